/* What the tests of the sampler ask: a surface or a mixture from one direction, by its calls. */
#ifndef TESTS_SAMPLER_SEEN_H
#define TESTS_SAMPLER_SEEN_H

#include "evidence/measure/measure.h"
#include "harness/test.h"
#include "oracle/oracle.h"
#include "vndf.h"

#if defined(__SSE2__)
#  include <xmmintrin.h>
#endif

typedef enum seen_kind { SEEN_SURFACE, SEEN_MIXTURE } seen_kind;

typedef struct seen {
    seen_kind kind;
    vndf_mixture of; /* of a surface one lobe */
    vndf_vec3 wi;
    vndf_view view;
    vndf_mixture_view mixture;
} seen;

static inline seen seen_from(seen_kind kind, const vndf_mixture *of, vndf_vec3 wi)
{
    seen s = {.kind = kind, .of = *of, .wi = wi};
    if (kind == SEEN_SURFACE)
        s.view = vndf_view_from(&of->lobe[0].surface, wi);
    else
        s.mixture = vndf_mixture_view_from(&s.of, wi);
    return s;
}

static inline seen seen_surface(vndf_surface surface, vndf_vec3 wi)
{
    const vndf_mixture one = {1, {{surface, 1}}};
    return seen_from(SEEN_SURFACE, &one, wi);
}

static inline vndf_vec3 seen_draw(const void *of, float u1, float u2, float *pdf)
{
    const seen *s = of;
    return s->kind == SEEN_MIXTURE ? vndf_mixture_sample(&s->mixture, u1, u2, pdf, NULL)
                                   : vndf_sample(&s->view, u1, u2, pdf);
}

static inline float seen_pdf(const void *of, vndf_vec3 wm)
{
    const seen *s = of;
    return s->kind == SEEN_MIXTURE ? vndf_mixture_pdf(&s->mixture, wm) : vndf_pdf(&s->view, wm);
}

typedef enum quantity { DENSITY, VISIBLE, NDF, AREA, LAMBDA, G1, QUANTITIES } quantity;
static const char *const quantity_names[QUANTITIES] = {"pdf", "visible", "ndf", "area", "lambda", "g1"};

/* The first three at w, the others from w. */
static inline float seen_quantity(const seen *s, quantity which, vndf_vec3 w)
{
    const vndf_surface *one = s->kind == SEEN_SURFACE ? &s->of.lobe[0].surface : NULL;
    switch (which) {
    case DENSITY: return seen_pdf(s, w);
    case VISIBLE: return one ? vndf_visible(&s->view, w) : vndf_mixture_visible(&s->mixture, w);
    case NDF: return one ? vndf_ndf(one, w) : vndf_mixture_ndf(&s->of, w);
    case LAMBDA: return one ? vndf_lambda(one, w) : vndf_mixture_lambda(&s->of, w);
    case G1: return one ? vndf_g1(one, w) : vndf_mixture_g1(&s->of, w);
    default: return one ? vndf_projected_area(one, w) : vndf_mixture_projected_area(&s->of, w);
    }
}

/* Whether more than this part is seen of what is seen at grazing incidence. */
static inline int seen_at_all(const seen *s, float part)
{
    const vndf_vec3 level = {s->wi.x, s->wi.y, 0};
    return s->wi.z >= 0 || seen_quantity(s, AREA, s->wi) > part * seen_quantity(s, AREA, level);
}

static inline vndf_vec3 vec3_of(const double w[3])
{
    return (vndf_vec3){(float)w[0], (float)w[1], (float)w[2]};
}

static inline void seen_print(const seen *s, const char *name)
{
    fprintf(stderr, "  %s: wi %.9g %.9g %.9g\n", name, (double)s->wi.x, (double)s->wi.y, (double)s->wi.z);
    for (int i = 0; i < s->of.count && i < VNDF_MIXTURE_LOBES; i++) {
        const vndf_surface *a = &s->of.lobe[i].surface;
        fprintf(stderr, "    (%.9g %.9g; %.9g %.9g) mean %.9g %.9g weight %.9g\n", (double)a->xx, (double)a->xy,
                (double)a->yx, (double)a->yy, (double)a->mean_x, (double)a->mean_y, (double)s->of.lobe[i].weight);
    }
}

/* Whether denormals are flushed to zero, and read as zero, from now on; returns 0 where no way is known. */
static inline int set_flushing(int flushing)
{
#if defined(__SSE2__)
    _mm_setcsr((_mm_getcsr() & ~0x8040u) | (flushing ? 0x8040u : 0));
    return 1;
#else
    return flushing & 0;
#endif
}

/* ---- subjects ---- */

/* GGX, Beckmann, and tables of the shapes of oracle.h, built here. */
enum { SUBJECT_COUNT = 2 + ORACLE_COUNT };

typedef struct subject {
    const char *name;
    const vndf_distribution *d;
    vndf_distribution *owned;
    oracle shape; /* its D as a formula */
} subject;

/* Runs a test of all subjects, or of the one that the program's first argument names; what main returns. */
static inline int subjects_test(int arguments, char **argument, void (*test)(const subject *of, size_t index))
{
    for (size_t i = 0; i < SUBJECT_COUNT; i++) {
        subject s = {i ? "closed beckmann" : "closed ggx", i ? vndf_beckmann() : vndf_ggx(), NULL,
                     oracle_get(i < 2 ? i : i - 2)};
        s.name = i < 2 ? s.name : s.shape.name;
        if (!oracle_wanted(arguments, argument, i, s.name))
            continue;
        if (i >= 2)
            s.d = s.owned = oracle_build(s.shape.name, 0, NULL, NULL);
        if (TEST(s.d != NULL))
            test(&s, i);
        vndf_free(s.owned);
    }
    return test_done();
}

static inline double random_between(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

/* 10 to a power that is uniform. */
static inline double random_decade(unsigned long long *state, double from, double to)
{
    return pow(10, random_between(state, from, to));
}

static inline vndf_vec3 random_direction(unsigned long long *state, double least_z)
{
    double z = random_between(state, least_z, 1), phi = random_between(state, -PI, PI), s = sqrt(1 - z * z);
    vndf_vec3 w = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)z};
    return w;
}

static inline double dot_of(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
}

static inline double length_of(vndf_vec3 w)
{
    return sqrt(dot_of(w, w));
}

#endif
