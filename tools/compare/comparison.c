/* The figures of a comparison. The mean square of an image's error falls as 1/samples, so that ratios of squares
 * are ratios of samples, and of time. */
#include "compare/comparison.h"

#include <math.h>

static double error_of(const contest_point *p, int trimmed)
{
    return trimmed ? p->error.trimmed : p->error.relative;
}

/* The square of one error over that of another. */
static measured ratio_of(const contest_point *a, const contest_point *b, int trimmed)
{
    double ratio = error_of(a, trimmed) / error_of(b, trimmed);
    double spread = a == b ? 0 : hypot(a->error.spread[trimmed], b->error.spread[trimmed]);
    measured m = {ratio * ratio, ratio * ratio * spread};
    return m;
}

measured efficiency(const contest *c, size_t i, int trimmed)
{
    const contest_point *first = &c->way[0].by_time, *p = &c->way[i].by_time;
    measured m = ratio_of(first, p, trimmed);
    m.value *= first->seconds / p->seconds;
    m.spread *= first->seconds / p->seconds;
    return m;
}

measured samples_for_error(const contest *c, size_t i, int trimmed)
{
    measured m = ratio_of(&c->way[i].by_samples, &c->way[0].by_samples, trimmed);
    m.value *= (double)c->samples;
    m.spread *= (double)c->samples;
    return m;
}

/* Two digits, without an exponent. */
static void percent(char text[COMMON_TEXT], const char *before, double part)
{
    double digits = part > 0 ? ceil(-log10(100 * part)) + 1 : 2;
    snprintf(text, COMMON_TEXT, "%s%.*f%%", before, (int)fmin(fmax(digits, 1), 8), 100 * part);
}

/* What is not above twice what chance leaves cannot be told from nothing. */
void common_text(char text[COMMON_TEXT], const comparison *r, size_t i)
{
    double seen = 2 * r->common_noise[i];
    if (r->common[i] > seen)
        percent(text, "", r->common[i]);
    else
        percent(text, "below ", seen);
}

/* Without fireflies in brackets. */
static void error_text(char text[FIGURE_TEXT], const film_error *e)
{
    snprintf(text, FIGURE_TEXT, "%.2f%% (%.2f%%)", 100 * e->relative, 100 * e->trimmed);
}

static void measured_text(char text[FIGURE_TEXT], int digits, measured all, measured trimmed)
{
    snprintf(text, FIGURE_TEXT, "%.*f ± %.*f (%.*f ± %.*f)", digits, all.value, digits, all.spread, digits,
             trimmed.value, digits, trimmed.spread);
}

void way_figures(char text[FIGURES][FIGURE_TEXT], const contest *c, size_t i)
{
    const way *w = &c->way[i];
    snprintf(text[FIGURE_TIME_SAMPLES], FIGURE_TEXT, "%llu", (unsigned long long)w->by_time.samples);
    error_text(text[FIGURE_TIME_ERROR], &w->by_time.error);
    measured_text(text[FIGURE_EFFICIENCY], 2, efficiency(c, i, 0), efficiency(c, i, 1));
    snprintf(text[FIGURE_SECONDS], FIGURE_TEXT, "%.1f", w->by_samples.seconds);
    error_text(text[FIGURE_ERROR], &w->by_samples.error);
    measured_text(text[FIGURE_SAMPLES_FOR_ERROR], 0, samples_for_error(c, i, 0), samples_for_error(c, i, 1));
}

/* ---- tables ---- */

static void print_common(FILE *file, const comparison *r)
{
    fprintf(file, "\n| %s | error that more samples do not lessen |\n|---|---|\n", r->by);
    for (size_t i = 1; i < r->contest->count; i++) {
        char text[COMMON_TEXT];
        common_text(text, r, i);
        fprintf(file, "| %s | %s |\n", r->contest->way[i].name, text);
    }
}

static void print_agreement(FILE *file, const comparison *r)
{
    fprintf(file,
            "\n| %s | all light, of the reference's | in standard deviations "
            "| blocks of 16 x 16 pixels beyond 3 (by chance 0.27%%) | their mean square (1) |\n"
            "|---|---|---|---|---|\n",
            r->by);
    for (size_t i = 0; i < r->contest->count; i++)
        fprintf(file, "| %s | %.5f | %+.1f | %.2f%% | %.2f |\n", r->contest->way[i].name, r->agrees[i].ratio,
                r->agrees[i].whole, 100 * r->agrees[i].beyond, r->agrees[i].mean_square);
    if (r->reference_read)
        fprintf(file, "\nThe reference was read: its noise is not known, and counts as that of the ways.\n");
}

void comparison_print(FILE *file, const comparison *r)
{
    const contest *c = r->contest;
    fprintf(file,
            "| %s | samples in equal time | error | efficiency | error of %llu samples | time of them "
            "| samples for the error of %s |\n|---|---|---|---|---|---|---|\n",
            r->by, (unsigned long long)c->samples, c->way[0].name);
    for (size_t i = 0; i < c->count; i++) {
        char f[FIGURES][FIGURE_TEXT];
        way_figures(f, c, i);
        fprintf(file, "| %s | %s | %s | %s | %s | %s s | %s |\n", c->way[i].name, f[FIGURE_TIME_SAMPLES],
                f[FIGURE_TIME_ERROR], f[FIGURE_EFFICIENCY], f[FIGURE_ERROR], f[FIGURE_SECONDS],
                f[FIGURE_SAMPLES_FOR_ERROR]);
    }
    print_agreement(file, r);
    if (r->has_common)
        print_common(file, r);
    if (r->remarks[0])
        fprintf(file, "\n%s\n", r->remarks);
}
