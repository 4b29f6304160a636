#include "measured/brdf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measured/model.h"

enum { POINTS_MAX = 1000000, COLUMNS = 3 };
enum { GROUPS_MOST = 400, GROUPS_LEAST = 4, STEPS = 30, SETTLED = 6, UNCALIBRATED = 2 };

static const double degree = 3.14159265358979323846 / 180;
static const double THETA_MOST = 85;    /* degrees, of directions that are used */
static const double RADIANS_MOST = 1.6; /* angles that never exceed this are no degrees */

/* ---- the file ------------------------------------------------------------------------------------ */

typedef enum column { THETA_I, THETA_O, BRDF, INTENSITY, NAMES } column;

static const char *const column_names[NAMES] = {"theta_i", "theta_o", "brdf", "intensity"};

/* A measurement; angles are in radians, of both directions from z. */
typedef struct point {
    double theta_h, theta_i, theta_o, cos_i, cos_o, rise, f;
    size_t group; /* of nearly the same half vector */
} point;

typedef struct points {
    point *at; /* owned */
    size_t used, room, count;
    double largest; /* angle, degrees */
} points;

/* The words of the next line that has some; 0 at the end, -1 and the reason if they are not COLUMNS. */
static int next_line(data_file *file, scan *text, char words[COLUMNS + 1][WORD_MAX])
{
    do {
        int count = 0;
        while (count <= COLUMNS && scan_word(text, words[count]))
            count++;
        if (count == COLUMNS)
            return count;
        if (count > 0)
            return refuse(file, "line %zu: %s numbers or names; %d are needed, separated by commas", text->line,
                          count < COLUMNS ? "too few" : "too many", COLUMNS) -
                   1;
    } while (scan_line(text));
    return 0;
}

static int read_header(data_file *file, scan *text, column columns[COLUMNS])
{
    char words[COLUMNS + 1][WORD_MAX];
    int seen = 0, count = next_line(file, text, words);
    if (count <= 0)
        return count < 0 ? 0 : refuse(file, "no header line; theta_i,theta_o,brdf is needed");
    for (int i = 0; i < COLUMNS; i++) {
        int k = 0;
        while (k < NAMES && strcmp(words[i], column_names[k]) != 0)
            k++;
        if (k == NAMES)
            return refuse(
                file,
                "line %zu: a column is called '%.40s'; theta_i, theta_o (degrees) and brdf or intensity are "
                "known",
                text->line, words[i]);
        columns[i] = (column)k;
        seen |= 1 << (k == INTENSITY ? BRDF : k);
    }
    return seen == 7 ||
           refuse(file, "line %zu: a column is named twice; theta_i, theta_o and brdf or intensity are needed",
                  text->line);
}

/* Adds a measurement, if it is one that can be used. Both directions are in the x-z plane, wi at +theta_i: theta_o
 * counts the other way. */
static int add_point(data_file *file, points *to, size_t line, const double number[NAMES])
{
    double theta_i = number[THETA_I] * degree, theta_o = number[THETA_O] * degree, f = number[BRDF];
    if (!(number[THETA_I] >= 0 && number[THETA_I] <= 90))
        return refuse(file, "line %zu: theta_i is %.10g; it must be from 0 to 90 degrees", line, number[THETA_I]);
    if (!(fabs(number[THETA_O]) <= 90))
        return refuse(file, "line %zu: theta_o is %.10g; it must be from -90 to 90 degrees", line,
                      number[THETA_O]);
    if (!isnan(number[INTENSITY]))
        f = number[INTENSITY] / fmax(cos(theta_o), 1e-9);
    if (!(fabs(f) <= 1e30))
        return refuse(file, "line %zu: the value is too large", line);
    if (++to->count > POINTS_MAX)
        return refuse(file, "line %zu: more than %d rows", line, POINTS_MAX);
    to->largest = fmax(to->largest, fmax(number[THETA_I], fabs(number[THETA_O])));
    if (number[THETA_I] > THETA_MOST || fabs(number[THETA_O]) > THETA_MOST || !(f > 0))
        return 1;
    if (to->used == to->room) {
        to->room = 2 * to->room + 256;
        point *at = realloc(to->at, to->room * sizeof *at);
        if (!at)
            return refuse(file, "there is no memory for %zu rows", to->room);
        to->at = at;
    }
    to->at[to->used++] = (point){fabs(theta_o - theta_i) / 2,
                                 theta_i,
                                 fabs(theta_o),
                                 cos(theta_i),
                                 cos(theta_o),
                                 model_schlick(cos((theta_i + theta_o) / 2)),
                                 f,
                                 0};
    return 1;
}

static int read_points(data_file *file, points *made)
{
    scan text = scan_from(file, ',');
    column columns[COLUMNS];
    char words[COLUMNS + 1][WORD_MAX];
    int count = read_header(file, &text, columns);
    while (count > 0 && scan_line(&text) && (count = next_line(file, &text, words)) > 0) {
        double number[NAMES] = {0, 0, 0, NAN};
        for (int i = 0; i < COLUMNS; i++)
            if (!word_number(words[i], &number[columns[i]]) || isnan(number[columns[i]]))
                return refuse(file, "line %zu: %s is '%.40s', which is no number", text.line,
                              column_names[columns[i]], words[i]);
        if (!add_point(file, made, text.line, number))
            return 0;
    }
    if (file->refused[0])
        return 0;
    if (made->count > 0 && made->largest <= RADIANS_MOST)
        return refuse(file, "no angle is above %.3g degrees: are these radians? Degrees are needed",
                      made->largest);
    note(file, "measurements %zu, %zu of them used", made->count, made->used);
    return 1;
}

