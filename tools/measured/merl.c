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
 * has.) */
#include "measured/brdf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HALVES = 90, DIFFERENCES = 90, HALF_TURN = 180, HEAD = 12, STEPS = 60 };
/* Every n-th bin is compared with the model. */
enum { STEP_D = 3, STEP_PHI = 30, PROBES = HALVES * (DIFFERENCES / STEP_D) * (HALF_TURN / STEP_PHI) };

static const double unit_of[3] = {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
static const double of_luminance[3] = {0.2126, 0.7152, 0.0722};

/* ---- the file ------------------------------------------------------------------------------------ */

typedef struct search {
    const unsigned char *numbers;
    int azimuths; /* of phi_d */
    merl_channel channel;
    double back[HALVES]; /* f of light that goes back; -1 where there is no number */
    int missing;         /* how many of these */
    law law;
    double f0;
    reflectance fitted;
    size_t count; /* of places that are compared */
    probe probes[PROBES];
    struct place {
        double found, theta_h, cos_i, cos_o, rise;
    } places[PROBES];
} search;

/* -1 where there is no number. */
static double value_at(const search *s, int half, int difference, int azimuth)
{
    size_t plane = (size_t)HALVES * DIFFERENCES * (size_t)s->azimuths;
    size_t at = ((size_t)half * DIFFERENCES + (size_t)difference) * (size_t)s->azimuths + (size_t)azimuth;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        if (s->channel != MERL_LUMINANCE && s->channel != (merl_channel)i)
            continue;
        double value = little_number(s->numbers + 8 * (at + (size_t)i * plane), 8) * unit_of[i];
        if (!(value >= 0) || !(value < 1e30))
            return -1;
        sum += (s->channel == MERL_LUMINANCE ? of_luminance[i] : 1) * value;
    }
    return sum;
}

/* The mean over azimuths at theta_d = 0. */
static void read_back(search *s)
{
    law_even(&s->law, HALVES);
    s->missing = 0;
    for (int half = 0; half < HALVES; half++) {
        double sum = 0, count = 0;
        for (int azimuth = 0; azimuth < s->azimuths; azimuth++) {
            double value = value_at(s, half, 0, azimuth);
            sum += fmax(value, 0);
            count += value >= 0;
        }
        s->missing += count == 0;
        s->back[half] = count > 0 ? sum / count : -1;
    }
}

/* Where wi and wo, on both sides of h at (theta_h, 0), are within 80 degrees of z; the weight is the light's, cos_i
 * cos_o over both directions. */
static void read_probes(search *s)
{
    static const double least = 0.17364817766693; /* cos 80 degrees */
    const int step = STEP_PHI * s->azimuths / HALF_TURN;
    for (int half = 0; half < HALVES; half++)
        for (int difference = 1; difference < DIFFERENCES; difference += STEP_D)
            for (int azimuth = step / 2; azimuth < s->azimuths; azimuth += step) {
                const double theta_d = (difference + 0.5) / DIFFERENCES * PI / 2, theta_h = s->law.theta[half];
                const double middle = cos(theta_h) * cos(theta_d), found = value_at(s, half, difference, azimuth);
                const double away = sin(theta_h) * sin(theta_d) * cos((azimuth + 0.5) / s->azimuths * PI);
                const double cos_i = middle - away, cos_o = middle + away;
                if (!(cos_i > least && cos_o > least) || !(found >= 0))
                    continue;
                s->probes[s->count].light = cos_i * cos_o * s->law.share[half] * sin(theta_d) * cos(theta_d);
                s->places[s->count++] = (struct place){found, theta_h, cos_i, cos_o, model_schlick(cos(theta_d))};
            }
}

/* ---- the search ---------------------------------------------------------------------------------- */

/* The fixed point for f[] at the bins of *l, from any D there, and its F0; negative where nothing is known: D is that
 * of the bin before. 0 if there is no light. */
