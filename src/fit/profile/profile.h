/* A source made fit for integration: P22 at canonical scale, cut into panels on which it is resolved.
 *
 * The canonical distribution P(R) = normalization scale^2 p22(scale R) + floor has 2 pi integral P R dR = 1 and
 * median R = 1. The floor, 1e-26/(1 + R^2)^2, is too small for any measurement and keeps a density positive on the
 * whole hemisphere. Panels are even in log R and at most an octave wide. A panel is halved until ten Gauss points
 * agree with twice ten to 1e-10 of the panel, or as far as rounding lets them; after forty halvings it holds a
 * jump. proof.c looks between the points; where it finds more, panels are made anew with edges there. All
 * integrals below are sums over panels, with relative precision near the pole (E) and in the tail (S). */
#ifndef VNDF_FIT_PROFILE_PROFILE_H
#define VNDF_FIT_PROFILE_PROFILE_H

#include "fit/guard.h"
#include "source/resolution.h"
#include "source/source.h"
#include "fit/profile/gauss.h"

/* F_n = integral_0^R P r^(n+1) dr at the inner edge, T_n from there to infinity; E = F0 - F1/R, S = T1 - R T0. */
typedef struct vndf_panel {
    double r;         /* inner edge */
    double m0, m1;    /* integral P r dr and P r (r - inner edge) dr over the panel */
    double f0, f1, e; /* before the inner edge */
    double t0, s;     /* beyond the inner edge */
    int jump;         /* narrowed to the limit: P jumps here */
} vndf_panel;

/* A Gauss point: P r dr = weight. */
typedef struct vndf_profile_point {
    double r, weight;
} vndf_profile_point;

/* Where panels are cut: a jump in the middle would add half to either rule, and look smooth. */
#define VNDF_UNEVEN 0.43

/* The cost of a bound (vndf_reach), over the cost of a value. */
#define VNDF_REACH_OPERATIONS 12

typedef struct vndf_profile {
    const vndf_source *source;
    char *description; /* the source, and how closely the build looks at it; owned */
    double sampled;    /* the given `finest`; 0: none */
    vndf_guard *guard; /* of the build; NULL for an oracle that may be shared between threads */
    double normalization, scale, floor;
    size_t count, capacity; /* panels; panel[count] is the outer end */
    vndf_panel *panel;
    vndf_profile_point *point; /* VNDF_GAUSS per panel */
    double f0, f1;             /* totals */
    double tail_m0, tail_m1;   /* as m0 and m1 of a panel: beyond the last one, where P falls by a power */
    int rough;                 /* needs more panels than the limit */
    int unsettled;             /* two passes found different masses */
    double *edge;              /* slopes in the source's unit where panels end, beside its own breaks; */
    size_t edge_count;         /* ascending */
    double hidden; /* a bound of the missed part of the mass, or of the area at grazing incidence; 1 if */
    double finest; /* this is not 0: then the relative width down to which the source was sampled */
} vndf_profile;

/* NULL and an error with the reason if the source cannot be the normals of a microsurface. The profile keeps the
 * guard, which must live as long or be set to NULL. The resolution may be NULL and is copied. */
vndf_profile *vndf_profile_from(const vndf_source *source, const vndf_resolution *resolution, vndf_guard *guard,
                                vndf_error *error);
void vndf_profile_free(vndf_profile *profile);

/* P(R) at canonical scale; only the floor once the guard has stopped the build. */
double vndf_profile_p22(const vndf_profile *profile, double r);

/* The same at up to VNDF_SOURCE_MANY slopes. */
void vndf_profile_p22_many(const vndf_profile *profile, const double *r, size_t count, double *p22);

/* integral over [a, b] of P r dr and of P r (r - a) dr; b may be infinite. */
typedef struct vndf_moments {
    double m0, m1;
} vndf_moments;
vndf_moments vndf_profile_moments(const vndf_profile *profile, double a, double b);

/* E(rho) = integral_0^rho P r (1 - r/rho) dr and S(rho) = integral_rho^inf P r (r - rho) dr. */
double vndf_profile_e(const vndf_profile *profile, double rho);
double vndf_profile_s(const vndf_profile *profile, double rho);

/* Half the area that a direction sees: the area of half a turn. Coordinate y in [0, 1] as in vndf_wedge: above,
 * the part beyond a right angle from wi for (s, c) = (1-y, y); below, the whole for (y, -(1-y)). With the
 * derivatives by y; the second may be infinite at the ends, and is 0 there. */
typedef struct vndf_area_value {
    double mass, slope, curve;
} vndf_area_value;
vndf_area_value vndf_profile_area_above(const vndf_profile *profile, double y);
vndf_area_value vndf_profile_area_below(const vndf_profile *profile, double y);

/* The masses alone, in less time; the same bits. */
double vndf_profile_mass_above(const vndf_profile *profile, double y);
double vndf_profile_mass_below(const vndf_profile *profile, double y);

/* Projected area of the unit problem for the direction (s, 0, c), s >= 0, of any length. */
double vndf_profile_area(const vndf_profile *profile, double s, double c);

/* The same for the direction of length 1, over the area at grazing incidence. */
double vndf_profile_seen(const vndf_profile *profile, double s, double c);

/* The part of the area below which the certificate claims nothing: 1e-10 of the area at grazing incidence at
 * alpha = 1. In the unit problem of a narrow distribution this is a smaller part, but at least 1e-14. */
double vndf_profile_claimed(const vndf_profile *profile);

/* The weight of an error where this part is visible: seen^power down to the claimed part, then next to nothing. */
double vndf_profile_fade(const vndf_profile *profile, double seen, double power);

#endif
