/* vndf judge: is anyone's sampler of visible normals right? It is a process that answers lines (judge/process.c). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/figures.h"
#include "cli/progress.h"
#include "cli/subject.h"
#include "command.h"
#include "judge/judge.h"

static const char name[] = "vndf judge";

static const char *const help[] = {
    "usage: vndf judge COMMAND [--ndf FILE|ggx|beckmann [--alpha A[,B]]] [--samples N] [--seed S]\n"
    "                  [--timeout SECONDS]\n"
    "\n"
    "Judges a sampler of visible normals in any language. COMMAND is one word for the shell, which runs it some\n"
    "ten times; it reads queries from stdin, one a line, to the end, and answers each by a line on stdout:\n"
    "\n"
    "  s wi.x wi.y wi.z u1 u2 u3        wm.x wm.y wm.z pdf     a normal drawn by uniform numbers in [0, 1)\n"
    "  p wi.x wi.y wi.z wm.x wm.y wm.z  pdf                    its density per steradian\n"
    "\n"
    "At fourteen directions, at 0 and 89.99 degrees from the normal and between, in all octants of the azimuth, drawn\n"
    "by the seed, and with uniform numbers at 0 and 1 - 2^-24, too, it has to pass:\n"
    "\n"
    "  unit        samples have length 1 within 1e-4\n"
    "  facing      they face wi and the side of the surface, within a cosine of 1e-5\n"
    "  valid       densities are finite and not negative, those of samples positive\n"
    "  moves       within 1e-3 of 0 or of 1 u1 and u2 still move the sample: of 16 pairs half may be the same\n"
    "  agrees      the density of a sample is that asked for it, within 1e-3 for 99% of 1000\n"
    "  mass        the integral of the density over the hemisphere is 1 within 1e-3 and four standard deviations of\n"
    "              the quadrature, mass_error; where that exceeds 6e-3, it cannot be told\n"
    "  covers      (--ndf) at most 1e-3 of the true visible normals has the density 0, which is bias\n"
    "  normals     (--ndf) the total variation to them is at most 2e-2: 4% of roughness are that much\n"
    "  chi-square  samples follow the density over 256 bins of each direction, over bins, rings and sectors of\n"
    "              all together, and in all blocks of 4096 bins, where a hole of 1e-3 shows itself (1024 bins for\n"
    "              less than 50000 samples). Bins that expect less than 5 are pooled. Bins whose integral errs\n"
    "              more than their count are left_out; where they hold a fifth of the mass, it cannot be told.\n"
    "              Significance 0.01 for all (Sidak)\n"
    "\n"
    "What fails comes with a query that shows it, its answer, and what that was compared with (beside). One that\n"
    "fails in normals alone is unbiased, but another one: --ndf says what is meant, so the result is not good, and\n"
    "says which roughness fits. Told is as well the scatter of 64 x 64 stratified samples over the bins as a part\n",
    "of that of random ones (1: they are worth no more); with --ndf the total variation and the efficiency\n"
    "1/integral Dv^2/p. Exit status 1: it fails, in what the last lines name, or it cannot be told; 2: COMMAND cannot\n"
    "be judged.\n"
    "\n"
    "  --ndf FILE       the distribution that is meant: a table, ggx or beckmann\n"
    "    --alpha A[,B]  its roughness along x and y (default 1)\n"
    "  --samples N      of each direction (default 100000); four times as many notice an error half as large\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "  --timeout S      COMMAND and its children are ended when it writes nothing for so many seconds (default 60)\n"
    "\n"
    "example: cc -O2 tools/judge/examples/ggx_caps.c -lm -o ggx_caps\n"
    "         vndf judge './ggx_caps 0.3 0.1' --ndf ggx --alpha 0.3,0.1\n"
    "         vndf judge 'python3 tools/judge/examples/ggx_caps.py 0.3 0.1' --samples 20000\n",
    NULL};

/* In the order of judge_id. A table of two moments, 1.3e-2 away from its visible normals, has the normals that are
 * meant. The last is Sidak's level of each test. */
static const char *const names[JUDGE_NUMBERS] = {"unit", "facing", "valid",   "moves",     "agrees",
                                                 "mass", "covers", "normals", "chi-square"};
