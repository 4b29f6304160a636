/* Panels: P22 cut into pieces on which ten points resolve it, and sums over them. The recursion first halves every
 * octave four times unconditionally, so that it meets a narrow ring, and merges two halves where the whole is as
 * good. */
#include "fit/profile/panels.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "math/ascending.h"

enum { DEPTH_SEEN = 4, DEPTH_ROUGH = 10, DEPTH_MAX = 40 };

static const double PANEL_TOLERANCE = 1e-10;
static const double NEGLIGIBLE = 1e-45; /* of the peak: far below the floor, for views deep below the horizon */
static const double LEAST = 1e-290;     /* a product with a slope or two remains a normal double */
static const double SAME_EDGE = 1e-13;  /* in log R: below the width that resolve() calls a jump */
static const double ROUNDED = 4e-16;    /* of a slope: the error of points */

static double floor_at(const vndf_profile *profile, double r)
{
    double q = 1.0 + r * r;
    return profile->floor / (q * q);
}

/* P must be finite: where it is not, it overflowed here, not in the source. */
static double finite(const vndf_profile *profile, double r, double p)
{
    if (!(p < HUGE_VAL))
        vndf_guard_note(profile->guard, r * profile->scale, p);
    return p;
}

static double density(const vndf_profile *profile, double r)
{
    return finite(profile, r, vndf_profile_p22(profile, r));
}

/* The source at the doubles beside a slope where it is infinite: a pole there has a mass that no double shows. */
static double beside_pole(const vndf_profile *profile, double r)
{
    const vndf_source *source = profile->source;
    double below = source->p22(source, nextafter(r, 0.0)), beyond = source->p22(source, nextafter(r, HUGE_VAL));
    vndf_guard_spend(profile->guard, 2 * source->operations);
    return below < beyond ? below : beyond;
}

/* P at r from what the source gives there. */
static double p22_of(const vndf_profile *profile, double r, double given)
{
    double scale = profile->scale;
    if (given == HUGE_VAL && r > 0.0)
        given = beside_pole(profile, r * scale);
    if (!(given >= 0.0 && given < HUGE_VAL)) {
        vndf_guard_note(profile->guard, r * scale, given);
        given = 0.0;
    }
    return profile->normalization * scale * scale * given + floor_at(profile, r);
}

double vndf_profile_p22(const vndf_profile *profile, double r)
{
    int going = vndf_guard_spend(profile->guard, profile->source->operations);
    return p22_of(profile, r, going ? profile->source->p22(profile->source, r * profile->scale) : 0.0);
}

void vndf_profile_p22_many(const vndf_profile *profile, const double *r, size_t count, double *p22)
{
    const vndf_source *source = profile->source;
    double at[VNDF_SOURCE_MANY], given[VNDF_SOURCE_MANY] = {0.0};
    if (!source->p22_many) {
        for (size_t i = 0; i < count; i++)
            p22[i] = vndf_profile_p22(profile, r[i]);
        return;
    }
    for (size_t i = 0; i < count; i++)
        at[i] = r[i] * profile->scale;
    if (vndf_guard_spend(profile->guard, (double)count * source->operations))
        source->p22_many(source, at, count, given);
    for (size_t i = 0; i < count; i++)
        p22[i] = p22_of(profile, r[i], given[i]);
}

/* The moments of a panel by ten points, and how far rounding of the points and of P may move m0. */
typedef struct estimate {
    double m0, m1, noise;
} estimate;

static estimate rule(vndf_profile *profile, double u0, double u1)
{
    double r0 = exp(u0), least = HUGE_VAL, most = 0.0, beyond[VNDF_GAUSS], at[VNDF_GAUSS], p22[VNDF_GAUSS];
    estimate sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < VNDF_GAUSS; i++) {
        /* not as a difference: panels get as narrow as 1e-13 r */
        beyond[i] = r0 * expm1((u1 - u0) * vndf_gauss_node[i]);
        at[i] = r0 + beyond[i];
    }
    vndf_profile_p22_many(profile, at, VNDF_GAUSS, p22);
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double r = at[i], p = finite(profile, r, p22[i]);
        double w = vndf_gauss_weight[i] * (u1 - u0) * r * r * p, f = r * r * p;
        sum.m0 += w;
        sum.m1 += w * beyond[i];
        least = f < least ? f : least;
        most = f > most ? f : most;
    }
    double step = profile->normalization * DBL_TRUE_MIN * profile->scale * profile->scale; /* of small values */
    sum.noise = ROUNDED * (1 + fabs(u0)) * (most - least) + step * r0 * r0 * (u1 - u0);
    return sum;
}

