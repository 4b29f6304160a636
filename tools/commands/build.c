/* vndf build: a table from what the user brings - formula, rows, family, measurements - or a family of tables along a
 * parameter. Reads the options, makes the source, calls the builder, saves, prints what came out. */
#include <stdlib.h>
#include <string.h>

#include "cli/output.h"
#include "cli/progress.h"
#include "command.h"
#include "commands/parts/describe.h"
#include "core/checksum.h"
#include "measured/measured.h"

static const char name[] = "vndf build";

static const char *const help[] = {
    "usage: vndf build (--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]) [options] -o FILE\n"
    "       vndf build (--rgl | --merl | --height | --normal-map) FILE [options] -o FILE\n"
    "       vndf build --family NAME --parameter LOW..HIGH [options] -o FILE.vndfs\n"
    "       vndf build --list\n"
    "\n"
    "Makes a table that samples the visible normals of an isotropic distribution of normals, and prints what it is\n"
    "worth. The input may have any scale; the factor found is printed. A FILE of input may be - for stdin.\n"
    "\n"
    "  --ndf EXPR      D per steradian, in c = cos(theta_m), theta (radians), t = tan(theta_m)\n"
    "  --slope EXPR    P22 = D cos^4, in r, the slope length tan(theta_m)\n"
    "                  EXPR has + - * / ^ ( ) numbers, pi, parameters and exp log log1p sqrt sin cos tan asin\n"
    "                  acos atan sinh cosh tanh erf erfc lgamma gamma abs min max pow, step(x) = 1 for x >= 0\n"
    "  --set NAME=X ...  a parameter of the expression, which must use it\n"
    "  --csv FILE      a header line that names the columns (theta_deg, theta or slope; ndf or p22), then rows\n"
    "  --family NAME   a named distribution or a measured material\n"
    "  --list          lists families and materials\n"
    "  --max-bytes N   the best table of this size at most, 2048 to 1048576 (default: some 3000, or what a total\n"
    "                  variation of 1e-3 above and 3e-2 below the horizon takes, up to 8192)\n"
    "  --max-tv X      the smallest table with total variation <= X above the horizon and the lesser of 30 X and 0.05\n"
    "                  below, up to --max-bytes or 8192; smaller than the default it is not faster, and D errs more\n"
    "  --moments 2|3|4    default 4: above the horizon densities are within 6.5e-2, 4.7e-3 or 7.2e-4 of the\n"
    "                  visible ones, whatever D is, but for the error of cells; fewer are smaller and faster\n"
    "  -o FILE         the table; it appears whole or not at all; - for stdout, in place of the figures\n"
    "\n"
    "A family of tables along a number of a named distribution, in one file; --max-bytes and --moments are of each\n"
    "table. Between two knots it is used as the mixture of both; how far that is off is measured (vndf info).\n"
    "\n"
    "  --parameter LOW..HIGH  the range of the number; NAME has {p} in its place, as in abc:{p},0.8, or is the\n"
    "                  name alone of a family with one number, as in student-t. --max-tv X: knots enough for a\n"
    "                  distance <= X of slopes (default 1e-3); visible normals at grazing incidence may be 0.06 off\n"
    "    --knots N     2 to 256 knots, where that distance is least\n"
    "\n",
    "From measurements (tools/measured/README.md says what is assumed of each); what was found is printed as well:\n"
    "errors, residuals, and of stretched surfaces the matrix: vndf sample FILE --matrix XX,XY,YX,YY.\n"
    "\n"
    "  --rgl FILE      a .bsdf of EPFL's realistic graphics lab: its ndf; anisotropic ones are refused\n"
    "  --merl FILE     a .binary of MERL: by power iteration of the light that goes back, less a diffuse constant\n"
    "    --channel red|green|blue|luminance    (default luminance)\n"
    "  --height FILE   heights of a surface: PFM, PGM, or numbers between blanks\n"
    "    --step X[,Y]  how far samples are apart, in the unit of the heights (default 1)\n"
    "    --cutoff N    takes waves shorter than N samples away first, 2 to 256 (Gaussian, ISO 16610-21)\n"
    "  --normal-map FILE    normals of a surface: PPM of 8 or 16 bits, or PFM\n"
    "  --profile OUT   the curve that was found, as a CSV for --csv\n"
    "\n"
    "example: vndf build --slope 'exp(-k*r)*(1+0.8*cos(6*r))' --set k=3 -o wavy.vndf\n"
    "         vndf build --family student-t:2.5 --max-tv 5e-4 -o student.vndf\n"
    "         vndf build --family student-t --parameter 1.6..6 -o tails.vndfs\n"
    "         vndf build --height surface.pfm --step 0.5 --cutoff 8 -o surface.vndf\n",
    NULL};

static const char *const sources[] = {"--ndf",  "--slope",  "--csv",        "--family", "--rgl",
                                      "--merl", "--height", "--normal-map", NULL};
static const char *const *const measured = sources + 4;

