#include "cli/verdict.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Beyond these a table is not good to ship. Two numbers of a certificate are no doubts. weight_bounded: a tail that
 * grows towards the horizon has no largest weight, but max_weight holds for all but 1e-6 of the mass (student-t-1.8 has
 * 1.06). horizon_power says what D is, not how well it is drawn. */
static const double tv_most = 5e-2;       /* of all samples wrong: they stop being worth their name */
static const double weight_most = 10;     /* a sample as bright as ten stands out as a firefly */
static const double area_most = 5e-2;     /* Lambda and G1, which the brightness of the surface follows */
static const double mass_most = 2e-3;     /* of the density, a bias: half a step of 8 bits */
static const double ndf_most = 1;         /* D is twice itself; beside thin rings, where little is, 0.4 is usual */
static const double hidden_most = 1e-3;   /* of the mass unknown, as much as a default table may be off */
static const double isotropy_most = 5e-2; /* of the normals; more of it refuses a .bsdf */
static const double by_chance = 6;        /* over the root of the number of slopes; independent ones have 4 */
static const double reflectance_most = 1e-1; /* of the light; a good fit has 0.02 */
static const double row_most = 1e-1;      /* one deviation of P22 at the median: few slopes, or no one surface */
static const double left_out_most = 1e-2; /* of the pixels that were no normals: a border, no surface */
static const double integral_most = 5e-2; /* of measured rows off 1; slopes that have a law stay within 0.02 */
static const double tilt_least = 1e-2;    /* of the rms slope: less moves less than 0.5% of the normals */
static const double tilt_most = 0.3;      /* 17 degrees: a tilted stage, or normals stored by a curve (sRGB) */
static const double near_floor = 1.2;     /* times what no size mends: a larger table gains less than that */

/* ---- reasons ------------------------------------------------------------------------------------- */

void verdict_doubt(table_verdict *to, const char *format, ...)
{
    const size_t used = strlen(to->doubts);
    const int mark = snprintf(to->doubts + used, sizeof to->doubts - used, "%s", used ? "; " : "");
    va_list list;
    va_start(list, format);
    if (used + (size_t)mark < sizeof to->doubts)
        vsnprintf(to->doubts + used + mark, sizeof to->doubts - used - (size_t)mark, format, list);
    va_end(list);
}

/* Where the total variation is too large, and what helps, if anything does. */
static void judge_distance(table_verdict *v, const vndf_info *info)
{
    const vndf_certificate *c = &info->certificate;
    const double above = (double)c->tv_above, below = (double)c->tv, floor_above = (double)c->floor_above;
    const int is_above = !(above <= tv_most), nears_above = above > near_floor * floor_above,
              nears_below = below > near_floor * (double)c->floor;
    v->misses = (above > table_aim_above && nears_above) || (below > table_aim_below && nears_below);
    if (is_above || !(below <= tv_most))
        verdict_doubt(v, "worth little at %.0f degrees%s", (double)(is_above ? c->tv_above_theta : c->tv_theta),
                      (is_above ? nears_above : nears_below) ? ": try a larger --max-bytes"
                      : is_above && info->moments < 4        ? ": try --moments 4"
                                                             : ", and no size mends it");
}

static void judge_certificate(table_verdict *v, const vndf_info *info)
{
    const vndf_certificate *c = &info->certificate;
    judge_distance(v, info);
    if (!((double)c->max_weight <= weight_most))
        verdict_doubt(v, "weights up to %.3g, which show as fireflies", (double)c->max_weight);
    if (!((double)c->area_error <= area_most))
        verdict_doubt(v, "Lambda and G1 are up to %.3g%% off", 100 * (double)c->area_error);
    if (!((double)c->consistency <= mass_most))
        verdict_doubt(v, "densities integrate to 1 within %.2g alone, a bias", (double)c->consistency);
    if (!((double)c->ndf_error <= ndf_most))
        verdict_doubt(v, "D is up to %.3g%% off", 100 * (double)c->ndf_error);
    if (c->finest > 0)
        snprintf(v->needs, sizeof v->needs, " if no feature is narrower than %.2g of its slope",
                 (double)c->finest);
    else if (!((double)c->hidden <= hidden_most))
        verdict_doubt(v, "%.2g of the normals may have been missed", (double)c->hidden);
}

/* ---- notes --------------------------------------------------------------------------------------- */

/* The value of the first note with this key, which ends with its line, or NULL. Its number, NaN if there is none. */
static const char *note_of(const char *notes, const char *key)
{
    const size_t length = strlen(key);
    for (; *notes; notes += strcspn(notes, "\n") + 1)
        if (strncmp(notes, key, length) == 0 && notes[length] == ' ')
            return notes + length + 1;
    return NULL;
}

static double number_of(const char *notes, const char *key)
{
    const char *value = note_of(notes, key);
    return value ? strtod(value, NULL) : NAN;
}

