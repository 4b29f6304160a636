#include "consistency.h"

#include <math.h>

#include "distribution.h"
#include "random.h"

typedef struct draw {
    vndf_surface surface;
    vndf_view view;
    vndf_vec3 wi, wm;
    float u1, u2, pdf;
} draw;

static double dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Angles uniform, not the sphere: grazing and steep directions are where things break. */
static draw draw_normal(const vndf_distribution *distribution, random_stream *stream)
{
    draw it;
    double theta = 180 * random_double(stream), phi = 360 * random_double(stream);
    it.surface.distribution = distribution;
    it.surface.alpha_x = (float)pow(10, -3 * random_double(stream));
    it.surface.alpha_y = (float)pow(10, -3 * random_double(stream));
    it.wi = direction_from(theta, phi);
    it.u1 = random_float(stream);
    it.u2 = random_float(stream);
    it.view = vndf_view_from(&it.surface, it.wi);
    it.wm = vndf_sample(&it.view, it.u1, it.u2, &it.pdf);
    return it;
}

/* 5e-7: four roundings of a float near 1. */
static int is_valid(const draw *it)
{
    return fabs(dot(it->wm, it->wm) - 1) < 1e-6 && it->wm.z >= 0 && dot(it->wm, it->wi) >= -5e-7 &&
           it->pdf > 0 && isfinite(it->pdf);
}

/* Density 0 is for views that see nothing, or as good as nothing in float. */
static int is_blind(const draw *it)
{
    return it->pdf == 0 && vndf_projected_area(&it->surface, it->wi) < 1e-30f;
}

/* NaN is worse than anything. */
static double worse(double a, double b)
{
    return isnan(b) ? INFINITY : fmax(a, b);
}

static double pdf_difference(const draw *it)
{
    double pdf = (double)it->pdf;
    return fabs((double)vndf_pdf(&it->view, it->wm) - pdf) / pdf;
}

static double invert_difference(const draw *it)
{
    const double steps = 4 * 0x1p-24;
    float u1, u2;
    vndf_invert(&it->view, it->wm, &u1, &u2);
    if (!(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1))
        return INFINITY;
    if (fabs((double)u1 - (double)it->u1) <= steps && fabs((double)u2 - (double)it->u2) <= steps)
        return 0;
    vndf_vec3 back = vndf_sample(&it->view, u1, u2, NULL);
    vndf_vec3 apart = {back.x - it->wm.x, back.y - it->wm.y, back.z - it->wm.z};
    return sqrt(dot(apart, apart));
}

consistency consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed)
{
    consistency result = {0, 0, 0, points, 0};
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < points; i++) {
        draw it = draw_normal(distribution, &stream);
        if (is_blind(&it))
            result.blind++;
        else if (!is_valid(&it))
            result.invalid++;
        else {
            result.worst_pdf = worse(result.worst_pdf, pdf_difference(&it));
            result.worst_invert = worse(result.worst_invert, invert_difference(&it));
        }
    }
    return result;
}
