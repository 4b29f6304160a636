#include "measured/model.h"

#include <math.h>

direction direction_at(double theta, double phi)
{
    return (direction){sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
}

double direction_dot(direction a, direction b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

direction direction_mirrored(direction w, direction m)
{
    double twice = 2 * direction_dot(w, m);
    return (direction){twice * m.x - w.x, twice * m.y - w.y, twice * m.z - w.z};
}

direction direction_between(direction a, direction b)
{
    direction sum = {a.x + b.x, a.y + b.y, a.z + b.z};
    double length = sqrt(direction_dot(sum, sum));
    return length > 0 ? (direction){sum.x / length, sum.y / length, sum.z / length} : (direction){0, 0, 1};
}

double model_ndf(const vndf_surface *surface, double theta)
{
    vndf_vec3 wm = {(float)sin(theta), 0.0f, (float)fmax(cos(theta), 0)};
    return (double)vndf_ndf(surface, wm);
}

double model_area(const vndf_surface *surface, direction w)
{
    return (double)vndf_projected_area(surface, (vndf_vec3){(float)w.x, (float)w.y, (float)w.z});
}

double model_masked(double area_i, double cos_i, double area_o, double cos_o)
{
    if (!(cos_o > 0))
        return 0;
    return area_i * cos_o / (area_i * cos_o + area_o * cos_i - cos_i * cos_o);
}

double model_schlick(double cosine)
{
    double away = 1 - cosine, square = away * away;
    return square * square * away;
}

double model_reflected(const vndf_surface *surface, direction wi, direction wo)
{
    if (!(wi.z > 0) || !(wo.z > 0))
        return 0;
    direction m = direction_between(wi, wo);
    double area_i = model_area(surface, wi), area_o = model_area(surface, wo);
    double theta = atan2(hypot(m.x, m.y), m.z);
    return model_ndf(surface, theta) * model_masked(area_i, wi.z, area_o, wo.z) / (4 * area_i);
}
