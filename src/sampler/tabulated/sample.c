#include "sampler/tabulated/theory.h"

#include "math/vector.h"
#include "sampler/tabulated/area.h"
#include "sampler/tabulated/draw.h"
#include "sampler/frame.h"
#include "sampler/law.h"
#include "sampler/tabulated/radial_draw.h"
#include "sampler/stretch.h"

/* ---- sampling ---- */

VNDF_INLINE vndf_front front_of(const vndf_view *view)
{
    return vndf_front_of(view->distribution, view->of.table.s, view->of.table.c);
}

/* The side of the horizon that the direction is on. */
VNDF_INLINE const vndf_wedge *wedge_of(const vndf_view *view)
{
    return vndf_is_below(view) ? &view->distribution->below : &view->distribution->above;
}

/* |a| where the part `half` of a half turn's mass lies between the side of wi and a. */
static vndf_azimuth draw_wedge(const vndf_view *view, float half)
{
    int below = vndf_is_below(view);
    vndf_azimuth_row row = vndf_wedge_row(wedge_of(view), below ? view->of.table.s : view->of.table.c);
    float apart = half * (view->of.table.front + view->of.table.wedge) - view->of.table.front;
    lanes_m plain = 0;
    vndf_azimuth at =
        vndf_azimuth_draw_one(&row, below ? half : vndf_wedge_part(apart, view->of.table.wedge), &plain);
    if (!below)
        at.c = -at.c;
    else
        at.c = at.c > 1e-7f * at.n ? at.c : 1e-7f * at.n; /* at a right angle from wi nothing is visible */
    return at;
}

static int is_drawn_in_front(const vndf_view *view, float half)
{
    return !vndf_is_below(view) && (half * (view->of.table.front + view->of.table.wedge) < view->of.table.front ||
                                    !(view->of.table.wedge > 0.0f));
}

static vndf_azimuth draw_azimuth(const vndf_view *view, float half)
{
    float target = half * (view->of.table.front + view->of.table.wedge);
    float near;
    if (is_drawn_in_front(view, half))
        return vndf_front_draw(front_of(view), lanes_positive(view->of.table.front - target), view->of.table.front,
                               &near);
    return draw_wedge(view, half);
}

/* The slope length for an azimuth, from n times the direction. */
static vndf_radial_drawn draw_radius(const vndf_view *view, const vndf_azimuth *a, float u)
{
    const vndf_distribution *d = view->distribution;
    float c = view->of.table.c * a->n + 0.0f, k = view->of.table.s * a->c; /* what rounds to -0 is the horizon */
    if (c < 1e-20f) {
        if (c < 0.0f)
            return vndf_radial_draw_below(d, c, k, u);
        float sum = c + fabsf(k); /* grazing; if it vanishes, at a right angle from wi, any ratio is a limit */
        c = sum > 0.0f ? c / sum : 0.0f;
        k = sum > 0.0f ? k / sum : 1.0f;
    }
    return k < 0.0f && c > 0.0f ? vndf_radial_draw_above(d, c, k, u) : vndf_radial_draw_whole(d, c, k, u);
}

/* The root is from 1e-18 to 1e18; of its square what is added may be lost among denormals. */
VNDF_INLINE vndf_vec3 normal_from(const vndf_level *level, float x, float z)
{
    float square = x * x * level->square + z * z;
    if (!vndf_is_plain(square))
        return vndf_normalize(vndf_vec3_of(x * level->x, x * level->y, z));
    float per = 1.0f / sqrtf(square);
    return vndf_vec3_of(x * level->x * per, x * level->y * per, z * per);
}

