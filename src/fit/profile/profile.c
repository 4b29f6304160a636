/* Panels: see profile.h. The recursion first halves every octave four times unconditionally, so that it meets a
 * narrow ring, and merges two halves where the whole is as good. */
#include "fit/profile/profile.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/profile/proof.h"
#include "core/error.h"
#include "math/ascending.h"

enum { OCTAVES = 100, DEPTH_SEEN = 4, DEPTH_ROUGH = 10, DEPTH_MAX = 40 };

static const double PI = 3.14159265358979323846;
static const double PANEL_TOLERANCE = 1e-10, FLOOR = 1e-26;
static const double NEGLIGIBLE = 1e-45;  /* of the peak: far below the floor, for views deep below the horizon */
static const double LEAST_PEAK = 1e-307; /* of P22 r^2: doubles lose their digits below, and have no reciprocal */
static const double LEAST = 1e-290;      /* a product with a slope or two remains a normal double */
static const double SAME_EDGE = 1e-13;   /* in log R: below the width that resolve() calls a jump */
static const double ROUNDED = 4e-16;     /* of a slope: the error of points */
static const double POWER_MARGIN =
    1e-6; /* an exponent this close to the limit of integrable ones counts as the limit */
static const double POLE_LOST = 1e-6; /* part of the mass that may lie below the first panel, */
static const double TAIL_LOST = 2e-3; /* of the area at grazing incidence beyond the last: one cell draws it */
static const double NARROW = 1.01;    /* ratio of the ends of a panel that was cut for a feature */
static const double SAME_MASS = 1e-7; /* two passes agree */

static double floor_at(const vndf_profile *profile, double r)
{
    double q = 1.0 + r * r;
    return profile->floor / (q * q);
}

/* P at r, which is finite or stops the build. */
static double density(const vndf_profile *profile, double r)
{
    double p = vndf_profile_p22(profile, r);
    if (!(p < HUGE_VAL)) /* it overflowed here, not in the source */
        vndf_guard_note(profile->guard, r * profile->scale, p);
    return p;
}

double vndf_profile_p22(const vndf_profile *profile, double r)
{
    double scale = profile->scale, given = 0.0;
    if (vndf_guard_spend(profile->guard, profile->source->operations))
        given = profile->source->p22(profile->source, r * scale);
    if (!(given >= 0.0 && given < HUGE_VAL)) {
        vndf_guard_note(profile->guard, r * scale, given);
        given = 0.0;
    }
    return profile->normalization * scale * scale * given + floor_at(profile, r);
}

/* ---- panels ---- */

/* The moments of a panel by ten points, and how far rounding of the points and of P may move m0. */
typedef struct estimate {
    double m0, m1, noise;
} estimate;

static estimate rule(vndf_profile *profile, double u0, double u1)
{
    double r0 = exp(u0), least = HUGE_VAL, most = 0.0;
    estimate sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < VNDF_GAUSS; i++) {
        /* not as a difference: panels get as narrow as 1e-13 r */
        double beyond = r0 * expm1((u1 - u0) * vndf_gauss_node[i]), r = r0 + beyond;
        double p = density(profile, r), w = vndf_gauss_weight[i] * (u1 - u0) * r * r * p, f = r * r * p;
        sum.m0 += w;
        sum.m1 += w * beyond;
        least = fmin(least, f);
        most = fmax(most, f);
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
    vndf_panel panel = {exp(u0), sum.m0, sum.m1, 0, 0, 0, 0, 0, jump};
    profile->panel[profile->count++] = panel;
}

static int agree(double a, double b, double part, double least)
{
    return fabs(a - b) <= part * (fabs(a) + fabs(b)) / 2 + least;
}

static int stopped(const vndf_profile *profile)
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

