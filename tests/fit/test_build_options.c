/* The builder keeps its options: no table exceeds max_bytes and one that takes exactly that many is made, max_tv is met
 * by the smallest table, or refused with the size that meets it or with the floor, at which large tables end; the
 * default has 64 knots; options out of range are refused (progress: test_family_build). A search that gives up where
 * knots do not grow, or a floor that is not that of the moments, fails. */
#include "harness/test.h"
#include "oracle/oracle.h"

static vndf_distribution *build(const char *text, vndf_build_options options, vndf_certificate *claim,
                                vndf_error *error)
{
    vndf_source *source = oracle_source(text, NULL);
    vndf_distribution *table = vndf_build(source, &options, claim, error);
    vndf_source_free(source);
    return table;
}

/* More and more bytes leave less and less. */
static void test_sizes(void)
{
    static const size_t most[] = {2048, 4096, 10000, 16384, 65536, 1048576};
    double last = 1;
    size_t last_bytes = 0;
    for (size_t i = 0; i < test_amount(2, 4, 6); i++) {
        vndf_certificate claim = {0};
        vndf_distribution *table = build("ggx", (vndf_build_options){.max_bytes = most[i]}, &claim, NULL);
        vndf_info info = vndf_distribution_info(table);
        TEST(table && info.bytes <= most[i] && info.bytes >= last_bytes);
        TEST(memcmp(&info.certificate, &claim, sizeof claim) == 0);
        TEST((double)claim.tv_above <= last * 1.05 && (double)claim.tv <= 30 * fmax(last, 2e-3));
        last = (double)claim.tv_above;
        last_bytes = info.bytes;
        vndf_free(table);
    }
}

static size_t bytes_of(size_t max_bytes)
{
    vndf_distribution *table = build("exp(-r)", (vndf_build_options){.max_bytes = max_bytes}, NULL, NULL);
    size_t bytes = vndf_distribution_info(table).bytes;
    vndf_free(table);
    return bytes;
}

static void test_exact_size(void)
{
    size_t bytes = bytes_of(3000);
    TEST(bytes > 2900 && bytes_of(bytes) == bytes && bytes_of(bytes - 1) < bytes);
}

