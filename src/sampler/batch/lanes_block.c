/* Batches in lanes: compiled once for each instruction set, with VNDF_LANES numbers side by side.
 *
 * A call goes block by block. A block sets the frames of its elements; splits them by the side of the horizon from
 * which a table is seen; takes each side through the steps of the kernel (draw.h), each a short loop over the block;
 * and puts the results together again. Short loops, since a processor overlaps few iterations of a long one. */
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

/* A block of a call, or of a lobe of it: where its inputs lie, all of them readable up to the last lane, and valid;
 * which elements are. */
typedef struct block {
    const vndf_lobe_call *lobe;
    vndf_task task;
    table t;
    int groups, plain; /* plain: of all its surfaces (kernel/surface.h) */
    const float *read[VNDF_READS];
    mask valid[GROUPS];
} block;

HERE real input(const block *b, int which, int g)
{
    return load(b->read[which] + g * LANES);
}

/* ---- frames ---- */

/* What of frames is needed to the end: f without m, which is read again, u, `grow` and `size`; the direction of (ux,
 * uy) of a table. */
typedef struct frames {
    frame f[GROUPS];
    real ex[GROUPS], ey[GROUPS];
} frames;

/* The elements of one side of the horizon, or of a block: height uz; s, c and rho of the direction, and rho^2 as two
 * parts; what is drawn with or given; results. */
enum { S, C, RHO, SQUARE, UNDER, GIVEN_A, GIVEN_B, GIVEN_C, GIVEN_D, SIDE_READS };
enum { RESULT_A, RESULT_B, RESULT_C, RESULT_D, RESULT_E, SIDE_WRITES };

typedef struct side {
    row height, read[SIDE_READS], write[SIDE_WRITES];
} side;

/* A matrix in units of the distribution's slopes. */
HERE affine_map map_at(const block *b, int g)
{
    const float unit = b->lobe->distribution->unit;
    const real zero = set(0.0f);
    affine_map m = {input(b, VNDF_READ_XX, g) * unit,
                    zero,
                    zero,
                    input(b, VNDF_READ_YY, g) * unit,
                    zero,
                    zero,
                    b->plain,
                    zero};
    if (!m.plain) {
        m.xy = input(b, VNDF_READ_XY, g) * unit;
        m.yx = input(b, VNDF_READ_YX, g) * unit;
        m.mean_x = input(b, VNDF_READ_MEAN_X, g);
        m.mean_y = input(b, VNDF_READ_MEAN_Y, g);
    }
    return affine_measured(m);
}

HERE frame frame_at(const block *b, int g)
{
    return frame_of(map_at(b, g), input(b, VNDF_READ_WI_X, g), input(b, VNDF_READ_WI_Y, g),
                    input(b, VNDF_READ_WI_Z, g));
}

/* Puts the direction of a frame at group g of a side. */
HERE table_direction put_direction(side *s, int g, frame f)
{
    table_direction w = table_direction_of(f);
    store(s->height + g * LANES, f.uz);
    store(s->read[S] + g * LANES, w.s);
    store(s->read[C] + g * LANES, w.c);
    store(s->read[RHO] + g * LANES, w.rho);
    store(s->read[SQUARE] + g * LANES, w.square);
    store(s->read[UNDER] + g * LANES, w.under);
    return w;
}

/* ---- sides of the horizon ---- */

/* The knot of entry `at` of a step of searches. */
HERE whole knot_of(table t, whole at, int level)
{
    return (at + at + (1 - (2 << level))) * (t.stride << (t.levels - level - 1));
}

/* One step: entries that follow `at`. */
HERE whole step_slope(table t, real square, real under, whole at, int level)
{
    return follow(at, at_most(look_level(t, AT_KNOT, at, level) * under, square));
}

/* The cells of slopes whose squares have these two parts. */
HERE void find_slopes(table t, int groups, const float *square, const float *under, whole *i)
{
    for (int g = 0; g < groups; g++) {
        real a = load(square + g * LANES), b = load(under + g * LANES);
        whole at = set_whole(1);
        LANES_UNROLLED
        for (int level = 0; level < FIRST_LEVELS; level++)
            at = step_slope(t, a, b, at, level);
        i[g] = at;
    }
    LANES_UNROLLED
    for (int level = FIRST_LEVELS; level < LEVELS; level++)
        for (int g = 0; level < t.levels && g < groups; g++)
            i[g] = step_slope(t, load(square + g * LANES), load(under + g * LANES), i[g], level);
    for (int g = 0; g < groups; g++)
        i[g] = (i[g] - set_whole(1 << t.levels)) * set_whole(t.stride);
    for (int step = t.stride / 2; step > 0; step /= 2)
        for (int g = 0; g < groups; g++) {
            whole next = least_whole(i[g] + step, set_whole(t.cells));
            real r = look(t, VNDF_KNOT, next).a;
            i[g] = pick_whole(at_most((r * r) * load(under + g * LANES), load(square + g * LANES)), next, i[g]);
        }
}

