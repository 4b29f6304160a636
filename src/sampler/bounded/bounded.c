/* Bounded visible normals (bounded.h): the calls. */
#include "sampler/bounded/bounded.h"

#include "math/vector.h"
#include "sampler/law.h"

static int is_drawn(const vndf_view *view)
{
    return view->distribution && view->wi.z > 0.0f;
}

void vndf_bounds_of(const vndf_view *view, vndf_bounds *bounds)
{
    if (is_drawn(view))
        vndf_law_bounds(view, bounds);
}

vndf_bounded vndf_sample_bounded(const vndf_view *view, const vndf_bounds *bounds, float u1, float u2)
{
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (!is_drawn(view)) {
        vndf_bounded nothing = {{0.0f, 0.0f, 1.0f}, 0.0f, 0.0f, 0.0f};
        return nothing;
    }
    return vndf_law_sample_bounded(view, bounds, u1, u2);
}

double vndf_pdf_bounded(const vndf_view *view, const vndf_bounds *bounds, vndf_normal wm)
{
    if (!is_drawn(view) || !(wm.z > 0.0))
        return 0.0;
    double facing = view->wi.x * wm.x + view->wi.y * wm.y + view->wi.z * wm.z,
           square = wm.x * wm.x + wm.y * wm.y + wm.z * wm.z;
    if (!(2.0 * facing * wm.z > (1.0 - 1e-6) * (view->wi.z * square))) /* by more than roundings */
        return 0.0;
    return vndf_bounded_density(vndf_law_bounded_at(view, bounds, wm, facing));
}
