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

/* Makes rows of a file; 0 after a complaint, or with the reason in the file. */
typedef int reader(const arguments *given, data_file *file, profile *rows);

static reader read_merl, read_rgl, read_height, read_normal_map;

static const struct {
    const char *option;
    reader *read;
    const char *with[3]; /* the options that go with it alone */
} kinds[] = {
    {"--merl", read_merl, {"--channel"}},
    {"--rgl", read_rgl, {NULL}},
    {"--height", read_height, {"--step", "--cutoff"}},
    {"--normal-map", read_normal_map, {NULL}},
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* Of the kind that was given; KINDS: none. */
static size_t kind_given(const arguments *given)
{
    size_t i = 0;
    while (i < KINDS && !option_value(given, kinds[i].option))
        i++;
    return i;
}

size_t measured_count(const arguments *given)
{
    size_t count = 0;
    for (size_t i = 0; i < KINDS; i++)
        count += option_value(given, kinds[i].option) != NULL;
    return count;
}

int measured_check(const arguments *given)
{
    const size_t kind = kind_given(given);
    const char *written = option_value(given, "--profile"), *path = option_value(given, "-o");
    for (size_t i = 0; i < KINDS; i++) {
        const char *lost = i == kind ? NULL : option_among(given, kinds[i].with);
        if (lost)
            return complain(given->command, "%s is for %s", lost, kinds[i].option), 0;
    }
    if (written && kind == KINDS)
        return complain(given->command, "--profile is for files of measurements"), 0;
    if (written && output_is_stdout(written))
        return complain(given->command, "--profile '-': a file is needed"), 0;
    if (written && path && files_same(written, path))
        return complain(given->command, "-o and --profile both name '%s'", written), 0;
    return 1;
}

/* ---- readers ------------------------------------------------------------------------------------- */

static int read_height(const arguments *given, data_file *file, profile *rows)
{
    const char *apart = option_value(given, "--step");
    unsigned long long cutoff = 0;
    double step[2];
    size_t steps = 0;
    height_field field;
    slope_set slopes;
    if (!option_count(given, "--cutoff", 2, CUTOFF_MAX, &cutoff))
        return 0;
    if (apart)
        steps = parse_numbers(given->command, "--step", apart, 1e-30, 1e30, 1, 2, step);
    if ((apart && !steps) || !heights_read(file, &field))
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

static int read_normal_map(const arguments *given, data_file *file, profile *rows)
{
    slope_set slopes;
    (void)given;
    if (!normals_slopes(file, &slopes))
        return 0;
    int good = slopes_law(&slopes, file, rows);
    slopes_free(&slopes);
    return good;
}

static int read_rgl(const arguments *given, data_file *file, profile *rows)
{
    (void)given;
    return rgl_read(file, rows);
}

static int read_merl(const arguments *given, data_file *file, profile *rows)
{
    return merl_read(file, (merl_channel)option_choice(given, "--channel", MERL_LUMINANCE), rows);
}

/* ---- the source ---------------------------------------------------------------------------------- */

/* "--height surface.pfm --cutoff 8 (crc32 ...)"; 0 after a complaint. */
static int describe(const arguments *given, const data_file *file, vndf_source *source)
{
    const size_t kind = kind_given(given);
    char text[DESCRIPTION_MAX + 2] = "", end[32];
    vndf_error error = {VNDF_OK, ""};
    source_text_add(given, kinds[kind].option, text, sizeof text);
    for (const char *const *with = kinds[kind].with; *with; with++)
        source_text_add(given, *with, text, sizeof text);
    snprintf(end, sizeof end, " (crc32 %08lx)", (unsigned long)vndf_crc32(0, file->bytes, file->size));
    if (strlen(text) + strlen(end) < sizeof text)
        strcat(text, end);
    if (vndf_source_describe(source, text, &error) == VNDF_OK)
        return 1;
    complain(given->command, "%.100s: %s", file->name, error.message);
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

static vndf_source *source_of(const arguments *given, data_file *file)
{
    const char *command = given->command, *implausible;
    profile rows = {0};
    vndf_source *source = NULL;
    if (kinds[kind_given(given)].read(given, file, &rows))
        source = profile_source(&rows, file);
    if (!source && file->refused[0])
        complain(command, "%s", file->refused);
    if (source && (implausible = strstr(file->notes, "implausible ")) != NULL)
        complain(command, "%s: %.*s", file->name, (int)strcspn(implausible, "\n"), implausible);
    if (source && (!describe(given, file, source) ||
                   !write_profile(command, option_value(given, "--profile"), &rows, source))) {
        vndf_source_free(source);
        source = NULL;
    }
    profile_free(&rows);
    return source;
}

vndf_source *measured_source(const arguments *given, char found[MEASURED_NOTES])
{
    data_file file = {.name = option_value(given, kinds[kind_given(given)].option)};
    char *bytes = input_read(given->command, file.name, BYTES_MAX, &file.size);
    if (!bytes)
        return NULL;
    file.bytes = (const unsigned char *)bytes;
    vndf_source *source = source_of(given, &file);
    memcpy(found, file.notes, MEASURED_NOTES);
    free(bytes);
    return source;
}
