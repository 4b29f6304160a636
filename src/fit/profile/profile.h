/* A source made fit for integration: P22 at canonical scale, cut into panels on which it is resolved.
 *
 * The canonical distribution P(R) = normalization scale^2 p22(scale R) + floor has 2 pi integral P R dR = 1 and
 * median R = 1. The floor, 1e-26/(1 + R^2)^2, is too small for any measurement and keeps a density positive on the
 * whole hemisphere. Panels are even in log R and at most an octave wide. A panel is halved until ten Gauss points
 * agree with twice ten to 1e-10 of the panel, or as far as rounding lets them; after forty halvings it holds a
 * jump or a pole. proof.c looks between the points; where it finds more, panels are made anew with edges there. All
 * integrals below are sums over panels, with relative precision in the tail. */
#ifndef VNDF_FIT_PROFILE_PROFILE_H
#define VNDF_FIT_PROFILE_PROFILE_H

#include "fit/guard.h"
#include "source/resolution.h"
#include "source/source.h"
#include "fit/profile/gauss.h"

/* Integrals of P r^n dr: inside the panel, before its inner edge, and beyond it. */
typedef struct vndf_panel {
    double r;           /* inner edge */
    double m0, m1;      /* of P r and of P r (r - inner edge) over the panel */
    double f0;          /* of P r before the inner edge */
    double t0, s;       /* of P r and of P r (r - inner edge) beyond it */
    double less, least; /* of P and of P/r^2 beyond it: vndf_panels_points */
    int jump;           /* narrowed to the limit: P jumps here, or has a pole */
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
    double f0, f1;             /* totals: integrals of P r dr and P r^2 dr */
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

/* integral over [a, b], which lies in a panel, of P r dr and of P r (r - a) dr. */
typedef struct vndf_moments {
    double m0, m1;
} vndf_moments;
vndf_moments vndf_profile_part(const vndf_profile *profile, double a, double b);

/* The panel of a slope: r_i <= R < r_(i+1), the ends extended. */
size_t vndf_profile_panel(const vndf_profile *profile, double r);

/* integral_rho^inf P r (r - rho) dr. */
double vndf_profile_s(const vndf_profile *profile, double rho);

/* The unit problem from (s, 0, -c), s and c >= 0: the projected area of what is visible, and its derivatives by -c and
 * by s. From (s, 0, c) the area is larger by c, and `turned` is what is missing of the derivative 1. */
typedef struct vndf_area {
    double below, turned, along;
} vndf_area;
vndf_area vndf_profile_below(const vndf_profile *profile, double s, double c);

/* Projected area of the unit problem for the direction (s, 0, c), s >= 0, of any length. */
double vndf_profile_area(const vndf_profile *profile, double s, double c);

/* The part of the area below which the certificate claims nothing: 1e-10 of the area at grazing incidence at
 * alpha = 1. In the unit problem of a narrow distribution this is a smaller part, but at least 1e-14. */
double vndf_profile_claimed(const vndf_profile *profile);

#endif
