/* Batches in lanes: compiled once for each instruction set, with VNDF_LANES numbers side by side.
 *
 * A call goes block by block, and a block through the steps of the kernel, each a short loop, since a processor
 * overlaps few iterations of a long one. Where a table is seen from both sides of the horizon, the elements of each
 * side are put together. Elements that are not valid go with the others, as no lane reads another, and get their
 * result at the end. */
#ifndef VNDF_LANES
#define VNDF_LANES 4
#endif
#if defined(__GNUC__)

#include "kernel/lanes.h"

#include "kernel/beckmann.h"
#include "kernel/ggx.h"
#include "kernel/sample.h"
#include "sampler/batch/call.h"

enum { BLOCK = VNDF_BLOCK, GROUPS = BLOCK / LANES };

/* Steps are not to be inlined into one large function: each has its own part of the stack. */
#define STEP static __attribute__((noinline))

typedef float row[BLOCK] __attribute__((aligned(4 * VNDF_LANES)));

/* Up to BLOCK elements of a call: where their inputs lie, readable to the last lane, and where results go. */
typedef struct block {
    vndf_task task;
    vndf_kind kind;
    float unit;
    table t;
    int groups, is_diagonal;        /* is_diagonal: all its surfaces are (kernel/surface.h) */
    uint64_t below;                 /* from which elements a table is seen from below, bit by bit */
    int varied, varies[VNDF_READS]; /* inputs of which each element has its own */
    const float *read[VNDF_READS];
    float *write[VNDF_WRITES];
} block;

KERNEL real input(const block *b, int which, int g)
{
    return load(b->read[which] + g * LANES);
}

KERNEL real unit_input(const block *b, int which, int g)
{
    return unit_number(input(b, which, g));
}

KERNEL void put(const block *b, int which, int g, real x)
{
    store(b->write[which] + g * LANES, x);
}

/* A matrix in units of the distribution's slopes. */
KERNEL affine_map map_at(const block *b, int g, const int is_diagonal)
{
    const real zero = set(0.0f);
    affine_map m = {input(b, VNDF_READ_XX, g) * b->unit,
                    zero,
                    zero,
                    input(b, VNDF_READ_YY, g) * b->unit,
                    zero,
                    zero,
                    is_diagonal,
                    zero};
    if (!is_diagonal) {
        m.xy = input(b, VNDF_READ_XY, g) * b->unit;
        m.yx = input(b, VNDF_READ_YX, g) * b->unit;
        m.mean_x = input(b, VNDF_READ_MEAN_X, g);
        m.mean_y = input(b, VNDF_READ_MEAN_Y, g);
    }
    return affine_measured(m);
}

KERNEL frame frame_at(const block *b, int g, const int is_diagonal)
{
    return frame_of(map_at(b, g, is_diagonal), input(b, VNDF_READ_WI_X, g), input(b, VNDF_READ_WI_Y, g),
                    input(b, VNDF_READ_WI_Z, g));
}

/* ---- searches ---- */

/* The knot of entry `at` of a step of searches. */
KERNEL integer knot_of(table t, integer at, int level)
{
    return (at + at + (1 - (2 << level))) * (t.stride << (t.levels - level - 1));
}

/* A slope length by the squares of its two parts, and its cell: an entry while steps go on. */
typedef struct slope_query {
    real square, under;
    integer cell;
} slope_query;

KERNEL integer step_slope(table t, slope_query q, int level)
{
    return follow(q.cell, le(level_entry(t, VNDF_AT_KNOT, q.cell, level) * q.under, q.square));
}

