#include "sampler/engine.h"

#include "math/vector.h"
#include "sampler/azimuth.h"
#include "sampler/beckmann.h"
#include "sampler/front.h"
#include "sampler/ggx.h"
#include "sampler/radial.h"

/* ---- area ---- */

/* The cubic Hermite spline of a wedge's mass at y, per (s + |c|). */
static float wedge_mass(const vndf_wedge *wedge, float y)
{
    uint32_t i = vndf_guide_find(&wedge->knot_guide, wedge->knot_y, wedge->knot_count, y);
    float h = wedge->knot_y[i + 1] - wedge->knot_y[i], t = (y - wedge->knot_y[i]) / h, u = 1.0f - t;
    float b0 = wedge->mass[i], b3 = wedge->mass[i + 1]; /* as a Bezier curve: terms >= 0, nothing cancels */
    float b1 = b0 + h * wedge->slope[i] / 3.0f, b2 = b3 - h * wedge->slope[i + 1] / 3.0f;
    return u * u * (u * b0 + 3.0f * t * b1) + t * t * (3.0f * u * b2 + t * b3);
}

/* A(s, -|c|): what is seen from below, s >= 0. */
static float area_below(const vndf_distribution *d, float s, float c)
{
    float sum = s + fabsf(c);
    return 2.0f * sum * wedge_mass(&d->below, s / sum);
}

float vndf_unit_area(const vndf_distribution *d, float s, float c)
{
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_area(s, c);
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_area(s, c);
    return area_below(d, s, c) + (c > 0.0f ? c : 0.0f); /* A(w) = cos + A(-w) */
}

/* ---- view ---- */

static const vndf_wedge *wedge_of(const vndf_view *view)
{
    return view->c >= 0.0f ? &view->distribution->above : &view->distribution->below;
}

static float front_total(const vndf_distribution *d, float s, float c)
{
    return c * d->f0_total * vndf_front_even[VNDF_FRONT_CELLS].cdf + s * d->f1_total;
}

void vndf_engine_view(vndf_view *view)
{
    const vndf_distribution *d = view->distribution;
    float s = view->s, c = view->c, sum = s + fabsf(c);
    float y = c >= 0.0f ? c / sum : s / sum;
    const vndf_wedge *wedge = wedge_of(view);
    uint32_t i = vndf_guide_find(&wedge->row_guide, wedge->row_y, wedge->row_count, y);
    float mix = (y - wedge->row_y[i]) / (wedge->row_y[i + 1] - wedge->row_y[i]);
    view->row = i;
    view->mix = mix;
    view->aspect_p = (1.0f - mix) * wedge->aspect_p[i] + mix * wedge->aspect_p[i + 1];
    view->aspect_r = (1.0f - mix) * wedge->aspect_r[i] + mix * wedge->aspect_r[i + 1];
    view->wedge = sum * wedge_mass(wedge, y);
    view->front = c >= 0.0f ? front_total(d, s, c) : 0.0f;
}

static vndf_azimuth_row front_row(const vndf_view *view)
{
    const vndf_distribution *d = view->distribution;
    vndf_azimuth_row row = {vndf_front_even, vndf_front_cosine, vndf_front_q, view->c * d->f0_total, view->s * d->f1_total,
                            VNDF_FRONT_CELLS, 1.0f, 1.0f};
    return row;
}

static vndf_azimuth_row wedge_row(const vndf_view *view)
{
    const vndf_wedge *wedge = wedge_of(view);
    uint32_t cells = wedge->cell_count;
    const vndf_azimuth_node *first = wedge->nodes + (size_t)view->row * (cells + 1);
    vndf_azimuth_row row = {first, first + cells + 1, wedge->q, 1.0f - view->mix, view->mix, cells, view->aspect_p, view->aspect_r};
    return row;
}

/* ---- sampling ---- */

/* |a| where the mass `half` (0 to 1) of a half turn lies between the side of wi and a. */
static vndf_turn sample_turn(const vndf_view *view, float half)
{
    float target = half * (view->front + view->wedge);
    if (view->c < 0.0f) {
        vndf_azimuth_row row = wedge_row(view);
        return vndf_azimuth_turn(&row, vndf_azimuth_invert(&row, half));
    }
    if (target < view->front || !(view->wedge > 0.0f)) {
        vndf_azimuth_row row = front_row(view);
        return vndf_azimuth_turn(&row, vndf_azimuth_invert(&row, target));
    }
    vndf_azimuth_row row = wedge_row(view); /* counted from the far side, a = pi */
    float rest = (target - view->front) / view->wedge;
    vndf_turn turn = vndf_azimuth_turn(&row, vndf_azimuth_invert(&row, rest < 1.0f ? 1.0f - rest : 0.0f));
    turn.cos_phi = -turn.cos_phi;
    return turn;
}

