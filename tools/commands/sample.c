/* vndf sample draws visible normals into a file, vndf eval says what normals are worth that it reads from stdin. */
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cli/figures.h"
#include "cli/files.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/random.h"
#include "cli/subject.h"
#include "command.h"

/* ---- sample -------------------------------------------------------------------------------------- */

static const char *const sample_help[] = {
    "usage: vndf sample " SURFACE_POSITIONAL " --theta DEG -n N -o OUT [options]\n"
    "\n"
    "Draws visible normals from one incident direction, each with its density per steradian.\n" SURFACE_HELP
    "  -n N             the number of samples\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "  -o OUT           OUT.csv: a header wm.x,wm.y,wm.z,pdf, then lines of 9 digits, which give the float back;\n"
    "                   OUT.f32: little-endian floats wm.x wm.y wm.z pdf; -: the CSV on stdout\n"
    "\n"
    "example: vndf sample wavy.vndf --theta 60 --phi 30 --alpha 0.1,0.3 -n 1000000 -o normals.f32\n"
    "         vndf sample ggx --theta 60 --matrix 0.5,0.2,-0.1,0.4 --mean 0.05,0 -n 1000 -o -\n",
    NULL};

static void write_f32(FILE *file, const float values[4])
{
    for (size_t i = 0; i < 16; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i / 4], sizeof bits);
        fputc((int)(bits >> 8 * (i % 4) & 255u), file);
    }
}

/* Stops early where going on is useless: the user interrupted, or the disk is full. */
static int write_samples(const arguments *given, const chosen_surface *surface, unsigned long long count,
                         uint64_t seed, int is_csv, output_file *output)
{
    random_stream stream = random_from(seed);
    vndf_mixture_view view = vndf_mixture_view_from(&surface->mixture, surface->wi);
    progress p = progress_begin("sampling", option_value(given, "-q") || !output->path); /* lines show it, too */
    int stops = 0;
    p.tells_left = 1;
    fputs(is_csv ? "wm.x,wm.y,wm.z,pdf\n" : "", output->file);
    for (unsigned long long i = 0; i < count && !ferror(output->file) && !stops; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_mixture_sample(&view, u1, u2, &pdf, NULL);
        if (is_csv)
            fprintf(output->file, "%.9g,%.9g,%.9g,%.9g\n", (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf);
        else
            write_f32(output->file, (const float[4]){wm.x, wm.y, wm.z, pdf});
        stops = i % 4096 == 0 && progress_tell((double)i / (double)count, &p) && output->path;
    }
    progress_end(&p);
    return stops ? output_give_up(output, "interrupted") : output_commit(output);
}

static int run_sample(const arguments *given)
{
    static const char *const forms[] = {"csv", "f32", NULL};
    const char *command = given->command, *path = option_value(given, "-o");
    output_file output;
    chosen_surface surface;
    unsigned long long count = 0, seed = 1;
    if (!option_value(given, "-n") || !path)
        return complain(command, "%s is missing; `%s --help` has an example", path ? "-n N" : "-o OUT", command);
    const int form = output_form(command, path, forms);
    if (form < 0 || !option_count(given, "-n", 1, 1e12, &count) ||
        !option_count(given, "--seed", 0, 0x1p53, &seed) || !surface_open(&surface, given))
        return STATUS_USE;
    int status = output_open(&output, command, path)
                     ? write_samples(given, &surface, count, seed, form == 0, &output)
                     : STATUS_USE;
    distribution_close(&surface.of);
    return status;
}

const subcommand command_sample = {
    "vndf sample", "draw visible normals into a CSV or a file of floats", SURFACE_POSITIONAL, 1, 1, run_sample,
    sample_help};

/* ---- eval ---------------------------------------------------------------------------------------- */

static const char *const eval_help[] = {
    "usage: vndf eval " SURFACE_POSITIONAL " --theta DEG [options]\n"
    "\n"
    "Reads one normal a line from stdin, wm.x,wm.y,wm.z (unit within 1e-3; no header), and prints for each a line\n"
    "ndf,pdf,lambda,g1: D(wm) per steradian; the density per steradian with which `vndf sample` draws wm from this\n"
    "incident direction; Smith's Lambda of the direction; and its masking, 1/(1 + lambda), 0 below the horizon.\n"
    "\n" SURFACE_HELP "\n"
    "example: echo 0.6,0,0.8 | vndf eval ggx --theta 45 --alpha 0.5\n"
    "         echo 0.6,0,0.8 | vndf eval beckmann --theta 45 --matrix 0.5,0.2,-0.1,0.4 --json\n",
    NULL};

/* Line `number` of stdin, counted from 1: normalised, so that nine digits of a text file are as good as the float. 1,
 * or 0 after a complaint. */
static int read_normal(const char *command, char *line, unsigned long long number, vndf_vec3 *wm)
{
    char where[48];
    double v[3];
    line[strcspn(line, "\r\n")] = '\0';
    snprintf(where, sizeof where, "stdin, line %llu:", number);
    if (!parse_numbers(command, where, line, -2, 2, 3, 3, v))
        return complain(command, "a line has to be wm.x,wm.y,wm.z, a unit vector"), 0;
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (fabs(length - 1) > 1e-3)
        return complain(command, "%s '%s' has length %.6g; it has to be 1 within 1e-3", where, line, length), 0;
    *wm = (vndf_vec3){(float)(v[0] / length), (float)(v[1] / length), (float)(v[2] / length)};
    return 1;
}

static int evaluate_lines(const char *command, const chosen_surface *surface, figures *f)
{
    static const char *const names[4] = {"ndf", "pdf", "lambda", "g1"};
    char line[256];
    const vndf_mixture *m = &surface->mixture;
    const vndf_mixture_view view = vndf_mixture_view_from(m, surface->wi);
    double value[4] = {0, 0, (double)vndf_mixture_lambda(m, surface->wi), (double)vndf_mixture_g1(m, surface->wi)};
    for (unsigned long long number = 1; fgets(line, sizeof line, stdin); number++) {
        vndf_vec3 wm;
        if (!read_normal(command, line, number, &wm))
            return STATUS_USE;
        value[0] = (double)vndf_mixture_ndf(m, wm);
        value[1] = (double)vndf_mixture_pdf(&view, wm);
        if (f->form == FIGURES_TEXT)
            printf("%.9g,%.9g,%.9g,%.9g\n", value[0], value[1], value[2], value[3]);
        else
            figures_record(f);
        for (int i = 0; i < 4 && f->form != FIGURES_TEXT; i++)
            figures_number(f, names[i], 9, value[i], i < 2 ? "per steradian" : "ratio");
        if (ferror(stdout))
            return STATUS_USE; /* main says why */
    }
    return ferror(stdin) ? complain(command, "cannot read stdin: %s", strerror(errno)) : STATUS_GOOD;
}

static int run_eval(const arguments *given)
{
    chosen_surface surface;
    if (!surface_open(&surface, given))
        return STATUS_USE;
    int status = STATUS_USE;
    if (input_stdin(given->command)) {
        figures f = figures_begin(given);
        figures_list(&f, "values");
        status = evaluate_lines(given->command, &surface, &f);
        figures_list_end(&f);
        figures_end(&f);
    }
    distribution_close(&surface.of);
    return status;
}

const subcommand command_eval = {
    "vndf eval", "ndf, pdf, lambda, g1 for normals read from stdin", SURFACE_POSITIONAL, 1, 1, run_eval,
    eval_help};
