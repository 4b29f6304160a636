/* MERL files (W. Matusik, H. Pfister, M. Brand, L. McMillan, "A Data-Driven Reflectance Model", SIGGRAPH 2003): three
 * numbers of 32 bits, 90 90 180 (or 360), then red, green and blue, each 90 x 90 x 180 doubles, the azimuth fastest;
 * all with the least byte first. f is a number times 1/1500, 1.15/1500 and 1.66/1500. Its bins, counted from the half
 * vector h: theta_h even in its square root from 0 to 90 degrees, theta_d even, phi_d even over half a turn. A number
 * is taken as f in the middle of its bin, and masked with heights correlated.
 *
 * D comes from what the surface sends back to where the light came from, by power iteration (J. Dupuy, E. Heitz,
 * J.-C. Iehl, P. Poulin, V. Ostromoukhov, "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials with
 * Power Iterations", EGSR 2015). There m = wi = wo, and the model has f = F0 D(w) / (4 cos (2 A(w)
 * - cos)). Now 2 A(w) - cos is the integral of |w.m| D(m) dm, so that
 *
 *     F0 D(w) = 4 cos f(w) integral |w.m| D(m) dm:
 *
 * D is an eigenvector, and F0 its eigenvalue, where D has the integral 1 over the projected hemisphere. (The paper
 * has the positive part of w.m in the place of |w.m|: it takes masking along the way in and along the same way out as
 * one event. Which of the two holds is a property of the surface; this is the one that the model of all files here
 * has.)
 *
 * All else of the file is compared with what D and Schlick's F then say of it:
 *
 *     f cos_o = F D(m) G2 / (4 cos_i) = F R D(m) / (4 A_i),   R = A_i cos_o / (A_i cos_o + A_o cos_i - cos_i cos_o). */
#include "measured/measured.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HALVES = 90, DIFFERENCES = 90, HALF_TURN = 180, HEAD = 12, AREAS = 181, STEPS = 60 };
/* Every n-th bin is compared with the model. */
enum { STEP_D = 3, STEP_PHI = 30, PLACES = HALVES * (DIFFERENCES / STEP_D) * (HALF_TURN / STEP_PHI) };

static const double pi = 3.14159265358979323846;
static const double unit_of[3] = {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
static const double weight_of[][3] = {
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2126, 0.7152, 0.0722}}; /* by merl_channel */

/* ---- D ------------------------------------------------------------------------------------------- */

/* D at the middles theta[i] of the bins of h, whose solid angles are 2 pi share[i], and its projected area every half
 * degree. */
typedef struct law {
    double theta[HALVES], share[HALVES], ndf[HALVES], area[AREAS];
    double both_sides[AREAS][HALVES]; /* what a bin with D = 1 adds to the integral of |w.m| D(m) dm */
} law;

static void make_bins(law *l)
{
    for (int i = 0; i < HALVES; i++) {
        const double at = (i + 0.5) / HALVES, from = (double)i / HALVES, to = (i + 1.0) / HALVES;
        const double bin = l->theta[i] = pi / 2 * at * at;
        l->share[i] = cos(pi / 2 * from * from) - cos(pi / 2 * to * to);
        for (int k = 0; k < AREAS; k++) {
            const double theta = pi / 2 * k / (AREAS - 1), a = cos(theta) * cos(bin), b = sin(theta) * sin(bin);
            const double around = a >= b ? 2 * pi * a : 4 * (a * asin(a / b) + sqrt(b * b - a * a));
            l->both_sides[k][i] = l->share[i] * around; /* the integral over phi of |a + b cos(phi)| */
        }
    }
}

/* Scales D to the integral 1 over the projected hemisphere and finds its areas; returns what the integral was. */
static double normalise(law *l)
{
    double whole = 0;
    for (int i = 0; i < HALVES; i++)
        whole += 2 * pi * l->share[i] * cos(l->theta[i]) * l->ndf[i];
    for (int i = 0; i < HALVES && whole > 0; i++)
        l->ndf[i] /= whole;
    for (int k = 0; k < AREAS; k++) {
        double both = 0;
        for (int i = 0; i < HALVES; i++)
            both += l->both_sides[k][i] * l->ndf[i];
        l->area[k] = (both + cos(pi / 2 * k / (AREAS - 1))) / 2;
    }
    return whole;
}

static double area_at(const law *l, double theta)
{
    const double place = fmin(theta / (pi / 2), 1) * (AREAS - 1);
    const int at = place < AREAS - 2 ? (int)place : AREAS - 2;
    return l->area[at] + (place - at) * (l->area[at + 1] - l->area[at]);
}

/* The fixed point for f[] at the bins, and its F0; negative where nothing is known: D is that of the bin before. 0 if
 * there is no light. */
