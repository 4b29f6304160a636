/* A source made fit for integration: P22 at canonical scale, cut into panels on which it is resolved.
 *
 * The canonical distribution P(R) = normalization scale^2 p22(scale R) has 2 pi integral P R dR = 1 and median R = 1.
 * Panels are even in log R and at most an octave wide. A panel is halved until ten Gauss points agree with twice ten to
 * 1e-10 of the panel, or as far as rounding lets them; after forty halvings it holds a jump or a pole. proof.c looks
 * between the points; where it finds more, panels are made anew with edges there. All integrals below are sums over
 * panels, with relative precision in the tail. */
#ifndef VNDF_FIT_PROFILE_PROFILE_H
#define VNDF_FIT_PROFILE_PROFILE_H

#include <math.h>

#include "core/error.h"
#include "source/source.h"

/* ---- the guard of a build: how much it has cost so far, and why it must end early ----
 *
 * It counts operations of some 4 to 12 ns each (vndf_build.h): evaluations of the source, and points of the sums beside
 * them. So the limit is the same on every machine, and builds stay deterministic. Every so many operations it asks the
 * caller's progress function whether to go on.
 *
 * The first reason why a build must end is kept here, whatever it is. From then on nothing evaluates the source any
 * more, and all loops run out quickly. The function that began the build asks for the reason, and throws the results
 * away. */
typedef struct vndf_guard {
    vndf_progress *progress; /* may be NULL */
    void *progress_user;
    const char *what;   /* the stage that the build is in, */
    double done;        /* and where it stands */
    double spent, next; /* operations; when to ask again */
    vndf_error why;     /* why the build must end; VNDF_OK until then */
} vndf_guard;

/* progress may be NULL. */
vndf_guard vndf_guard_from(vndf_progress *progress, void *progress_user);

/* Notes that a stage begins, and asks whether to go on. */
void vndf_guard_stage(vndf_guard *guard, double done, const char *what);

/* Counts operations; 0 if the build must end. */
int vndf_guard_spend(vndf_guard *guard, double operations);

int vndf_guard_stopped(const vndf_guard *guard);

/* Where vndf_fail may put the reason: NULL, which it takes, if there is one already. */
vndf_error *vndf_guard_why(vndf_guard *guard);
void vndf_guard_starve(vndf_guard *guard); /* there is no memory */

/* VNDF_OK, or the error that says why the build must end. */
vndf_status vndf_guard_status(const vndf_guard *guard, vndf_error *error);

/* ---- the profile ---- */

/* The Gauss-Legendre rule on [0, 1]. */
enum { VNDF_GAUSS = 10 };
extern const double vndf_gauss_node[VNDF_GAUSS], vndf_gauss_weight[VNDF_GAUSS];

/* A Gauss point: P r dr = weight. */
typedef struct vndf_profile_point {
    double r, weight;
} vndf_profile_point;

/* Integrals of P r^n dr: inside the panel, before its inner edge, and beyond it. */
typedef struct vndf_panel {
    double r;           /* inner edge */
    double m0, m1;      /* of P r and of P r (r - inner edge) over the panel */
    double f0;          /* of P r before the inner edge */
    double t0, s;       /* of P r and of P r (r - inner edge) beyond it */
    double less, least; /* of P and of P/r^2 beyond it, by the points */
    vndf_profile_point point[VNDF_GAUSS];
} vndf_panel;

typedef struct vndf_profile {
    const vndf_source *source;
    vndf_guard *guard; /* of the build */
    double normalization, scale;
    size_t count;            /* of panels */
    vndf_panel *panel;       /* room for the limit of them; panel[count] is the outer end */
    double f0, f1;           /* totals: integrals of P r dr and P r^2 dr */
    double pole, tail;       /* -d log P / d log r at both ends; infinite if P vanishes there */
    double tail_m0, tail_m1; /* as m0 and m1 of a panel: beyond the last one, where P falls by a power */
    double *edge;            /* slopes in the source's unit where panels end, ascending and apart */
    size_t edge_count;
    double hidden; /* a bound of the missed part of the mass, or of the area at grazing incidence; 1 if */
    double finest; /* this is not 0: then the relative width down to which the source was sampled */
} vndf_profile;

