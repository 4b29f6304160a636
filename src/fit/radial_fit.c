/* The fit judges a cell by the laws that the sampler draws from it: weights Z (all normals), X (grazing), and
 * the two weights that vanish at one end (a cut there). The error of a law, half the integral of |drawn - true|,
 * counts by the largest share of the visible normals that the cell holds from any direction. */
#include "fit/radial_fit.h"

#include <math.h>
#include <stdlib.h>

#include "math/weighted_cell.h"
#include "table/moment_cubic.h"

enum { JUMPS_MAX = 256, PIECES_MAX = 16 };

static const double SLOPE_MOST = 1e29;  /* 1/R remains a normal float */
static const double WIDTH_LEAST = 2e-5; /* of a cell, relative to its slope: xi keeps a hundred steps in float */

/* How far from a jump, relative to its slope, the fit reads the values on either side: beyond the narrow panel. */
static const double BESIDE = 1e-9;
static const double JUMP_LEAST = 1e-4;   /* of the higher side: cells err by more than a smaller jump */
static const double JUMP_MASS = 1e-25;   /* P r^2 at a jump that is worth a knot: well above the floor */
static const double SAME_JUMP = 1.0001;  /* ratio of slopes within which narrow panels mean one jump */
static const double INSIDE_JUMP = 4e-7;  /* of the slope: four floats into the cell, since knots are rounded */
static const double NEAR_HORIZON = 1e-6; /* of the last cell: x/z is finite there */

/* An end of f this many times above the mean is a pole of D: the fit keeps the cell bounded. */
static const double END_MOST = 50;
static const double MASS_LEAST = 1e-36; /* of a cell: a normal float with some room for products */
static const double ENDS_MOST = 3; /* both ends of a bent cubic together, over its mass: at 4 no mass is inside */
static const double INSIDE = 1e-3; /* the cubic stays above 0 when its moments are rounded to float */

/* ---- knots ---- */

static int jumps_at(const vndf_profile *profile, double r)
{
    double here = vndf_profile_p22(profile, r * (1 - BESIDE)), there = vndf_profile_p22(profile, r * (1 + BESIDE));
    return fabs(here - there) > JUMP_LEAST * fmax(here, there) && fmax(here, there) * r * r > JUMP_MASS;
}

int vndf_radial_fit_from(vndf_radial_fit *fit, const vndf_profile *profile)
{
    double last = 0.0;
    fit->profile = profile;
    fit->jump_count = 0;
    fit->jump = malloc(JUMPS_MAX * sizeof *fit->jump);
    for (size_t i = 1; fit->jump && i < profile->count && fit->jump_count < JUMPS_MAX; i++) {
        double r = profile->panel[i].r;
        if (r > last * SAME_JUMP && jumps_at(profile, r))
            fit->jump[fit->jump_count++] = last = r;
    }
    return fit->jump != NULL;
}

void vndf_radial_fit_free(vndf_radial_fit *fit)
{
    free(fit->jump);
    fit->jump = NULL;
}

static int is_jump(const vndf_radial_fit *fit, double r)
{
    for (size_t i = 0; i < fit->jump_count; i++)
        if (fit->jump[i] == r)
            return 1;
    return 0;
}

/* Among the floats about a knot, the pair x, z whose slope is next to r on the given side: both together come
 * nearer to r than either alone. */
static void round_to_side(vndf_fit_knot *knot, double r, int above)
{
    const float x[] = {nextafterf(knot->x, 0.0f), knot->x, nextafterf(knot->x, 2.0f)};
    const float z[] = {nextafterf(knot->z, 0.0f), knot->z, nextafterf(knot->z, 2.0f)};
    double nearest = HUGE_VAL;
    for (int i = 0; i < 9; i++) {
        double beyond = ((double)x[i / 3] / (double)z[i % 3] / r - 1) * (above ? 1 : -1);
        if (beyond >= 0 && beyond < nearest) {
            nearest = beyond;
            knot->x = x[i / 3];
            knot->z = z[i % 3];
        }
    }
}

