/* The builder keeps its options: the same input gives the same bytes, no table exceeds max_bytes and one that
 * takes exactly that many is made, max_tv is met or refused with what was reached, options out of range are
 * refused, and progress may stop a build. */
#include "core/checksum.h"
#include "oracle/oracle.h"
#include "harness/test.h"

static unsigned char bytes[1 << 20];

/* Of all but the checksum at the end: with it, that of every table is the same. */
static uint32_t checksum_of(const vndf_distribution *table)
{
    size_t size = vndf_distribution_info(table).bytes;
    TEST(vndf_save_memory(table, bytes, size, NULL) == VNDF_OK);
    return vndf_crc32(0, bytes, size - 4);
}

static void test_sizes(void)
{
    const size_t sizes[] = {2048, 4096, 10000, 16384, 65536, 1048576};
    oracle o = oracle_get(ORACLE_GGX);
    double last = 1;
    for (int i = 0; i < (int)test_amount(2, 4, 6); i++) {
        vndf_certificate claim = {0};
        vndf_distribution *table = oracle_build(o.name, sizes[i], &claim, NULL);
        vndf_certificate held = vndf_distribution_info(table).certificate;
        TEST(table && vndf_distribution_info(table).bytes <= sizes[i]);
        TEST(memcmp(&held, &claim, sizeof claim) == 0);
        TEST(claim.tv_above <= last * 1.05); /* more bytes, no worse */
        last = (double)claim.tv_above;
        vndf_free(table);
    }
}

static void test_same_bytes(void)
{
    for (size_t i = 0; i < ORACLE_COUNT; i += test_long() ? 3 : 5) {
        oracle o = oracle_get(i);
        vndf_distribution *a = oracle_build(o.name, 8192, NULL, NULL), *b = oracle_build(o.name, 8192, NULL, NULL);
        TEST(a && b && checksum_of(a) == checksum_of(b));
        vndf_free(a);
        vndf_free(b);
    }
}

static vndf_distribution *build(size_t max_bytes, double max_tv, vndf_certificate *claim, vndf_error *error)
{
    oracle o = oracle_get(ORACLE_GGX);
    vndf_source *source = oracle_source(o.name, NULL);
    vndf_build_options options = {.max_bytes = max_bytes, .max_tv = max_tv};
    vndf_distribution *table = vndf_build(source, &options, claim, error);
    vndf_source_free(source);
    return table;
}

static void test_target(void)
{
    const double targets[] = {0.1, 0.01, 1e-3, 6e-4};
    size_t last = 0;
    for (int i = 0; i < (int)test_amount(2, 3, 4); i++) {
        vndf_certificate claim = {.tv = 1, .tv_above = 1};
        vndf_error error = {VNDF_OK, ""};
        vndf_distribution *table = build(0, targets[i], &claim, &error);
        TEST(table != NULL && (double)claim.tv_above <= targets[i] && (double)claim.tv <= 30 * targets[i]);
        size_t size = table ? vndf_distribution_info(table).bytes : 0;
        TEST(size >= last && size <= 8192);
        last = size;
        vndf_free(table);
    }
    vndf_error error = {VNDF_OK, ""};
    TEST(!build(2048, 1e-5, NULL, &error));
    TEST(error.status == VNDF_ERROR_TARGET);
    TEST_HAS(error.message, "1e-05");
    TEST_HAS(error.message, "reach");
}

static void test_bad_options(void)
{
    static const double bad[] = {1, -1}, many[VNDF_LIMIT_BREAKS + 1] = {1};
    static const struct {
        vndf_build_options options;
        const char *message;
    } cases[] = {{{.max_bytes = 1}, "max_bytes"},
                 {{.max_bytes = 2047}, "max_bytes"},
                 {{.max_bytes = (1 << 20) + 1}, "max_bytes"},
                 {{.max_bytes = (size_t)-1}, "max_bytes"},
                 {{.max_tv = -1}, "max_tv"},
                 {{.max_tv = 1}, "max_tv"},
                 {{.max_tv = (double)NAN}, "max_tv"},
                 {{.max_tv = (double)INFINITY}, "max_tv"},
                 {{.moments = 5}, "moments is 5"},
                 {{.breaks = bad, .break_count = 2}, "a break is -1; it is a slope above 0"},
                 {{.break_count = 2}, "breaks is NULL"},
                 {{.breaks = many, .break_count = VNDF_LIMIT_BREAKS + 1}, "65 breaks; at most 64"},
                 {{.finest = -1}, "finest is -1"},
                 {{.finest = 1e-10}, "finest is 1e-10"}};
    vndf_source *source = vndf_source_family("ggx", NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vndf_error error = {VNDF_OK, ""};
        TEST(!vndf_build(source, &cases[i].options, NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
        TEST_HAS(error.message, cases[i].message);
    }
    vndf_source_free(source);
}

/* What progress was told: `user` points to one. */
typedef struct told {
    double last;
    int calls, stop_after, in_order;
} told;

static int note(double done, const char *what, void *user)
{
    told *t = user;
    t->in_order &= done >= t->last && done <= 1 && what != NULL;
    t->last = done;
    return ++t->calls >= t->stop_after;
}

static void test_progress(void)
{
    oracle o = oracle_get(ORACLE_GGX);
    vndf_source *source = oracle_source(o.name, NULL);
    told all = {0, 0, 1 << 30, 1}, some = {0, 0, 2, 1};
    vndf_build_options options = {.progress = note, .progress_user = &all};
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = vndf_build(source, &options, NULL, &error);
    TEST(table && all.calls > 5 && all.in_order); /* at stages, and every 2^18 operations */
    vndf_free(table);
    options.progress_user = &some;
    TEST(!vndf_build(source, &options, NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "interrupted");
    vndf_source_free(source);
}

static double laplace(double r, void *user)
{
    (void)user;
    return exp(-r);
}

/* The bytes of the smallest table that 2048 allow, with a name of `length` letters in it; 0: none fits. */
static size_t bytes_with_name(size_t length)
{
    static char name[2048];
    const vndf_build_options options = {.max_bytes = 2048};
    vndf_error error = {VNDF_OK, ""};
    memset(name, 'n', length);
    name[length] = '\0';
    vndf_source *source = vndf_source_slope_callback(laplace, NULL, name, &error);
    vndf_distribution *table = vndf_build(source, &options, NULL, &error);
    size_t size = table ? vndf_distribution_info(table).bytes : 0;
    TEST(size ? size <= 2048 : error.status == VNDF_ERROR_TARGET);
    vndf_free(table);
    vndf_source_free(source);
    return size;
}

/* The name stands in the table, so that a letter is a byte. Near the longest name with which a table fits it has the
 * fewest knots that there are, and its size is known; the name that fills it to the last byte has to fit, and no longer
 * one. */
static void test_exact_size(void)
{
    size_t fits = 1, large = 2000, size = 0;
    while (large - fits > 8) { /* a knot takes 44 bytes */
        size_t middle = (fits + large) / 2, found = bytes_with_name(middle);
        size = found ? found : size;
        fits = found ? middle : fits;
        large = found ? large : middle;
    }
    fits += 2048 - size;
    TEST(size > 0 && bytes_with_name(fits) == 2048 && bytes_with_name(fits + 1) == 0);
}

int main(void)
{
    test_sizes();
    test_exact_size();
    test_same_bytes();
    test_target();
    test_bad_options();
    test_progress();
    return test_done();
}
