/* Samples of affine surfaces and of mixtures follow the density that is claimed for them at 64 Mi samples and more, and
 * it integrates to 1 within 1e-5: chi-square over 128 x 64 bins of slopes for sheared, mirrored and off-centre surfaces
 * of condition up to 200, and for mixtures of lobes 100 times apart in roughness, above the horizon and the mean plane
 * and below. One run is of one distribution:
 *
 *     test_long_affine_chi_square FILE.vndf|ggx|beckmann SAMPLES SUBJECTS
 *
 * The level of 0.01 is for all SUBJECTS together. Samples are drawn by batches, which give the bits of single calls. */
#include <stdlib.h>

#include "harness/constants.h"
#include "harness/test.h"
#include "measure/statistics.h"
#include "oracle/oracle_validate.h"
#include "statistics/grid.h"
#include "vndf.h"

enum { RINGS = 64, SECTORS = 128, BATCH = 4096 };

/* Lobes, of the matrix xx xy yx yy, the mean slope and the weight; and bins: by the azimuth and the length R = scale
 * (p/(1 - p))^power of the slopes that the first lobe's matrix and mean slope take to slopes of the surface. */
typedef struct setting {
    int lobes;
    float lobe[2][7];
    double theta, phi, scale, power; /* degrees */
} setting;

static const setting SETTINGS[] = {
    {1, {{0.5f, 0.3f, -0.1f, 0.2f, 0.4f, -0.15f, 1}}, 30, 20, 1, 1},
    {1, {{0.5f, 0.3f, -0.1f, 0.2f, 0.4f, -0.15f, 1}}, 88, 200, 1, 1},
    {1, {{0.5f, 0.3f, 0.1f, -0.2f, 0.4f, -0.15f, 1}}, 130, 110, 1, 1},
    {1, {{0.1f, 0.099f, 0.1f, 0.101f, 0.3f, 0, 1}}, 70, 300, 1, 1},
    {1, {{0.4f, 0, 0, 0.4f, 1, 0, 1}}, 60, 10, 1, 1}, /* below the mean plane */
    {2, {{0.005f, 0, 0.001f, 0.004f, 0.1f, 0.05f, 1}, {0.5f, 0.1f, 0, 0.4f, 0.1f, 0.05f, 1}}, 20, 0, 10, 3},
    {2, {{0.005f, 0, 0, 0.005f, 0, 0, 1}, {0.5f, 0, 0, 0.5f, 0, 0, 1}}, 85, 50, 10, 3},
    {2, {{0.005f, 0.002f, 0, 0.005f, 0.2f, -0.1f, 3}, {0.5f, 0, 0.2f, -0.5f, -0.1f, 0.2f, 1}}, 50, 130, 10, 3}};
enum { SETTING_COUNT = sizeof SETTINGS / sizeof *SETTINGS };

typedef struct subject {
    const setting *is;
    vndf_mixture surface;
    vndf_mixture_view view;
} subject;

static vndf_mixture surface_of(const vndf_distribution *d, const setting *is)
{
    vndf_mixture m = {.count = is->lobes};
    for (int l = 0; l < is->lobes; l++) {
        const float *of = is->lobe[l];
        vndf_mixture_lobe lobe = {{d, of[0], of[1], of[2], of[3], of[4], of[5]}, of[6]};
        m.lobe[l] = lobe;
    }
    return m;
}

static size_t bin_of(const setting *is, const grid *bins, double wx, double wy, double wz)
{
    const float *m = is->lobe[0];
    double det = (double)m[0] * m[3] - (double)m[1] * m[2], x = -wx / wz - m[4], y = -wy / wz - m[5];
    double u = (m[3] * x - m[1] * y) / det, v = (m[0] * y - m[2] * x) / det;
    double root = pow(hypot(u, v) / is->scale, 1 / is->power);
    return grid_bin(bins, wz > 0 ? root / (1 + root) : 1, atan2(v, u));
}

