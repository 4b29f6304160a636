/* Surfaces: slopes are M u + mean, where u are slopes of the unit problem (design: affine images of slopes, Dupuy et
 * al., "Linear Efficient Antialiased Displacement and Reflectance Mapping", TOG 32(6), 2013; Atanasov et al. 2022).
 *
 * A normal of the unit problem, (x, y, z) with the slope -(x, y)/z, is the normal (M (x, y) - mean z, z) of the
 * surface, and wi . wm is w . (x, y, z) with w = (M^T wi_xy, wi_z - wi_xy . mean): the surface is seen from wi as the
 * unit problem is seen from w, and A(wi) = A(w). */
#ifndef VNDF_KERNEL_SURFACE_H
#define VNDF_KERNEL_SURFACE_H

#include "kernel/math.h"

/* M, in units of the table's slopes, and the mean slope. */
typedef struct affine_map {
    real xx, xy, yx, yy, mean_x, mean_y;
} affine_map;

/* |det M|. Only matrices that turn or shear need all the digits of their products. */
HERE real affine_determinant(affine_map m)
{
    real straight = m.xx * m.yy, across = size(m.xy * m.yx), determinant = size(straight);
    mask sheared = less(set(0.0f), across);
    if (any(sheared))
        determinant = pick(sheared, size(difference_of_products(m.xx, m.yy, m.xy, m.yx)), determinant);
    return determinant;
}

/* Singular values from 1e-15, the determinant over the largest entry, to 1e15, whose squares and cubes floats hold;
 * mean slopes up to 1e6. */
HERE mask affine_is_valid(affine_map m)
{
    real determinant = affine_determinant(m), end = set(1e15f);
    real largest = most(most(size(m.xx), size(m.xy)), most(size(m.yx), size(m.yy)));
    mask inside =
        both(at_most(most(largest * 1e-15f, set(1e-36f)), determinant), at_most(determinant, set(1e36f)));
    mask first = both(at_most(size(m.xx), end), at_most(size(m.xy), end));
    mask second = both(at_most(size(m.yx), end), at_most(size(m.yy), end));
    mask level = both(at_most(size(m.mean_x), set(1e6f)), at_most(size(m.mean_y), set(1e6f)));
    return both(both(inside, level), both(first, second));
}

/* Not zero, infinite or NaN. */
HERE mask direction_is_valid(real x, real y, real z)
{
    real largest = most(most(size(x), size(y)), size(z)), end = set(3.4028234e38f);
    mask finite = both(both(at_most(size(x), end), at_most(size(y), end)), at_most(size(z), end));
    return both(finite, less(set(0.0f), largest));
}

/* A direction wi on a surface. */
typedef struct frame {
    affine_map m;
    real wx, wy, wz; /* wi, times a power of two */
    real ux, uy,
        uz;    /* w, times another one, which is 1 where the largest component is within [1/16, 16], or makes it
                        * so */
    real grow; /* w = grow (ux, uy, uz) for wi as it was scaled, */
    real size; /* and `size` for wi as it was given */
    real determinant; /* |det M| */
    real rarest;      /* the least density of a sample: 0 straight from below, where nothing is seen */
} frame;

HERE frame frame_of(affine_map m, real x, real y, real z)
{
    real largest = most(most(size(x), size(y)), size(z)), k = set(1.0f);
    mask odd = either(less(largest, set(1e-9f)), less(set(1e9f), largest));
    if (any(odd))
        k = pick(odd, inverse_scale(largest), k);
    frame f;
    f.m = m;
    f.wx = x * k;
    f.wy = y * k;
    f.wz = z * k;
    real ux = m.xx * f.wx + m.yx * f.wy, uy = m.xy * f.wx + m.yy * f.wy,
         uz = f.wz - (f.wx * m.mean_x + f.wy * m.mean_y);
    real l = set(1.0f);
    largest = most(most(size(ux), size(uy)), size(uz));
    odd = either(less(largest, set(0.0625f)), less(set(16.0f), largest));
    if (any(odd))
        l = pick(odd, inverse_scale(largest), l);
    f.ux = ux * l;
    f.uy = uy * l;
    f.uz = uz * l;
    f.grow = 1.0f / l;
    f.size = 1.0f / k / l;
    f.determinant = affine_determinant(m);
    mask unseen = both(at_most(size(f.ux) + size(f.uy), set(0.0f)), less(f.uz, set(0.0f)));
    f.rarest = pick(unseen, set(0.0f), set(1.17549435e-38f));
    return f;
}

/* A normal that a frame draws: unit, and its density per steradian. */
typedef struct sampled {
    real x, y, z, pdf;
} sampled;

/* A density that a float can hold, not 0 where something is seen. */
HERE real frame_density(frame f, real density)
{
    real held = least(most(density, f.rarest), set(3.4028234e38f));
    return pick(less(set(0.0f), f.rarest), held, set(0.0f));
}

