/* vndf albedo: how much single scattering keeps of the light, for one distribution. */
#include <stdio.h>

#include "cli/arguments.h"
#include "cli/figures.h"
#include "cli/files.h"
#include "cli/subject.h"
#include "command.h"
#include "draw/table.h"
#include "vndf_bsdf.h"

static const char name[] = "vndf albedo";

static const char *const help[] = {
    "usage: vndf albedo FILE|ggx|beckmann [--eta X] [--alpha LIST] [--theta LIST] [-o OUT]\n"
    "\n"
    "The directional albedo E: the part of the light that one scattering event with height-correlated Smith masking\n"
    "sends on, and its average 2 integral E mu dmu. 1 - E is what energy compensation has to give back (Kulla &\n"
    "Conty 2017, Turquin 2019). By quadrature, without noise: within 1e-3 for a mirror, 1e-2 for a dielectric whose\n"
    "index ratio is a tenth or more from 1, 7e-2 nearer to 1.\n"
    "\n"
    "  --eta X          a dielectric of this ratio of indices, 0.01 to 100 and not 1: what is reflected and\n"
    "                   transmitted together, from either side; without it a mirror, F = 1\n"
    "  --alpha LIST     roughness to print, 0 to 4, between commas (default 0.05,0.1,0.2,0.3,0.5,0.7,1)\n"
    "  --theta LIST     angles of incidence, 0 to 90 (default 0,15,30,45,60,75,80,85,88,89,90)\n" ROWS_HELP "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf albedo ggx --alpha 0.1,0.5,1\n"
    "         vndf albedo tables/hazy.vndf --eta 1.5 -o hazy_glass.csv\n",
    NULL};

enum { LIST_MAX = 16 };

typedef struct list {
    double value[LIST_MAX];
    size_t count;
} list;

/* What is printed, from one side of the surface after the other. */
typedef struct report {
    const char *subject;
    const vndf_albedo *albedo;
    double eta; /* 0: a mirror, which has one side */
    list alpha, theta;
} report;

static float at(const report *r, int side, double theta, double alpha)
{
    float cosine = direction_from(theta, 0).z;
    return vndf_albedo_directional(r->albedo, side ? -cosine : cosine, (float)alpha);
}

static void print_side(FILE *file, const report *r, int side)
{
    fprintf(file, "\nalbedo%s; theta in degrees\n%7s",
            r->eta > 0 ? side ? ", from the other side" : ", from the side of z" : "", "theta");
    for (size_t j = 0; j < r->alpha.count; j++)
        fprintf(file, "  a=%-6.4g", r->alpha.value[j]);
    fputc('\n', file);
    for (size_t i = 0; i < r->theta.count; i++) {
        fprintf(file, "%7g", r->theta.value[i]);
        for (size_t j = 0; j < r->alpha.count; j++)
            fprintf(file, " %9.5f", (double)at(r, side, r->theta.value[i], r->alpha.value[j]));
        fputc('\n', file);
    }
    fputs("average", file);
    for (size_t j = 0; j < r->alpha.count; j++)
        fprintf(file, " %9.5f", (double)vndf_albedo_average(r->albedo, (float)r->alpha.value[j], side ? -1 : 1));
    fputc('\n', file);
}

/* Of a report. */
static int print(FILE *file, const void *of, figures_form form)
{
    const report *r = of;
    const int sides = r->eta > 0 ? 2 : 1;
    text_table t = {.rows = 0};
    if (form == FIGURES_TEXT)
        fprintf(file, r->eta > 0 ? "%s, dielectric, eta %g\n" : "%s, mirror\n", r->subject, r->eta);
    for (int side = 0; side < sides && form == FIGURES_TEXT; side++)
        print_side(file, r, side);
    for (size_t i = 0; i < (size_t)sides * r->alpha.count * r->theta.count && form != FIGURES_TEXT; i++) {
        const size_t column = i / r->theta.count % r->alpha.count;
        const int side = i >= r->alpha.count * r->theta.count;
        double alpha = r->alpha.value[column], theta = r->theta.value[i % r->theta.count];
        table_row(&t);
        table_text(&t, "distribution", r->subject);
        table_number(&t, "eta", "%.9g", r->eta);
        table_number(&t, "side", "%.0f", side ? -1 : 1);
        table_number(&t, "alpha", "%.9g", alpha);
        table_number(&t, "theta", "%.9g", theta);
        table_number(&t, "albedo", "%.9g", (double)at(r, side, theta, alpha));
        table_number(&t, "average", "%.9g", (double)vndf_albedo_average(r->albedo, (float)alpha, side ? -1 : 1));
    }
    int good = table_print(file, &t, form);
    table_free(&t);
    return good;
}

static int read_list(const arguments *given, const char *what, const char *otherwise, double most, list *to)
{
    const char *text = option_value(given, what);
    to->count = parse_numbers(name, what, text ? text : otherwise, 0, most, 1, LIST_MAX, to->value);
    return to->count != 0;
}

static int run(const arguments *given)
{
    const char *subject = given->positional.item[0];
    vndf_error error = {VNDF_OK, ""};
    chosen_distribution chosen;
    report r = {.eta = 0, .subject = input_name(subject)};
    if (!rows_check(given) || !option_number(given, "--eta", 0.01, 100, &r.eta) ||
        !read_list(given, "--alpha", "0.05,0.1,0.2,0.3,0.5,0.7,1", (double)VNDF_ALBEDO_ALPHA_MAX, &r.alpha) ||
        !read_list(given, "--theta", "0,15,30,45,60,75,80,85,88,89,90", 90, &r.theta) ||
        !distribution_open(&chosen, name, subject, 0))
        return STATUS_USE;
    vndf_albedo *albedo = vndf_albedo_build(chosen.distribution, (float)r.eta, &error);
    r.albedo = albedo;
    int status = albedo ? rows_print(given, print, &r) : complain(name, "%s", error.message);
    vndf_albedo_free(albedo);
    distribution_close(&chosen);
    return status;
}

const subcommand command_albedo = {
    name, "what single scattering keeps of the light, for energy compensation", "FILE|ggx|beckmann", 1, 1, run,
    help};
