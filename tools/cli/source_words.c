#include "cli/source_words.h"

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
    return given->ndf.count ? vndf_source_ndf_expression(formula, parameters, given->set.count, error)
                            : vndf_source_slope_expression(formula, parameters, given->set.count, error);
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
    if (!source && error.status != VNDF_OK)
        complain(command, "%s", error.message);
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

typedef struct text_end {
    char *at, *end; /* end: of the buffer, where the zero may stand at last */
} text_end;

static void put(text_end *t, char letter)
{
    if (t->at < t->end)
        *t->at++ = letter;
}

static void put_text(text_end *t, const char *text)
{
    while (*text)
        put(t, *text++);
}

/* Between quotes where a shell would make something else of it. */
static void put_word(text_end *t, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+.,:/=_";
    if (*word && strspn(word, plain) == strlen(word)) {
        put_text(t, word);
        return;
    }
    put(t, '\'');
    for (; *word; word++)
        if (*word == '\'')
            put_text(t, "'\\''");
        else
            put(t, *word);
    put(t, '\'');
}

static void put_option(text_end *t, const char *option, const words *values)
{
    for (size_t i = 0; i < values->count; i++) {
        put_text(t, option);
        put_word(t, values->item[i]);
    }
}

void source_text(const source_words *given, char *text, size_t size)
{
    text_end t = {text, text + size - 1};
    put_option(&t, "--ndf ", &given->ndf);
    put_option(&t, "--slope ", &given->slope);
    put_option(&t, "--csv ", &given->csv);
    put_option(&t, "--family ", &given->family);
    put_option(&t, " --set ", &given->set);
    *t.at = '\0';
}

void source_text_add(const char *option, const words *values, char *text, size_t size)
{
    text_end t = {text + strlen(text), text + size - 1};
    for (size_t i = 0; i < values->count; i++) {
        if (t.at > text)
            put(&t, ' ');
        put_text(&t, option);
        if (strcmp(values->item[i], option) == 0) /* a flag */
            continue;
        put(&t, ' ');
        put_word(&t, values->item[i]);
    }
    *t.at = '\0';
}

void source_text_name(const source_words *given, char *text, size_t size)
{
    const words *all[] = {&given->ndf, &given->slope, &given->csv, &given->family};
    text_end t = {text, text + size - 1};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i]->count)
            put_text(&t, only_word(all[i]));
    for (size_t i = 0; i < given->set.count; i++) {
        put_text(&t, ", ");
        put_text(&t, given->set.item[i]);
    }
    *t.at = '\0';
}

/* ---- as a table ---- */

vndf_distribution *table_from_words(const char *command, const source_words *given, char *name, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = source_from_words(command, given);
    if (!source)
        return NULL;
    vndf_distribution *table = vndf_build(source, NULL, NULL, &error);
    vndf_source_free(source);
    if (!table)
        complain(command, "%s", error.message);
    source_text_name(given, name, size);
    return table;
}
