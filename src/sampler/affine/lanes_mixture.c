/* See lanes_mixture.h. Each lane does what mixture.c does, in the same order. Lanes past the end of a block work on
 * numbers that are in memory, and nobody reads what they make of them. */
#include "sampler/affine/lanes_mixture.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include <math.h>

#  include "sampler/affine/lanes_list.h"
#  include "simd/doubles.h"

#  if VNDF_LANES == 16
#    define NAMED(call) call##_avx512
#  else
#    define NAMED(call) call##_avx2
#  endif

/* ---- weights ---- */

/* One over the sum of the weights; 0 where a weight is invalid. */
VNDF_INLINE doubles per_weight(const float *const *weight, int lobes, uint32_t i)
{
    const doubles nothing = doubles_set(0.0), infinite = doubles_set((double)HUGE_VALF);
    doubles sum = nothing;
    doubles_m valid = doubles_at_most(nothing, nothing);
    for (int l = 0; l < lobes; l++) {
        doubles w = doubles_load(weight[l] + i);
        valid = doubles_both(valid, doubles_both(doubles_at_most(nothing, w), doubles_less(w, infinite)));
        sum = sum + w;
    }
    return doubles_pick(doubles_both(valid, doubles_less(nothing, sum)), 1.0 / sum, nothing);
}

void NAMED(vndf_mixture_weigh)(const float *const *weight, uint32_t count, vndf_lobes_block *at)
{
    const doubles nothing = doubles_set(0.0);
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        doubles per = per_weight(weight, at->lobes, i);
        doubles_m valid = doubles_less(nothing, per);
        doubles_store_long(at->whole.toward + i, doubles_pick(valid, nothing, doubles_set(-1.0)));
        for (int l = 0; l < at->lobes; l++) {
            doubles w = doubles_load(weight[l] + i) * per;
            doubles_store_long(at->lobe[l].weight + i, doubles_pick(valid, w, nothing));
        }
    }
}

/* ---- shares ---- */

/* Adds up areas; a lobe's `share` is its area until all are known. Returns the area of the whole. */
VNDF_INLINE doubles add_areas(vndf_lobes_block *at, uint32_t i)
{
    const doubles nothing = doubles_set(0.0);
    doubles toward = nothing, away = nothing, up = nothing, any = nothing;
    doubles_m valid = doubles_at_most(nothing, nothing);
    for (int l = 0; l < at->lobes; l++) {
        vndf_lobe_block *lobe = &at->lobe[l];
        doubles weight = doubles_load_long(lobe->weight + i), area = doubles_load_long(lobe->areas.toward + i);
        doubles_m has = doubles_less(nothing, weight), good = doubles_at_most(nothing, area);
        doubles part = doubles_pick(has, weight * area, nothing);
        valid = doubles_without(valid, doubles_without(has, good));
        any = any + weight;
        toward = toward + part;
        away = away + doubles_pick(has, weight * doubles_load_long(lobe->areas.away + i), nothing);
        up = up + doubles_pick(has, weight * doubles_load_long(lobe->areas.up + i), nothing);
        doubles_store_long(lobe->share + i, part);
    }
    valid = doubles_both(valid, doubles_less(nothing, any));
    toward = doubles_pick(valid, toward, doubles_set(-1.0));
    doubles_store_long(at->whole.toward + i, toward);
    doubles_store_long(at->whole.away + i, away);
    doubles_store_long(at->whole.up + i, up);
    return toward;
}

/* The last lobe with a weight ends at 1. */
VNDF_INLINE void end_shares(vndf_lobes_block *at, uint32_t i)
{
    const doubles nothing = doubles_set(0.0);
    doubles_m open = doubles_at_most(nothing, nothing);
    for (int l = at->lobes - 1; l >= 0; l--) {
        vndf_lobe_block *lobe = &at->lobe[l];
        doubles_m has = doubles_less(nothing, doubles_load_long(lobe->weight + i)), last = doubles_both(open, has);
        doubles rest = 1.0 - doubles_load_long(lobe->begin + i), share = doubles_load_long(lobe->share + i);
        doubles_store_long(lobe->share + i, doubles_pick(last, rest, share));
        open = doubles_without(open, has);
    }
}

void NAMED(vndf_mixture_share)(uint32_t count, vndf_lobes_block *at)
{
    const doubles nothing = doubles_set(0.0);
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        doubles area = add_areas(at, i), from = nothing;
        doubles_m seen = doubles_less(nothing, area);
        for (int l = 0; l < at->lobes; l++) {
            vndf_lobe_block *lobe = &at->lobe[l];
            doubles weight = doubles_load_long(lobe->weight + i);
            doubles part = doubles_pick(seen, doubles_load_long(lobe->share + i) / area, weight);
            doubles end = doubles_pick(doubles_less(nothing, weight), from + part, from);
            doubles_store_long(lobe->begin + i, from);
            doubles_store_long(lobe->share + i, end - from);
            from = end;
        }
        end_shares(at, i);
    }
}

/* ---- choice ---- */

/* The last lobe that begins at or below u and is drawn at all, or the first with a weight: its number, -1 where the
 * mixture is invalid. */
VNDF_INLINE doubles choose(const vndf_lobes_block *at, uint32_t i, doubles u, doubles *begin, doubles *share)
{
    const doubles nothing = doubles_set(0.0);
    doubles chosen = doubles_set(-1.0);
    doubles_m valid = doubles_at_most(nothing, doubles_load_long(at->whole.toward + i));
    *begin = *share = nothing;
    for (int l = 0; l < at->lobes; l++) {
        const vndf_lobe_block *lobe = &at->lobe[l];
        doubles from = doubles_load_long(lobe->begin + i), part = doubles_load_long(lobe->share + i);
        doubles_m has = doubles_both(valid, doubles_less(nothing, doubles_load_long(lobe->weight + i)));
        doubles_m later = doubles_both(doubles_at_most(from, u), doubles_less(nothing, part));
        doubles_m first = doubles_both(has, doubles_less(chosen, nothing));
        doubles_m here = doubles_without(has, doubles_without(doubles_without(has, later), first));
        chosen = doubles_pick(here, doubles_set((double)l), chosen);
        *begin = doubles_pick(here, from, *begin);
        *share = doubles_pick(here, part, *share);
    }
    return chosen;
}

void NAMED(vndf_mixture_choose)(const vndf_lobes_block *at, const float *u1, uint32_t count, vndf_choice_block *to)
{
    const doubles nothing = doubles_set(0.0);
    for (int l = 0; l < at->lobes; l++)
        to->own[l].count = to->other[l].count = 0;
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        doubles begin, share, u = doubles_between(doubles_positive(doubles_load(u1 + i)), 0.0, 1.0);
        doubles chosen = choose(at, i, u, &begin, &share);
        doubles_m valid = doubles_at_most(nothing, chosen);
        doubles_store_f(to->part + i, doubles_narrow((u - begin) / share));
        doubles_store_long(to->share + i, share);
        for (int l = 0; l < at->lobes; l++) {
            doubles_m has = doubles_both(valid, doubles_less(nothing, doubles_load_long(at->lobe[l].weight + i)));
            doubles away = doubles_abs(chosen - (double)l);
            doubles_m here = doubles_both(valid, doubles_at_most(away, nothing));
            vndf_list_add(&to->own[l], here, vndf_list_indices(i), count);
            vndf_list_add(&to->other[l], doubles_without(has, here), vndf_list_indices(i), count);
        }
    }
}

#endif
