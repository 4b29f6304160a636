/* Slopes (x, y) = (alpha_x r cos a, alpha_y r sin a) in polar form, a counted from the azimuth b0 where normals
 * turn away from wi:  D dwm = P22(r)/cos(theta_m) r dr db, and
 *
 *     wi.wm/cos(theta_m) = w = cos_i - q cos b,      q = r |(alpha_x wi.x, alpha_y wi.y)|.
 *
 * V-cavities cut w at 2 cos_i; so everything is smooth in b but where cos b = +-cos_i/q, and Gauss's rule between
 * these is exact to rounding, unless the roughness is far from isotropic (then Kelemen's is not). The radius, r =
 * median X/(1 - X), is bisected until ten nodes tell what five do: D may have jumps, rings and peaks. */
#include "measure/masking.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* ---- k ------------------------------------------------------------------------------------------- */

double masking_schlick_k(const vndf_surface *surface, vndf_vec3 wi)
{
    double x = (double)surface->alpha_x, y = (double)surface->alpha_y, across = hypot((double)wi.x, (double)wi.y);
    double along = across > 0 ? hypot(x * (double)wi.x, y * (double)wi.y) / across : x;
    if (surface->distribution == vndf_beckmann())
        return fmin(1, along * sqrt(2 / PI));
    return fmin(1, 0.5 * along * vndf_distribution_info(surface->distribution).scale);
}

/* ---- integrals ----------------------------------------------------------------------------------- */

/* What is integrated over the normals at once. */
enum { NORMALS, AREA, V_CAVITIES, KELEMEN, PARTS };

typedef struct slopes {
    vndf_surface unit;   /* roughness 1: P22(r) */
    double scale;        /* median slope */
    double x, y, cosine; /* roughness, cos_i */
    double across, turn; /* q/r, b0 */
} slopes;

static slopes slopes_of(const vndf_surface *surface, vndf_vec3 wi)
{
    double x = (double)surface->alpha_x, y = (double)surface->alpha_y, wx = x * (double)wi.x,
           wy = y * (double)wi.y;
    slopes s = {{surface->distribution, 1, 1},
                vndf_distribution_info(surface->distribution).scale,
                x,
                y,
                (double)wi.z,
                hypot(wx, wy),
                atan2(wy, wx)};
    return s;
}

enum { NODES = 5 };
static const double node[NODES] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                   0.953089922969332};
static const double node_weight[NODES] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                          0.23931433524968324, 0.11846344252809454};

/* Adds the mean over [from, to] of b times its part of the turn, in four panels of five nodes. */
static void add_azimuths(const slopes *s, double r, double from, double to, double *mean)
{
    const int panels = 4;
    double q = r * s->across, width = (to - from) / panels;
    for (int i = 0; i < panels * NODES; i++) {
        double b = from + width * (i / NODES + node[i % NODES]), part = width / (2 * PI) * node_weight[i % NODES];
        double w = fmax(0, s->cosine - q * cos(b)) / s->cosine;
        double x = s->x * r * cos(b + s->turn), y = s->y * r * sin(b + s->turn);
        mean[AREA] += part * w;
        mean[V_CAVITIES] += part * fmin(w, 2);
        mean[KELEMEN] += w > 0 ? part * sqrt(1 + x * x + y * y) : 0;
    }
}

/* All parts at X, per dX. */
static void integrand(const slopes *s, double x, double *value)
{
    double r = s->scale * x / (1 - x), per = 2 * PI * r * s->scale / ((1 - x) * (1 - x));
    double p22 = (double)vndf_p22(&s->unit, (float)r, 0), ratio = s->cosine / (r * s->across);
    double edge = ratio < 1 ? acos(ratio) : 0;
    double mean[PARTS] = {1, 0, 0, 0};
    const double border[] = {edge, PI - edge, PI + edge, 2 * PI - edge, 2 * PI + edge};
    for (int i = 0; i < 4 && p22 > 0; i++)
        if (border[i + 1] > border[i])
            add_azimuths(s, r, border[i], border[i + 1], mean);
    for (int i = 0; i < PARTS; i++)
        value[i] = p22 * per * mean[i];
}

static void integrate_panel(const slopes *s, double from, double to, double *sum)
{
    for (int i = 0; i < PARTS; i++)
        sum[i] = 0;
    for (int i = 0; i < NODES; i++) {
        double value[PARTS];
        integrand(s, from + (to - from) * node[i], value);
        for (int j = 0; j < PARTS; j++)
            sum[j] += (to - from) * node_weight[i] * value[j];
    }
}

/* Adds the integral over [from, to], `whole` by one rule. P22 comes as a float, so parts of 5e-7 are not asked
 * for. */
static void refine(const slopes *s, double from, double to, const double *whole, int depth, double *sum)
{
    double middle = 0.5 * (from + to), left[PARTS], right[PARTS];
    int good = 1;
    integrate_panel(s, from, middle, left);
    integrate_panel(s, middle, to, right);
    for (int i = 0; i < PARTS; i++) {
        double both = left[i] + right[i];
        good &= fabs(both - whole[i]) <= 1e-6 * (to - from) + 5e-7 * fabs(both);
    }
    if (!good && depth < 40) {
        refine(s, from, middle, left, depth + 1, sum);
        refine(s, middle, to, right, depth + 1, sum);
        return;
    }
    for (int i = 0; i < PARTS; i++)
        sum[i] += left[i] + right[i];
}

masking_integrals masking_integrate(const vndf_surface *surface, vndf_vec3 wi)
{
    const int panels = 32;
    slopes s = slopes_of(surface, wi);
    double sum[PARTS] = {0}, whole[PARTS], k = masking_schlick_k(surface, wi);
    for (int i = 0; i < panels; i++) {
        double from = (double)i / panels, to = (double)(i + 1) / panels;
        integrate_panel(&s, from, to, whole);
        refine(&s, from, to, whole, 0, sum);
    }
    masking_integrals result = {{0}, sum[NORMALS]};
    result.of[MASKING_SMITH] = (double)vndf_g1(surface, wi) * sum[AREA];
    result.of[MASKING_V_CAVITIES] = sum[V_CAVITIES];
    result.of[MASKING_IMPLICIT] = s.cosine * sum[AREA];
    result.of[MASKING_KELEMEN] = sum[KELEMEN];
    result.of[MASKING_SCHLICK_SMITH] = s.cosine / (s.cosine * (1 - k) + k) * sum[AREA];
    return result;
}
