/* Narrow features of what is no formula: a callback shows those as wide as vndf_build_options.finest or beside a
 * break, a CSV every row, a family its lobes at any scale; and a table is measured as closely as it was built. */
#include "harness/constants.h"
#include "harness/test.h"

#include <stdlib.h>

#include "fit/profile/profile.h"

/* exp(-r) and a ring at `at`; masses are 2 pi and 2 pi^1.5 height at^2 width. */
typedef struct ring {
    double at, width, height;
} ring;

static double ring_p22(double r, void *user)
{
    const ring *g = user;
    double x = (r - g->at) / (g->at * g->width);
    return exp(-r) + g->height * exp(-x * x);
}

static double mass_of(const ring *g)
{
    return 2 * PI * (1 + g->height * g->at * g->at * g->width * sqrt(PI));
}

/* With half of the mass. */
static ring ring_from(double at, double width)
{
    ring g = {at, width, 1 / (at * at * width * sqrt(PI))};
    return g;
}

static double found_mass(const vndf_source *source, const vndf_resolution *resolution, double *finest)
{
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_error error = {VNDF_OK, ""};
    vndf_profile *profile = vndf_profile_from(source, resolution, &guard, &error);
    double mass = profile ? 1 / profile->normalization : 0;
    if (!TEST(profile != NULL))
        fprintf(stderr, "  %s\n", error.message);
    *finest = profile ? profile->finest : -1;
    TEST(profile && (*finest > 0 ? profile->hidden == 1 : profile->hidden <= 1e-5));
    vndf_profile_free(profile);
    return mass;
}

/* Found by points that are close enough, at any place. */
static void test_finest(double width, double finest, double recorded, int places)
{
    unsigned long long state = 11;
    vndf_resolution resolution = {NULL, 0, finest};
    for (int i = 0; i < places; i++) {
        ring g = ring_from(0.1 * exp(4 * test_uniform(&state)), width);
        double got = 0;
        vndf_source *source = vndf_source_slope_callback(ring_p22, &g, "ring", NULL);
        TEST_RELATIVE(found_mass(source, &resolution, &got), mass_of(&g), 1e-5);
        TEST(got == recorded);
        vndf_source_free(source);
    }
}

/* Found because its place is told, however narrow it is. */
static void test_breaks(double width)
{
    unsigned long long state = 12;
    for (int i = 0; i < 20; i++) {
        ring g = ring_from(0.1 * exp(4 * test_uniform(&state)), width);
        double got;
        vndf_resolution resolution = {&g.at, 1, 0};
        vndf_source *source = vndf_source_slope_callback(ring_p22, &g, "ring", NULL);
        TEST_RELATIVE(found_mass(source, &resolution, &got), mass_of(&g), 1e-5);
        vndf_source_free(source);
    }
}

/* The table says how it was built, and is measured so. */
static void test_provenance(void)
{
    ring g = ring_from(1.2345, 1e-6);
    double breaks[] = {1.2345};
    vndf_build_options options = {.max_bytes = 4096, .breaks = breaks, .break_count = 1, .finest = 2e-3};
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_slope_callback(ring_p22, &g, "ring", NULL);
    vndf_distribution *table = vndf_build(source, &options, NULL, &error);
    vndf_certificate built, measured;
    if (TEST(table != NULL)) {
        built = vndf_distribution_info(table).certificate;
        TEST_HAS(vndf_distribution_info(table).source, "--slope-callback ring --break 1.2345 --finest 0.002");
        TEST(vndf_certify(table, source, &measured, &error) == VNDF_OK);
        TEST(measured.tv == built.tv && measured.area_error == built.area_error);
    }
    vndf_free(table);
    vndf_source_free(source);
}

static void test_source_of(void)
{
    double breaks[] = {2, 0.5};
    vndf_build_options options = {.max_bytes = 2048, .breaks = breaks, .break_count = 2, .finest = 1e-3};
    vndf_source *source = vndf_source_family("mix:(0.5,1,ggx)+(0.5,0.1,ggx)", NULL);
    vndf_distribution *table = vndf_build(source, &options, NULL, NULL);
    vndf_source *again = table ? vndf_source_of(table, NULL) : NULL;
    TEST(again && strcmp(vndf_source_description(again), vndf_source_description(source)) == 0);
    vndf_source_free(again);
    vndf_free(table);
    vndf_source_free(source);
}

/* exp(-r) from 0 to 20 in so many digits; one row has more. */
static vndf_source *csv(int rows, const char *format, int spike, double height)
{
    char *text = malloc((size_t)rows * 48 + 64);
    size_t used = text ? (size_t)sprintf(text, "slope,p22\n") : 0;
    for (int i = 0; text && i < rows; i++) {
        double r = 20.0 * i / (rows - 1);
        used += (size_t)sprintf(text + used, "%.12g,", r);
        used += (size_t)sprintf(text + used, format, exp(-r) + (i == spike ? height : 0));
    }
    vndf_source *source = text ? vndf_source_csv_text("rows", text, used, NULL) : NULL;
    free(text);
    return source;
}

/* What a source has more than exp(-r) within three steps of r: integral r dr. */
static double surplus(const vndf_source *source, double r, double step)
{
    enum { PARTS = 6000 };
    double sum = 0, h = 6 * step / PARTS;
    for (int i = 0; i < PARTS; i++) {
        double at = r - 3 * step + h * (i + 0.5);
        sum += h * at * (vndf_source_p22(source, at) - exp(-at));
    }
    return sum;
}

/* Rows of few digits are smooth; one among many is seen. */
static void test_rows(int rows, int spike)
{
    double r = 20.0 * spike / (rows - 1), step = 20.0 / (rows - 1), finest, share = 0.1, tail = 21 * exp(-20);
    vndf_source *smooth = csv(rows, "%.9g\n", -1, 0), *short_of_digits = csv(rows, "%g\n", -1, 0);
    vndf_source *peaked = csv(rows, "%.9g\n", spike, share / (r * step));
    TEST_RELATIVE(found_mass(smooth, NULL, &finest), 2 * PI * (1 - tail), 1e-6);
    TEST_RELATIVE(found_mass(short_of_digits, NULL, &finest), 2 * PI * (1 - tail), 1e-6);
    TEST(finest == 0);
    TEST_RELATIVE(found_mass(peaked, NULL, &finest), 2 * PI * (1 - tail + surplus(peaked, r, step)), 1e-5);
    vndf_source_free(smooth);
    vndf_source_free(short_of_digits);
    vndf_source_free(peaked);
}

/* The weights of a mix are its masses. */
static void test_family(const char *specification)
{
    double finest;
    vndf_source *source = vndf_source_family(specification, NULL);
    TEST_RELATIVE(found_mass(source, NULL, &finest), 1.0, 1e-5);
    TEST(finest == 0);
    vndf_source_free(source);
}

int main(void)
{
    test_finest(1e-3, 0, 1e-3, (int)test_amount(20, 20, 60));
    test_finest(1e-4, 1e-4, 1e-4, 12);
    test_breaks(1e-5);
    test_breaks(1e-9);
    test_provenance();
    test_source_of();
    test_rows(5000, 3000);
    test_rows(100000, 12345);
    test_family("mix:(0.5,1e-9,ggx)+(0.5,1e3,ggx)");
    test_family("mix:(0.5,1e-6,epd:1000)+(0.5,1e6,epd:1000)");
    test_family("mix:(0.001,1e-6,beckmann)+(0.999,1,epd:1000)");
    return test_done();
}
