#include "sampler/engine.h"

#include "math/vector.h"
#include "sampler/azimuth.h"
#include "sampler/beckmann.h"
#include "sampler/front.h"
#include "sampler/ggx.h"
#include "sampler/radial.h"

/* ---- area ---- */

/* The spline of a wedge's mass at y, per (s + |c|). */
static float wedge_mass(const vndf_wedge *wedge, float y)
{
    uint32_t i = vndf_guide_find(&wedge->knot_guide, wedge->knot_y, wedge->knot_count, y);
    const float *b = wedge->bezier + (size_t)VNDF_BEZIER * i;
    float t = (y - wedge->knot_y[i]) * b[4], u = 1.0f - t;
    return u * u * (u * b[0] + 3.0f * t * b[1]) + t * t * (3.0f * u * b[2] + t * b[3]);
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

void vndf_engine_view(vndf_view *view)
{
    const vndf_distribution *d = view->distribution;
    const vndf_wedge *wedge = wedge_of(view);
    float s = view->s, c = view->c, y = c >= 0.0f ? c : s;
    uint32_t i = vndf_guide_find(&wedge->row_guide, wedge->row_y, wedge->row_count, y);
    float mix = (y - wedge->row_y[i]) / (wedge->row_y[i + 1] - wedge->row_y[i]);
    view->row = i;
    view->mix = mix;
    view->aspect_p = (1.0f - mix) * wedge->aspect_p[i] + mix * wedge->aspect_p[i + 1];
    view->aspect_r = (1.0f - mix) * wedge->aspect_r[i] + mix * wedge->aspect_r[i + 1];
    view->wedge = wedge_mass(wedge, y);
    view->front = c >= 0.0f ? c * d->f0_total * VNDF_QUARTER_TURN + s * d->f1_total : 0.0f;
    view->area = 2.0f * (view->front + view->wedge);
}

/* The half circle towards wi, above the horizon. */
static vndf_azimuth_row front_row(const vndf_view *view)
{
    const vndf_distribution *d = view->distribution;
    vndf_azimuth_row row = {
        {vndf_front_even_cdf, vndf_front_even_mass, vndf_front_even_density, view->c * d->f0_total},
        {vndf_front_cosine_cdf, vndf_front_cosine_mass, vndf_front_cosine_density, view->s * d->f1_total},
        vndf_front_q, VNDF_FRONT_CELLS, VNDF_FRONT_CELLS, 1.0f, 1.0f};
    return row;
}

/* The wedge: away from wi above the horizon, towards it below. Its mass is 1. */
static vndf_azimuth_row wedge_row(const vndf_view *view)
{
    const vndf_wedge *w = wedge_of(view);
    size_t a = (size_t)view->row * w->stride, b = a + w->stride, end = (size_t)view->row * (w->cell_count + 1);
    vndf_azimuth_row row = {{w->cdf + a, w->cell_mass + a, w->density + end, 1.0f - view->mix},
                            {w->cdf + b, w->cell_mass + b, w->density + end + w->cell_count + 1, view->mix},
                            w->q, w->cell_count, w->stride, view->aspect_p, view->aspect_r};
    return row;
}

/* ---- sampling ---- */

/* |a| where the part `half` of a half turn's mass lies between the side of wi and a, with the mass per radian. */
static vndf_azimuth draw_azimuth(const vndf_view *view, float half)
{
    float target = half * (view->front + view->wedge);
    vndf_azimuth at;
    if (view->c >= 0.0f && (target < view->front || !(view->wedge > 0.0f))) {
        vndf_azimuth_row row = front_row(view);
        return vndf_azimuth_draw(&row, target);
    }
    vndf_azimuth_row row = wedge_row(view);
    if (view->c >= 0.0f) { /* counted from the far side, a = pi */
        float rest = (target - view->front) / view->wedge;
        at = vndf_azimuth_draw(&row, rest < 1.0f ? 1.0f - rest : 0.0f);
        at.c = -at.c;
    } else
        at = vndf_azimuth_draw(&row, half);
    at.density *= view->wedge;
    return at;
}

void vndf_engine_sample(const vndf_view *view, float u1, float u2, vndf_engine_draw *draw)
{
    float half = 2.0f * u1 - 1.0f;
    vndf_azimuth a = draw_azimuth(view, fabsf(half));
    draw->law = vndf_radial_law_for(view->distribution, view->c * a.n, view->s * a.c);
    vndf_radius at = vndf_radial_draw(&draw->law, u2, &draw->piece, &draw->inside);
    const vndf_knots *k = &view->distribution->knots;
    float x = k->x[at.cell] + at.xi * (k->x[at.cell + 1] - k->x[at.cell]);
    float z = k->z[at.cell] + at.xi * (k->z[at.cell + 1] - k->z[at.cell]), across = x / a.n;
    draw->normal.x = across * a.c;
    draw->normal.y = across * (half < 0.0f ? -a.s : a.s);
    draw->normal.z = z > 0.0f ? z : 0.0f;
    draw->at = at;
    draw->n = a.n;
    draw->azimuth = 0.5f * a.density / (view->front + view->wedge);
}

float vndf_engine_drawn(const vndf_engine_draw *draw, float w)
{
    return draw->azimuth * vndf_radial_density(&draw->law, &draw->piece, draw->at, draw->inside, draw->n * w);
}

/* ---- density and inverse ---- */

/* A normal of the unit problem taken apart: azimuth |a| and radius. */
typedef struct place {
    float cos_phi, sin_phi;
    vndf_radius at;
} place;

static vndf_radius radius_of(const vndf_distribution *d, float x, float z)
{
    const vndf_knots *k = &d->knots;
    float slope = z > 0.0f ? x / z : HUGE_VALF;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, slope);
    float inner = x * k->z[j] - z * k->x[j], outer = z * k->x[j + 1] - x * k->z[j + 1];
    float xi = inner + outer > 0.0f ? inner / (inner + outer) : 0.0f;
    vndf_radius at = {j, xi > 0.0f ? (xi < 1.0f ? xi : 1.0f) : 0.0f};
    return at;
}