/* The matrix, and a mean slope that moves normals. */
static void find_needs(table_verdict *v, const char *notes)
{
    const char *matrix = note_of(notes, "matrix"), *tilt = note_of(notes, "tilt");
    double x, y;
    char *put = v->needs + strlen(v->needs);
    if (matrix)
        put += snprintf(put, 100, " with the matrix %.*s", (int)fmin((double)strcspn(matrix, "\n"), 64), matrix);
    if (!tilt || sscanf(tilt, "%lf,%lf", &x, &y) != 2 || hypot(x, y) <= tilt_least * number_of(notes, "rms_slope"))
        return;
    snprintf(put, 100, " %s the mean slope %.4g,%.4g", matrix ? "and" : "with", x, y);
    if (hypot(x, y) > fmax(tilt_most, number_of(notes, "rms_slope")))
        verdict_doubt(v, "the surface leans as a whole, is it meant to?");
}

static void judge_notes(table_verdict *v, const vndf_info *info)
{
    const char *notes = info->notes, *wrong = notes;
    const double isotropy = number_of(notes, "residual_isotropy"),
                 light = number_of(notes, "residual_reflectance"), row = number_of(notes, "p22_error_median"),
                 left_out = number_of(notes, "left_out"), all = left_out + number_of(notes, "slopes");
    for (; (wrong = note_of(wrong, "implausible")) != NULL; wrong += strcspn(wrong, "\n"))
        verdict_doubt(v, "implausible %.*s", (int)fmin((double)strcspn(wrong, "\n"), 200), wrong);
    if (isotropy > isotropy_most)
        verdict_doubt(v, "%.2g of the normals would have to turn about z: %s", isotropy,
                      isotropy < by_chance / sqrt(number_of(notes, "slopes"))
                          ? "too few slopes to tell; measure more of the surface"
                          : "the slopes are no ellipse");
    if (light > reflectance_most)
        verdict_doubt(v, "%.2g of the light is not that of one D", light);
    if (row > row_most)
        verdict_doubt(v, "P22 is known within %.0f%% alone: measure more of the surface", 100 * row);
    if (left_out > left_out_most * all)
        verdict_doubt(v, "%.0f%% of the pixels are no normals", 100 * left_out / all);
    /* Formulas and curves of the user may have any scale; what was measured here has the one of its file. */
    if ((!isnan(isotropy) || !isnan(light)) && !(fabs(1 / info->normalization - 1) <= integral_most))
        verdict_doubt(v, "the measured D integrates to %.2g, not 1", 1 / info->normalization);
    find_needs(v, notes);
}

/* ---- the sentence -------------------------------------------------------------------------------- */

/* Mixtures between knots, and the first table with a doubt. */
static void judge_family(table_verdict *v, const vndf_family *family)
{
    const vndf_family_facts facts = vndf_family_info(family);
    for (size_t i = 0; i < facts.count && !v->doubts[0]; i++) {
        const vndf_info info = vndf_distribution_info(vndf_family_distribution(family, i));
        judge_certificate(v, &info);
        if (v->doubts[0])
            verdict_doubt(v, "that is the table of %.7g", (double)vndf_family_parameter(family, i));
    }
    if (!((double)facts.distance <= tv_most))
        verdict_doubt(v, "mixtures are worth little: try more --knots");
}

double verdict_largest_tv(const vndf_family *family)
{
    double most = 0;
    for (size_t i = 0; i < vndf_family_info(family).count; i++)
        most = fmax(most, (double)vndf_distribution_info(vndf_family_distribution(family, i)).certificate.tv);
    return most;
}

table_verdict verdict_of(const chosen_distribution *of)
{
    table_verdict v = {.within = ""};
    const vndf_info info = vndf_distribution_info(of->distribution);
    const vndf_family_facts facts = vndf_family_info(of->family);
    if (of->family)
        judge_family(&v, of->family);
    else if (info.bytes) {
        judge_certificate(&v, &info);
        judge_notes(&v, &info);
    }
    if (of->family)
        snprintf(v.within, sizeof v.within,
                 "within %.2g%% of the family, %.2g%% at grazing; tables within %.2g%%; %.1f KiB; ",
                 100 * (double)facts.distance, 100 * (double)facts.grazing, 100 * verdict_largest_tv(of->family),
                 (double)facts.bytes / 1024);
    else
        snprintf(v.within, sizeof v.within, "within %.2g%% of exact above the horizon, %.2g%% below; %.1f KiB; ",
                 100 * (double)info.certificate.tv_above, 100 * (double)info.certificate.tv,
                 (double)info.bytes / 1024);
    return v;
}

const char *verdict_text(const table_verdict *is, char text[VERDICT_TEXT])
{
    const int doubtful = is->doubts[0] != 0;
    snprintf(text, VERDICT_TEXT, "%s%s%s%s%s", is->within, doubtful ? "doubtful" : "good to ship", is->needs,
             doubtful ? ": " : "", is->doubts);
    return text;
}

void verdict_tell(const table_verdict *is, const char *command, figures *f)
{
    char text[VERDICT_TEXT];
    verdict_text(is, text);
    if (is->doubts[0])
        complain(command, "%s", text);
    if (f)
        figures_text(f, "verdict", text);
}
