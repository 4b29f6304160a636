/* Bounded visible normals of a table (bounded.h): azimuth first, whose law stays, then the slope length r up to
 * the border of the disc. Along an azimuth a of the stretched frame, where real slopes are r times a vector of
 * squared length q, with k = s cos a
 *
 *     c q r^2 - 2 k r - c < 0,     r < (k + sqrt(k^2 + q c^2))/(q c) = c/(sqrt(k^2 + q c^2) - k),
 *
 * below half the slope at which normals turn away. `inside_mass` is the part of the law of r up to there and u2 is
 * multiplied by it: the sample is that of vndf_sample for (u1, inside_mass u2), and sums from the pole keep the digits
 * of a small part. In float where that is good enough; elsewhere by just that, with inside_mass from exact.c. */
#include "math/vector.h"
#include "sampler/bounded/table.h"
#include "sampler/tabulated/draw.h"
#include "sampler/tabulated/exact.h"

/* ---- in double ---- */

/* Of real slopes at a normal's azimuth; that of a level normal is wi's. */
static double stretch_at(const vndf_view *view, vndf_normal wm)
{
    double ax = view->alpha_x, ay = view->alpha_y, x = wm.x, y = wm.y;
    if (!(x != 0.0 || y != 0.0)) {
        x = view->wi.x * ax * ax;
        y = view->wi.y * ay * ay;
        x = x != 0.0 || y != 0.0 ? x : 1.0;
    }
    double mx = x / ax, my = y / ay;
    return (x * x + y * y) / (mx * mx + my * my);
}

static double inside_mass_on(const vndf_azimuth_slice *slice, double q)
{
    double c = slice->c, k = slice->k, root = sqrt(k * k + q * c * c);
    return k > 0.0 ? vndf_azimuth_slice_part(slice, k + root, q * c) : vndf_azimuth_slice_part(slice, c, root - k);
}

vndf_bounded_factors vndf_bounded_table_at(const vndf_view *view, vndf_normal wm, double facing)
{
    vndf_azimuth_slice slice = vndf_azimuth_slice_of(view, wm);
    vndf_bounded_factors at = {vndf_engine_density_on(view, &slice, wm, facing),
                               inside_mass_on(&slice, stretch_at(view, wm))};
    return at;
}

/* The azimuth that u1 stands for is that of a sample half-way out. */
VNDF_RARE vndf_bounded bounded_exactly(const vndf_view *view, float u1, float u2)
{
    vndf_normal middle = vndf_normal_of(vndf_engine_sample_exactly(view, u1, 0.5f, NULL));
    vndf_azimuth_slice slice = vndf_azimuth_slice_of(view, middle);
    float inside_mass = (float)inside_mass_on(&slice, stretch_at(view, middle));
    vndf_vec3 drawn = vndf_engine_sample_exactly(view, u1, inside_mass * u2, NULL);
    vndf_vec3 wm = vndf_disc_normal(view, vndf_normal_of(drawn));
    return vndf_bounded_from(wm, vndf_bounded_table_at(view, vndf_normal_of(wm), vndf_exact_dot(view->wi, wm)));
}

/* ---- in float ---- */

/* The border of the disc along an azimuth: a normal (x, 0, z) of any length, and the part of the law up to it. */
typedef struct border {
    float x, z, inside_mass;
} border;

/* Mass of a cell, above/below, up to a place that is `inner` and `outer` of its width from its knots: a quotient
 * that is left to be formed with another. */
typedef struct inside {
    float above, below, rise; /* rise: mass per xi, times (below/(mass width))^2 */
} inside;

VNDF_INLINE inside inside_of(const vndf_rational_cell *in, float width, float inner, float outer)
{
    float m = in->mass, w = inner * outer, inner2 = inner * inner;
    inside at = {m * (m * inner2 + in->e0 * w), m * (width * width) + (in->e0 + in->e1 - 2.0f * m) * w,
                 in->e1 * inner2 + 2.0f * m * w + in->e0 * (outer * outer)};
    return at;
}

/* In the two cells beside the cut and at it, which float does not follow: where there is no cut it is at infinity, and
 * little is lost. */
static border border_beside(const vndf_distribution *d, const vndf_radial_law *law, border at, lanes_m *trusted)
{
    vndf_azimuth_slice slice = {d, law->c, law->k, 0.0, 0.0, 0.0, 0};
    vndf_exact_law_find(&slice);
    at.inside_mass = (float)vndf_azimuth_slice_part(&slice, at.x, at.z);
    *trusted &= at.inside_mass > VNDF_TRUST_BORDER_CUT;
    return at;
}

/* The law of the bearing, not scaled; knots have X + Z = 1. inside_mass moves with the slope of the border, and that by
 * 1e-7 of s/root for what the azimuth is rounded by, and by its own rounding: good for 3e-6. */
