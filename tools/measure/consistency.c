#include "measure/consistency.h"

#include <math.h>

#include "cli/subject.h"
#include "cli/random.h"

/* Below it, certificates do not measure either: the whole lobe is the far end of a tail. */
static const float least_area = 1e-12f;

typedef struct draw {
    consistency_point point;
    vndf_surface surface;
    vndf_view view;
    vndf_vec3 wi, wm;
    float pdf;
} draw;

static double dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Angles uniform, not the sphere: grazing and steep directions are where things break. */
static consistency_point draw_point(random_stream *stream)
{
    consistency_point point;
    point.theta = 180 * random_double(stream);
    point.phi = 360 * random_double(stream);
    point.alpha_x = (float)pow(10, -3 * random_double(stream));
    point.alpha_y = (float)pow(10, -3 * random_double(stream));
    point.u1 = random_float(stream);
    point.u2 = random_float(stream);
    return point;
}

static draw draw_normal(const vndf_distribution *distribution, consistency_point point)
{
    draw it = {.point = point, .surface = {distribution, point.alpha_x, point.alpha_y}};
    it.wi = direction_from(point.theta, point.phi);
    it.view = vndf_view_from(&it.surface, it.wi);
    it.wm = vndf_sample(&it.view, point.u1, point.u2, &it.pdf);
    return it;
}

/* 5e-7: four roundings of a float near 1. */
static int is_valid(const draw *it)
{
    return fabs(dot(it->wm, it->wm) - 1) < 1e-6 && it->wm.z >= 0 && dot(it->wm, it->wi) >= -5e-7 && it->pdf > 0 &&
           isfinite(it->pdf);
}

/* Density 0 is for views that see nothing, or as good as nothing in float. */
static int is_blind(const draw *it)
{
    return it->pdf == 0 && sees_nothing(&it->surface, it->wi);
}

static double pdf_difference(const draw *it)
{
    double pdf = (double)it->pdf;
    return fabs((double)vndf_pdf(&it->view, it->wm) - pdf) / pdf;
}

static double invert_difference(const draw *it)
{
    const double steps = 8 * 0x1p-24;
    float u1, u2;
    vndf_invert(&it->view, it->wm, &u1, &u2);
    if (!(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1))
        return INFINITY;
    if (fabs((double)u1 - (double)it->point.u1) <= steps && fabs((double)u2 - (double)it->point.u2) <= steps)
        return 0;
    vndf_vec3 back = vndf_sample(&it->view, u1, u2, NULL);
    vndf_vec3 apart = {back.x - it->wm.x, back.y - it->wm.y, back.z - it->wm.z};
    return sqrt(dot(apart, apart));
}

/* NaN is worse than any number. */
static void keep_worst(double difference, consistency_point point, double *worst, consistency_point *at)
{
    if (difference <= *worst)
        return;
    *worst = isnan(difference) ? INFINITY : difference;
    *at = point;
}

static void measure_point(const draw *it, consistency *result)
{
    if (is_blind(it)) {
        result->blind++;
        return;
    }
    if (!is_valid(it)) {
        result->invalid++;
        result->invalid_at = it->point;
        return;
    }
    if (vndf_projected_area(&it->surface, it->wi) < least_area)
        return;
    result->measured++;
    keep_worst(pdf_difference(it), it->point, &result->worst_pdf, &result->pdf_at);
    keep_worst(invert_difference(it), it->point, &result->worst_invert, &result->invert_at);
}

consistency consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed)
{
    consistency result = {.points = points};
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < points; i++) {
        draw it = draw_normal(distribution, draw_point(&stream));
        measure_point(&it, &result);
    }
    return result;
}
