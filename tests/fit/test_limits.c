/* Every limit that the headers state is where they state it: what is at the limit is taken, what is one beyond is
 * refused with an error that names the limit. (Length and depth of expressions, lines and rows of a CSV, panels, sizes
 * of tables: test_expression, test_csv, test_build_refusals, test_build_options.) */
#include "fit/profile/profile.h"
#include "harness/damage.h"
#include "source/sources.h"

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
    TEST(!vndf_build(source, NULL, NULL, &error) && error.status == VNDF_ERROR_TARGET);
    TEST_HAS(error.message, "8192 bytes are too few: the smallest table of this distribution takes ");
    vndf_source_free(source);
    name[VNDF_LIMIT_NAME_LENGTH] = 'a';
    refused(vndf_source_slope_callback(laplace, NULL, name, &error), &error, VNDF_ERROR_ARGUMENT, "at most 4096");
    refused(vndf_source_csv_text(name, "slope,p22\n0,1\n1,0\n", 18, &error), &error, VNDF_ERROR_ARGUMENT,
            "at most 4096");
    refused(vndf_source_family(name, &error), &error, VNDF_ERROR_SYNTAX, "at most 4096");
}

/* A table with 10 GiB behind it: a hole, which takes no room on most disks. */
static void test_long_files(void)
{
    static unsigned char bytes[4096];
    const char *path = "limits.tmp";
    vndf_error error = {VNDF_OK, ""};
    size_t size = read_bytes(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", bytes, sizeof bytes);
    FILE *file = fopen(path, "wb");
    int good = file && fwrite(bytes, 1, size, file) == size;
    for (int gigabytes = 0; good && gigabytes < 10; gigabytes++)
        good = fseek(file, 1L << 30, SEEK_CUR) == 0;
    good = good && fputc(0, file) != EOF;
    if (file && fclose(file) == 0 && good) {
        TEST(!vndf_load(path, &error) && error.status == VNDF_ERROR_TABLE &&
             TEST_HAS(error.message, "more follow"));
        refused(vndf_source_csv_file(path, &error), &error, VNDF_ERROR_SYNTAX, "more than 16777216 bytes");
    } else
        fprintf(stderr, "no file of 10 GiB can be made here\n");
    remove(path);
}

/* The size that a table states bounds what is read and allocated, whatever follows; the largest that is possible
 * fails for what follows alone. */
static void test_stated_size(void)
{
    unsigned char bytes[64] = "VNDFtab\n";
    vndf_error error = {VNDF_OK, ""};
    put_u32(bytes + 8, 5); /* the version */
    put_u32(bytes + 12, VNDF_LIMIT_TABLE_BYTES);
    TEST(!vndf_load_memory(bytes, sizeof bytes, &error) && !strstr(error.message, "are possible"));
    put_u32(bytes + 12, VNDF_LIMIT_TABLE_BYTES + 1u);
    TEST(!vndf_load_memory(bytes, sizeof bytes, &error) && error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "at most 8388608 are possible");
}

static void test_operations(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    TEST(vndf_guard_spend(&guard, VNDF_LIMIT_BUILD_OPERATIONS) && vndf_guard_status(&guard, &error) == VNDF_OK);
    TEST(!vndf_guard_spend(&guard, 1e6) && vndf_guard_status(&guard, &error) == VNDF_ERROR_DISTRIBUTION);
    TEST(strstr(error.message, "too costly") && strstr(error.message, "1e+10 operations"));
}

int main(void)
{
    test_names();
    test_long_files();
    test_stated_size();
    test_operations();
    return test_done();
}
