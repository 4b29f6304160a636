/* vndf albedo: how much single scattering keeps of the light, for one distribution: a table of albedos is built,
 * printed, and written as CSV, as an array in C, and as a file for vndf_albedo_load. */
#include <stdio.h>

#include "cli/arguments.h"
#include "cli/files.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "command.h"
#include "commands/parts/albedo_print.h"

static const char name[] = "vndf albedo";

static const char help[] =
    "usage: vndf albedo (FILE|ggx|beckmann | --csv FILE | --family NAME[:PARAM,...] | --ndf EXPR | --slope EXPR)\n"
    "                   [--eta X] [--alpha LIST] [--theta LIST] [-o OUT.csv] [--c OUT.h] [--save OUT.albedo]\n"
    "\n"
    "The directional albedo E: the part of the light that one scattering event with height-correlated Smith masking\n"
    "sends on, and its average 2 integral E mu dmu. 1 - E is what energy compensation has to give back (Kulla &\n"
    "Conty 2017, Turquin 2019). By quadrature, without noise; prints E over angles and roughness, then how far\n"
    "the look-ups of the table are from the quadrature at most.\n"
    "\n"
    "  --eta X          a dielectric of this ratio of indices, 0.01 to 100 and not 1: what is reflected and\n"
    "                   transmitted together, from either side; without it a mirror, F = 1\n"
    "  --alpha LIST     roughness to print, 0 to 4, between commas (default 0.05,0.1,0.2,0.3,0.5,0.7,1)\n"
    "  --theta LIST     angles of incidence, 0 to 90 (default 0,15,30,45,60,75,80,85,88,89,90)\n"
    "  --columns N      cosines of the grid, 8 to 128 (default 24, of a dielectric 48)\n"
    "  --rows N         roughnesses of the grid, 8 to 128 (default 20, of a dielectric 24)\n"
    "  --csv FILE, --family NAME, --ndf EXPR, --slope EXPR, --set NAME=X\n"
    "                   your own D, as `vndf build --help` describes them, by a table of 8 KiB\n"
    "  -o OUT.csv       what is printed as CSV; - for stdout, in place of the text\n"
    "  --c OUT.h        float OUT[N][N], rows even in sqrt(alpha) and columns even in the cosine, from 0 to 1, and\n"
    "                   OUT_average[N]: for hosts with such tables; - for stdout\n"
    "  --size N         that N, 2 to 256 (default 32)\n"
    "  --save OUT       a small file for vndf_albedo_load; `vndf info` says what is in OUT.albedo\n"
    "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf albedo ggx --alpha 0.1,0.5,1\n"
    "         vndf albedo tables/hazy.vndf --eta 1.5 --c hazy_glass.h --save hazy_glass.albedo\n";

typedef struct albedo_words {
    source_words source;
    words subject, eta, alpha, theta, columns, rows, csv, c, size, save;
} albedo_words;

typedef struct albedo_plan {
    const albedo_words *given;
    const char *subject;
    const vndf_distribution *distribution;
    vndf_albedo_options options;
    albedo_lists at;
    int size;      /* of arrays in C */
    unsigned held; /* signals that wait */
} albedo_plan;

/* ---- words --------------------------------------------------------------------------------------- */

static int read_list(const char *what, const words *given, const char *otherwise, double most, double *list,
                     size_t *count)
{
    const char *text = only_word(given);
    *count = parse_numbers(name, what, text ? text : otherwise, 0, most, 1, ALBEDO_LIST_MAX, list);
    return *count != 0;
}

static int read_count(const char *what, const words *given, double low, double high, int *count)
{
    unsigned long long number = (unsigned long long)*count;
    int good = option_count(name, what, given, low, high, &number);
    *count = (int)number;
    return good;
}

static int read_settings(albedo_plan *plan)
{
    const albedo_words *given = plan->given;
    double eta = 0;
    plan->size = 32;
    if (!option_number(name, "--eta", &given->eta, 0.01, 100, &eta) ||
        !read_list("--alpha", &given->alpha, "0.05,0.1,0.2,0.3,0.5,0.7,1", (double)VNDF_ALBEDO_ALPHA_MAX,
                   plan->at.alpha, &plan->at.alphas) ||
        !read_list("--theta", &given->theta, "0,15,30,45,60,75,80,85,88,89,90", 90, plan->at.theta,
                   &plan->at.thetas) ||
        !read_count("--columns", &given->columns, VNDF_ALBEDO_GRID_MIN, VNDF_ALBEDO_GRID_MAX,
                    &plan->options.columns) ||
        !read_count("--rows", &given->rows, VNDF_ALBEDO_GRID_MIN, VNDF_ALBEDO_GRID_MAX, &plan->options.rows) ||
        !read_count("--size", &given->size, 2, 256, &plan->size))
        return 0;
    plan->options.eta = (float)eta;
    return 1;
}

/* Of two outputs, either of which may be NULL. */
static int are_distinct(const char *option, const char *path, const char *other, const char *its)
{
    if (!path || !its)
        return 1;
    int both = output_is_stdout(path) + output_is_stdout(its);
    if (both == 2 || (both == 0 && files_same(path, its)))
        complain(name, "%s and %s both name '%s'", option, other, path);
    else
        return 1;
    return 0;
}