/* The real normal of one of the unit problem. Where rounding turns it away from wi it is turned back, by wi, and the
 * density is that of where it went: wi . wm exceeds what three more roundings may take. */
HERE sampled frame_sampled(frame f, drawn n)
{
    real x = (f.m.xx * n.x + f.m.xy * n.y) - f.m.mean_x * n.z,
         y = (f.m.yx * n.x + f.m.yy * n.y) - f.m.mean_y * n.z;
    real z = n.z, up = most(f.wz, set(0.0f)), a = f.wx * x, b = f.wy * y, c = f.wz * z;
    real tiny = 1e-12f * (size(x) + size(y) + z) * (size(f.wx) + size(f.wy) + size(f.wz)); /* all terms may be 0 */
    real lack = 3e-7f * (size(a) + size(b) + size(c)) + tiny - (a + b + c);
    mask away = less(set(0.0f), lack);
    if (any(away)) {
        real turn_by = lack / ((f.wx * f.wx + f.wy * f.wy) + (up * up + 1e-30f));
        x = pick(away, x + turn_by * f.wx, x); /* not by a turn of 0: that would make -0 of 0 */
        y = pick(away, y + turn_by * f.wy, y);
        z = pick(away, z + turn_by * up, z);
    }
    real square = (x * x + y * y) + z * z, reach = root(square), per = reach * (1.0f / square);
    sampled s = {x * per, y * per, z * per, frame_density(f, (n.density * reach) * (square / f.determinant))};
    return s;
}

/* The normal of the unit problem for a unit normal of the surface; what w sees of it, for w = (ux, uy, uz). */
typedef struct unit_normal {
    real x, y, z, facing;
} unit_normal;

HERE unit_normal frame_normal(frame f, real x, real y, real z)
{
    real a = x + f.m.mean_x * z, b = y + f.m.mean_y * z;
    real per = 1.0f / difference_of_products(f.m.xx, f.m.yy, f.m.xy, f.m.yx);
    unit_normal n = {difference_of_products(f.m.yy, a, f.m.xy, b) * per,
                     difference_of_products(f.m.xx, b, f.m.yx, a) * per, z,
                     ((f.wx * x + f.wy * y) + f.wz * z) / f.grow};
    return n;
}

/* Smith's Lambda and G1 of a direction with this area, whose projection on the mean plane is `cosine`. */
HERE real lambda_of(real area, real cosine)
{
    mask nothing = both(at_most(area, set(0.0f)), at_most(size(cosine), set(0.0f)));
    real lambda = (most(area, cosine) - cosine) / cosine, end = set(3.4028234e38f);
    return pick(nothing, set(0.0f), least(most(lambda, -end), end));
}

HERE real g1_of(real area, real cosine)
{
    real part = least(cosine / most(area, cosine), set(1.0f));
    return pick(less(set(0.0f), cosine), part, set(0.0f));
}

/* ---- a table on a surface ---- */

/* The direction of (ux, uy), and the direction as the unit problem sees it (law.h). */
typedef struct table_direction {
    real ex, ey, s, c, rho;
    real square, under; /* rho^2 as two parts, by which its cell is found */
} table_direction;

HERE table_direction table_direction_of(frame f)
{
    table_direction w;
    w.square = f.uz * f.uz;
    w.under = f.ux * f.ux + f.uy * f.uy;
    real across = root(w.under), level = size(f.uz);
    mask straight = less(across, 1e-15f * level);
    across = most(across, 1e-15f * level);
    real over = 1.0f / across, per = 1.0f / (across + level);
    w.ex = pick(straight, set(1.0f), f.ux * over);
    w.ey = pick(straight, set(0.0f), f.uy * over);
    w.s = across * per;
    w.c = f.uz * per;
    w.rho = level * over;
    return w;
}

typedef struct table_view {
    real ex, ey;
    seen v;
} table_view;

/* `below` is known: w is below the horizon in all lanes, or in none. */
HERE table_view table_view_of(table t, frame f, const int below)
{
    table_direction w = table_direction_of(f);
    whole cell = find_knot(t, w.square, w.under);
    table_view view;
    view.ex = w.ex;
    view.ey = w.ey;
    if (below)
        view.v = law_see_below(t, w.s, w.c, w.rho, cell);
    else
        view.v = law_see_above(t, w.s, w.c, w.rho, cell, law_first(t, cell, w.square, w.under));
    return view;
}

HERE drawn table_turned(real ex, real ey, drawn n)
{
    drawn turned = {ex * n.x - ey * n.y, ey * n.x + ex * n.y, n.z, n.density};
    return turned;
}

/* What |(ux, uy)| + |uz| is: facing of a frame over it is that of (s, 0, c). */
HERE real frame_reach(frame f)
{
    return root(f.ux * f.ux + f.uy * f.uy) + size(f.uz);
}

#endif