/* NULL and an error with the reason if the source cannot be the normals of a microsurface. The profile keeps the
 * guard, which must live as long. */
vndf_profile *vndf_profile_from(const vndf_source *source, vndf_guard *guard, vndf_error *error);
void vndf_profile_free(vndf_profile *profile);

/* P(R) at canonical scale; 0 once the guard has stopped the build. */
double vndf_profile_p22(const vndf_profile *profile, double r);

/* The same at up to VNDF_SOURCE_MANY slopes. */
void vndf_profile_p22_many(const vndf_profile *profile, const double *r, size_t count, double *p22);

/* The points of the rule over [from, to], even in log r. */
void vndf_profile_rule(const vndf_profile *profile, double from, double to, vndf_profile_point point[VNDF_GAUSS]);

/* sqrt(R^2 - rho^2) - rho acos(rho/R), R >= rho: the kernel of what is seen from below the horizon, times rho. With v =
 * 1 - rho/R it is (R - rho) sqrt(v) times a series of v, interpolated at Chebyshev's points (tools/evidence/fits.py);
 * it errs by 3e-10. */
static inline double vndf_profile_kernel(double r, double rho)
{
    double way = r - rho, v = way / r;
    return way * sqrt(v) *
           (0.942809041755102 +
            v * (0.0471404241180448 +
                 v * (0.00757688010954708 +
                      v * (0.00174636513315605 +
                           v * (0.000524695280505182 +
                                v * (0.0000530581966426208 +
                                     v * (0.000203962682914189 +
                                          v * (-0.00011057126242655 + v * 0.0000561436904973098))))))));
}

/* The unit problem from (s, 0, -c), s and c >= 0: the projected area of what is visible, and its derivatives by -c and
 * by s. From (s, 0, c) the area is larger by c, and `turned` is what is missing of the derivative 1. */
typedef struct vndf_area {
    double below, turned, along;
} vndf_area;
vndf_area vndf_profile_below(const vndf_profile *profile, double s, double c);

/* The part of the area below which the certificate claims nothing: 1e-10 of the area at grazing incidence at
 * alpha = 1. In the unit problem of a narrow distribution this is a smaller part, but at least 1e-14. */
double vndf_profile_claimed(const vndf_profile *profile);

/* ---- inside of panels.c, proof.c and profile.c ----
 *
 * Until a profile is complete its scale is 1: slopes are those of the source. */

/* Panels lie between 2^-VNDF_OCTAVES and 2^VNDF_OCTAVES of the source's own unit. */
enum { VNDF_OCTAVES = 100 };

/* An exponent this close to the limit of integrable ones counts as the limit. */
static const double VNDF_POWER_MARGIN = 1e-6;

/* Where panels are cut: a jump in the middle would add half to either rule, and look smooth. */
static const double VNDF_UNEVEN = 0.43;

/* The cost of a bound (vndf_reach), over the cost of a value. */
static const double VNDF_REACH_OPERATIONS = 12;

/* Of P22 r^2: doubles lose their digits below, and have no reciprocal. */
static const double VNDF_LEAST_PEAK = 1e-307;

/* Makes the panels between the edges, with their points and sums, unless something stops it; P is normalised to a peak
 * of 1. Returns the largest P22 r^2 at a few thousand slopes. */
double vndf_panels_make(vndf_profile *profile);

/* Fills what lies before and beyond each panel, and the totals. */
void vndf_panels_sum(vndf_profile *profile);

/* What panels missed. */
typedef struct vndf_proof {
    double hidden;       /* bound on what panels missed, of the mass or of the area at grazing incidence */
    double worst, where; /* largest bound of one place, as such a part, and its slope */
    int proven;          /* the bound and the miss that was found are small enough */
    double *edge;        /* slopes about features that panels missed, ascending; owned */
    size_t edge_count;
} vndf_proof;

/* By bounds, for a source that has them; by values of another, as far apart as profile->finest, which is put. 0 if
 * there is no memory or the build must end; free the edges either way. */
int vndf_proof_from(vndf_proof *proof, vndf_profile *profile);

#endif
