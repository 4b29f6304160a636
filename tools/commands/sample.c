/* vndf sample: visible normals into a file, in a format that outsiders read:
 *   .csv  header `wm.x,wm.y,wm.z,pdf`, one normal a line, 9 significant digits (they give the float back);
 *   .f32  wm.x wm.y wm.z pdf as little-endian 32-bit floats, nothing else. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/random.h"
#include "cli/subject.h"

static const char name[] = "vndf sample";

static const char *const help[] = {
    "usage: vndf sample " SURFACE_POSITIONAL " --theta DEG -n N -o OUT [options]\n"
    "\n"
    "Draws visible normals from one incident direction, each with its density per steradian.\n" SURFACE_HELP
    "  -n N             the number of samples\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "  -o OUT           OUT.csv: a header wm.x,wm.y,wm.z,pdf, then lines; OUT.f32: little-endian floats\n"
    "                   wm.x wm.y wm.z pdf; -: the CSV on stdout\n"
    "\n"
    "example: vndf sample wavy.vndf --theta 60 --phi 30 --alpha 0.1,0.3 -n 1000000 -o normals.f32\n"
    "         vndf sample ggx --theta 60 --matrix 0.5,0.2,-0.1,0.4 --mean 0.05,0 -n 1000 -o -\n",
    NULL};

static void write_f32(FILE *file, const float values[4])
{
    unsigned char bytes[16];
    for (size_t i = 0; i < 4; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (size_t k = 0; k < 4; k++)
            bytes[4 * i + k] = (unsigned char)(bits >> (8 * k) & 0xFFu);
    }
    fwrite(bytes, 1, sizeof bytes, file);
}

/* Stops early where going on is useless: the user interrupted, or the disk is full. */
static int write_samples(output_file *output, int is_csv, const chosen_surface *surface, unsigned long long count,
                         uint64_t seed, int is_quiet)
{
    random_stream stream = random_from(seed);
    vndf_mixture_view view = vndf_mixture_view_from(&surface->mixture, surface->wi);
    progress p = progress_begin("sampling", is_quiet || !output->path); /* lines on the terminal are enough */
    p.tells_left = 1;
    fputs(is_csv ? "wm.x,wm.y,wm.z,pdf\n" : "", output->file);
    for (unsigned long long i = 0; i < count && !ferror(output->file); i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_mixture_sample(&view, u1, u2, &pdf, NULL);
        if (is_csv)
            fprintf(output->file, "%.9g,%.9g,%.9g,%.9g\n", (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf);
        else
            write_f32(output->file, (const float[4]){wm.x, wm.y, wm.z, pdf});
        if (i % 4096 == 0 && progress_tell((double)i / (double)count, &p) && output->path) {
            progress_end(&p);
            return output_give_up(output, "interrupted");
        }
    }
    progress_end(&p);
    return output_commit(output);
}

static int run(const arguments *given)
{
    static const char *const forms[] = {"csv", "f32", NULL};
    output_file output;
    chosen_surface surface;
    unsigned long long count = 0, seed = 1;
    const char *path = option_value(given, "-o");
    if (!option_value(given, "-n") || !path)
        return complain(name, "%s is missing", path ? "-n N" : "-o OUT");
    const int form = output_form(name, path, forms);
    if (form < 0 || !option_count(given, "-n", 1, 1e12, &count) ||
        !option_count(given, "--seed", 0, 0x1p53, &seed) || !surface_open(&surface, given))
        return STATUS_USE;
    int status = STATUS_USE;
    if (output_open(&output, name, path))
        status = write_samples(&output, form == 0, &surface, count, seed, option_value(given, "-q") != NULL);
    distribution_close(&surface.of);
    return status;
}

const subcommand command_sample = {
    name, "draw visible normals into a CSV or a file of floats", SURFACE_POSITIONAL, 1, 1, run, help};
