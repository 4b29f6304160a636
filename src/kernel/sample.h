/* The steps of a table put together: a sample, a density, an inverse, all normals and bounded normals. */
#ifndef VNDF_KERNEL_SAMPLE_H
#define VNDF_KERNEL_SAMPLE_H

#include "kernel/draw.h"
#include "kernel/normals.h"
#include "kernel/surface.h"

/* A drawn normal, and the visible density over the density as drawn. */
typedef struct weighed {
    drawn n;
    real weight;
} weighed;

HERE drawn table_draw(table t, table_view view, real u1, real u2, const int below)
{
    aim a = table_aim(view.v, u2, below);
    reached at = table_find(t, view.v, a, below);
    found f = table_cell(t, view.v, a, at, below);
    drawn_length d = table_length(t, view.v, f, law_invert(f.at, f.before), below);
    arc k = table_arc(view.v, d.r, below);
    return table_turned(view.ex, view.ey, table_normal(view.v, d, k, arc_draw(k, u1, below)));
}

HERE weighed table_draw_weighed(table t, table_view view, real u1, real u2, const int below)
{
    aim a = table_aim(view.v, u2, below);
    reached at = table_find(t, view.v, a, below);
    found f = table_cell(t, view.v, a, at, below);
    place in = law_invert(f.at, f.before);
    drawn_length d = table_length(t, view.v, f, in, below);
    arc k = table_arc(view.v, d.r, below);
    weighed s;
    s.weight = table_weight(t, view.v, at.i, f, in, d.r, k, law_area(t, view.v, below), below);
    s.n = table_turned(view.ex, view.ey, table_normal(view.v, d, k, arc_draw(k, u1, below)));
    return s;
}

/* A normal of the unit problem in the frame of the direction. */
HERE unit_normal table_unturned(real ex, real ey, unit_normal n)
{
    unit_normal m = {ex * n.x + ey * n.y, ex * n.y - ey * n.x, n.z, n.facing};
    return m;
}

/* K of a given normal (math.h); `reach` is frame_reach. */
HERE real table_pdf(table t, table_view view, unit_normal n, real reach, const int below)
{
    return table_density(t, view.v, table_given(t, n.x, n.y, n.z), n.facing / reach, below);
}

HERE pair table_numbers(table t, table_view view, unit_normal n, const int below)
{
    unit_normal m = table_unturned(view.ex, view.ey, n);
    return table_invert(t, view.v, table_given(t, m.x, m.y, m.z), m.x, m.y, below);
}

/* ---- all normals ---- */

/* A slope length of all normals, from a view straight from above. */
HERE any_slope table_slope(table t, table_view straight, real u2)
{
    aim a = table_aim(straight.v, u2, 0);
    reached at = table_find(t, straight.v, a, 0);
    found f = table_cell(t, straight.v, a, at, 0);
    drawn_length d = table_length(t, straight.v, f, law_invert(f.at, f.before), 0);
    any_slope r = {d.r.x, d.r.z, d.density * 0.159154943f};
    return r;
}

/* ---- bounded normals ----
 *
 * With the same roughness along and across, alpha, a normal at slope length alpha R and azimuth a reflects wi to above
 * the horizon where cos a > b = (alpha^2 R^2 - 1)/(2 alpha R tan(theta)): everywhere where b < -1, nowhere where b > 1,
 * which is where alpha R exceeds (1 + sin(theta))/cos(theta). So u2 is multiplied by the part of the law up to there,
 * and the arc is shortened. */

/* The cosine b. s and c are those of the view: tan(theta) is slant = s/(alpha c). */
HERE real bounded_cosine(real alpha, real slant, real x, real z)
{
    real r = alpha * x;
    return ((r - z) * (r + z)) / most(2.0f * (r * z) * slant, set(1e-37f));
}

/* The part of half the arc that is not bounded away, from the azimuth of wi on. */
HERE real bounded_arc(arc k, real b)
{
    real cosine = least(most(b, set(-1.0f)), set(1.0f)),
         sine = root(most((1.0f - cosine) * (1.0f + cosine), set(0.0f)));
    real u = arc_invert(k, cosine, sine); /* from 1/2 towards wi to 1 behind it */
    return least(most(2.0f * (u - 0.5f), set(1e-6f)), set(1.0f));
}

/* The part of the law of the slope length up to the largest that reflects upwards. */
HERE real table_bounded_part(table t, table_view view, real alpha, real slant)
{
    real steep = slant + root(1.0f + slant * slant), per = 1.0f / (steep + alpha);
    given g = table_given(t, steep, set(0.0f), alpha);
    pair u = table_invert(t, view.v, g, steep * per, set(0.0f), 0);
    return most(u.b, set(1e-6f));
}

typedef struct bounded_normal {
    drawn n;
    real inside; /* the part of the visible normals of its slope length, and of all lengths, that is kept */
} bounded_normal;

HERE bounded_normal table_draw_bounded(table t, table_view view, real alpha, real slant, real part, real u1,
                                       real u2)
{
    aim a = table_aim(view.v, u2 * part, 0);
    reached at = table_find(t, view.v, a, 0);
    found f = table_cell(t, view.v, a, at, 0);
    drawn_length d = table_length(t, view.v, f, law_invert(f.at, f.before), 0);
    arc k = table_arc(view.v, d.r, 0);
    real arc_part = bounded_arc(k, bounded_cosine(alpha, slant, d.r.x, d.r.z));
    bounded_normal s;
    s.inside = part * arc_part;
    s.n =
        table_turned(view.ex, view.ey, table_normal(view.v, d, k, arc_draw(k, 0.5f + (u1 - 0.5f) * arc_part, 0)));
    s.n.density = s.n.density / s.inside;
    return s;
}

HERE real table_bounded_inside(table t, table_view view, real alpha, real slant, real part, unit_normal n)
{
    given g = table_given(t, n.x, n.y, n.z);
    return part * bounded_arc(table_given_arc(view.v, g, 0), bounded_cosine(alpha, slant, g.x, g.z));
}

#endif