static int check_words(const albedo_words *given)
{
    static const char *const forms[] = {"csv", NULL};
    const char *csv = only_word(&given->csv), *c = only_word(&given->c), *save = only_word(&given->save);
    size_t subjects = given->subject.count + source_words_count(&given->source);
    if (subjects != 1)
        return complain(name, "%s of FILE|ggx|beckmann, --ndf, --slope, --csv and --family; exactly one is needed",
                        subjects ? "more than one" : "none");
    if (csv && output_form(name, csv, NULL, forms) < 0)
        return STATUS_USE;
    if (save && output_is_stdout(save))
        return complain(name, "--save '-': a file is needed");
    if (!are_distinct("-o", csv, "--c", c) || !are_distinct("-o", csv, "--save", save) ||
        !are_distinct("--c", c, "--save", save))
        return STATUS_USE;
    return source_words_check_set(name, &given->source);
}

/* ---- work ---------------------------------------------------------------------------------------- */

static vndf_albedo *build(albedo_plan *plan)
{
    vndf_error error = {VNDF_OK, ""};
    progress p = progress_begin("albedo", plan->held);
    p.tells_left = 1;
    plan->options.progress = progress_show;
    plan->options.progress_user = &p;
    vndf_albedo *albedo = vndf_albedo_build(plan->distribution, &plan->options, &error);
    progress_end(&p);
    if (!albedo)
        complain(name, "%s", error.message);
    return albedo;
}

static int save(const albedo_plan *plan, const vndf_albedo *albedo)
{
    vndf_error error = {VNDF_OK, ""};
    const char *path = only_word(&plan->given->save);
    if (path && vndf_albedo_save(albedo, path, &error) != VNDF_OK)
        return complain(name, "%s", error.message);
    return STATUS_GOOD;
}

/* Opened before the work begins, so that a name that cannot be written costs no time. `file` is NULL where none was
 * asked for. */
typedef struct albedo_outputs {
    output_file csv, c;
    int count;
} albedo_outputs;

static int open_outputs(const albedo_words *given, albedo_outputs *to)
{
    const char *csv = only_word(&given->csv), *c = only_word(&given->c), *path = only_word(&given->save);
    if (path && !output_replaceable(name, path))
        return 0;
    if (csv && !output_open(&to->csv, name, csv))
        return 0;
    if (!c || output_open(&to->c, name, c))
        return 1;
    if (csv)
        output_discard(&to->csv);
    return 0;
}

static int write_all(const albedo_plan *plan, const vndf_albedo *albedo, albedo_outputs *to)
{
    const char *csv = only_word(&plan->given->csv), *c = only_word(&plan->given->c);
    if (!(csv && output_is_stdout(csv)) && !(c && output_is_stdout(c)))
        albedo_print_text(stdout, plan->subject, albedo, &plan->at);
    if (csv)
        albedo_print_csv(to->csv.file, plan->subject, albedo, &plan->at);
    if (c)
        albedo_print_c(to->c.file, c, albedo, plan->size);
    int status = save(plan, albedo), of_c = c ? output_commit(&to->c) : STATUS_GOOD;
    int of_csv = csv ? output_commit(&to->csv) : STATUS_GOOD;
    return status != STATUS_GOOD ? status : of_c != STATUS_GOOD ? of_c : of_csv;
}

static int run(albedo_plan *plan)
{
    albedo_outputs to = {0};
    if (!open_outputs(plan->given, &to))
        return STATUS_USE;
    vndf_albedo *albedo = build(plan);
    if (!albedo) {
        if (to.csv.file)
            output_discard(&to.csv);
        if (to.c.file)
            output_discard(&to.c);
        return STATUS_USE;
    }
    int status = write_all(plan, albedo, &to);
    vndf_albedo_free(albedo);
    return status;
}

static int run_with_subject(albedo_plan *plan)
{
    chosen_distribution chosen;
    plan->subject = only_word(&plan->given->subject);
    if (!distribution_open(&chosen, name, plan->subject))
        return STATUS_USE;
    plan->distribution = chosen.distribution;
    int status = run(plan);
    distribution_close(&chosen);
    return status;
}

/* A table of the source that was given stands for it. */
static int run_with_source(albedo_plan *plan)
{
    char title[256];
    vndf_distribution *table = table_from_words(name, &plan->given->source, title, sizeof title);
    if (!table)
        return STATUS_USE;
    plan->subject = title;
    plan->distribution = table;
    int status = run(plan);
    vndf_free(table);
    return status;
}

int command_albedo(int argc, char **argv)
{
    albedo_words given = {0};
    albedo_plan plan = {.given = &given};
    const option_form options[] = {
        {"--ndf", 1, 1, &given.source.ndf},
        {"--slope", 1, 1, &given.source.slope},
        {"--csv", 1, 1, &given.source.csv},
        {"--family", 1, 1, &given.source.family},
        {"--set", 1, WORDS_MAX, &given.source.set},
        {"--eta", 1, 1, &given.eta},
        {"--alpha", 1, 1, &given.alpha},
        {"--theta", 1, 1, &given.theta},
        {"--columns", 1, 1, &given.columns},
        {"--rows", 1, 1, &given.rows},
        {"-o", 1, 1, &given.csv},
        {"--c", 1, 1, &given.c},
        {"--size", 1, 1, &given.size},
        {"--save", 1, 1, &given.save},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "FILE|ggx|beckmann", 0, 1};
    int parsed = parse_arguments(&form, argc, argv, &given.subject);
    if (parsed == PARSE_GO_ON)
        parsed = check_words(&given);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (!read_settings(&plan))
        return STATUS_USE;
    plan.held = output_hold_signals();
    int status = given.subject.count ? run_with_subject(&plan) : run_with_source(&plan);
    output_release_signals(plan.held);
    return status;
}