vndf_fit_knot vndf_fit_knot_at(const vndf_radial_fit *fit, double r)
{
    int infinite = r == HUGE_VAL;
    vndf_fit_knot knot = {infinite ? 1.0f : (float)(r / (1 + r)), (float)(1 / (1 + r)), r, is_jump(fit, r)};
    if (knot.jump) { /* the side with more normals keeps its edge inside its own cell */
        double before = vndf_profile_p22(fit->profile, r * (1 - BESIDE));
        round_to_side(&knot, r, before > vndf_profile_p22(fit->profile, r * (1 + BESIDE)));
    }
    if (!infinite)
        knot.r = (double)knot.x / (double)knot.z;
    return knot;
}

double vndf_fit_middle(double a, double b)
{
    double xa = a / (1 + a), za = 1 / (1 + a), xb = b < HUGE_VAL ? b / (1 + b) : 1.0, zb = 1 / (1 + b);
    return (xa + xb) / (za + zb);
}

/* ---- cells ---- */

static double width_of(vndf_fit_knot a, vndf_fit_knot b)
{
    return (double)b.x * a.z - (double)a.x * b.z;
}

/* A place in a cell. */
typedef struct spot {
    double x, z;
} spot;

static spot spot_at(vndf_fit_knot a, vndf_fit_knot b, double xi)
{
    spot at = {a.x + xi * ((double)b.x - a.x), a.z + xi * ((double)b.z - a.z)};
    return at;
}

/* f: P X width/Z^4. */
static double f_of(spot at, double p22, double width)
{
    return p22 * at.x * width / (at.z * at.z * at.z * at.z);
}

static double f_at(const vndf_radial_fit *fit, vndf_fit_knot a, vndf_fit_knot b, double xi)
{
    spot at = spot_at(a, b, xi);
    return f_of(at, vndf_profile_p22(fit->profile, at.x / at.z), width_of(a, b));
}

/* f at the VNDF_GAUSS places xi. */
static void f_rule(const vndf_radial_fit *fit, vndf_fit_knot a, vndf_fit_knot b, const double *xi, double *f)
{
    double r[VNDF_GAUSS], p22[VNDF_GAUSS];
    for (int i = 0; i < VNDF_GAUSS; i++) {
        spot at = spot_at(a, b, xi[i]);
        r[i] = at.x / at.z;
    }
    vndf_profile_p22_many(fit->profile, r, VNDF_GAUSS, p22);
    for (int i = 0; i < VNDF_GAUSS; i++)
        f[i] = f_of(spot_at(a, b, xi[i]), p22[i], width_of(a, b));
}

/* f at an end of the cell: where P jumps its value inside the cell, at the horizon its limit. */
static double f_end(const vndf_radial_fit *fit, vndf_fit_knot a, vndf_fit_knot b, int outer)
{
    double inside = INSIDE_JUMP * (outer ? b.r : a.r) / (b.r - a.r);
    if (outer && b.z == 0.0f)
        return f_at(fit, a, b, 1 - NEAR_HORIZON);
    if (!(outer ? b.jump : a.jump))
        return f_at(fit, a, b, outer ? 1.0 : 0.0);
    inside = inside < 0.25 ? inside : 0.25;
    return f_at(fit, a, b, outer ? 1 - inside : inside);
}

/* Where the cubic would be negative, one of its inner Bernstein coefficients is negative. That one is raised to
 * (almost) 0 and the other lowered, which keeps the mass. Ends that would need more than the whole mass are
 * lowered first. */