/* Makes room for one more panel and the outer end; 0, and a note to the guard, if there is no memory. */
static int grow(vndf_profile *profile)
{
    if (profile->count + 1 < profile->capacity)
        return 1;
    size_t capacity = profile->capacity ? 2 * profile->capacity : 1024;
    vndf_panel *panel = realloc(profile->panel, capacity * sizeof *panel);
    if (!panel) {
        profile->guard->starved = 1;
        return 0;
    }
    profile->panel = panel;
    profile->capacity = capacity;
    return 1;
}

static void push(vndf_profile *profile, double u0, estimate sum, int jump)
{
    if (profile->count >= VNDF_LIMIT_BUILD_PANELS)
        profile->rough = 1;
    if (profile->rough || !grow(profile))
        return;
    vndf_panel panel = {.r = exp(u0), .m0 = sum.m0, .m1 = sum.m1, .jump = jump};
    profile->panel[profile->count++] = panel;
}

static int agree(double a, double b, double part, double least)
{
    return fabs(a - b) <= part * (fabs(a) + fabs(b)) / 2 + least;
}

int vndf_profile_stopped(const vndf_profile *profile)
{
    return profile->rough || vndf_guard_stopped(profile->guard);
}

/* How much rounding inside a formula, as in 1 - cos r, may add to m0: twice the distance of the bounds at one
 * slope. */
static double roughness(const vndf_profile *profile, double u0, double u1)
{
    double r = exp((u0 + u1) / 2) * profile->scale;
    if (!profile->source->reach ||
        !vndf_guard_spend(profile->guard, VNDF_REACH_OPERATIONS * profile->source->operations))
        return 0.0;
    vndf_reach at = profile->source->reach(profile->source, r, r);
    double width = profile->normalization * (at.high - at.low) * r * r;
    return width < HUGE_VAL ? 2 * width * (u1 - u0) : 0.0;
}

/* Whether the source is proven to give next to nothing between two slopes, so that nothing narrow lies there. The
 * points say where it is worth while to ask. */
static int is_nothing(const vndf_profile *profile, double u0, double u1, estimate whole, double least)
{
    const double part = 0.01;
    double end = exp(u1), floor = floor_at(profile, exp(u0)) * end * end * (u1 - u0);
    if (!profile->source->reach || !(whole.m0 <= part * least + 2 * floor) ||
        !vndf_guard_spend(profile->guard, VNDF_REACH_OPERATIONS * profile->source->operations))
        return 0;
    vndf_reach bound = profile->source->reach(profile->source, exp(u0) * profile->scale, end * profile->scale);
    double most = profile->normalization * profile->scale * profile->scale * bound.high * end * end * (u1 - u0);
    return bound.low >= 0.0 && most <= part * least;
}

/* `simple`: nothing narrow lies here. */
static void resolve(vndf_profile *profile, double u0, double u1, estimate whole, int depth, double least,
                    int simple)
{
    double middle = u0 + (u1 - u0) * VNDF_UNEVEN, gap = exp(u0) * expm1(middle - u0);
    estimate l = rule(profile, u0, middle), r = rule(profile, middle, u1);
    estimate sum = {l.m0 + r.m0, l.m1 + r.m1 + r.m0 * gap, 0.0};
    if (vndf_profile_stopped(profile))
        return;
    double slack = least + whole.noise + l.noise + r.noise, part = PANEL_TOLERANCE + profile->source->rounding;
    if (depth >= DEPTH_ROUGH)
        slack += roughness(profile, u0, u1);
    int good = agree(sum.m0, whole.m0, part, slack) && agree(sum.m1, whole.m1, part, slack * gap);
    simple = simple && good;
    if (simple || (depth >= DEPTH_SEEN && (good || depth >= DEPTH_MAX))) {
        push(profile, u0, sum, !good);
        return;
    }
    size_t first = profile->count;
    resolve(profile, u0, middle, l, depth + 1, least, 0);
    resolve(profile, middle, u1, r, depth + 1, least, 0);
    if (good && depth < DEPTH_SEEN && profile->count == first + 2 && !vndf_profile_stopped(profile)) {
        profile->count = first; /* neither half needed more: the whole is enough */
        push(profile, u0, sum, 0);
    }
}