vndf_vec3 vndf_engine_sample(const vndf_view *view, float u1, float u2)
{
    float half = 2.0f * u1 - 1.0f;
    vndf_turn turn = sample_turn(view, fabsf(half));
    vndf_radial_law law = vndf_radial_law_for(view->distribution, view->c, view->s * turn.cos_phi);
    vndf_radius at = vndf_radial_invert(&law, u2);
    const vndf_pole_knot *knot = &view->distribution->pole[at.cell];
    float x = knot[0].x + at.xi * (knot[1].x - knot[0].x), z = knot[0].z + at.xi * (knot[1].z - knot[0].z);
    vndf_vec3 normal = {x * turn.cos_phi, half < 0.0f ? -x * turn.sin_phi : x * turn.sin_phi, z > 0.0f ? z : 0.0f};
    return normal;
}

/* ---- density and inverse ---- */

/* A normal of the unit problem taken apart. */
typedef struct place {
    vndf_turn turn; /* of |a|: cos of either sign, sin >= 0 */
    vndf_radius at;
} place;

static vndf_radius radius_of(const vndf_distribution *d, float x, float z)
{
    float slope = z > 0.0f ? x / z : HUGE_VALF;
    vndf_radius at = {vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, slope), 0.0f};
    const vndf_pole_knot *k = &d->pole[at.cell];
    float inner = x * k[0].z - z * k[0].x, outer = z * k[1].x - x * k[1].z;
    float xi = inner + outer > 0.0f ? inner / (inner + outer) : 0.0f;
    at.xi = xi > 0.0f ? (xi < 1.0f ? xi : 1.0f) : 0.0f;
    return at;
}

static place place_of(const vndf_view *view, vndf_vec3 normal)
{
    float x = vndf_length2(normal.x, normal.y);
    place p = {{1.0f, 0.0f}, radius_of(view->distribution, x, normal.z)};
    if (x > 0.0f) {
        p.turn.cos_phi = normal.x / x;
        p.turn.sin_phi = fabsf(normal.y) / x;
    }
    return p;
}

/* The row that a turn belongs to, the turn as the row counts it, and the row's scale; 0 if nothing is drawn there. */
static int row_of(const vndf_view *view, vndf_turn *turn, vndf_azimuth_row *row)
{
    int toward = turn->cos_phi >= 0.0f;
    turn->cos_phi = fabsf(turn->cos_phi);
    if (view->c >= 0.0f && toward) {
        *row = front_row(view);
        return view->front > 0.0f;
    }
    *row = wedge_row(view);
    return toward == (view->c < 0.0f) && view->wedge > 0.0f && row->p > 0.0f;
}

float vndf_engine_density(const vndf_view *view, vndf_vec3 normal)
{
    place p = place_of(view, normal);
    float k = view->s * p.turn.cos_phi;
    int front = view->c >= 0.0f && p.turn.cos_phi >= 0.0f;
    vndf_azimuth_row row;
    if (!row_of(view, &p.turn, &row))
        return 0.0f;
    vndf_radial_law law = vndf_radial_law_for(view->distribution, view->c, k);
    if (!(law.total > 0.0f))
        return 0.0f;
    float azimuth = vndf_azimuth_density(&row, vndf_azimuth_q(&row, p.turn)) * (front ? 1.0f : view->wedge);
    float radial = vndf_radial_density_over_x(&law, p.at) / view->distribution->cells[p.at.cell].width;
    return 0.5f * azimuth / (view->front + view->wedge) * radial;
}

/* Part of a half turn's mass between the side of wi and |a|. */
static float half_turn(const vndf_view *view, vndf_turn turn)
{
    vndf_azimuth_row row;
    int front = view->c >= 0.0f && turn.cos_phi >= 0.0f;
    float total = view->front + view->wedge;
    if (!row_of(view, &turn, &row))
        return 1.0f;
    float cdf = vndf_azimuth_cdf(&row, vndf_azimuth_q(&row, turn));
    if (front)
        return cdf / total;
    return view->c < 0.0f ? cdf : (view->front + (1.0f - cdf) * view->wedge) / total;
}

void vndf_engine_invert(const vndf_view *view, vndf_vec3 normal, float *u1, float *u2)
{
    place p = place_of(view, normal);
    vndf_radial_law law = vndf_radial_law_for(view->distribution, view->c, view->s * p.turn.cos_phi);
    float half = half_turn(view, p.turn);
    *u1 = 0.5f + (normal.y < 0.0f ? -0.5f : 0.5f) * half;
    *u2 = law.total > 0.0f ? vndf_radial_cdf(&law, p.at) : 0.5f;
}

/* ---- the distribution ---- */

float vndf_engine_p22_over_z4(const vndf_distribution *d, float x, float z)
{
    vndf_radius at = radius_of(d, x, z);
    const vndf_radial_cell *cell = &d->cells[at.cell];
    float bump = (1.0f - at.xi) * (cell->a + cell->b * at.xi), f_over_x;
    if (at.cell == 0) /* f begins at 0, as X does */
        f_over_x = (cell->f1 + bump) / d->pole[1].x;
    else
        f_over_x = (cell->f0 * (1.0f - at.xi) + at.xi * (cell->f1 + bump)) /
                   (d->pole[at.cell].x + at.xi * (d->pole[at.cell + 1].x - d->pole[at.cell].x));
    return f_over_x > 0.0f ? f_over_x / cell->width : 0.0f;
}
