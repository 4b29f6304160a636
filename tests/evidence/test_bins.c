/* The bins of the chi-square test hold the whole density: their sum is 1 within 4e-6 where a lobe has parts of
 * very different width, an unbounded peak, a tail that barely has an area, a ring, or a jump, up to grazing, and within
 * what it says it may err; in a ring of width 1e-4 floats hardly tell slopes apart. Each bin is what a plain sum over a
 * fine grid gives. */

#include "evidence/measure/measure.h"
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

/* A bin by the midpoints of parts that are even in atan(R) and in the azimuth; without mean slope. */
static double sum_over(const bins_sampler *of, const double slopes[BINS_RINGS + 1], size_t bin)
{
    enum { RINGS = 2000, SECTORS = 20 }; /* finer where there may be a jump */
    const bins_frame *f = &of->frame;
    const double *slope = slopes + bin / BINS_SECTORS, turn = atan2(f->y, f->x);
    const double from = atan(slope[0]), step = (atan(slope[1]) - from) / RINGS;
    double sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const double theta = from + step * (i + 0.5), r = tan(theta), level = -f->c / (f->s * r);
        const double reach = acos(fmin(fmax(level, -1), 1)), wide = 2 * reach / BINS_SECTORS / SECTORS;
        for (int j = 0; j < SECTORS; j++) {
            const double phi = turn - reach + wide * ((double)(bin % BINS_SECTORS) * SECTORS + j + 0.5);
            const double x = f->xx * r * cos(phi), y = f->yy * r * sin(phi), z = 1 / sqrt(1 + x * x + y * y);
            const vndf_vec3 wm = {(float)(x * z), (float)(y * z), (float)z};
            sum += (double)of->pdf(of->of, wm) * z * z * z * f->xx * f->yy * r * (1 + r * r) * wide * step;
        }
    }
    return sum;
}

/* Some bins of all rings but the innermost and the outermost, where the angles would have to be finer. */
static void test_view(const view_case *at)
{
    vndf_distribution *table = oracle_build(at->slope, 0, NULL, NULL);
    const vndf_surface surface = vndf_rough(table, at->alpha_x, at->alpha_y);
    const vndf_vec3 wi = oracle_direction(at->theta, at->phi);
    if (!TEST(table != NULL))
        return;
    const vndf_view view = vndf_view_from(&surface, wi);
    const bins_sampler of = bins_of_view(&view, &surface, wi);
    /* of the tail r^-3.1 two thousandths lie beyond slope 1e26, where a table ends */
    const int is_narrow = at->bin_error == 0, is_cut = strcmp(at->slope, "(1+r*r)^-1.55") == 0;
    const bins_result found = bins_chi_square(&of, 0, 7);
    if (!(TEST_NEAR(found.mass, 1, is_cut ? 3e-3 : fmin(found.error, is_narrow ? 1 : 4e-6)) &
          TEST(found.error < (is_narrow ? 2e-3 : 2e-5))))
        fprintf(stderr, "  of %s: error %g\n", at->slope, found.error);
    for (size_t bin = BINS_SECTORS; !is_narrow && bin < BINS_COUNT - 2 * BINS_SECTORS;
         bin += test_amount(331, 131, 131)) {
        double sum = sum_over(&of, found.slope, bin);
        if (!TEST_NEAR(found.sum[bin].value, sum, 2e-8 + at->bin_error * sum))
            fprintf(stderr, "  of %s: bin %zu\n", at->slope, bin);
    }
    vndf_free(table);
}

/* Normals at the pole and at the horizon, and slopes so large that an angle would not tell them from it. */
static void test_ends(void)
{
    const vndf_surface surface = vndf_rough(vndf_ggx(), 1, 1);
    const vndf_vec3 wi = oracle_direction(30, 0);
    const vndf_view view = vndf_view_from(&surface, wi);
    const bins_sampler of = bins_of_view(&view, &surface, wi);
    bins_result found = bins_chi_square(&of, 0, 7);
    double *slope = found.slope;
    const bins_frame *f = &of.frame;
    TEST(bins_bin(f, slope, (vndf_vec3){0, 0, 1}) / BINS_SECTORS == 0);
    TEST(bins_bin(f, slope, (vndf_vec3){1, 0, 0}) / BINS_SECTORS == BINS_RINGS - 1);
    slope[BINS_RINGS - 1] = 1e20 / f->xx;
    TEST(bins_bin(f, slope, (vndf_vec3){1, 0, 2e-20f}) / BINS_SECTORS == BINS_RINGS - 2);
    TEST(bins_bin(f, slope, (vndf_vec3){1, 0, 0.5e-20f}) / BINS_SECTORS == BINS_RINGS - 1);
    /* sectors ascend with the azimuth from wi, from horizon to horizon */
    TEST(bins_bin(f, slope, (vndf_vec3){0.6f, 0.01f, 0.8f}) % BINS_SECTORS == BINS_SECTORS / 2);
    TEST(bins_bin(f, slope, (vndf_vec3){0.6f, -0.01f, 0.8f}) % BINS_SECTORS == BINS_SECTORS / 2 - 1);
    TEST(bins_bin(f, slope, (vndf_vec3){-0.6f, 0.01f, 0.8f}) % BINS_SECTORS == BINS_SECTORS - 1);
    TEST(bins_bin(f, slope, (vndf_vec3){-0.6f, -0.01f, 0.8f}) % BINS_SECTORS == 0);
}

int main(void)
{
    test_ends();
    for (size_t i = 0; i < test_amount(1, CASE_COUNT, CASE_COUNT); i += test_amount(1, 4, 1))
        test_view(&CASES[i]);
    return test_done();
}