static double integrand(vndf_profile *profile, double r)
{
    return density(profile, r) * r * r;
}

/* The largest integrand per octave and at the edges; far smaller values are negligible. */
double vndf_panels_peak(vndf_profile *profile)
{
    double most = 0.0;
    for (int i = -16 * VNDF_OCTAVES; i < 16 * VNDF_OCTAVES && !vndf_profile_stopped(profile); i++)
        most = fmax(most, integrand(profile, exp2(i / 16.0) / profile->scale));
    for (size_t i = 0; i < profile->edge_count && !vndf_profile_stopped(profile); i++)
        most = fmax(most, integrand(profile, profile->edge[i] / profile->scale));
    return most;
}

/* Drops edges that are too close to the one before. */
static size_t thin(double *edge, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || edge[i] - edge[kept - 1] > SAME_EDGE)
            edge[kept++] = edge[i];
    return kept;
}

/* Octave edges, the known breaks of the source and other edges, ascending, as logarithms of canonical R. */
static double *make_edges(const vndf_profile *profile, size_t *count)
{
    const vndf_source *source = profile->source;
    double shift = log(profile->scale), low = -VNDF_OCTAVES * log(2.0), high = -low;
    double *edge = malloc((2 * VNDF_OCTAVES + 1 + source->break_count + profile->edge_count) * sizeof *edge);
    size_t n = 0;
    for (int i = -VNDF_OCTAVES; edge && i <= VNDF_OCTAVES; i++)
        edge[n++] = i * log(2.0) - shift;
    for (size_t i = 0; edge && i < source->break_count + profile->edge_count; i++) {
        double r = i < source->break_count ? source->breaks[i] : profile->edge[i - source->break_count];
        double u = r > 0.0 ? log(r) : low;
        if (u > low && u < high)
            edge[n++] = u - shift;
    }
    if (edge)
        qsort(edge, n, sizeof *edge, vndf_ascending);
    *count = edge ? thin(edge, n) : 0;
    return edge;
}

/* The panels between two edges. */
static void fill_between(vndf_profile *profile, double u0, double u1, double least, unsigned char *simple)
{
    estimate whole = rule(profile, u0, u1);
    size_t before = profile->count;
    *simple = *simple || is_nothing(profile, u0, u1, whole, least);
    resolve(profile, u0, u1, whole, 0, least, *simple);
    *simple = profile->count == before + 1;
}

/* As many as there are edges now, all 0 unless as many are known from the pass before. */
static int know_edges(vndf_known *known, size_t edges)
{
    if (known->count == edges)
        return 1;
    free(known->simple);
    known->simple = calloc(edges, sizeof *known->simple);
    known->count = known->simple ? edges : 0;
    return known->simple != NULL;
}

/* Fills panels from r = 2^-VNDF_OCTAVES to 2^VNDF_OCTAVES of the source's own unit, unless something stops it. */
void vndf_panels_fill(vndf_profile *profile, vndf_known *known)
{
    size_t edges;
    double least = fmax(NEGLIGIBLE * profile->normalization * known->peak, LEAST);
    double *edge = make_edges(profile, &edges);
    profile->count = 0;
    if (!edge || !know_edges(known, edges))
        profile->guard->starved = 1;
    for (size_t i = 0; i + 1 < edges && !vndf_profile_stopped(profile); i++)
        fill_between(profile, edge[i], edge[i + 1], least, known->simple + i);
    if (!vndf_profile_stopped(profile) && grow(profile)) {
        vndf_panel end = {.r = exp(edge[edges - 1])};
        profile->panel[profile->count] = end;
    }
    free(edge);
}

