/* vndf judge: is anyone's sampler of visible normals right? It is a process that answers lines (judge/process.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/figures.h"
#include "cli/progress.h"
#include "cli/subject.h"
#include "command.h"
#include "judge/judge.h"

static const char name[] = "vndf judge";

static const char *const help[] = {
    "usage: vndf judge COMMAND [--ndf FILE|ggx|beckmann [--alpha A[,B]]] [--samples N] [--seed S]\n"
    "\n"
    "Judges a sampler of visible normals in any language. COMMAND is one word for the shell, which runs it some\n"
    "ten times; it reads queries from stdin, one a line, to the end, and answers each by a line on stdout:\n"
    "\n"
    "  s wi.x wi.y wi.z u1 u2 u3        wm.x wm.y wm.z pdf     a normal drawn by uniform numbers in [0, 1)\n"
    "  p wi.x wi.y wi.z wm.x wm.y wm.z  pdf                    its density per steradian\n"
    "\n"
    "At 0, 20, 45, 65, 80 and 88 degrees from the normal, each at an azimuth of its own, it has to pass:\n"
    "\n"
    "  unit        samples have length 1 within 1e-4\n"
    "  facing      they face wi and the side of the surface, within a cosine of 1e-5\n"
    "  valid       densities are finite and not negative, those of samples positive\n"
    "  agrees      the density of a sample is that asked for it, within 1e-3 for 99% of 1000\n"
    "  mass        the integral of the density over the hemisphere is 1 within 1e-3 and the error of quadrature\n"
    "  holes       no bin that expects 20 samples or more has none; smaller holes fail as chi-square\n"
    "  covers      (--ndf) at most 1e-3 of the true visible normals has the density 0, which is bias\n"
    "  chi-square  samples follow the density over 16 x 32 bins of each direction, and over rings and sectors of\n"
    "              all together; bins that expect less than 5 are pooled. Significance 0.01 for all (Sidak)\n"
    "\n"
    "and is told: the scatter of 64 x 64 stratified samples over the bins as a part of that of random ones (1: they\n"
    "are worth no more); with --ndf the total variation to the true visible normals and the efficiency\n"
    "1/integral Dv^2/p. Exit status 1: it fails, in what the last lines name; 2: COMMAND cannot be judged.\n"
    "\n"
    "  --ndf FILE       the distribution that is meant: a table, ggx or beckmann\n"
    "    --alpha A[,B]  its roughness along x and y (default 1)\n"
    "  --samples N      of each direction (default 100000); four times as many notice an error half as large\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "\n"
    "example: cc -O2 tools/judge/examples/ggx_caps.c -lm -o ggx_caps\n"
    "         vndf judge './ggx_caps 0.3 0.1' --ndf ggx --alpha 0.3,0.1\n"
    "         vndf judge 'python3 tools/judge/examples/ggx_caps.py 0.3 0.1' --samples 20000\n",
    NULL};

static void print_views(figures *f, const judge_view *views, int has_truth)
{
    figures_list(f, "directions");
    for (int i = 0; i < JUDGE_VIEWS; i++) {
        const judge_view *v = &views[i];
        figures_record(f);
        figures_number(f, "theta", "%.3g", v->theta, "degrees");
        figures_number(f, "phi", "%.3g", v->phi, "degrees");
        figures_number(f, "mass", "%.7g", v->mass, "");
        figures_number(f, "mass_error", "%.2g", v->mass_error, "");
        figures_number(f, "bins", "%.9g", (double)v->bins.classes, "");
        figures_number(f, "statistic", "%.6g", v->bins.statistic, "");
        figures_number(f, "p", "%.4g", v->bins.p, "");
        figures_number(f, "scatter", "%.3g", v->scatter, "of random samples");
        if (has_truth) {
            figures_number(f, "tv", "%.3g", v->tv, "of the mass");
            figures_number(f, "efficiency", "%.4g", v->efficiency, "ratio");
        }
    }
    figures_list_end(f);
}

/* A bin in figures; azimuths are those of the surface. */
static void print_bin(figures *f, const judge_view *v, size_t bin)
{
    static const char *const names[4] = {"theta_from", "theta_to", "phi_from", "phi_to"};
    const double degrees = 180 / acos(-1);
    const double *theta = &v->ring[bin / JUDGE_SECTORS], *phi = &v->sector[bin % JUDGE_SECTORS];
    const double ends[4] = {theta[0], theta[1], v->turn + phi[0], v->turn + phi[1]};
    figures_record(f);
    figures_number(f, "theta_of_wi", "%.3g", v->theta, "degrees");
    for (int k = 0; k < 4; k++)
        figures_number(f, names[k], "%.4g", ends[k] * degrees, "degrees");
    figures_number(f, "expected", "%.4g", v->expected[bin], "samples");
    figures_number(f, "observed", "%.4g", v->observed[bin], "samples");
}