HERE void see_side(table t, int groups, const side *s, seen *v, const int below)
{
    whole cell[GROUPS];
    if (below)
        find_slopes(t, groups, s->read[SQUARE], s->read[UNDER], cell);
    for (int g = 0; g < groups; g++) {
        const float *at = s->read[0] + g * LANES;
        real height = load(at + C * BLOCK), across = load(at + S * BLOCK), rho = load(at + RHO * BLOCK);
        if (below)
            v[g] = law_see_below(t, across, height, rho, cell[g]);
        else
            v[g] = law_see_above(t, across, height, rho);
    }
}

/* law_sum, whose fourth term is 0 for fewer moments. */
HERE real sum_beyond(table t, weights w, quad tail)
{
    real far = w.wq * tail.c;
    if (t.moments > 3)
        far = far + w.w4 * tail.d;
    return (w.w1 * tail.a + w.w0 * tail.b) + far;
}

/* One step of a search for the cell of a sample. */
HERE reached step_cell(table t, seen v, aim a, reached r, int level, const int below)
{
    const quad zero = {set(0.0f), set(0.0f), set(0.0f), set(0.0f)};
    quad tail = zero, low = zero;
    real beyond;
    mask passes;
    tail.c = look_level(t, AT_TQ, r.i, level);
    if (below) {
        real knot = look_level(t, AT_R, r.i, level);
        low.a = look_level(t, AT_N1, r.i, level);
        low.b = look_level(t, AT_N2, r.i, level);
        beyond = law_sum_below(v.w, knot, most(knot - v.rho, set(0.0f)), tail, low);
        passes = law_passes(t, v, knot_of(t, r.i, level), beyond, a.left);
    } else {
        tail.a = look_level(t, AT_T1, r.i, level);
        tail.b = look_level(t, AT_T0, r.i, level);
        if (t.moments > 3)
            tail.d = look_level(t, AT_T4, r.i, level);
        beyond = sum_beyond(t, a.w, tail);
        passes = at_most(a.left, beyond);
    }
    r.i = follow(r.i, passes);
    r.beyond = pick(passes, beyond, r.beyond);
    return r;
}

/* The same by rows: r.i is a knot. */
HERE reached step_rows(table t, seen v, aim a, reached r, int step, const int below)
{
    whole next = r.i + step, there = least_whole(next, set_whole(t.cells));
    real beyond = below ? law_beyond(t, v, there) : sum_beyond(t, a.w, look(t, VNDF_TAIL, there));
    mask passes = below ? law_passes(t, v, next, beyond, a.left) : at_most(a.left, beyond);
    r.i = pick_whole(passes, there, r.i);
    r.beyond = pick(passes, beyond, r.beyond);
    return r;
}

/* Areas of what is seen. */
HERE void find_areas(table t, int groups, const seen *v, real *area, const int below)
{
    row square, under;
    whole cell[GROUPS];
    for (int g = 0; g < groups; g++)
        store(square + g * LANES, v[g].rho * v[g].rho);
    for (int g = 0; g < GROUPS; g++)
        store(under + g * LANES, set(1.0f));
    find_slopes(t, groups, square, under, cell);
    for (int g = 0; g < groups; g++)
        area[g] = law_area_in(t, v[g], cell[g], below);
}