double vndf_panels_exponent(vndf_profile *profile, double r0, double r1)
{
    double p0 = density(profile, r0), p1 = density(profile, r1);
    return p0 > 0.0 && p1 > 0.0 ? -log(p1 / p0) / log(r1 / r0) : HUGE_VAL;
}

/* The moments beyond the panels, by the power with which P falls there. */
static void measure_tail(vndf_profile *profile)
{
    double end = profile->panel[profile->count].r, p = density(profile, end),
           n = vndf_panels_exponent(profile, end / 4, end);
    profile->tail_m0 = profile->tail_m1 = 0.0;
    if (p > 0.0 && n > 3.0 + VNDF_POWER_MARGIN && n < HUGE_VAL) {
        profile->tail_m0 = p * end * end / (n - 2);
        profile->tail_m1 = p * end * end * end / (n - 3) - end * profile->tail_m0;
    }
}

/* Sums from both ends; every term is positive. */
void vndf_panels_sum(vndf_profile *profile)
{
    vndf_panel *p = profile->panel;
    size_t n = profile->count;
    measure_tail(profile);
    double before = 0.0; /* the integral of P r^2 */
    p[0].f0 = 0.0;
    p[n].t0 = profile->tail_m0;
    p[n].s = profile->tail_m1;
    for (size_t i = 0; i < n; i++) {
        p[i + 1].f0 = p[i].f0 + p[i].m0;
        before += p[i].m1 + p[i].r * p[i].m0;
    }
    for (size_t i = n; i-- > 0;) {
        p[i].t0 = p[i + 1].t0 + p[i].m0;
        p[i].s = p[i + 1].s + p[i + 1].t0 * (p[i + 1].r - p[i].r) + p[i].m1;
    }
    profile->f0 = p[n].f0 + profile->tail_m0;
    profile->f1 = before + profile->tail_m1 + p[n].r * profile->tail_m0;
}

/* The points of a panel. */
static void put_points(vndf_profile *profile, const vndf_panel *panel, vndf_profile_point *point)
{
    double u0 = log(panel->r), du = log(panel[1].r) - u0, r[VNDF_GAUSS], p22[VNDF_GAUSS];
    for (int k = 0; k < VNDF_GAUSS; k++)
        r[k] = exp(u0 + du * vndf_gauss_node[k]);
    vndf_profile_p22_many(profile, r, VNDF_GAUSS, p22);
    for (int k = 0; k < VNDF_GAUSS; k++) {
        double p = finite(profile, r[k], p22[k]);
        point[k] = (vndf_profile_point){r[k], vndf_gauss_weight[k] * du * r[k] * r[k] * p};
    }
}

int vndf_panels_points(vndf_profile *profile)
{
    vndf_panel *panel = profile->panel;
    free(profile->point);
    profile->point = malloc(profile->count * VNDF_GAUSS * sizeof *profile->point);
    panel[profile->count].less = panel[profile->count].least = 0.0;
    for (size_t i = profile->point ? profile->count : 0; i-- > 0;) {
        vndf_profile_point *point = profile->point + i * VNDF_GAUSS;
        put_points(profile, &panel[i], point);
        panel[i].less = panel[i + 1].less;
        panel[i].least = panel[i + 1].least;
        for (int k = 0; k < VNDF_GAUSS; k++) {
            double less = point[k].weight / point[k].r;
            panel[i].less += less;
            panel[i].least += less / (point[k].r * point[k].r);
        }
    }
    return profile->point != NULL;
}

double vndf_panels_median(vndf_profile *profile)
{
    size_t i = 0;
    while (i + 1 < profile->count && profile->panel[i + 1].f0 < profile->f0 / 2)
        i++;
    const vndf_panel *p = &profile->panel[i];
    double u0 = log(p->r), low = u0, high = log(p[1].r);
    for (int step = 0; step < 30; step++) {
        double middle = (low + high) / 2;
        if (p->f0 + rule(profile, u0, middle).m0 < profile->f0 / 2)
            low = middle;
        else
            high = middle;
    }
    return exp(low);
}
