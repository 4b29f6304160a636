#include "evidence/measure/consistency.h"

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

/* One rounding of a normal changes the density by the slope of D there: a lobe a tenth of its slope wide has
 * some 20 for d log P22 / d log r. */
static int is_steep(const draw *it)
{
    const float up = 1.01f, down = 0.99f;
    float x = it->wm.x / it->wm.z, y = it->wm.y / it->wm.z;
    double high = (double)vndf_p22(&it->surface, up * x, up * y),
           low = (double)vndf_p22(&it->surface, down * x, down * y);
    return !(high > 0 && low > 0 && fabs(log(high / low)) < 20 * 0.02);
}

/* Of unit length when slopes are divided by the roughness. */
static void stretched(const draw *it, double scale, vndf_vec3 wm, double to[3])
{
    to[0] = (double)wm.x / ((double)it->point.alpha_x * scale);
    to[1] = (double)wm.y / ((double)it->point.alpha_y * scale);
    to[2] = (double)wm.z;
    double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    for (int i = 0; i < 3; i++)
        to[i] /= length;
}

static double invert_difference(const draw *it, double scale)
{
    const double steps = 8 * 0x1p-24;
    double from[3], to[3];
    float u1, u2;
    vndf_invert(&it->view, it->wm, &u1, &u2);
    if (!(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1))
        return INFINITY;
    if (fabs((double)u1 - (double)it->point.u1) <= steps && fabs((double)u2 - (double)it->point.u2) <= steps)
        return 0;
    stretched(it, scale, it->wm, from);
    stretched(it, scale, vndf_sample(&it->view, u1, u2, NULL), to);
    double x = to[0] - from[0], y = to[1] - from[1], z = to[2] - from[2], apart = sqrt(x * x + y * y + z * z);
    return isnan(apart) ? INFINITY : apart;
}

typedef struct differences {
    double *above, *below, *inverted, scale;
} differences;

static void measure_point(const draw *it, const differences *room, consistency *found)
{
    int is_above = it->wi.z >= 0;
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
    room->inverted[found->inverted.measured++] = invert_difference(it, room->scale);
    if (is_steep(it))
        return;
    if (is_above)
        room->above[found->above.measured++] = pdf_difference(it);
    else
        room->below[found->below.measured++] = pdf_difference(it);
}

static void conclude(consistency_quantiles *found, double *difference)
{
    if (!found->measured)
        return;
    sort_numbers(difference, found->measured);
    found->usual = difference[(size_t)(0.999 * (double)(found->measured - 1))];
    found->rare = difference[(size_t)(0.9999 * (double)(found->measured - 1))];
}

int consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed, consistency *found)
{
    double scale = vndf_distribution_info(distribution).scale, *room = malloc(3 * points * sizeof *room);
    const differences to = {room, room + points, room + 2 * points, scale > 0 ? scale : 1};
    random_stream stream = random_from(seed);
    int good = room != NULL;
    *found = (consistency){.points = points};
    for (size_t i = 0; room && i < points; i++) {
        draw it = draw_normal(distribution, draw_point(&stream, to.scale));
        measure_point(&it, &to, found);
    }
    conclude(&found->above, to.above);
    conclude(&found->below, to.below);
    conclude(&found->inverted, to.inverted);
    free(room);
    return good;
}
