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
#include "bsdf/walk/connect.h"

static const double inverse_pi = 0.31830988618379067;

static double saturated(double x)
{
    return x / (1.0 + x);
}

/* Of the cosine lobes. */
static double share_of(const vndf_walk *walk, const vndf_view *view)
{
    double unit = vndf_unit_area(view->distribution, 1.0, 0.0), cosine = view->wi.z, share;
    double slope2 = unit * unit * view->alpha_x * view->alpha_y;
    if (!walk->transmits)
        share = saturated(9.0 * slope2) * cosine / (cosine + 0.17);
    else if (walk->eta > 1.0f)
        share = saturated(30.0 * slope2) * (1.0 - 1.0 / vndf_law_view_slant(view));
    else
        share = saturated(9.0 * slope2);
    return 0.001 + 0.998 * (share > 0.0 ? share : 0.0);
}

/* Of these, the one on the side of wo. */
static double side_of(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo)
{
    double near = !walk->transmits ? 1.0 : walk->eta > 1.0f ? 0.05 : 1.0 - 0.6 * view->wi.z;
    return wo.z > 0.0f ? near : 1.0 - near;
}

static double scattered(const vndf_walk *walk, const vndf_view *view, vndf_vec3 o, int across)
{
    vndf_walk_scattered s;
    return vndf_walk_scatter(walk, view, walk->eta, o, across, &s) ? s.drawn : 0.0;
}

/* Above the horizon, or over the whole sphere. */
static double first_event(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo)
{
    double density = scattered(walk, view, wo, 0);
    vndf_vec3 mirrored = vndf_vec3_of(wo.x, wo.y, -wo.z), turned = vndf_vec3_of(-wo.x, -wo.y, -wo.z);
    return density + scattered(walk, view, walk->transmits ? turned : mirrored, walk->transmits);
}

float vndf_walk_pdf(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo)
{
    double share = share_of(walk, view);
    if (!walk->transmits && !(wo.z > 0.0f))
        return 0.0f;
    double cosine = fabs((double)wo.z) * inverse_pi * side_of(walk, view, wo);
    return vndf_density_from((1.0 - share) * first_event(walk, view, wo) + share * cosine);
}