static void resolve(vndf_profile *profile, double u0, double u1, estimate whole, int depth, double least)
{
    double middle = u0 + (u1 - u0) * VNDF_UNEVEN, gap = exp(u0) * expm1(middle - u0);
    estimate l = rule(profile, u0, middle), r = rule(profile, middle, u1);
    estimate sum = {l.m0 + r.m0, l.m1 + r.m1 + r.m0 * gap, 0.0};
    if (stopped(profile))
        return;
    double slack = least + whole.noise + l.noise + r.noise, part = PANEL_TOLERANCE + profile->source->rounding;
    if (depth >= DEPTH_ROUGH)
        slack += roughness(profile, u0, u1);
    int good = agree(sum.m0, whole.m0, part, slack) && agree(sum.m1, whole.m1, part, slack * gap);
    if (depth >= DEPTH_SEEN && (good || depth >= DEPTH_MAX)) {
        push(profile, u0, sum, !good);
        return;
    }
    size_t first = profile->count;
    resolve(profile, u0, middle, l, depth + 1, least);
    resolve(profile, middle, u1, r, depth + 1, least);
    if (good && depth < DEPTH_SEEN && profile->count == first + 2 && !stopped(profile)) {
        profile->count = first; /* neither half needed more: the whole is enough */
        push(profile, u0, sum, 0);
    }
}

static double integrand(vndf_profile *profile, double r)
{
    return density(profile, r) * r * r;
}

/* The largest integrand per octave and at the edges; far smaller values are negligible. */
static double peak(vndf_profile *profile)
{
    double most = 0.0;
    for (int i = -16 * OCTAVES; i < 16 * OCTAVES && !stopped(profile); i++)
        most = fmax(most, integrand(profile, exp2(i / 16.0) / profile->scale));
    for (size_t i = 0; i < profile->edge_count && !stopped(profile); i++)
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
    double shift = log(profile->scale), low = -OCTAVES * log(2.0), high = -low;
    double *edge = malloc((2 * OCTAVES + 1 + source->break_count + profile->edge_count) * sizeof *edge);
    size_t n = 0;
    for (int i = -OCTAVES; edge && i <= OCTAVES; i++)
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

/* Fills panels from r = 2^-OCTAVES to 2^OCTAVES of the source's own unit, unless something stops it. */
static void fill_panels(vndf_profile *profile)
{
    size_t edges;
    double least = fmax(NEGLIGIBLE * peak(profile), LEAST), *edge = make_edges(profile, &edges);
    profile->count = 0;
    if (!edge)
        profile->guard->starved = 1;
    for (size_t i = 0; i + 1 < edges && !stopped(profile); i++)
        resolve(profile, edge[i], edge[i + 1], rule(profile, edge[i], edge[i + 1]), 0, least);
    if (!stopped(profile) && grow(profile)) {
        vndf_panel end = {exp(edge[edges - 1]), 0, 0, 0, 0, 0, 0, 0, 0};
        profile->panel[profile->count] = end;
    }
    free(edge);
}

/* -d log P / d log r between two slopes; infinite if P vanishes there. */
static double exponent(vndf_profile *profile, double r0, double r1)
{
    double p0 = density(profile, r0), p1 = density(profile, r1);
    return p0 > 0.0 && p1 > 0.0 ? -log(p1 / p0) / log(r1 / r0) : HUGE_VAL;
}

/* The moments beyond the panels, by the power with which P falls there. */
static void measure_tail(vndf_profile *profile)
{
    double end = profile->panel[profile->count].r, p = density(profile, end), n = exponent(profile, end / 4, end);
    profile->tail_m0 = profile->tail_m1 = 0.0;
    if (p > 0.0 && n > 3.0 + POWER_MARGIN && n < HUGE_VAL) {
        profile->tail_m0 = p * end * end / (n - 2);
        profile->tail_m1 = p * end * end * end / (n - 3) - end * profile->tail_m0;
    }
}

/* Sums from both ends; every term is positive. */
static void sum_panels(vndf_profile *profile)
{
    vndf_panel *p = profile->panel;
    size_t n = profile->count;
    measure_tail(profile);
    p[0].f0 = p[0].f1 = p[0].e = 0.0;
    p[n].t0 = profile->tail_m0;
    p[n].s = profile->tail_m1;
    for (size_t i = 0; i < n; i++) {
        double a = p[i].r, b = p[i + 1].r;
        p[i + 1].f0 = p[i].f0 + p[i].m0;
        p[i + 1].f1 = p[i].f1 + p[i].m1 + a * p[i].m0;
        p[i + 1].e = p[i].e + p[i].f1 * (1 / a - 1 / b) + ((b - a) * p[i].m0 - p[i].m1) / b;
    }
    for (size_t i = n; i-- > 0;) {
        p[i].t0 = p[i + 1].t0 + p[i].m0;
        p[i].s = p[i + 1].s + p[i + 1].t0 * (p[i + 1].r - p[i].r) + p[i].m1;
    }
    profile->f0 = p[n].f0 + profile->tail_m0;
    profile->f1 = p[n].f1 + profile->tail_m1 + p[n].r * profile->tail_m0;
}

/* The Gauss points of all panels, for integrals with other kernels. */
static int fill_points(vndf_profile *profile)
{
    free(profile->point);
    profile->point = malloc(profile->count * VNDF_GAUSS * sizeof *profile->point);
    for (size_t i = 0; profile->point && i < profile->count; i++) {
        double u0 = log(profile->panel[i].r), u1 = log(profile->panel[i + 1].r);
        for (int k = 0; k < VNDF_GAUSS; k++) {
            double r = exp(u0 + (u1 - u0) * vndf_gauss_node[k]);
            vndf_profile_point point = {r, vndf_gauss_weight[k] * (u1 - u0) * r * r * density(profile, r)};
            profile->point[i * VNDF_GAUSS + (size_t)k] = point;
        }
    }
    return profile->point != NULL;
}

/* ---- what a microsurface must be ---- */

static vndf_status no_memory(vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to resolve the distribution");
}

static vndf_status check_values(const vndf_profile *profile, vndf_error *error)
{
    if (vndf_guard_stopped(profile->guard))
        return vndf_guard_status(profile->guard, error);
    if (profile->rough)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 is too rough: not resolved by %d panels; the last one began at slope %g",
                         VNDF_LIMIT_BUILD_PANELS,
                         profile->count ? profile->panel[profile->count - 1].r * profile->scale : 0.0);
    if (!(profile->f0 > 0.0))
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 is zero everywhere from slope 1e-30 to 1e30: no projected area");
    return VNDF_OK;
}