/* ---- D ------------------------------------------------------------------------------------------- */

typedef struct fit {
    point *at; /* ascending in theta_h */
    size_t count, groups;
    double theta[GROUPS_MOST];
    double f0, scale, change; /* scale: of D beside the normalised one; change: of areas */
    law law;
} fit;

static int ascending(const void *a, const void *b)
{
    const point *x = a, *y = b;
    return (x->theta_h > y->theta_h) - (x->theta_h < y->theta_h);
}

/* Measurements with nearly the same half vector are one group. */
static void group(fit *l)
{
    double range = l->count ? l->at[l->count - 1].theta_h : 0, begin = -1, number[GROUPS_MOST] = {0};
    double width = fmax(range / (GROUPS_MOST - 1), 0.02 * degree);
    for (size_t i = 0; i < l->count; i++) {
        if (l->groups == 0 || (l->at[i].theta_h - begin > width && l->groups < GROUPS_MOST)) {
            begin = l->at[i].theta_h;
            l->groups++;
        }
        l->at[i].group = l->groups - 1;
        l->theta[l->groups - 1] += l->at[i].theta_h;
        number[l->groups - 1]++;
    }
    for (size_t k = 0; k < l->groups; k++)
        l->theta[k] /= number[k];
}

/* What f has under it: 4 (A_i cos_o + A_o cos_i - cos_i cos_o). */
static double masking(const fit *l, const point *p)
{
    double area_i = law_area(&l->law, p->theta_i), area_o = law_area(&l->law, p->theta_o);
    return 4 * (area_i * p->cos_o + area_o * p->cos_i - p->cos_i * p->cos_o);
}

static double fresnel(const fit *l, const point *p)
{
    return l->f0 <= 1 ? l->f0 + (1 - l->f0) * p->rise : 1;
}

/* One step: D of each group, the mean over its measurements, with the areas of the D before. */
static int step(data_file *file, fit *l, profile *rows)
{
    double number[GROUPS_MOST] = {0}, before[LAW_AREAS];
    memset(rows->value, 0, rows->count * sizeof *rows->value);
    for (size_t i = 0; i < l->count; i++) {
        const point *p = &l->at[i];
        rows->value[p->group] += p->f * masking(l, p) / fresnel(l, p);
        number[p->group]++;
    }
    for (size_t k = 0; k < l->groups; k++)
        rows->value[k] /= number[k];
    vndf_source *source = profile_source(rows, file);
    if (!source)
        return 0;
    memcpy(before, l->law.area, sizeof before);
    l->scale = law_of_source(&l->law, source);
    vndf_source_free(source);
    l->change = 0;
    for (int i = 0; i < LAW_AREAS; i++)
        l->change = fmax(l->change, fabs(l->law.area[i] - before[i]));
    return (isfinite(l->scale) && l->scale > 0) || refuse(file, "D has no integral");
}

/* F0 is looked for unless it is given; that the scale is another is decided when A has settled. */
static int iterate(data_file *file, fit *l, int is_given, profile *rows)
{
    law_even(&l->law, LAW_ANGLES, 0.5);
    law_normalise(&l->law); /* A = cos/2 of no D */
    for (int i = 0; i < LAW_AREAS; i++)
        l->law.area[i] *= 2;
    for (int i = 0; i < STEPS && (i <= SETTLED || l->change > 1e-6); i++) {
        if (!step(file, l, rows))
            return 0;
        /* D came out times f0/F, so its scale is what f0 has to be multiplied by. */
        if (!is_given && l->f0 <= 1)
            l->f0 = l->f0 * l->scale <= 1.02 || i < SETTLED ? fmin(l->f0 * l->scale, 1) : UNCALIBRATED;
    }
    return 1;
}

/* Of f as the model has it: what is elsewhere, f cos_o over all measurements. */
static void note_fit(data_file *file, const fit *l, const profile *rows)
{
    double off = 0, whole = 0;
    for (size_t i = 0; i < l->count; i++) {
        const point *p = &l->at[i];
        off += p->cos_o * fabs(p->f - fresnel(l, p) * rows->value[p->group] / masking(l, p)) / 2;
        whole += p->cos_o * p->f;
    }
    note(file, "half_vectors %zu, to %.4g degrees", l->groups, rows->x[l->groups - 1] / degree);
    if (l->f0 <= 1)
        note(file, "f0 %.4g", l->f0);
    else
        note(file, "uncalibrated, f0 times a scale is %.4g", l->scale);
    note(file, "change_of_area %.2g", l->change);
    note(file, "residual_reflectance %.3g", off / whole);
}

int gonio_read(data_file *file, double f0, profile *rows)
{
    points given = {0};
    fit *l = calloc(1, sizeof *l);
    *rows = (profile){0};
    int good = l ? read_points(file, &given) : refuse(file, "there is no memory");
    if (good) {
        if (given.used)
            qsort(given.at, given.used, sizeof *given.at, ascending);
        l->at = given.at;
        l->count = given.used;
        l->f0 = f0 < 0 ? 0.5 : f0;
        l->change = 1;
        group(l);
        good = l->groups >= GROUPS_LEAST ||
               refuse(file, "%zu half vectors with light; %d are needed", l->groups, GROUPS_LEAST);
    }
    good = good && profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, l->groups, file);
    if (good)
        memcpy(rows->x, l->theta, l->groups * sizeof *rows->x);
    good = good && iterate(file, l, f0 >= 0, rows);
    if (good)
        note_fit(file, l, rows);
    else
        profile_free(rows);
    free(given.at);
    free(l);
    return good;
}
