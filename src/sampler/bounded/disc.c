#include "sampler/bounded/disc.h"

#include "math/vector.h"

/* wo.z over wi.z for the normal as it is, or less: per square of its length, and as if that were 1. */
static double rise_of(const vndf_view *view, vndf_normal wm)
{
    double square = wm.x * wm.x + wm.y * wm.y + wm.z * wm.z, z = view->wi.z;
    double facing = view->wi.x * wm.x + view->wi.y * wm.y + view->wi.z * wm.z, twice = 2.0 * facing * wm.z;
    return twice - z * (square > 1.0 ? square : 1.0);
}

static int is_inside(const vndf_view *view, vndf_vec3 wm)
{
    return rise_of(view, vndf_normal_of(wm)) > 0x1p-21 * view->wi.z;
}

static vndf_vec3 rounded(vndf_normal n)
{
    double per = 1.0 / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    vndf_vec3 wm = {(float)(n.x * per), (float)(n.y * per), (float)(n.z * per)};
    return wm;
}

/* The normal of the same azimuth on the border of the disc: b + sqrt(b^2 + wi.z^2) and wi.z are its slope, b =
 * wi.xy along the azimuth. Then inwards, until rounding no longer matters: along any azimuth the disc holds all
 * down to the pole. */
VNDF_RARE vndf_vec3 turned_in(const vndf_view *view, vndf_vec3 wm)
{
    double x = wm.x, y = wm.y, across = sqrt(x * x + y * y), per = across > 0.0 ? 1.0 / across : 0.0;
    double z = view->wi.z, b = per * (view->wi.x * x + view->wi.y * y), root = sqrt(b * b + z * z);
    double up = b > 0.0 ? z : root - b, away = b > 0.0 ? b + root : z;
    for (double step = 0x1p-20; step < 1.0; step *= 2.0) {
        double level = per * away * (1.0 - step);
        vndf_normal n = {level * x, level * y, up + step * step * away};
        wm = rounded(n);
        if (is_inside(view, wm))
            return wm;
    }
    return vndf_vec3_of(0.0f, 0.0f, 1.0f);
}

vndf_vec3 vndf_disc_normal(const vndf_view *view, vndf_normal drawn)
{
    vndf_vec3 wm = rounded(drawn);
    return is_inside(view, wm) ? wm : turned_in(view, wm);
}

/* Where a chord is nothing but rounding no density is infinite. */
static const double LEAST_INSIDE = 1e-37;

double vndf_bounded_density(vndf_bounded_factors at)
{
    return at.visible / (at.inside_mass > LEAST_INSIDE ? at.inside_mass : LEAST_INSIDE);
}

vndf_bounded vndf_bounded_from(vndf_vec3 wm, vndf_bounded_factors at)
{
    double inside_mass = at.inside_mass > LEAST_INSIDE ? at.inside_mass : LEAST_INSIDE;
    vndf_bounded b = {wm, vndf_positive(vndf_density_from(at.visible / inside_mass)), (float)inside_mass, 0.0f};
    return b;
}