/* Cells of samples. */
HERE void find_cells(table t, int groups, const seen *v, const aim *a, reached *r, const int below)
{
    for (int g = 0; g < groups; g++) {
        reached at = {set_whole(1), set(0.0f)};
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
        r[g].i = (r[g].i - set_whole(1 << t.levels)) * set_whole(t.stride);
    for (int step = t.stride / 2; step > 0; step /= 2)
        for (int g = 0; g < groups; g++)
            r[g] = step_rows(t, v[g], a[g], r[g], step, below);
}

/* The azimuths of u1. */
HERE void draw_azimuths(int groups, const arc *k, const float *u1, bearing *a, const int below)
{
    real start[GROUPS];
    for (int g = 0; g < groups; g++)
        start[g] = arc_start(k[g], arc_half(load(u1 + g * LANES)), below);
    for (int g = 0; g < groups; g++) {
        real u = load(u1 + g * LANES);
        a[g] = arc_side(arc_step(k[g], start[g], arc_half(u) * k[g].mass), u);
    }
}

/* Normals in the frames of their directions, with K, and their weights. */
HERE void draw_side(table t, int groups, side *s, const int weigh, const int below)
{
    seen v[GROUPS];
    aim a[GROUPS];
    reached r[GROUPS];
    found f[GROUPS];
    drawn_length d[GROUPS];
    arc k[GROUPS];
    bearing turned[GROUPS];
    real area[GROUPS];
    see_side(t, groups, s, v, below);
    for (int g = 0; g < groups; g++)
        a[g] = table_aim(v[g], load(s->read[GIVEN_B] + g * LANES), below);
    find_cells(t, groups, v, a, r, below);
    for (int g = 0; g < groups; g++)
        f[g] = table_cell(t, v[g], a[g], r[g], below);
    for (int g = 0; g < groups; g++)
        d[g] = table_length(t, v[g], f[g], law_invert(f[g].at, f[g].before), below);
    for (int g = 0; g < groups; g++)
        k[g] = table_arc(v[g], d[g].r, below);
    draw_azimuths(groups, k, s->read[GIVEN_A], turned, below);
    for (int g = 0; g < groups; g++) {
        drawn n = table_normal(v[g], d[g], k[g], turned[g]);
        store(s->write[RESULT_A] + g * LANES, n.x);
        store(s->write[RESULT_B] + g * LANES, n.y);
        store(s->write[RESULT_C] + g * LANES, n.z);
        store(s->write[RESULT_D] + g * LANES, n.density);
    }
    if (weigh)
        find_areas(t, groups, v, area, below);
    for (int g = 0; weigh && g < groups; g++) {
        place in = law_invert(f[g].at, f[g].before);
        real weight = table_weight(t, v[g], r[g].i, f[g], in, d[g].r, k[g], area[g], below);
        store(s->write[RESULT_E] + g * LANES, weight);
    }
}

/* The given normals, with their cells. */
HERE void place_given(table t, int groups, const side *s, given *n)
{
    row square, under;
    whole cell[GROUPS];
    for (int g = 0; g < groups; g++) {
        const float *at = s->read[0] + g * LANES;
        n[g] =
            table_given_slope(load(at + GIVEN_A * BLOCK), load(at + GIVEN_B * BLOCK), load(at + GIVEN_C * BLOCK));
        store(square + g * LANES, n[g].square);
        store(under + g * LANES, n[g].under);
    }
    find_slopes(t, groups, square, under, cell);
    for (int g = 0; g < groups; g++)
        n[g].cell = cell[g];
}

HERE void density_side(table t, int groups, side *s, const int below)
{
    seen v[GROUPS];
    given n[GROUPS];
    see_side(t, groups, s, v, below);
    place_given(t, groups, s, n);
    for (int g = 0; g < groups; g++)
        store(s->write[RESULT_A] + g * LANES,
              table_density(t, v[g], n[g], load(s->read[GIVEN_D] + g * LANES), below));
}

HERE void invert_side(table t, int groups, side *s, const int below)
{
    seen v[GROUPS];
    given n[GROUPS];
    see_side(t, groups, s, v, below);
    place_given(t, groups, s, n);
    for (int g = 0; g < groups; g++) {
        real x = load(s->read[GIVEN_A] + g * LANES), y = load(s->read[GIVEN_B] + g * LANES);
        pair u = table_invert(t, v[g], n[g], x, y, below);
        store(s->write[RESULT_A] + g * LANES, u.a);
        store(s->write[RESULT_B] + g * LANES, u.b);
    }
}

HERE void area_side(table t, int groups, side *s, const int law_alone, const int below)
{
    seen v[GROUPS];
    real area[GROUPS];
    see_side(t, groups, s, v, below);
    for (int g = 0; law_alone && g < groups; g++)
        area[g] = law_drawn_area(v[g], below);
    if (!law_alone)
        find_areas(t, groups, v, area, below);
    for (int g = 0; g < groups; g++)
        store(s->write[RESULT_A] + g * LANES, area[g]);
}

/* What is done to a side. */
typedef enum side_task { DRAW, WEIGH, DENSITY, INVERT, AREA, DRAWN_AREA } side_task;

/* How many rows of a side that takes and gives. */
static const struct side_rows {
    int reads, writes;
} side_rows[] = {{GIVEN_C, RESULT_E}, {GIVEN_C, SIDE_WRITES}, {SIDE_READS, RESULT_B},
                 {GIVEN_D, RESULT_C}, {GIVEN_A, RESULT_B},    {GIVEN_A, RESULT_B}};

HERE void do_side(side_task task, table t, int groups, side *s, const int below)
{
    switch (task) {
    case DRAW: draw_side(t, groups, s, 0, below); break;
    case WEIGH: draw_side(t, groups, s, 1, below); break;
    case DENSITY: density_side(t, groups, s, below); break;
    case INVERT: invert_side(t, groups, s, below); break;
    case AREA: area_side(t, groups, s, 0, below); break;
    case DRAWN_AREA: area_side(t, groups, s, 1, below); break;
    }
}

STEP void do_above(side_task task, table t, int groups, side *s)
{
    do_side(task, t, groups, s, 0);
}

STEP void do_below(side_task task, table t, int groups, side *s)
{
    do_side(task, t, groups, s, 1);
}

/* Some elements of a block, to be put together: which, how many, and in how many groups. */
typedef struct some {
    mask of[GROUPS];
    int count, groups;
#if VNDF_LANES < 16
    uint8_t at[BLOCK];
#endif
} some;

/* Counts the elements in e->of. */
HERE void count_some(some *e, int groups)
{
    e->count = 0;
    for (int g = 0; g < groups; g++) {
#if VNDF_LANES == 16
        e->count += __builtin_popcount(e->of[g]);
#else
        for (int l = 0; l < LANES; l++) {
            e->at[e->count] = (uint8_t)(g * LANES + l);
            e->count -= e->of[g][l];
        }
#endif
    }
    e->groups = (e->count + LANES - 1) / LANES;
}

/* Puts their numbers together; lanes that are left hold the first. */
HERE void gather(const some *e, int groups, const float *from, float *to)
{
#if VNDF_LANES == 16 /* one instruction for sixteen copies. Lanes end within the row */
    int count = 0;
    for (int g = 0; g < groups; g++) {
        _mm512_storeu_ps(to + count, _mm512_maskz_compress_ps(e->of[g], (__m512)load(from + g * LANES)));
        count += __builtin_popcount(e->of[g]);
    }
#else
    (void)groups;
    for (int i = 0; i < e->count; i++)
        to[i] = from[e->at[i]];
#endif
    for (int i = e->count; i < e->groups * LANES; i++)
        to[i] = to[0];
}

/* Puts numbers back. */
HERE void scatter(const some *e, int groups, const float *from, float *to)
{
#if VNDF_LANES == 16
    int count = 0;
    for (int g = 0; g < groups; g++) {
        __m512 before = (__m512)load(to + g * LANES);
        store(to + g * LANES, (real)_mm512_mask_expand_ps(before, e->of[g], _mm512_loadu_ps(from + count)));
        count += __builtin_popcount(e->of[g]);
    }
#else
    (void)groups;
    for (int i = 0; i < e->count; i++)
        to[e->at[i]] = from[i];
#endif
}

/* A task on the elements of one side of a block, which are put together for it. */
HERE void take_some(side_task task, table t, side *s, int groups, const int below)
{
    side own;
    some e;
    for (int g = 0; g < groups; g++) {
        real height = load(s->height + g * LANES);
        e.of[g] = below ? less(height, set(0.0f)) : at_most(set(0.0f), height);
    }
    count_some(&e, groups);
    for (int r = 0; r < side_rows[task].reads; r++)
        gather(&e, groups, s->read[r], own.read[r]);
    (below ? do_below : do_above)(task, t, e.groups, &own);
    for (int w = 0; w < side_rows[task].writes; w++)
        scatter(&e, groups, own.write[w], s->write[w]);
}

/* A task on each side that has elements. */
HERE void take_sides(side_task task, const block *b, side *s)
{
    real least_height = set(0.0f), most_height = set(-1.0f);
    for (int g = 0; g < b->groups; g++) {
        real height = load(s->height + g * LANES);
        least_height = least(least_height, height);
        most_height = most(most_height, height);
    }
    if (!any(less(least_height, set(0.0f))))
        do_above(task, b->t, b->groups, s);
    else if (!any(at_most(set(0.0f), most_height)))
        do_below(task, b->t, b->groups, s);
    else {
        take_some(task, b->t, s, b->groups, 0);
        take_some(task, b->t, s, b->groups, 1);
    }
}

/* ---- samples ---- */

/* Of the numbers u1 and u2: in [0, 1], 0 for NaN. */
HERE real unit_input(const block *b, int which, int g)
{
    return least(most(input(b, which, g), set(0.0f)), set(1.0f));
}

/* Keeps what a sample needs of its frame to the end. */
HERE void keep_frame(frames *at, int g, frame f)
{
    at->f[g].wx = f.wx;
    at->f[g].wy = f.wy;
    at->f[g].wz = f.wz;
    at->f[g].determinant = f.determinant;
    at->f[g].densest = f.densest;
    at->f[g].near = f.near;
}

/* Writes the samples of a group; density and weight where that is asked for. */
HERE void put_sample(const block *b, const frames *at, int g, drawn n, real weight, float *const to[VNDF_WRITES])
{
    frame f = at->f[g];
    f.m = map_at(b, g);
    sampled_normal s = frame_sampled(f, n);
    mask valid = b->valid[g];
    real zero = set(0.0f);
    store(to[0] + g * LANES, pick(valid, s.x, zero));
    store(to[1] + g * LANES, pick(valid, s.y, zero));
    store(to[2] + g * LANES, pick(valid, s.z, set(1.0f)));
    if (to[3])
        store(to[3] + g * LANES, pick(valid, s.pdf, zero));
    if (to[4])
        store(to[4] + g * LANES, pick(valid, weight, zero));
}

HERE void sample_table(const block *b, float *const to[VNDF_WRITES])
{
    frames at;
    side s;
    const int weigh = to[4] != NULL;
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g);
        table_direction w = put_direction(&s, g, f);
        keep_frame(&at, g, f);
        at.ex[g] = w.ex;
        at.ey[g] = w.ey;
        store(s.read[GIVEN_A] + g * LANES, unit_input(b, VNDF_READ_A, g));
        store(s.read[GIVEN_B] + g * LANES, unit_input(b, VNDF_READ_B, g));
    }
    take_sides(weigh ? WEIGH : DRAW, b, &s);
    for (int g = 0; g < b->groups; g++) {
        const float *from = s.write[0] + g * LANES;
        drawn n = {load(from), load(from + BLOCK), load(from + 2 * BLOCK), load(from + 3 * BLOCK)};
        real weight = weigh ? load(s.write[RESULT_E] + g * LANES) : set(1.0f);
        put_sample(b, &at, g, table_turned(at.ex[g], at.ey[g], n), weight, to);
    }
}