VNDF_INLINE border border_at(const vndf_distribution *d, const vndf_incidence *w, const vndf_azimuth_sample *b,
                             const vndf_radial_law *law, int whole, lanes_m *trusted)
{
    float qc = b->level.square * b->c, root = sqrtf(b->k * b->k + qc * b->c);
    float n = w->s * b->c, root_c = w->c * root;
    border at = {whole ? b->k + root : b->c, whole ? qc : root - b->k, 1.0f};
    float around = at.x + at.z, per = 1.0f / (around * at.z), x = at.x * (at.z * per), z = at.z * (at.z * per);
    uint32_t j = vndf_guide_find(&d->slope_guide, at.x * (around * per));
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    float inner = lanes_positive(x * cell.z0 - z * cell.x0), outer = lanes_positive(z * cell.x1 - x * cell.z1);
    *trusted &= VNDF_TRUST_BORDER_ROOT * n < root_c;
    if (j + 3 > law->cut)
        return border_beside(d, law, at, trusted);
    vndf_rational_cell in = vndf_radial_cell_away(law, &cell);
    float before = whole ? vndf_radial_before_whole(law, &cell) : vndf_radial_before(law, &cell);
    inside mass = inside_of(&in, cell.width, inner, outer);
    float per_mass = 1.0f / (mass.below * b->total), scale = in.mass * (per_mass * b->total);
    at.inside_mass = (before * mass.below + mass.above) * per_mass;
    float rise = mass.rise * (scale * scale) * (cell.width * (x * z));
    *trusted &= rise * (root_c + n) < VNDF_TRUST_BORDER_STEEP * root_c * (at.inside_mass * b->total);
    return at;
}

/* The normal, if it is far enough inside for its roundings. */
VNDF_INLINE vndf_drawn drawn_inside(const vndf_azimuth_sample *b, vndf_place at, const border *edge,
                                    lanes_m *trusted)
{
    *trusted &= at.x * edge->z * (float)VNDF_TRUST_INSIDE < edge->x * at.z;
    at.below *= edge->inside_mass;
    return vndf_drawn_at(&b->level, &at, trusted);
}

VNDF_INLINE vndf_drawn draw_in_front(const vndf_distribution *d, const vndf_incidence *w,
                                     const vndf_azimuth_range *range, float u2, border *edge, lanes_m *trusted,
                                     float *weight)
{
    vndf_azimuth_sample b = vndf_azimuth_sample_front(d, w, range, u2);
    vndf_radial_law law = vndf_radial_law_whole(d, b.c, b.k);
    *edge = border_at(d, w, &b, &law, 1, trusted);
    float u = edge->inside_mass * u2;
    uint32_t j = vndf_radial_find_one(d, vndf_window_of(d, b.c, b.k, u), b.c, b.k, u * b.total, 1);
    j = j < d->radial_count - 1 ? j : d->radial_count - 1;
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    vndf_place at = vndf_place_front(d, w, &b, &cell, j, u, trusted, weight);
    return drawn_inside(&b, at, edge, trusted);
}

VNDF_INLINE vndf_drawn draw_in_wedge(const vndf_distribution *d, const vndf_incidence *w,
                                     const vndf_azimuth_range *range, float u2, border *edge, lanes_m *trusted,
                                     float *weight)
{
    vndf_azimuth_row row = vndf_wedge_row(&d->above, w->c);
    float part = vndf_wedge_part(fabsf(range->apart), range->mass);
    vndf_azimuth a = vndf_azimuth_draw_one(&row, part, trusted);
    vndf_azimuth_sample b = vndf_azimuth_sample_wedge(d, w, range, &a, u2);
    vndf_radial_law law = vndf_radial_law_above(d, b.c, b.k, &b.total);
    *edge = border_at(d, w, &b, &law, 0, trusted);
    float u = edge->inside_mass * u2;
    uint32_t j = vndf_radial_find_one(d, vndf_window_of(d, b.c, b.k, u), b.c, b.k, u * b.total, 0);
    j = j < law.cut ? j : law.cut;
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    vndf_place at = vndf_place_wedge(d, w, &b, &law, &cell, j, u, trusted, weight);
    return drawn_inside(&b, at, edge, trusted);
}

vndf_bounded vndf_bounded_table(const vndf_view *view, float u1, float u2)
{
    const vndf_distribution *d = view->distribution;
    float half = 2.0f * u1 - 1.0f;
    vndf_incidence w = vndf_incidence_of(view);
    vndf_azimuth_range range = vndf_azimuth_range_at(view->of.table.front, view->of.table.wedge, half);
    lanes_m trusted = w.trusted & vndf_trusts_wedge_mass(view->of.table.front, range.mass);
    border edge;
    float weight;
    if (!trusted)
        return bounded_exactly(view, u1, u2);
    vndf_drawn n = range.in_front ? draw_in_front(d, &w, &range, u2, &edge, &trusted, &weight)
                                  : draw_in_wedge(d, &w, &range, u2, &edge, &trusted, &weight);
    if (!trusted)
        return bounded_exactly(view, u1, u2);
    vndf_bounded b = {vndf_vec3_of(n.x, n.y, n.z), n.density, edge.inside_mass, weight};
    return b;
}
