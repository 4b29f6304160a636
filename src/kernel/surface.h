/* Surfaces: slopes are M u + mean, where u are slopes of the unit problem: roughness 1 and no mean slope, the stretched
 * space or standard configuration of the literature (affine images of slopes: Dupuy et al., "Linear Efficient
 * Antialiased Displacement and Reflectance Mapping", TOG 32(6), 2013; Atanasov et al. 2022).
 *
 * A normal of the unit problem, (x, y, z) with the slope -(x, y)/z, is the normal (M (x, y) - mean z, z) of the
 * surface, and wi . wm is w . (x, y, z) with w = (M^T wi_xy, wi_z - wi_xy . mean): the surface is seen from wi as the
 * unit problem is seen from w, and A(wi) = A(w). */
#ifndef VNDF_KERNEL_SURFACE_H
#define VNDF_KERNEL_SURFACE_H

#include "kernel/math.h"

/* M, in units of the table's slopes, and the mean slope. Of a `is_diagonal` surface xx and yy alone are not 0:
 * its other numbers are not read, and it has the same bits without them. */
typedef struct affine_map {
    real xx, xy, yx, yy, mean_x, mean_y;
    int is_diagonal;
    real determinant; /* of M */
} affine_map;

/* Completes a map with its determinant. If its two products are close, their difference takes all their digits. */
KERNEL affine_map affine_measured(affine_map bare)
{
    affine_map m = bare;
    m.determinant = m.xx * m.yy;
    if (m.is_diagonal == 0) {
        real across = m.xy * m.yx, sum = abs(m.determinant) + abs(across);
        m.determinant = m.determinant - across;
        mask close = lt(abs(m.determinant), 0.25f * sum);
        if (any(close))
            m.determinant = select(close, difference_of_products(m.xx, m.yy, m.xy, m.yx), m.determinant);
    }
    return m;
}

/* No entry above 1e15 and, as the determinant over the largest, no singular value below 1e-15: floats hold their
 * squares and cubes; mean slopes up to 1e6. NaN fails all comparisons, and makes the determinant NaN. */
KERNEL mask affine_is_valid(affine_map m)
{
    real determinant = abs(m.determinant), largest = max(abs(m.xx), abs(m.yy));
    mask small = le(determinant, set(1e36f));
    if (m.is_diagonal == 0) {
        largest = max(largest, max(abs(m.xy), abs(m.yx)));
        small = both(small, both(le(abs(m.mean_x), set(1e6f)), le(abs(m.mean_y), set(1e6f))));
    }
    mask large = le(max(largest * 1e-15f, set(1e-36f)), determinant);
    return both(both(large, small), le(largest, set(1e15f)));
}

/* True if the length stays a finite float when it is stretched; NaN is false. */
KERNEL mask direction_is_valid(real x, real y, real z)
{
    real length = (abs(x) + abs(y)) + abs(z);
    return both(le(set(1e-20f), length), le(length, set(1e20f)));
}

/* A direction wi on a surface. Scales are powers of two, 1 for ordinary directions. */
typedef struct frame {
    affine_map m;
    real wx, wy, wz;  /* wi, scaled */
    real ux, uy, uz;  /* w, scaled: its length is within 1/100 to 100 */
    real scale;       /* (ux, uy, uz) is this times w of the scaled wi */
    real size;        /* w of wi as it was given is this times (ux, uy, uz) */
    real determinant; /* |det M| */
    real max_pdf;     /* the largest density: 0 within 1e-15 of straight from below, where nothing is seen */
    real flip_cosine; /* below this cosine to the scaled wi, rounding may turn a normal away */
} frame;

/* A direction or a normal, of any length. */
typedef struct triple {
    real x, y, z;
} triple;

/* w of the direction (x, y, z), unscaled. a - (0 - b) is a + b, but a where b is a zero of either sign and a is -0. */
KERNEL triple affine_stretched(affine_map m, real x, real y, real z)
{
    triple w = {m.xx * x, m.yy * y, z};
    if (m.is_diagonal == 0) {
        w.x = w.x - (0.0f - m.yx * y);
        w.y = w.y - (0.0f - m.xy * x);
        w.z = z - ((0.0f + x * m.mean_x) + y * m.mean_y);
    }
    return w;
}

/* Scales wi, then w, to a length of about 1 in the lanes where w is short or long (`odd`): its squares stay
 * floats. */
