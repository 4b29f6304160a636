/* A family at a parameter: the mixture of its neighbours. */
#include <math.h>

#include "table/family/family.h"

static void put_lobe(const vndf_family *family, size_t knot, double weight, const vndf_surface *shape,
                     vndf_mixture *mixture)
{
    vndf_mixture_lobe *lobe = &mixture->lobe[mixture->count++];
    lobe->surface = *shape;
    lobe->surface.distribution = family->distribution[knot];
    lobe->weight = (float)weight;
}

/* The last knot at or below p, which is within them. */
static size_t knot_below(const vndf_family *family, float p)
{
    size_t low = 0, high = family->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (family->parameter[middle] <= p)
            low = middle;
        else
            high = middle;
    }
    return low;
}

vndf_family_place vndf_family_at(const vndf_family *family, float parameter, const vndf_surface *shape,
                                 vndf_mixture *mixture)
{
    mixture->count = 0;
    if (!family || !shape || isnan(parameter))
        return VNDF_FAMILY_INVALID;
    float low = family->parameter[0], high = family->parameter[family->count - 1];
    float p = parameter < low ? low : parameter > high ? high : parameter;
    size_t knot = knot_below(family, p);
    if (p > family->parameter[knot]) {
        double t = vndf_family_weight(family->parameter[knot], family->parameter[knot + 1], p, family->reciprocal);
        put_lobe(family, knot, 1.0 - t, shape, mixture);
        put_lobe(family, knot + 1, t, shape, mixture);
    } else
        put_lobe(family, knot, 1.0, shape, mixture);
    return parameter < low ? VNDF_FAMILY_BELOW : parameter > high ? VNDF_FAMILY_ABOVE : VNDF_FAMILY_INSIDE;
}