/* ---- files of measurements ----------------------------------------------------------------------- */

enum { MEASURED_BYTES = 1 << 28 };

static int height_slopes(const arguments *given, data_file *file, slope_set *slopes)
{
    const char *apart = option_value(given, "--step");
    unsigned long long cutoff = 0;
    double step[2] = {1, 1};
    size_t steps = 1;
    image field;
    if (!option_count(given, "--cutoff", 2, CUTOFF_MAX, &cutoff) ||
        (apart && !(steps = parse_numbers(name, "--step", apart, 1e-30, 1e30, 1, 2, step))) ||
        !heights_read(file, &field))
        return 0;
    step[1] = step[steps - 1];
    note(file, "heights %d x %d, %.6g x %.6g apart", field.width, field.height, step[0], step[1]);
    if (cutoff)
        note(file, "cutoff %llu", cutoff);
    const int good =
        (!cutoff || heights_smooth(&field, (int)cutoff) || refuse(file, "there is no memory for the cut-off")) &&
        heights_slopes(&field, step, (int)cutoff / 2, slopes, file);
    image_free(&field);
    return good;
}

/* 0 after a complaint, or with the reason in the file. */
static int read_rows(const arguments *given, data_file *file, profile *rows)
{
    slope_set slopes;
    if (option_value(given, "--rgl"))
        return rgl_read(file, rows);
    if (option_value(given, "--merl"))
        return merl_read(file, (merl_channel)option_choice(given, "--channel", MERL_LUMINANCE), rows);
    if (option_value(given, "--height") ? !height_slopes(given, file, &slopes) : !normals_slopes(file, &slopes))
        return 0;
    int good = slopes_law(&slopes, file, rows);
    slopes_free(&slopes);
    return good;
}

/* Calls it "--height surface.pfm --cutoff 8 (crc32 ...)", notes what was found, writes its rows to --profile. 0 after a
 * complaint. */
static int finish_measured(const arguments *given, const data_file *file, const profile *rows, vndf_source *source,
                           output_file *to)
{
    static const char *const options[] = {"--rgl",  "--merl",   "--channel",    "--height",
                                          "--step", "--cutoff", "--normal-map", NULL};
    const char *profile_path = option_value(given, "--profile");
    char text[VNDF_LIMIT_NAME_LENGTH + 2] = "";
    vndf_error error = {VNDF_OK, ""};
    options_text(given, options, text, sizeof text);
    snprintf(text + strlen(text), sizeof text - strlen(text), " (crc32 %08lx)",
             (unsigned long)vndf_crc32(0, file->bytes, file->size));
    if (vndf_source_describe(source, text, &error) != VNDF_OK ||
        vndf_source_note(source, file->notes, &error) != VNDF_OK)
        return denied(name, "%.100s: %s", file->name, error.message);
    return !profile_path || (output_open(to, name, profile_path) &&
                             (profile_write(to->file, rows, vndf_source_description(source)) ||
                              denied(name, "cannot write '%s'", profile_path)));
}

static vndf_source *measured_source(const arguments *given, output_file *to)
{
    data_file file = {.notes = ""};
    profile rows = {0};
    vndf_source *source = NULL;
    file.name = option_value(given, option_among(given, measured));
    char *bytes = input_read(name, file.name, MEASURED_BYTES, &file.size);
    file.bytes = (const unsigned char *)bytes;
    if (bytes && read_rows(given, &file, &rows))
        source = profile_source(&rows, &file);
    if (!source && file.error.message[0])
        complain(name, "%s", file.error.message);
    if (source && !finish_measured(given, &file, &rows, source, to)) {
        vndf_source_free(source);
        source = NULL;
    }
    profile_free(&rows);
    free(bytes);
    return source;
}

/* ---- building ------------------------------------------------------------------------------------ */

/* "1.6..6" */
static int read_range(const char *text, double range[2])
{
    char low[64];
    const char *dots = strstr(text, "..");
    if (!dots || dots - text >= (ptrdiff_t)sizeof low)
        return denied(name, "--parameter '%.64s' is not LOW..HIGH, as in 1.6..6", text);
    snprintf(low, sizeof low, "%.*s", (int)(dots - text), text);
    return parse_numbers(name, "--parameter", low, -1e30, 1e30, 1, 1, &range[0]) &&
           parse_numbers(name, "--parameter", dots + 2, -1e30, 1e30, 1, 1, &range[1]);
}

