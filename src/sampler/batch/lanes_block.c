/* Batches in lanes: compiled once for each instruction set, with VNDF_LANES numbers side by side.
 *
 * A call goes block by block. The elements of a block are valid and, where a table is seen, on one side of the horizon:
 * where some are not, those of each side are put together first. A block goes through the steps of the kernel, each a
 * short loop, since a processor overlaps few iterations of a long one. */
#ifndef VNDF_LANES
#define VNDF_LANES 4
#endif
#if defined(__GNUC__)

#include "kernel/lanes.h"

#include "kernel/beckmann.h"
#include "kernel/ggx.h"
#include "kernel/sample.h"
#include "sampler/batch/call.h"

#if VNDF_LANES == 4
#  define LANES_ENTRY vndf_lanes_4
#elif VNDF_LANES == 8
#  define LANES_ENTRY vndf_lanes_8
#else
#  define LANES_ENTRY vndf_lanes_16
#endif

enum { BLOCK = 128, GROUPS = BLOCK / LANES };

/* Steps are not to be inlined into one large function: each has its own part of the stack. */
#define STEP static __attribute__((noinline))

typedef float row[BLOCK] __attribute__((aligned(4 * VNDF_LANES)));

/* Up to BLOCK elements of a call: where their inputs lie, readable to the last lane, and where results go; below: a
 * table is seen from below the horizon. */
typedef struct block {
    vndf_task task;
    vndf_kind kind;
    float unit;
    table t;
    int groups, is_diagonal, below; /* is_diagonal: all its surfaces are (kernel/surface.h) */
    const float *read[VNDF_READS];
    float *write[VNDF_WRITES];
} block;

KERNEL real input(const block *b, int which, int g)
{
    return load(b->read[which] + g * LANES);
}