KERNEL frame frame_scaled(frame bare, mask odd)
{
    frame f = bare;
    real largest = max(max(abs(f.wx), abs(f.wy)), abs(f.wz)), k = select(odd, inverse_scale(largest), set(1.0f));
    f.wx = f.wx * k;
    f.wy = f.wy * k;
    f.wz = f.wz * k;
    triple w = affine_stretched(f.m, f.wx, f.wy, f.wz);
    largest = max(max(abs(w.x), abs(w.y)), abs(w.z));
    f.scale = select(odd, inverse_scale(largest), set(1.0f));
    f.ux = w.x * f.scale;
    f.uy = w.y * f.scale;
    f.uz = w.z * f.scale;
    f.flip_cosine = f.flip_cosine * max(k, set(1.0f));
    f.size = 1.0f / k / f.scale;
    return f;
}

KERNEL frame frame_of(affine_map m, real x, real y, real z)
{
    triple w = affine_stretched(m, x, y, z);
    real one = set(1.0f), near = 6e-7f * ((abs(x) + abs(y)) + abs(z)) + 2e-12f;
    frame f = {m, x, y, z, w.x, w.y, w.z, one, one, abs(m.determinant), set(3.4028234e38f), near};
    real under = w.x * w.x + w.y * w.y, square = under + w.z * w.z;
    mask odd = either(lt(square, set(1e-4f)), lt(set(1e4f), square));
    if (any(odd))
        f = frame_scaled(f, odd);
    mask upright = le(under, 1e-29f * square);
    if (any(upright)) {
        upright = both(le(abs(f.ux) + abs(f.uy), -1e-15f * f.uz), lt(f.uz, set(0.0f)));
        f.max_pdf = select(upright, set(0.0f), f.max_pdf);
    }
    return f;
}

/* A normal that a frame draws: unit, and its density per steradian. */
typedef struct surface_sample {
    real x, y, z, pdf;
} surface_sample;

/* Clamps a density to normal floats: it is 0 only where nothing is visible. */
KERNEL real frame_density(frame f, real density)
{
    return min(max(density, set(1.17549435e-38f)), f.max_pdf);
}

KERNEL triple triple_times(triple w, real k)
{
    const triple t = {w.x * k, w.y * k, w.z * k};
    return t;
}

/* 1, or for a length outside [low, high] that is not 0 the power of two that makes it about 1. */
KERNEL real triple_scale(triple w, real low, real high)
{
    real longest = max(max(abs(w.x), abs(w.y)), abs(w.z));
    mask odd = either(both(lt(set(0.0f), longest), lt(longest, low)), lt(high, longest));
    return select(odd, inverse_scale(longest), set(1.0f));
}

/* Turns n, about 1 long, to wi where rounding may have turned it away: wi . wm exceeds what three more roundings may
 * take. The way is that of wi across z, or its own from above: where this is short, n becomes short too. */
KERNEL triple triple_turned_back(triple wi, triple n)
{
    real a = wi.x * n.x, b = wi.y * n.y, c = wi.z * n.z;
    real tiny = 1e-12f * max(max(abs(n.x), abs(n.y)), n.z); /* all terms may be 0 */
    real lack = 3e-7f * (abs(a) + abs(b) + abs(c)) + tiny - (a + b + c);
    triple way = {wi.x, wi.y, max(wi.z, set(0.0f))};
    real k = triple_scale(way, set(1e-10f), set(1e10f)), per = 1.0f / k;
    way = triple_times(way, k);
    real turn_by = lack / ((way.x * way.x + way.y * way.y) + (way.z * way.z + 1e-30f));
    mask away = lt(set(0.0f), lack); /* not by a turn of 0: that would make -0 of 0 */
    triple m = {select(away, n.x * per + turn_by * way.x, n.x), select(away, n.y * per + turn_by * way.y, n.y),
                select(away, n.z * per + turn_by * way.z, n.z)};
    return m;
}

/* A normal that may be turned away, and with its factor of the density those whose squares are no floats. */
KERNEL normal_sample frame_turned_back(frame f, normal_sample n)
{
    triple w = {n.x, n.y, n.z}, wi = {f.wx, f.wy, f.wz};
    real k = triple_scale(w, set(1e-17f), set(1e17f)), per = 1.0f / k;
    w = triple_turned_back(triple_times(wi, triple_scale(wi, set(1e-2f), set(1e2f))), triple_times(w, k));
    w = triple_times(w, triple_scale(w, set(1e-17f), set(1e17f)));
    const normal_sample m = {w.x, w.y, w.z, n.density * per * per * per};
    return m;
}

/* Maps a normal of the unit problem to the surface, with its density. If rounding turned it away from wi, it
 * is turned back, and both are of the corrected normal. */
