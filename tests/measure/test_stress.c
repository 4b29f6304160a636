/* No input is too hard: every property of tools/measure/stress.h holds over its product of directions, roughnesses
 * and uniform numbers, for every shipped table, the smallest table of each source, the closed forms, and
 * distributions that are pathological: jumps, a hole at the pole, a narrow ring, an unbounded peak, a tail at the
 * edge of integrability, two scales a hundred apart, and a scale of 1e-9. more_stress takes the whole product, as
 * `vndf check --hard` does, but of the smallest tables and the pathological ones every fifth view; stress takes every
 * 19th and every 37th. With the name of a shipped table it looks at that and the smallest of the source. */
#include "oracle/oracle.h"
#include "measure/stress.h"
#include "harness/test.h"

static const char *const pathological[] = {
    "step(1-r)",       "exp(-r)*step(r-2)", "exp(-((r-1)/0.02)^2)",          "r^-1.5*exp(-r)",
    "r^-1.75*exp(-r)", "(1+r*r)^-1.55",     "exp(-r*r)+1e4*exp(-(100*r)^2)", "exp(-1e9*r)"};

static void print_point(const stress_point *at)
{
    fprintf(stderr, "    at wi %.9g %.9g %.9g alpha %.9g %.9g u %.9g %.9g wo %.9g %.9g %.9g\n", (double)at->wi.x,
            (double)at->wi.y, (double)at->wi.z, (double)at->alpha_x, (double)at->alpha_y, (double)at->u1,
            (double)at->u2, (double)at->wo.x, (double)at->wo.y, (double)at->wo.z);
}

static void test_distribution(const vndf_distribution *d, const char *name, size_t every)
{
    stress_result result = {0};
    if (!TEST(d != NULL))
        return;
    stress_run(d, test_amount(37, every == 1 ? 19 : 37, 2 * every), 1, &result);
    fprintf(stderr, "%-50s %6lu bytes, %lu samples, density repeated within %.2g\n", name,
            (unsigned long)vndf_distribution_info(d).bytes, (unsigned long)result.samples,
            result.found[STRESS_REPEATED].worst);
    TEST(result.samples > 40000);
    for (int id = 0; id < STRESS_COUNT; id++) {
        const stress_finding *found = &result.found[id];
        if (TEST(found->failed == 0) & TEST(found->checked > 0))
            continue;
        fprintf(stderr, "  %s: %lu of %lu fail, worst %g\n", stress_property_of((stress_id)id)->name,
                (unsigned long)found->failed, (unsigned long)found->checked, found->worst);
        print_point(&found->at);
    }
}

static void test_source(vndf_source *source, size_t bytes, size_t every)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_build_options options = {.max_bytes = bytes};
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, &error) : NULL;
    if (!table)
        fprintf(stderr, "  %s\n", error.message);
    test_distribution(table, source ? vndf_source_description(source) : "no source", every);
    vndf_free(table);
}

/* A shipped table, and the smallest of the same source unless the one before was of that source. */
static void test_shipped(const char *file, char *last, size_t size)
{
    char path[8192];
    vndf_error error = {VNDF_OK, ""};
    snprintf(path, sizeof path, VNDF_SOURCE_DIR "/tables/%s", file);
    vndf_distribution *table = vndf_load(path, &error);
    test_distribution(table, file, 1);
    if (table && strcmp(vndf_distribution_info(table).source, last) != 0) {
        snprintf(last, size, "%s", vndf_distribution_info(table).source);
        vndf_source *source = vndf_source_of(table, &error);
        if (!source)
            source = vndf_source_csv_file(VNDF_SOURCE_DIR "/tables/example.csv", &error);
        test_source(source, 2048, 5);
        vndf_source_free(source);
    }
    vndf_free(table);
}

/* The first column of the manifest, below its head. */
static void test_all_shipped(void)
{
    FILE *manifest = fopen(VNDF_SOURCE_DIR "/tables/manifest.csv", "r");
    char line[4096], last[1024] = "";
    int count = 0;
    if (!TEST(manifest != NULL))
        return;
    while (fgets(line, sizeof line, manifest))
        if (count++ > 0) {
            line[strcspn(line, ",")] = '\0';
            test_shipped(line, last, sizeof last);
        }
    fclose(manifest);
    TEST(count > 10);
}

static void test_pathological(void)
{
    for (size_t i = 0; i < sizeof pathological / sizeof *pathological; i++) {
        vndf_error error = {VNDF_OK, ""};
        vndf_source *source = vndf_source_slope_expression(pathological[i], NULL, 0, &error);
        for (size_t size = 0; size < 2; size++) /* a short run takes each at one of the two sizes */
            if (test_long() || size == i % 2)
                test_source(source, size ? 2048 : 0, 5);
        vndf_source_free(source);
    }
}

/* What is wrong is counted, and the worst is kept: NaN is worse than any number. */
static void test_notes(void)
{
    stress_result result = {0};
    stress_point first = {.u1 = 1}, second = {.u1 = 2};
    TEST(stress_note(&result, STRESS_REPEATED, 1e-6, &first) && stress_failed(&result) == 0);
    TEST(!stress_note(&result, STRESS_REPEATED, 1e-4, &second) && stress_failed(&result) == 1);
    TEST(stress_note(&result, STRESS_REPEATED, 0, &first) && result.found[STRESS_REPEATED].worst == 1e-4);
    TEST(result.found[STRESS_REPEATED].at.u1 == 2 && result.found[STRESS_REPEATED].failed == 1);
    TEST(!stress_note(&result, STRESS_REPEATED, NAN, &first) && result.found[STRESS_REPEATED].worst == INFINITY);
}

int main(int arguments, char **argument)
{
    test_notes();
    if (arguments > 1) {
        char last[1024] = "";
        test_shipped(argument[1], last, sizeof last);
        return test_done();
    }
    test_distribution(vndf_ggx(), "closed ggx", 1);
    test_distribution(vndf_beckmann(), "closed beckmann", 1);
    test_pathological();
    test_all_shipped();
    return test_done();
}