static int iterate(law *l, const double *f, double *f0)
{
    double before = 0;
    for (int i = 0; i < HALVES; i++)
        l->ndf[i] = 1;
    *f0 = normalise(l);
    for (int step = 0; step < STEPS && (step < 4 || fabs(*f0 - before) > 1e-10 * *f0); step++) {
        before = *f0;
        for (int i = 0; i < HALVES; i++) {
            const double area = area_at(l, l->theta[i]), c = cos(l->theta[i]);
            const double next = 4 * f[i] * c * (2 * area - c);
            l->ndf[i] = f[i] >= 0 ? next : i > 0 ? l->ndf[i - 1] : 0;
        }
        *f0 = normalise(l);
        if (!(*f0 > 0))
            return 0;
    }
    return 1;
}

/* ---- the file ------------------------------------------------------------------------------------ */

/* A bin that is compared: f there, and what it weighs; of the model f with F = 1 - (1 - wi.m)^5 and with F = that. */
typedef struct place {
    int half;
    double found, light, cos_i, cos_o, rise, low, high;
} place;

typedef struct search {
    const unsigned char *numbers;
    int azimuths; /* of phi_d */
    merl_channel channel;
    double back[HALVES]; /* f of light that goes back; -1 where there is no number */
    int missing;         /* how many of these */
    law law;
    double f0;                  /* of light that goes back, */
    double fitted_0, fitted_90; /* and F0 and F90 nearest to all light by least squares */
    size_t count;
    place places[PLACES];
} search;

/* -1 where there is no number. */
static double value_at(const search *s, int half, int difference, int azimuth)
{
    size_t plane = (size_t)HALVES * DIFFERENCES * (size_t)s->azimuths;
    size_t at = ((size_t)half * DIFFERENCES + (size_t)difference) * (size_t)s->azimuths + (size_t)azimuth;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        if (weight_of[s->channel][i] == 0)
            continue;
        const double value = little_number(s->numbers + 8 * (at + (size_t)i * plane), 8) * unit_of[i];
        if (!(value >= 0) || !(value < 1e30))
            return -1;
        sum += weight_of[s->channel][i] * value;
    }
    return sum;
}

/* The mean over azimuths at theta_d = 0. */
static void read_back(search *s)
{
    s->missing = 0;
    for (int half = 0; half < HALVES; half++) {
        double sum = 0, count = 0;
        for (int azimuth = 0; azimuth < s->azimuths; azimuth++) {
            const double value = value_at(s, half, 0, azimuth);
            sum += fmax(value, 0);
            count += value >= 0;
        }
        s->missing += count == 0;
        s->back[half] = count > 0 ? sum / count : -1;
    }
}

/* Where wi and wo, on both sides of h at (theta_h, 0), are within 80 degrees of z; the weight is the light's, cos_i
 * cos_o over both directions. */
static void read_places(search *s)
{
    static const double least = 0.17364817766693; /* cos 80 degrees */
    const int step = STEP_PHI * s->azimuths / HALF_TURN;
    for (int half = 0; half < HALVES; half++)
        for (int difference = 1; difference < DIFFERENCES; difference += STEP_D)
            for (int azimuth = step / 2; azimuth < s->azimuths; azimuth += step) {
                const double theta_d = (difference + 0.5) / DIFFERENCES * pi / 2, theta_h = s->law.theta[half];
                const double middle = cos(theta_h) * cos(theta_d), found = value_at(s, half, difference, azimuth);
                const double away = sin(theta_h) * sin(theta_d) * cos((azimuth + 0.5) / s->azimuths * pi);
                const double cos_i = middle - away, cos_o = middle + away;
                if (cos_i > least && cos_o > least && found >= 0)
                    s->places[s->count++] = (place){
                        .half = half,
                        .found = found,
                        .light = cos_i * cos_o * s->law.share[half] * sin(theta_d) * cos(theta_d),
                        .cos_i = cos_i,
                        .cos_o = cos_o,
                        .rise = pow(1 - cos(theta_d), 5),
                    };
            }
}

/* ---- the search ---------------------------------------------------------------------------------- */

/* D and F for one diffuse constant; the part of the light that is elsewhere then, at most 1. Squares have relative
 * weights, so that the dim wide part counts as the bright peak. */
