/* Bounded visible normals, and the directions that they reflect wi to, follow the density that vndf_pdf_bounded
 * claims: chi-square over 24 x 32 bins of each at 4e5 samples, level 0.01 for all together (Sidak).
 *
 * Normals are binned in the disc of slopes that bounds them, in polar coordinates about the pole with the radius
 * over that of the border; directions wo by height and azimuth, their density vndf_pdf_bounded/(4 wi.wm).
 * Expected counts are from 8 x 8 points of Gauss to a bin, 32 x 32 where the density of GGX or Beckmann has an
 * edge. */
#include "oracle/oracle.h"
#include "sampler/bounded/bounded.h"
#include "measure/statistics.h"
#include "harness/test.h"

enum { RINGS = 24, SECTORS = 32, BINS = RINGS * SECTORS };
static const double PI = 3.14159265358979323846;
static const double NODE[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263};
static const double WEIGHT[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                 0.17392742256872693};

typedef struct subject {
    vndf_view view;
    vndf_bounds bounds;
} subject;

/* A place in a map of bins, both in [0, 1), and the density there per unit of the map. */
typedef struct map {
    int reflected;
    double x, y;
} map;

static double dot(vndf_vec3 a, vndf_normal b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double border_at(const subject *g, double cosine, double sine)
{
    double b = (g->view.wi.x * cosine + g->view.wi.y * sine) / g->view.wi.z;
    return b + sqrt(b * b + 1);
}

static map place_of(const subject *g, vndf_vec3 wm, int reflected)
{
    vndf_normal n = vndf_normal_of(wm);
    double twice = 2 * dot(g->view.wi, n), x = n.x, y = n.y, part;
    if (reflected) {
        x = twice * x - g->view.wi.x;
        y = twice * y - g->view.wi.y;
        part = twice * n.z - g->view.wi.z;
    } else {
        double across = hypot(x, y);
        part = across > 0 ? across / n.z / border_at(g, x / across, y / across) : 0;
    }
    map at = {reflected, part, 0.5 + atan2(y, x) / (2 * PI)};
    return at;
}

/* dwm = r dr da/(1 + r^2)^(3/2) for slopes, dwo = dz da. */
static double density_at(const subject *g, map at)
{
    double azimuth = 2 * PI * (at.y - 0.5), c = cos(azimuth), s = sin(azimuth);
    if (!at.reflected) {
        double border = border_at(g, c, s), r = at.x * border, per = 1 / sqrt(1 + r * r);
        vndf_normal wm = {r * c * per, r * s * per, per};
        return vndf_pdf_bounded(&g->view, &g->bounds, wm) * r * border * (2 * PI) * (per * per * per);
    }
    double level = sqrt(1 - at.x * at.x);
    vndf_normal h = {g->view.wi.x + level * c, g->view.wi.y + level * s, g->view.wi.z + at.x};
    double length = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    vndf_normal wm = {h.x / length, h.y / length, h.z / length};
    return vndf_pdf_bounded(&g->view, &g->bounds, wm) / (4 * dot(g->view.wi, wm)) * (2 * PI);
}

static double expected_in(const subject *g, int reflected, int bin, int parts)
{
    double sum = 0, ring = bin / SECTORS, sector = bin % SECTORS;
    for (int i = 0; i < 16 * parts * parts; i++) {
        int a = i % (4 * parts), b = i / (4 * parts);
        map at = {reflected, (ring + (a / 4 + NODE[a % 4]) / parts) / RINGS,
                  (sector + (b / 4 + NODE[b % 4]) / parts) / SECTORS};
        sum += WEIGHT[a % 4] * WEIGHT[b % 4] * density_at(g, at);
    }
    return sum / (parts * parts * BINS);
}

/* Bins that expect less than 5 are pooled. */
static double chance(const subject *g, int reflected, const long *counts, long samples, double *mass)
{
    double statistic = 0, pooled = 0, got = 0;
    size_t classes = 0;
    *mass = 0;
    for (int i = 0; i < BINS; i++) {
        double coarse = expected_in(g, reflected, i, 2), fine = expected_in(g, reflected, i, 4);
        double rough = fabs(fine - coarse) * (double)samples, expected = fine;
        if (rough > 0.02 * sqrt(fine * (double)samples))
            expected = expected_in(g, reflected, i, 16);
        *mass += expected;
        expected *= (double)samples;
        if (expected < 5) {
            pooled += expected;
            got += (double)counts[i];
            continue;
        }
        statistic += ((double)counts[i] - expected) * ((double)counts[i] - expected) / expected;
        classes++;
    }
    if (pooled > 5) {
        statistic += (got - pooled) * (got - pooled) / pooled;
        classes++;
    }
    return statistics_chi_square_p(statistic, classes - 1);
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
    long samples = oracle_quick() ? 100000 : 400000;
    static long counts[2][BINS];
    vndf_surface surface = {d, is.alpha_x, is.alpha_y};
    double sine = sqrt(1 - is.cosine * is.cosine);
    double level = statistics_sidak(0.01, 2 * SETTING_COUNT * SUBJECT_COUNT);
    vndf_vec3 wi = {(float)(0.6 * sine), (float)(0.8 * sine), (float)is.cosine};
    subject g = {.view = vndf_view_from(&surface, wi)};
    vndf_bounds_of(&g.view, &g.bounds);
    memset(counts, 0, sizeof counts);
    for (long i = 0; i < samples; i++) {
        float u1 = test_uniform(&seed), u2 = test_uniform(&seed);
        vndf_vec3 wm = vndf_sample_bounded(&g.view, &g.bounds, u1, u2).wm;
        for (int reflected = 0; reflected < 2; reflected++) {
            map at = place_of(&g, wm, reflected);
            int ring = (int)(at.x * RINGS), sector = (int)(at.y * SECTORS);
            counts[reflected][(ring < RINGS ? ring : RINGS - 1) * SECTORS + sector % SECTORS]++;
        }
    }
    for (int reflected = 0; reflected < 2; reflected++) {
        double mass, p = chance(&g, reflected, counts[reflected], samples, &mass);
        if (!(TEST(p > level) & TEST_NEAR(mass, 1, 3e-4)))
            fprintf(stderr, "  %s, alpha %g %g, cos %g, %s: p %g\n", name, is.alpha_x, is.alpha_y, is.cosine,
                    reflected ? "directions" : "normals", p);
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