/* Any direction and any place: the density is that of the normal as it was rounded, in double. */
vndf_vec3 vndf_engine_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf)
{
    float half = 2.0f * u1 - 1.0f;
    vndf_azimuth a = draw_azimuth(view, fabsf(half));
    float per_n = 1.0f / a.n;
    vndf_level level = vndf_level_at(view->ax, view->ay, view->of.table.cos_phi, view->of.table.sin_phi,
                                     a.c * per_n, a.s * per_n, half);
    vndf_radial_drawn r = draw_radius(view, &a, u2);
    vndf_radial_lanes cell = vndf_radial_load(view->distribution, r.at.cell);
    float x = r.at.eta * cell.x0 + r.at.xi * cell.x1, z = r.at.eta * cell.z0 + r.at.xi * cell.z1;
    vndf_vec3 wm = normal_from(&level, x, z);
    if (!(vndf_exact_dot(view->wi, wm) > 0.0)) {
        vndf_frame frame = vndf_table_frame(view);
        wm = vndf_turn_to_face(&frame, wm);
    }
    if (pdf)
        *pdf = vndf_is_facing(view, wm) ? vndf_law_pdf(view, wm) : 0.0f;
    return wm;
}

VNDF_INLINE vndf_drawn draw_in_front(const vndf_distribution *d, const vndf_incidence *w,
                                     const vndf_azimuth_range *range, float u2, lanes_m *plain)
{
    vndf_azimuth_sample b = vndf_azimuth_sample_front(d, w, range, u2);
    uint32_t j = vndf_radial_find_one(d, b.code, b.c, b.k, u2 * b.total, 1);
    j = j < d->radial_count - 1 ? j : d->radial_count - 1;
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    vndf_place at = vndf_place_front(d, w, &b, &cell, j, u2, plain);
    return vndf_drawn_at(&b.level, &at, plain);
}

VNDF_INLINE vndf_drawn draw_in_wedge(const vndf_distribution *d, const vndf_incidence *w,
                                     const vndf_azimuth_range *range, float u2, lanes_m *plain)
{
    vndf_azimuth_row row = vndf_wedge_row(&d->above, w->c);
    float part = vndf_wedge_part(fabsf(range->apart), range->mass);
    vndf_azimuth a = vndf_azimuth_draw_one(&row, part, plain);
    vndf_azimuth_sample b = vndf_azimuth_sample_wedge(d, w, range, &a, u2);
    vndf_radial_law law = vndf_radial_law_above(d, b.c, b.k, &b.total);
    uint32_t j = vndf_radial_find_one(d, b.code, b.c, b.k, u2 * b.total, 0);
    j = j < law.cut ? j : law.cut;
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    vndf_place at = vndf_place_wedge(w, &b, &law, &cell, j, u2, plain);
    return vndf_drawn_at(&b.level, &at, plain);
}

