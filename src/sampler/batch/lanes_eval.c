/* See lanes_eval.h. The scalar calls (surface.c, view.c, exact.c) use the same sources. Lanes past the end of a block
 * read numbers that are in memory, and nobody reads their answers.
 *
 * Densities of a table take three ways: in front of wi, behind it, and below the horizon. The normals are sorted by way
 * first; then each way evaluates its own normals, gathered. */
#include "sampler/batch/lanes_eval.h"

#include "sampler/tabulated/density_wedge.h"
#include "sampler/area.h"
#include "sampler/batch/density_of.h"
#include "simd/list.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

/* ---- inputs ---- */

VNDF_INLINE doubles input(const vndf_eval_inputs *in, int which, uint32_t i)
{
    return doubles_load(in->of[which] + i);
}

VNDF_INLINE vndf_direction direction_at(const vndf_eval_inputs *in, uint32_t i, double scale)
{
    vndf_direction w = {input(in, VNDF_EVAL_ALPHA_X, i) * scale, input(in, VNDF_EVAL_ALPHA_Y, i) * scale,
                        input(in, VNDF_EVAL_WI_X, i), input(in, VNDF_EVAL_WI_Y, i), input(in, VNDF_EVAL_WI_Z, i)};
    return w;
}

VNDF_INLINE vndf_normal normal_at(const vndf_eval_inputs *in, uint32_t i)
{
    vndf_normal n;
    n.x = in->normal[0] ? doubles_load_long(in->normal[0] + i) : input(in, VNDF_EVAL_X, i);
    n.y = in->normal[0] ? doubles_load_long(in->normal[1] + i) : input(in, VNDF_EVAL_Y, i);
    n.z = in->normal[0] ? doubles_load_long(in->normal[2] + i) : input(in, VNDF_EVAL_Z, i);
    return n;
}

VNDF_INLINE vndf_query given_at(const vndf_eval_inputs *in, uint32_t i, double scale)
{
    vndf_normal n = normal_at(in, i);
    vndf_query g = {direction_at(in, i, scale), n.x, n.y, n.z};
    return g;
}

VNDF_INLINE doubles facing_at(const vndf_eval_inputs *in, uint32_t i, const vndf_query *g)
{
    return in->facing ? doubles_load_long(in->facing + i) : vndf_query_facing(g);
}

/* The query, with numbers that can be looked up in lanes outside `m`. */
VNDF_INLINE vndf_query picked_given(doubles_m m, const vndf_query *g)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    vndf_query safe = {{doubles_pick(m, g->wi.ax, one), doubles_pick(m, g->wi.ay, one),
                        doubles_pick(m, g->wi.x, nothing), doubles_pick(m, g->wi.y, nothing),
                        doubles_pick(m, g->wi.z, one)},
                       doubles_pick(m, g->x, nothing),
                       doubles_pick(m, g->y, nothing),
                       doubles_pick(m, g->z, one)};
    return safe;
}

/* ---- answers for a direction ---- */

static void answer_area(const vndf_distribution *d, vndf_eval_block *b)
{
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        vndf_direction w = direction_at(&b->in, i, scale);
        doubles_store_f(b->value + i, vndf_area_of(d, &w));
    }
}

static void answer_lambda(const vndf_distribution *d, vndf_eval_block *b)
{
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        vndf_direction w = direction_at(&b->in, i, scale);
        doubles_store_f(b->value + i, vndf_lambda_of(d, &w));
    }
}

static void answer_g1(const vndf_distribution *d, vndf_eval_block *b)
{
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        vndf_direction w = direction_at(&b->in, i, scale);
        doubles_store_f(b->value + i, vndf_g1_of(d, &w));
    }
}

/* ---- answers for a normal ---- */

