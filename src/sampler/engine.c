#include "sampler/engine.h"

#include "math/vector.h"
#include "sampler/beckmann.h"
#include "sampler/frame.h"
#include "sampler/ggx.h"
#include "sampler/radial_draw.h"
#include "sampler/wedge.h"

double vndf_unit_area(const vndf_distribution *d, double s, double c)
{
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_area((float)s, (float)c);
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_area((float)s, (float)c);
    double sum = s + fabs(c), below = 2.0 * sum * vndf_wedge_mass(&d->below, s / sum);
    return below + (c > 0.0 ? c : 0.0); /* A(w) = cos + A(-w) */
}

/* Per steradian, of a normal that faces wi: dwm = ax ay X Z^2 dR da / scale^3. */
VNDF_INLINE float per_steradian(const vndf_view *view, float density, float scale)
{
    return vndf_positive(density * (scale * view->per_alpha_x) * (scale * view->per_alpha_y) * scale);
}

/* ---- sampling ---- */

VNDF_INLINE vndf_front front_of(const vndf_view *view)
{
    return vndf_front_of(view->distribution, (float)view->s, (float)view->c);
}

/* |a| where the part `half` of a half turn's mass lies between the side of wi and a, with the mass per radian. */
VNDF_INLINE vndf_azimuth draw_azimuth(const vndf_view *view, float half)
{
    float wedge = (float)view->wedge, target = half * (view->front + wedge);
    vndf_azimuth at;
    if (view->c >= 0.0 && (target < view->front || !(wedge > 0.0f))) {
        float rest = view->front - target;
        return vndf_front_draw(front_of(view), rest > 0.0f ? rest : 0.0f, 1.0f / view->front);
    }
    vndf_azimuth_row row = vndf_wedge_row(view);
    if (view->c >= 0.0) { /* counted from the far side, a = pi */
        float rest = (target - view->front) / wedge;
        at = vndf_azimuth_draw(&row, rest < 1.0f ? 1.0f - rest : 0.0f);
        at.c = -at.c;
    } else {
        at = vndf_azimuth_draw(&row, half);
        at.c = at.c > 1e-7f * at.n ? at.c : 1e-7f * at.n; /* at a right angle from wi nothing is visible */
    }
    at.density *= wedge;
    return at;
}

/* The slope length for an azimuth, from n times the direction. */
VNDF_INLINE vndf_radial_drawn draw_radius(const vndf_view *view, const vndf_azimuth *a, float u)
{
    const vndf_distribution *d = view->distribution;
    float c = (float)view->c * a->n + 0.0f, k = (float)view->s * a->c; /* what rounds to -0 is the horizon */
    if (c < 1e-20f) {
        if (c < 0.0f)
            return vndf_radial_draw_below(d, c, k, u);
        float sum = c + fabsf(k); /* grazing; if it vanishes, at a right angle from wi, any ratio is a limit */
        c = sum > 0.0f ? c / sum : 0.0f;
        k = sum > 0.0f ? k / sum : 1.0f;
    }
    return k < 0.0f && c > 0.0f ? vndf_radial_draw_above(d, c, k, u) : vndf_radial_draw_whole(d, c, k, u);
}

/* A normal whose rounding shows in its density, or turns it away: the density is that of the rounded normal. */
static vndf_vec3 sample_delicate(const vndf_view *view, vndf_vec3 wm, float *pdf)
{
    if (!(vndf_exact_dot(view->wi, wm) > 0.0))
        wm = vndf_turn_to_face(view, wm);
    if (pdf)
        *pdf = vndf_pdf(view, wm);
    return wm;
}

/* Above the horizon, where W = along + up is neither a small difference nor small against what a rounding of the
 * azimuth, a part of `across`, does to it; in a wedge where not all normals have a small W. Rounding must not take
 * the azimuth from the front to the wedge or back either, as the wedge's density is the table's. */
