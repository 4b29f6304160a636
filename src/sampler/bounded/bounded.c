/* Bounded visible normals (bounded.h): what the kinds of distributions share. */
#include "sampler/bounded/bounded.h"

#include "math/vector.h"
#include "table/table.h"

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

/* Where a chord is nothing but rounding no density is infinite. */
static const double LEAST_KEPT = 1e-37;

static vndf_bounded_factors factors_at(const vndf_view *view, const double bounds[VNDF_BOUNDS], vndf_normal wm,
                                       double facing)
{
    vndf_kind kind = view->distribution->kind;
    vndf_bounded_factors at = kind == VNDF_KIND_TABLE ? vndf_bounded_table_at(view, wm, facing)
                              : kind == VNDF_KIND_GGX ? vndf_bounded_ggx_at(view, bounds, wm, facing)
                                                      : vndf_bounded_beckmann_at(view, bounds, wm, facing);
    at.kept = at.kept > LEAST_KEPT ? at.kept : LEAST_KEPT;
    return at;
}

vndf_bounded vndf_bounded_settled(const vndf_view *view, const double bounds[VNDF_BOUNDS], vndf_normal drawn)
{
    vndf_vec3 wm = rounded(drawn);
    if (!is_inside(view, wm))
        wm = turned_in(view, wm);
    vndf_bounded_factors at = factors_at(view, bounds, vndf_normal_of(wm), vndf_exact_dot(view->wi, wm));
    vndf_bounded b = {wm, vndf_positive(vndf_density_from(at.visible / at.kept)), (float)at.kept};
    return b;
}

static int is_drawn(const vndf_view *view)
{
    return view->distribution && view->wi.z > 0.0f;
}

void vndf_bounds_of(vndf_view *view, double bounds[VNDF_BOUNDS])
{
    if (!is_drawn(view) || view->distribution->kind == VNDF_KIND_TABLE)
        return;
    if (view->distribution->kind == VNDF_KIND_GGX)
        vndf_bounds_ggx(view, bounds);
    else
        vndf_bounds_beckmann(view, bounds);
}

vndf_bounded vndf_sample_bounded(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1, float u2)
{
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (!is_drawn(view)) {
        vndf_bounded nothing = {{0.0f, 0.0f, 1.0f}, 0.0f, 0.0f};
        return nothing;
    }
    if (view->distribution->kind == VNDF_KIND_TABLE)
        return vndf_bounded_table(view, u1, u2);
    if (view->distribution->kind == VNDF_KIND_GGX)
        return vndf_bounded_ggx(view, bounds, u1, u2);
    return vndf_bounded_beckmann(view, bounds, u1, u2);
}

double vndf_pdf_bounded(const vndf_view *view, const double bounds[VNDF_BOUNDS], vndf_normal wm)
{
    if (!is_drawn(view) || !(wm.z > 0.0))
        return 0.0;
    double facing = view->wi.x * wm.x + view->wi.y * wm.y + view->wi.z * wm.z,
           square = wm.x * wm.x + wm.y * wm.y + wm.z * wm.z;
    if (!(2.0 * facing * wm.z > (1.0 - 1e-6) * (view->wi.z * square))) /* by more than roundings */
        return 0.0;
    vndf_bounded_factors at = factors_at(view, bounds, wm, facing);
    return at.visible / at.kept;
}
