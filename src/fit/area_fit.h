/* The spline of a wedge's mass for a profile, on one side of the horizon. The coordinate y in [0, 1] is the one of
 * vndf_wedge. */
#ifndef VNDF_FIT_AREA_FIT_H
#define VNDF_FIT_AREA_FIT_H

#include "fit/profile/profile.h"
#include "fit/refine.h"
#include "table/area_piece.h"

typedef struct vndf_side {
    const vndf_profile *profile;
    int below;     /* 1: the horizon; 0: above it */
    double weight; /* of errors below the horizon, */
    double fade;   /* and how it falls with what is seen: power of vndf_profile_fade */
    double areas;  /* weight of errors of the area below the horizon; 1: all areas count alike */
} vndf_side;

/* Mass of the wedge per (s + |c|), with its derivatives by y. */
vndf_area_value vndf_side_area(const vndf_side *side, double y);

/* The mass alone, in less time; the same bits. */
double vndf_side_mass(const vndf_side *side, double y);

/* The share of the visible mass at y that lies in the wedge, from its mass. It rises with y. Below the horizon that is
 * all of it; there the share falls with the visible area, and is next to nothing where nothing is claimed; times
 * `weight`. */
double vndf_side_share(const vndf_side *side, double y, double mass);

/* The largest miss times the share where it is; y ascending. Asks for few shares: each bounds those before it. */
double vndf_side_largest(const vndf_side *side, const double *y, const double *miss, size_t count);

/* The y below which the certificate claims nothing (vndf_profile_claimed); 0 above the horizon. */
double vndf_side_least(const vndf_side *side);

/* The ends of the spline's piece from a to b. */
void vndf_area_fit_piece(const vndf_side *side, double a, double b, vndf_area_knot *from, vndf_area_knot *to);

/* Relative error of the area between knots at a and b; above the horizon times the wedge's share of the area. The
 * areas below also give those of the opposite directions above; with `areas` below 1 the larger counts of the error
 * there and of the error below times its weight. A vndf_interval_error with a vndf_side. */
vndf_interval_miss vndf_area_fit_error(double a, double b, void *side);

#endif
