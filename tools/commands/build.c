/* vndf build: a table from what the user brings, or a family of tables along a parameter. Reads the options, makes the
 * source, calls the builder, saves, prints what came out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "commands/parts/build_measured.h"
#include "commands/parts/describe.h"
#include "cli/files.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "vndf_build.h"

static const char name[] = "vndf build";

static const char help[] =
    "usage: vndf build (--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]) [options] -o FILE\n"
    "       vndf build (--rgl | --merl | --height | --normal-map) FILE [options] -o FILE\n"
    "       vndf build --family NAME --parameter LOW..HIGH [options] -o FILE.vndfs\n"
    "       vndf build --list\n"
    "\n"
    "Makes a table that samples the visible normals of an isotropic distribution of normals, and prints what it\n"
    "is worth. The input may have any scale and need not be normalised; the factor found is printed.\n"
    "\n"
    "  --ndf EXPR      D per steradian, in c = cos(theta_m), theta (radians), t = tan(theta_m)\n"
    "  --slope EXPR    P22 = D cos^4, in r, the slope length tan(theta_m)\n"
    "                  EXPR has + - * / ^ ( ) numbers, pi, parameters and exp log log1p sqrt sin cos tan asin\n"
    "                  acos atan sinh cosh tanh erf erfc lgamma gamma abs min max pow, step(x) = 1 for x >= 0\n"
    "  --set NAME=X    a parameter of the expression, which must use it; may be repeated\n"
    "  --csv FILE      a header line that names the columns (theta_deg, theta or slope; ndf or p22), then rows;\n"
    "                  - for stdin, here and for every FILE below\n"
    "  --family NAME   a named distribution or a measured material\n"
    "  --list          lists families and materials\n"
    "  --break R       a slope where a feature begins, ends or has its peak; may be repeated. Formulas, families and\n"
    "                  rows need none: narrow features are found, or refused with their slope\n"
    "  --finest W      samples a formula that cannot be bounded, to find features as wide as W of their slope\n"
    "  --max-bytes N   size of the table at most, 2048 to 1048576 (default: what a total variation of 1e-3 above and\n"
    "                  3e-2 below the horizon takes, up to 8192)\n"
    "  --max-tv X      the smallest table with total variation <= X above the horizon and 30 X below; without it,\n"
    "                  the best table that fits\n"
    "  --moments 2|3|4    default 4: above the horizon densities are within 6.5e-2, 4.7e-3 or 7.2e-4 of the\n"
    "                  visible ones, whatever D is, but for the error of cells; fewer are smaller and faster\n"
    "  -o FILE         the table; it appears whole or not at all; - for stdout, in place of the figures\n" FIGURES_HELP
    "\n"
    "With --parameter, tables along a number of a family, in one file: between two of these knots the family is used\n"
    "as the mixture of both, and what is printed says how far that is from it (measured at 7 parameters between\n"
    "each two knots, not proven; see vndf info).\n"
    "\n"
    "  --parameter LOW..HIGH    the range of the number; NAME has {p} in its place, as in abc:{p},0.8, or is the name\n"
    "                  alone of a family with one number, as in student-t\n"
    "  --max-tv X      knots enough for a distance <= X of slopes between mixture and family (default 1e-3). Normals\n"
    "                  that are visible at grazing incidence weigh the tail: where it is heavy they may be 0.06 off\n"
    "                  (student-t from 1.6; the line `grazing` of vndf info)\n"
    "  --knots N       2 to 256 knots, where that distance is least\n"
    "  --max-bytes N, --moments 2|3|4    of each table\n"
    "\n";

static const char examples[] =
    "\n"
    "example: vndf build --slope 'exp(-k*r)*(1+0.8*cos(6*r))' --set k=3 -o wavy.vndf\n"
    "         vndf build --family student-t:2.5 --max-tv 1e-4 -o student.vndf\n"
    "         vndf build --slope 'exp(-r^2)*(1+r)' --max-bytes 2048 --moments 3 -o small.vndf\n"
    "         vndf build --family student-t --parameter 1.6..6 -o tails.vndfs\n";

typedef struct build_words {
    source_words source;
    measured_words measured;
    words list, bytes, tv, moments, breaks, finest, parameter, knots, output;
    figure_words figures;
} build_words;

static int print_list(void)
{
    const char *material;
    fputs("families:\n", stdout);
    fputs(vndf_family_help(), stdout);
    fputs("\nmaterials:\n", stdout);
    for (size_t i = 0; (material = vndf_family_material(i)) != NULL; i++)
        puts(material);
    return STATUS_GOOD;
}

/* ---- building ------------------------------------------------------------------------------------ */

static int read_size(const build_words *given, size_t *max_bytes, int *moments)
{
    unsigned long long bytes = 0, terms = 0;
    int good = option_count(name, "--max-bytes", &given->bytes, 2048, 1048576, &bytes) &&
               option_count(name, "--moments", &given->moments, 2, 4, &terms);
    *max_bytes = (size_t)bytes;
    *moments = (int)terms;
    return good;
}

