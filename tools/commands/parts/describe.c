#include "commands/parts/describe.h"

#include <math.h>
#include <string.h>

/* The units of figures, as text and JSON name them. */
static const char bytes[] = "B", mass[] = "of the mass", degrees[] = "degrees", relative[] = "relative";

/* A closed form has no certificate. */
static void put_table(figures *f, const vndf_info *info)
{
    const vndf_certificate *c = &info->certificate;
    figures_text(f, "source", info->source);
    figures_text(f, "tool", info->tool);
    figures_number(f, "bytes", "%.9g", (double)info->bytes, bytes);
    figures_number(f, "memory", "%.9g", (double)info->memory, bytes);
    figures_number(f, "cells", "%.9g", (double)info->cells, "intervals");
    figures_number(f, "moments", "%.9g", info->moments, "terms");
    figures_number(f, "normalization", "%.17g", info->normalization, "factor");
    figures_number(f, "scale", "%.9g", info->scale, "slope");
    if (!info->bytes)
        return;
    figures_number(f, "tv", "%.4g", (double)c->tv, mass);
    figures_number(f, "tv_theta", "%.6g", (double)c->tv_theta, degrees);
    figures_number(f, "tv_above", "%.4g", (double)c->tv_above, mass);
    figures_number(f, "tv_above_theta", "%.6g", (double)c->tv_above_theta, degrees);
    figures_number(f, "max_weight", "%.6g", (double)c->max_weight, "ratio");
    figures_truth(f, "weight_bounded", c->weight_bounded > 0);
    figures_number(f, "area_error", "%.4g", (double)c->area_error, relative);
    figures_number(f, "consistency", "%.4g", (double)c->consistency, mass);
    figures_number(f, "ndf_error", "%.4g", (double)c->ndf_error, relative);
    figures_number(f, "hidden", "%.4g", (double)c->hidden, mass);
    figures_number(f, "finest", "%.4g", (double)c->finest, "of the slope");
    figures_number(f, "horizon_power", "%.4g", (double)c->horizon_power, "power of cos(theta_m)");
    figures_number(f, "floor_above", "%.4g", (double)c->floor_above, mass);
    figures_number(f, "floor", "%.4g", (double)c->floor, mass);
}

static double largest_tv(const vndf_family *family)
{
    double most = 0;
    for (size_t i = 0; i < vndf_family_info(family).count; i++)
        most = fmax(most, (double)vndf_distribution_info(vndf_family_distribution(family, i)).certificate.tv);
    return most;
}

static void put_family(figures *f, const vndf_family *family)
{
    vndf_family_facts facts = vndf_family_info(family);
    figures_text(f, "source", facts.source);
    figures_text(f, "tool", facts.tool);
    figures_number(f, "bytes", "%.9g", (double)facts.bytes, bytes);
    figures_number(f, "memory", "%.9g", (double)facts.memory, bytes);
    figures_number(f, "knots", "%.9g", (double)facts.count, "tables");
    figures_number(f, "low", "%.7g", (double)facts.low, "parameter");
    figures_number(f, "high", "%.7g", (double)facts.high, "parameter");
    figures_text(f, "linear_in", facts.reciprocal ? "1/p" : "p");
    figures_number(f, "distance", "%.4g", (double)facts.distance, mass);
    figures_number(f, "grazing", "%.4g", (double)facts.grazing, mass);
    figures_number(f, "tables_tv", "%.4g", largest_tv(family), mass);
    figures_list(f, "knot");
    for (size_t i = 0; i < facts.count; i++) {
        vndf_info info = vndf_distribution_info(vndf_family_distribution(family, i));
        figures_record(f);
        figures_number(f, "at", "%.7g", (double)vndf_family_parameter(family, i), "parameter");
        figures_number(f, "bytes", "%.9g", (double)info.bytes, bytes);
        figures_number(f, "tv", "%.4g", (double)info.certificate.tv, mass);
        if (i + 1 < facts.count)
            figures_number(f, "distance", "%.4g", (double)vndf_family_distance(family, i), mass);
    }
    figures_list_end(f);
}

