/* vndf sample: visible normals into a file, in a format that outsiders read. */
#include <string.h>

#include "cli/files.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/random.h"
#include "cli/subject.h"
#include "command.h"

#define POSITIONAL "FILE|ggx|beckmann|FILE.vndfs@P"

static const char name[] = "vndf sample";

static const char *const help[] = {
    "usage: vndf sample " POSITIONAL " --theta DEG -n N -o OUT [options]\n"
    "\n"
    "Draws visible normals from one incident direction, each with its density per steradian. FILE is a table (vndf\n"
    "build), - for stdin; FILE.vndfs@P is a family of tables (vndf build --parameter) at the parameter P, as in\n"
    "tails.vndfs@2.7.\n"
    "\n"
    "  --theta DEG      angle of the incident direction from the normal, 0 to 180; above 90 is below the surface\n"
    "  --phi DEG        its azimuth from the x axis, -360 to 360 (default 0)\n"
    "  --alpha AX[,AY]  roughness along x and y (default 1: the distribution as the builder received it), or\n"
    "  --matrix XX,XY,YX,YY  the linear map of its slopes, s = M u + mean, not singular\n"
    "  --mean X,Y       its mean slope (default 0,0)\n"
    "  -n N             the number of samples\n"
    "  --seed S         the stream of random numbers, a whole number (default 1)\n"
    "  -o OUT           OUT.csv: a header wm.x,wm.y,wm.z,pdf, then lines of 9 digits, which give the float back;\n"
    "                   OUT.f32: little-endian floats wm.x wm.y wm.z pdf; -: the CSV on stdout\n"
    "\n"
    "example: vndf sample wavy.vndf --theta 60 --phi 30 --alpha 0.1,0.3 -n 1000000 -o normals.f32\n"
    "         vndf sample ggx --theta 60 --matrix 0.5,0.2,-0.1,0.4 --mean 0.05,0 -n 1000 -o -\n",
    NULL};

/* --alpha or --matrix, and --mean, of ggx. 1, or 0 after a complaint. */
static int read_map(const arguments *given, vndf_surface *map)
{
    const char *alpha = option_value(given, "--alpha"), *matrix = option_value(given, "--matrix");
    const char *mean = option_value(given, "--mean");
    double m[4] = {1, 0, 0, 1}, shift[2] = {0, 0};
    if (alpha && matrix)
        return denied(name, "--alpha and --matrix are given; one of them is possible");
    if (!roughness_from(name, alpha, map) ||
        (matrix && !parse_numbers(name, "--matrix", matrix, -1e18, 1e18, 4, 4, m)) ||
        (mean && !parse_numbers(name, "--mean", mean, -1e6, 1e6, 2, 2, shift)))
        return 0;
    map->distribution = vndf_ggx();
    if (matrix)
        map->xx = (float)m[0], map->xy = (float)m[1], map->yx = (float)m[2], map->yy = (float)m[3];
    map->mean_x = (float)shift[0];
    map->mean_y = (float)shift[1];
    const vndf_mixture alone = {1, {{*map, 1}}}; /* which has no view if it is singular */
    if (vndf_mixture_view_from(&alone, (vndf_vec3){0, 0, 1}).count != 1)
        return denied(name, "--matrix '%s' is singular, or its scale is not from 1e-18 to 1e18",
                      matrix ? matrix : "");
    return 1;
}

/* One distribution, or the two neighbours of a family's parameter. Close what it is of. 1, or 0 after a complaint. */
static int read_surface(const arguments *given, vndf_mixture *surface, chosen_distribution *of)
{
    const char *word = given->positional.item[0], *at = strstr(word, ".vndfs@");
    char path[4096];
    double p;
    vndf_surface map;
    if (is_family_file(word))
        return denied(name, "'%s' is a family; say at which parameter, as in %s@2.5", word, word);
    snprintf(path, sizeof path, "%.*s", at ? (int)(at - word) + 6 : (int)strlen(word), word);
    if (!read_map(given, &map) || !distribution_open(of, name, path, at != NULL))
        return 0;
    map.distribution = of->distribution;
    *surface = (vndf_mixture){1, {{map, 1}}};
    if (!at)
        return 1;
    if (!parse_numbers(name, "the parameter", at + 7, -1e30, 1e30, 1, 1, &p))
        return 0;
    vndf_family_facts facts = vndf_family_info(of->family);
    if (!((float)p >= facts.low && (float)p <= facts.high))
        return denied(name, "the parameter '%s' is not in the range of the family, from %.7g to %.7g", at + 7,
                      (double)facts.low, (double)facts.high);
    vndf_family_at(of->family, (float)p, &map, surface);
    return 1;
}

/* Stops early where going on is useless: the user interrupted, or the disk is full. */
static int write_samples(const vndf_mixture_view *view, unsigned long long count, uint64_t seed, int is_csv,
                         int is_quiet, output_file *output)
{
    random_stream stream = random_from(seed);
    progress p = progress_begin("sampling", is_quiet || !output->path); /* lines on the terminal show it, too */
    int stops = 0;
    p.tells_left = 1;
    fputs(is_csv ? "wm.x,wm.y,wm.z,pdf\n" : "", output->file);
    for (unsigned long long i = 0; i < count && !ferror(output->file) && !stops; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_mixture_sample(view, u1, u2, &pdf, NULL);
        if (is_csv)
            fprintf(output->file, "%.9g,%.9g,%.9g,%.9g\n", (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf);
        else
            put_floats(output->file, (const float[4]){wm.x, wm.y, wm.z, pdf}, 4);
        stops = i % 4096 == 0 && progress_show((double)i / (double)count, NULL, &p) && output->path;
    }
    progress_end(&p);
    return stops ? output_give_up(output, "interrupted") : output_commit(output);
}

static int run(const arguments *given)
{
    static const char *const needed[][2] = {{"--theta", " DEG"}, {"-n", " N"}, {"-o", " OUT"}};
    static const char *const forms[] = {"csv", "f32", NULL};
    const char *path = option_value(given, "-o");
    output_file output;
    chosen_distribution of = {NULL, NULL, NULL};
    vndf_mixture surface;
    unsigned long long count = 0, seed = 1;
    double theta = 0, phi = 0;
    for (int i = 0; i < 3; i++)
        if (!option_value(given, needed[i][0]))
            return complain(name, "%s%s is missing; `%s --help` has an example", needed[i][0], needed[i][1], name);
    const int form = output_form(name, path, forms);
    int status = STATUS_USE;
    if (form >= 0 && option_count(given, "-n", 1, 1e12, &count) &&
        option_count(given, "--seed", 0, 0x1p53, &seed) && option_number(given, "--theta", 0, 180, &theta) &&
        option_number(given, "--phi", -360, 360, &phi) && read_surface(given, &surface, &of) &&
        output_open(&output, name, path)) {
        const vndf_mixture_view view = vndf_mixture_view_from(&surface, direction_from(theta, phi));
        status = write_samples(&view, count, seed, form == 0, option_value(given, "-q") != NULL, &output);
    }
    distribution_close(&of);
    return status;
}

const subcommand command_sample = {
    name, "draw visible normals into a CSV or a file of floats", POSITIONAL, 1, 1, run, help};
