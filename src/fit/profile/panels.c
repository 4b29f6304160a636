/* Panels: P22 cut into pieces on which ten points resolve it, and sums over them. The recursion halves every octave
 * once, and merges two halves where the whole is as good. What the points have missed is found by proof.c. */
#include "fit/profile/profile.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { DEPTH_ROUGH = 10, DEPTH_MAX = 40 };

static const double DEGREES = 57.295779513082323; /* to a radian */
static const double PANEL_TOLERANCE = 1e-10;
static const double NEGLIGIBLE = 1e-34; /* of both peaks: less than numbers of tables tell from nothing */
static const double LEAST = 1e-290;     /* a product with a slope or two remains a normal double */
static const double WINDOW = 0x1p30;    /* between the slopes from which exponents at both ends are read */
static const double ROUNDED = 4e-16;    /* of a slope: the error of points */

const double vndf_gauss_node[VNDF_GAUSS] = {
    0.013046735741414128, 0.067468316655507732, 0.16029521585048778, 0.28330230293537639, 0.42556283050918442,
    0.57443716949081558,  0.71669769706462361,  0.83970478414951222, 0.93253168334449232, 0.98695326425858587};
const double vndf_gauss_weight[VNDF_GAUSS] = {
    0.033335672154344013, 0.074725674575290266, 0.10954318125799103, 0.13463335965499812,  0.14776211235737646,
    0.14776211235737646,  0.13463335965499812,  0.10954318125799103, 0.074725674575290266, 0.033335672154344013};

/* ---- values ---- */

/* P at r from what the source gives there; the guard notes a value that is no density, or too large for a double. A
 * source that is infinite has a pole there, whose mass no double shows: the doubles beside it count. */
static double p22_of(const vndf_profile *profile, double r, double given)
{
    const vndf_source *source = profile->source;
    double scale = profile->scale, at = r * scale;
    if (given == HUGE_VAL && r > 0.0) {
        given =
            fmin(vndf_source_p22(source, nextafter(at, 0.0)), vndf_source_p22(source, nextafter(at, HUGE_VAL)));
        vndf_guard_spend(profile->guard, 2 * source->operations);
    }
    double p = profile->normalization * scale * scale * given;
    if (given >= 0.0 && p < HUGE_VAL)
        return p;
    vndf_fail(vndf_guard_why(profile->guard), VNDF_ERROR_DISTRIBUTION,
              "P22 is %s at slope %g (theta_m = %.9g degrees)",
              given < 0.0    ? "negative"
              : isnan(given) ? "not a number"
                             : "infinite",
              at, atan(at) * DEGREES);
    return 0.0;
}

double vndf_profile_p22(const vndf_profile *profile, double r)
{
    double p22;
    vndf_profile_p22_many(profile, &r, 1, &p22);
    return p22;
}

void vndf_profile_p22_many(const vndf_profile *profile, const double *r, size_t count, double *p22)
{
    const vndf_source *source = profile->source;
    double at[VNDF_SOURCE_MANY], given[VNDF_SOURCE_MANY];
    int going = vndf_guard_spend(profile->guard, (double)count * source->operations);
    for (size_t i = 0; i < count; i++)
        at[i] = r[i] * profile->scale;
    if (going)
        source->p22(source, at, count, given);
    for (size_t i = 0; i < count; i++)
        p22[i] = going ? p22_of(profile, r[i], given[i]) : 0.0;
}

void vndf_profile_rule(const vndf_profile *profile, double from, double to, vndf_profile_point point[VNDF_GAUSS])
{
    double du = log1p((to - from) / from), r[VNDF_GAUSS], p22[VNDF_GAUSS]; /* as narrow as 1e-13 */
    for (int i = 0; i < VNDF_GAUSS; i++)
        r[i] = from * exp(du * vndf_gauss_node[i]);
    vndf_profile_p22_many(profile, r, VNDF_GAUSS, p22);
    for (int i = 0; i < VNDF_GAUSS; i++)
        point[i] = (vndf_profile_point){r[i], vndf_gauss_weight[i] * du * r[i] * r[i] * p22[i]};
}

/* -d log P / d log r over many octaves, by the line closest to P at points whose spacing has no period, so that waves
 * even out; infinite where P vanishes at half of them. */
