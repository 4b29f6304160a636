#include "commands/parts/build_measured.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "cli/output.h"
#include "cli/source_words.h"
#include "command.h"
#include "core/checksum.h"
#include "measured/brdf.h"
#include "measured/surface.h"

enum { BYTES_MAX = 1 << 28, DESCRIPTION_MAX = VNDF_LIMIT_NAME_LENGTH };

const char measured_help[] =
    "From measurements (tools/measured/README.md says what is assumed of each). What was found is printed with the\n"
    "table: errors, residuals that say how well D explains the data, and for stretched surfaces the matrix of the\n"
    "lobe that they are: vndf sample --lobe 'table=FILE matrix=XX,XY,YX,YY'.\n"
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
    "example: vndf build --rgl leather.bsdf -o leather.vndf\n"
    "         vndf build --merl gold-paint.binary --channel red -o gold-paint.vndf\n"
    "         vndf build --height surface.pfm --step 0.5 --cutoff 8 -o surface.vndf\n";

/* ---- words --------------------------------------------------------------------------------------- */

/* Makes rows of a file; 0 after a complaint, or with the reason in the file. */
typedef int reader(const char *command, const measured_words *given, data_file *file, profile *rows);

static reader read_merl, read_rgl, read_height, read_normal_map;

static const struct {
    const char *option;
    size_t words; /* where they are in measured_words */
    reader *read;
} kinds[] = {
    {"--merl", offsetof(measured_words, merl), read_merl},
    {"--rgl", offsetof(measured_words, rgl), read_rgl},
    {"--height", offsetof(measured_words, height), read_height},
    {"--normal-map", offsetof(measured_words, normal_map), read_normal_map},
};

/* Options that go with one kind of file. */
static const struct {
    const char *option;
    size_t words;
    const char *with;
} riders[] = {
    {"--step", offsetof(measured_words, step), "--height"},
    {"--cutoff", offsetof(measured_words, cutoff), "--height"},
    {"--channel", offsetof(measured_words, channel), "--merl"},
};

enum { KINDS = sizeof kinds / sizeof kinds[0], RIDERS = sizeof riders / sizeof riders[0] };

static const words *at(const measured_words *given, size_t offset)
{
    return (const words *)(const void *)((const char *)given + offset);
}

/* The index of the kind that was given, or KINDS. */
static size_t kind_given(const measured_words *given)
{
    size_t i = 0;
    while (i < KINDS && !at(given, kinds[i].words)->count)
        i++;
    return i;
}

size_t measured_words_count(const measured_words *given)
{
    size_t count = 0;
    for (size_t i = 0; i < KINDS; i++)
        count += at(given, kinds[i].words)->count;
    return count;
}

int measured_words_check(const char *command, const measured_words *given)
{
    size_t kind = kind_given(given);
    const char *written = only_word(&given->profile);
    for (size_t i = 0; i < RIDERS; i++)
        if (at(given, riders[i].words)->count &&
            (kind == KINDS || strcmp(kinds[kind].option, riders[i].with) != 0))
            return complain(command, "%s is for %s", riders[i].option, riders[i].with);
    if (written && kind == KINDS)
        return complain(command, "--profile is for files of measurements");
    if (written && output_is_stdout(written))
        return complain(command, "--profile '-': a file is needed");
    return PARSE_GO_ON;
}

/* ---- readers ------------------------------------------------------------------------------------- */

static int read_height(const char *command, const measured_words *given, data_file *file, profile *rows)
{
    unsigned long long cutoff = 0;
    double step[2];
    size_t steps = 0;
    height_field field;
    slope_set slopes;
    if (!option_count(command, "--cutoff", &given->cutoff, 2, CUTOFF_MAX, &cutoff))
        return 0;
    if (given->step.count)
        steps = parse_numbers(command, "--step", only_word(&given->step), 1e-30, 1e30, 1, 2, step);
    if ((given->step.count && !steps) || !heights_read(file, &field))
        return 0;
    if (steps) {
        field.step_x = step[0];
        field.step_y = step[steps - 1];
    }
    note(file, "heights %d x %d, %.6g x %.6g apart", field.width, field.height, field.step_x, field.step_y);
    if (cutoff)
        note(file, "cutoff %llu", cutoff);
    int good =
        !cutoff || heights_smooth(&field, (int)cutoff) || refuse(file, "there is no memory for the cut-off");
    good = good && heights_slopes(&field, (int)cutoff / 2, &slopes, file);
    heights_free(&field);
    if (!good)
        return 0;
    good = slopes_law(&slopes, file, rows);
    slopes_free(&slopes);
    return good;
}

