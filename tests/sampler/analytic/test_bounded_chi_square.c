/* Bounded visible normals, and the directions that they reflect wi to, follow the density that vndf_pdf_bounded
 * claims: chi-square over 24 x 32 bins of each at 4e5 samples, level 0.01 for all together (Sidak).
 *
 * Normals are binned in the disc of slopes that bounds them, in polar coordinates about the pole with the radius
 * over that of the border; directions wo by height and azimuth, their density vndf_pdf_bounded/(4 wi.wm). */
#include "oracle/oracle.h"
#include "sampler/bounded/bounded.h"
#include "measure/statistics.h"
#include "harness/constants.h"
#include "harness/test.h"
#include "statistics/grid.h"

enum { RINGS = 24, SECTORS = 32 };

typedef struct subject {
    vndf_view view;
    vndf_bounds bounds;
    int reflected; /* directions, not normals */
} subject;

static double dot(vndf_vec3 a, vndf_normal b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double border_at(const subject *g, double cosine, double sine)
{
    double b = (g->view.wi.x * cosine + g->view.wi.y * sine) / g->view.wi.z;
    return b + sqrt(b * b + 1);
}

/* A part of 1 and an azimuth. */
static size_t place_of(const subject *g, const grid *bins, vndf_vec3 wm)
{
    vndf_normal n = vndf_normal_of(wm);
    double twice = 2 * dot(g->view.wi, n), x = n.x, y = n.y, part;
    if (g->reflected) {
        x = twice * x - g->view.wi.x;
        y = twice * y - g->view.wi.y;
        part = twice * n.z - g->view.wi.z;
    } else {
        double across = hypot(x, y);
        part = across > 0 ? across / n.z / border_at(g, x / across, y / across) : 0;
    }
    return grid_bin(bins, part, atan2(y, x));
}

/* dwm = r dr da/(1 + r^2)^(3/2) for slopes, dwo = dz da. */
static double density_at(double part, double azimuth, const void *of)
{
    const subject *g = of;
    double c = cos(azimuth), s = sin(azimuth);
    if (!g->reflected) {
        double border = border_at(g, c, s), r = part * border, per = 1 / sqrt(1 + r * r);
        vndf_normal wm = {r * c * per, r * s * per, per};
        return vndf_pdf_bounded(&g->view, &g->bounds, wm) * r * border * (per * per * per);
    }
    double level = sqrt(1 - part * part);
    vndf_normal h = {g->view.wi.x + level * c, g->view.wi.y + level * s, g->view.wi.z + part};
    double length = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    vndf_normal wm = {h.x / length, h.y / length, h.z / length};
    return vndf_pdf_bounded(&g->view, &g->bounds, wm) / (4 * dot(g->view.wi, wm));
}

typedef struct setting {
    float alpha_x, alpha_y;
    double cosine;
} setting;

static const setting SETTINGS[] = {
    {0.5f, 0.5f, 0.999}, {1, 1, 0.5}, {1, 1, 0.0872}, {0.8f, 0.2f, 0.3}, {2, 0.5f, 0.3}};
enum { SETTING_COUNT = 5, SUBJECT_COUNT = 4 };

static void test_setting(const char *name, const vndf_distribution *d, setting is, unsigned long long seed)
{
    static grid bins[2];
    const size_t samples = test_quick() ? 100000 : 400000;
    vndf_surface surface = {d, is.alpha_x, is.alpha_y};
    double sine = sqrt(1 - is.cosine * is.cosine), mass[2];
    double level = statistics_sidak(0.01, 2 * SETTING_COUNT * SUBJECT_COUNT);
    vndf_vec3 wi = {(float)(0.6 * sine), (float)(0.8 * sine), (float)is.cosine};
    subject g = {.view = vndf_view_from(&surface, wi)};
    vndf_bounds_of(&g.view, &g.bounds);
    for (g.reflected = 0; g.reflected < 2; g.reflected++) {
        grid_even(&bins[g.reflected], RINGS, 0, 1, SECTORS, -PI, PI);
        mass[g.reflected] = grid_expect(&bins[g.reflected], density_at, &g, (double)samples, 1e-7);
    }
    for (size_t i = 0; i < samples; i++) {
        float u1 = test_uniform(&seed), u2 = test_uniform(&seed);
        vndf_vec3 wm = vndf_sample_bounded(&g.view, &g.bounds, u1, u2).wm;
        for (g.reflected = 0; g.reflected < 2; g.reflected++)
            bins[g.reflected].observed[place_of(&g, &bins[g.reflected], wm)] += 1;
    }
    for (int i = 0; i < 2; i++) {
        double p = grid_test(&bins[i]).p;
        if (!(TEST(p > level) & TEST_NEAR(mass[i], 1, 3e-4)))
            fprintf(stderr, "  %s, alpha %g %g, cos %g, %s: p %g\n", name, is.alpha_x, is.alpha_y, is.cosine,
                    i ? "directions" : "normals", p);
    }
}

static void test_subject(const char *name, const vndf_distribution *d, unsigned long long seed)
{
    for (int i = 0; i < SETTING_COUNT; i++)
        test_setting(name, d, SETTINGS[i], seed + (unsigned long long)i);
}

int main(int arguments, char **argument)
{
    const char *paths[] = {VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", VNDF_SOURCE_DIR "/tables/hazy.vndf"};
    vndf_error error;
    if (oracle_wanted(arguments, argument, 0, "ggx"))
        test_subject("ggx", vndf_ggx(), 1001);
    if (oracle_wanted(arguments, argument, 1, "beckmann"))
        test_subject("beckmann", vndf_beckmann(), 2001);
    for (size_t i = 0; i < 2; i++) {
        if (!oracle_wanted(arguments, argument, i + 2, paths[i]))
            continue;
        vndf_distribution *table = vndf_load(paths[i], &error);
        if (TEST(table != NULL))
            test_subject(paths[i], table, 3001 + 1000 * i);
        vndf_free(table);
    }
    return test_done();
}