HERE void sample_closed(const block *b, float *const to[VNDF_WRITES], const vndf_kind kind)
{
    frames at;
    ggx_view caps[GROUPS];
    beckmann_view laws[GROUPS];
    drawn n[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g);
        keep_frame(&at, g, f);
        if (kind == VNDF_KIND_GGX)
            caps[g] = ggx_see(f.ux, f.uy, f.uz);
        else
            laws[g] = beckmann_see(f.ux, f.uy, f.uz);
    }
    for (int g = 0; g < b->groups; g++) {
        real u1 = unit_input(b, VNDF_READ_A, g), u2 = unit_input(b, VNDF_READ_B, g);
        if (kind == VNDF_KIND_GGX)
            put_sample(b, &at, g, ggx_draw(caps[g], u1, u2), set(1.0f), to);
        else
            n[g] = beckmann_draw(laws[g], u1, u2); /* long enough for a loop of its own */
    }
    for (int g = 0; kind == VNDF_KIND_BECKMANN && g < b->groups; g++)
        put_sample(b, &at, g, n[g], set(1.0f), to);
}

/* ---- given normals ---- */

/* The normal of a group in the unit problem, seen or not. */
HERE unit_normal normal_at(const block *b, int g, frame f)
{
    return frame_normal(f, input(b, VNDF_READ_A, g), input(b, VNDF_READ_B, g), input(b, VNDF_READ_C, g));
}