static double exponent(const vndf_profile *profile, double from, double to)
{
    enum { POINTS = 96 };
    const double golden = 0.6180339887498949;
    double n = 0, x1 = 0, y1 = 0, xx = 0, xy = 0;
    for (int i = 0; i < POINTS; i++) {
        double x = log(to / from) * (i + fmod(golden * i, 1)) / POINTS,
               p22 = vndf_profile_p22(profile, from * exp(x));
        if (!(p22 > 0))
            continue;
        double y = -log(p22);
        n++, x1 += x, y1 += y, xx += x * x, xy += x * y;
    }
    return 2 * n > POINTS ? (n * xy - x1 * y1) / (n * xx - x1 * x1) : HUGE_VAL;
}

/* ---- one panel ---- */

/* A panel by ten points: its moments, and how far rounding of the points and of P may move m0. */
typedef struct estimate {
    double m0, m1, noise;
    vndf_profile_point point[VNDF_GAUSS];
} estimate;

static estimate estimate_of(const vndf_profile *profile, double r0, double r1)
{
    double least = HUGE_VAL, most = 0.0, du = log1p((r1 - r0) / r0);
    estimate sum = {.m0 = 0.0};
    vndf_profile_rule(profile, r0, r1, sum.point);
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double w = sum.point[i].weight, f = w / (vndf_gauss_weight[i] * du);
        sum.m0 += w;
        sum.m1 += w * (sum.point[i].r - r0);
        least = fmin(least, f);
        most = fmax(most, f);
    }
    sum.noise = ROUNDED * (most - least) + profile->normalization * DBL_TRUE_MIN * r0 * r0 * du;
    return sum;
}

static void push(vndf_profile *profile, double r, double m0, double m1, const vndf_profile_point *point)
{
    if (profile->count >= VNDF_LIMIT_BUILD_PANELS)
        vndf_fail(vndf_guard_why(profile->guard), VNDF_ERROR_DISTRIBUTION,
                  "P22 is too rough: not resolved by %d panels; the last one began at slope %g",
                  VNDF_LIMIT_BUILD_PANELS, profile->panel[profile->count - 1].r);
    if (vndf_guard_stopped(profile->guard))
        return;
    vndf_panel *panel = &profile->panel[profile->count++];
    *panel = (vndf_panel){.r = r, .m0 = m0, .m1 = m1};
    memcpy(panel->point, point, sizeof panel->point);
}

/* How much rounding inside a formula, as in 1 - cos r, may add to m0: twice the distance of the bounds at one slope, if
 * the source has bounds. */
static double roughness(const vndf_profile *profile, double r0, double r1)
{
    const vndf_source *source = profile->source;
    if (!source->reach || !vndf_guard_spend(profile->guard, VNDF_REACH_OPERATIONS * source->operations))
        return 0.0;
    double r = sqrt(r0 * r1);
    vndf_reach at = source->reach(source, r, r);
    double width = profile->normalization * (at.high - at.low) * r * r;
    return width < HUGE_VAL ? 2 * width * (r1 - r0) / r0 : 0.0;
}

static int agree(double a, double b, double least)
{
    return fabs(a - b) <= PANEL_TOLERANCE * (fabs(a) + fabs(b)) / 2 + least;
}

/* Whether P22 jumps between an end of a panel and the point next to it, where no point would show it: a probe close to
 * the end is farther from that point than the next point is, by much. */
static int jumps_at_end(const vndf_profile *profile, double r0, double r1, const vndf_profile_point *point)
{
    const double far = 4, little = 0.02; /* times the next step; of the largest */
    const double r[2] = {r0 + (point[0].r - r0) / 1024, r1 - (r1 - point[VNDF_GAUSS - 1].r) / 1024};
    double p[2], f[VNDF_GAUSS], most = 0;
    vndf_profile_p22_many(profile, r, 2, p);
    for (int i = 0; i < VNDF_GAUSS; i++)
        most = fmax(most, f[i] = point[i].weight / vndf_gauss_weight[i]);
    for (int k = 0; k < 2; k++) {
        int first = k ? VNDF_GAUSS - 1 : 0, next = k ? VNDF_GAUSS - 2 : 1;
        double end = log1p((r1 - r0) / r0) * r[k] * r[k] * p[k];
        if (fabs(end - f[first]) > far * fabs(f[first] - f[next]) + little * fmax(most, end))
            return 1;
    }
    return 0;
}