/* Of the numbers u1 and u2: in [0, 1], 0 for NaN. */
KERNEL real unit_input(const block *b, int which, int g)
{
    return min(max(input(b, which, g), set(0.0f)), set(1.0f));
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

/* One step: entries that follow `at`. */
KERNEL integer step_slope(table t, real square, real under, integer at, int level)
{
    return follow(at, le(level_entry(t, VNDF_AT_KNOT, at, level) * under, square));
}

/* The cells of slopes whose squares have these two parts. */
KERNEL void find_slopes(table t, int groups, const real *square, const real *under, integer *i)
{
    for (int g = 0; g < groups; g++) {
        integer at = set_int(1);
        LANES_UNROLLED
        for (int level = 0; level < FIRST_LEVELS; level++)
            at = step_slope(t, square[g], under[g], at, level);
        i[g] = at;
    }
    LANES_UNROLLED
    for (int level = FIRST_LEVELS; level < LEVELS; level++)
        for (int g = 0; level < t.levels && g < groups; g++)
            i[g] = step_slope(t, square[g], under[g], i[g], level);
    for (int g = 0; g < groups; g++)
        i[g] = (i[g] - set_int(1 << t.levels)) * set_int(t.stride);
    for (int step = t.stride / 2; step > 0; step /= 2)
        for (int g = 0; g < groups; g++) {
            integer next = min_int(i[g] + step, set_int(t.cells));
            real r = load_knot(t, next).r;
            i[g] = select_int(le((r * r) * under[g], square[g]), next, i[g]);
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
    integer cell[GROUPS];
    real square[GROUPS], under[GROUPS];
    for (int g = 0; below && g < groups; g++) {
        square[g] = w[g].square;
        under[g] = w[g].under;
    }
    if (below)
        find_slopes(t, groups, square, under, cell);
    for (int g = 0; g < groups; g++)
        v[g] = below ? law_see_below(t, w[g].s, w[g].c, w[g].rho, cell[g])
                     : law_see_above(t, w[g].s, w[g].c, w[g].rho);
}

/* Areas of what is seen. */
KERNEL void find_areas(table t, int groups, const radial_law *v, real *area, const int below)
{
    real square[GROUPS], under[GROUPS];
    integer cell[GROUPS];
    for (int g = 0; g < groups; g++) {
        square[g] = v[g].rho * v[g].rho;
        under[g] = set(1.0f);
    }
    find_slopes(t, groups, square, under, cell);
    for (int g = 0; g < groups; g++)
        area[g] = law_area_in(t, v[g], cell[g], below);
}

/* The given normals, with their cells. */
KERNEL void place_given(table t, int groups, const unit_normal *n, query *at)
{
    real square[GROUPS], under[GROUPS];
    integer cell[GROUPS];
    for (int g = 0; g < groups; g++) {
        at[g] = table_given_slope(n[g].x, n[g].y, n[g].z);
        square[g] = at[g].square;
        under[g] = at[g].under;
    }
    find_slopes(t, groups, square, under, cell);
    for (int g = 0; g < groups; g++)
        at[g].cell = cell[g];
}

/* Normals in the frames of their directions, with K, and their weights. */
KERNEL void draw_side(const block *b, table_direction *w, normal_sample *n, real *weight, const int weigh,
                      const int below)
{
    const table t = b->t;
    const int groups = b->groups;
    radial_law v[GROUPS];
    target a[GROUPS];
    knot_hit r[GROUPS];
    cell_hit f[GROUPS];
    length_sample d[GROUPS];
    arc k[GROUPS];
    real start[GROUPS], area[GROUPS];
    see(t, groups, w, v, below);
    for (int g = 0; g < groups; g++)
        a[g] = table_aim(v[g], unit_input(b, VNDF_READ_B, g), below);
    find_cells(t, groups, v, a, r, below);
    for (int g = 0; g < groups; g++)
        f[g] = table_cell(t, v[g], a[g], r[g], below);
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
    const int below = b->below;
    radial_law v[GROUPS];
    query at[GROUPS];
    see(b->t, b->groups, w, v, below);
    place_given(b->t, b->groups, n, at);
    for (int g = 0; g < b->groups; g++)
        density[g] = table_density(b->t, v[g], at[g], n[g].facing, below);
}

STEP void table_areas(const block *b, table_direction *w, real *area)
{
    const int below = b->below;
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

KERNEL void sample_as(const block *b, const vndf_kind kind, const int is_diagonal)
{
    frame at[GROUPS]; /* what is needed to the end: the matrix is read again */
    table_direction w[GROUPS];
    ggx_view caps[GROUPS];
    beckmann_view laws[GROUPS];
    normal_sample n[GROUPS];
    real weight[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, is_diagonal);
        at[g].wx = f.wx;
        at[g].wy = f.wy;
        at[g].wz = f.wz;
        at[g].determinant = f.determinant;
        at[g].max_pdf = f.max_pdf;
        at[g].flip_cosine = f.flip_cosine;
        if (kind == VNDF_KIND_TABLE)
            w[g] = table_direction_of(f);
        else if (kind == VNDF_KIND_GGX)
            caps[g] = ggx_see(f.ux, f.uy, f.uz);
        else
            laws[g] = beckmann_see(f.ux, f.uy, f.uz);
    }
    if (kind == VNDF_KIND_TABLE)
        draw(b, w, n, weight, b->write[4] != NULL);
    for (int g = 0; kind == VNDF_KIND_BECKMANN && g < b->groups; g++) /* long enough for a loop of its own */
        n[g] = beckmann_draw(laws[g], unit_input(b, VNDF_READ_A, g), unit_input(b, VNDF_READ_B, g));
    for (int g = 0; g < b->groups; g++) {
        frame f = at[g];
        f.m = map_at(b, g, is_diagonal);
        if (kind == VNDF_KIND_TABLE)
            n[g] = table_turned(w[g].ex, w[g].ey, n[g]);
        else if (kind == VNDF_KIND_GGX)
            n[g] = ggx_draw(caps[g], unit_input(b, VNDF_READ_A, g), unit_input(b, VNDF_READ_B, g));
        surface_sample s = frame_sampled(f, n[g]);
        put(b, 0, g, s.x);
        put(b, 1, g, s.y);
        put(b, 2, g, s.z);
        if (b->write[3])
            put(b, 3, g, s.pdf);
        if (b->write[4])
            put(b, 4, g, kind == VNDF_KIND_TABLE ? weight[g] : set(1.0f));
    }
}

KERNEL void sample(const block *b, const vndf_kind kind)
{
    if (b->is_diagonal) /* once more, where the compiler knows it */
        sample_as(b, kind, 1);
    else
        sample_as(b, kind, 0);
}

/* The normal of a group in the unit problem, seen or not. */
KERNEL unit_normal normal_at(const block *b, int g, frame f)
{
    return frame_normal(f, input(b, VNDF_READ_A, g), input(b, VNDF_READ_B, g), input(b, VNDF_READ_C, g));
}

/* The drawn density, or the visible one; for closed forms they are the same. */
KERNEL void density(const block *b, const vndf_kind kind)
{
    const int visible = b->task == VNDF_TASK_VISIBLE;
    frame at[GROUPS]; /* `determinant` and `max_pdf` are needed to the end */
    table_direction w[GROUPS];
    unit_normal n[GROUPS];
    real facing[GROUPS], reach[GROUPS], value[GROUPS], p22[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, b->is_diagonal);
        n[g] = normal_at(b, g, f);
        facing[g] = n[g].facing;
        at[g].determinant = f.determinant;
        at[g].max_pdf = f.max_pdf;
        if (kind == VNDF_KIND_GGX)
            value[g] = ggx_density(ggx_see(f.ux, f.uy, f.uz), n[g].x, n[g].y, n[g].z, n[g].facing);
        else if (kind == VNDF_KIND_BECKMANN)
            value[g] = beckmann_density(beckmann_see(f.ux, f.uy, f.uz), n[g].x, n[g].y, n[g].z, n[g].facing);
        else {
            w[g] = table_direction_of(f);
            reach[g] = frame_reach(f);
            if (b->below && !visible)
                n[g] = table_unturned(w[g].ex, w[g].ey, n[g]);
            n[g].facing = n[g].facing / reach[g];
        }
    }
    if (kind == VNDF_KIND_TABLE && visible) {
        table_areas(b, w, value);
        p22_table(b, n, p22);
    } else if (kind == VNDF_KIND_TABLE)
        densities(b, w, n, value);
    for (int g = 0; g < b->groups; g++) {
        real k = value[g] / at[g].determinant;
        if (kind == VNDF_KIND_TABLE && visible)
            k = p22[g] / at[g].determinant * (facing[g] / max(value[g] * reach[g], set(1e-37f)));
        mask seen_at_all = both(le(set(0.0f), input(b, VNDF_READ_C, g)), lt(set(0.0f), facing[g]));
        put(b, 0, g, select(seen_at_all, frame_density(at[g], k), set(0.0f)));
    }
}

KERNEL void ndf(const block *b, const vndf_kind kind)
{
    unit_normal n[GROUPS];
    real determinant[GROUPS], p22[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_of(map_at(b, g, b->is_diagonal), set(0.0f), set(0.0f), set(1.0f));
        n[g] = normal_at(b, g, f);
        determinant[g] = f.determinant;
        if (kind == VNDF_KIND_GGX)
            p22[g] = ggx_p22(n[g].x, n[g].y, n[g].z);
        else if (kind == VNDF_KIND_BECKMANN)
            p22[g] = beckmann_p22(n[g].x, n[g].y, n[g].z);
    }
    if (kind == VNDF_KIND_TABLE)
        p22_table(b, n, p22);
    for (int g = 0; g < b->groups; g++) {
        real d = min(p22[g] / determinant[g], set(3.40282347e38f));
        put(b, 0, g, select(le(set(0.0f), input(b, VNDF_READ_C, g)), d, set(0.0f)));
    }
}

/* Areas, and what masking makes of them. */
KERNEL void areas(const block *b, const vndf_kind kind)
{
    table_direction w[GROUPS];
    real area[GROUPS], reach[GROUPS], cosine[GROUPS], scale[GROUPS], max_pdf[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g, b->is_diagonal);
        cosine[g] = f.uz * f.size;
        scale[g] = f.size;
        max_pdf[g] = f.max_pdf;
        reach[g] = frame_reach(f);
        if (kind == VNDF_KIND_TABLE)
            w[g] = table_direction_of(f);
        else
            area[g] = kind == VNDF_KIND_GGX ? ggx_area(f.ux, f.uy, f.uz) : beckmann_area(f.ux, f.uy, f.uz);
    }
    if (kind == VNDF_KIND_TABLE)
        table_areas(b, w, area);
    for (int g = 0; g < b->groups; g++) {
        real all = (kind == VNDF_KIND_TABLE ? area[g] * reach[g] : area[g]) * scale[g];
        if (b->task == VNDF_TASK_DRAWN_AREA)
            all = select(lt(set(0.0f), max_pdf[g]), all, set(0.0f));
        if (b->task == VNDF_TASK_LAMBDA)
            all = lambda_of(all, cosine[g]);
        else if (b->task == VNDF_TASK_G1)
            all = g1_of(all, cosine[g]);
        put(b, 0, g, all);
        if (b->write[1])
            put(b, 1, g, set(1.0f));
    }
}