/* Checks that both ends are integrable, and that little lies beyond the panels. */
static vndf_status check_ends(vndf_profile *profile, vndf_error *error)
{
    double tail = exponent(profile, exp2(OCTAVES - 2), exp2(OCTAVES));
    double pole = exponent(profile, exp2(-OCTAVES), exp2(2 - OCTAVES));
    const vndf_panel *p = profile->panel;
    size_t n = profile->count;
    if (pole < HUGE_VAL && pole >= 2.0 - POWER_MARGIN)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "infinite projected area at the pole: P22 rises as r^-%.4g for r -> 0, must rise slower "
                         "than r^-2",
                         pole);
    if (pole < HUGE_VAL && pole > 0.0 && p[1].f0 / (exp2(2.0 - pole) - 1.0) > POLE_LOST * profile->f0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 rises as r^-%.4g for r -> 0: too much of its mass lies below slope 1e-30", pole);
    if (tail <= 3.0 + POWER_MARGIN)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "infinite projected area: P22 falls as r^%.4g for large r, must fall faster than r^-3 "
                         "(D slower than 1/cos(theta_m) towards 90 degrees)",
                         0.0 - tail);
    if (tail < HUGE_VAL && profile->tail_m1 + p[n].r * profile->tail_m0 > TAIL_LOST * profile->f1)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "the tail is too heavy: P22 falls as r^-%.6g, so that over 0.2%% of the projected area "
                         "at grazing incidence lies beyond slope 1e30, where no single-precision normal can lie",
                         tail);
    return VNDF_OK;
}

static double median(vndf_profile *profile)
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

static vndf_status measure(vndf_profile *profile, vndf_error *error)
{
    fill_panels(profile);
    if (!stopped(profile))
        sum_panels(profile);
    return check_values(profile, error);
}

