/* The builder keeps its options: no table exceeds max_bytes and one that takes exactly that many is made, max_tv is met
 * or refused with what was reached, options out of range are refused, and progress may stop a build. */
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
    const vndf_build_options impossible = {.max_bytes = 2048, .max_tv = 1e-5};
    TEST(!build("ggx", impossible, NULL, &error) && error.status == VNDF_ERROR_TARGET);
    TEST(strstr(error.message, "1e-05") && strstr(error.message, "reach"));
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
    test_progress();
    return test_done();
}
