/* The steps of a table put together: a sample, a density, an inverse, all normals. */
#ifndef VNDF_KERNEL_SAMPLE_H
#define VNDF_KERNEL_SAMPLE_H

#include "kernel/draw.h"
#include "kernel/normals.h"
#include "kernel/surface.h"

/* A drawn normal, and the visible density over the density as drawn. */
typedef struct weighted_sample {
    normal_sample n;
    real weight;
} weighted_sample;

/* A visible normal, with its weight if that is asked for, else 1. */
KERNEL weighted_sample table_draw_weighed(table t, table_view view, real u1, real u2, const int below,
                                          const int weigh)
{
    target a = table_aim(view.v, u2, below);
    knot_hit at = table_find(t, view.v, a, below);
    cell_hit f = table_cell(t, view.v, a, at, below);
    cell_place in = law_invert(f.at, f.before);
    length_sample d = table_length(t, view.v, f, in, below);
    arc k = table_arc(view.v, d.r, below);
    weighted_sample s;
    s.weight = set(1.0f);
    if (weigh)
        s.weight = table_weight(t, view.v, at.i, f, in, d.r, k, law_area(t, view.v, below), below);
    s.n = table_turned(view.ex, view.ey, table_normal(view.v, d, k, arc_draw(k, u1, below)));
    return s;
}

KERNEL normal_sample table_draw(table t, table_view view, real u1, real u2, const int below)
{
    weighted_sample s = table_draw_weighed(t, view, u1, u2, below, 0);
    return s.n;
}

/* A normal of the unit problem in the frame of the direction. */
KERNEL unit_normal table_unturned(real ex, real ey, unit_normal n)
{
    unit_normal m = {ex * n.x + ey * n.y, ex * n.y - ey * n.x, n.z, n.facing};
    return m;
}

/* K of a given normal (math.h); `reach` is frame_reach. */
KERNEL real table_pdf(table t, table_view view, unit_normal n, real reach, const int below)
{
    return table_density(t, view.v, table_given(t, n.x, n.y, n.z), n.facing / reach, below);
}

KERNEL pair table_numbers(table t, table_view view, unit_normal n, const int below)
{
    unit_normal m = table_unturned(view.ex, view.ey, n);
    return table_invert(t, view.v, table_given(t, m.x, m.y, m.z), m.x, m.y, below);
}

/* ---- all normals ---- */

/* A slope length of all normals, from a view straight from above. */
KERNEL any_slope table_slope(table t, table_view straight, real u2)
{
    target a = table_aim(straight.v, u2, 0);
    knot_hit at = table_find(t, straight.v, a, 0);
    cell_hit f = table_cell(t, straight.v, a, at, 0);
    length_sample d = table_length(t, straight.v, f, law_invert(f.at, f.before), 0);
    any_slope r = {d.r.x, d.r.z, d.density * 0.159154943f};
    return r;
}

#endif