HERE void put_given(side *s, int g, unit_normal n)
{
    store(s->read[GIVEN_A] + g * LANES, n.x);
    store(s->read[GIVEN_B] + g * LANES, n.y);
    store(s->read[GIVEN_C] + g * LANES, n.z);
}

/* D times the determinant of given normals, D of a direction straight up if there is no other. */
HERE void p22_table(table t, int groups, const side *s, real *p22)
{
    given n[GROUPS];
    place_given(t, groups, s, n);
    for (int g = 0; g < groups; g++)
        p22[g] = table_p22(t, n[g]);
}

/* A density that a float can hold where the element and its normal are valid, else 0. */
HERE void put_density(const frame *f, mask valid, int g, real density, float *to)
{
    store(to + g * LANES, pick(valid, frame_density(*f, density), set(0.0f)));
}

/* The drawn density, or the visible one; for closed forms they are the same. */
HERE void density(const block *b, float *to, const vndf_kind kind, const int visible)
{
    frame at[GROUPS]; /* `determinant` and `densest` are needed to the end */
    mask valid[GROUPS];
    side s;
    real facing[GROUPS], reach[GROUPS], p22[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g);
        unit_normal n = normal_at(b, g, f);
        mask up = both(at_most(set(0.0f), input(b, VNDF_READ_C, g)), less(set(0.0f), n.facing));
        valid[g] = both(b->valid[g], up);
        if (kind == VNDF_KIND_GGX) {
            real k = ggx_density(ggx_see(f.ux, f.uy, f.uz), n.x, n.y, n.z, n.facing);
            put_density(&f, valid[g], g, k / f.determinant, to);
            continue;
        }
        if (kind == VNDF_KIND_BECKMANN) {
            real k = beckmann_density(beckmann_see(f.ux, f.uy, f.uz), n.x, n.y, n.z, n.facing);
            put_density(&f, valid[g], g, k / f.determinant, to);
            continue;
        }
        table_direction w = put_direction(&s, g, f);
        at[g].determinant = f.determinant;
        at[g].densest = f.densest;
        if (visible) {
            put_given(&s, g, n);
            facing[g] = n.facing;
            reach[g] = frame_reach(f);
        } else {
            unit_normal m = table_unturned(w.ex, w.ey, n);
            mask below = less(f.uz, set(0.0f));
            m.x = pick(below, m.x, n.x);
            m.y = pick(below, m.y, n.y);
            put_given(&s, g, m);
            store(s.read[GIVEN_D] + g * LANES, n.facing / frame_reach(f));
        }
    }
    if (kind != VNDF_KIND_TABLE)
        return;
    take_sides(visible ? AREA : DENSITY, b, &s);
    if (visible)
        p22_table(b->t, b->groups, &s, p22);
    for (int g = 0; g < b->groups; g++) {
        real result = load(s.write[RESULT_A] + g * LANES), k = result / at[g].determinant;
        if (visible)
            k = p22[g] / at[g].determinant * (facing[g] / most(result * reach[g], set(1e-37f)));
        put_density(&at[g], valid[g], g, k, to);
    }
}

