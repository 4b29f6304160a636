/* vndf sample: visible normals into a file, in a format that outsiders read:
 *   .csv  header `wm.x,wm.y,wm.z,pdf`, one normal a line, 9 significant digits (they give the float back); where
 *         there are several --lobe, `lobe` is one more column: which of them was drawn, counted from 0;
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
    "usage: vndf sample " SURFACE_POSITIONAL " --theta DEG [--phi DEG] [--alpha AX[,AY]]\n"
    "                   -n N -o OUT [options]\n"
    "       vndf sample --lobe 'KEY=VALUE ...' [--lobe ...] --theta DEG [--phi DEG] -n N -o OUT [options]\n"
    "\n"
    "Draws visible normals from one incident direction, each with its density per steradian.\n"
    "\n" AIM_HELP "  -n N             the number of samples\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "  -o OUT           OUT.csv: a header wm.x,wm.y,wm.z,pdf, then lines; OUT.f32: little-endian floats\n"
    "                   wm.x wm.y wm.z pdf; -: stdout\n"
    "  --format csv|f32  whatever OUT ends in (default, for -: csv)\n"
    "  -q               prints no progress\n"
    "\n" SURFACE_HELP "\n"
    "Then pdf is the density of the whole surface, and a CSV has one more column, lobe: which --lobe the normal was\n"
    "drawn from, counted from 0 (not where there is but one).\n"
    "\n"
    "example: vndf sample wavy.vndf --theta 60 --phi 30 --alpha 0.1,0.3 -n 1000000 -o normals.f32\n"
    "         vndf sample --theta 60 -n 1000 -o - --lobe 'weight=0.7 table=wavy.vndf alpha=0.1,0.3 mean=0.05,0' \\\n"
    "                                             --lobe 'weight=0.3 table=ggx matrix=0.5,0.2,-0.1,0.4'\n",
    NULL};

typedef void write_normal(FILE *file, vndf_vec3 wm, float pdf, int lobe);

static void write_csv(FILE *file, vndf_vec3 wm, float pdf, int lobe)
{
    (void)lobe;
    fprintf(file, "%.9g,%.9g,%.9g,%.9g\n", (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf);
}

static void write_csv_with_lobe(FILE *file, vndf_vec3 wm, float pdf, int lobe)
{
    fprintf(file, "%.9g,%.9g,%.9g,%.9g,%d\n", (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf, lobe);
}

static void write_f32(FILE *file, vndf_vec3 wm, float pdf, int lobe)
{
    (void)lobe;
    const float values[4] = {wm.x, wm.y, wm.z, pdf};
    unsigned char bytes[16];
    for (size_t i = 0; i < 4; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (size_t k = 0; k < 4; k++)
            bytes[4 * i + k] = (unsigned char)(bits >> (8 * k) & 0xFFu);
    }
    fwrite(bytes, 1, sizeof bytes, file);
}

static write_normal *writer_for(const char *path, const char *format, size_t lobes)
{
    static const char *const forms[] = {"csv", "f32", NULL};
    int form = output_form(name, path, format, forms);
    return form < 0 ? NULL : form == 1 ? write_f32 : lobes > 1 ? write_csv_with_lobe : write_csv;
}

static void write_header(FILE *file, write_normal *write)
{
    if (write != write_f32)
        fprintf(file, "wm.x,wm.y,wm.z,pdf%s\n", write == write_csv_with_lobe ? ",lobe" : "");
}

/* Stops early where going on is useless: the user interrupted, or the disk is full. */
static int write_samples(output_file *output, write_normal *write, const chosen_surface *surface,
                         unsigned long long count, uint64_t seed, int is_quiet)
{
    random_stream stream = random_from(seed);
    vndf_mixture_view view = vndf_mixture_view_from(&surface->mixture, surface->wi);
    progress p = progress_begin("sampling", output->held);
    p.tells_left = 1;
    p.is_seen &= output->path && !is_quiet; /* lines on the terminal are progress enough */
    write_header(output->file, write);
    for (unsigned long long i = 0; i < count && !ferror(output->file); i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        int lobe;
        vndf_vec3 wm = vndf_mixture_sample(&view, u1, u2, &pdf, &lobe);
        write(output->file, wm, pdf, lobe < 0 ? 0 : surface->option[lobe]); /* -1: nothing is drawn */
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
    output_file output;
    chosen_surface surface;
    unsigned long long count = 0, seed = 1;
    const char *path = option_value(given, "-o");
    if (!option_value(given, "-n") || !path)
        return complain(name, "%s is missing", path ? "-n N" : "-o OUT");
    if (!surface_open(&surface, given))
        return STATUS_USE;
    int status = STATUS_USE;
    write_normal *write = writer_for(path, option_value(given, "--format"), option_values(given, "--lobe").count);
    if (write && option_count(given, "-n", 1, 1e12, &count) && option_count(given, "--seed", 0, 0x1p53, &seed) &&
        output_open(&output, name, path))
        status = write_samples(&output, write, &surface, count, seed, option_value(given, "-q") != NULL);
    surface_close(&surface);
    return status;
}

const subcommand command_sample = {
    name, "draw visible normals into a CSV or a file of floats", SURFACE_POSITIONAL, 0, 1, run, help};