KERNEL void block_of(const block *b, const vndf_kind kind)
{
    switch (b->task) {
    case VNDF_TASK_SAMPLE: sample(b, kind); break;
    case VNDF_TASK_PDF:
    case VNDF_TASK_VISIBLE: density(b, kind); break;
    case VNDF_TASK_NDF: ndf(b, kind); break;
    default: areas(b, kind);
    }
}

STEP void run_block(const block *b)
{
    switch (b->kind) {
    case VNDF_KIND_TABLE: block_of(b, VNDF_KIND_TABLE); break;
    case VNDF_KIND_GGX: block_of(b, VNDF_KIND_GGX); break;
    case VNDF_KIND_BECKMANN: block_of(b, VNDF_KIND_BECKMANN); break;
    }
}

/* ---- blocks ---- */

/* Some elements of a call: `at`, or the first, of its arrays from `first` on. */
typedef struct elements {
    size_t first;
    const int *at;
    int count;
} elements;

typedef struct copies {
    row read[VNDF_READS], write[VNDF_WRITES];
} copies;

/* Reads and writes in place, or copies that go on, with the last element, to the last lane. */
KERNEL void enter(block *b, const vndf_call *call, const elements *e, copies *c)
{
    b->groups = (e->count + LANES - 1) / LANES;
    const int in_place = !e->at && e->count == b->groups * LANES;
    for (int r = 0; r < VNDF_READS; r++) {
        if (!call->read[r] || call->shared >> r & 1)
            continue; /* which is the same for all blocks */
        const float *from = call->read[r] + e->first;
        b->read[r] = in_place ? from : c->read[r];
        for (int i = 0; !in_place && i < e->count; i++)
            c->read[r][i] = from[e->at ? e->at[i] : i];
        for (int i = e->count; i < b->groups * LANES; i++)
            c->read[r][i] = c->read[r][e->count - 1];
    }
    for (int w = 0; w < VNDF_WRITES; w++)
        b->write[w] = !call->write[w] ? NULL : in_place ? call->write[w] + e->first : c->write[w];
}