HERE void put_numbers(const block *b, int g, pair u, float *const to[VNDF_WRITES])
{
    mask valid = b->valid[g];
    real zero = set(0.0f), one = set(1.0f);
    store(to[0] + g * LANES, pick(valid, least(most(u.a, zero), one), zero));
    store(to[1] + g * LANES, pick(valid, least(most(u.b, zero), one), zero));
}

/* The numbers of normals, which are held above the horizon. */
HERE void invert(const block *b, float *const to[VNDF_WRITES], const vndf_kind kind)
{
    side s;
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g);
        unit_normal n = frame_normal(f, input(b, VNDF_READ_A, g), input(b, VNDF_READ_B, g),
                                     most(input(b, VNDF_READ_C, g), set(0.0f)));
        if (kind == VNDF_KIND_GGX)
            put_numbers(b, g, ggx_invert(ggx_see(f.ux, f.uy, f.uz), n.x, n.y, n.z), to);
        else if (kind == VNDF_KIND_BECKMANN)
            put_numbers(b, g, beckmann_invert(beckmann_see(f.ux, f.uy, f.uz), n.x, n.y, n.z), to);
        else {
            table_direction w = put_direction(&s, g, f);
            put_given(&s, g, table_unturned(w.ex, w.ey, n));
        }
    }
    if (kind != VNDF_KIND_TABLE)
        return;
    take_sides(INVERT, b, &s);
    for (int g = 0; g < b->groups; g++) {
        pair u = {load(s.write[RESULT_A] + g * LANES), load(s.write[RESULT_B] + g * LANES)};
        put_numbers(b, g, u, to);
    }
}

/* ---- the distribution itself ---- */

