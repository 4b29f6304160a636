/* Reads provenance back, and lets programs bring words of their own. Descriptions come from table files, so they are
 * not trusted: every word is checked. */
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "source/source.h"
#include "source/words.h"

/* ---- the source ---------------------------------------------------------------------------------- */

/* "--set a=0.3" and so on, behind the first two words; the '=' becomes the end of the name. */
static vndf_status read_settings(const vndf_words *words, vndf_parameter *parameters, size_t *count,
                                 vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    for (size_t i = 2; i < words->count; i += 2) {
        char *word = words->word[i], *setting = i + 1 < words->count ? words->word[i + 1] : NULL;
        char *equals = setting ? strchr(setting, '=') : NULL;
        if (strcmp(word, "--set") != 0 || !setting)
            return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                             "'%s' in a table's source: right would be --set NAME=NUMBER",
                             vndf_excerpt(excerpt, word, strlen(word)));
        if (*count >= VNDF_LIMIT_PARAMETERS)
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "more than %d parameters", VNDF_LIMIT_PARAMETERS);
        parameters[*count].name = setting;
        if (!equals || !vndf_number_is_all(equals + 1, strlen(equals + 1), &parameters[(*count)++].value))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "--set '%s': right would be NAME=NUMBER, as in a=0.3",
                             vndf_excerpt(excerpt, setting, strlen(setting)));
        *equals = '\0';
    }
    return VNDF_OK;
}

enum option { NDF, SLOPE, FAMILY, OTHER };

static enum option option_of(const vndf_words *words)
{
    static const char *const options[OTHER] = {"--ndf", "--slope", "--family"};
    int i = 0;
    while (i < OTHER && (words->count < 2 || strcmp(words->word[0], options[i]) != 0))
        i++;
    return (enum option)i;
}

static vndf_source *make(enum option option, const vndf_words *words, vndf_error *error)
{
    vndf_parameter parameters[VNDF_LIMIT_PARAMETERS];
    size_t count = 0;
    if (read_settings(words, parameters, &count, error) != VNDF_OK)
        return NULL;
    if (option != FAMILY)
        return (option == NDF ? vndf_source_ndf_expression
                              : vndf_source_slope_expression)(words->word[1], parameters, count, error);
    if (count == 0)
        return vndf_source_family(words->word[1], error);
    vndf_fail(error, VNDF_ERROR_ARGUMENT, "--family takes no --set");
    return NULL;
}

vndf_source *vndf_source_from_description(const char *description, vndf_error *error)
{
    vndf_words words;
    vndf_source *source = NULL;
    char excerpt[VNDF_EXCERPT];
    if (vndf_words_split(description, &words, error) != VNDF_OK)
        return NULL;
    enum option option = option_of(&words);
    if (option != OTHER)
        source = make(option, &words, error);
    else
        vndf_fail(error, VNDF_ERROR_ARGUMENT,
                  "the source was '%s', and a table keeps only its name, not the file or function; "
                  "sources by --ndf, --slope and --family can be made again, for others bring the source itself",
                  vndf_excerpt(excerpt, description, strlen(description)));
    vndf_words_free(&words);
    return source;
}

/* ---- other words --------------------------------------------------------------------------------- */

vndf_status vndf_source_describe(vndf_source *source, const char *text, vndf_error *error)
{
    vndf_words words;
    vndf_error inner = {VNDF_OK, ""};
    size_t length = text ? strlen(text) : 0, printable = 0;
    if (!source || !text)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the %s is NULL", source ? "description" : "source");
    if (source->rebuildable)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the description '%.100s' makes this source again; it stays",
                         source->description);
    if (length == 0 || length > VNDF_LIMIT_NAME_LENGTH)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a description of %zu characters; 1 to %d are possible",
                         length, VNDF_LIMIT_NAME_LENGTH);
    while ((unsigned char)text[printable] >= 32 && text[printable] != 127)
        printable++;
    if (printable < length)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "column %zu of the description: a control character",
                         printable + 1);
    if (vndf_words_split(text, &words, &inner) != VNDF_OK)
        return vndf_fail(error, inner.status == VNDF_ERROR_MEMORY ? inner.status : VNDF_ERROR_ARGUMENT,
                         "the description, %s", inner.message);
    int taken = option_of(&words) != OTHER;
    vndf_words_free(&words);
    if (taken)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "the description begins as that of a formula or a family does, which it is not");
    vndf_writer copy = {NULL, 0, 0, 0};
    vndf_text_add(&copy, text);
    char *description = vndf_text_finish(&copy, error);
    if (!description)
        return VNDF_ERROR_MEMORY;
    free(source->description);
    source->description = description;
    return VNDF_OK;
}

vndf_source *vndf_source_of(const vndf_distribution *distribution, vndf_error *error)
{
    const char *description = distribution ? vndf_distribution_info(distribution).source : NULL;
    if (description)
        return vndf_source_from_description(description, error);
    vndf_fail(error, VNDF_ERROR_ARGUMENT, "the distribution is NULL or does not say what it was built from");
    return NULL;
}