static double limits[JUDGE_NUMBERS] = {1e-4, 1e-5, 0, 0.5, 1e-3, 1e-3, 1e-3, 2e-2};

/* What the quadrature may err, and leave out. */
static const double MASS_ERROR = 6e-3, LEFT_OUT = 0.2;

static void print_views(figures *f, const judgement *j, int has_truth)
{
    figures_list(f, "directions");
    for (const judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        figures_record(f);
        figures_number(f, "theta", "%.5g", v->theta, "degrees");
        figures_number(f, "phi", "%.5g", v->phi, "degrees");
        figures_number(f, "mass", "%.7g", v->total, "");
        figures_number(f, "mass_error", "%.2g", v->error, "");
        figures_number(f, "bins", "%.9g", (double)v->bins.classes, "");
        figures_number(f, "statistic", "%.6g", v->bins.statistic, "");
        figures_number(f, "p", "%.4g", v->bins.p, "");
        figures_number(f, "left_out", "%.3g", v->left_out, "of the mass");
        figures_number(f, "scatter", "%.3g", v->scatter, "of random samples");
        if (has_truth) {
            figures_number(f, "tv", "%.3g", v->tv, "of the mass");
            figures_number(f, "efficiency", "%.4g", v->efficiency, "ratio");
        }
    }
    figures_list_end(f);
}

/* Of each direction whose samples do not follow the density, the block that is farthest off; azimuths are those of the
 * surface. */
static void print_blocks(figures *f, const judgement *j)
{
    const double degrees = 180 / acos(-1), level = limits[JUDGE_CHI_SQUARE];
    figures_list(f, "farthest off");
    for (const judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        const judge_block *b = &v->block;
        if (fmin(v->bins.p, b->p) >= level)
            continue;
        figures_record(f);
        figures_number(f, "theta_of_wi", "%.5g", v->theta, "degrees");
        figures_number(f, "theta_from", "%.4g", v->ring[b->ring[0]] * degrees, "degrees");
        figures_number(f, "theta_to", "%.4g", v->ring[b->ring[1]] * degrees, "degrees");
        figures_number(f, "phi_from", "%.4g", (v->turn + v->sector[b->sector[0]]) * degrees, "degrees");
        figures_number(f, "phi_to", "%.4g", (v->turn + v->sector[b->sector[1]]) * degrees, "degrees");
        figures_number(f, "expected", "%.4g", b->expected, "samples");
        figures_number(f, "observed", "%.4g", b->observed, "samples");
        figures_number(f, "p", "%.3g", b->p, "");
    }
    figures_list_end(f);
}

/* Why it cannot be told, into text; 0 if it can. */
static int is_unsure(int id, const judgement *j, char text[LISTED_LENGTH])
{
    double worst = id == JUDGE_MASS ? MASS_ERROR : LEFT_OUT;
    *text = '\0';
    for (const judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        const double of = id == JUDGE_MASS ? v->error : id == JUDGE_CHI_SQUARE ? v->left_out : 0;
        if (of <= worst || !v->is_first)
            continue;
        worst = of;
        snprintf(text, LISTED_LENGTH, "cannot tell: at %.5g degrees the quadrature %s %.2g of the mass", v->theta,
                 id == JUDGE_MASS ? "may err by" : "leaves out", of);
    }
    return *text != '\0';
}

static void print_shown(figures *f, const judge_fault *fault)
{
    const answer *a = &fault->shown.got;
    char text[JUDGE_LINE];
    process_line(text, &fault->shown.asked, NULL);
    figures_text(f, "query", text);
    if (fault->shown.asked.kind == 's')
        snprintf(text, sizeof text, "%.9g %.9g %.9g %.9g", a->x, a->y, a->z, a->pdf);
    else
        snprintf(text, sizeof text, "%.9g", a->pdf);
    figures_text(f, "answer", text);
    if (fault->beside > 0)
        figures_number(f, "beside", "%.6g", fault->beside, "");
}