/* Where the narrowest panel begins. */
static double narrowest(const vndf_profile *profile)
{
    const vndf_panel *p = profile->panel;
    size_t at = 0;
    for (size_t i = 1; i < profile->count; i++)
        if (p[i + 1].r * p[at].r < p[at + 1].r * p[i].r)
            at = i;
    return p[at].r;
}

/* Pass 1 works in the unit of the source, the next passes at canonical scale with the floor, until two find the
 * same mass: a peak that one pass stepped over shows in the next, whose panels begin elsewhere. */
static vndf_status settle(vndf_profile *profile, vndf_error *error)
{
    enum { PASSES = 4 };
    double most = peak(profile); /* first scale to a size that neither overflows nor vanishes */
    if (most > 0.0 && most < LEAST_PEAK)
        return vndf_fail(
            error, VNDF_ERROR_DISTRIBUTION,
            "P22 r^2 is no more than %.3g at any slope: too small for doubles; multiply P22 by a factor", most);
    if (most > 0.0)
        profile->normalization = 1.0 / most;
    vndf_status status = measure(profile, error);
    if (status == VNDF_OK)
        status = check_ends(profile, error);
    for (int pass = 0; status == VNDF_OK && pass < PASSES; pass++) {
        double mass = 2 * PI * profile->f0;
        if (pass > 0 && fabs(mass - 1.0) < SAME_MASS)
            return VNDF_OK;
        double middle = median(profile);
        profile->normalization /= mass;
        profile->scale *= middle;
        profile->floor = FLOOR;
        if (!(profile->scale > 1e-17 && profile->scale < 1e17))
            return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                             "the median slope is %g; from 1e-17 to 1e17 can be tabulated", profile->scale);
        status = measure(profile, error);
    }
    if (status != VNDF_OK)
        return status;
    profile->unsettled = 1;
    return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                     "P22 has a feature too narrow to be resolved: two integrations of it disagree; the narrowest "
                     "part that was tried lies at slope %.9g",
                     narrowest(profile) * profile->scale);
}

/* ---- what no point has met ---- */

static int add_edges(vndf_profile *profile, const double *more, size_t more_count)
{
    size_t count = profile->edge_count + more_count;
    double *edge = realloc(profile->edge, (count + 1) * sizeof *edge);
    if (!edge)
        return 0;
    profile->edge = edge;
    memcpy(edge + profile->edge_count, more, more_count * sizeof *edge);
    qsort(edge, count, sizeof *edge, vndf_ascending);
    profile->edge_count = count;
    return 1;
}

/* The ends of panels that were cut more than by default: the next passes look where one pass met a feature by
 * chance. */
static int keep_edges(vndf_profile *profile)
{
    const vndf_panel *p = profile->panel;
    double *edge = malloc(2 * profile->count * sizeof *edge);
    size_t count = 0;
    for (size_t i = 0; edge && i < profile->count; i++)
        if (p[i + 1].r < p[i].r * NARROW) {
            edge[count++] = p[i].r * profile->scale;
            edge[count++] = p[i + 1].r * profile->scale;
        }
    int good = edge && add_edges(profile, edge, count);
    free(edge);
    return good;
}

static vndf_status unproven(const vndf_proof *proof, vndf_error *error)
{
    if (isinf(proof->worst))
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 cannot be bounded at slope %.9g: it may be infinite or not a number there",
                         proof->where);
    return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                     "P22 cannot be resolved at slope %.9g: up to %.3g of the mass, or of the area at grazing "
                     "incidence, may lie between the points that were looked at, %.3g of it there",
                     proof->where, proof->hidden, proof->worst);
}

static const double FINEST = 1e-3; /* the default width of features that samples find */

