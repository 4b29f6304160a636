#include "source_words.h"

#include <string.h>

#include "command.h"

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
    if (given->ndf.count)
        return vndf_source_ndf_expression(only_word(&given->ndf), parameters, given->set.count, error);
    return vndf_source_slope_expression(only_word(&given->slope), parameters, given->set.count, error);
}

vndf_source *source_from_words(const char *command, const source_words *given)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source;
    if (given->csv.count)
        source = vndf_source_csv_file(only_word(&given->csv), &error);
    else if (given->family.count)
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
