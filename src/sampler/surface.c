/* The public calls on a surface: D, P22, projected area, Lambda, G1, G2. */
#include "sampler/surface.h"

#include "math/vector.h"
#include "sampler/area.h"

float vndf_ndf(const vndf_surface *surface, vndf_vec3 wm)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay))
        return 0.0f;
    vndf_query g = {{ax, ay, 0.0, 0.0, 0.0}, wm.x, wm.y, wm.z};
    return vndf_normal_is_valid(&g) ? vndf_density_from(vndf_law_ndf(surface->distribution, &g)) : 0.0f;
}

float vndf_p22(const vndf_surface *surface, float x, float y)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(fabsf(x) < HUGE_VALF) || !(fabsf(y) < HUGE_VALF))
        return 0.0f;
    double sx = x / ax, sy = y / ay, p22 = vndf_law_p22(surface->distribution, sx * sx + sy * sy);
    return vndf_density_from(p22 / ax / ay);
}

/* Of a surface without a distribution none. */
VNDF_INLINE vndf_direction direction_of(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_direction direction = {0.0, 0.0, w.x, w.y, w.z};
    return vndf_surface_scaled(surface, &direction.ax, &direction.ay) ? direction : (vndf_direction){0};
}

double vndf_unit_area(const vndf_distribution *d, double s, double c)
{
    vndf_direction w = {1.0, 1.0, s, 0.0, c};
    return vndf_law_area_below(d, &w, 1) + doubles_positive(c); /* A(w) = cos + A(-w) */
}

float vndf_area_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 w)
{
    vndf_direction direction = {ax, ay, w.x, w.y, w.z};
    return vndf_area_of(d, &direction);
}

float vndf_projected_area(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_direction direction = direction_of(surface, w);
    return vndf_direction_is_valid(&direction) ? vndf_area_of(surface->distribution, &direction) : 0.0f;
}

float vndf_lambda(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_direction direction = direction_of(surface, w);
    return vndf_direction_is_valid(&direction) ? vndf_lambda_of(surface->distribution, &direction) : 0.0f;
}

float vndf_g1(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_direction direction = direction_of(surface, w);
    return vndf_direction_is_valid(&direction) ? vndf_g1_of(surface->distribution, &direction) : 0.0f;
}

float vndf_g2(const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_g1(surface, wi), vndf_g1(surface, wo), model);
}