HERE void ndf(const block *b, float *to, const vndf_kind kind)
{
    side s;
    mask up[GROUPS];
    real determinant[GROUPS], p22[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_of(map_at(b, g), set(0.0f), set(0.0f), set(1.0f));
        unit_normal n = normal_at(b, g, f);
        up[g] = both(b->valid[g], at_most(set(0.0f), input(b, VNDF_READ_C, g)));
        determinant[g] = f.determinant;
        if (kind == VNDF_KIND_TABLE)
            put_given(&s, g, n);
        else
            p22[g] = kind == VNDF_KIND_GGX ? ggx_p22(n.x, n.y, n.z) : beckmann_p22(n.x, n.y, n.z);
    }
    if (kind == VNDF_KIND_TABLE)
        p22_table(b->t, b->groups, &s, p22);
    for (int g = 0; g < b->groups; g++) {
        real d = least(p22[g] / determinant[g], set(3.40282347e38f));
        store(to + g * LANES, pick(up[g], d, set(0.0f)));
    }
}

/* Areas, and what masking makes of them. */
HERE void areas(const block *b, float *to, const vndf_kind kind)
{
    side s;
    real area[GROUPS], cosine[GROUPS], scale[GROUPS];
    for (int g = 0; g < b->groups; g++) {
        frame f = frame_at(b, g);
        cosine[g] = f.uz * f.size;
        scale[g] = f.size;
        if (kind == VNDF_KIND_TABLE) {
            put_direction(&s, g, f);
            area[g] = frame_reach(f);
        } else
            area[g] = kind == VNDF_KIND_GGX ? ggx_area(f.ux, f.uy, f.uz) : beckmann_area(f.ux, f.uy, f.uz);
    }
    if (kind == VNDF_KIND_TABLE)
        take_sides(b->task == VNDF_TASK_DRAWN_AREA ? DRAWN_AREA : AREA, b, &s);
    for (int g = 0; g < b->groups; g++) {
        real all = area[g];
        if (kind == VNDF_KIND_TABLE)
            all = load(s.write[RESULT_A] + g * LANES) * all;
        all = all * scale[g];
        if (b->task == VNDF_TASK_LAMBDA)
            all = lambda_of(all, cosine[g]);
        else if (b->task == VNDF_TASK_G1)
            all = g1_of(all, cosine[g]);
        store(to + g * LANES, pick(b->valid[g], all, set(0.0f)));
    }
}

/* ---- blocks ---- */

HERE void sample(const block *b, float *const to[VNDF_WRITES], const vndf_kind kind)
{
    if (kind == VNDF_KIND_TABLE)
        sample_table(b, to);
    else
        sample_closed(b, to, kind);
}

HERE void block_of(const block *b, float *const to[VNDF_WRITES], const vndf_kind kind)
{
    if (b->task == VNDF_TASK_SAMPLE && b->plain) { /* once more, where the compiler knows it */
        block plain = *b;
        plain.plain = 1;
        sample(&plain, to, kind);
    } else if (b->task == VNDF_TASK_SAMPLE)
        sample(b, to, kind);
    else if (b->task == VNDF_TASK_VISIBLE && kind == VNDF_KIND_TABLE)
        density(b, to[0], kind, 1);
    else if (b->task == VNDF_TASK_PDF || b->task == VNDF_TASK_VISIBLE)
        density(b, to[0], kind, 0);
    else if (b->task == VNDF_TASK_INVERT)
        invert(b, to, kind);
    else if (b->task == VNDF_TASK_NDF)
        ndf(b, to[0], kind);
    else
        areas(b, to[0], kind);
}

/* One for each kind, which the compiler then knows. */
STEP void run_block(const block *b, float *const to[VNDF_WRITES])
{
    switch (b->lobe->distribution->kind) {
    case VNDF_KIND_TABLE: block_of(b, to, VNDF_KIND_TABLE); break;
    case VNDF_KIND_GGX: block_of(b, to, VNDF_KIND_GGX); break;
    case VNDF_KIND_BECKMANN: block_of(b, to, VNDF_KIND_BECKMANN); break;
    }
}

/* Copies for the last lanes of a call, numbers that all elements share, and what became valid. */
typedef struct copies {
    row read[VNDF_READS], write[VNDF_WRITES], valid[VNDF_READ_A];
} copies;

static const row zeros;

/* Where a block reads from: zeros, in place, or copies that go on, with the last element, to the last lane. What all
 * elements share is copied to `fresh` copies. */
