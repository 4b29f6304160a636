/* What the tests of the random walk share: distributions, materials and their hits, and the comparison of two
 * estimated histograms. */
#ifndef TESTS_BSDF_WALK_WALK_CASE_H
#define TESTS_BSDF_WALK_WALK_CASE_H

#include "bsdf/bsdf_case.h"
#include "statistics/grid.h"

/* The closed forms and shipped tables; the first of them are as different as they come. */
enum { WALK_SUBJECTS = 12, WALK_FEW = 8 };
static const char *const walk_subjects[WALK_SUBJECTS] = {"ggx",
                                                         "beckmann",
                                                         "student-t-1.8",
                                                         "hazy",
                                                         "epd-0.6",
                                                         "abc-two-layer-gold",
                                                         "sgd-nickel-g",
                                                         "student-t-2.5-small",
                                                         "student-t-6",
                                                         "gtr-1.5",
                                                         "sgd-alum-bronze-r",
                                                         "sgd-red-fabric-r"};

/* ---- optics: of one wavelength ---- */

/* Lossless. */
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

/* A hit, which must not move, and the same by single scattering alone. */
typedef struct walk_hit {
    const char *name;
    vndf_description is;
    vndf_material material, once;
    vndf_bsdf bsdf, single;
    vndf_vec3 wi;
} walk_hit;

/* Roughness is over the distribution's scale if `scaled`. */
static inline void walk_hit_at(walk_hit *h, const vndf_description *is, const oracle_ndf *ndf,
                               const float alpha[2], int scaled, vndf_vec3 wi)
{
    float per = scaled ? 1 / (float)vndf_distribution_info(ndf->distribution).scale : 1;
    vndf_description once = *is;
    h->name = ndf->name;
    once.distribution = ndf->distribution;
    once.alpha_x = alpha[0] * per;
    once.alpha_y = alpha[1] * per;
    h->is = once;
    h->wi = wi;
    once.effects.scattering = VNDF_SCATTERING_SINGLE;
    TEST(vndf_material_resolve(&h->is, &h->material, NULL) == VNDF_OK && vndf_bsdf_at(&h->bsdf, &h->material, wi));
    TEST(vndf_material_resolve(&once, &h->once, NULL) == VNDF_OK && vndf_bsdf_at(&h->single, &h->once, wi));
}

/* f |cos_o|. */
static inline double walk_eval(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed)
{
    float f;
    vndf_bsdf_eval(bsdf, wo, seed, &f);
    return (double)f * fabs((double)wo.z);
}

static inline void walk_describe(const walk_hit *h)
{
    fprintf(stderr, "  %s, alpha %g %g, cos %g, eta %g\n", h->name, (double)h->is.alpha_x, (double)h->is.alpha_y,
            (double)h->wi.z, walk_transmits(&h->is) ? (double)h->is.eta : 0.0);
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

/* Whether two means agree within 5 sigmas, 6e-7. */
static inline int walk_agree(const walk_mean *a, const walk_mean *b)
{
    return fabs(walk_value(a) - walk_value(b)) <= 5 * sqrt(walk_variance(a) + walk_variance(b));
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

/* Draws `count` samples into the bins of a grid; what is lost is elsewhere. */
static inline void walk_observe(const walk_hit *h, size_t count, unsigned long long state, grid *g)
{
    for (size_t k = 0; k < count; k++) {
        float u[3];
        vndf_scattered w;
        bsdf_numbers(&state, u);
        vndf_bsdf_sample(&h->bsdf, u, &w);
        g->observed[w.lobe == VNDF_LOBE_NONE ? grid_elsewhere(g) : walk_bin(w.wo)] += 1.0;
    }
}

#endif
