#include "measured/profile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 4, PANELS = 6, STEPS = 40, TABLE_ROWS = 100 };

static const double two_pi = 6.283185307179586477;

int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count)
{
    *made = (profile){over, of, calloc(count, sizeof(double)), calloc(count, sizeof(double)), count, NULL};
    if (made->x && made->value)
        return 1;
    profile_free(made);
    return 0;
}

void profile_free(profile *freed)
{
    free(freed->x);
    free(freed->value);
    free(freed->error);
    freed->x = freed->value = freed->error = NULL;
    freed->count = 0;
}

int profile_write(FILE *file, const profile *from, const char *title)
{
    fprintf(file, "# %s\n", title);
    if (from->error)
        fputs("# +- after a row: one standard deviation of its value, relative\n", file);
    fprintf(file, "%s,%s\n", from->over == VNDF_ROWS_OVER_SLOPE ? "slope" : "theta",
            from->of == VNDF_ROWS_OF_P22 ? "p22" : "ndf");
    for (size_t i = 0; i < from->count; i++) {
        fprintf(file, "%.17g,%.17g\n", from->x[i], from->value[i]);
        if (from->error)
            fprintf(file, "# +- %.3g\n", from->error[i]);
    }
    return fflush(file) == 0 && !ferror(file);
}

vndf_source *profile_source(const profile *from, const char *name, refusal *why)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_rows(from->over, from->of, from->x, from->value, from->count, NULL, &error);
    if (!source)
        refuse_data(why, name, "what was found is no curve: %s", error.message);
    return source;
}

/* A build takes a second for thousands of rows; for areas every n-th is enough. */
static vndf_source *thin_source(const profile *from, const char *name, refusal *why)
{
    double x[TABLE_ROWS], value[TABLE_ROWS];
    profile thin = {from->over, from->of, x, value, TABLE_ROWS, NULL};
    if (from->count <= TABLE_ROWS)
        return profile_source(from, name, why);
    for (size_t i = 0; i < TABLE_ROWS; i++) {
        size_t row = i * (from->count - 1) / (TABLE_ROWS - 1);
        x[i] = from->x[row];
        value[i] = from->value[row];
    }
    return profile_source(&thin, name, why);
}

vndf_distribution *profile_table(const profile *from, const char *name, refusal *why)
{
    const vndf_build_options options = {.max_bytes = 8192};
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = thin_source(from, name, why);
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, &error) : NULL;
    if (source && !table)
        refuse_data(why, name, "no table can be made of it: %s", error.message);
    vndf_source_free(source);
    return table;
}

/* ---- masses ---- */

/* By Gauss-Legendre, exact to degree 7. */
static double panel_mass(const vndf_source *source, double from, double to)
{
    static const double place[POINTS] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                         0.93056815579702629};
    static const double weight[POINTS] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                          0.17392742256872693};
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        double r = from + (to - from) * place[i];
        sum += weight[i] * vndf_source_p22(source, r) * r;
    }
    return two_pi * sum * (to - from);
}

double profile_mass(const vndf_source *source, double from, double to)
{
    double sum = 0, most = isfinite(to) ? to : from * 1e6;
    /* Beyond a finite stretch the panels grow: P22 falls at least as r^-4 there. */
    for (double left = from; !isfinite(to) && left < most; left *= 1.5)
        sum += profile_mass(source, left, 1.5 * left);
    for (int i = 0; isfinite(to) && i < PANELS; i++)
        sum += panel_mass(source, from + (to - from) * i / PANELS, from + (to - from) * (i + 1) / PANELS);
    return sum;
}

/* ---- matching ------------------------------------------------------------------------------------ */

/* What each bin needs to be multiplied by goes to factor[]; the largest part by which a bin is wrong, or -1. */
static double compare(const profile *with, const profile_bins *bins, double *factor, const char *name,
                      refusal *why)
{
    double worst = 0, whole = 0;
    vndf_source *source = profile_source(with, name, why);
    if (!source)
        return -1;
    for (size_t i = 0; i < bins->count; i++)
        whole += bins->mass[i];
    for (size_t i = 0; i < bins->count; i++) {
        double found = profile_mass(source, bins->edge[i], bins->edge[i + 1]);
        worst = fmax(worst, fabs(found - bins->mass[i]) / whole);
        factor[i] = found > 0 ? bins->mass[i] / found : 1;
    }
    vndf_source_free(source);
    return worst;
}

/* Rows beyond the last bin go with it. */
static void multiply(profile *changed, const profile_bins *bins, const double *factor, double power)
{
    for (size_t i = 0; i < changed->count; i++)
        changed->value[i] *= pow(factor[i < bins->count ? i : bins->count - 1], power);
}

/* In full steps; in smaller ones after a step that made the worst bin no better. The best rows are kept: where no rows
 * have the masses, the last ones may be far worse. */
static int match(profile *changed, const profile_bins *bins, double *factor, double *best, const char *name,
                 double *left, refusal *why)
{
    double before = INFINITY, power = 1;
    *left = INFINITY;
    for (int step = 0; step < STEPS && !(*left <= 1e-6); step++) {
        double worst = compare(changed, bins, factor, name, why);
        if (worst < 0)
            return 0;
        if (worst < *left) {
            *left = worst;
            memcpy(best, changed->value, changed->count * sizeof *best);
        }
        power = worst < before ? power : fmax(power / 2, 0.125);
        before = worst;
        multiply(changed, bins, factor, power);
    }
    memcpy(changed->value, best, changed->count * sizeof *best);
    return 1;
}

int profile_match(profile *changed, const profile_bins *bins, const char *name, double *left, refusal *why)
{
    double *factor = malloc(bins->count * sizeof *factor), *best = malloc(changed->count * sizeof *best);
    int good = factor && best ? match(changed, bins, factor, best, name, left, why)
                              : refuse_data(why, name, "there is no memory for %zu rows", changed->count);
    free(factor);
    free(best);
    return good;
}
