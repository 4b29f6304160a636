#include "bsdf/terms/masking.h"

#include "bsdf/hit.h"
#include "bsdf/terms/beta.h"

static double area_of(const vndf_bsdf *b, const vndf_event *e)
{
    return (double)vndf_hit_area(&b->view, e->up);
}

static double reflect_correlated(const vndf_bsdf *b, const vndf_event *e)
{
    return vndf_height_correlated(e->cos_i, e->cos_o, (double)b->area, area_of(b, e));
}

/* Heights are u^(1/Lambda_i) distributed from above and (1 - u)^(1/Lambda_o) from below: the part of the
 * microfacets that both see is Beta(1 + Lambda_i, 1 + Lambda_o). */
static double transmit_correlated(const vndf_bsdf *b, const vndf_event *e)
{
    double i = (double)b->area / e->cos_i, o = area_of(b, e) / e->cos_o;
    return vndf_beta(i > 1.0 ? i : 1.0, o > 1.0 ? o : 1.0) / (e->cos_i * e->cos_o);
}

static double separable(const vndf_bsdf *b, const vndf_event *e)
{
    return 1.0 / ((double)b->area * area_of(b, e));
}

/* G1/cos = min(1/cos, 2 cos_m/facing). */
static double cavity(double cosine, double facing, double cos_m)
{
    return 2.0 * cos_m * cosine < facing ? 2.0 * cos_m / facing : 1.0 / cosine;
}

/* The smaller of the two is visible to both. */
static double reflect_in_cavities(const vndf_bsdf *b, const vndf_event *e)
{
    double i = cavity(e->cos_i, e->facing_i, (double)e->wm.z), o = cavity(e->cos_o, e->facing_o, (double)e->wm.z);
    (void)b;
    return i * e->cos_i < o * e->cos_o ? i / e->cos_o : o / e->cos_i;
}

/* From above the upper part of a side is seen, from below the lower one. */
static double transmit_in_cavities(const vndf_bsdf *b, const vndf_event *e)
{
    double i = cavity(e->cos_i, e->facing_i, (double)e->wm.z) * e->cos_i;
    double o = cavity(e->cos_o, e->facing_o, (double)e->wm.z) * e->cos_o, both = i + o - 1.0;
    (void)b;
    return both > 0.0 ? both / (e->cos_i * e->cos_o) : 0.0;
}

static double unmasked(const vndf_bsdf *b, const vndf_event *e)
{
    (void)b;
    return 1.0 / (e->cos_i * e->cos_o);
}

const vndf_masking_routine vndf_masking_height_correlated = {reflect_correlated, transmit_correlated};
const vndf_masking_routine vndf_masking_separable = {separable, separable};
const vndf_masking_routine vndf_masking_v_cavities = {reflect_in_cavities, transmit_in_cavities};
const vndf_masking_routine vndf_masking_none = {unmasked, unmasked};
