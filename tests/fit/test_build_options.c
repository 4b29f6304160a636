/* The builder keeps its options: no table exceeds max_bytes and one that takes exactly that many is made, max_tv is met
 * by the smallest table, or refused with the size that meets it or with the floor, at which large tables end; the
 * default has 64 knots; options out of range are refused, and progress may stop a build. A search that gives up where
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

/* Of options that ask for more and more. */
static void test_asked(const vndf_build_options *asked, size_t count)
{
    double last = 1;
    size_t last_bytes = 0;
    for (size_t i = 0; i < count; i++) {
        size_t most = asked[i].max_bytes ? asked[i].max_bytes : 8192;
        double tv = asked[i].max_tv > 0 ? asked[i].max_tv : last * 1.05;
        vndf_certificate claim = {0};
        vndf_distribution *table = build("ggx", asked[i], &claim, NULL);
        vndf_info info = vndf_distribution_info(table);
        TEST(table && info.bytes <= most && info.bytes >= last_bytes);
        TEST(memcmp(&info.certificate, &claim, sizeof claim) == 0);
        TEST((double)claim.tv_above <= tv && (double)claim.tv <= 30 * fmax(tv, 2e-3));
        last = (double)claim.tv_above;
        last_bytes = info.bytes;
        vndf_free(table);
    }
}

static void test_sizes(void)
{
    const vndf_build_options sizes[] = {{.max_bytes = 2048},  {.max_bytes = 4096},  {.max_bytes = 10000},
                                        {.max_bytes = 16384}, {.max_bytes = 65536}, {.max_bytes = 1048576}};
    const vndf_build_options targets[] = {{.max_tv = 0.1}, {.max_tv = 0.01}, {.max_tv = 1e-3}, {.max_tv = 6e-4}};
    test_asked(sizes, test_amount(2, 4, 6));
    test_asked(targets, test_amount(2, 3, 4));
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
                 {{.max_tv = (double)NAN}, "max_tv"}, {{.moments = 5}, "moments is 5"}};
    vndf_error error = {VNDF_OK, ""};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        TEST(!build("ggx", cases[i].options, NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
        TEST_HAS(error.message, cases[i].message);
    }
}

/* ---- targets ---- */

static int meets(const char *text, size_t max_bytes, double max_tv, vndf_info *info, vndf_error *error)
{
    vndf_certificate claim = {.tv = 1, .tv_above = 1};
    vndf_distribution *table =
        build(text, (vndf_build_options){.max_bytes = max_bytes, .max_tv = max_tv}, &claim, error);
    *info = vndf_distribution_info(table);
    vndf_free(table);
    return table && (double)claim.tv_above <= max_tv && (double)claim.tv <= fmin(30 * max_tv, 5e-2);
}

/* Laws that fall as r^-q, from flat ones with an edge to peaks, and tails for which the default has to be enough. */
static void test_met(void)
{
    static const double edges[] = {0.5, 2, 8, 1, 1.5, 3, 4, 6}, falls[] = {3.2, 5, 8, 3.5, 4, 6};
    vndf_info info;
    char text[96];
    for (size_t p = 0; p < test_amount(2, 3, 8); p++)
        for (size_t q = 0; q < test_amount(2, 3, 6); q++)
            for (int fine = 0; fine < 2; fine++) {
                snprintf(text, sizeof text, "(1+r^%g)^(-%g/%g)", edges[p], falls[q], edges[p]);
                if (!TEST(meets(text, 0, fine ? 1e-3 : 1e-2, &info, NULL)))
                    fprintf(stderr, "  %s\n", text);
            }
    for (int gamma = 230; gamma <= 265; gamma += (int)test_amount(35, 15, 5)) {
        snprintf(text, sizeof text, "student-t:%g", gamma / 100.0);
        TEST(meets(text, 0, 1e-2, &info, NULL) && meets(text, 0, 1e-3, &info, NULL) && info.bytes < 2100);
    }
}

/* With an eighth less it would not be met; the default has 64 knots where they are enough. */
static void test_smallest(void)
{
    static const char *const texts[] = {"ggx", "exp(-3*r)*(1+0.8*cos(6*r))", "(1+r^2)^-1.55", "student-t:2.5"};
    static const double targets[] = {5e-4, 1e-3, 1e-3, 5e-4};
    vndf_info info, less;
    for (size_t i = 0; i < test_amount(2, 2, 4); i++) {
        TEST(meets(texts[i], 0, targets[i], &info, NULL));
        if (!TEST(!meets(texts[i], info.bytes * 7 / 8, targets[i], &less, NULL)))
            fprintf(stderr, "  %s: %zu, and %zu\n", texts[i], info.bytes, less.bytes);
        vndf_distribution *plain = build(texts[i], (vndf_build_options){.moments = 0}, NULL, NULL);
        TEST(vndf_distribution_info(plain).cells >= 63 && (i % 3 || vndf_distribution_info(plain).cells == 63));
        vndf_free(plain);
    }
}

/* Large tables end at their floor. */
static void test_floor(const char *text, int moments)
{
    const vndf_build_options large = {.max_bytes = 65536, .moments = moments};
    vndf_certificate claim = {.tv = 1}, again = {.tv = 0};
    vndf_source *source = oracle_source(text, NULL);
    vndf_distribution *table = vndf_build(source, &large, &claim, NULL);
    TEST_RELATIVE((double)claim.floor_above, (double)claim.tv_above, 0.1);
    TEST_RELATIVE((double)claim.floor, (double)claim.tv, 0.1);
    TEST(vndf_certify(table, source, &again, NULL) == VNDF_OK && memcmp(&again, &claim, sizeof claim) == 0);
    vndf_free(table);
    vndf_source_free(source);
}

/* What is said to reach a target reaches it. */
static void test_unmet(void)
{
    vndf_info info;
    vndf_error error = {VNDF_OK, ""};
    TEST(!meets("ggx", 2048, 4e-4, &info, &error) && error.status == VNDF_ERROR_TARGET);
    const char *takes = strstr(error.message, "a total variation of 0.0004 above the horizon takes ");
    size_t bytes = takes ? strtoul(strstr(takes, "takes") + 6, NULL, 10) : 0;
    TEST(bytes > 2048 && meets("ggx", bytes, 4e-4, &info, NULL));
    TEST(!meets("ggx", 0, 1e-5, &info, &error) && error.status == VNDF_ERROR_TARGET);
    TEST_HAS(error.message, "1e-05 above the horizon: 4 moments leave 0.0002");
    TEST(!meets("ggx", 2048, 2.5e-4, &info, &error) && TEST_HAS(error.message, "0.0075 below the horizon: 4 "));
    TEST(!build("ggx", (vndf_build_options){.max_tv = 1.5e-3, .moments = 2}, NULL, &error));
    TEST_HAS(error.message, "2 moments leave 0.016");
    TEST_HAS(error.message, "whatever the size; 3 moments leave 0.0012");
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
    told all = {0, 0, 1 << 30, 1}, some = {0, 0, 2, 1};
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table =
        build("ggx", (vndf_build_options){.progress = note, .progress_user = &all}, NULL, NULL);
    TEST(table && all.calls > 5 && all.in_order); /* at stages, and every 2^18 operations */
    vndf_free(table);
    TEST(!build("ggx", (vndf_build_options){.progress = note, .progress_user = &some}, NULL, &error));
    TEST(error.status == VNDF_ERROR_ARGUMENT && TEST_HAS(error.message, "interrupted"));
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
    test_progress();
    return test_done();
}
