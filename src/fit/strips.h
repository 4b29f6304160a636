/* The measure f dR of a profile in narrow strips: what knots are chosen among, cells are summed from and laws are
 * compared with. A strip is so narrow that two points in it stand for all of its f. */
#ifndef VNDF_FIT_STRIPS_H
#define VNDF_FIT_STRIPS_H

#include "fit/profile/profile.h"

/* Slopes nearer than this part of themselves count as one: normals of floats hardly tell them apart. */
#define VNDF_GRAIN 0x1p-20

/* From its edge to that of the next, t = R - edge. */
typedef struct vndf_strip {
    double edge;
    double m0, m1, m2, m4; /* integrals of f/R, t f/R, t^2 f/R and f/R^4 */
    double f, along;       /* of f and of R f */
    double p0, p1;         /* P22 inside both ends */
    double r[2], mass[2];  /* two points: f dR = mass */
    int gathered;          /* all of it stands at one place */
} vndf_strip;

typedef struct vndf_strips {
    size_t count;
    vndf_strip *at; /* edges ascend from 0, as floats do; at[count] has an infinite one */
} vndf_strips;

/* About `count` strips; some end at knots, which ascend from 0. 0 if there is no memory; free them either
 * way. */
int vndf_strips_from(vndf_strips *strips, const vndf_profile *profile, const float *knot, size_t knots,
                     size_t count);
void vndf_strips_free(vndf_strips *strips);

/* The last edge at or before a slope. */
size_t vndf_strips_edge(const vndf_strips *strips, double r);

#endif