KERNEL void find_slopes(table t, int groups, slope_query *q)
{
    for (int g = 0; g < groups; g++) {
        q[g].cell = set_int(1);
        LANES_UNROLLED
        for (int level = 0; level < FIRST_LEVELS; level++)
            q[g].cell = step_slope(t, q[g], level);
    }
    LANES_UNROLLED
    for (int level = FIRST_LEVELS; level < LEVELS; level++)
        for (int g = 0; level < t.levels && g < groups; g++)
            q[g].cell = step_slope(t, q[g], level);
    for (int g = 0; g < groups; g++)
        q[g].cell = (q[g].cell - set_int(1 << t.levels)) * set_int(t.stride);
    for (int step = t.stride / 2; step > 0; step /= 2)
        for (int g = 0; g < groups; g++) {
            integer next = min_int(q[g].cell + step, set_int(t.cells));
            real r = load_knot(t, next).r;
            q[g].cell = select_int(le((r * r) * q[g].under, q[g].square), next, q[g].cell);
        }
}

/* law_sum, whose fourth term is 0 for fewer moments. */
KERNEL real sum_beyond(table t, weights w, tail_row tail)
{
    real far = w.wq * tail.over;
    if (t.moments > 3)
        far = far + w.w4 * tail.over4;
    return (w.w1 * tail.along + w.w0 * tail.all) + far;
}

/* One step of a search for the cell of a sample. */
KERNEL knot_hit step_cell(table t, radial_law v, target a, knot_hit r, int level, const int below)
{
    tail_row tail = {set(0.0f), set(0.0f), set(0.0f), set(0.0f)};
    area_row low = {set(0.0f), set(0.0f), set(0.0f), set(0.0f)};
    real beyond;
    mask passes;
    tail.over = level_entry(t, VNDF_AT_TQ, r.i, level);
    if (below) {
        real knot = level_entry(t, VNDF_AT_R, r.i, level);
        low.t1 = level_entry(t, VNDF_AT_N1, r.i, level);
        low.t2 = level_entry(t, VNDF_AT_N2, r.i, level);
        beyond = law_sum_below(v.w, knot, max(knot - v.rho, set(0.0f)), tail, low);
        passes = law_passes(t, v, knot_of(t, r.i, level), beyond, a.left);
    } else {
        tail.along = level_entry(t, VNDF_AT_T1, r.i, level);
        tail.all = level_entry(t, VNDF_AT_T0, r.i, level);
        if (t.moments > 3)
            tail.over4 = level_entry(t, VNDF_AT_T4, r.i, level);
        beyond = sum_beyond(t, a.w, tail);
        passes = le(a.left, beyond);
    }
    r.i = follow(r.i, passes);
    r.beyond = select(passes, beyond, r.beyond);
    return r;
}

/* The same by rows: r.i is a knot. */
KERNEL knot_hit step_rows(table t, radial_law v, target a, knot_hit r, int step, const int below)
{
    integer next = r.i + step, there = min_int(next, set_int(t.cells));
    real beyond = below ? law_beyond(t, v, there) : sum_beyond(t, a.w, load_tail(t, there));
    mask passes = below ? law_passes(t, v, next, beyond, a.left) : le(a.left, beyond);
    r.i = select_int(passes, there, r.i);
    r.beyond = select(passes, beyond, r.beyond);
    return r;
}

/* Cells of samples. */
KERNEL void find_cells(table t, int groups, const radial_law *v, const target *a, knot_hit *r, const int below)
{
    for (int g = 0; g < groups; g++) {
        knot_hit at = {set_int(1), set(0.0f)};
        LANES_UNROLLED
        for (int level = 0; level < FIRST_LEVELS; level++)
            at = step_cell(t, v[g], a[g], at, level, below);
        r[g] = at;
    }
    LANES_UNROLLED
    for (int level = FIRST_LEVELS; level < LEVELS; level++)
        for (int g = 0; level < t.levels && g < groups; g++)
            r[g] = step_cell(t, v[g], a[g], r[g], level, below);
    for (int g = 0; g < groups; g++)
        r[g].i = (r[g].i - set_int(1 << t.levels)) * set_int(t.stride);
    for (int step = t.stride / 2; step > 0; step /= 2)
        for (int g = 0; g < groups; g++)
            r[g] = step_rows(t, v[g], a[g], r[g], step, below);
}

