/* An affine surface along its principal axes, for one or for lanes: s = M u + mean is R diag(ax, ay) u' + mean for
 * slopes u' with the same distribution as u, since that is isotropic; R turns x to the first principal axis. Normals
 * and directions go over to the surface without mean slope by a linear map of determinant 1, and so do densities:
 *
 *     wm ~ L n,   wi' = L^T wi,   L (x, y, z) = R (x - mean.x z, y - mean.y z, z),  mean along the axes.
 *
 * wi.wm is wi'.n. The plain surface has ax, ay and wi' as floats: relative roundings, which it could have been given.
 * Their price is that u' is off by up to 2^-24 of itself from the matrix as it is given, and exp(-u'^2) of Beckmann by
 * up to 2^-23 u'^2: 8.8e-6 where u'^2 is 74, and more than 1e-5 beyond 84, where D is 1e-37 of its maximum.
 * n = L^-1 wm stays in double, and is not made unit: with n of any length the density of n/|n| over |n|^3, and D of it
 * over |n|^4, are what the formulas give (density.h, analytic_density.h), and those are the densities of wm. */
#ifndef VNDF_SAMPLER_AFFINE_PRINCIPAL_H
#define VNDF_SAMPLER_AFFINE_PRINCIPAL_H

#include <math.h>

#include "sampler/law.h"

/* ---- axes ---- */

/* The matrix and the mean slope. */
typedef struct vndf_slope_map {
    doubles xx, xy, yx, yy, mean_x, mean_y;
} vndf_slope_map;

/* Roughness, the first axis, the mean slope along the axes. Straight: without a turn and a mean slope. */
typedef struct vndf_principal {
    doubles_f ax, ay;
    doubles cosine, sine, mean_x, mean_y;
    doubles_m straight;
} vndf_principal;

VNDF_INLINE doubles_m vndf_are_zero(doubles a, doubles b)
{
    return doubles_at_most(doubles_abs(a) + doubles_abs(b), doubles_set(0.0));
}

VNDF_INLINE doubles_m vndf_principal_is_straight(const vndf_principal *p)
{
    return doubles_both(vndf_are_zero(p->sine, p->mean_x), vndf_are_zero(p->mean_y, p->mean_y));
}

/* A diagonal M has the axes x and y, whichever is rougher. */
VNDF_INLINE vndf_principal vndf_principal_of_diagonal(const vndf_slope_map *m)
{
    vndf_principal at;
    at.ax = doubles_narrow(doubles_abs(m->xx));
    at.ay = doubles_narrow(doubles_abs(m->yy));
    at.cosine = doubles_set(1.0);
    at.sine = doubles_set(0.0);
    return at;
}

/* Axes and singular values of M from M M^T = (a b; b c): half the difference and half the sum of its eigenvalues.
 * Squares of floats are exact in double, and so are the products in the determinant. */
VNDF_INLINE vndf_principal vndf_principal_of_any(const vndf_slope_map *m, doubles_m diagonal)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    doubles xx = m->xx, xy = m->xy, yx = m->yx, yy = m->yy, a = xx * xx + xy * xy, c = yx * yx + yy * yy;
    doubles b = xx * yx + xy * yy, p = 0.5 * (a - c), h = doubles_root(p * p + b * b);
    doubles most = doubles_root(0.5 * (a + c) + h), least = doubles_abs(xx * yy - xy * yx) / most;
    doubles sum = h + doubles_abs(p), per = 1.0 / doubles_root(2.0 * h * sum), large = sum * per, small = b * per;
    doubles_m turned = doubles_without(doubles_less(nothing, h), diagonal);
    doubles_m along_x = doubles_at_most(nothing, p);
    doubles cosine = doubles_pick(along_x, large, small), sine = doubles_pick(along_x, small, large);
    vndf_principal at;
    at.ax = doubles_narrow(doubles_pick(diagonal, doubles_abs(xx), most));
    at.ay = doubles_narrow(doubles_pick(diagonal, doubles_abs(yy), least));
    at.cosine = doubles_pick(turned, cosine, one);
    at.sine = doubles_pick(turned, sine, nothing);
    return at;
}

VNDF_INLINE vndf_principal vndf_principal_axes(const vndf_slope_map *m)
{
    const doubles nothing = doubles_set(0.0);
    doubles_m diagonal = vndf_are_zero(m->xy, m->yx), all = doubles_at_most(nothing, nothing);
    return doubles_any(doubles_without(all, diagonal)) ? vndf_principal_of_any(m, diagonal)
                                                       : vndf_principal_of_diagonal(m);
}

/* Roughness 0, which is invalid, where the mean slope is too large. */
VNDF_INLINE vndf_principal vndf_principal_of(const vndf_slope_map *m)
{
    const doubles most = doubles_set(1e6);
    vndf_principal at = vndf_principal_axes(m);
    doubles_m near =
        doubles_both(doubles_at_most(doubles_abs(m->mean_x), most), doubles_at_most(doubles_abs(m->mean_y), most));
    at.ax = doubles_narrow(doubles_pick(near, doubles_widen(at.ax), doubles_set(0.0)));
    at.mean_x = at.cosine * m->mean_x + at.sine * m->mean_y;
    at.mean_y = at.cosine * m->mean_y - at.sine * m->mean_x;
    at.straight = vndf_principal_is_straight(&at);
    return at;
}