static int read_normal_map(const char *command, const measured_words *given, data_file *file, profile *rows)
{
    slope_set slopes;
    (void)command, (void)given;
    if (!normals_slopes(file, &slopes))
        return 0;
    int good = slopes_law(&slopes, file, rows);
    slopes_free(&slopes);
    return good;
}

static int read_rgl(const char *command, const measured_words *given, data_file *file, profile *rows)
{
    (void)command, (void)given;
    return rgl_read(file, rows);
}

static int read_merl(const char *command, const measured_words *given, data_file *file, profile *rows)
{
    static const char *const names[4] = {"red", "green", "blue", "luminance"};
    const char *wanted = given->channel.count ? only_word(&given->channel) : "luminance";
    for (int i = 0; i < 4; i++)
        if (strcmp(wanted, names[i]) == 0)
            return merl_read(file, (merl_channel)i, rows);
    complain(command, "--channel '%s' is none of red, green, blue and luminance", wanted);
    return 0;
}

/* ---- the source ---------------------------------------------------------------------------------- */

/* "--height surface.pfm --cutoff 8 (crc32 ...)"; 0 after a complaint. */
static int describe(const char *command, const measured_words *given, const data_file *file, vndf_source *source)
{
    char text[DESCRIPTION_MAX + 2] = "", end[32];
    const words name = {{file->name}, 1};
    vndf_error error = {VNDF_OK, ""};
    source_text_add(kinds[kind_given(given)].option, &name, text, sizeof text);
    for (size_t i = 0; i < RIDERS; i++)
        source_text_add(riders[i].option, at(given, riders[i].words), text, sizeof text);
    snprintf(end, sizeof end, " (crc32 %08lx)", (unsigned long)vndf_crc32(0, file->bytes, file->size));
    if (strlen(text) + strlen(end) < sizeof text)
        strcat(text, end);
    if (vndf_source_describe(source, text, &error) == VNDF_OK)
        return 1;
    complain(command, "%.100s: %s", file->name, error.message);
    return 0;
}

/* The rows of a source that says what it is, to --profile; 0 after a complaint. */
static int write_profile(const char *command, const char *path, const profile *rows, const vndf_source *source)
{
    output_file output;
    if (!path)
        return 1;
    if (!output_open(&output, command, path))
        return 0;
    if (profile_write(output.file, rows, vndf_source_description(source)))
        return output_commit(&output) == STATUS_GOOD;
    output_give_up(&output, "no place on the disk");
    return 0;
}

static vndf_source *source_of(const char *command, const measured_words *given, data_file *file)
{
    profile rows = {0};
    vndf_source *source = NULL;
    if (kinds[kind_given(given)].read(command, given, file, &rows))
        source = profile_source(&rows, file);
    if (!source && file->refused[0])
        complain(command, "%s", file->refused);
    const char *implausible = strstr(file->notes, "implausible ");
    if (source && implausible)
        complain(command, "%s: %.*s", file->name, (int)strcspn(implausible, "\n"), implausible);
    if (source && (!describe(command, given, file, source) ||
                   !write_profile(command, only_word(&given->profile), &rows, source))) {
        vndf_source_free(source);
        source = NULL;
    }
    profile_free(&rows);
    return source;
}

vndf_source *measured_source(const char *command, const measured_words *given, char found[MEASURED_NOTES])
{
    data_file file = {.name = only_word(at(given, kinds[kind_given(given)].words))};
    char reason[128];
    char *bytes = files_read(file.name, BYTES_MAX, &file.size, reason, sizeof reason);
    if (!bytes) {
        complain(command, "%s: %s", file.name, reason);
        return NULL;
    }
    file.bytes = (const unsigned char *)bytes;
    vndf_source *source = source_of(command, given, &file);
    memcpy(found, file.notes, MEASURED_NOTES);
    free(bytes);
    return source;
}