/* ---- tables ---- */

/* How a table sees directions. */
KERNEL void see(table t, int groups, const table_direction *w, radial_law *v, const int below)
{
    slope_query q[GROUPS];
    for (int g = 0; below && g < groups; g++) /* of elements that are not valid: not beyond the ends of searches */
        q[g] = (slope_query){min(w[g].square, set(3.4028234e38f)), w[g].under, set_int(0)};
    if (below)
        find_slopes(t, groups, q);
    for (int g = 0; g < groups; g++)
        v[g] = below ? law_see_below(t, w[g].s, w[g].c, w[g].rho, q[g].cell)
                     : law_see_above(t, w[g].s, w[g].c, w[g].rho);
}

/* Areas of what is seen. */
KERNEL void find_areas(table t, int groups, const radial_law *v, real *area, const int below)
{
    slope_query q[GROUPS];
    for (int g = 0; g < groups; g++)
        q[g] = (slope_query){v[g].rho * v[g].rho, set(1.0f), set_int(0)};
    find_slopes(t, groups, q);
    for (int g = 0; g < groups; g++)
        area[g] = law_area_in(t, v[g], q[g].cell, below);
}

/* The given normals, with their cells. */
KERNEL void place_given(table t, int groups, const unit_normal *n, query *at)
{
    slope_query q[GROUPS];
    for (int g = 0; g < groups; g++) {
        at[g] = table_given_slope(n[g].x, n[g].y, n[g].z);
        q[g] = (slope_query){at[g].square, at[g].under, set_int(0)};
    }
    find_slopes(t, groups, q);
    for (int g = 0; g < groups; g++)
        at[g].cell = q[g].cell;
}

/* Normals in the frames of their directions, with K, and their weights. */
KERNEL void draw_side(const block *b, table_direction *w, normal_sample *n, real *weight, const int weigh,
                      const int below)
{
    const table t = b->t;
    const int groups = b->groups;
    radial_law v[GROUPS];
    knot_hit r[GROUPS];
    cell_hit f[GROUPS];
    length_sample d[GROUPS];
    arc k[GROUPS];
    real start[GROUPS];
    see(t, groups, w, v, below);
    {
        target a[GROUPS]; /* whose room the next steps have */
        for (int g = 0; g < groups; g++)
            a[g] = table_aim(v[g], unit_input(b, VNDF_READ_B, g), below);
        find_cells(t, groups, v, a, r, below);
        for (int g = 0; g < groups; g++)
            f[g] = table_cell(t, v[g], a[g], r[g], below);
    }
    for (int g = 0; g < groups; g++)
        d[g] = table_length(t, v[g], f[g], law_invert(f[g].at, f[g].before), below);
    for (int g = 0; g < groups; g++)
        k[g] = table_arc(v[g], d[g].r, below);
    for (int g = 0; g < groups; g++)
        start[g] = arc_start(k[g], arc_half(unit_input(b, VNDF_READ_A, g)), below);
    for (int g = 0; g < groups; g++) {
        real u = unit_input(b, VNDF_READ_A, g);
        azimuth turned = arc_side(arc_step(k[g], start[g], arc_half(u) * k[g].mass), u);
        n[g] = table_normal(v[g], d[g], k[g], turned);
    }
    if (!weigh)
        return;
    real *const area = start;
    find_areas(t, groups, v, area, below);
    for (int g = 0; g < groups; g++) {
        cell_place in = law_invert(f[g].at, f[g].before);
        weight[g] = table_weight(t, v[g], r[g].i, f[g], in, d[g].r, k[g], area[g], below);
    }
}

STEP void draw(const block *b, table_direction *w, normal_sample *n, real *weight, const int weigh)
{
    if (b->below)
        draw_side(b, w, n, weight, weigh, 1);
    else
        draw_side(b, w, n, weight, weigh, 0);
}

