/* What the tests of the random walk share: distributions, materials and their hits, directions, and the comparison
 * of two estimated histograms. */
#ifndef TESTS_BSDF_WALK_WALK_CASE_H
#define TESTS_BSDF_WALK_WALK_CASE_H

#include <stdlib.h>

#include "oracle/oracle.h"
#include "evidence/measure/statistics.h"
#include "statistics/grid.h"
#include "harness/constants.h"
#include "harness/test.h"
#include "vndf_bsdf.h"

/* ---- distributions ---- */

/* The closed forms and all shipped tables; the first of them are as different as they come. */
enum { WALK_SUBJECTS = 17, WALK_FEW = 8 };

static inline const char *walk_subject_name(int i)
{
    /* clang-format off */
    static const char *const names[WALK_SUBJECTS] = {
        "ggx", "beckmann", "student-t-1.8", "hazy", "epd-0.6", "abc-two-layer-gold", "sgd-nickel-g",
        "student-t-2.5-small", "student-t-2.5", "student-t-2.5-large", "student-t-6", "gtr-1.5", "example",
        "sgd-alum-bronze-r", "sgd-blue-metallic-paint-b", "sgd-red-fabric-r", "sgd-specular-black-phenolic-g"};
    /* clang-format on */
    return names[i];
}

/* Freed at the end of the process: vndf_free of a closed form does nothing. */
static inline const vndf_distribution *walk_subject(int i)
{
    if (i < 2)
        return i ? vndf_beckmann() : vndf_ggx();
    const vndf_distribution *d = oracle_shipped(walk_subject_name(i));
    TEST(d != NULL);
    return d;
}

static inline void walk_subject_free(const vndf_distribution *d)
{
    vndf_free((vndf_distribution *)(size_t)d);
}

/* ---- directions ---- */

/* gcc 12 at -O3 leaves out a rounding to float and back when it joins x and y to a vector. */
static inline float walk_rounded(double x)
{
    volatile float rounded = (float)x;
    return rounded;
}

static inline vndf_vec3 walk_direction(double cosine, double phi)
{
    double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    vndf_vec3 w = {walk_rounded(sine * cos(phi)), walk_rounded(sine * sin(phi)), walk_rounded(cosine)};
    return w;
}

/* ---- optics ---- */

static inline double walk_dielectric_at(double c, double eta)
{
    double t2 = 1.0 - (1.0 - c * c) / (eta * eta), t = t2 > 0.0 ? sqrt(t2) : 0.0;
    double s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
    return t2 > 0.0 ? 0.5 * (s * s + p * p) : 1.0;
}

/* Lossless, of one wavelength. */
static inline vndf_description walk_of_mirror(void)
{
    vndf_description is = {.effects = {.scattering = VNDF_SCATTERING_MULTIPLE}, .wavelengths = 1, .eta = 1.5f};
    return is;
}

static inline vndf_description walk_of_metal(void)
{
    vndf_description is = walk_of_mirror();
    is.effects.fresnel = VNDF_FRESNEL_SCHLICK;
    is.f0[0] = 0.6f;
    return is;
}

static inline vndf_description walk_of_glass(float eta)
{
    vndf_description is = walk_of_mirror();
    is.eta = eta;
    is.effects.lobes = VNDF_LOBES_BOTH;
    is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    is.effects.transport = VNDF_TRANSPORT_IMPORTANCE;
    return is;
}

static inline int walk_transmits(const vndf_description *is)
{
    return is->effects.lobes != VNDF_LOBES_REFLECTION;
}

/* ---- hits ---- */

/* A hit, which must not move, and the view of single events there. */
typedef struct walk_hit {
    vndf_description is;
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_view view;
    vndf_vec3 wi;
} walk_hit;

static inline void walk_hit_at(walk_hit *h, const vndf_description *is, const vndf_distribution *d, float ax,
                               float ay, vndf_vec3 wi)
{
    vndf_surface surface = {d, ax, ay};
    h->is = *is;
    h->is.distribution = d;
    h->is.alpha_x = ax;
    h->is.alpha_y = ay;
    h->wi = wi;
    h->view = vndf_view_from(&surface, wi);
    TEST(vndf_material_resolve(&h->is, &h->material, NULL) == VNDF_OK && vndf_bsdf_at(&h->bsdf, &h->material, wi));
}

/* f |cos_o|. */
static inline double walk_eval(const walk_hit *h, vndf_vec3 wo, uint64_t seed)
{
    float f[VNDF_WAVELENGTHS];
    vndf_bsdf_eval(&h->bsdf, wo, seed, f);
    return (double)f[0] * fabs((double)wo.z);
}

static inline void walk_describe(const walk_hit *h, const char *name)
{
    fprintf(stderr, "  %s, alpha %g %g, cos %g, eta %g\n", name, (double)h->is.alpha_x, (double)h->is.alpha_y,
            (double)h->wi.z, walk_transmits(&h->is) ? (double)h->is.eta : 0.0);
}

static inline void walk_numbers(unsigned long long *state, float u[3])
{
    for (int i = 0; i < 3; i++)
        u[i] = test_uniform(state);
}

static inline size_t walk_count(size_t whole)
{
    return test_amount(whole / 5, whole / 4, whole);
}

/* ---- means and their errors ---- */

typedef struct walk_mean {
    double sum, squares, count, largest;
} walk_mean;

static inline void walk_add(walk_mean *m, double x)
{
    m->sum += x;
    m->squares += x * x;
    m->largest = x > m->largest ? x : m->largest;
}

static inline double walk_value(const walk_mean *m)
{
    return m->sum / m->count;
}

/* Variance of the value. */
static inline double walk_variance(const walk_mean *m)
{
    double mean = walk_value(m), variance = m->squares / m->count - mean * mean;
    return variance > 0.0 ? variance / m->count : 0.0;
}

/* Whether two means agree within `sigmas` of their errors and `slack`. */
static inline int walk_agree(const walk_mean *a, const walk_mean *b, double sigmas, double slack)
{
    double difference = fabs(walk_value(a) - walk_value(b));
    return difference <= sigmas * sqrt(walk_variance(a) + walk_variance(b)) + slack;
}

/* ---- bins of the sphere: equal areas ---- */

enum { WALK_HEIGHTS = 12, WALK_TURNS = 8, WALK_BINS = WALK_HEIGHTS * WALK_TURNS };

static inline void walk_bins(grid *g)
{
    grid_even(g, WALK_HEIGHTS, -1, 1, WALK_TURNS, -PI, PI);
}

static inline size_t walk_bin(vndf_vec3 w)
{
    static grid g;
    if (!g.rows)
        walk_bins(&g);
    return grid_bin(&g, (double)w.z, atan2((double)w.y, (double)w.x));
}

#endif
