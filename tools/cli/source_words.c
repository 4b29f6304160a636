#include "cli/source_words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "cli/files.h"

enum { NAME_MAX_LENGTH = VNDF_LIMIT_PARAMETER_NAME + 1 };

/* "a=0.3" into a parameter whose name is kept in `storage`; the library judges the name itself. */
static int read_parameter(const char *command, const char *text, char storage[NAME_MAX_LENGTH],
                          vndf_parameter *parameter)
{
    const char *equals = strchr(text, '=');
    size_t length = equals ? (size_t)(equals - text) : 0;
    if (length == 0 || length >= NAME_MAX_LENGTH) {
        complain(command, "--set '%s' is not NAME=NUMBER", text);
        return 0;
    }
    memcpy(storage, text, length);
    storage[length] = '\0';
    parameter->name = storage;
    return parse_numbers(command, "--set", equals + 1, -1e300, 1e300, 1, 1, &parameter->value) == 1;
}

vndf_source *source_from_csv(const char *command, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    size_t size;
    char *text = input_read(command, path, VNDF_LIMIT_CSV_BYTES, &size);
    vndf_source *source = text ? vndf_source_csv_text(input_name(path), text, size, &error) : NULL;
    if (text && !source)
        complain(command, "%s", error.message);
    free(text);
    return source;
}

static const char *const kinds[] = {"--ndf", "--slope", "--csv", "--family", NULL};

size_t source_words_count(const arguments *given)
{
    size_t count = 0;
    for (const char *const *kind = kinds; *kind; kind++)
        count += option_value(given, *kind) != NULL;
    return count;
}

vndf_source *source_from_words(const arguments *given, const char *otherwise)
{
    const char *command = given->command, *ndf = option_value(given, "--ndf"), *csv = option_value(given, "--csv");
    const char *slope = option_value(given, "--slope"), *family = option_value(given, "--family");
    const words set = option_values(given, "--set");
    const size_t count = source_words_count(given);
    vndf_parameter parameters[WORDS_MAX];
    char names[WORDS_MAX][NAME_MAX_LENGTH];
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source;
    if (count > 1 || (count == 0 && !otherwise))
        return complain(command, "%s of --ndf, --slope, --csv and --family; %s is needed",
                        count ? "more than one" : "none", otherwise ? "one at most" : "exactly one"),
               NULL;
    if (set.count && !ndf && !slope)
        return complain(command, "--set is for --ndf and --slope; the parameters of a family follow its name"),
               NULL;
    if (csv)
        return source_from_csv(command, csv);
    for (size_t i = 0; i < set.count; i++)
        if (!read_parameter(command, set.item[i], names[i], &parameters[i]))
            return NULL;
    const char *option = ndf ? "--ndf" : slope ? "--slope" : "--family";
    if (ndf)
        source = vndf_source_ndf_expression(ndf, parameters, set.count, &error);
    else if (slope)
        source = vndf_source_slope_expression(slope, parameters, set.count, &error);
    else
        source = vndf_source_family(family ? family : otherwise, &error);
    if (!source) {
        complain(command, "%s: %s", option, error.message);
        if (strstr(error.message, "unknown name") && !strstr(error.message, "did you mean"))
            complain(command, "a parameter of your own has its value by --set NAME=X");
    }
    return source;
}

/* ---- as text ------------------------------------------------------------------------------------- */

/* Adds what fits. */
static void add(char *text, size_t size, const char *more)
{
    size_t at = strlen(text);
    snprintf(text + at, size - at, "%s", more);
}

void source_text_add(const arguments *given, const char *option, char *text, size_t size)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+.,:/=_";
    const words values = option_values(given, option);
    for (size_t i = 0; i < values.count; i++) {
        const char *word = values.item[i];
        const char *quote = *word && strspn(word, plain) == strlen(word) ? "" : "'";
        add(text, size, *text ? " " : "");
        add(text, size, option);
        if (strcmp(word, option) == 0) /* a flag */
            continue;
        add(text, size, " ");
        add(text, size, quote);
        for (; *word; word++)
            add(text, size, *word == '\'' ? "'\\''" : (const char[2]){*word, '\0'});
        add(text, size, quote);
    }
}

void source_text_name(const arguments *given, char *text, size_t size)
{
    const words set = option_values(given, "--set");
    text[0] = '\0';
    for (const char *const *kind = kinds; *kind; kind++)
        add(text, size, option_value(given, *kind) ? option_value(given, *kind) : "");
    for (size_t i = 0; i < set.count; i++) {
        add(text, size, ", ");
        add(text, size, set.item[i]);
    }
}
