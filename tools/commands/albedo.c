/* vndf albedo: how much single scattering keeps of the light, for one distribution, as text and as CSV. */
#include <stdio.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "command.h"
#include "draw/table.h"
#include "vndf_bsdf.h"

static const char name[] = "vndf albedo";

static const char help[] =
    "usage: vndf albedo (FILE|ggx|beckmann | --csv FILE | --family NAME[:PARAM,...] | --ndf EXPR | --slope EXPR)\n"
    "                   [--eta X] [--alpha LIST] [--theta LIST] [-o OUT.csv]\n"
    "\n"
    "The directional albedo E: the part of the light that one scattering event with height-correlated Smith masking\n"
    "sends on, and its average 2 integral E mu dmu. 1 - E is what energy compensation has to give back (Kulla &\n"
    "Conty 2017, Turquin 2019). By quadrature, without noise: within 1e-3 for a mirror, 2e-2 for a dielectric.\n"
    "\n"
    "  --eta X          a dielectric of this ratio of indices, 0.01 to 100 and not 1: what is reflected and\n"
    "                   transmitted together, from either side; without it a mirror, F = 1\n"
    "  --alpha LIST     roughness to print, 0 to 4, between commas (default 0.05,0.1,0.2,0.3,0.5,0.7,1)\n"
    "  --theta LIST     angles of incidence, 0 to 90 (default 0,15,30,45,60,75,80,85,88,89,90)\n"
    "  --csv FILE, --family NAME, --ndf EXPR, --slope EXPR, --set NAME=X\n"
    "                   your own D, as `vndf build --help` describes them, by a table of 8 KiB\n"
    "  -o OUT.csv       what is printed as CSV; - for stdout, in place of the text\n"
    "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf albedo ggx --alpha 0.1,0.5,1\n"
    "         vndf albedo tables/hazy.vndf --eta 1.5 -o hazy_glass.csv\n";

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

static void print_side(const report *r, int side)
{
    printf("\nalbedo%s\n%7s", r->eta > 0 ? side ? ", from the other side" : ", from the side of z" : "", "theta");
    for (size_t j = 0; j < r->alpha.count; j++)
        printf("  a=%-6.4g", r->alpha.value[j]);
    putchar('\n');
    for (size_t i = 0; i < r->theta.count; i++) {
        printf("%7g", r->theta.value[i]);
        for (size_t j = 0; j < r->alpha.count; j++)
            printf(" %9.5f", (double)at(r, side, r->theta.value[i], r->alpha.value[j]));
        putchar('\n');
    }
    fputs("average", stdout);
    for (size_t j = 0; j < r->alpha.count; j++)
        printf(" %9.5f", (double)vndf_albedo_average(r->albedo, (float)r->alpha.value[j], side ? -1 : 1));
    putchar('\n');
}

static void print_csv(FILE *file, const report *r)
{
    fputs("distribution,eta,side,alpha,theta,albedo,average\n", file);
    for (int side = 0; side < (r->eta > 0 ? 2 : 1); side++)
        for (size_t j = 0; j < r->alpha.count; j++)
            for (size_t i = 0; i < r->theta.count; i++) {
                double alpha = r->alpha.value[j], theta = r->theta.value[i];
                table_quote(file, r->subject);
                fprintf(file, ",%.9g,%d,%.9g,%.9g,%.9g,%.9g\n", r->eta, side ? -1 : 1, alpha, theta,
                        (double)at(r, side, theta, alpha),
                        (double)vndf_albedo_average(r->albedo, (float)alpha, side ? -1 : 1));
            }
}

/* `csv` may be NULL; it is opened before the work begins, so that a name that cannot be written costs no time. */
static int run(report *r, const vndf_distribution *d, const char *csv)
{
    vndf_error error = {VNDF_OK, ""};
    output_file output;
    if (csv && !output_open(&output, name, csv))
        return STATUS_USE;
    vndf_albedo *albedo = vndf_albedo_build(d, (float)r->eta, &error);
    if (!albedo)
        return csv ? output_give_up(&output, error.message) : complain(name, "%s", error.message);
    r->albedo = albedo;
    if (!csv || !output_is_stdout(csv)) {
        printf(r->eta > 0 ? "%s, dielectric, eta %g\n" : "%s, mirror\n", r->subject, r->eta);
        for (int side = 0; side < (r->eta > 0 ? 2 : 1); side++)
            print_side(r, side);
    }
    if (csv)
        print_csv(output.file, r);
    vndf_albedo_free(albedo);
    return csv ? output_commit(&output) : STATUS_GOOD;
}

static int read_list(const char *what, const words *given, const char *otherwise, double most, list *to)
{
    const char *text = only_word(given);
    to->count = parse_numbers(name, what, text ? text : otherwise, 0, most, 1, LIST_MAX, to->value);
    return to->count != 0;
}

int command_albedo(int argc, char **argv)
{
    static const char *const forms[2] = {"csv", NULL};
    source_words source = {0};
    words subject = {{NULL}, 0}, eta = subject, alpha = subject, theta = subject, out = subject;
    const option_form options[] = {
        {"--ndf", 1, 1, &source.ndf},
        {"--slope", 1, 1, &source.slope},
        {"--csv", 1, 1, &source.csv},
        {"--family", 1, 1, &source.family},
        {"--set", 1, WORDS_MAX, &source.set},
        {"--eta", 1, 1, &eta},
        {"--alpha", 1, 1, &alpha},
        {"--theta", 1, 1, &theta},
        {"-o", 1, 1, &out},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "FILE|ggx|beckmann", 0, 1};
    char title[256];
    report r = {.subject = title};
    int parsed = parse_arguments(&form, argc, argv, &subject);
    if (parsed != PARSE_GO_ON)
        return parsed;
    size_t subjects = subject.count + source_words_count(&source);
    const char *csv = only_word(&out);
    if (subjects != 1)
        return complain(name, "%s of FILE|ggx|beckmann, --ndf, --slope, --csv and --family; exactly one is needed",
                        subjects ? "more than one" : "none");
    if (csv && output_form(name, csv, NULL, forms) < 0)
        return STATUS_USE;
    if ((parsed = source_words_check_set(name, &source)) != PARSE_GO_ON)
        return parsed;
    if (!option_number(name, "--eta", &eta, 0.01, 100, &r.eta) ||
        !read_list("--alpha", &alpha, "0.05,0.1,0.2,0.3,0.5,0.7,1", (double)VNDF_ALBEDO_ALPHA_MAX, &r.alpha) ||
        !read_list("--theta", &theta, "0,15,30,45,60,75,80,85,88,89,90", 90, &r.theta))
        return STATUS_USE;
    if (!subject.count) { /* a table of the source that was given stands for it */
        vndf_distribution *table = table_from_words(name, &source, title, sizeof title);
        int status = table ? run(&r, table, csv) : STATUS_USE;
        vndf_free(table);
        return status;
    }
    chosen_distribution chosen;
    r.subject = only_word(&subject);
    if (!distribution_open(&chosen, name, r.subject))
        return STATUS_USE;
    int status = run(&r, chosen.distribution, csv);
    distribution_close(&chosen);
    return status;
}
