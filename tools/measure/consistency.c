#include "measure/consistency.h"

#include <math.h>
#include <stdlib.h>

#include "cli/subject.h"
#include "cli/random.h"
#include "cli/sort.h"

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
static consistency_point draw_point(random_stream *stream, double scale)
{
    consistency_point point;
    point.theta = 180 * random_double(stream);
    point.phi = 360 * random_double(stream);
    point.alpha_x = (float)(pow(0.02, random_double(stream)) / scale);
    point.alpha_y = (float)(pow(0.02, random_double(stream)) / scale);
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
    return fabs((double)vndf_pdf(&it->view, it->wm) / (double)it->pdf - 1);
}

/* One rounding of a normal changes the density by the slope of D there: a lobe a tenth of its slope wide has up to 50
 * for d log P22 / d log r. */
static int is_steep(const draw *it)
{
    const float up = 1.01f, down = 0.99f;
    float x = it->wm.x / it->wm.z, y = it->wm.y / it->wm.z;
    double high = (double)vndf_p22(&it->surface, up * x, up * y),
           low = (double)vndf_p22(&it->surface, down * x, down * y);
    return !(high > 0 && low > 0 && fabs(log(high / low)) < 50 * 0.02);
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

static void measure_point(const draw *it, double *above, double *below, consistency *found)
{
    int is_above = it->wi.z >= 0;
    consistency_side *side = is_above ? &found->above : &found->below;
    if (is_blind(it)) {
        found->blind++;
        return;
    }
    if (!is_valid(it)) {
        found->invalid++;
        found->invalid_at = it->point;
        return;
    }
    if (vndf_projected_area(&it->surface, it->wi) < least_area)
        return;
    if (!is_steep(it))
        (is_above ? above : below)[side->measured++] = pdf_difference(it);
    double apart = invert_difference(it);
    if (!(apart <= found->worst_invert)) { /* NaN is worse than any number */
        found->worst_invert = isnan(apart) ? INFINITY : apart;
        found->invert_at = it->point;
    }
}

static void conclude(consistency_side *side, double *difference)
{
    if (!side->measured)
        return;
    sort_numbers(difference, side->measured);
    side->usual = difference[(size_t)(0.999 * (double)(side->measured - 1))];
    side->rare = difference[(size_t)(0.9999 * (double)(side->measured - 1))];
}

int consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed, consistency *found)
{
    double scale = vndf_distribution_info(distribution).scale, *above = malloc(2 * points * sizeof *above);
    random_stream stream = random_from(seed);
    *found = (consistency){.points = points};
    if (!above)
        return 0;
    for (size_t i = 0; i < points; i++) {
        draw it = draw_normal(distribution, draw_point(&stream, scale > 0 ? scale : 1));
        measure_point(&it, above, above + points, found);
    }
    conclude(&found->above, above);
    conclude(&found->below, above + points);
    free(above);
    return 1;
}
