/* The figures of a comparison. The mean square of an image's error falls as 1/samples, so that ratios of squares
 * are ratios of samples, and of time. */
#include "compare/comparison.h"

#include <math.h>
#include <string.h>

enum { FIGURE_TEXT = 64 };

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
static void percent(char text[FIGURE_TEXT], const char *before, double part)
{
    double digits = part > 0 ? ceil(-log10(100 * part)) + 1 : 2;
    snprintf(text, FIGURE_TEXT, "%s%.*f%%", before, (int)fmin(fmax(digits, 1), 8), 100 * part);
}

/* In brackets: without fireflies. */
static void error_text(char text[FIGURE_TEXT], const film_error *e)
{
    snprintf(text, FIGURE_TEXT, "%.2f%% (%.2f%%)", 100 * e->relative, 100 * e->trimmed);
}

static void measured_text(char text[FIGURE_TEXT], int digits, measured all, measured trimmed)
{
    snprintf(text, FIGURE_TEXT, "%.*f ± %.*f (%.*f ± %.*f)", digits, all.value, digits, all.spread, digits,
             trimmed.value, digits, trimmed.spread);
}

/* ---- tables ---- */

/* The results: in equal time, then with equal samples. */
static void add_figures(text_table *t, const comparison *r, size_t i)
{
    const contest *c = r->contest;
    const way *w = &c->way[i];
    char text[FIGURE_TEXT], samples[FIGURE_TEXT], wanted[FIGURE_TEXT];
    snprintf(samples, sizeof samples, "%llu samples:\n", (unsigned long long)c->samples);
    snprintf(wanted, sizeof wanted, "samples for the error of %s", c->way[0].name);
    table_text(t, r->by, w->name);
    table_number(t, "equal time:\nsamples", "%.0f", (double)w->by_time.samples);
    error_text(text, &w->by_time.error);
    table_figure(t, "equal time:\nerror", text);
    measured_text(text, 2, efficiency(c, i, 0), efficiency(c, i, 1));
    table_figure(t, "equal time:\nefficiency", text);
    error_text(text, &w->by_samples.error);
    table_figure(t, strcat(samples, "error"), text);
    *strchr(samples, '\n') = '\0';
    table_number(t, strcat(samples, "\nseconds"), "%.1f", w->by_samples.seconds);
    measured_text(text, 0, samples_for_error(c, i, 0), samples_for_error(c, i, 1));
    table_figure(t, wanted, text);
}

static void add_agreement(text_table *t, const comparison *r, size_t i)
{
    const agreement *a = &r->agrees[i];
    table_text(t, r->by, r->contest->way[i].name);
    table_number(t, "all light, of the\nreference's", "%.5f", a->ratio);
    table_number(t, "in standard\ndeviations", "%+.1f", a->whole);
    table_number(t, "blocks of 16 x 16 pixels\nbeyond 3 (by chance 0.27%)", "%.2f%%", 100 * a->beyond);
    table_number(t, "their mean\nsquare (1)", "%.2f", a->mean_square);
}

/* An error below twice its noise cannot be told from 0. */
static void add_common(text_table *t, const comparison *r, size_t i)
{
    char text[FIGURE_TEXT];
    double seen = 2 * r->common_noise[i];
    if (r->common[i] > seen)
        percent(text, "", r->common[i]);
    else
        percent(text, "below ", seen);
    table_text(t, r->by, r->contest->way[i].name);
    table_figure(t, "error that more\nsamples do not lessen", text);
}

static text_table table_from(const comparison *r, size_t first,
                             void (*columns)(text_table *t, const comparison *r, size_t i))
{
    text_table t = {.rows = 0};
    for (size_t i = first; i < r->contest->count; i++) {
        table_row(&t);
        columns(&t, r, i);
    }
    return t;
}

text_table comparison_figures(const comparison *r)
{
    return table_from(r, 0, add_figures);
}

text_table comparison_agreement(const comparison *r)
{
    return table_from(r, 0, add_agreement);
}

text_table comparison_common(const comparison *r)
{
    return table_from(r, 1, add_common);
}

static int print(FILE *file, text_table t)
{
    int good = table_print_markdown(file, &t);
    table_free(&t);
    return good;
}

int comparison_print(FILE *file, const comparison *r)
{
    int good = print(file, comparison_figures(r));
    fputs("\n", file);
    good = print(file, comparison_agreement(r)) && good;
    if (r->reference_read)
        fputs("\nThe reference was read: its noise is not known, and counts as that of the ways.\n", file);
    if (r->has_common) {
        fputs("\n", file);
        good = print(file, comparison_common(r)) && good;
    }
    if (r->remarks[0])
        fprintf(file, "\n%s\n", r->remarks);
    return good;
}
