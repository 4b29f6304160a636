/* The figures of a comparison. The mean square of an image's error falls as 1/samples, so that ratios of squares
 * are ratios of samples, and of time. */
#include "compare/comparison.h"

static double error_of(const contest_point *p, int trimmed)
{
    return trimmed ? p->error.trimmed : p->error.relative;
}

double efficiency(const contest *c, size_t i, int trimmed)
{
    const contest_point *first = &c->way[0].by_time, *p = &c->way[i].by_time;
    double ratio = error_of(first, trimmed) / error_of(p, trimmed);
    return ratio * ratio * first->seconds / p->seconds;
}

double samples_for_error(const contest *c, size_t i, int trimmed)
{
    double ratio = error_of(&c->way[i].by_samples, trimmed) / error_of(&c->way[0].by_samples, trimmed);
    return (double)c->samples * ratio * ratio;
}

static void print_common(FILE *file, const comparison *r)
{
    fprintf(file, "\n| %s | error that more samples do not lessen | and what could not be seen |\n|---|---|---|\n",
            r->by);
    for (size_t i = 1; i < r->contest->count; i++)
        fprintf(file, "| %s | %.2g%% | %.2g%% |\n", r->contest->way[i].name, 100 * r->common[i],
                100 * r->common_noise[i]);
}

void comparison_print(FILE *file, const comparison *r)
{
    const contest *c = r->contest;
    unsigned long long all = c->samples;
    fprintf(file, "| %s | samples in equal time | error | efficiency | error of %llu samples | time of them "
                  "| samples for the error of %s |\n|---|---|---|---|---|---|---|\n", r->by, all, c->way[0].name);
    for (size_t i = 0; i < c->count; i++) {
        const way *w = &c->way[i];
        fprintf(file, "| %s | %llu | %.2f%% (%.2f%%) | %.2f (%.2f) | %.2f%% (%.2f%%) | %.1f s | %.0f (%.0f) |\n",
                w->name, (unsigned long long)w->by_time.samples, 100 * w->by_time.error.relative,
                100 * w->by_time.error.trimmed, efficiency(c, i, 0), efficiency(c, i, 1),
                100 * w->by_samples.error.relative, 100 * w->by_samples.error.trimmed, w->by_samples.seconds,
                samples_for_error(c, i, 0), samples_for_error(c, i, 1));
    }
    fprintf(file, "\n| %s | all light, of the reference's | in standard deviations "
                  "| blocks of 16 x 16 pixels beyond 3 (by chance 0.27%%) | their mean square (1) |\n"
                  "|---|---|---|---|---|\n", r->by);
    for (size_t i = 0; i < c->count; i++)
        fprintf(file, "| %s | %.5f | %+.1f | %.2f%% | %.2f |\n", c->way[i].name, r->agrees[i].ratio,
                r->agrees[i].whole, 100 * r->agrees[i].beyond, r->agrees[i].mean_square);
    if (r->reference_read)
        fprintf(file, "\nThe reference was read: its noise is not known, and counts as that of the ways.\n");
    if (r->has_common)
        print_common(file, r);
    if (r->remarks[0])
        fprintf(file, "\n%s\n", r->remarks);
}