static progress begin(const build_words *given, unsigned held)
{
    progress p = progress_begin("building", held);
    p.is_seen &= !given->figures.quiet.count;
    return p;
}

/* Why nothing was built. */
static int refuse(const build_words *given, const vndf_error *error, unsigned held)
{
    if (output_stopping(held))
        return complain(name, "%s; '%s' was not touched", error->message, only_word(&given->output));
    const int may_grow = !given->bytes.count || strtod(only_word(&given->bytes), NULL) < 1048576;
    return complain(name, "%s%s", error->message,
                    error->status == VNDF_ERROR_TARGET && may_grow ? "; --max-bytes N allows a larger table" : "");
}

static vndf_distribution *build_table(const vndf_source *source, const build_words *given, unsigned held)
{
    vndf_build_options options = {0};
    vndf_error error = {VNDF_OK, ""};
    double breaks[WORDS_MAX];
    if (!read_size(given, &options.max_bytes, &options.moments) ||
        !option_number(name, "--max-tv", &given->tv, 1e-12, 1, &options.max_tv) ||
        !option_number(name, "--finest", &given->finest, 1e-9, 1, &options.finest))
        return NULL;
    for (size_t i = 0; i < given->breaks.count; i++)
        if (!parse_numbers(name, "--break", given->breaks.item[i], 1e-30, 1e30, 1, 1, &breaks[i]))
            return NULL;
    progress p = begin(given, held);
    options.breaks = breaks;
    options.break_count = given->breaks.count;
    options.progress = progress_show;
    options.progress_user = &p;
    vndf_distribution *table = vndf_build(source, &options, NULL, &error);
    progress_end(&p);
    if (!table)
        refuse(given, &error, held);
    return table;
}

/* "1.6..6" */
static int read_range(const char *text, double range[2])
{
    char low[64];
    const char *dots = strstr(text, "..");
    size_t length = dots ? (size_t)(dots - text) : sizeof low;
    if (length >= sizeof low)
        return complain(name, "--parameter '%.64s' is not LOW..HIGH, as in 1.6..6", text), 0;
    memcpy(low, text, length);
    low[length] = '\0';
    return parse_numbers(name, "--parameter", low, -1e30, 1e30, 1, 1, &range[0]) &&
           parse_numbers(name, "--parameter", dots + 2, -1e30, 1e30, 1, 1, &range[1]);
}

static vndf_family *build_family(const build_words *given, unsigned held)
{
    vndf_family_options options = {0};
    vndf_error error = {VNDF_OK, ""};
    unsigned long long knots = 0;
    double range[2];
    if (!read_range(only_word(&given->parameter), range) ||
        !read_size(given, &options.max_bytes, &options.moments) ||
        !option_number(name, "--max-tv", &given->tv, 1e-12, 1, &options.max_distance) ||
        !option_count(name, "--knots", &given->knots, 2, VNDF_LIMIT_FAMILY_KNOTS, &knots))
        return NULL;
    progress p = begin(given, held);
    options.knots = (size_t)knots;
    options.progress = progress_show;
    options.progress_user = &p;
    vndf_family *family =
        vndf_build_family(only_word(&given->source.family), range[0], range[1], &options, &error);
    progress_end(&p);
    if (!family)
        refuse(given, &error, held);
    return family;
}

/* ---- saving and telling -------------------------------------------------------------------------- */

/* Frees the bytes; NULL: there was no memory for them. */
static int write_bytes(const char *path, void *bytes, size_t size)
{
    output_file output;
    if (!bytes || !output_open(&output, name, path)) {
        free(bytes);
        return bytes ? STATUS_USE : complain(name, "no memory for the file");
    }
    fwrite(bytes, 1, size, output.file); /* committing tells what could not be written */
    free(bytes);
    return output_commit(&output);
}

/* Says what was built and what it is worth, and that on stderr too where it is worth little. Where the file itself is
 * on stdout there is no place for figures. */
static int tell(const build_words *given, const vndf_distribution *table, const vndf_family *family,
                const char *found)
{
    char verdict[DESCRIBE_VERDICT];
    figures f = figures_begin(&given->figures);
    vndf_info info = {.bytes = 0};
    if (table)
        info = vndf_distribution_info(table);
    const int by_default = !given->bytes.count && !given->tv.count && !given->moments.count;
    const int good =
        table ? describe_verdict(&info, by_default, verdict) : describe_family_verdict(family, verdict);
    if (!good)
        complain(name, "%s", verdict);
    if (output_is_stdout(only_word(&given->output)))
        return STATUS_GOOD;
    if (table) {
        describe_info(&f, &info);
        describe_certificate(&f, &info.certificate);
    } else
        describe_family(&f, family);
    int length = 0; /* of a line `key value` of what was found in measurements */
    for (char key[64], value[512]; sscanf(found, "%63s %511[^\n]%n", key, value, &length) == 2; found += length)
        figures_text(&f, key, value);
    figures_text(&f, "verdict", verdict);
    figures_end(&f);
    return STATUS_GOOD;
}

