#include <math.h>
#include <stdlib.h>

#include "measured/brdf/gonio.h"
#include "measured/brdf/power.h"
#include "measured/model.h"

enum { GROUPS_MOST = 400, GROUPS_LEAST = 4, STEPS = 30, SETTLED = 6, AREAS = 91, UNCALIBRATED = 2 };

static const double degree = 3.14159265358979323846 / 180;

/* A measurement as it is used. */
typedef struct used {
    double theta_h, theta_i, theta_o, cos_i, cos_o, rise, f;
    size_t group;
} used;

typedef struct law {
    used *at; /* owned: ascending in theta_h */
    size_t count, groups;
    double theta[GROUPS_MOST], ndf[GROUPS_MOST]; /* of the groups */
    double area[AREAS];                          /* every degree */
    power_bins bins;
    double f0, scale, change;
} law;

static int ascending(const void *a, const void *b)
{
    const used *x = a, *y = b;
    return (x->theta_h > y->theta_h) - (x->theta_h < y->theta_h);
}

/* Both directions in the x-z plane, wi at +theta_i: theta_o counts the other way. */
static void choose(law *l, const gonio_points *points)
{
    for (size_t i = 0; i < points->count; i++) {
        const gonio_point *p = &points->at[i];
        if (p->theta_i > 85 * degree || fabs(p->theta_o) > 85 * degree || !(p->f > 0))
            continue;
        l->at[l->count++] = (used){fabs(p->theta_o - p->theta_i) / 2,
                                   p->theta_i,
                                   fabs(p->theta_o),
                                   cos(p->theta_i),
                                   cos(p->theta_o),
                                   model_schlick(cos((p->theta_i + p->theta_o) / 2)),
                                   p->f,
                                   0};
    }
    qsort(l->at, l->count, sizeof *l->at, ascending);
}

/* Measurements with nearly the same half vector are one group. */
static void group(law *l)
{
    double range = l->count ? l->at[l->count - 1].theta_h : 0;
    double width = fmax(range / (GROUPS_MOST - 1), 0.02 * degree), begin = -1, number[GROUPS_MOST] = {0};
    l->groups = 0;
    for (size_t i = 0; i < l->count; i++) {
        if (l->groups == 0 || (l->at[i].theta_h - begin > width && l->groups < GROUPS_MOST)) {
            begin = l->at[i].theta_h;
            l->theta[l->groups++] = 0;
        }
        l->at[i].group = l->groups - 1;
        l->theta[l->groups - 1] += l->at[i].theta_h;
        number[l->groups - 1]++;
    }
    for (size_t k = 0; k < l->groups; k++)
        l->theta[k] /= number[k];
}

static double area_at(const law *l, double theta)
{
    double place = theta / (degree);
    int at = place < AREAS - 2 ? (int)place : AREAS - 2;
    return l->area[at] + (place - at) * (l->area[at + 1] - l->area[at]);
}

/* 4 (A_i cos_o + A_o cos_i - cos_i cos_o): what f has under it. */
static double masking(const law *l, const used *p)
{
    return 4 * (area_at(l, p->theta_i) * p->cos_o + area_at(l, p->theta_o) * p->cos_i - p->cos_i * p->cos_o);
}

static double fresnel(const law *l, const used *p)
{
    return l->f0 <= 1 ? l->f0 + (1 - l->f0) * p->rise : 1;
}

/* F D of each group, the mean over its measurements. */
static void solve(law *l)
{
    double sum[GROUPS_MOST] = {0}, number[GROUPS_MOST] = {0};
    for (size_t i = 0; i < l->count; i++) {
        const used *p = &l->at[i];
        sum[p->group] += p->f * masking(l, p) / fresnel(l, p);
        number[p->group]++;
    }
    for (size_t k = 0; k < l->groups; k++)
        l->ndf[k] = sum[k] / number[k];
}