static int iterate(law *l, const double *f, double *f0)
{
    double before = 0;
    if (!(law_normalise(l) > 0)) {
        for (int i = 0; i < l->count; i++)
            l->ndf[i] = 1;
        law_normalise(l);
    }
    *f0 = 0;
    for (int step = 0; step < STEPS && (step < 4 || fabs(*f0 - before) > 1e-10 * *f0); step++) {
        before = *f0;
        for (int i = 0; i < l->count; i++) {
            double area = law_area(l, l->theta[i]), c = cos(l->theta[i]);
            double next = 4 * f[i] * c * (2 * area - c);
            l->ndf[i] = f[i] >= 0 ? next : i > 0 ? l->ndf[i - 1] : 0;
        }
        *f0 = law_normalise(l);
        if (!(*f0 > 0))
            return 0;
    }
    return 1;
}

/* D and F for one diffuse constant; the residual, at most 1. Squares have relative weights, so that the dim wide part
 * counts as the bright peak. */
static double try_diffuse(search *s, double diffuse)
{
    double f[HALVES];
    for (int i = 0; i < HALVES; i++)
        f[i] = s->back[i] < 0 ? -1 : fmax(s->back[i] - diffuse, 0);
    if (!iterate(&s->law, f, &s->f0))
        return 1;
    double found = 0, left = 0; /* light without the diffuse part, and all of it */
    for (size_t i = 0; i < s->count; i++) {
        const struct place *at = &s->places[i];
        const double area_i = law_area(&s->law, acos(at->cos_i)), area_o = law_area(&s->law, acos(at->cos_o));
        const double masked = area_i * at->cos_o + area_o * at->cos_i - at->cos_i * at->cos_o;
        const double shape = law_ndf(&s->law, at->theta_h) / (4 * masked), light = s->probes[i].light;
        s->probes[i] = (probe){at->found - diffuse, shape * (1 - at->rise), shape * at->rise, light,
                               light / (shape * s->f0 + diffuse + 1e-30)};
        found += light * (at->found - diffuse);
        left += light * at->found;
    }
    if (!model_reflectance(s->probes, s->count, &s->fitted))
        return 1;
    s->fitted.residual *= found / left;
    return fmin(s->fitted.residual, 1);
}

/* On ever finer steps about the best so far, from 0 to the least light that comes back anywhere within 70 degrees; 0
 * if that is as good. */
static double find_diffuse(search *s)
{
    double most = INFINITY, best = 0, none = try_diffuse(s, 0), least = none;
    for (int i = 0; i < HALVES && s->law.theta[i] < 70 * PI / 180; i++)
        most = s->back[i] < 0 ? most : fmin(most, s->back[i]);
    most = isfinite(most) ? most : 0;
    for (double step = most / 8; step > 1e-4 * most; step /= 8) {
        double middle = best;
        for (int i = -8; i <= 8; i++) {
            double diffuse = middle + i * step, residual = 1;
            if (i != 0 && diffuse > 0 && diffuse <= most)
                residual = try_diffuse(s, diffuse);
            if (residual < least) {
                least = residual;
                best = diffuse;
            }
        }
    }
    return none <= 1.01 * least + 1e-5 ? 0 : best;
}

/* The number of azimuths, or 0 and the reason. */
static int open_file(data_file *file)
{
    unsigned long side[3];
    if (file->size < HEAD)
        return refuse(file, "this is no MERL file: its head of three numbers of 4 bytes is not whole");
    for (size_t i = 0; i < 3; i++)
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
    read_back(s);
    read_probes(s);
    if (s->count == 0)
        return refuse(file, "no direction within 80 degrees has a value");
    const double diffuse = find_diffuse(s);
    if (try_diffuse(s, diffuse) >= 1 || !(s->f0 > 0))
        return refuse(file, "no light comes back to where it came from, or D explains nothing of the file");
    note(file, "angles_without_light %d\ndiffuse %.4g\nf0 %.4g\nf90 %.4g\nresidual_reflectance %.3g", s->missing,
         diffuse * PI, s->fitted.f0, s->fitted.f90, s->fitted.residual);
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