/* Tries the proof; without one, samples. 0 if there is no memory. */
static int look_between(vndf_profile *profile, vndf_proof *proof)
{
    profile->finest = 0.0;
    int good = profile->source->reach ? vndf_proof_from(proof, profile) : 1;
    if (profile->source->reach && (proof->proven || proof->edge_count || profile->sampled == 0.0))
        return good;
    profile->finest = profile->sampled > 0.0 ? profile->sampled : FINEST;
    if (profile->source->reach)
        vndf_proof_free(proof);
    return good && vndf_proof_by_samples(proof, profile, profile->finest);
}

/* 1 if panels must be made anew, with more edges; else *status is the answer. */
static int look_closer(vndf_profile *profile, int last, vndf_status *status, vndf_error *error)
{
    vndf_proof proof = {0};
    int good = look_between(profile, &proof), again = 0;
    profile->hidden = fmin(proof.hidden, 1.0);
    if (vndf_guard_stopped(profile->guard))
        *status = vndf_guard_status(profile->guard, error);
    else if (!good || (proof.edge_count && !add_edges(profile, proof.edge, proof.edge_count)))
        *status = no_memory(error);
    else if (proof.edge_count && !last)
        again = 1;
    else if (!proof.proven && (*status == VNDF_OK || !(profile->f0 > 0.0)))
        *status = unproven(&proof, error);
    vndf_proof_free(&proof);
    return again;
}

/* Looks at points first, then between them, until it finds nothing more. */
static vndf_status make(vndf_profile *profile, vndf_error *error)
{
    enum { LOOKS = 12 };
    for (int i = 0;; i++) {
        profile->normalization = profile->scale = 1.0;
        profile->floor = 0.0;
        profile->unsettled = 0;
        vndf_status status = settle(profile, error);
        if (stopped(profile) || profile->count == 0)
            return status;
        if (!fill_points(profile))
            return no_memory(error);
        int again = look_closer(profile, i + 1 == LOOKS, &status, error);
        if (!again && (!profile->unsettled || i + 1 == LOOKS))
            return status;
        if (!again && !keep_edges(profile))
            return no_memory(error);
    }
}

/* Adds panels that are narrower the nearer they are to a break, where a feature may have any width. */
static int add_break(vndf_profile *profile, double r)
{
    enum { SHELLS = 20 };
    double edge[2 * SHELLS + 1] = {r};
    for (int i = 0; i < SHELLS; i++) {
        double beside = ldexp(r, -2 * (i + 1));
        edge[2 * i + 1] = r - beside;
        edge[2 * i + 2] = r + beside;
    }
    return add_edges(profile, edge, 2 * SHELLS + 1);
}

/* 0 if there is no memory. */
static int take_resolution(vndf_profile *profile, const vndf_resolution *resolution, vndf_error *error)
{
    vndf_resolution none = {NULL, 0, 0.0}, given = resolution ? *resolution : none;
    profile->sampled = given.finest;
    profile->description = vndf_resolution_describe(&given, profile->source->description, error);
    int good = profile->description != NULL;
    for (size_t i = 0; good && i < given.break_count; i++)
        good = add_break(profile, given.breaks[i]);
    if (profile->description && !good)
        no_memory(error);
    return good;
}

vndf_profile *vndf_profile_from(const vndf_source *source, const vndf_resolution *resolution, vndf_guard *guard,
                                vndf_error *error)
{
    vndf_profile *profile = source ? calloc(1, sizeof *profile) : NULL;
    if (!profile) {
        vndf_fail(error, source ? VNDF_ERROR_MEMORY : VNDF_ERROR_ARGUMENT,
                  source ? "no memory to resolve the distribution" : "no source: NULL was given");
        return NULL;
    }
    profile->source = source;
    profile->guard = guard;
    vndf_error inner = {VNDF_ERROR_MEMORY, ""}; /* a pass that fails may precede one that succeeds */
    if (take_resolution(profile, resolution, &inner) && make(profile, &inner) == VNDF_OK)
        return profile;
    vndf_fail(error, inner.status, "%s", inner.message);
    vndf_profile_free(profile);
    return NULL;
}

void vndf_profile_free(vndf_profile *profile)
{
    if (!profile)
        return;
    free(profile->panel);
    free(profile->point);
    free(profile->edge);
    free(profile->description);
    free(profile);
}