/* The densities of given normals, whose `facing` is over the reach of the direction. */
STEP void densities(const block *b, table_direction *w, unit_normal *n, real *density)
{
    const int below = b->below != 0;
    radial_law v[GROUPS];
    query at[GROUPS];
    see(b->t, b->groups, w, v, below);
    place_given(b->t, b->groups, n, at);
    for (int g = 0; g < b->groups; g++)
        density[g] = table_density(b->t, v[g], at[g], n[g].facing, below);
}

STEP void table_areas(const block *b, table_direction *w, real *area)
{
    const int below = b->below != 0;
    radial_law v[GROUPS];
    see(b->t, b->groups, w, v, below);
    if (b->task != VNDF_TASK_DRAWN_AREA)
        find_areas(b->t, b->groups, v, area, below);
    for (int g = 0; b->task == VNDF_TASK_DRAWN_AREA && g < b->groups; g++)
        area[g] = law_drawn_area(v[g], below);
}

/* D times the determinant of given normals. */
STEP void p22_table(const block *b, unit_normal *n, real *p22)
{
    query at[GROUPS];
    place_given(b->t, b->groups, n, at);
    for (int g = 0; g < b->groups; g++)
        p22[g] = table_p22(b->t, at[g]);
}

/* ---- tasks, of which the compiler knows the kind of distribution ---- */

/* A bit for each of `count` elements, at least 1. */
KERNEL uint64_t first_bits(int count)
{
    return ~(uint64_t)0 >> (BLOCK - count);
}

KERNEL uint64_t below_bits(int g, frame f)
{
    return (uint64_t)mask_bits(lt(f.uz, set(0.0f))) << g * LANES;
}

/* Whether a block is on one side of the horizon: else nothing of it is written. */
KERNEL int is_one_side(const block *b)
{
    return b->below == 0 || b->below == first_bits(b->groups * LANES);
}

/* Which elements of a group are valid. */
KERNEL mask valid_at(const block *b, int g, affine_map m)
{
    mask valid = affine_is_valid(m);
    if (b->task != VNDF_TASK_NDF)
        valid = both(valid, direction_is_valid(input(b, VNDF_READ_WI_X, g), input(b, VNDF_READ_WI_Y, g),
                                               input(b, VNDF_READ_WI_Z, g)));
    return valid;
}

/* Of frames, what is needed to the end: the matrix is read again. */
typedef struct kept_frame {
    real wx, wy, wz, max_pdf, flip_cosine;
    mask valid;
} kept_frame;

KERNEL void put_sample(const block *b, int g, kept_frame k, const int is_diagonal, normal_sample n, real weight)
{
    const real zero = set(0.0f), one = set(1.0f);
    affine_map m = map_at(b, g, is_diagonal);
    const frame f = {m, k.wx, k.wy, k.wz, zero, zero, one, one, one, abs(m.determinant), k.max_pdf, k.flip_cosine};
    surface_sample s = frame_sampled(f, n);
    if (any((mask)~k.valid)) {
        s = (surface_sample){select(k.valid, s.x, zero), select(k.valid, s.y, zero), select(k.valid, s.z, one),
                             select(k.valid, s.pdf, zero)};
        weight = select(k.valid, weight, zero);
    }
    put(b, 0, g, s.x);
    put(b, 1, g, s.y);
    put(b, 2, g, s.z);
    if (b->write[3])
        put(b, 3, g, s.pdf);
    if (b->write[4])
        put(b, 4, g, weight);
}