static double try_diffuse(search *s, double diffuse)
{
    double f[HALVES], aa = 0, ab = 0, bb = 0, fa = 0, fb = 0, off = 0, whole = 0;
    for (int i = 0; i < HALVES; i++)
        f[i] = s->back[i] < 0 ? -1 : fmax(s->back[i] - diffuse, 0);
    if (!iterate(&s->law, f, &s->f0))
        return 1;
    for (place *p = s->places; p < s->places + s->count; p++) {
        const double area_i = area_at(&s->law, acos(p->cos_i)), area_o = area_at(&s->law, acos(p->cos_o));
        const double masked = area_i * p->cos_o + area_o * p->cos_i - p->cos_i * p->cos_o;
        const double shape = s->law.ndf[p->half] / (4 * masked), found = p->found - diffuse;
        const double weight = p->light / (shape * s->f0 + diffuse + 1e-30);
        p->low = shape * (1 - p->rise);
        p->high = shape * p->rise;
        aa += weight * p->low * p->low;
        ab += weight * p->low * p->high;
        bb += weight * p->high * p->high;
        fa += weight * found * p->low;
        fb += weight * found * p->high;
    }
    const double det = aa * bb - ab * ab;
    s->fitted_0 = (fa * bb - fb * ab) / det;
    s->fitted_90 = (fb * aa - fa * ab) / det;
    for (const place *p = s->places; p < s->places + s->count; p++) {
        off += p->light * fabs(p->found - diffuse - s->fitted_0 * p->low - s->fitted_90 * p->high) / 2;
        whole += p->light * p->found;
    }
    return det > 0 && isfinite(s->fitted_0) && isfinite(s->fitted_90) && off < whole ? off / whole : 1;
}

/* On ever finer steps about the best so far, from 0 to the least light that comes back anywhere within 70 degrees; 0
 * if that is as good. */
static double find_diffuse(search *s)
{
    double most = INFINITY, best = 0;
    const double none = try_diffuse(s, 0);
    double least = none;
    for (int i = 0; i < HALVES && s->law.theta[i] < 70 * pi / 180; i++)
        most = s->back[i] < 0 ? most : fmin(most, s->back[i]);
    for (double step = isfinite(most) ? most / 8 : 0; step > 1e-4 * most; step /= 8) {
        const double from = fmax(best - 8 * step, step), to = fmin(best + 8.5 * step, most);
        for (double diffuse = from; diffuse <= to; diffuse += step) {
            const double residual = try_diffuse(s, diffuse);
            best = residual < least ? diffuse : best;
            least = fmin(residual, least);
        }
    }
    return none <= 1.01 * least + 1e-5 ? 0 : best;
}

/* The number of azimuths, or 0 and the reason. */
static int open_file(data_file *file)
{
    unsigned long side[3] = {0};
    for (size_t i = 0; i < 3 && file->size >= HEAD; i++)
        side[i] = (unsigned long)little_whole(file->bytes + 4 * i, 4);
    if (side[0] != HALVES || side[1] != DIFFERENCES || (side[2] != HALF_TURN && side[2] != 2 * HALF_TURN))
        return refuse(file, "this is no MERL file: it begins with %lu %lu %lu in the place of 90 90 180", side[0],
                      side[1], side[2]);
    const size_t want = HEAD + (size_t)HALVES * DIFFERENCES * (size_t)side[2] * 3 * 8;
    return file->size == want ? (int)side[2]
                              : refuse(file, "a MERL file of 90 x 90 x %lu has %zu bytes, and there are %zu",
                                       side[2], want, file->size);
}

static int search_file(data_file *file, search *s, profile *rows)
{
    static const char *const names[3] = {"red", "green", "blue"};
    make_bins(&s->law);
    read_back(s);
    read_places(s);
    if (s->count == 0)
        return refuse(file, "no direction within 80 degrees has a value");
    const double diffuse = find_diffuse(s), residual = try_diffuse(s, diffuse);
    if (residual >= 1 || !(s->f0 > 0))
        return refuse(file, "no light comes back to where it came from, or D explains nothing of the file");
    note(file, "angles_without_light %d\ndiffuse %.4g\nf0 %.4g\nf90 %.4g\nresidual_reflectance %.3g", s->missing,
         diffuse * pi, s->fitted_0, s->fitted_90, residual);
    if (!profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, HALVES, file))
        return 0;
    memcpy(rows->x, s->law.theta, HALVES * sizeof *rows->x);
    memcpy(rows->value, s->law.ndf, HALVES * sizeof *rows->value);
    for (int i = 0; i < 3; i++) { /* F0 of each channel by itself, with its own D; diffuse light counts in */
        s->channel = (merl_channel)i;
        read_back(s);
        if (iterate(&s->law, s->back, &s->f0))
            note(file, "f0_%s %.4g", names[i], s->f0);
    }
    return 1;
}

int merl_read(data_file *file, merl_channel channel, profile *rows)
{
    *rows = (profile){0};
    const int azimuths = open_file(file);
    search *s = azimuths ? calloc(1, sizeof *s) : NULL;
    if (!s)
        return azimuths ? refuse(file, "there is no memory") : 0;
    s->numbers = file->bytes + HEAD;
    s->azimuths = azimuths;
    s->channel = channel;
    const int good = search_file(file, s, rows);
    free(s);
    return good;
}
