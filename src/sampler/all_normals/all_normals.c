/* All normals: a slope length R = X/Z from u2, an azimuth from u1, each by itself. With the stretched level vector
 * (lx, ly) = (ax cos a, ay sin a) the normal is (X lx, X ly, Z)/length, and
 *
 *     D cos(theta_m) = P22(R)/Z^3 length^3/(ax ay)                                                        (1)
 *
 * since cos(theta_m) = Z/length. Law of R, mass P22 R dR of 1/(2 pi):
 *     GGX        R^2 = u/(1 - u):       X = sqrt(u), Z = sqrt(1 - u), P22/Z^3 = Z/pi
 *     Beckmann   R^2 = -log(1 - u):     Z = 1, P22 = (1 - u)/pi
 *     tables     the radial cells of the visible normals with the weights c = 1, k = 0 (radial.h), which D cos is at
 *                normal incidence: the cell by a window of knots, a rational cell m(xi) inverted, and
 *                P22/Z^3 = m/(width X). The azimuth is uniform here, and there a table: TV is that of R alone.
 *
 * V-cavities: the same R, and an azimuth as in v_cavity.h. A normal is taken if it is drawn, or if its twin (-x, -y,
 * z) is, which is as probable: with f = max(0, wi.wm) and f' of the twin the density is D cos(theta_m) 2 f/(f +
 * f'). Where both see wi f + f' = 2 cos(theta_m) cos_i, and it is D f/cos_i; elsewhere 2 D cos(theta_m). Both are
 * D G1 f/cos_i.
 *
 * Densities are formed in float by (1) where that of the place is the one of the normal as it was rounded, else in
 * double from the normal: far in a Beckmann's tail, beside knots and in steep cells of a table, at extreme
 * roughness. wi.wm is always formed from the rounded normal: at the terminator it is a small difference. */
#include "sampler/all_normals/all_normals.h"

#include "math/half_turn.h"
#include "math/vector.h"
#include "sampler/all_normals/v_cavity.h"
#include "sampler/law.h"

/* ---- normal ---- */

/* A normal and the density with which all are drawn. */
typedef struct drawn_normal {
    vndf_vec3 wm;
    double density;
} drawn_normal;

/* Only a far tail rounds to a normal at the horizon. It is lifted by less than a float resolves, and so has a density.
 */
VNDF_RARE drawn_normal normal_exactly(const vndf_distribution *d, double ax, double ay, const vndf_slope *r,
                                      float cosine, float sine)
{
    double x = r->x * (ax * cosine), y = r->x * (ay * sine), z = r->z, per = 1.0 / sqrt(x * x + y * y + z * z);
    drawn_normal drawn = {{(float)(x * per), (float)(y * per), (float)(z * per)}, 0.0};
    drawn.wm.z = drawn.wm.z > FLT_MIN ? drawn.wm.z : FLT_MIN;
    drawn.density = vndf_pdf_all(d, ax, ay, vndf_normal_of(drawn.wm));
    return drawn;
}

VNDF_INLINE drawn_normal normal_at(const vndf_distribution *d, double ax, double ay, const vndf_slope *r,
                                   float cosine, float sine)
{
    float along = (float)ax, across = (float)ay, x = r->x * (along * cosine), y = r->x * (across * sine);
    float length2 = x * x + y * y + r->z * r->z, length = sqrtf(length2), per = 1.0f / length;
    float density = r->p22_over_z3 * (length2 * length) / (along * across);
    if (!(r->trusted & vndf_trusts_scale(along, across, 1.0f)) || !vndf_trusts_density(density))
        return normal_exactly(d, ax, ay, r, cosine, sine);
    drawn_normal drawn = {{x * per, y * per, r->z * per}, density};
    return drawn;
}

vndf_vec3 vndf_sample_all(const vndf_distribution *d, double ax, double ay, float u1, float u2, float *pdf)
{
    float half = 2.0f * vndf_clamp_unit(u1) - 1.0f;
    vndf_slope r = vndf_law_slope(d, vndf_clamp_unit(u2));
    vndf_turn turn = vndf_half_turn(fabsf(half));
    drawn_normal drawn = normal_at(d, ax, ay, &r, turn.cosine, copysignf(turn.sine, half));
    if (pdf)
        *pdf = vndf_positive(vndf_density_from(drawn.density));
    return drawn.wm;
}

double vndf_pdf_all(const vndf_distribution *d, double ax, double ay, vndf_normal wm)
{
    if (!(wm.z >= 0.0))
        return 0.0;
    return vndf_law_pdf_all(d, ax, ay, wm);
}

/* ---- V-cavities ---- */

/* 2 f/(f + f'). */
static double twin_share(vndf_vec3 wi, vndf_normal wm)
{
    double level = wi.x * wm.x + wi.y * wm.y, up = wi.z * wm.z, seen = level + up, other = up - level;
    return seen > 0.0 ? (other > 0.0 ? seen / up : 2.0) : 0.0;
}

/* The stretched azimuth of a normal with slope X/Z by what it and its twin see of wi. */
VNDF_INLINE vndf_turn v_cavity_azimuth(vndf_vec3 wi, double ax, double ay, const vndf_slope *r, float u1)
{
    float along = (float)ax * wi.x, aside = (float)ay * wi.y, across = vndf_length2(along, aside);
    float half = 2.0f * u1 - 1.0f, rest = 2.0f * (half < 0.0f ? u1 : 1.0f - u1), per = 1.0f / across;
    float cos_phi = across > 0.0f ? along * per : 1.0f, sin_phi = across > 0.0f ? aside * per : 0.0f;
    vndf_v_cavity twin = vndf_v_cavity_from(wi.z * r->z, across * r->x);
    vndf_turn from = vndf_half_turn(vndf_v_cavity_draw(&twin, rest));
    float sine = copysignf(from.sine, half);
    vndf_turn turn = {sin_phi * from.cosine + cos_phi * sine, cos_phi * from.cosine - sin_phi * sine};
    return turn;
}

vndf_vec3 vndf_sample_v_cavity(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi, float u1, float u2,
                               float *pdf)
{
    vndf_slope r = vndf_law_slope(d, vndf_clamp_unit(u2));
    vndf_turn turn = v_cavity_azimuth(wi, ax, ay, &r, vndf_clamp_unit(u1));
    drawn_normal drawn = normal_at(d, ax, ay, &r, turn.cosine, turn.sine);
    double share = twin_share(wi, vndf_normal_of(drawn.wm));
    if (!(share > 0.0)) { /* turned away by a rounding: the twin sees wi */
        drawn.wm.x = -drawn.wm.x;
        drawn.wm.y = -drawn.wm.y;
        share = twin_share(wi, vndf_normal_of(drawn.wm));
    }
    if (pdf)
        *pdf = vndf_positive(vndf_density_from(drawn.density * share));
    return drawn.wm;
}

double vndf_pdf_v_cavity(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi, vndf_normal wm)
{
    double share = twin_share(wi, wm);
    return share > 0.0 ? share * vndf_pdf_all(d, ax, ay, wm) : 0.0;
}
