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

static vndf_source *source_from_expression(const char *command, const source_words *given, vndf_error *error)
{
    vndf_parameter parameters[WORDS_MAX];
    char names[WORDS_MAX][NAME_MAX_LENGTH];
    for (size_t i = 0; i < given->set.count; i++)
        if (!read_parameter(command, given->set.item[i], names[i], &parameters[i]))
            return NULL;
    const char *formula = only_word(given->ndf.count ? &given->ndf : &given->slope);
    vndf_source *source = given->ndf.count
                              ? vndf_source_ndf_expression(formula, parameters, given->set.count, error)
                              : vndf_source_slope_expression(formula, parameters, given->set.count, error);
    return source;
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

vndf_source *source_from_words(const char *command, const source_words *given)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source;
    if (given->csv.count)
        return source_from_csv(command, only_word(&given->csv));
    if (given->family.count)
        source = vndf_source_family(only_word(&given->family), &error);
    else
        source = source_from_expression(command, given, &error);
    if (!source && error.status != VNDF_OK) {
        complain(command, "%s", error.message);
        if (strstr(error.message, "unknown name") && !strstr(error.message, "did you mean"))
            complain(command, "a parameter of your own has its value by --set NAME=X");
    }
    return source;
}

size_t source_words_count(const source_words *given)
{
    return given->ndf.count + given->slope.count + given->csv.count + given->family.count;
}

int source_words_check_set(const char *command, const source_words *given)
{
    if (given->set.count && !given->ndf.count && !given->slope.count)
        return complain(command, "--set is for --ndf and --slope; the parameters of a family follow its name");
    return PARSE_GO_ON;
}

/* ---- as text ------------------------------------------------------------------------------------- */

/* Adds what fits. */
static void add(char *text, size_t size, const char *more)
{
    size_t at = strlen(text);
    snprintf(text + at, size - at, "%s", more);
}

/* Between quotes where a shell would make something else of it. */
static void add_word(char *text, size_t size, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+.,:/=_";
    const int is_plain = *word && strspn(word, plain) == strlen(word);
    add(text, size, is_plain ? "" : "'");
    for (; *word; word++) {
        const char letter[2] = {*word, '\0'};
        add(text, size, *word == '\'' ? "'\\''" : letter);
    }
    add(text, size, is_plain ? "" : "'");
}

void source_text_add(const char *option, const words *values, char *text, size_t size)
{
    for (size_t i = 0; i < values->count; i++) {
        add(text, size, *text ? " " : "");
        add(text, size, option);
        if (strcmp(values->item[i], option) == 0) /* a flag */
            continue;
        add(text, size, " ");
        add_word(text, size, values->item[i]);
    }
}

void source_text_name(const source_words *given, char *text, size_t size)
{
    const words *all[] = {&given->ndf, &given->slope, &given->csv, &given->family};
    text[0] = '\0';
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        add(text, size, all[i]->count ? only_word(all[i]) : "");
    for (size_t i = 0; i < given->set.count; i++) {
        add(text, size, ", ");
        add(text, size, given->set.item[i]);
    }
}
