#include "commands/parts/build_family.h"

#include <stdlib.h>
#include <string.h>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/subject.h"
#include "command.h"
#include "commands/describe.h"
#include "vndf_build.h"

enum { RANGE_LENGTH = 64 };

/* "1.6..6" */
static int read_range(const char *command, const char *text, double range[2])
{
    char low[RANGE_LENGTH];
    const char *dots = strstr(text, "..");
    size_t length = dots ? (size_t)(dots - text) : sizeof low;
    if (length >= sizeof low) {
        complain(command, "--parameter '%.64s' is not LOW..HIGH, as in 1.6..6", text);
        return 0;
    }
    memcpy(low, text, length);
    low[length] = '\0';
    return parse_numbers(command, "--parameter", low, -1e30, 1e30, 1, 1, &range[0]) &&
           parse_numbers(command, "--parameter", dots + 2, -1e30, 1e30, 1, 1, &range[1]);
}

static int read_options(const char *command, const family_words *given, vndf_family_options *options)
{
    unsigned long long bytes = 0, knots = 0, moments = 0;
    if (!option_count(command, "--max-bytes", &given->bytes, 2048, 1048576, &bytes) ||
        !option_number(command, "--max-tv", &given->distance, 1e-12, 1, &options->max_distance) ||
        !option_count(command, "--knots", &given->knots, 2, VNDF_LIMIT_FAMILY_KNOTS, &knots) ||
        !option_count(command, "--moments", &given->moments, 2, 4, &moments))
        return 0;
    options->max_bytes = (size_t)bytes;
    options->moments = (int)moments;
    options->knots = (size_t)knots;
    return 1;
}

static vndf_family *build(const char *command, const family_words *given, unsigned held)
{
    vndf_family_options options = {0};
    vndf_error error = {VNDF_OK, ""};
    double range[2];
    progress p = progress_begin("building", held);
    if (!read_range(command, only_word(&given->parameter), range) || !read_options(command, given, &options))
        return NULL;
    options.progress = progress_show;
    options.progress_user = &p;
    vndf_family *family = vndf_build_family(only_word(&given->family), range[0], range[1], &options, &error);
    progress_end(&p);
    if (!family && output_stopping(held))
        complain(command, "%s; '%s' was not touched", error.message, only_word(&given->output));
    else if (!family)
        complain(command, "%s", error.message);
    return family;
}

static int save_to_stdout(const char *command, const vndf_family *family)
{
    vndf_error error = {VNDF_OK, ""};
    size_t size = vndf_family_info(family).bytes;
    void *bytes = malloc(size);
    int good = bytes && vndf_family_save_memory(family, bytes, size, &error) == VNDF_OK;
    if (good)
        fwrite(bytes, 1, size, stdout);
    free(bytes);
    return good ? output_finish_stdout(command) : complain(command, "no memory for the family");
}

static int save(const char *command, const vndf_family *family, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    if (output_is_stdout(path))
        return save_to_stdout(command, family);
    if (vndf_family_save(family, path, &error) != VNDF_OK)
        return complain(command, "%s", error.message);
    describe_family(family);
    return STATUS_GOOD;
}

int build_family(const char *command, const family_words *given, unsigned held)
{
    const char *path = only_word(&given->output);
    if (!output_is_stdout(path) && !is_family_file(path))
        return complain(command, "'%s' has to end in .vndfs: a family of tables is known by that", path);
    if (!output_replaceable(command, path))
        return STATUS_USE;
    vndf_family *family = build(command, given, held);
    if (!family)
        return STATUS_USE;
    int status = save(command, family, path);
    vndf_family_free(family);
    return status;
}
