/* The bins of the chi-square test hold the whole density: their sum is 1 within 2e-6 where a lobe has parts of
 * very different width, an unbounded peak, a tail that barely has an area, a ring, or a jump, up to grazing; in a
 * ring of width 1e-4, whose slopes floats hardly tell apart, it is within what bins_integrate says of rounding. Each
 * bin is what a plain sum over a fine grid gives. */
#include <string.h>

#include "evidence/measure/bins.h"
#include "oracle/oracle.h"
#include "harness/test.h"

typedef struct view_case {
    const char *slope;
    float alpha_x, alpha_y;
    double theta, phi, bin_error; /* relative; larger where a sum misses a jump; 0: it misses all */
} view_case;

static const view_case CASES[] = {
    {"step(1-r)", 1, 1, 130, 25, 1e-2},
    {"r^-1.5*exp(-r)", 1, 1, 0, 0, 1e-4},
    {"(1+r*r)^-1.55", 1, 1, 80, 0, 1e-4},
    {"exp(-((r-1)/0.1)^2)", 0.05f, 0.4f, 89.9, 25, 1e-4},
    {"1e4*(1+1e4*r*r)^-2 + (1+r*r)^-2", 0.5f, 0.5f, 89.9, 0, 1e-4},
    {"step(1-r)", 1e-3f, 1, 130, 25, 1e-2},
    {"exp(-((r-1)/1e-4)^2)", 1, 1, 30, 0, 0},
};
enum { CASE_COUNT = sizeof CASES / sizeof *CASES };

/* The density at theta', phi' by these angles. */
static double density_at(const bin_map *map, const vndf_view *view, double theta, double phi)
{
    double x = map->stretch_x * sin(theta) * cos(map->centre + phi);
    double y = map->stretch_y * sin(theta) * sin(map->centre + phi);
    double length = sqrt(x * x + y * y + cos(theta) * cos(theta));
    vndf_vec3 wm = {(float)(x / length), (float)(y / length), (float)(cos(theta) / length)};
    double area = map->stretch_x * map->stretch_y / (length * length * length) * sin(theta);
    return (double)vndf_pdf(view, wm) * area;
}

/* A bin by the midpoints of SIDE times SIDE parts. */
static double sum_over(const bin_map *map, const vndf_view *view, size_t bin)
{
    enum { SIDE = 200 };
    const double *slope = map->slope + bin / BINS_PHI, *phi = map->phi + bin % BINS_PHI;
    double theta = atan(slope[0]), high = (atan(slope[1]) - theta) / SIDE, wide = (phi[1] - phi[0]) / SIDE,
           sum = 0;
    for (size_t i = 0; i < SIDE; i++)
        for (size_t j = 0; j < SIDE; j++)
            sum += density_at(map, view, theta + high * ((double)i + 0.5), phi[0] + wide * ((double)j + 0.5));
    return sum * high * wide;
}

/* Some bins of all rings but the innermost and the outermost, where the angles would have to be finer. */
static void test_view(const view_case *at)
{
    static double probability[BINS_COUNT];
    vndf_distribution *table = oracle_build(at->slope, 0, NULL, NULL);
    const vndf_surface surface = {table, at->alpha_x, at->alpha_y};
    const vndf_vec3 wi = oracle_direction(at->theta, at->phi);
    if (!TEST(table != NULL))
        return;
    const vndf_view view = vndf_view_from(&surface, wi);
    const bin_map map = bins_for(&surface, wi, 7);
    /* of the tail r^-3.1 two thousandths lie beyond slope 1e26, where a table ends */
    const double beyond = strcmp(at->slope, "(1+r*r)^-1.55") == 0 ? 3e-3 : 2e-6;
    double mass = 0, rounding = bins_integrate(&map, &surface, wi, probability);
    for (size_t i = 0; i < BINS_COUNT; i++)
        mass += probability[i];
    if (!(TEST_NEAR(mass, 1, beyond + rounding) & TEST(rounding < (at->bin_error > 0 ? 5e-6 : 2e-3))))
        fprintf(stderr, "  of %s: rounding %g\n", at->slope, rounding);
    for (size_t bin = BINS_PHI; at->bin_error > 0 && bin < BINS_COUNT - 2 * BINS_PHI;
         bin += test_amount(997, 331, 331)) {
        double sum = sum_over(&map, &view, bin);
        if (!TEST_NEAR(probability[bin], sum, 1e-9 + at->bin_error * sum))
            fprintf(stderr, "  of %s: bin %zu\n", at->slope, bin);
    }
    vndf_free(table);
}

/* Normals at the pole and at the horizon, and slopes so large that an angle would not tell them from it. */
static void test_ends(void)
{
    vndf_surface surface = {vndf_ggx(), 1, 1};
    bin_map map = bins_for(&surface, oracle_direction(30, 0), 7);
    TEST(bins_place(&map, (vndf_vec3){0, 0, 1}) / BINS_PHI == 0);
    TEST(bins_place(&map, (vndf_vec3){1, 0, 0}) / BINS_PHI == BINS_THETA - 1);
    map.slope[BINS_THETA - 1] = 1e20 / map.stretch_x;
    TEST(bins_place(&map, (vndf_vec3){1, 0, 2e-20f}) / BINS_PHI == BINS_THETA - 2);
    TEST(bins_place(&map, (vndf_vec3){1, 0, 0.5e-20f}) / BINS_PHI == BINS_THETA - 1);
}

int main(void)
{
    test_ends();
    for (size_t i = 0; i < test_amount(1, CASE_COUNT, CASE_COUNT); i += test_amount(1, 4, 1))
        test_view(&CASES[i]);
    return test_done();
}
