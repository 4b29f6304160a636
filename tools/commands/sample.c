/* vndf sample: visible normals into a file, in a format that outsiders read:
 *   .csv  header `wm.x,wm.y,wm.z,pdf`, one normal a line, 9 significant digits (they give the float back);
 *   .f32  wm.x wm.y wm.z pdf as little-endian 32-bit floats, nothing else. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/subject.h"
#include "cli/output.h"
#include "cli/random.h"

static const char name[] = "vndf sample";

static const char help[] =
    "usage: vndf sample FILE|ggx|beckmann --theta DEG [--phi DEG] [--alpha AX[,AY]] -n N -o OUT [options]\n"
    "\n"
    "Draws visible normals from one incident direction, each with its density per steradian.\n"
    "\n"
    "  --theta DEG      angle of the incident direction from the normal, 0 to 180; above 90 is below the surface\n"
    "  --phi DEG        its azimuth from the x axis, -360 to 360 (default 0)\n"
    "  --alpha AX[,AY]  roughness along x and y (default 1: the distribution as the builder received it)\n"
    "  -n N             the number of samples\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "  -o OUT           OUT.csv: a header wm.x,wm.y,wm.z,pdf, then lines; OUT.f32: little-endian floats\n"
    "                   wm.x wm.y wm.z pdf; -: stdout\n"
    "  --format NAME    csv or f32, whatever OUT ends in (default, for -: csv)\n"
    "\n"
    "example: vndf sample wavy.vndf --theta 60 --phi 30 --alpha 0.1,0.3 -n 1000000 -o normals.f32\n";

typedef struct sample_words {
    aim_words aim;
    words number, seed, format, output;
} sample_words;

typedef void write_normal(FILE *file, vndf_vec3 wm, float pdf);

static void write_csv(FILE *file, vndf_vec3 wm, float pdf)
{
    fprintf(file, "%.9g,%.9g,%.9g,%.9g\n", (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf);
}

static void write_f32(FILE *file, vndf_vec3 wm, float pdf)
{
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

static write_normal *writer_for(const char *path, const char *format)
{
    static const char *const forms[2] = {"csv", "f32"};
    int form = output_form(name, path, format, forms);
    return form < 0 ? NULL : form == 0 ? write_csv : write_f32;
}

/* Stops early where going on is useless: the user interrupted, or the disk is full. */
static int write_samples(output_file *output, write_normal *write, const vndf_view *view, unsigned long long count,
                         uint64_t seed)
{
    random_stream stream = random_from(seed);
    if (write == write_csv)
        fputs("wm.x,wm.y,wm.z,pdf\n", output->file);
    for (unsigned long long i = 0; i < count; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_sample(view, u1, u2, &pdf);
        write(output->file, wm, pdf);
        if (i % 4096 != 0)
            continue;
        if (ferror(output->file))
            break;
        if (output_interrupted(output))
            return output_give_up(output, "interrupted");
    }
    return output_commit(output);
}

static int sample_to_file(const sample_words *given, const vndf_distribution *distribution)
{
    vndf_surface surface;
    vndf_vec3 wi;
    output_file output;
    unsigned long long count = 0, seed = 1;
    const char *path = only_word(&given->output);
    write_normal *write = writer_for(path, only_word(&given->format));
    if (!write || !view_from_words(name, &given->aim, distribution, &surface, &wi) ||
        !option_count(name, "-n", &given->number, 1, 1e12, &count) ||
        !option_count(name, "--seed", &given->seed, 0, 0x1p53, &seed) || !output_open(&output, name, path))
        return STATUS_USE;
    vndf_view view = vndf_view_from(&surface, wi);
    return write_samples(&output, write, &view, count, seed);
}

int command_sample(int argc, char **argv)
{
    sample_words given = {0};
    words positional = {{NULL}, 0};
    chosen_distribution chosen;
    const option_form options[] = {
        {"--theta", 1, 1, &given.aim.theta}, {"--phi", 1, 1, &given.aim.phi}, {"--alpha", 1, 1, &given.aim.alpha},
        {"-n", 1, 1, &given.number},         {"--seed", 1, 1, &given.seed},   {"-o", 1, 1, &given.output},
        {"--format", 1, 1, &given.format},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "FILE|ggx|beckmann", 1, 1};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (!given.number.count || !given.output.count)
        return complain(name, "%s is missing", given.number.count ? "-o OUT" : "-n N");
    if (!distribution_open(&chosen, name, only_word(&positional)))
        return STATUS_USE;
    int status = sample_to_file(&given, chosen.distribution);
    distribution_close(&chosen);
    return status;
}