/* The value of the first note with this key, up to the end of its line; "" if there is none. */
static const char *note_of(const char *notes, const char *key)
{
    const size_t length = strlen(key);
    while (*notes && (strncmp(notes, key, length) != 0 || notes[length] != ' '))
        notes += strcspn(notes, "\n") + 1;
    return *notes ? notes + length + 1 : "";
}

static double number_of(const char *notes, const char *key)
{
    double x = 0;
    sscanf(note_of(notes, key), "%lf", &x);
    return x;
}

enum { CELLS_MOST = 4095 };      /* of any table */
static const double poor = 5e-2; /* a total variation at which samples stop being worth their name */

/* "" where the total variation is good, else what helps, which is only what would make it good. */
static void judge_distance(const vndf_info *info, char *to, size_t room)
{
    const double near_floor = 1.2; /* times what no size mends: a larger table gains less than that */
    const vndf_certificate *c = &info->certificate;
    const int is_above = !((double)c->tv_above <= poor);
    const float tv = is_above ? c->tv_above : c->tv, floor = is_above ? c->floor_above : c->floor;
    const int size_helps = (double)tv > near_floor * (double)floor && info->cells < CELLS_MOST;
    const char *what = size_helps                      ? ": try a larger --max-bytes"
                       : is_above && info->moments < 4 ? ": try --moments 4"
                                                       : ", and no size mends it";
    *to = '\0';
    if (!((double)tv <= poor))
        snprintf(to, room, "; worth little at %.0f degrees%s",
                 (double)(is_above ? c->tv_above_theta : c->tv_theta), what);
}

/* What is wrong, each behind "; ". No doubts are horizon_power, which says what D is, and weight_bounded: a tail that
 * grows towards the horizon has no largest weight, and 1.06 for all but 1e-6 of the mass (student-t-1.8). A formula or
 * a curve has any scale: the integral counts of measurements, whose rows have their own. */
static void find_doubts(const vndf_info *info, char *to, size_t room)
{
    const vndf_certificate *c = &info->certificate;
    const char *notes = info->notes, *implausible = note_of(notes, "implausible");
    const double isotropy = number_of(notes, "residual_isotropy"), rows = number_of(notes, "p22_error_median"),
                 light = number_of(notes, "residual_reflectance"), left_out = number_of(notes, "left_out"),
                 off = strstr(notes, "residual_") ? fabs(1 / info->normalization - 1) : 0;
    const struct {
        double is, most;
        const char *says;
    } limits[] = {
        {(double)c->max_weight, 10, "weights up to %.3g, fireflies"}, /* as bright as ten samples stands out */
        {(double)c->area_error, poor, "Lambda and G1 off by %.2g"},   /* which brightness follows */
        {(double)c->consistency, 2e-3, "densities biased by %.2g"},   /* half a step of 8 bits */
        {(double)c->ndf_error, 3, "D off by %.2g of itself"},         /* 2 is usual at the feet of thin rings */
        {c->finest > 0 ? 0 : (double)c->hidden, 1e-3, "%.2g of D may be missing"}, /* as much as tables are off */
        {isotropy, 5e-2, "no ellipse: %.2g of the normals would have to turn"},    /* more refuses a .bsdf */
        {light, 1e-1, "%.2g of the light is not that of one D"},                   /* a good fit has 0.02 */
        {rows, 1e-1, "P22 known within %.2g, measure more"},                       /* a bin of 100 slopes */
        {left_out / (left_out + 1 + number_of(notes, "slopes")), 1e-2,
         "%.2g of the pixels no normals"},                         /* a rim */
        {off, 5e-2, "the integral of the measured D off by %.2g"}, /* 0.02 for slopes that have a law */
    };
    judge_distance(info, to, room);
    size_t used = strlen(to);
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++)
        if (!(limits[i].is <= limits[i].most)) {
            used += (size_t)snprintf(to + used, room - used, "; ");
            used += (size_t)snprintf(to + used, room - used, limits[i].says, limits[i].is);
        }
    if (*implausible)
        snprintf(to + used, room - used, "; implausible %.200s", implausible);
    to[used + strcspn(to + used, "\n")] = '\0';
}