static int make_rows(const law *l, const char *name, profile *rows, refusal *why)
{
    if (!profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, l->groups))
        return refuse_data(why, name, "there is no memory for %zu rows", l->groups);
    for (size_t k = 0; k < l->groups; k++) {
        rows->x[k] = l->theta[k];
        rows->value[k] = l->ndf[k];
    }
    return 1;
}

/* A of the curve through the rows, and the scale that D has beside the normalised one. */
static int follow(law *l, const profile *rows, const char *name, refusal *why)
{
    double ndf[POWER_ANGLES];
    vndf_source *source = profile_source(rows, name, why);
    if (!source)
        return 0;
    for (int i = 0; i < l->bins.count; i++)
        ndf[i] = vndf_source_p22(source, tan(l->bins.theta[i])) / pow(cos(l->bins.theta[i]), 4);
    vndf_source_free(source);
    l->scale = power_normalise(&l->bins, ndf);
    l->change = 0;
    for (int i = 0; i < AREAS; i++) {
        double area = power_area(&l->bins, ndf, i * degree);
        l->change = fmax(l->change, fabs(area - l->area[i]));
        l->area[i] = area;
    }
    return isfinite(l->scale) && l->scale > 0 ? 1 : refuse_data(why, name, "D has no integral");
}

/* One step. F0 is looked for unless it is given; that the scale is another is decided when A has settled. */
static int step(law *l, int number, int is_given, const char *name, profile *rows, refusal *why)
{
    profile_free(rows);
    solve(l);
    if (!make_rows(l, name, rows, why) || !follow(l, rows, name, why))
        return 0;
    /* D came out times f0/F, so its scale is what f0 has to be multiplied by. */
    if (!is_given && l->f0 <= 1)
        l->f0 = l->f0 * l->scale <= 1.02 || number < SETTLED ? fmin(l->f0 * l->scale, 1) : UNCALIBRATED;
    return 1;
}

/* Of f as the model has it: what is elsewhere, f cos_o over all measurements. */
static void note_law(const law *l, notes *to)
{
    double off = 0, whole = 0;
    for (size_t i = 0; i < l->count; i++) {
        const used *p = &l->at[i];
        double model = fresnel(l, p) * l->ndf[p->group] / masking(l, p);
        off += p->cos_o * fabs(p->f - model) / 2;
        whole += p->cos_o * p->f;
    }
    note(to, "half_vectors %zu, to %.4g degrees", l->groups, l->theta[l->groups - 1] / degree);
    if (l->f0 <= 1)
        note(to, "f0 %.4g", l->f0);
    else
        note(to, "uncalibrated, f0 times a scale is %.4g", l->scale);
    note(to, "change_of_area %.2g", l->change);
    note(to, "residual_reflectance %.3g", off / whole);
}

int gonio_law(const gonio_points *points, double f0, const char *name, profile *rows, notes *to, refusal *why)
{
    law *l = calloc(1, sizeof *l);
    *rows = (profile){VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, NULL, NULL, 0, NULL};
    if (l)
        l->at = malloc((points->count + 1) * sizeof *l->at);
    if (!l || !l->at) {
        free(l);
        return refuse_data(why, name, "there is no memory for %zu measurements", points->count);
    }
    choose(l, points);
    group(l);
    note(to, "measurements %zu, %zu of them used", points->count, l->count);
    power_even(&l->bins, POWER_ANGLES / 2, 0.5);
    l->f0 = f0 < 0 ? 0.5 : f0;
    l->change = 1;
    for (int i = 0; i < AREAS; i++)
        l->area[i] = cos(i * degree);
    int good = l->groups >= GROUPS_LEAST;
    if (!good)
        refuse_data(why, name, "%zu half vectors with light; %d are needed", l->groups, GROUPS_LEAST);
    for (int i = 0; i < STEPS && good && (i <= SETTLED || l->change > 1e-6); i++)
        good = step(l, i, f0 >= 0, name, rows, why);
    if (good)
        note_law(l, to);
    else
        profile_free(rows);
    free(l->at);
    free(l);
    return good;
}