KERNEL void sample(block *b, const vndf_kind kind, const int is_diagonal)
{
    kept_frame at[GROUPS];
    table_direction w[GROUPS];
    ggx_view caps[GROUPS];
    beckmann_view laws[GROUPS];
    beckmann_place p[GROUPS];
    normal_sample n[GROUPS];
    real weight[GROUPS], y[GROUPS];
    uint64_t below = 0;
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, is_diagonal);
        at[g] = (kept_frame){f.wx, f.wy, f.wz, f.max_pdf, f.flip_cosine, valid_at(b, g, f.m)};
        below |= below_bits(g, f);
        if (kind == VNDF_KIND_TABLE)
            w[g] = table_direction_of(f);
        else if (kind == VNDF_KIND_GGX)
            caps[g] = ggx_see(f.ux, f.uy, f.uz);
        else
            laws[g].law = beckmann_toward(f.ux, f.uy, f.uz);
    }
    if (kind == VNDF_KIND_TABLE) {
        b->below = below;
        if (!is_one_side(b))
            return;
        draw(b, w, n, weight, b->write[4] != NULL);
    } else if (kind == VNDF_KIND_BECKMANN) {
        for (int g = 0; g < b->groups; g++)
            laws[g] = beckmann_view_of(laws[g].law);
        for (int g = 0; g < b->groups; g++)
            p[g] = beckmann_start(laws[g], unit_input(b, VNDF_READ_A, g));
        for (int g = 0; g < b->groups; g++)
            p[g] = beckmann_step(laws[g].law, p[g], unit_input(b, VNDF_READ_A, g));
        for (int g = 0; g < b->groups; g++)
            y[g] = erf_quantile(unit_input(b, VNDF_READ_B, g));
        for (int g = 0; g < b->groups; g++)
            n[g] = beckmann_normal(laws[g], p[g], y[g]);
    } else
        for (int g = 0; g < b->groups; g++)
            n[g] = ggx_draw(caps[g], unit_input(b, VNDF_READ_A, g), unit_input(b, VNDF_READ_B, g));
    for (int g = 0; g < b->groups; g++) {
        if (kind == VNDF_KIND_TABLE)
            n[g] = table_turned(w[g].ex, w[g].ey, n[g]);
        put_sample(b, g, at[g], is_diagonal, n[g], kind == VNDF_KIND_TABLE && b->write[4] ? weight[g] : set(1.0f));
    }
}

/* The normal of a group in the unit problem, seen or not. */
KERNEL unit_normal normal_at(const block *b, int g, frame f)
{
    return frame_normal(f, input(b, VNDF_READ_A, g), input(b, VNDF_READ_B, g), input(b, VNDF_READ_C, g));
}

/* A density with which a normal is drawn or seen, over the determinant of the surface. */
KERNEL void put_density(const block *b, int g, frame f, real facing, real density)
{
    mask is_seen = both(le(set(0.0f), input(b, VNDF_READ_C, g)), lt(set(0.0f), facing));
    put(b, 0, g, select(both(is_seen, valid_at(b, g, f.m)), frame_density(f, density), set(0.0f)));
}

/* The drawn density, or the visible one; for closed forms they are the same. */
KERNEL void density(block *b, const vndf_kind kind)
{
    const int visible = b->task == VNDF_TASK_VISIBLE;
    table_direction w[GROUPS];
    unit_normal n[GROUPS];
    real facing[GROUPS], reach[GROUPS], value[GROUPS], p22[GROUPS];
    uint64_t below = 0;
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, b->is_diagonal);
        n[g] = normal_at(b, g, f);
        below |= below_bits(g, f);
        if (kind == VNDF_KIND_TABLE) {
            w[g] = table_direction_of(f);
            facing[g] = n[g].facing;
            reach[g] = frame_reach(f);
            n[g].facing = n[g].facing / reach[g];
        } else {
            value[g] = kind == VNDF_KIND_GGX
                           ? ggx_density(ggx_see(f.ux, f.uy, f.uz), n[g].x, n[g].y, n[g].z, n[g].facing)
                           : beckmann_density(beckmann_see(f.ux, f.uy, f.uz), n[g].x, n[g].y, n[g].z, n[g].facing);
            put_density(b, g, f, n[g].facing, value[g] / f.determinant);
        }
    }
    b->below = kind == VNDF_KIND_TABLE ? below : 0;
    if (kind != VNDF_KIND_TABLE || !is_one_side(b))
        return;
    for (int g = 0; b->below && !visible && g < b->groups; g++)
        n[g] = table_unturned(w[g].ex, w[g].ey, n[g]);
    if (visible) {
        table_areas(b, w, value);
        p22_table(b, n, p22);
    } else
        densities(b, w, n, value);
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, b->is_diagonal);
        real k = visible ? p22[g] / f.determinant * (facing[g] / max(value[g] * reach[g], set(1e-37f)))
                         : value[g] / f.determinant;
        put_density(b, g, f, facing[g], k);
    }
}

