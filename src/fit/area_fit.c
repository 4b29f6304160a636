#include "fit/area_fit.h"

#include <math.h>

static const double CURVE_MOST = 1e11; /* of an area: beyond it no more knots help */
static const double HALF_PI = 1.57079632679489661923;

vndf_area_value vndf_side_area(const vndf_side *side, double y)
{
    return side->below ? vndf_profile_area_below(side->profile, y) : vndf_profile_area_above(side->profile, y);
}

double vndf_side_mass(const vndf_side *side, double y)
{
    return side->below ? vndf_profile_mass_below(side->profile, y) : vndf_profile_mass_above(side->profile, y);
}

double vndf_side_share(const vndf_side *side, double y, double mass)
{
    if (!side->below)
        return mass / (mass + y * side->profile->f0 * HALF_PI + (1 - y) * side->profile->f1);
    double seen = mass / (side->profile->f1 * hypot(y, 1 - y));
    return side->weight * vndf_profile_fade(side->profile, seen, side->fade);
}

double vndf_side_largest(const vndf_side *side, const double *y, const double *miss, size_t count)
{
    const double rounded = 1e-6; /* far more than areas err */
    double largest = 0.0, most = HUGE_VAL;
    for (size_t i = count; i-- > 0;) {
        if (miss[i] * most <= largest)
            continue;
        double share = vndf_side_share(side, y[i], vndf_side_mass(side, y[i]));
        largest = fmax(largest, miss[i] * share);
        most = share * (1 + rounded);
    }
    return largest;
}

double vndf_side_least(const vndf_side *side)
{
    double low = 0.0, high = 1.0;
    for (int i = 0; side->below && i < 40; i++) {
        double y = (low + high) / 2;
        if (vndf_profile_seen(side->profile, y, y - 1) > vndf_profile_claimed(side->profile))
            high = y;
        else
            low = y;
    }
    return side->below ? high : 0.0;
}

static vndf_area_knot knot_at(const vndf_side *side, double y)
{
    vndf_area_value v = vndf_side_area(side, y);
    vndf_area_knot knot = {v.mass, v.slope, fmin(v.curve, CURVE_MOST)};
    return knot;
}

/* At the ends of [0, 1] the second derivative may be infinite: the value that leads through the middle replaces
 * it. */
void vndf_area_fit_piece(const vndf_side *side, double a, double b, vndf_area_knot *from, vndf_area_knot *to)
{
    *from = knot_at(side, a);
    *to = knot_at(side, b);
    vndf_area_knot *free_end = a <= 0 ? from : b >= 1 ? to : NULL;
    if (!free_end)
        return;
    double h = b - a, piece[VNDF_AREA_ORDER];
    free_end->curve = 0.0;
    vndf_area_piece(h, *from, *to, piece);
    double missing = 32 * (vndf_side_mass(side, a + h / 2) - vndf_area_piece_at(piece, 0.5));
    free_end->curve = fmin(fmax(missing * 2 / (h * h), 0.0), CURVE_MOST);
}

/* What an error of the mass at y counts against. */
static double whole_at(const vndf_side *side, double y, double mass)
{
    double seen = mass + 0.1 * vndf_profile_claimed(side->profile) * side->profile->f1;
    if (!side->below)
        return mass / vndf_side_share(side, y, mass);
    return side->areas < 1 ? fmin(seen / side->areas, mass + (1 - y) / 2) : seen;
}

vndf_interval_miss vndf_area_fit_error(double a, double b, void *user)
{
    static const double at[] = {0.2, 0.45, 0.7, 0.85};
    const vndf_side *side = user;
    vndf_area_knot from, to;
    double h = b - a, worst = 0.0, piece[VNDF_AREA_ORDER];
    vndf_area_fit_piece(side, a, b, &from, &to);
    vndf_area_piece(h, from, to, piece);
    for (unsigned i = 0; i < sizeof at / sizeof *at; i++) {
        double y = a + at[i] * h, reference = vndf_side_mass(side, y);
        double error = fabs(vndf_area_piece_at(piece, at[i]) - reference);
        worst = fmax(worst, error / whole_at(side, y, reference));
    }
    vndf_interval_miss found = {0.0, h > 1e-9 ? worst : 0.0};
    return found;
}