VNDF_INLINE int is_plain(const vndf_view *view, float cos_phi, float x, float z)
{
    const float side = 1e-6f;
    float across = (float)view->s * x, along = across * cos_phi, up = (float)view->c * z;
    if (cos_phi >= 0.0f)
        return view->c >= 0.0 && (cos_phi > 0.05f || (cos_phi > side && along + up > 0.05f * across));
    return view->c >= 0.25 && cos_phi < -side && along + up > 0.1f * (across + up);
}

vndf_vec3 vndf_engine_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    const vndf_distribution *d = view->distribution;
    const vndf_knots *k = &d->knots;
    float half = 2.0f * u1 - 1.0f;
    vndf_azimuth a = draw_azimuth(view, fabsf(half));
    float per_n = 1.0f / a.n, cos_phi = a.c * per_n;
    vndf_vec3 level = {cos_phi, copysignf(a.s, half) * per_n, 0.0f}; /* stretched back while the radius is drawn */
    level = vndf_from_unit(view, level);
    float level2 = level.x * level.x + level.y * level.y;
    vndf_radial_drawn r = draw_radius(view, &a, u2);
    uint32_t j = r.at.cell;
    float x = r.at.eta * k->x[j] + r.at.xi * k->x[j + 1], z = r.at.eta * k->z[j] + r.at.xi * k->z[j + 1];
    float length = sqrtf(x * x * level2 + z * z), per = 1.0f / length; /* from 1e-18 to 1e18 */
    vndf_vec3 wm = {x * level.x * per, x * level.y * per, z * per};
    int plain = is_plain(view, cos_phi, x, z) &&
                fabsf(u2 - 0.5f) < 0.4999f && fabsf(half) < 0.9999f && !r.piece.weighted;
    if (!plain || vndf_radial_is_delicate(d, &r, a.c >= 0.0f))
        return sample_delicate(view, wm, pdf);
    if (pdf)
        *pdf = per_steradian(view, a.density * r.inside.density / (view->area * x * d->cells[j].width), length);
    return wm;
}

/* ---- inverse ---- */

/* A normal of the unit problem taken apart: azimuth |a| and radius. */
typedef struct place {
    float cos_phi, sin_phi;
    vndf_radius at;
} place;

static vndf_radius radius_of(const vndf_distribution *d, float x, float z)
{
    const vndf_knots *k = &d->knots;
    float slope = z > 0.0f ? x / z : HUGE_VALF;
    uint32_t j = vndf_guide_find(&d->slope_guide, slope);
    float inner = x * k->z[j] - z * k->x[j], outer = z * k->x[j + 1] - x * k->z[j + 1];
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
    return view->c >= 0.0 && cos_phi >= 0.0f;
}

/* Whether normals are drawn at an azimuth that is not in front. */
static int is_wedge(const vndf_view *view, float cos_phi)
{
    return (view->c >= 0.0) != (cos_phi >= 0.0f) && view->wedge > 0.0;
}

/* Part of a half turn's mass between the side of wi and |a|. */
static float half_turn(const vndf_view *view, float cos_phi, float sin_phi)
{
    float wedge = (float)view->wedge, total = view->front + wedge;
    if (is_front(view, cos_phi))
        return (view->front - vndf_front_rest(front_of(view), cos_phi, sin_phi)) / total;
    if (!is_wedge(view, cos_phi))
        return 1.0f;
    vndf_azimuth_row row = vndf_wedge_row(view);
    float before = vndf_azimuth_cdf(&row, fabsf(cos_phi), sin_phi);
    return view->c < 0.0 ? before : (view->front + (1.0f - before) * wedge) / total;
}

void vndf_engine_invert(const vndf_view *view, vndf_vec3 normal, float *u1, float *u2)
{
    place p = place_of(view, normal);
    vndf_radial_law law = vndf_radial_law_for(view->distribution, (float)view->c, (float)view->s * p.cos_phi);
    float half = half_turn(view, p.cos_phi, p.sin_phi);
    *u1 = 0.5f + (normal.y < 0.0f ? -0.5f : 0.5f) * half;
    *u2 = law.scale > 0.0f ? vndf_radial_cdf(&law, p.at) : 0.5f;
}