/* A family if there is no source. 0 after a complaint. */
static int build(const arguments *given, const vndf_source *source, chosen_distribution *to)
{
    double range[2];
    unsigned long long bytes = 0, knots = 0;
    progress bar = progress_begin("building", option_value(given, "-q") != NULL);
    vndf_build_options one = {.progress = progress_show, .progress_user = &bar};
    one.moments = 2 + option_choice(given, "--moments", -2);
    vndf_error error = {VNDF_OK, ""};
    if (!option_count(given, "--max-bytes", 2048, 1048576, &bytes) ||
        !option_number(given, "--max-tv", 1e-12, 1, &one.max_tv) ||
        !option_count(given, "--knots", 2, VNDF_LIMIT_FAMILY_KNOTS, &knots) ||
        (!source && !read_range(option_value(given, "--parameter"), range)))
        return 0;
    one.max_bytes = (size_t)bytes;
    const vndf_family_options many = {one.max_tv, (size_t)knots, one.max_bytes, one.moments, progress_show, &bar};
    if (source)
        to->distribution = to->owned = vndf_build(source, &one, NULL, &error);
    else
        to->family = vndf_build_family(option_value(given, "--family"), range[0], range[1], &many, &error);
    progress_end(&bar);
    if (output_stopping() && error.status != VNDF_OK)
        complain(name, "%s; '%s' was not touched", error.message, option_value(given, "-o"));
    else if (error.status != VNDF_OK)
        complain(name, "%s", error.message);
    return to->owned || to->family;
}

/* 0 after a complaint; committing tells what could not be written. */
static int write_table(const chosen_distribution *of, FILE *file)
{
    vndf_error error = {VNDF_ERROR_MEMORY, "no memory for the file"};
    size_t size = of->owned ? vndf_distribution_info(of->owned).bytes : vndf_family_info(of->family).bytes;
    void *bytes = malloc(size);
    const int good = bytes && (of->owned ? vndf_save_memory(of->owned, bytes, size, &error)
                                         : vndf_family_save_memory(of->family, bytes, size, &error)) == VNDF_OK;
    if (good)
        fwrite(bytes, 1, size, file);
    free(bytes);
    return good || denied(name, "%s", error.message);
}

/* Says what was built and what it is worth. Where the file itself is on stdout there is no place for figures. */
static int tell(const arguments *given, const chosen_distribution *of, figures *f)
{
    char verdict[DESCRIBE_VERDICT];
    if (output_is_stdout(option_value(given, "-o"))) {
        if (!describe_verdict(of, verdict))
            complain(name, "%s", verdict);
        return STATUS_GOOD;
    }
    describe(f, of);
    return f->failed ? complain(name, "no memory for figures") : STATUS_GOOD;
}

static int check_words(const arguments *given)
{
    const char *path = option_value(given, "-o");
    const char *profile_path = option_value(given, "--profile");
    const int is_family = option_value(given, "--parameter") != NULL;
    if (!option_alone(given, sources))
        return 0;
    if (is_family && !option_value(given, "--family"))
        complain(name, "--parameter is for --family; a formula has its parameters by --set");
    else if (option_value(given, "--knots") && option_value(given, "--max-tv"))
        complain(name, "--knots and --max-tv are given; with --parameter one of them is possible");
    else if (!path)
        complain(name, "-o FILE is missing");
    else if (is_family && !output_is_stdout(path) && !is_family_file(path))
        complain(name, "'%s' has to end in .vndfs: a family of tables is known by that", path);
    else if (!is_family && is_family_file(path))
        complain(name, "'%s': a family of tables is known by .vndfs, and this is one table", path);
    else if (profile_path && !option_among(given, measured))
        complain(name, "--profile is for files of measurements");
    else if (profile_path && output_is_stdout(profile_path))
        complain(name, "--profile '-': a file is needed");
    else if (profile_path && files_same(profile_path, path))
        complain(name, "-o and --profile both name '%s'", profile_path);
    else
        return 1;
    return 0;
}

static int run(const arguments *given)
{
    const int is_family = option_value(given, "--parameter") != NULL;
    chosen_distribution made = {NULL, NULL, NULL};
    vndf_source *source = NULL;
    output_file output[2] = {{.command = NULL}}; /* the table, the profile */
    figures f = figures_begin(given);
    int status = STATUS_USE;
    if (option_value(given, "--list")) {
        const char *material;
        printf("families:\n%s\nmaterials:\n", vndf_family_help());
        for (size_t i = 0; (material = vndf_family_material(i)) != NULL; i++)
            puts(material);
        return STATUS_GOOD;
    }
    if (!check_words(given))
        return STATUS_USE;
    if (!is_family)
        source =
            option_among(given, measured) ? measured_source(given, &output[1]) : source_from_words(given, NULL);
    /* Opened before the work, so that a place that cannot be written is told first. */
    if ((source || is_family) && output_open(&output[0], name, option_value(given, "-o")) &&
        build(given, source, &made) && write_table(&made, output[0].file))
        status = tell(given, &made, &f);
    status = output_commit_all(output, 2, status);
    if (status == STATUS_GOOD)
        figures_end(&f);
    figures_free(&f);
    distribution_close(&made);
    vndf_source_free(source);
    return status;
}

const subcommand command_build = {name,
                                  "make a table from a formula, a CSV, a named family or a file of measurements",
                                  "; a formula is --slope 'EXPR' or --ndf 'EXPR', a file --csv FILE",
                                  0,
                                  0,
                                  run,
                                  help};