/* ---- directions and normals ---- */

/* wi' times `factor`, a power of two that keeps it in the range of a float. */
typedef struct vndf_toward {
    doubles x, y, z, factor;
} vndf_toward;

VNDF_INLINE vndf_toward vndf_principal_toward(const vndf_principal *p, doubles x, doubles y, doubles z)
{
    const doubles one = doubles_set(1.0);
    doubles length = doubles_abs(x) + doubles_abs(y) + doubles_abs(z);
    doubles factor =
        doubles_pick(doubles_less(length, doubles_set(1e-15)), doubles_set(0x1p100),
                     doubles_pick(doubles_less(doubles_set(1e15), length), doubles_set(0x1p-100), one));
    doubles along = p->cosine * x + p->sine * y, aside = p->cosine * y - p->sine * x;
    doubles up = z - (along * p->mean_x + aside * p->mean_y);
    vndf_toward to;
    to.factor = doubles_pick(p->straight, one, factor);
    to.x = doubles_pick(p->straight, x, along * factor);
    to.y = doubles_pick(p->straight, y, aside * factor);
    to.z = doubles_pick(p->straight, z, up * factor);
    return to;
}

/* L^-1 wm. */
VNDF_INLINE vndf_normal vndf_principal_normal(const vndf_principal *p, vndf_normal wm)
{
    doubles x = p->cosine * wm.x + p->sine * wm.y, y = p->cosine * wm.y - p->sine * wm.x;
    vndf_normal n = {doubles_pick(p->straight, wm.x, x + p->mean_x * wm.z),
                     doubles_pick(p->straight, wm.y, y + p->mean_y * wm.z), wm.z};
    return n;
}

/* L n. */
VNDF_INLINE vndf_normal vndf_principal_back(const vndf_principal *p, vndf_normal n)
{
    doubles x = n.x - p->mean_x * n.z, y = n.y - p->mean_y * n.z;
    vndf_normal to = {p->cosine * x - p->sine * y, p->sine * x + p->cosine * y, n.z};
    return to;
}

/* Whether w . n is large beside its terms, of which w or n is rounded. */
VNDF_INLINE doubles_m vndf_principal_faces(vndf_normal w, vndf_normal n, doubles facing)
{
    doubles terms = doubles_abs(w.x * n.x) + doubles_abs(w.y * n.y) + doubles_abs(w.z * n.z);
    return vndf_trusts_affine_facing(terms, facing);
}

/* wi . wm with one rounding: vndf_exact_dot. */
VNDF_INLINE doubles vndf_normal_facing(vndf_normal wi, vndf_normal wm)
{
    vndf_query g = {{wi.x, wi.x, wi.x, wi.y, wi.z}, wm.x, wm.y, wm.z};
    return vndf_query_facing(&g);
}

/* ---- samples ---- */

/* The real normal of one that the plain surface drew with its density. That density times |L n|^3 is trusted where the
 * rounding of the real normal changes it little (trust.h). */
typedef struct vndf_affine_drawn {
    doubles_f x, y, z;
    doubles facing, density;
    doubles_m trusted;
} vndf_affine_drawn;

/* Whether the rounding of wm = L n/|L n|, of which `to` is L n, moves the density by less than VNDF_SHARE_AFFINE. `of`
 * has roughness times the distribution's scale, and wi'. */
VNDF_INLINE doubles_m vndf_principal_trusts(const vndf_distribution *d, const vndf_direction *of, vndf_normal n,
                                            vndf_normal to)
{
    doubles a = of->ax * of->ay, x = of->ay * n.x, y = of->ax * n.y, z = a * n.z,
            along = of->x * n.x + of->y * n.y;
    doubles least = doubles_pick(doubles_less(of->ax, of->ay), of->ax, of->ay) * n.z;
    doubles sx = of->ax * of->x, sy = of->ay * of->y;
    vndf_rounding r = {x * x + y * y, z * z,         to.x * to.x + to.y * to.y,
                       least * least, along * along, (sx * sx + sy * sy) * (n.z * n.z)};
    return vndf_law_trusts_rounding(d, &r);
}

VNDF_INLINE vndf_affine_drawn vndf_principal_drawn(const vndf_distribution *d, const vndf_principal *p,
                                                   const vndf_direction *of, vndf_normal wi, vndf_normal n,
                                                   doubles density)
{
    vndf_normal to = vndf_principal_back(p, n);
    doubles length = doubles_root(to.x * to.x + to.y * to.y + to.z * to.z), per = 1.0 / length;
    vndf_affine_drawn at;
    at.x = doubles_narrow(to.x * per);
    at.y = doubles_narrow(to.y * per);
    at.z = doubles_narrow(to.z * per);
    vndf_normal wm = {doubles_widen(at.x), doubles_widen(at.y), doubles_widen(at.z)};
    at.facing = vndf_normal_facing(wi, wm);
    at.density = density * (length * length * length);
    vndf_normal toward = {of->x, of->y, of->z};
    at.trusted = doubles_both(vndf_principal_faces(wi, wm, at.facing), vndf_trusts_affine_density(density));
    at.trusted = doubles_both(at.trusted,
                              vndf_principal_faces(toward, n, toward.x * n.x + toward.y * n.y + toward.z * n.z));
    at.trusted = doubles_both(at.trusted, vndf_principal_trusts(d, of, n, to));
    return at;
}

#endif