/* The first bins without a sample; and where a direction's samples do not follow the density, the bin that is farthest
 * off. */
static void print_bins(figures *f, const judge_view *views, double level)
{
    enum { SHOWN = 12 };
    figures_list(f, "first holes");
    for (size_t i = 0, shown = 0; i < (size_t)JUDGE_VIEWS * JUDGE_BINS && shown < SHOWN; i++)
        if (judge_is_hole(&views[i / JUDGE_BINS], i % JUDGE_BINS)) {
            print_bin(f, &views[i / JUDGE_BINS], i % JUDGE_BINS);
            shown++;
        }
    figures_list(f, "farthest off");
    for (const judge_view *v = views; v < views + JUDGE_VIEWS; v++) {
        size_t most = 0;
        double worst = -1;
        for (size_t i = 0; i < JUDGE_BINS && v->bins.p < level; i++) {
            const double off = v->observed[i] - v->expected[i], by = off * off / fmax(v->expected[i], 5);
            most = by > worst ? i : most;
            worst = fmax(worst, by);
        }
        if (worst >= 0)
            print_bin(f, v, most);
    }
    figures_list_end(f);
}

static int print_verdict(const arguments *given, const judge_task *task, const judge_view *views)
{
    static const char *const names[] = {"unit", "facing", "valid",  "agrees",
                                        "mass", "holes",  "covers", "chi-square"};
    static const double limits[JUDGE_NUMBERS] = {1e-4, 1e-5, 0,   1e-3,
                                                 1e-3, 0,    1e-3}; /* in the order of judge_id */
    const int has_truth = task->surface.distribution != NULL;
    const double level = statistics_sidak(0.01, JUDGE_VIEWS + 2), p = judge_least_p(views);
    char failed[LISTED_LENGTH] = "";
    figures f = figures_begin(given);
    figures_text(&f, "command", task->command);
    figures_number(&f, "samples", "%.9g", (double)task->samples, "of each direction");
    print_views(&f, views, has_truth);
    print_bins(&f, views, level);
    figures_list(&f, "verdict");
    for (int id = 0; id <= JUDGE_NUMBERS; id++) {
        const int is_p = id == JUDGE_NUMBERS;
        double worst = is_p ? p : 0;
        if (id == JUDGE_COVERS && !has_truth)
            continue;
        for (int i = 0; i < JUDGE_VIEWS && !is_p; i++)
            worst = fmax(worst, views[i].found[id]);
        const int is_good = is_p ? p >= level : worst <= limits[id];
        figures_record(&f);
        figures_text(&f, "of", names[id]);
        figures_number(&f, is_p ? "least p" : "worst", "%.3g", worst, "");
        figures_number(&f, "limit", "%.3g", is_p ? level : limits[id], "");
        figures_truth(&f, "good", is_good);
        if (!is_good)
            snprintf(failed + strlen(failed), sizeof failed - strlen(failed), "%s%s", *failed ? ", " : "",
                     names[id]);
    }
    figures_list_end(&f);
    if (*failed)
        figures_text(&f, "fails", failed);
    figures_text(&f, "result", *failed ? "FAILED" : "good");
    const int status = figures_end(&f);
    return *failed && status == STATUS_GOOD ? STATUS_NO : status;
}

static int run(const arguments *given)
{
    const char *ndf = option_value(given, "--ndf");
    unsigned long long samples = 100000, seed = 1;
    chosen_distribution chosen = {NULL, NULL, NULL};
    judge_view views[JUDGE_VIEWS];
    vndf_surface surface;
    if (!option_count(given, "--samples", 1000, 1e6, &samples) ||
        !option_count(given, "--seed", 0, 0x1p53, &seed) ||
        !roughness_from(name, option_value(given, "--alpha"), &surface) ||
        (ndf && !distribution_open(&chosen, name, ndf, 0)))
        return STATUS_USE;
    surface.distribution = chosen.distribution;
    const judge_task task = {name, given->positional.item[0], (size_t)samples, seed, surface};
    progress bar = progress_begin(name, option_value(given, "-q") != NULL);
    const int is_judged = judge_views(&task, &bar, views);
    progress_end(&bar);
    int status = is_judged ? print_verdict(given, &task, views) : STATUS_USE;
    distribution_close(&chosen);
    return status;
}

const subcommand command_judge = {name, "judge anyone's sampler; exit 1 if it fails", "COMMAND", 1, 1, run, help};