static void test_refused(void)
{
    static const struct {
        vndf_build_options options;
        const char *message;
    } cases[] = {{{.max_bytes = 2047}, "max_bytes"},  {{.max_bytes = (1 << 20) + 1}, "max_bytes"},
                 {{.max_tv = -1}, "max_tv"},          {{.max_tv = 1}, "max_tv"},
                 {{.max_tv = (double)NAN}, "max_tv"}, {{.moments = 5}, "moments is 5"},
                 {{.moments = 1}, "moments is 1"}};
    vndf_error error = {VNDF_OK, ""};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        TEST(!build("ggx", cases[i].options, NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
        TEST_HAS(error.message, cases[i].message);
    }
}

/* ---- targets ---- */

/* The bytes that a target takes; 0 if it is not reached. */
static size_t taken(const char *text, size_t max_bytes, double max_tv, vndf_error *error)
{
    vndf_certificate claim = {.tv = 1, .tv_above = 1};
    vndf_distribution *table =
        build(text, (vndf_build_options){.max_bytes = max_bytes, .max_tv = max_tv}, &claim, error);
    size_t bytes = vndf_distribution_info(table).bytes;
    vndf_free(table);
    return (double)claim.tv_above <= max_tv && (double)claim.tv <= fmin(30 * max_tv, 5e-2) ? bytes : 0;
}

/* From flat laws with an edge to peaks, tails among them, for which the default is enough. */
static void test_met(void)
{
    static const double edges[] = {0.5, 2, 8, 1, 1.5, 3, 4, 6}, falls[] = {3.2, 5, 8, 3.5, 4, 6};
    char text[96];
    for (size_t i = 0; i < test_amount(4, 12, 48); i++) {
        double p = edges[7 * i % 48 / 6], q = falls[7 * i % 48 % 6];
        snprintf(text, sizeof text, "(1+r^%g)^(-%g/%g)", p, q, p);
        if (!(TEST(taken(text, 0, 1e-2, NULL)) & TEST(taken(text, 0, 1e-3, NULL))))
            fprintf(stderr, "  %s\n", text);
    }
    for (int gamma = 230; gamma <= 265; gamma += (int)test_amount(35, 15, 5)) {
        snprintf(text, sizeof text, "student-t:%g", gamma / 100.0);
        TEST(taken(text, 0, 1e-2, NULL) && taken(text, 0, 1e-3, NULL) < 2100);
    }
}

/* With an eighth less it would not be met; 64 knots are the default where they are enough. */
static void test_smallest(void)
{
    static const char *const texts[] = {"ggx", "student-t:2.5", "exp(-3*r)*(1+0.8*cos(6*r))"};
    for (size_t i = 0; i < test_amount(2, 2, 3); i++) {
        double target = i < 2 ? 5e-4 : 1e-3;
        size_t bytes = taken(texts[i], 0, target, NULL);
        TEST(bytes && !taken(texts[i], bytes * 7 / 8, target, NULL));
        vndf_distribution *plain = build(texts[i], (vndf_build_options){.moments = 0}, NULL, NULL);
        TEST((vndf_distribution_info(plain).cells == 63) == (i < 2));
        vndf_free(plain);
    }
}

/* Large tables end at their floor, which is less than half the bound of the weights. */
static void test_floor(const char *text, int moments)
{
    static const float bound[] = {3.3e-2f, 2.4e-3f, 3.6e-4f};
    const vndf_build_options large = {.max_bytes = 65536, .moments = moments};
    vndf_certificate claim = {.tv = 1}, again = {.tv = 0};
    vndf_source *source = oracle_source(text, NULL), *other = oracle_source("exp(-r)", NULL);
    vndf_distribution *table = vndf_build(source, &large, &claim, NULL);
    TEST(claim.floor_above < bound[moments - 2]);
    TEST_RELATIVE((double)claim.floor_above, (double)claim.tv_above, 0.1);
    TEST_RELATIVE((double)claim.floor, (double)claim.tv, 0.1);
    TEST(vndf_certify(table, source, &again, NULL) == VNDF_OK && memcmp(&again, &claim, sizeof claim) == 0);
    TEST(vndf_certify(table, other, &again, NULL) == VNDF_ERROR_DISTRIBUTION);
    TEST(vndf_certify(NULL, source, &again, NULL) && vndf_certify(table, source, NULL, NULL));
    vndf_free(table);
    vndf_source_free(source);
    vndf_source_free(other);
}

/* What is said to reach a target reaches it. */
static void test_unmet(void)
{
    vndf_error error = {VNDF_OK, ""};
    TEST(!taken("ggx", 2048, 4e-4, &error) && error.status == VNDF_ERROR_TARGET);
    const char *takes = strstr(error.message, "a total variation of 0.0004 above the horizon takes some ");
    TEST(takes && taken("ggx", strtoul(strstr(takes, "some") + 5, NULL, 10), 4e-4, NULL) > 2048);
    TEST(!taken("ggx", 0, 1e-5, &error) && error.status == VNDF_ERROR_TARGET);
    TEST_HAS(error.message, "1e-05 above the horizon: 4 moments leave 0.0002");
    TEST(!taken("ggx", 2048, 2.5e-4, &error) && TEST_HAS(error.message, "0.0075 below the horizon: 4 "));
    TEST(!build("ggx", (vndf_build_options){.max_tv = 1.5e-3, .moments = 2}, NULL, &error));
    TEST_HAS(error.message, "2 moments leave 0.0163 whatever the size; 3 moments leave 0.0012");
}

int main(void)
{
    test_sizes();
    test_exact_size();
    test_refused();
    test_met();
    test_smallest();
    test_unmet();
    for (int moments = 2; moments <= 4; moments++) {
        test_floor("ggx", moments);
        test_floor("exp(-3*r)", moments);
    }
    return test_done();
}