static int build_and_save(const vndf_source *source, const char *found, const build_words *given, unsigned held)
{
    const char *path = only_word(&given->output);
    const int is_family = given->parameter.count > 0;
    vndf_error error = {VNDF_OK, ""};
    if (!output_replaceable(name, path))
        return STATUS_USE;
    vndf_distribution *table = is_family ? NULL : build_table(source, given, held);
    vndf_family *family = is_family ? build_family(given, held) : NULL;
    if (!table && !family)
        return STATUS_USE;
    size_t size = table ? vndf_distribution_info(table).bytes : vndf_family_info(family).bytes;
    void *bytes = malloc(size);
    if (bytes && table)
        vndf_save_memory(table, bytes, size, &error);
    else if (bytes)
        vndf_family_save_memory(family, bytes, size, &error);
    int status = write_bytes(path, bytes, size);
    if (status == STATUS_GOOD)
        status = tell(given, table, family, found);
    vndf_free(table);
    vndf_family_free(family);
    return status;
}

/* ---- the command --------------------------------------------------------------------------------- */

static int check_words(const build_words *given)
{
    size_t sources = source_words_count(&given->source) + measured_words_count(&given->measured);
    const char *path = only_word(&given->output), *rows = only_word(&given->measured.profile);
    if (sources != 1)
        return complain(name,
                        "%s of --ndf, --slope, --csv, --family and files of measurements; exactly one is needed",
                        sources ? "more than one" : "none");
    if (given->parameter.count && !given->source.family.count)
        return complain(name, "--parameter is for --family; a formula has its parameters by --set");
    if (given->parameter.count && (given->breaks.count || given->finest.count))
        return complain(name, "--parameter takes no %s", given->breaks.count ? "--break" : "--finest");
    if (given->knots.count && !given->parameter.count)
        return complain(name, "--knots is for --parameter LOW..HIGH");
    if (given->knots.count && given->tv.count)
        return complain(name, "--knots and --max-tv are given; with --parameter one of them is possible");
    int checked = source_words_check_set(name, &given->source);
    if (checked == PARSE_GO_ON)
        checked = measured_words_check(name, &given->measured);
    if (checked != PARSE_GO_ON)
        return checked;
    if (!path)
        return complain(name, "-o FILE is missing");
    if (given->parameter.count && !output_is_stdout(path) && !is_family_file(path))
        return complain(name, "'%s' has to end in .vndfs: a family of tables is known by that", path);
    if (!given->parameter.count && is_family_file(path))
        return complain(name, "'%s': a family of tables is known by .vndfs, and this is one table", path);
    if (rows && files_same(rows, path))
        return complain(name, "-o and --profile both name '%s'", rows);
    return PARSE_GO_ON;
}

static int run(const build_words *given)
{
    char found[MEASURED_NOTES] = "";
    vndf_source *source = NULL;
    if (measured_words_count(&given->measured))
        source = measured_source(name, &given->measured, found);
    else if (!given->parameter.count)
        source = source_from_words(name, &given->source);
    if (!source && !given->parameter.count)
        return STATUS_USE;
    unsigned held = output_hold_signals();
    int status = build_and_save(source, found, given, held);
    vndf_source_free(source);
    output_release_signals(held);
    return status;
}

int command_build(int argc, char **argv)
{
    build_words given = {0};
    words positional = {{NULL}, 0};
    const option_form options[] = {
        {"--ndf", 1, 1, &given.source.ndf},
        {"--slope", 1, 1, &given.source.slope},
        {"--csv", 1, 1, &given.source.csv},
        {"--family", 1, 1, &given.source.family},
        {"--list", 0, 1, &given.list},
        {"--set", 1, WORDS_MAX, &given.source.set},
        {"--max-bytes", 1, 1, &given.bytes},
        {"--max-tv", 1, 1, &given.tv},
        {"--moments", 1, 1, &given.moments},
        {"--break", 1, VNDF_LIMIT_BREAKS, &given.breaks},
        {"--finest", 1, 1, &given.finest},
        {"--parameter", 1, 1, &given.parameter},
        {"--knots", 1, 1, &given.knots},
        {"--rgl", 1, 1, &given.measured.rgl},
        {"--merl", 1, 1, &given.measured.merl},
        {"--channel", 1, 1, &given.measured.channel},
        {"--profile", 1, 1, &given.measured.profile},
        {"--height", 1, 1, &given.measured.height},
        {"--normal-map", 1, 1, &given.measured.normal_map},
        {"--step", 1, 1, &given.measured.step},
        {"--cutoff", 1, 1, &given.measured.cutoff},
        {"-o", 1, 1, &given.output},
        FIGURES_OPTIONS(given.figures),
    };
    static char text[sizeof help + sizeof examples + MEASURED_HELP_MAX]; /* `vndf help` reads it later */
    snprintf(text, sizeof text, "%s%s%s", help, measured_help, examples);
    const command_form form = {name, text, options, sizeof options / sizeof options[0], "", 0, 0};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed == PARSE_GO_ON && given.list.count)
        return print_list();
    if (parsed == PARSE_GO_ON)
        parsed = check_words(&given);
    return parsed == PARSE_GO_ON ? run(&given) : parsed;
}