/* Runs a block that was entered, and puts back what it copied. */
KERNEL void run_entered(const block *b, const vndf_call *call, const elements *e)
{
    run_block(b);
    for (int w = 0; w < VNDF_WRITES; w++)
        for (int i = 0; b->write[w] && b->write[w] != call->write[w] + e->first && i < e->count; i++)
            call->write[w][e->first + (size_t)(e->at ? e->at[i] : i)] = b->write[w][i];
}

/* Which elements of a group are valid. */
KERNEL mask valid_at(const block *b, int g)
{
    mask valid = affine_is_valid(map_at(b, g, b->is_diagonal));
    if (b->task != VNDF_TASK_NDF)
        valid = both(valid, direction_is_valid(input(b, VNDF_READ_WI_X, g), input(b, VNDF_READ_WI_Y, g),
                                               input(b, VNDF_READ_WI_Z, g)));
    return valid;
}

/* Elements above the horizon, those from which a table is seen from below, and those that are not valid; the first two
 * are the values of a block's `below`. */
enum { ABOVE, BELOW, INVALID, SORTS };

/* Whether all elements are valid and plainly of one side, which b->below becomes: what frames make of the height hangs
 * on no rounding. */
KERNEL int is_one_sort(block *b, const int sided)
{
    const mask none = lt(set(0.0f), set(0.0f));
    mask good = (mask)~none, below = none, above = none;
    for (int g = 0; g < b->groups; g++) {
        real x = input(b, VNDF_READ_WI_X, g), y = input(b, VNDF_READ_WI_Y, g),
             height = input(b, VNDF_READ_WI_Z, g);
        if (!b->is_diagonal)
            height = height - (x * input(b, VNDF_READ_MEAN_X, g) + y * input(b, VNDF_READ_MEAN_Y, g));
        good = both(good, valid_at(b, g));
        if (sided)
            good = both(good, lt(1e-20f * (abs(x) + abs(y)), abs(height)));
        below = either(below, lt(height, set(0.0f)));
        above = either(above, lt(set(0.0f), height));
    }
    b->below = sided && any(below);
    return !any((mask)~good) && !(sided && any(below) && any(above));
}