static void keep_positive(vndf_radial_cell *cell)
{
    double mass = (double)cell->mu0 + cell->mu1, f0 = cell->f0, f1 = cell->f1;
    vndf_moment_cubic cubic = vndf_moment_cubic_from(f0, f1, cell->mu0, cell->mu1);
    double first = (2 * f0 + f1 + cubic.a) / 3, second = (f0 + 2 * f1 + cubic.a + cubic.b) / 3;
    if (first >= 0 && second >= 0)
        return;
    double lower = fmin(1.0, ENDS_MOST * mass / (f0 + f1)), inner = 4 * mass - lower * (f0 + f1);
    first = fmin(fmax(lower * first, INSIDE * inner), (1 - INSIDE) * inner);
    second = inner - first;
    cell->f0 = (float)(f0 *= lower);
    cell->f1 = (float)(f1 *= lower);
    cell->mu0 = (float)((4 * f0 + 3 * first + 2 * second + f1) / 20);
    cell->mu1 = (float)((f0 + 2 * first + 3 * second + 4 * f1) / 20);
}

vndf_radial_cell vndf_fit_cell(const vndf_radial_fit *fit, vndf_fit_knot a, vndf_fit_knot b)
{
    vndf_radial_cell cell = {0};
    vndf_moments m = vndf_profile_moments(fit->profile, a.r, b.r);
    double mu0 = b.z > 0.0f ? (m.m0 - m.m1 / (b.r - a.r)) / a.z : m.m0 / a.z;
    double mu1 = b.z > 0.0f ? m.m1 / (b.r - a.r) / b.z : m.m1, most = END_MOST * (mu0 + mu1);
    double f1 = f_end(fit, a, b, 1), f0 = a.x > 0.0f ? f_end(fit, a, b, 0) : 0.0;
    cell.f0 = (float)(f0 < most ? f0 : most);
    cell.f1 = (float)(f1 < most ? f1 : most);
    cell.mu0 = (float)(mu0 > MASS_LEAST ? mu0 : MASS_LEAST);
    cell.mu1 = (float)(mu1 > MASS_LEAST ? mu1 : MASS_LEAST);
    cell.width = (float)width_of(a, b);
    keep_positive(&cell);
    return cell;
}

/* ---- errors ---- */

typedef struct law_error {
    double all, grazing, cut_inside, cut_outside, cubic;
} law_error;

/* |drawn - true| at xi for the weight w0 (1-xi) + w1 xi, as the sampler draws at a cut and away from it. */
static double miss(const vndf_radial_cell *cell, double w0, double w1, double f, double xi)
{
    double mass = w0 * cell->mu0 + w1 * cell->mu1, w = w0 * (1 - xi) + w1 * xi, sum = w0 + w1;
    int weighted = w0 == 0 || w1 == 0;
    vndf_rational_cell drawn = {(float)(cell->f0 * (weighted ? sum / 2 : w0) / mass),
                                (float)(cell->f1 * (weighted ? sum / 2 : w1) / mass), 1.0f};
    float at = weighted ? vndf_weighted_zeta((float)w0, (float)w1, (float)xi) : (float)xi;
    return fabs((double)vndf_rational_density(&drawn, at) * (weighted ? 2 * w / sum : 1) - f * w / mass);
}

static double miss_cubic(const vndf_radial_cell *cell, double f, double xi)
{
    vndf_moment_cubic cubic = vndf_moment_cubic_from(cell->f0, cell->f1, cell->mu0, cell->mu1);
    double drawn = cell->f0 * (1 - xi) + cell->f1 * xi + xi * (1 - xi) * (cubic.a + cubic.b * xi);
    return fabs(drawn - f) / (cell->mu0 + cell->mu1);
}