/* What a good verdict hangs on: the matrix and the mean slope of a surface, features that no sample has met. */
static void find_needs(const vndf_info *info, char *to, size_t room)
{
    const double least = 1e-2; /* of the rms slope: a smaller mean slope moves less than 0.5% of the normals */
    const char *matrix = note_of(info->notes, "matrix");
    double x = 0, y = 0;
    snprintf(to, room, "%s%.64s", *matrix ? " with the matrix " : "", matrix);
    size_t used = strcspn(to, "\n");
    to[used] = '\0';
    sscanf(note_of(info->notes, "tilt"), "%lf,%lf", &x, &y);
    if (hypot(x, y) > least * number_of(info->notes, "rms_slope"))
        used += (size_t)snprintf(to + used, room - used, " %s the mean slope %.4g,%.4g", *matrix ? "and" : "with",
                                 x, y);
    if (info->certificate.finest > 0)
        snprintf(to + used, room - used, " if no feature is narrower than %.2g of its slope",
                 (double)info->certificate.finest);
}

int describe_worth(const vndf_info *of, char worth[DESCRIBE_WORTH])
{
    char doubts[1280], needs[256];
    find_doubts(of, doubts, sizeof doubts);
    find_needs(of, needs, sizeof needs);
    snprintf(worth, DESCRIBE_WORTH, *doubts ? "doubtful%s: %s" : "good to ship%s", needs, doubts + 2);
    return !*doubts;
}

int describe_verdict(const chosen_distribution *of, char verdict[DESCRIBE_VERDICT])
{
    const vndf_family_facts facts = vndf_family_info(of->family);
    vndf_info info = vndf_distribution_info(of->distribution);
    char worth[DESCRIBE_WORTH];
    int good = !of->distribution || describe_worth(&info, worth), length;
    for (size_t i = 0; i < facts.count && good; i++) {
        info = vndf_distribution_info(vndf_family_distribution(of->family, i));
        good = describe_worth(&info, worth);
    }
    if (!((double)facts.distance <= poor))
        good = snprintf(worth, sizeof worth, "doubtful: mixtures are worth little: try more --knots") < 0;
    if (of->family)
        length = snprintf(verdict, 128, "within %.2g%% of the family, %.2g%% at grazing; tables within %.2g%%; ",
                          100 * (double)facts.distance, 100 * (double)facts.grazing, 100 * largest_tv(of->family));
    else
        length = snprintf(verdict, 128, "within %.2g%% of exact above the horizon, %.2g%% below; ",
                          100 * (double)info.certificate.tv_above, 100 * (double)info.certificate.tv);
    snprintf(verdict + length, DESCRIBE_WORTH + 64, "%.1f KiB; %s",
             (double)(of->family ? facts.bytes : info.bytes) / 1024, worth);
    return good;
}

void describe_end(figures *f, const chosen_distribution *of)
{
    char verdict[DESCRIBE_VERDICT], key[VNDF_LIMIT_NOTES + 1], value[VNDF_LIMIT_NOTES + 1];
    const char *notes = vndf_distribution_info(of->distribution).notes;
    for (int length = 0; sscanf(notes, "%4096s %4096[^\n]%n", key, value, &length) == 2; notes += length)
        figures_text(f, key, value);
    if (!describe_verdict(of, verdict))
        complain(f->command, "%s", verdict);
    figures_text(f, "verdict", verdict);
}

void describe(figures *f, const chosen_distribution *of)
{
    const vndf_info info = vndf_distribution_info(of->distribution);
    if (of->family)
        put_family(f, of->family);
    else
        put_table(f, &info);
    if (of->family || info.bytes)
        describe_end(f, of);
}