static void answer_ndf(const vndf_distribution *d, vndf_eval_block *b)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    const vndf_eval_inputs *in = &b->in;
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        doubles ax = input(in, VNDF_EVAL_ALPHA_X, i) * scale, ay = input(in, VNDF_EVAL_ALPHA_Y, i) * scale;
        vndf_normal n = normal_at(in, i);
        vndf_query g = {{ax, ay, one, one, one}, n.x, n.y, n.z};
        doubles_m valid = vndf_normal_is_valid(&g);
        g = picked_given(valid, &g);
        doubles ndf = doubles_pick(valid, vndf_law_ndf(d, &g), nothing);
        doubles_store_f(b->value + i, vndf_density_of(ndf));
        if (b->exact)
            doubles_store_long(b->exact + i, ndf);
    }
}

/* Whether wi sees the normal. */
VNDF_INLINE doubles_m is_seen(const vndf_query *g, doubles facing)
{
    const doubles nothing = doubles_set(0.0);
    return doubles_both(vndf_direction_is_valid(&g->wi),
                        doubles_both(doubles_at_most(nothing, g->z), doubles_less(nothing, facing)));
}

/* Dv; for an exact law it is the density of a sample, and at least FLT_MIN. */
static void answer_visible(const vndf_distribution *d, vndf_eval_block *b)
{
    const doubles nothing = doubles_set(0.0);
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        vndf_query g = given_at(&b->in, i, scale);
        doubles facing = facing_at(&b->in, i, &g);
        doubles_m seen = is_seen(&g, facing);
        g = picked_given(seen, &g);
        doubles visible = vndf_law_visible(d, &g, facing);
        doubles rounded =
            doubles_widen(vndf_law_is_exact(d) ? vndf_positive_of(visible) : vndf_density_of(visible));
        doubles_store_f(b->value + i, doubles_narrow(doubles_pick(seen, rounded, nothing)));
        if (b->exact)
            doubles_store_long(b->exact + i, doubles_pick(seen, visible, nothing));
    }
}

/* ---- the density of a table ---- */

enum { IN_FRONT, BEHIND, BELOW, WAYS };

/* The indices of the normals that take each way. */
typedef struct sorted {
    uint32_t index[WAYS][VNDF_EVAL_BLOCK], count[WAYS];
} sorted;

/* The inputs of the normals of one way, side by side, with room for the last group. */
typedef struct gathered {
    float of[VNDF_EVAL_INPUTS][VNDF_EVAL_BLOCK + VNDF_DOUBLES];
    double normal[3][VNDF_EVAL_BLOCK + VNDF_DOUBLES];
} gathered;

/* Indices of the lanes in `m`, from `first` on, that are below `end`. */
VNDF_INLINE void append(sorted *s, int way, doubles_m m, uint32_t first, uint32_t end)
{
    s->count[way] = vndf_list_bits(s->index[way], s->count[way], doubles_mask_bits(m), first, VNDF_DOUBLES, end);
}

/* A normal that wi does not see takes no way; its answer is 0. */
static void sort(const vndf_distribution *d, vndf_eval_block *b, sorted *s)
{
    const doubles nothing = doubles_set(0.0);
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        vndf_query g = given_at(&b->in, i, scale);
        doubles_m seen = is_seen(&g, facing_at(&b->in, i, &g)), below = doubles_less(g.wi.z, nothing);
        doubles_m above = doubles_without(seen, below), front = doubles_at_most(nothing, vndf_query_along(&g));
        append(s, IN_FRONT, doubles_both(above, front), i, b->count);
        append(s, BEHIND, doubles_without(above, front), i, b->count);
        append(s, BELOW, doubles_both(seen, below), i, b->count);
        doubles_store_f(b->value + i, doubles_narrow(nothing));
        if (b->exact)
            doubles_store_long(b->exact + i, nothing);
    }
}

VNDF_INLINE void gather_normals(const vndf_eval_inputs *in, const uint32_t *index, uint32_t count, gathered *own,
                                vndf_eval_inputs *made)
{
    for (uint32_t i = 0; i < count + VNDF_DOUBLES; i++)
        for (int n = 0; n < 3; n++)
            own->normal[n][i] = in->normal[n][index[i < count ? i : 0]];
    for (int n = 0; n < 3; n++)
        made->normal[n] = own->normal[n];
}

