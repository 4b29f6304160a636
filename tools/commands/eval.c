/* vndf eval: a filter. A normal wm.x,wm.y,wm.z per line of stdin gives ndf,pdf,lambda,g1 on stdout. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/figures.h"
#include "cli/files.h"
#include "cli/subject.h"
#include "command.h"

static const char name[] = "vndf eval";

static const char *const help[] = {
    "usage: vndf eval " SURFACE_POSITIONAL " --theta DEG [options]\n"
    "\n"
    "Reads one normal a line from stdin, wm.x,wm.y,wm.z (unit within 1e-3; no header), and prints a line for each:\n"
    "\n"
    "  ndf,pdf,lambda,g1\n"
    "\n"
    "  ndf     D(wm) per steradian\n"
    "  pdf     density per steradian with which `vndf sample` draws wm from this incident direction\n"
    "  lambda  Smith's Lambda of the incident direction\n"
    "  g1      Smith's masking of the incident direction, 1/(1 + lambda); 0 below the horizon\n"
    "\n" SURFACE_HELP "\n"
    "example: echo 0.6,0,0.8 | vndf eval ggx --theta 45 --alpha 0.5\n"
    "         echo 0.6,0,0.8 | vndf eval beckmann --theta 45 --matrix 0.5,0.2,-0.1,0.4 --json\n",
    NULL};

enum { LINE_MAX_LENGTH = 256 };

/* A line of stdin, `number` of them counted from 1: normalised, so that nine digits of a text file are as good as the
 * float. 1, or 0 after a complaint. */
static int read_normal(char *line, unsigned long long number, vndf_vec3 *wm)
{
    char where[48];
    double v[3];
    size_t end = strcspn(line, "\r\n");
    if (end == LINE_MAX_LENGTH - 1)
        return complain(name, "stdin, line %llu: longer than %d characters", number, LINE_MAX_LENGTH - 2), 0;
    line[end] = '\0';
    snprintf(where, sizeof where, "stdin, line %llu:", number);
    if (!parse_numbers(name, where, line, -2, 2, 3, 3, v))
        return complain(name, "a line has to be wm.x,wm.y,wm.z, a unit vector"), 0;
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (fabs(length - 1) > 1e-3)
        return complain(name, "%s '%s' has length %.6g; a normal has length 1 within 1e-3", where, line, length),
               0;
    *wm = (vndf_vec3){(float)(v[0] / length), (float)(v[1] / length), (float)(v[2] / length)};
    return 1;
}

/* What is no family gives the bits of its distribution alone. */
static double ndf_of(const vndf_mixture *m, vndf_vec3 wm)
{
    return (double)(m->count == 1 ? vndf_affine_ndf(&m->lobe[0].surface, wm) : vndf_mixture_ndf(m, wm));
}

static int evaluate_lines(const chosen_surface *surface, figures *f)
{
    char line[LINE_MAX_LENGTH];
    const vndf_mixture *m = &surface->mixture;
    const vndf_affine *alone = m->count == 1 ? &m->lobe[0].surface : NULL;
    vndf_mixture_view view = vndf_mixture_view_from(m, surface->wi);
    double lambda = (double)(alone ? vndf_affine_lambda(alone, surface->wi) : vndf_mixture_lambda(m, surface->wi));
    double g1 = (double)(alone ? vndf_affine_g1(alone, surface->wi) : vndf_mixture_g1(m, surface->wi));
    for (unsigned long long number = 1; fgets(line, sizeof line, stdin); number++) {
        vndf_vec3 wm;
        if (!read_normal(line, number, &wm))
            return STATUS_USE;
        double ndf = ndf_of(m, wm), pdf = (double)vndf_mixture_pdf(&view, wm);
        if (f->form == FIGURES_TEXT)
            printf("%.9g,%.9g,%.9g,%.9g\n", ndf, pdf, lambda, g1);
        else {
            figures_record(f);
            figures_number(f, "ndf", 9, ndf, "per steradian");
            figures_number(f, "pdf", 9, pdf, "per steradian");
            figures_number(f, "lambda", 9, lambda, "ratio");
            figures_number(f, "g1", 9, g1, "ratio");
        }
        if (ferror(stdout))
            return STATUS_USE; /* main says why */
    }
    if (ferror(stdin))
        return complain(name, "cannot read stdin: %s", strerror(errno));
    return STATUS_GOOD;
}

static int run(const arguments *given)
{
    chosen_surface surface;
    if (!surface_open(&surface, given))
        return STATUS_USE;
    int status = STATUS_USE;
    if (input_stdin(name)) {
        figures f = figures_begin(given);
        figures_list(&f, "values");
        status = evaluate_lines(&surface, &f);
        figures_list_end(&f);
        figures_end(&f);
    }
    distribution_close(&surface.of);
    return status;
}

const subcommand command_eval = {
    name, "ndf, pdf, lambda, g1 for normals read from stdin", SURFACE_POSITIONAL, 1, 1, run, help};