KERNEL void ndf(const block *b, const vndf_kind kind)
{
    unit_normal n[GROUPS];
    real p22[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        n[g] = normal_at(b, g, frame_of(map_at(b, g, b->is_diagonal), set(0.0f), set(0.0f), set(1.0f)));
        if (kind == VNDF_KIND_GGX)
            p22[g] = ggx_p22(n[g].x, n[g].y, n[g].z);
        else if (kind == VNDF_KIND_BECKMANN)
            p22[g] = beckmann_p22(n[g].x, n[g].y, n[g].z);
    }
    if (kind == VNDF_KIND_TABLE)
        p22_table(b, n, p22);
    for (int g = 0; g < b->groups; g++) {
        affine_map m = map_at(b, g, b->is_diagonal);
        mask is_seen = both(le(set(0.0f), input(b, VNDF_READ_C, g)), valid_at(b, g, m));
        put(b, 0, g, select(is_seen, min(p22[g] / abs(m.determinant), set(3.40282347e38f)), set(0.0f)));
    }
}

/* An area of the unit problem as the task wants it. */
KERNEL void put_area(const block *b, int g, frame f, real area)
{
    real all = area * f.size, cosine = f.uz * f.size;
    mask valid = valid_at(b, g, f.m);
    if (b->task == VNDF_TASK_DRAWN_AREA)
        all = select(lt(set(0.0f), f.max_pdf), all, set(0.0f));
    if (b->task == VNDF_TASK_LAMBDA)
        all = lambda_of(all, cosine);
    else if (b->task == VNDF_TASK_G1)
        all = g1_of(all, cosine);
    put(b, 0, g, select(valid, all, set(0.0f)));
    if (b->write[1])
        put(b, 1, g, select(valid, set(1.0f), set(0.0f)));
}

KERNEL void areas(block *b, const vndf_kind kind)
{
    table_direction w[GROUPS];
    real area[GROUPS];
    uint64_t below = 0;
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, b->is_diagonal);
        below |= below_bits(g, f);
        if (kind == VNDF_KIND_TABLE)
            w[g] = table_direction_of(f);
        else
            put_area(b, g, f,
                     kind == VNDF_KIND_GGX ? ggx_area(f.ux, f.uy, f.uz) : beckmann_area(f.ux, f.uy, f.uz));
    }
    b->below = kind == VNDF_KIND_TABLE ? below : 0;
    if (kind != VNDF_KIND_TABLE || !is_one_side(b))
        return;
    table_areas(b, w, area);
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, b->is_diagonal);
        put_area(b, g, f, area[g] * frame_reach(f));
    }
}

/* Cosines to the mean plane, of surfaces that are not valid too. */
KERNEL void cosines(const block *b)
{
    for (int g = 0; g < b->groups; g++)
        put(b, 0, g,
            input(b, VNDF_READ_WI_Z, g) - (input(b, VNDF_READ_WI_X, g) * input(b, VNDF_READ_MEAN_X, g) +
                                           input(b, VNDF_READ_WI_Y, g) * input(b, VNDF_READ_MEAN_Y, g)));
}