/* dwm = wm.z^3 ds, ds = |det M| R dR da. */
static double density_at(double part, double azimuth, const void *given)
{
    const subject *of = given;
    const setting *is = of->is;
    const float *m = is->lobe[0];
    double rest = 1 - part, r = is->scale * pow(part / rest, is->power), u = r * cos(azimuth),
           v = r * sin(azimuth);
    double x = m[0] * u + m[1] * v + m[4], y = m[2] * u + m[3] * v + m[5], z = 1 / sqrt(1 + x * x + y * y);
    double det = fabs((double)m[0] * m[3] - (double)m[1] * m[2]);
    vndf_vec3 wm = {(float)(-x * z), (float)(-y * z), (float)z};
    return (double)vndf_mixture_pdf(&of->view, wm) * z * z * z * det * r * (r * is->power / (part * rest));
}

/* Samples of one view, by batches in which all is shared. */
static void draw(const subject *of, vndf_vec3 wi, size_t samples, unsigned long long seed, grid *bins)
{
    static float u1[BATCH], u2[BATCH], x[BATCH], y[BATCH], z[BATCH], pdf[BATCH];
    vndf_mixture_batch b = {.shared = VNDF_SHARED_ALPHA | VNDF_SHARED_WI | VNDF_SHARED_WEIGHT,
                            .wi_x = &wi.x,
                            .wi_y = &wi.y,
                            .wi_z = &wi.z,
                            .lobes = of->surface.count};
    for (int l = 0; l < b.lobes; l++) {
        const vndf_affine *m = &of->surface.lobe[l].surface;
        vndf_lobe_batch lobe = {m->distribution, &m->xx,     &m->xy,     &m->yx,
                                &m->yy,          &m->mean_x, &m->mean_y, &of->surface.lobe[l].weight};
        b.lobe[l] = lobe;
    }
    for (size_t done = 0; done < samples; done += b.count) {
        b.count = samples - done < BATCH ? samples - done : BATCH;
        for (size_t i = 0; i < b.count; i++) {
            u1[i] = test_uniform(&seed);
            u2[i] = test_uniform(&seed);
        }
        vndf_mixture_sample_n(&b, u1, u2, (vndf_normals){x, y, z}, pdf, NULL);
        for (size_t i = 0; i < b.count; i++)
            bins->observed[bin_of(of->is, bins, (double)x[i], (double)y[i], (double)z[i])] += 1;
    }
}

static void test_setting(const vndf_distribution *d, const setting *is, size_t samples, unsigned long long seed,
                         double level)
{
    static grid bins;
    vndf_vec3 wi = oracle_direction(is->theta, is->phi);
    subject of = {.is = is, .surface = surface_of(d, is)};
    of.view = vndf_mixture_view_from(&of.surface, wi);
    grid_even(&bins, RINGS, 0, 1, SECTORS, -PI, PI);
    double mass = grid_expect(&bins, density_at, &of, (double)samples, 1e-9);
    draw(&of, wi, samples, seed, &bins);
    double p = grid_test(&bins).p;
    int good = TEST(p > level) & TEST(fabs(mass - 1) < 1e-5);
    fprintf(stderr, "%s %d lobes, theta %g, phi %g: p %.3g, mass - 1 %.2e\n", good ? " " : "!", is->lobes,
            is->theta, is->phi, p, mass - 1);
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: test_long_affine_chi_square FILE.vndf|ggx|beckmann SAMPLES SUBJECTS\n");
        return 2;
    }
    int ggx = strcmp(argv[1], "ggx") == 0, closed = ggx || strcmp(argv[1], "beckmann") == 0;
    vndf_distribution *table = closed ? NULL : vndf_load(argv[1], NULL);
    const vndf_distribution *d = closed ? ggx ? vndf_ggx() : vndf_beckmann() : table;
    double level = statistics_sidak(0.01, strtoul(argv[3], NULL, 10) * SETTING_COUNT);
    for (size_t i = 0; TEST(d != NULL) && i < SETTING_COUNT; i++)
        test_setting(d, &SETTINGS[i], strtoul(argv[2], NULL, 10), 4000 + i, level);
    vndf_free(table);
    return test_done();
}
