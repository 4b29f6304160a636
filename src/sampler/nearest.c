/* Drawing is in float, so a number stands for a mass that is some steps of 2^-24 off. Where there is next to no mass -
 * in far tails, in gaps, beside the cut - these steps lead far away, which the inverse of exact.c does not know. This
 * file draws with the numbers nearby: it tries from 1 to 64 steps each way, of u2 and then of u1, takes the best and
 * begins again there. It tries every step, since a rounding may take a normal back from one step to the next. One
 * random number in ten thousand needs this search of 5 to 50 us; of the others one in ten draws one sample. */
#include "sampler/nearest.h"

#include "sampler/tabulated/theory.h"
#include "sampler/frame.h"

static const float NEAR_ENOUGH = 16e-12f; /* squared */
enum { REACH = 64, ROUNDS = 4 };

/* Both numbers, and the squared distance from their normal to the wanted one. */
typedef struct candidate {
    float u[2], far;
} candidate;

static vndf_vec3 unit_normal(const vndf_view *view, vndf_vec3 wm)
{
    vndf_frame frame = vndf_table_frame(view);
    return vndf_normalize(vndf_to_unit(&frame, wm));
}

static candidate candidate_at(const vndf_view *view, vndf_vec3 wanted, float u1, float u2)
{
    vndf_vec3 n = unit_normal(view, vndf_engine_sample(view, u1, u2, NULL));
    vndf_vec3 apart = {n.x - wanted.x, n.y - wanted.y, n.z - wanted.z};
    candidate made = {{u1, u2}, vndf_dot(apart, apart)};
    return made;
}

/* One step of a number. Draws round 2 u1 - 1 to 2^-24, so a step of u1 below 1/2 is half as long. */
static double step_of(float u, int which)
{
    return which == 0 && u < 0.5f ? 0x1p-25 : 0x1p-24;
}

/* The better of `best` and `from` with one of its numbers moved by `steps`. */
static candidate step(const vndf_view *view, vndf_vec3 wanted, candidate from, int which, int steps,
                      candidate best)
{
    from.u[which] = vndf_clamp_unit((float)(from.u[which] + steps * step_of(from.u[which], which)));
    candidate made = candidate_at(view, wanted, from.u[0], from.u[1]);
    return made.far < best.far ? made : best;
}

static candidate look_along(const vndf_view *view, vndf_vec3 wanted, candidate from, int which)
{
    candidate best = from;
    for (int steps = 1; steps <= REACH && best.far > NEAR_ENOUGH; steps++) {
        best = step(view, wanted, from, which, steps, best);
        best = step(view, wanted, from, which, -steps, best);
    }
    return best;
}

void vndf_nearest(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    vndf_vec3 wanted = unit_normal(view, wm);
    candidate best = candidate_at(view, wanted, *u1, *u2), last = {{*u1, *u2}, HUGE_VALF};
    for (int round = 0; round < ROUNDS && best.far > NEAR_ENOUGH && best.far < last.far; round++) {
        last = best;
        best = look_along(view, wanted, best, 1);
        best = look_along(view, wanted, best, 0);
    }
    *u1 = best.u[0];
    *u2 = best.u[1];
}