HERE void place_reads(block *b, size_t first, int count, int fresh, copies *c)
{
    for (int r = 0; r < VNDF_READS; r++) {
        const float *from = b->lobe->read[r];
        int one = (int)(b->lobe->shared >> r & 1), in_place = !one && count == b->groups * LANES;
        b->read[r] = !from ? zeros : in_place ? from + first : c->read[r];
        if (!from || in_place)
            continue;
        for (int g = 0; one && fresh && g < GROUPS; g++)
            store(c->read[r] + g * LANES, set(*from));
        for (int i = 0; !one && i < b->groups * LANES; i++)
            c->read[r][i] = from[first + (size_t)(i < count ? i : count - 1)];
    }
}

/* Elements whose matrix and direction are far from what is invalid. */
HERE mask is_ordinary(const block *b, int g)
{
    affine_map m = map_at(b, g);
    real x = input(b, VNDF_READ_WI_X, g), y = input(b, VNDF_READ_WI_Y, g), z = input(b, VNDF_READ_WI_Z, g);
    real sum = (size(x) + size(y)) + size(z), largest = most(sum, m.xx + m.yy);
    mask regular = less(set(1e-12f), least(m.xx, m.yy));
    if (!b->plain) {
        real along = m.xx * m.yy, across = m.xy * m.yx, means = size(m.mean_x) + size(m.mean_y);
        regular = less(1e-4f * (size(along) + size(across)) + 1e-24f, size(along - across));
        largest = most(sum, ((size(m.xx) + size(m.xy)) + (size(m.yx) + size(m.yy))) + means);
    }
    return both(both(less(largest, set(1e6f)), less(set(1e-9f), sum)), regular);
}

/* Which elements of a group are valid. */
HERE mask valid_at(const block *b, int g)
{
    mask valid = affine_is_valid(map_at(b, g));
    if (b->plain)
        valid = both(valid, less(set(0.0f), least(input(b, VNDF_READ_XX, g), input(b, VNDF_READ_YY, g))));
    if (b->task != VNDF_TASK_NDF)
        valid = both(valid, direction_is_valid(input(b, VNDF_READ_WI_X, g), input(b, VNDF_READ_WI_Y, g),
                                               input(b, VNDF_READ_WI_Z, g)));
    return valid;
}

/* Sets which elements are valid. If some are not, the block reads from copies, in which they have the unit matrix and a
 * direction straight up. */
HERE void set_valid(block *b, copies *c)
{
    const float valid_one[VNDF_READ_A] = {1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f};
    mask ordinary = same(set_whole(0), 0);
    for (int g = 0; g < b->groups; g++) {
        b->valid[g] = is_ordinary(b, g);
        ordinary = both(ordinary, b->valid[g]);
    }
    if (all(ordinary))
        return;
    for (int g = 0; g < b->groups; g++)
        b->valid[g] = valid_at(b, g);
    for (int r = 0; r < VNDF_READ_A; r++) {
        for (int g = 0; g < b->groups; g++)
            store(c->valid[r] + g * LANES, pick(b->valid[g], input(b, r, g), set(valid_one[r])));
        b->read[r] = c->valid[r];
    }
}

static void surfaces(const vndf_call *call)
{
    const vndf_distribution *d = call->lobe->distribution;
    table_copies table_parts;
    copies c;
    block b = {.lobe = call->lobe, .task = call->task, .plain = call->diagonal};
    if (d->kind == VNDF_KIND_TABLE)
        b.t = table_of(d, &table_parts);
    for (size_t first = 0; first < call->count; first += BLOCK) {
        int count = call->count - first < BLOCK ? (int)(call->count - first) : BLOCK;
        float *to[VNDF_WRITES];
        b.groups = (count + LANES - 1) / LANES;
        int in_place = count == b.groups * LANES;
        place_reads(&b, first, count, first == 0, &c);
        set_valid(&b, &c);
        for (int w = 0; w < VNDF_WRITES; w++)
            to[w] = !call->write[w] ? NULL : in_place ? call->write[w] + first : c.write[w];
        run_block(&b, to);
        for (int w = 0; !in_place && w < VNDF_WRITES; w++)
            if (to[w])
                memcpy(call->write[w] + first, to[w], (size_t)count * sizeof(float));
    }
}

#include "sampler/batch/mixture_lanes.h"

void LANES_ENTRY(const vndf_call *call)
{
    (call->mixed ? mixtures : surfaces)(call);
}

#endif
