/* See lanes_sample.h. */
#include "sampler/batch/lanes_sample.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "math/vector.h"
#  include "sampler/area.h"
#  include "sampler/batch/density_of.h"
#  include "sampler/surface.h"
#  include "sampler/batch/below.h"

enum { ALPHA_X, ALPHA_Y, WI_X, WI_Y, WI_Z, U1, U2, INPUTS };

/* The inputs of samples below the horizon, side by side, with room for the last group, and where they come from. */
typedef struct gathered {
    float of[INPUTS][VNDF_BLOCK_SAMPLES + VNDF_DOUBLES];
    uint32_t index[VNDF_BLOCK_SAMPLES], count;
} gathered;

static void put(gathered *to, const vndf_sample_block *b, uint32_t i, uint32_t at)
{
    to->of[ALPHA_X][at] = b->alpha_x[i];
    to->of[ALPHA_Y][at] = b->alpha_y[i];
    to->of[WI_X][at] = b->wi_x[i];
    to->of[WI_Y][at] = b->wi_y[i];
    to->of[WI_Z][at] = b->wi_z[i];
    to->of[U1][at] = vndf_clamp_unit(b->u1[i]);
    to->of[U2][at] = vndf_clamp_unit(b->u2[i]);
}

/* Takes the samples below the horizon out of those that are left. */
static void gather(vndf_sample_block *b, gathered *to)
{
    uint32_t left = 0;
    to->count = 0;
    for (uint32_t n = 0; n < b->left_count; n++) {
        uint32_t i = b->left[n];
        if (i < VNDF_DELICATE && b->wi_z[i] < 0.0f) {
            put(to, b, i, to->count);
            to->index[to->count++] = i;
        } else
            b->left[left++] = i;
    }
    b->left_count = left;
    for (uint32_t spare = 0; spare < VNDF_DOUBLES && to->count > 0; spare++)
        put(to, b, to->index[0], to->count + spare);
}

VNDF_INLINE doubles_m is_between(doubles least, doubles x, doubles most)
{
    return doubles_both(doubles_less(least, x), doubles_less(x, most));
}

/* Roughness and direction of a group. Where they are extreme the lane is not trusted, and draws from others. */
VNDF_INLINE vndf_direction direction_at(const gathered *from, uint32_t i, double scale, doubles_m *trusted)
{
    const doubles least = doubles_set(1e-6), most = doubles_set(1e6), one = doubles_set(1.0);
    vndf_direction w = {doubles_load(from->of[ALPHA_X] + i) * scale, doubles_load(from->of[ALPHA_Y] + i) * scale,
                        doubles_load(from->of[WI_X] + i), doubles_load(from->of[WI_Y] + i),
                        doubles_load(from->of[WI_Z] + i)};
    doubles square = w.x * w.x + w.y * w.y + w.z * w.z;
    doubles_m good = doubles_both(is_between(least, w.ax, most), is_between(least, w.ay, most));
    good = doubles_both(good, is_between(doubles_set(1e-12), square, doubles_set(1e12)));
    vndf_direction safe = {doubles_pick(good, w.ax, one), doubles_pick(good, w.ay, one),
                           doubles_pick(good, w.x, one), doubles_pick(good, w.y, one),
                           doubles_pick(good, w.z, doubles_set(-1.0))};
    *trusted = good;
    return safe;
}

/* Puts a group's samples where they belong, and leaves those that are not trusted. */
VNDF_INLINE void scatter(vndf_sample_block *b, const gathered *from, uint32_t first, const vndf_query *g,
                         doubles density, doubles_m trusted)
{
    float x[VNDF_DOUBLES], y[VNDF_DOUBLES], z[VNDF_DOUBLES], pdf[VNDF_DOUBLES];
    uint32_t bits = doubles_mask_bits(trusted);
    doubles_store_f(x, doubles_narrow(g->x));
    doubles_store_f(y, doubles_narrow(g->y));
    doubles_store_f(z, doubles_narrow(g->z));
    doubles_store_f(pdf, vndf_positive_of(density));
    for (uint32_t n = 0; n < VNDF_DOUBLES && first + n < from->count; n++) {
        uint32_t i = from->index[first + n];
        b->x[i] = x[n];
        b->y[i] = y[n];
        b->z[i] = z[n];
        b->density[i] = pdf[n];
        if (b->weight)
            b->weight[i] = 0.0f;
        b->left[b->left_count] = i;
        b->left_count += !(bits >> n & 1);
    }
}

/* Groups that take a step together. */
enum { GROUPS = 64 / VNDF_DOUBLES };

static void draw(const vndf_distribution *d, vndf_sample_block *b, const gathered *from, uint32_t first,
                 int groups)
{
    double scale = vndf_unit_scale(d);
    vndf_below_sample n[GROUPS];
    for (int k = 0; k < groups; k++) {
        uint32_t i = first + (uint32_t)k * VNDF_DOUBLES;
        n[k].g.wi = direction_at(from, i, scale, &n[k].trusted);
        n[k].half = doubles_widen(doubles_narrow(2.0 * doubles_load(from->of[U1] + i) - 1.0));
        vndf_below_begin(d, &n[k]);
    }
    for (int k = 0; k < groups; k++)
        vndf_below_turn(d, &n[k]);
    for (int k = 0; k < groups; k++)
        vndf_below_cut(d, doubles_load(from->of[U2] + first + (uint32_t)k * VNDF_DOUBLES), &n[k]);
    for (int k = 0; k < groups; k++)
        vndf_below_reach(d, &n[k]);
    for (int k = 0; k < groups; k++)
        vndf_below_end(d, &n[k]);
    for (int k = 0; k < groups; k++) {
        doubles_m seen = doubles_less(doubles_set(0.0), vndf_query_facing(&n[k].g));
        doubles_m trusted = doubles_both(n[k].trusted, seen);
        doubles density = vndf_query_of_wedge(d, &n[k].g, 1, &n[k].near, &trusted);
        scatter(b, from, first + (uint32_t)k * VNDF_DOUBLES, &n[k].g, density, trusted);
    }
}

#  if VNDF_LANES == 16
void vndf_sample_below_avx512(const vndf_distribution *d, vndf_sample_block *b)
#  else
void vndf_sample_below_avx2(const vndf_distribution *d, vndf_sample_block *b)
#  endif
{
    gathered from;
    gather(b, &from);
    for (uint32_t i = 0; i < from.count; i += GROUPS * VNDF_DOUBLES) {
        uint32_t groups = (from.count - i + VNDF_DOUBLES - 1) / VNDF_DOUBLES;
        draw(d, b, &from, i, groups < GROUPS ? (int)groups : GROUPS);
    }
}

#endif
