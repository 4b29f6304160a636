#include "commands/parts/build_measured.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "cli/output.h"
#include "cli/source_words.h"
#include "command.h"
#include "core/checksum.h"
#include "measured/brdf/gonio.h"
#include "measured/brdf/merl.h"
#include "measured/rgl/rgl.h"
#include "measured/surface/heights.h"
#include "measured/surface/maps.h"

enum { BYTES_MAX = 1 << 28, DESCRIPTION_MAX = VNDF_LIMIT_NAME_LENGTH };

const char measured_help[] =
    "From measurements (tools/measured/README.md says what is assumed of each). What was found is printed with the\n"
    "table: errors, residuals that say how well D explains the data, and for stretched surfaces the matrix of the\n"
    "lobe that they are: vndf sample --lobe 'table=FILE matrix=XX,XY,YX,YY'.\n"
    "\n"
    "  --rgl FILE      a .bsdf of EPFL's realistic graphics lab: its ndf; anisotropic ones are refused\n"
    "    --matrix      an anisotropic one as the matrix of an isotropic D, which is printed\n"
    "  --merl FILE     a .binary of MERL: by power iteration of the light that goes back, less a diffuse constant\n"
    "    --channel red|green|blue|luminance    (default luminance)\n"
    "  --gonio FILE    a CSV with the columns theta_i,theta_o (degrees; the mirror direction is theta_o = theta_i)\n"
    "                  and brdf (f) or intensity (f cos theta_o), in the plane of incidence\n"
    "    --f0 X        reflectance at normal incidence (without it, from the scale of the data)\n"
    "  --height FILE   heights of a surface: PFM, PGM, ASCII .sdf, numbers between blanks, or raw floats by --size\n"
    "    --step X[,Y]  how far samples are apart, in the unit of the heights (default 1, or what the .sdf says)\n"
    "    --cutoff N    takes waves shorter than N samples away first, 2 to 256 (Gaussian, ISO 16610-21)\n"
    "    --size WxH    FILE is W times H little-endian floats of 32 bits\n"
    "  --normal-map FILE    normals of a surface: PPM of 8 or 16 bits, or PFM\n"
    "  --profile OUT   the curve that was found, as a CSV for --csv, with its errors where they are known\n"
    "\n"
    "example: vndf build --rgl leather.bsdf -o leather.vndf\n"
    "         vndf build --merl gold-paint.binary --channel red -o gold-paint.vndf\n"
    "         vndf build --height surface.pfm --step 0.5 --cutoff 8 -o surface.vndf\n";

/* The file of one command line. */
typedef struct measured_file {
    const char *command, *path;
    char *bytes; /* owned */
    size_t size;
} measured_file;

/* ---- words --------------------------------------------------------------------------------------- */

typedef struct kind {
    const char *option;
    size_t file; /* where the words are in measured_words */
    int (*read)(const measured_file *file, const measured_words *given, profile *rows, notes *found, refusal *why);
} kind;

static int read_height(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                       refusal *why);
static int read_normal_map(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                           refusal *why);

static int read_rgl(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                    refusal *why);

static int read_merl(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                     refusal *why);
static int read_gonio(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                      refusal *why);