static void print_result(figures *f, const judgement *j, const char *failed, const char *unsure, int has_truth)
{
    const double *a = j->fits;
    char alpha[64], result[LISTED_LENGTH] = "good";
    snprintf(alpha, sizeof alpha, fabs(a[0] / a[1] - 1) < 0.01 ? "%.3g" : "%.3g,%.3g", a[0], a[1]);
    if (has_truth) {
        figures_text(f, "nearest_alpha", alpha);
        figures_number(f, "nearest_tv", "%.3g", j->fits_tv, "of the mass");
    }
    if (*failed)
        figures_text(f, "fails", failed);
    if (*unsure)
        figures_text(f, "cannot_tell", unsure);
    if (*failed && strcmp(failed, names[JUDGE_NORMALS]) != 0)
        strcpy(result, "FAILED");
    else if (*unsure)
        strcpy(result, "CANNOT TELL");
    else if (*failed && j->fits_tv <= limits[JUDGE_NORMALS])
        snprintf(result, sizeof result, "unbiased, but not these normals: alpha %s fits", alpha);
    else if (*failed)
        snprintf(result, sizeof result, "unbiased, but not these normals, nor of another alpha");
    figures_text(f, "result", result);
}

static int print_verdict(const arguments *given, const judge_task *task, const judgement *j)
{
    const int has_truth = task->surface.distribution != NULL;
    char failed[LISTED_LENGTH] = "", unsure[LISTED_LENGTH] = "", why[LISTED_LENGTH];
    figures f = figures_begin(given);
    limits[JUDGE_CHI_SQUARE] = statistics_sidak(0.01, JUDGE_TESTS);
    figures_text(&f, "command", task->command);
    figures_number(&f, "samples", "%.9g", (double)task->samples, "of each direction");
    print_views(&f, j, has_truth);
    print_blocks(&f, j);
    figures_list(&f, "verdict");
    for (int id = 0; id < JUDGE_NUMBERS; id++) {
        const judge_fault *fault = &j->fault[id];
        const int is_p = id == JUDGE_CHI_SQUARE, is_told = !is_unsure(id, j, why);
        const int fails = is_p ? fault->worst < limits[id] : fault->worst > limits[id];
        if ((id == JUDGE_COVERS || id == JUDGE_NORMALS) && !has_truth)
            continue;
        figures_record(&f);
        figures_text(&f, "of", names[id]);
        figures_number(&f, is_p ? "least p" : "worst", "%.3g", fault->worst, "");
        figures_number(&f, "limit", "%.3g", limits[id], "");
        figures_truth(&f, "good", !fails && is_told);
        if (!is_told)
            figures_text(&f, "why", why);
        if (fails)
            print_shown(&f, fault);
        char *list = fails ? failed : unsure;
        if (fails || !is_told)
            snprintf(list + strlen(list), LISTED_LENGTH - strlen(list), "%s%s", *list ? ", " : "", names[id]);
    }
    figures_list_end(&f);
    print_result(&f, j, failed, unsure, has_truth);
    const int status = figures_end(&f);
    return (*failed || *unsure) && status == STATUS_GOOD ? STATUS_NO : status;
}

static int run(const arguments *given)
{
    const char *ndf = option_value(given, "--ndf");
    unsigned long long samples = 100000, seed = 1;
    double timeout = 60;
    chosen_distribution chosen = {NULL, NULL, NULL};
    vndf_surface surface;
    if (!option_count(given, "--samples", 1000, 1e6, &samples) ||
        !option_count(given, "--seed", 0, 0x1p53, &seed) ||
        !option_number(given, "--timeout", 0.1, 1e6, &timeout) ||
        !roughness_from(name, option_value(given, "--alpha"), &surface) ||
        (ndf && !distribution_open(&chosen, name, ndf, 0)))
        return STATUS_USE;
    surface.distribution = chosen.distribution;
    const judge_task task = {name, given->positional.item[0], timeout, (size_t)samples, seed, surface};
    judgement *j = calloc(1, sizeof *j);
    progress bar = progress_begin(name, option_value(given, "-q") != NULL);
    const int is_judged = j ? judge_sampler(&task, &bar, j) : denied(name, "no memory");
    progress_end(&bar);
    const int status = is_judged ? print_verdict(given, &task, j) : STATUS_USE;
    free(j);
    distribution_close(&chosen);
    return status;
}

const subcommand command_judge = {name, "judge anyone's sampler; exit 1 if it fails", "COMMAND", 1, 1, run, help};