/* Copies the inputs of one way into `own`, one after the other: gathers cost more. */
VNDF_INLINE vndf_eval_inputs gather_way(const vndf_eval_block *b, const uint32_t *index, uint32_t count,
                                        gathered *own)
{
    vndf_eval_inputs made;
    const int inputs = b->in.normal[0] ? VNDF_EVAL_X : VNDF_EVAL_INPUTS;
    for (uint32_t i = 0; i < count + VNDF_DOUBLES; i++) {
        uint32_t from = index[i < count ? i : 0]; /* spare lanes repeat the first normal */
        for (int n = 0; n < inputs; n++)
            own->of[n][i] = b->in.of[n][from];
    }
    made.normal[0] = made.facing = NULL;
    if (b->in.normal[0])
        gather_normals(&b->in, index, count, own, &made);
    for (int n = 0; n < VNDF_EVAL_INPUTS; n++)
        made.of[n] = own->of[n];
    return made;
}

VNDF_INLINE void scatter_exact(vndf_eval_block *b, const uint32_t *index, uint32_t count, doubles density)
{
    double value[VNDF_DOUBLES];
    doubles_store_long(value, density);
    for (uint32_t i = 0; i < VNDF_DOUBLES && i < count; i++)
        b->exact[index[i]] = value[i];
}

/* Puts a group's answers where its normals were, and leaves densities that are not trusted. */
VNDF_INLINE void scatter(vndf_eval_block *b, const uint32_t *index, uint32_t count, doubles density,
                         doubles_m trusted)
{
    float value[VNDF_DOUBLES];
    uint32_t bits = doubles_mask_bits(trusted);
    doubles_store_f(value, vndf_positive_of(density));
    for (uint32_t i = 0; i < VNDF_DOUBLES && i < count; i++) {
        b->value[index[i]] = value[i];
        b->left[b->left_count] = index[i];
        b->left_count += !(bits >> i & 1);
    }
    if (b->exact)
        scatter_exact(b, index, count, density);
}

VNDF_INLINE void answer_way(const vndf_distribution *d, vndf_eval_block *b, const sorted *s, int way)
{
    double scale = vndf_unit_scale(d);
    gathered own;
    if (s->count[way] == 0)
        return;
    const vndf_eval_inputs in = gather_way(b, s->index[way], s->count[way], &own);
    for (uint32_t i = 0; i < s->count[way]; i += VNDF_DOUBLES) {
        const uint32_t *index = s->index[way] + i;
        vndf_query g = given_at(&in, i, scale);
        doubles_m trusted = doubles_at_most(g.z, g.z);
        doubles density = way == IN_FRONT ? vndf_query_in_front(d, &g, &trusted)
                                          : vndf_query_of_wedge(d, &g, way == BELOW, NULL, &trusted);
        scatter(b, index, s->count[way] - i, density, trusted);
    }
}

static void answer_pdf(const vndf_distribution *d, vndf_eval_block *b)
{
    sorted s;
    s.count[IN_FRONT] = s.count[BEHIND] = s.count[BELOW] = 0;
    sort(d, b, &s);
    answer_way(d, b, &s, IN_FRONT);
    answer_way(d, b, &s, BEHIND);
    answer_way(d, b, &s, BELOW);
}

#  if VNDF_LANES == 16
void vndf_eval_block_avx512(const vndf_distribution *d, vndf_question question, vndf_eval_block *b)
#  else
void vndf_eval_block_avx2(const vndf_distribution *d, vndf_question question, vndf_eval_block *b)
#  endif
{
    b->left_count = 0;
    if (question == VNDF_ASK_AREA)
        answer_area(d, b);
    else if (question == VNDF_ASK_LAMBDA)
        answer_lambda(d, b);
    else if (question == VNDF_ASK_G1)
        answer_g1(d, b);
    else if (question == VNDF_ASK_NDF)
        answer_ndf(d, b);
    else if (question == VNDF_ASK_PDF && !vndf_law_is_exact(d))
        answer_pdf(d, b);
    else
        answer_visible(d, b); /* for an exact law it is the density too */
}

#endif
