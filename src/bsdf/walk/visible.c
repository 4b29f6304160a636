#include "bsdf/walk/visible.h"

#include "sampler/query.h"

double vndf_walk_visible(const vndf_view *view, vndf_normal wm, double facing)
{
    return wm.z >= 0.0 && facing > 0.0 ? vndf_normal_visible(view, wm, facing) : 0.0;
}
