/* Densities, draws and the inverse of the exact tier (exact.h), in double from the caller's own numbers. In float three
 * numbers of a density would cancel: W = wi.wm at the cut, where the density ends; the place of a slope in its cell,
 * which is narrow where D is steep; and the distance to a right angle from wi, where the azimuth's density ends below
 * the horizon. In double none of them needs the turned frame:
 *
 *     s X cos a = wi.x wm.x + wi.y wm.y,       s X sin a = ax wi.x (wm.y/ay) - ay wi.y (wm.x/ax)
 *
 * for the normal (wm.x/ax, wm.y/ay, wm.z) = (X cos a, X sin a, Z), whatever the stretch; s is the level length of the
 * stretched direction before per_length brings it to s + |c| = 1. This file serves every normal, and the builder of
 * tables; density.h and density_wedge.h evaluate most normals, and inverse.h inverts them, in lanes too. The relative
 * error is below 1e-5 of the density that the numbers of the file define, wherever that exceeds 1e-30 (test
 * float_accuracy). */
#include "sampler/tabulated/exact.h"

#include "math/vector.h"
#include "sampler/frame.h"
#include "sampler/tabulated/density_wedge.h"

/* ---- density ---- */

static vndf_azimuth_slice slice_from(const vndf_azimuth_fan *fan, double cosine, double sine, double k)
{
    vndf_azimuth_slice slice = {fan->table, fan->c, k, vndf_azimuth_fan_density(fan, cosine, sine), 0.0, 0.0, 0};
    vndf_exact_law_find(&slice);
    return slice;
}

vndf_azimuth_slice vndf_azimuth_slice_in(const vndf_azimuth_fan *fan, double cosine, double sine)
{
    return slice_from(fan, cosine, sine, fan->s * cosine);
}

vndf_azimuth_slice vndf_azimuth_slice_of(const vndf_view *view, vndf_normal wm)
{
    double mx = wm.x / view->alpha_x, my = wm.y / view->alpha_y, x = sqrt(mx * mx + my * my);
    double level = view->wi.x * wm.x + view->wi.y * wm.y, cosine = 1.0, sine = 0.0;
    vndf_stretched w = vndf_stretched_of(view);
    if (x >
        0.0) { /* for wi straight up or down the azimuth is the normal's own; for a normal straight up it is 0 */
        double per = w.s > 0.0 ? w.per_length / (w.s * x) : 1.0 / x;
        cosine = per * (w.s > 0.0 ? level : mx);
        sine = per * fabs(w.s > 0.0 ? w.x * my - w.y * mx : my);
    }
    vndf_azimuth_fan fan = vndf_azimuth_fan_of(view->distribution, w.s, w.c, (w.c >= 0.0) != (cosine >= 0.0));
    return slice_from(&fan, cosine, sine, x > 0.0 ? level * w.per_length / x : w.s);
}

double vndf_engine_density_on(const vndf_view *view, const vndf_azimuth_slice *slice, vndf_normal wm,
                              double facing)
{
    double ax = view->alpha_x, ay = view->alpha_y, mx = wm.x / ax, my = wm.y / ay, x = sqrt(mx * mx + my * my);
    double scale = 1.0 / (x + wm.z), per_length = vndf_stretched_of(view).per_length;
    double density = vndf_azimuth_slice_density(slice, x * scale, wm.z * scale, facing * per_length * scale);
    return density * scale * scale * scale / (ax * ay);
}

/* The density of any normal that faces wi. */
VNDF_RARE double density_exactly(const vndf_view *view, const vndf_query *g)
{
    vndf_normal wm = {g->x, g->y, g->z};
    vndf_azimuth_slice slice = vndf_azimuth_slice_of(view, wm);
    return vndf_engine_density_on(view, &slice, wm, vndf_query_facing(g));
}

/* Tries density.h and density_wedge.h first. */
static double density_near(const vndf_view *view, const vndf_query *g, const vndf_wedge_near *near)
{
    const vndf_distribution *d = view->distribution;
    int toward = vndf_query_along(g) >= 0.0;
    doubles_m trusted = 1;
    double density = vndf_is_below(view) ? vndf_query_of_wedge(d, g, 1, near, &trusted)
                     : toward            ? vndf_query_in_front(d, g, &trusted)
                                         : vndf_query_of_wedge(d, g, 0, near, &trusted);
    return trusted ? density : density_exactly(view, g);
}

double vndf_engine_density(const vndf_view *view, const vndf_query *g)
{
    return density_near(view, g, NULL);
}