/* Half the integrals over the cell by `pieces` Gauss rules, and the mass that the cell lacks by the same rules. */
static law_error measure(const vndf_radial_fit *fit, vndf_fit_knot a, vndf_fit_knot b,
                         const vndf_radial_cell *cell, int pieces)
{
    law_error e = {0, 0, 0, 0, 0};
    double mass = 0.0, lack;
    for (int piece = 0; piece < pieces; piece++) {
        double xi[VNDF_GAUSS], f[VNDF_GAUSS];
        for (int i = 0; i < VNDF_GAUSS; i++)
            xi[i] = (piece + vndf_gauss_node[i]) / pieces;
        f_rule(fit, a, b, xi, f);
        for (int i = 0; i < VNDF_GAUSS; i++) {
            double w = 0.5 * vndf_gauss_weight[i] / pieces;
            e.all += w * miss(cell, a.z, b.z, f[i], xi[i]);
            e.grazing += w * miss(cell, a.x, b.x, f[i], xi[i]);
            e.cut_inside += w * miss(cell, 0, 1, f[i], xi[i]);
            e.cut_outside += w * miss(cell, 1, 0, f[i], xi[i]);
            e.cubic += w * miss_cubic(cell, f[i], xi[i]);
            mass += 2 * w * f[i];
        }
    }
    lack = fabs(mass / ((double)cell->mu0 + cell->mu1) - 1.0);
    e.all += lack;
    e.grazing += lack;
    e.cut_inside += lack;
    return e;
}

static size_t panels_between(const vndf_profile *profile, double a, double b)
{
    size_t n = 0;
    for (size_t i = 0; i < profile->count && n < PIECES_MAX; i++)
        n += profile->panel[i].r > a && profile->panel[i].r < b;
    return n;
}

/* The weight of errors at slope r for a view below the horizon that sees this part of the area at grazing
 * incidence; it falls to 0 as the slope becomes infinite. */
static double weight_of_view(const vndf_radial_fit *fit, double seen, double r)
{
    return fit->below * vndf_profile_fade(fit->profile, seen, fit->fade) / (1 + r * 1e-8);
}

/* The weight of a cell's error for views below the horizon whose cut lies before the cell: its share of the mass
 * that is visible from one scale of the tail before it, times the number of similar cells that are visible with
 * it. */
static double share_of_deep_views(const vndf_radial_fit *fit, double a, double b, vndf_moments m)
{
    const vndf_profile *profile = fit->profile;
    double least = fmax(a / 2, 1e-30), s = vndf_profile_s(profile, fmax(a, 1e-30));
    double before = fmax(a - (b - a), least), slope = (vndf_profile_s(profile, before) - s) / (a - before);
    double rho = fmax(fmin(before, a - s / slope), least), seen = vndf_profile_s(profile, rho);
    if (!(a > least && slope > 0 && seen > 0))
        return 0.0;
    double share = (m.m1 + (a - rho) * m.m0) / seen * fmax(1.0, (a - rho) / (b - a));
    return fmin(1.0, share) * weight_of_view(fit, seen / profile->f1, a);
}

vndf_interval_miss vndf_fit_cell_error(double ra, double rb, void *user)
{
    const vndf_radial_fit *fit = user;
    vndf_fit_knot a = vndf_fit_knot_at(fit, ra), b = vndf_fit_knot_at(fit, rb);
    vndf_interval_miss found = {0.0, 0.0};
    double s0 = fit->profile->f1;
    if ((!(b.r - a.r > WIDTH_LEAST * b.r) && b.z > 0.0f) || a.r > SLOPE_MOST)
        return found; /* the cell is as narrow, or as far out, as a cell can be */
    vndf_radial_cell cell = vndf_fit_cell(fit, a, b);
    law_error e = measure(fit, a, b, &cell, 1 + (int)panels_between(fit->profile, a.r, b.r));
    vndf_moments m = vndf_profile_moments(fit->profile, a.r, b.r);
    double all = m.m0 / fit->profile->f0, grazing = (m.m1 + a.r * m.m0) / s0;
    double s = vndf_profile_s(fit->profile, a.r > 0 ? a.r : 1e-30), below = s > 0 ? m.m1 / s : 0.0;
    double seen = weight_of_view(fit, s / s0, a.r);
    double outside = b.z > 0.0f ? ((b.r - a.r) * m.m0 - m.m1) / b.r / fit->profile->f0 : 0.0;
    found.share = fmax(fmax(e.all, e.cubic / 4) * all, e.grazing * grazing);
    double beyond = share_of_deep_views(fit, a.r, b.r, m);
    found.alone = fmax(fmax(e.cut_inside * below * seen, e.all * beyond), e.cut_outside * outside);
    return found;
}