static void resolve(vndf_profile *profile, double r0, double r1, const estimate *whole, int depth, double least)
{
    double middle = r0 + r0 * expm1(VNDF_UNEVEN * log1p((r1 - r0) / r0)), gap = middle - r0;
    estimate l = estimate_of(profile, r0, middle), r = estimate_of(profile, middle, r1);
    double m0 = l.m0 + r.m0, m1 = l.m1 + r.m1 + r.m0 * gap;
    if (vndf_guard_stopped(profile->guard))
        return;
    double slack = least + whole->noise + l.noise + r.noise;
    int seen = depth > 0, good = 0;
    for (int rough = 0; !good && rough <= (depth >= DEPTH_ROUGH); rough++) {
        double more = rough ? roughness(profile, r0, r1) : 0;
        slack += more;
        good = agree(m0, whole->m0, slack) && agree(m1, whole->m1, slack * gap + ROUNDED * r0 * m0) &&
               (more > 1e-3 * m0 || !jumps_at_end(profile, r0, r1, whole->point));
    }
    if (good ? seen : depth >= DEPTH_MAX) {
        push(profile, r0, m0, m1, whole->point);
        return;
    }
    size_t first = profile->count;
    resolve(profile, r0, middle, &l, depth + 1, least);
    resolve(profile, middle, r1, &r, depth + 1, least);
    if (good && profile->count == first + 2) {
        profile->count = first; /* neither half needed more: the whole is enough */
        push(profile, r0, m0, m1, whole->point);
    }
}

/* ---- all panels ---- */

/* Sums from both ends; every term is positive. Beyond the panels P falls by the power that it has before their end. */
void vndf_panels_sum(vndf_profile *profile)
{
    vndf_panel *p = profile->panel;
    size_t n = profile->count;
    double end = p[n].r, last = vndf_profile_p22(profile, end),
           power = profile->tail = exponent(profile, end / WINDOW, end);
    profile->pole = exponent(profile, p->r, p->r * WINDOW);
    double before = 0.0; /* the integral of P r^2 */
    profile->tail_m0 = profile->tail_m1 = 0.0;
    if (last > 0.0 && power > 3.0 + VNDF_POWER_MARGIN) {
        profile->tail_m0 = last * end * end / (power - 2);
        profile->tail_m1 = last * end * end * end / (power - 3) - end * profile->tail_m0;
    }
    p[0].f0 = 0.0;
    p[n].t0 = profile->tail_m0;
    p[n].s = profile->tail_m1;
    p[n].less = p[n].least = 0.0;
    for (size_t i = 0; i < n; i++) {
        p[i + 1].f0 = p[i].f0 + p[i].m0;
        before += p[i].m1 + p[i].r * p[i].m0;
    }
    for (size_t i = n; i-- > 0;) {
        p[i].t0 = p[i + 1].t0 + p[i].m0;
        p[i].s = p[i + 1].s + p[i + 1].t0 * (p[i + 1].r - p[i].r) + p[i].m1;
        p[i].less = p[i + 1].less;
        p[i].least = p[i + 1].least;
        for (int k = 0; k < VNDF_GAUSS; k++) {
            double r = p[i].point[k].r, less = p[i].point[k].weight / r;
            p[i].less += less;
            p[i].least += less / (r * r);
        }
    }
    profile->f0 = p[n].f0 + profile->tail_m0;
    profile->f1 = before + profile->tail_m1 + p[n].r * profile->tail_m0;
}

double vndf_panels_make(vndf_profile *profile)
{
    enum { PER_OCTAVE = 16, SLOPES = 2 * VNDF_OCTAVES * PER_OCTAVE };
    const double *edge = profile->edge;
    size_t edges = profile->edge_count;
    double mass = 0, along = 0; /* the largest P22 r^2 and P22 r^3, to see what is negligible */
    profile->normalization = profile->scale = 1.0;
    for (size_t i = 0; i < SLOPES + edges && !vndf_guard_stopped(profile->guard); i++) {
        double r = i < SLOPES ? exp2((double)i / PER_OCTAVE - VNDF_OCTAVES) : edge[i - SLOPES];
        double f = vndf_profile_p22(profile, r) * r * r;
        mass = fmax(mass, f);
        along = fmax(along, f * r);
    }
    if (mass >= VNDF_LEAST_PEAK)
        profile->normalization = 1.0 / mass;
    profile->count = 0;
    for (size_t i = 0; i + 1 < edges && !vndf_guard_stopped(profile->guard); i++) {
        double least = fmax(NEGLIGIBLE * (profile->normalization * fmin(mass, along / edge[i + 1])), LEAST);
        estimate whole = estimate_of(profile, edge[i], edge[i + 1]);
        resolve(profile, edge[i], edge[i + 1], &whole, 0, least);
    }
    if (!vndf_guard_stopped(profile->guard)) {
        profile->panel[profile->count] = (vndf_panel){.r = edge[edges - 1]};
        vndf_panels_sum(profile);
    }
    return mass;
}