KERNEL void block_of(block *b, const vndf_kind kind)
{
    switch (b->task) {
    case VNDF_TASK_SAMPLE:
        if (b->is_diagonal)
            sample(b, kind, 1);
        else
            sample(b, kind, 0);
        break;
    case VNDF_TASK_PDF:
    case VNDF_TASK_VISIBLE: density(b, kind); break;
    case VNDF_TASK_NDF: ndf(b, kind); break;
    case VNDF_TASK_COSINE: cosines(b); break;
    default: areas(b, kind);
    }
}

STEP void run_table(block *b)
{
    block_of(b, VNDF_KIND_TABLE);
}

STEP void run_ggx(block *b)
{
    block_of(b, VNDF_KIND_GGX);
}

STEP void run_beckmann(block *b)
{
    block_of(b, VNDF_KIND_BECKMANN);
}

/* ---- blocks ---- */

/* Numbers that all elements share lie there for the whole call. */
typedef struct copies {
    row read[VNDF_READS], write[VNDF_WRITES];
} copies;

/* Runs the elements `some` of a block of `count`, which is at `first`: in place if all lanes are theirs, else in
 * copies. Results are put back where all are on one side. */
KERNEL void run_elements(block *b, const vndf_call *call, size_t first, int count, uint64_t some, copies *c)
{
    const int in_place = some == first_bits(count) && count % LANES == 0;
    const picks p = picks_of(in_place ? 0 : some);
    b->groups = ((in_place ? count : p.count) + LANES - 1) / LANES;
    for (int k = 0; k < b->varied; k++) {
        const int r = b->varies[k];
        b->read[r] = in_place ? call->read[r] + first : c->read[r];
        if (!in_place)
            pack(call->read[r] + first, &p, c->read[r]);
        for (int i = p.count; !in_place && i % LANES; i++) /* the last one goes on to the last lane */
            c->read[r][i] = c->read[r][p.count - 1];
    }
    for (int w = 0; w < VNDF_WRITES; w++)
        b->write[w] = !call->write[w] ? NULL : in_place ? call->write[w] + first : c->write[w];
    b->below = 0;
    b->kind == VNDF_KIND_TABLE ? run_table(b) : b->kind == VNDF_KIND_GGX ? run_ggx(b) : run_beckmann(b);
    for (int w = 0; !in_place && is_one_side(b) && w < VNDF_WRITES; w++)
        if (call->write[w])
            unpack(c->write[w], &p, call->write[w] + first);
}

/* Runs the elements of each side of a block that was not written. */
STEP void run_sides(block *b, const vndf_call *call, size_t first, int count, uint64_t some, copies *c)
{
    uint64_t below = 0;
    for (uint64_t left = some; left; left &= left - 1, b->below >>= 1)
        below |= b->below & 1 ? left & ~(left - 1) : 0;
    run_elements(b, call, first, count, below, c);
    run_elements(b, call, first, count, some & ~below, c);
}

/* ---- calls ---- */

void VNDF_OF_LANES(vndf_lanes_)(const vndf_call *call)
{
    static const row zeros;
    copies c;
    const vndf_distribution *d = call->distribution;
    block b = {.task = call->task, .kind = d->kind, .unit = d->unit, .is_diagonal = call->is_diagonal};
    if (b.kind == VNDF_KIND_TABLE)
        b.t = table_of(d);
    for (int r = 0; r < VNDF_READS; r++) {
        b.read[r] = call->read[r] ? c.read[r] : zeros;
        if (call->read[r] && !(call->shared >> r & 1))
            b.varies[b.varied++] = r;
        for (int g = 0; call->read[r] && call->shared >> r & 1 && g < GROUPS; g++)
            store(c.read[r] + g * LANES, set(*call->read[r]));
    }
    for (size_t first = 0; first < call->count; first += BLOCK) {
        const int count = call->count - first < BLOCK ? (int)(call->count - first) : BLOCK;
        const uint64_t some = call->which & first_bits(count);
        run_elements(&b, call, first, count, some, &c);
        if (!is_one_side(&b))
            run_sides(&b, call, first, count, some, &c);
    }
}

#endif
