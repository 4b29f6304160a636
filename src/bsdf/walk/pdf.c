/* The density that goes with a walk: that of the first event, and cosine lobes for all later events.
 *
 * The first event sends directions everywhere. Those that reflection sends below the horizon are mirrored at it,
 * as if the surface met there were flat; so no mass is lost and the integral stays 1. With transmission the
 * sphere is whole, and directions that are on the wrong side of the surface are left where they are: most facets
 * they meet next let them pass. With s = A(horizontal), the mean slope, and Lambda of wi, the share of cosine
 * lobes is
 *
 *     reflection               9 s^2/(1 + 9 s^2) cos_i/(cos_i + 0.17)
 *     transmission, eta > 1    30 s^2/(1 + 30 s^2) Lambda/(1 + Lambda)
 *     transmission, eta < 1    9 s^2/(1 + 9 s^2)
 *
 * fitted by eye to the part of walks of more than one event (GGX, Beckmann and Student-T, alpha 0.05 to 1), and
 * a thousandth more, so that the density is positive where the first event's is not. Light that enters
 * the denser medium mostly stays there; light that comes from it is reflected totally, the more the
 * flatter it comes. */
#include "bsdf/walk/path.h"

static const double inverse_pi = 0.31830988618379067;

static double saturated(double x)
{
    return x / (1.0 + x);
}

/* Of the cosine lobes. s^2 is the product of the areas along both axes of an aligned surface. */
static double share_of(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wi)
{
    const vndf_affine *m = walk->surface;
    double across = (double)vndf_view_area(view, vndf_vec3_of(1.0f, 0.0f, 0.0f)), cosine = (double)wi.z, share;
    double determinant = fabs((double)m->xx * m->yy - (double)m->xy * m->yx);
    double slope2 = across * across * determinant / ((double)m->xx * m->xx + (double)m->xy * m->xy);
    if (!walk->transmits)
        share = saturated(9.0 * slope2) * cosine / (cosine + 0.17);
    else if (walk->eta > 1.0)
        share = saturated(30.0 * slope2) * (1.0 - cosine / (double)vndf_view_area(view, wi));
    else
        share = saturated(9.0 * slope2);
    return 0.001 + 0.998 * (share > 0.0 ? share : 0.0);
}

/* Of these, the one on the side of wo. */
static double side_of(const vndf_walk *walk, vndf_vec3 wi, vndf_vec3 wo)
{
    double near = !walk->transmits ? 1.0 : walk->eta > 1.0 ? 0.05 : 1.0 - 0.6 * (double)wi.z;
    return wo.z > 0.0f ? near : 1.0 - near;
}

/* Above the horizon, or over the whole sphere. */
static double first_event(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wi, vndf_vec3 wo)
{
    vndf_walk_scattered s;
    vndf_vec3 other = walk->transmits ? vndf_turned(wo, -1.0f) : vndf_vec3_of(wo.x, wo.y, -wo.z);
    double density = vndf_walk_scatter(walk, view, wi, walk->eta, wo, 0, &s) ? s.drawn : 0.0;
    return density + (vndf_walk_scatter(walk, view, wi, walk->eta, other, walk->transmits, &s) ? s.drawn : 0.0);
}

float vndf_walk_pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    vndf_walk walk = vndf_walk_of(b);
    const vndf_view *view = &b->view.of.one;
    double share = share_of(&walk, view, b->wi);
    if (!walk.transmits && !(wo.z > 0.0f))
        return 0.0f;
    double cosine = fabs((double)wo.z) * inverse_pi * side_of(&walk, b->wi, wo);
    return vndf_density_from((1.0 - share) * first_event(&walk, view, b->wi, wo) + share * cosine);
}
