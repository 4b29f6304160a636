/* Projected area, Lambda and G1 of any distribution, in double from the caller's own numbers, for one or for lanes. All
 * three come from A(-|w|), the area of the direction turned below the horizon, which is a sum of positive terms:
 * A(w) - A(-w) = cos(theta), so A(|w|) = cos(theta) + A(-|w|) and Lambda = A(-|w|)/cos(theta). */
#ifndef VNDF_SAMPLER_AREA_H
#define VNDF_SAMPLER_AREA_H

#include "sampler/law.h"

/* The area for w made unit. */
VNDF_INLINE doubles_f vndf_area_of(const vndf_distribution *d, const vndf_direction *w)
{
    doubles_m valid = vndf_direction_is_valid(w);
    doubles area = vndf_law_area_below(d, w, valid) + doubles_positive(w->z);
    doubles length = doubles_root(w->x * w->x + w->y * w->y + w->z * w->z);
    return doubles_narrow(doubles_pick(valid, area / length, doubles_set(0.0)));
}

/* At the horizon the quotient is infinite or 0/0, and Lambda becomes FLT_MAX. */
VNDF_INLINE doubles_f vndf_lambda_of(const vndf_distribution *d, const vndf_direction *w)
{
    const doubles most = doubles_set(FLT_MAX);
    doubles_m valid = vndf_direction_is_valid(w);
    doubles exact = vndf_law_area_below(d, w, valid) / doubles_abs(w->z);
    doubles lambda = doubles_widen(doubles_narrow(doubles_pick(doubles_less(exact, most), exact, most)));
    lambda = doubles_pick(doubles_less(w->z, doubles_set(0.0)), -1.0 - lambda, lambda);
    return doubles_narrow(doubles_pick(valid, lambda, doubles_set(0.0)));
}

VNDF_INLINE doubles_f vndf_g1_of(const vndf_distribution *d, const vndf_direction *w)
{
    doubles_m valid = vndf_direction_is_valid(w);
    doubles up = w->z, g1 = up / (up + vndf_law_area_below(d, w, valid)), one = doubles_set(1.0);
    g1 = doubles_pick(doubles_less(g1, one), g1, one);
    doubles_m above = doubles_both(valid, doubles_less(doubles_set(0.0), up));
    return doubles_narrow(doubles_pick(above, g1, doubles_set(0.0)));
}

#endif