/* The sort of each element. */
KERNEL void sort_elements(const block *b, const int sided, int32_t *sorts)
{
    for (int g = 0; g < b->groups; g++) {
        mask below = lt(frame_at(b, g, b->is_diagonal).uz, set(0.0f));
        integer side = select_int(below, set_int(sided ? BELOW : ABOVE), set_int(ABOVE));
        integer sort = select_int(valid_at(b, g), side, set_int(INVALID));
        memcpy(sorts + g * LANES, &sort, sizeof sort);
    }
}

/* Gives all elements but those of one sort the unit matrix and a direction on that side, in copies. */
KERNEL void replace_others(block *b, const int32_t *sorts, int kept, copies *c)
{
    const float other[VNDF_READ_A] = {
        1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, kept == BELOW ? -1.0f : 1.0f};
    for (int r = 0; r < VNDF_READ_A; r++) {
        for (int g = 0; g < b->groups; g++) {
            integer sort;
            memcpy(&sort, sorts + g * LANES, sizeof sort);
            store(c->read[r] + g * LANES, select(eq(sort, kept), input(b, r, g), set(other[r])));
        }
        b->read[r] = c->read[r];
    }
}

/* Runs both sides, each put together; the larger one with all elements in place where that is nearly all of them. */
STEP void run_sorts(const block *of, const vndf_call *call, elements e, const int sided, copies *c)
{
    block b = *of, rest = *of;
    copies own;
    int32_t sorts[BLOCK];
    int list[SORTS][BLOCK], count[SORTS] = {0};
    sort_elements(&b, sided, sorts);
    for (int i = 0; i < e.count; i++)
        list[sorts[i]][count[sorts[i]]++] = e.at ? e.at[i] : i;
    b.below = count[BELOW] > count[ABOVE];
    rest.below = !b.below;
    elements larger = {e.first, list[b.below], count[b.below]},
             smaller = {e.first, list[rest.below], count[rest.below]};
    enter(&rest, call, &smaller, &own);
    if (4 * smaller.count < e.count) {
        replace_others(&b, sorts, b.below, c);
        larger = e;
    } else
        enter(&b, call, &larger, c);
    run_entered(&b, call, &larger);
    if (smaller.count > 0)
        run_entered(&rest, call, &smaller);
    for (int i = 0; i < count[INVALID]; i++)
        for (int w = 0; w < VNDF_WRITES; w++)
            if (call->write[w])
                call->write[w][e.first + (size_t)list[INVALID][i]] =
                    call->task == VNDF_TASK_SAMPLE && w == 2 ? 1.0f : 0.0f;
}

/* ---- calls ---- */

void LANES_ENTRY(const vndf_call *call)
{
    static const row zeros;
    row shared[VNDF_READS];
    copies c;
    const vndf_distribution *d = call->distribution;
    const int sided = d->kind == VNDF_KIND_TABLE && call->task != VNDF_TASK_NDF;
    block b = {.task = call->task, .kind = d->kind, .unit = d->unit, .is_diagonal = call->is_diagonal};
    if (b.kind == VNDF_KIND_TABLE)
        b.t = table_of(d);
    for (int r = 0; r < VNDF_READS; r++) {
        b.read[r] = call->read[r] ? shared[r] : zeros;
        for (int g = 0; call->read[r] && call->shared >> r & 1 && g < GROUPS; g++)
            store(shared[r] + g * LANES, set(*call->read[r]));
    }
    for (size_t first = 0; first < call->count; first += BLOCK) {
        const int count = call->count - first < BLOCK ? (int)(call->count - first) : BLOCK;
        const elements e = {call->at ? 0 : first, call->at ? call->at + first : NULL, count};
        enter(&b, call, &e, &c);
        if (is_one_sort(&b, sided))
            run_entered(&b, call, &e);
        else
            run_sorts(&b, call, e, sided, &c);
    }
}

#endif