static const kind kinds[] = {
    {"--merl", offsetof(measured_words, merl), read_merl},
    {"--gonio", offsetof(measured_words, gonio), read_gonio},
    {"--rgl", offsetof(measured_words, rgl), read_rgl},
    {"--height", offsetof(measured_words, height), read_height},
    {"--normal-map", offsetof(measured_words, normal_map), read_normal_map},
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const words *at(const measured_words *given, size_t offset)
{
    return (const words *)(const void *)((const char *)given + offset);
}

/* An option that goes with some files alone. */
typedef struct rider {
    const char *option;
    size_t values;
    const char *with[2]; /* options of files; the second may be NULL */
} rider;

static const rider riders[] = {
    {"--size", offsetof(measured_words, size), {"--height", NULL}},
    {"--step", offsetof(measured_words, step), {"--height", NULL}},
    {"--cutoff", offsetof(measured_words, cutoff), {"--height", NULL}},
    {"--matrix", offsetof(measured_words, matrix), {"--rgl", NULL}},
    {"--channel", offsetof(measured_words, channel), {"--merl", NULL}},
    {"--f0", offsetof(measured_words, f0), {"--gonio", NULL}},
};

enum { RIDERS = sizeof riders / sizeof riders[0] };

static const kind *kind_given(const measured_words *given)
{
    for (size_t i = 0; i < KINDS; i++)
        if (at(given, kinds[i].file)->count)
            return &kinds[i];
    return NULL;
}

size_t measured_words_count(const measured_words *given)
{
    size_t count = 0;
    for (size_t i = 0; i < KINDS; i++)
        count += at(given, kinds[i].file)->count;
    return count;
}

int measured_words_check(const char *command, const measured_words *given)
{
    const kind *of = kind_given(given);
    for (size_t i = 0; i < RIDERS; i++) {
        const rider *r = &riders[i];
        int fits =
            of && (strcmp(of->option, r->with[0]) == 0 || (r->with[1] && strcmp(of->option, r->with[1]) == 0));
        if (at(given, r->values)->count && !fits)
            return complain(command, "%s is for %s%s%s", r->option, r->with[0], r->with[1] ? " and " : "",
                            r->with[1] ? r->with[1] : "");
    }
    const char *written = only_word(&given->profile);
    if (written && !of)
        return complain(command, "--profile is for files of measurements");
    if (written && output_is_stdout(written))
        return complain(command, "--profile '-': a file is needed");
    return PARSE_GO_ON;
}

/* ---- heights and normals ------------------------------------------------------------------------- */

/* "WxH" */
static int read_size(const char *command, const char *text, height_form *form)
{
    char *end;
    long width = text ? strtol(text, &end, 10) : 0, height = text && *end == 'x' ? strtol(end + 1, &end, 10) : 0;
    if (!text)
        return 1;
    if (*end || width < 3 || height < 3 || width > HEIGHTS_SIDE_MAX || height > HEIGHTS_SIDE_MAX) {
        complain(command, "--size '%s' is not WIDTHxHEIGHT, each from 3 to %d", text, HEIGHTS_SIDE_MAX);
        return 0;
    }
    form->width = (int)width;
    form->height = (int)height;
    return 1;
}

static int read_form(const char *command, const measured_words *given, height_form *form, int *cutoff)
{
    double step[2] = {0, 0};
    unsigned long long samples = 0;
    size_t count = 1;
    if (!read_size(command, only_word(&given->size), form) ||
        !option_count(command, "--cutoff", &given->cutoff, 2, CUTOFF_MAX, &samples))
        return 0;
    if (given->step.count)
        count = parse_numbers(command, "--step", only_word(&given->step), 1e-30, 1e30, 1, 2, step);
    form->step_x = step[0];
    form->step_y = count == 2 ? step[1] : step[0];
    *cutoff = (int)samples;
    return count > 0;
}

static void note_smith(const height_field *field, notes *found)
{
    static const int degrees[2] = {60, 80};
    for (int i = 0; i < 2; i++) {
        double off = heights_smith(field, degrees[i] * 3.14159265358979323846 / 180);
        if (off >= 0)
            note(found, "residual_smith_%d %.3g", degrees[i], off);
    }
}

static int law_of_heights(height_field *field, int cutoff, const char *name, profile *rows, notes *found,
                          refusal *why)
{
    slope_set slopes = {NULL, NULL, NULL, 0, 0, 0};
    slope_law law;
    note(found, "heights %d x %d, %.6g x %.6g apart", field->width, field->height, field->step_x, field->step_y);
    if (cutoff)
        note(found, "cutoff %d", cutoff);
    if (cutoff && !heights_smooth(field, cutoff))
        return refuse_data(why, name, "there is no memory for the cut-off");
    int good =
        heights_slopes(field, cutoff / 2, name, &slopes, why) && slopes_law(&slopes, name, &law, found, why);
    slopes_free(&slopes);
    if (!good)
        return 0;
    note_smith(field, found);
    *rows = law.rows;
    return 1;
}

static int read_height(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                       refusal *why)
{
    height_form form = {0, 0, 0, 0};
    height_field field;
    int cutoff = 0;
    if (!read_form(file->command, given, &form, &cutoff) ||
        !heights_read(&field, file->path, file->bytes, file->size, &form, why))
        return 0;
    int good = law_of_heights(&field, cutoff, file->path, rows, found, why);
    heights_free(&field);
    return good;
}

static int read_normal_map(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                           refusal *why)
{
    slope_set slopes;
    slope_law law;
    (void)given;
    if (!maps_read(&slopes, file->path, file->bytes, file->size, found, why))
        return 0;
    int good = slopes_law(&slopes, file->path, &law, found, why);
    slopes_free(&slopes);
    if (good)
        *rows = law.rows;
    return good;
}

/* ---- reflectances -------------------------------------------------------------------------------- */

static int read_rgl(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                    refusal *why)
{
    const unsigned char *bytes = (const unsigned char *)file->bytes;
    if (given->matrix.count)
        return rgl_fit(rows, file->path, bytes, file->size, found, why);
    if (!rgl_read(rows, file->path, bytes, file->size, found, why))
        return 0;
    vndf_distribution *table = profile_table(rows, file->path, why);
    const vndf_surface surface = {table, 1, 1};
    if (table)
        rgl_residuals(&surface, file->path, bytes, file->size, found);
    vndf_free(table);
    return table != NULL;
}

static int read_channel(const char *command, const measured_words *given, merl_channel *channel)
{
    static const char *const names[4] = {"red", "green", "blue", "luminance"};
    const char *wanted = given->channel.count ? only_word(&given->channel) : "luminance";
    for (int i = 0; i < 4; i++)
        if (strcmp(wanted, names[i]) == 0) {
            *channel = (merl_channel)i;
            return 1;
        }
    complain(command, "--channel '%s' is none of red, green, blue and luminance", wanted);
    return 0;
}

static int read_merl(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                     refusal *why)
{
    merl_channel channel;
    return read_channel(file->command, given, &channel) &&
           merl_read(rows, file->path, (const unsigned char *)file->bytes, file->size, channel, found, why);
}

static int read_gonio(const measured_file *file, const measured_words *given, profile *rows, notes *found,
                      refusal *why)
{
    gonio_points points;
    double f0 = -1;
    if (!option_number(file->command, "--f0", &given->f0, 0, 1, &f0) ||
        !gonio_read(&points, file->path, file->bytes, file->size, why))
        return 0;
    int good = gonio_law(&points, f0, file->path, rows, found, why);
    gonio_free(&points);
    return good;
}

/* ---- the source ---------------------------------------------------------------------------------- */

/* "--height surface.pfm --cutoff 8 (crc32 ...)"; 0 after a complaint. */
static int describe(const measured_file *file, const measured_words *given, const char *option,
                    vndf_source *source)
{
    char text[DESCRIPTION_MAX + 2] = "", end[32];
    const words name = {{file->path}, 1};
    vndf_error error = {VNDF_OK, ""};
    source_text_add(option, &name, text, sizeof text);
    for (size_t i = 0; i < RIDERS; i++)
        source_text_add(riders[i].option, at(given, riders[i].values), text, sizeof text);
    snprintf(end, sizeof end, " (crc32 %08lx)", (unsigned long)vndf_crc32(0, file->bytes, file->size));
    if (strlen(text) + strlen(end) < sizeof text)
        strcat(text, end);
    if (vndf_source_describe(source, text, &error) == VNDF_OK)
        return 1;
    complain(file->command, "%.100s: %s", file->path, error.message);
    return 0;
}

/* The rows of a source that says what it is, to --profile; 0 after a complaint. */
static int write_profile(const measured_file *file, const char *path, const profile *rows,
                         const vndf_source *source)
{
    output_file output;
    if (!path)
        return 1;
    if (!output_open(&output, file->command, path))
        return 0;
    if (profile_write(output.file, rows, vndf_source_description(source)))
        return output_commit(&output) == STATUS_GOOD;
    output_give_up(&output, "no place on the disk");
    return 0;
}

static vndf_source *source_of(const measured_file *file, const kind *of, const measured_words *given, notes *found)
{
    profile rows = {VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, NULL, NULL, 0, NULL};
    refusal why = {""};
    vndf_source *source = NULL;
    if (of->read(file, given, &rows, found, &why))
        source = profile_source(&rows, file->path, &why);
    if (!source && why.message[0])
        complain(file->command, "%s", why.message);
    if (source && (!describe(file, given, of->option, source) ||
                   !write_profile(file, only_word(&given->profile), &rows, source))) {
        vndf_source_free(source);
        source = NULL;
    }
    profile_free(&rows);
    return source;
}

vndf_source *measured_source(const char *command, const measured_words *given, notes *found)
{
    const kind *of = kind_given(given);
    measured_file file = {command, only_word(at(given, of->file)), NULL, 0};
    char reason[128];
    file.bytes = files_read(file.path, BYTES_MAX, &file.size, reason, sizeof reason);
    if (!file.bytes) {
        complain(command, "%s: %s", file.path, reason);
        return NULL;
    }
    vndf_source *source = source_of(&file, of, given, found);
    free(file.bytes);
    return source;
}