KERNEL surface_sample frame_sampled(frame f, normal_sample n)
{
    affine_map m = f.m;
    normal_sample w = {m.xx * n.x, m.yy * n.y, n.z, n.density};
    if (m.is_diagonal == 0) {
        w.x = (w.x - (0.0f - m.xy * n.y)) - (0.0f + m.mean_x * n.z);
        w.y = (w.y - (0.0f - m.yx * n.x)) - (0.0f + m.mean_y * n.z);
    }
    real square = (w.x * w.x + w.y * w.y) + w.z * w.z, reach = sqrt(square);
    mask close = le((f.wx * w.x + f.wy * w.y) + f.wz * w.z, f.flip_cosine * (reach + 2e-11f));
    if (any(close)) {
        normal_sample turned = frame_turned_back(f, w);
        w.x = select(close, turned.x, w.x);
        w.y = select(close, turned.y, w.y);
        w.z = select(close, turned.z, w.z);
        w.density = select(close, turned.density, w.density);
        square = (w.x * w.x + w.y * w.y) + w.z * w.z;
        reach = sqrt(square);
    }
    real per = reach * (1.0f / square);
    surface_sample s = {w.x * per, w.y * per, w.z * per,
                        frame_density(f, (w.density * reach) * (square / f.determinant))};
    return s;
}

/* A unit normal of the surface in the unit problem, and facing = (ux, uy, uz) . n. */
typedef struct unit_normal {
    real x, y, z, facing;
} unit_normal;

KERNEL unit_normal frame_normal(frame f, real x, real y, real z)
{
    affine_map m = f.m;
    real along = m.yy * x, aside = m.xx * y;
    if (m.is_diagonal == 0) {
        real a = x + m.mean_x * z, b = y + m.mean_y * z;
        along = m.yy * a;
        aside = m.xx * b;
        mask sheared = lt(set(0.0f), abs(m.xy) + abs(m.yx));
        if (any(sheared)) { /* which takes all the digits of products */
            along = select(sheared, difference_of_products(m.yy, a, m.xy, b), along);
            aside = select(sheared, difference_of_products(m.xx, b, m.yx, a), aside);
        }
    }
    real per = 1.0f / m.determinant;
    unit_normal n = {along * per, aside * per, z, ((f.wx * x + f.wy * y) + f.wz * z) * f.scale};
    return n;
}

/* Smith's Lambda and G1 of a direction with this area, whose projection on the mean plane is `cosine`. */
KERNEL real lambda_of(real area, real cosine)
{
    mask nothing = both(le(area, set(0.0f)), le(abs(cosine), set(0.0f)));
    real lambda = (max(area, cosine) - cosine) / cosine, end = set(3.4028234e38f);
    return select(nothing, set(0.0f), min(max(lambda, -end), end));
}

KERNEL real g1_of(real area, real cosine)
{
    real part = min(cosine / max(area, cosine), set(1.0f));
    return select(lt(set(0.0f), cosine), part, set(0.0f));
}

/* ---- a table on a surface ---- */

/* The azimuth of the stretched direction, and (s, 0, c) and rho of law.h. */
typedef struct table_direction {
    real ex, ey, s, c, rho;
    real square, under; /* rho^2 as two parts, by which its cell is found */
} table_direction;

KERNEL table_direction table_direction_of(frame f)
{
    table_direction w;
    w.square = f.uz * f.uz;
    w.under = f.ux * f.ux + f.uy * f.uy;
    real across = sqrt(w.under), level = abs(f.uz);
    mask straight = le(across, 1e-15f * level);
    across = max(across, 1e-15f * level);
    real over = 1.0f / across, per = 1.0f / (across + level);
    w.ex = f.ux * over;
    w.ey = f.uy * over;
    if (any(straight)) {
        w.ex = select(straight, set(1.0f), w.ex);
        w.ey = select(straight, set(0.0f), w.ey);
    }
    w.s = across * per;
    w.c = f.uz * per;
    w.rho = level * over;
    return w;
}

typedef struct table_view {
    real ex, ey;
    radial_law v;
} table_view;

/* `below` is known: w is below the horizon in all lanes, or in none. */
KERNEL table_view table_view_of(table t, frame f, const int below)
{
    table_direction w = table_direction_of(f);
    table_view view;
    view.ex = w.ex;
    view.ey = w.ey;
    if (below)
        view.v = law_see_below(t, w.s, w.c, w.rho, find_knot(t, w.square, w.under));
    else
        view.v = law_see_above(t, w.s, w.c, w.rho);
    return view;
}

KERNEL normal_sample table_turned(real ex, real ey, normal_sample n)
{
    normal_sample turned = {ex * n.x - ey * n.y, ey * n.x + ex * n.y, n.z, n.density};
    return turned;
}

/* L1 length of the stretched direction: n.facing over it is (s, 0, c) . n with s + |c| = 1. */
KERNEL real frame_reach(frame f)
{
    return sqrt(f.ux * f.ux + f.uy * f.uy) + abs(f.uz);
}

#endif