/* ---- D ---- */

double vndf_engine_p22_over_z4(const vndf_distribution *d, double x, double z)
{
    vndf_radial_location at = vndf_radial_location_at(d, x, z);
    vndf_quotient p22 = vndf_radial_location_p22(d, &at);
    return p22.above > 0.0 ? p22.above / p22.below : 0.0;
}

/* ---- draw ---- */

/* The law of the radius, scaled so that k = 1 below the horizon, and no weight is too small for a float above it. Where
 * both weights vanish, at the horizon and at a right angle from wi, any ratio is a limit. */
static vndf_azimuth_slice law_of(const vndf_view *view, const vndf_stretched *w, const vndf_exact_azimuth *a)
{
    vndf_azimuth_slice law = {view->distribution, w->c * a->n, w->s * a->cosine, 0.0, 0.0, 0.0, 0};
    double length = law.c < 0.0 ? law.k : law.c + fabs(law.k);
    if (!(length > 0.0)) {
        law.k = law.c < 0.0 ? 0.0 : 1.0;
    } else if (law.c < 1e-20) {
        law.c /= length;
        law.k /= length;
    }
    vndf_exact_law_find(&law);
    return law;
}

/* The normal at a slope and an azimuth of the turned frame; `half` has the sign of the azimuth. */
static vndf_vec3 normal_at(const vndf_view *view, const vndf_exact_azimuth *a, double half, vndf_exact_slope slope)
{
    double cos_phi = view->of.table.cos_phi, sin_phi = view->of.table.sin_phi, sine = copysign(a->sine, half);
    double x = slope.x * view->alpha_x * (cos_phi * a->cosine - sin_phi * sine);
    double y = slope.x * view->alpha_y * (sin_phi * a->cosine + cos_phi * sine), z = slope.z * a->n;
    double per = 1.0 / sqrt(x * x + y * y + z * z);
    return vndf_vec3_of((float)(x * per), (float)(y * per), (float)(z * per));
}

/* The density is the density of the rounded normal; its search begins where the normal was drawn. */
vndf_vec3 vndf_engine_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf)
{
    float half = 2.0f * u1 - 1.0f;
    vndf_wedge_near near;
    vndf_stretched w = vndf_stretched_of(view);
    vndf_exact_azimuth a = vndf_exact_azimuth_draw(view, &w, fabsf(half), &near);
    vndf_azimuth_slice law = law_of(view, &w, &a);
    vndf_vec3 wm = normal_at(view, &a, half, vndf_exact_law_draw(&law, u2, &near.cell));
    near.cut = law.cut < law.table->radial_count ? law.cut : law.table->radial_count - 1;
    int faces = vndf_exact_dot(view->wi, wm) > 0.0;
    if (!faces) {
        vndf_frame frame = vndf_table_frame(view);
        wm = vndf_turn_to_face(&frame, wm);
        faces = vndf_is_facing(view, wm);
    }
    if (pdf) {
        vndf_query g = vndf_query_of(view, wm);
        double density = faces ? density_near(view, &g, a.in_wedge ? &near : NULL) : 0.0;
        *pdf = faces ? vndf_positive(vndf_density_from(density)) : 0.0f;
    }
    return wm;
}

/* ---- inverse ---- */

/* Both numbers are off by less than 8 steps of 2^-24, which moves the normal by up to 2^-20 over the rate of half
 * a turn, and half of that over the rate of slopes: 5e-6 and 5e-6. */
int vndf_engine_invert(const vndf_view *view, vndf_vec3 normal, float *u1, float *u2)
{
    double x = normal.x, y = normal.y, across = sqrt(x * x + y * y), per = across > 0.0 ? 1.0 / across : 0.0;
    vndf_stretched w = vndf_stretched_of(view);
    vndf_exact_azimuth a = {across > 0.0 ? x * per : 1.0, fabs(y) * per, 1.0, 0};
    vndf_exact_slope slope = {across, normal.z};
    vndf_azimuth_slice law = law_of(view, &w, &a);
    vndf_exact_part half = vndf_exact_azimuth_part(view, &w, a.cosine, a.sine),
                    radius = vndf_exact_law_part(&law, slope);
    *u1 = 0.5f + (normal.y < 0.0f ? -0.5f : 0.5f) * (float)half.part; /* draws round 2 u1 - 1 in the same way */
    *u2 = (float)radius.part;
    return half.rate > 0.2 && radius.rate > 0.1;
}
