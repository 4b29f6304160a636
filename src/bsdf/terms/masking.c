#include "bsdf/terms/masking.h"

#include "bsdf/terms/beta.h"
#include "bsdf/trust.h"

static double reflect_correlated(const vndf_bsdf *b, const vndf_event *e)
{
    return vndf_height_correlated(e->cos_i, e->cos_o, (double)b->area, (double)vndf_bsdf_area(b, e->wo));
}

static double exact_area(const vndf_bsdf *b, vndf_vec3 w)
{
    return (double)vndf_area_scaled(b->view.distribution, b->view.alpha_x, b->view.alpha_y, w);
}

/* Heights are u^(1/Lambda_i) distributed from above and (1 - u)^(1/Lambda_o) from below: the part of the
 * microfacets that both see is Beta(1 + Lambda_i, 1 + Lambda_o). */
static double transmit_correlated(const vndf_bsdf *b, const vndf_event *e)
{
    double area = vndf_bsdf_area(b, e->wo), i = b->area / e->cos_i, o = area / e->cos_o;
    if (vndf_needs_exact_areas(i, o)) {
        i = exact_area(b, b->view.wi) / e->cos_i;
        o = exact_area(b, e->wo) / e->cos_o;
    }
    return vndf_beta(i > 1.0 ? i : 1.0, o > 1.0 ? o : 1.0) / (e->cos_i * e->cos_o);
}

static double separable(const vndf_bsdf *b, const vndf_event *e)
{
    return 1.0 / ((double)b->area * vndf_bsdf_area(b, e->wo));
}

/* G1/cos = min(1/cos, 2 cos_m/facing). */
static double cavity(double cosine, double facing, double cos_m)
{
    return 2.0 * cos_m * cosine < facing ? 2.0 * cos_m / facing : 1.0 / cosine;
}

/* The smaller of the two is visible to both. */
static double reflect_in_cavities(const vndf_bsdf *b, const vndf_event *e)
{
    double i = cavity(e->cos_i, e->facing_i, e->cos_m) * e->cos_i;
    double o = cavity(e->cos_o, e->facing_o, e->cos_m) * e->cos_o;
    (void)b;
    return i < o ? cavity(e->cos_i, e->facing_i, e->cos_m) / e->cos_o
                 : cavity(e->cos_o, e->facing_o, e->cos_m) / e->cos_i;
}

/* From above the upper part of a side is seen, from below the lower one. */
static double transmit_in_cavities(const vndf_bsdf *b, const vndf_event *e)
{
    double i = cavity(e->cos_i, e->facing_i, e->cos_m) * e->cos_i;
    double o = cavity(e->cos_o, e->facing_o, e->cos_m) * e->cos_o, both = i + o - 1.0;
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