static place place_of(const vndf_view *view, vndf_vec3 normal)
{
    float x = vndf_length2(normal.x, normal.y), per = x > 0.0f ? 1.0f / x : 0.0f;
    place p = {x > 0.0f ? normal.x * per : 1.0f, fabsf(normal.y) * per, radius_of(view->distribution, x, normal.z)};
    return p;
}

/* The row that an azimuth belongs to; 0 if nothing is drawn there. */
static int row_of(const vndf_view *view, float cos_phi, vndf_azimuth_row *row)
{
    int toward = cos_phi >= 0.0f, above = view->c >= 0.0f;
    if (above && toward) {
        *row = front_row(view);
        return view->front > 0.0f;
    }
    *row = wedge_row(view);
    return above != toward && view->wedge > 0.0f && row->p > 0.0f;
}

float vndf_engine_density(const vndf_view *view, vndf_vec3 normal, float w)
{
    place p = place_of(view, normal);
    vndf_azimuth_row row;
    if (!row_of(view, p.cos_phi, &row))
        return 0.0f;
    vndf_radial_law law = vndf_radial_law_for(view->distribution, view->c, view->s * p.cos_phi);
    vndf_radial_piece piece = vndf_radial_piece_of(&law, p.at.cell);
    float azimuth = vndf_azimuth_density(&row, fabsf(p.cos_phi), p.sin_phi);
    if (row.q != vndf_front_q)
        azimuth *= view->wedge;
    float radial = vndf_radial_density(&law, &piece, p.at, vndf_radial_inside(&piece, p.at.xi), w);
    return 0.5f * azimuth / (view->front + view->wedge) * radial;
}

/* Part of a half turn's mass between the side of wi and |a|. */
static float half_turn(const vndf_view *view, float cos_phi, float sin_phi)
{
    vndf_azimuth_row row;
    float total = view->front + view->wedge;
    if (!row_of(view, cos_phi, &row))
        return 1.0f;
    float before = vndf_azimuth_cdf(&row, fabsf(cos_phi), sin_phi);
    if (row.q == vndf_front_q)
        return before / total;
    return view->c < 0.0f ? before : (view->front + (1.0f - before) * view->wedge) / total;
}

void vndf_engine_invert(const vndf_view *view, vndf_vec3 normal, float *u1, float *u2)
{
    place p = place_of(view, normal);
    vndf_radial_law law = vndf_radial_law_for(view->distribution, view->c, view->s * p.cos_phi);
    float half = half_turn(view, p.cos_phi, p.sin_phi);
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
        f_over_x = (cell->f1 + bump) / d->knots.x[1];
    else
        f_over_x = (cell->f0 * (1.0f - at.xi) + at.xi * (cell->f1 + bump)) /
                   (d->knots.x[at.cell] + at.xi * (d->knots.x[at.cell + 1] - d->knots.x[at.cell]));
    return f_over_x > 0.0f ? f_over_x / cell->width : 0.0f;
}
