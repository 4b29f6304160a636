/* An affine surface along its principal axes: s = M u + mean is R diag(ax, ay) u' + mean for slopes u' with the same
 * distribution as u, since that is isotropic; R turns x to the first principal axis. Normals and directions go over
 * to the surface without mean slope by a linear map of determinant 1, and so do densities:
 *
 *     wm ~ L n,   wi' = L^T wi,   L (x, y, z) = R (x - mean.x z, y - mean.y z, z),  mean along the axes.
 *
 * wi.wm is wi'.n but for lengths. With n = L^-1 wm, wm of unit length, a density of n/|n| is one of wm divided by
 * |n|^3, and D, which is P22 over the fourth power of the cosine, is D(n/|n|)/|n|^4. */
#ifndef VNDF_SAMPLER_AFFINE_PRINCIPAL_H
#define VNDF_SAMPLER_AFFINE_PRINCIPAL_H

#include <math.h>

#include "sampler/analytic_density.h"
#include "sampler/surface.h"

/* Roughness times the distribution's scale, the first axis, the mean slope along the axes. */
typedef struct vndf_principal {
    double ax, ay, cosine, sine, mean_x, mean_y;
} vndf_principal;

/* Whether M is diagonal: then the axes are x and y, whichever is rougher. */
VNDF_INLINE int vndf_affine_is_diagonal(const vndf_affine *a)
{
    return a->xy == 0.0f && a->yx == 0.0f;
}

/* Axes and singular values of M from M M^T = (a b; b c): half the difference and half the sum of its eigenvalues.
 * Squares of floats are exact in double, and so are the products in the determinant. */
VNDF_INLINE vndf_principal vndf_principal_turned(const vndf_affine *m)
{
    double xx = m->xx, xy = m->xy, yx = m->yx, yy = m->yy, a = xx * xx + xy * xy, c = yx * yx + yy * yy;
    double b = xx * yx + xy * yy, p = 0.5 * (a - c), h = sqrt(p * p + b * b), most = sqrt(0.5 * (a + c) + h);
    double least = fabs(xx * yy - xy * yx) / most, large = sqrt(0.5 + 0.5 * (fabs(p) / h));
    double small =
        0.5 * b / (h * large); /* a tenth of a degree from the axes the cosine alone would lose the sine */
    vndf_principal round = {most, least, 1.0, 0.0, 0.0, 0.0};
    vndf_principal at = {most, least, p >= 0.0 ? large : small, p >= 0.0 ? small : large, 0.0, 0.0};
    return h > 0.0 ? at : round;
}

/* 0 if the surface is invalid. */
VNDF_INLINE int vndf_principal_of(const vndf_affine *a, vndf_principal *to)
{
    if (!a || !a->distribution)
        return 0;
    vndf_principal straight = {fabsf(a->xx), fabsf(a->yy), 1.0, 0.0, 0.0, 0.0};
    *to = vndf_affine_is_diagonal(a) ? straight : vndf_principal_turned(a);
    double scale = vndf_unit_scale(a->distribution);
    to->ax *= scale;
    to->ay *= scale;
    to->mean_x = to->cosine * a->mean_x + to->sine * a->mean_y;
    to->mean_y = to->cosine * a->mean_y - to->sine * a->mean_x;
    return to->ax >= 1e-18 && to->ax <= 1e18 && to->ay >= 1e-18 && to->ay <= 1e18 && fabsf(a->mean_x) <= 1e6f &&
           fabsf(a->mean_y) <= 1e6f;
}

/* wi' = L^T wi. */
VNDF_INLINE vndf_normal vndf_principal_direction(const vndf_principal *p, vndf_vec3 wi)
{
    double x = p->cosine * wi.x + p->sine * wi.y, y = p->cosine * wi.y - p->sine * wi.x;
    vndf_normal to = {x, y, wi.z - (x * p->mean_x + y * p->mean_y)};
    return to;
}

/* L^-1 wm. */
VNDF_INLINE vndf_normal vndf_principal_normal(const vndf_principal *p, vndf_normal wm)
{
    double x = p->cosine * wm.x + p->sine * wm.y, y = p->cosine * wm.y - p->sine * wm.x;
    vndf_normal to = {x + p->mean_x * wm.z, y + p->mean_y * wm.z, wm.z};
    return to;
}

/* L n. */
VNDF_INLINE vndf_normal vndf_principal_back(const vndf_principal *p, vndf_normal n)
{
    double x = n.x - p->mean_x * n.z, y = n.y - p->mean_y * n.z;
    vndf_normal to = {p->cosine * x - p->sine * y, p->sine * x + p->cosine * y, n.z};
    return to;
}

VNDF_INLINE double vndf_normal_length(vndf_normal n)
{
    return sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
}

VNDF_INLINE vndf_normal vndf_normal_times(vndf_normal n, double factor)
{
    vndf_normal to = {n.x * factor, n.y * factor, n.z * factor};
    return to;
}

#endif
