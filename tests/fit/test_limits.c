/* Every limit that the headers state is where they state it: what is at the limit is taken, what is one beyond
 * is refused with an error that names the limit. (Length and depth of expressions, lines and rows of a CSV, panels:
 * test_expression, test_csv, test_certificate.) */
#include <stdlib.h>

#include "fit/guard.h"
#include "oracle/oracle.h"
#include "table/file.h"
#include "harness/test.h"

/* ---- texts ---- */

static double laplace(double r, void *user)
{
    (void)user;
    return exp(-r);
}

/* The worst name that is allowed takes four characters for each of its own, and still comes back from a table. */
static void test_names(void)
{
    static char name[VNDF_LIMIT_NAME_LENGTH + 2];
    vndf_error error = {VNDF_OK, ""};
    vndf_build_options options = {.max_bytes = 65536};
    memset(name, '\'', VNDF_LIMIT_NAME_LENGTH);
    vndf_source *source = vndf_source_slope_callback(laplace, NULL, name, &error);
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, &error) : NULL;
    TEST(table && strlen(vndf_distribution_info(table).source) > 4 * VNDF_LIMIT_NAME_LENGTH);
    vndf_free(table);
    vndf_source_free(source);
    name[VNDF_LIMIT_NAME_LENGTH] = 'a';
    TEST(!vndf_source_slope_callback(laplace, NULL, name, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "at most 4096");
    error.message[0] = '\0';
    TEST(!vndf_source_csv_text(name, "slope,p22\n0,1\n1,0\n", 18, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "at most 4096");
    TEST(!vndf_source_family(name, &error) && error.status == VNDF_ERROR_SYNTAX);
    TEST_HAS(error.message, "at most 4096");
}

/* ---- files ---- */

/* A file that begins with these bytes and ends `gigabytes` further: a hole, which takes no room on most disks. */
static int make_long(const char *path, const unsigned char *bytes, size_t size, long gigabytes)
{
    FILE *file = fopen(path, "wb");
    int good = file && fwrite(bytes, 1, size, file) == size;
    for (long i = 0; good && i < gigabytes; i++)
        good = fseek(file, 1L << 30, SEEK_CUR) == 0;
    good = good && fputc(0, file) != EOF;
    return file && fclose(file) == 0 && good;
}

static void test_long_files(void)
{
    unsigned char bytes[4096];
    const char *path = "limits.tmp";
    vndf_error error = {VNDF_OK, ""};
    FILE *shipped = fopen(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", "rb");
    size_t size = shipped ? fread(bytes, 1, sizeof bytes, shipped) : 0;
    if (shipped)
        fclose(shipped);
    if (make_long(path, bytes, size, 10)) {
        TEST(!vndf_load(path, &error) && error.status == VNDF_ERROR_TABLE);
        TEST_HAS(error.message, "more follow");
        TEST(!vndf_source_csv_file(path, &error));
        TEST_HAS(error.message, "more than 16777216 bytes");
    } else
        fprintf(stderr, "no file of 10 GiB can be made here\n");
    remove(path);
}

static void state_size(unsigned char *bytes, unsigned size)
{
    for (int i = 0; i < 4; i++)
        bytes[12 + i] = (unsigned char)(size >> (8 * i) & 0xffu);
}

/* The size that a table states bounds what is read and allocated, whatever follows; the largest that is possible
 * fails for what follows alone. */
static void test_stated_size(void)
{
    unsigned char bytes[64] = "VNDFtab\n";
    vndf_error error = {VNDF_OK, ""};
    bytes[8] = 4; /* the version */
    state_size(bytes, VNDF_LIMIT_TABLE_BYTES);
    TEST(!vndf_load_memory(bytes, sizeof bytes, &error) && !strstr(error.message, "are possible"));
    state_size(bytes, VNDF_LIMIT_TABLE_BYTES + 1u);
    TEST(!vndf_load_memory(bytes, sizeof bytes, &error) && error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "from 64 to 8388608 are possible");
    TEST(make_long("limits.tmp", bytes, sizeof bytes, 0));
    TEST(!vndf_load("limits.tmp", &error) && error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "limits.tmp: the table says that it has 8388609 bytes");
    remove("limits.tmp");
}

/* ---- builds ---- */

static void test_operations(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    TEST(vndf_guard_spend(&guard, VNDF_LIMIT_BUILD_OPERATIONS) && vndf_guard_status(&guard, &error) == VNDF_OK);
    TEST(!vndf_guard_spend(&guard, 1e6) && vndf_guard_status(&guard, &error) == VNDF_ERROR_DISTRIBUTION);
    TEST_HAS(error.message, "too costly");
    TEST_HAS(error.message, "1e+10 operations");
}

int main(void)
{
    test_names();
    test_long_files();
    test_stated_size();
    test_operations();
    return test_done();
}