vndf_vec3 vndf_engine_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    const vndf_distribution *d = view->distribution;
    float half = 2.0f * u1 - 1.0f;
    vndf_incidence w = vndf_incidence_of(view);
    vndf_azimuth_range range = vndf_azimuth_range_at(view->of.table.front, view->of.table.wedge, half);
    lanes_m plain = w.plain & vndf_trusts_wedge_mass(view->of.table.front, range.mass);
    if (!plain)
        return vndf_engine_sample_exactly(view, u1, u2, pdf);
    vndf_drawn n =
        range.in_front ? draw_in_front(d, &w, &range, u2, &plain) : draw_in_wedge(d, &w, &range, u2, &plain);
    if (!plain)
        return vndf_engine_sample_exactly(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

/* ---- inverse ---- */

/* A normal of the unit problem taken apart: azimuth |a| and radius. */
typedef struct place {
    float cos_phi, sin_phi;
    vndf_radius at;
} place;

static vndf_radius radius_of(const vndf_distribution *d, float x, float z)
{
    float slope = z > 0.0f ? x / z : HUGE_VALF;
    uint32_t j = vndf_guide_find(&d->slope_guide, slope);
    vndf_knot from = d->knots.at[j], to = d->knots.at[j + 1];
    float inner = x * from.z - z * from.x, outer = z * to.x - x * to.z;
    inner = inner > 0.0f ? inner : 0.0f;
    outer = outer > 0.0f ? outer : 0.0f;
    float sum = inner + outer;
    vndf_radius at = {j, sum > 0.0f ? inner / sum : 0.0f, sum > 0.0f ? outer / sum : 1.0f};
    return at;
}

static place place_of(const vndf_view *view, vndf_vec3 normal)
{
    float x = vndf_length2(normal.x, normal.y), per = x > 0.0f ? 1.0f / x : 0.0f;
    place p = {x > 0.0f ? normal.x * per : 1.0f, fabsf(normal.y) * per,
               radius_of(view->distribution, x, normal.z)};
    return p;
}

static int is_front(const vndf_view *view, float cos_phi)
{
    return !vndf_is_below(view) && cos_phi >= 0.0f;
}

/* Whether normals are drawn at an azimuth that is not in front. */
static int is_wedge(const vndf_view *view, float cos_phi)
{
    return !vndf_is_below(view) != (cos_phi >= 0.0f) && view->of.table.wedge > 0.0f;
}

/* Place of an azimuth in the row: its cell of q, and xi within. */
static float place_in_row(const vndf_azimuth_row *row, float cos_phi, float sin_phi, uint32_t *j)
{
    const float *knots = row->wedge->q;
    float c = row->r * cos_phi, s = row->p * sin_phi, q = s / (c + sqrtf(c * c + s * s));
    uint32_t count = 0;
    q = q < 1.0f ? q : 1.0f;
    for (uint32_t i = 1; i < row->wedge->cell_count; i++)
        count += knots[i] <= q;
    *j = count;
    return vndf_clamp_unit((q - knots[count]) / (knots[count + 1] - knots[count]));
}

/* A part of the mass, and mass per radian where it ends, if 2^-20 at least is on either side. */
typedef struct portion {
    float part, rate;
} portion;

/* Of the wedge's mass before an azimuth. */
static portion before_in_wedge(const vndf_view *view, float cos_phi, float sin_phi)
{
    vndf_azimuth_row row =
        vndf_wedge_row(wedge_of(view), !vndf_is_below(view) ? view->of.table.c : view->of.table.s);
    uint32_t j;
    float xi = place_in_row(&row, cos_phi, sin_phi, &j);
    vndf_azimuth_cell cell = vndf_azimuth_cell_at(&row, j);
    portion before = {cell.before + vndf_rational_cdf(&cell.cell, xi),
                      vndf_rational_inner_density(&cell.cell, xi) / vndf_azimuth_turned(&row, &cell, xi)};
    return before;
}

/* Of a half turn's mass between the side of wi and |a|. */
static portion half_turn(const vndf_view *view, float cos_phi, float sin_phi)
{
    float front = view->of.table.front, wedge = view->of.table.wedge, total = front + wedge;
    if (is_front(view, cos_phi)) {
        float rest = vndf_front_rest(front_of(view), cos_phi, sin_phi);
        float rate = rest > 0x1p-20f * total ? vndf_front_density(front_of(view), cos_phi) / total : 0.0f;
        return (portion){(front - rest) / total, rate};
    }
    if (!is_wedge(view, cos_phi))
        return (portion){1.0f, 0.0f};
    portion before = before_in_wedge(view, fabsf(cos_phi), sin_phi);
    portion behind = {(front + (1.0f - before.part) * wedge) / total, before.rate * wedge / total};
    return vndf_is_below(view) ? before : behind;
}

/* Both numbers are off by less than 8 steps of 2^-24, which moves the normal by up to 2^-20 over the rate of half
 * a turn, and half of that over the rate of slopes: 5e-6 and 5e-6. */
int vndf_engine_invert(const vndf_view *view, vndf_vec3 normal, float *u1, float *u2)
{
    place p = place_of(view, normal);
    vndf_radial_law law = vndf_radial_law_for(view->distribution, view->of.table.c, view->of.table.s * p.cos_phi);
    portion half = half_turn(view, p.cos_phi, p.sin_phi);
    *u1 = 0.5f + (normal.y < 0.0f ? -0.5f : 0.5f) * half.part;
    *u2 = law.scale > 0.0f ? vndf_radial_cdf(&law, p.at) : 0.5f;
    return half.rate > 0.2f && vndf_radial_rate(&law, p.at) > 0.1f;
}
