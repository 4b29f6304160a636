/* vndf sample: visible normals into a file, in a format that outsiders read. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/random.h"
#include "cli/subject.h"
#include "command.h"

static const char name[] = "vndf sample";

static const char *const help[] = {
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

static int run(const arguments *given)
{
    static const char *const forms[] = {"csv", "f32", NULL};
    const char *path = option_value(given, "-o");
    output_file output;
    chosen_surface surface;
    unsigned long long count = 0, seed = 1;
    if (!option_value(given, "-n") || !path)
        return complain(name, "%s is missing; `%s --help` has an example", path ? "-n N" : "-o OUT", name);
    const int form = output_form(name, path, forms);
    if (form < 0 || !option_count(given, "-n", 1, 1e12, &count) ||
        !option_count(given, "--seed", 0, 0x1p53, &seed) || !surface_open(&surface, given))
        return STATUS_USE;
    int status = output_open(&output, name, path) ? write_samples(given, &surface, count, seed, form == 0, &output)
                                                  : STATUS_USE;
    distribution_close(&surface.of);
    return status;
}

const subcommand command_sample = {
    name, "draw visible normals into a CSV or a file of floats", SURFACE_POSITIONAL, 1, 1, run, help};
