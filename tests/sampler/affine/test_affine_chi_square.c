/* Samples of affine surfaces follow the density that vndf_affine_pdf claims, which is normalised: chi-square over 24
 * x 32 bins of slopes at 4e5 samples for sheared, turned, mirrored and off-centre surfaces, level 0.01 for all
 * together (Sidak). Slopes are binned where M takes them from: by R/(1 + R) and azimuth. */
#include "harness/constants.h"
#include "harness/test.h"
#include "measure/statistics.h"
#include "oracle/oracle.h"
#include "statistics/grid.h"
#include "vndf.h"

enum { RINGS = 24, SECTORS = 32 };

typedef struct setting {
    float matrix[4], mean[2]; /* xx xy yx yy */
    double theta, phi;        /* degrees */
} setting;

static const setting SETTINGS[] = {{{0.5f, 0.3f, -0.1f, 0.2f}, {0.4f, -0.15f}, 30, 20},
                                   {{0.5f, 0.3f, -0.1f, 0.2f}, {0.4f, -0.15f}, 80, 200},
                                   {{0.5f, 0.3f, -0.1f, 0.2f}, {0.4f, -0.15f}, 130, 110},
                                   {{0, 0.3f, 0.3f, 0}, {0, 0}, 60, 45},
                                   {{0.1f, 0.099f, 0.1f, 0.101f}, {0, 0}, 70, 300},
                                   {{1, 0.5f, 0.5f, -1}, {-2, 1}, 55, 0},
                                   {{0.05f, 0, 0, 0.05f}, {1, 0}, 60, 10} /* below the mean plane, far off */};
enum { SETTING_COUNT = sizeof SETTINGS / sizeof *SETTINGS, SUBJECT_COUNT = 3 };

typedef struct subject {
    vndf_affine surface;
    vndf_affine_view view;
} subject;

static size_t bin_of(const subject *of, const grid *bins, vndf_vec3 wm)
{
    const vndf_affine *m = &of->surface;
    double det = (double)m->xx * m->yy - (double)m->xy * m->yx;
    double x = -(double)wm.x / wm.z - m->mean_x, y = -(double)wm.y / wm.z - m->mean_y;
    double u = (m->yy * x - m->xy * y) / det, v = (m->xx * y - m->yx * x) / det, r = hypot(u, v);
    return grid_bin(bins, wm.z > 0 ? r / (1 + r) : 1, atan2(v, u));
}

/* dwm = wm.z^3 ds, ds = |det M| R dR da. */
static double density_at(double part, double azimuth, const void *given)
{
    const subject *of = given;
    const vndf_affine *m = &of->surface;
    double rest = 1 - part, r = part / rest, u = r * cos(azimuth), v = r * sin(azimuth);
    double x = m->xx * u + m->xy * v + m->mean_x, y = m->yx * u + m->yy * v + m->mean_y,
           z = 1 / sqrt(1 + x * x + y * y);
    double det = fabs((double)m->xx * m->yy - (double)m->xy * m->yx);
    vndf_vec3 wm = {(float)(-x * z), (float)(-y * z), (float)z};
    return (double)vndf_affine_pdf(&of->view, wm) * z * z * z * det * r / (rest * rest);
}

static void test_setting(const char *name, const vndf_distribution *d, const setting *is, unsigned long long seed)
{
    static grid bins;
    const size_t samples = test_quick() ? 100000 : 400000;
    double sine = sin(is->theta * PI / 180), phi = is->phi * PI / 180;
    vndf_vec3 wi = {(float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)cos(is->theta * PI / 180)};
    const float *m = is->matrix;
    subject of = {.surface = {d, m[0], m[1], m[2], m[3], is->mean[0], is->mean[1]}};
    of.view = vndf_affine_view_from(&of.surface, wi);
    grid_even(&bins, RINGS, 0, 1, SECTORS, -PI, PI);
    double mass = grid_expect(&bins, density_at, &of, (double)samples, 1e-6);
    for (size_t i = 0; i < samples; i++) {
        float u1 = test_uniform(&seed), u2 = test_uniform(&seed);
        bins.observed[bin_of(&of, &bins, vndf_affine_sample(&of.view, u1, u2, NULL))] += 1;
    }
    double p = grid_test(&bins).p;
    if (!(TEST(p > statistics_sidak(0.01, SETTING_COUNT * SUBJECT_COUNT)) & TEST_NEAR(mass, 1, 1e-3)))
        fprintf(stderr, "  %s, theta %g, phi %g: p %g, mass %g\n", name, is->theta, is->phi, p, mass);
}

static void test_subject(const char *name, const vndf_distribution *d, unsigned long long seed)
{
    for (int i = 0; i < SETTING_COUNT; i++)
        test_setting(name, d, &SETTINGS[i], seed + (unsigned long long)i);
}

int main(int arguments, char **argument)
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    if (oracle_wanted(arguments, argument, 0, "ggx"))
        test_subject("ggx", vndf_ggx(), 1001);
    if (oracle_wanted(arguments, argument, 1, "beckmann"))
        test_subject("beckmann", vndf_beckmann(), 2001);
    if (TEST(table != NULL) && oracle_wanted(arguments, argument, 2, "table"))
        test_subject("table", table, 3001);
    vndf_free(table);
    return test_done();
}
