/* The calls that all kinds of source have in common; sources given by a C function; descriptions, which are read back
 * and which programs may replace. Descriptions come from table files, so they are not trusted. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "source/source.h"
#include "source/words.h"
#include "table/table.h"

double vndf_source_p22(const vndf_source *source, double r)
{
    double value = 0.0;
    if (source)
        source->p22(source, &r, 1, &value);
    return value;
}

const char *vndf_source_description(const vndf_source *source)
{
    return source ? source->description : "";
}

void vndf_source_free(vndf_source *source)
{
    if (!source)
        return;
    free(source->notes);
    source->destroy(source);
}

/* ---- functions: P22(r), or D(cos theta) with P22(r) = D(c) c^4, c = 1/sqrt(1 + r^2) ---------------------------- */

enum { OPERATIONS = 8 }; /* the cost of a call, whatever it does: a guess */

typedef struct callback_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_density_function *density;
    void *user;
    int is_ndf;
} callback_source;

static void p22(const vndf_source *self, const double *r, size_t count, double *values)
{
    const callback_source *source = (const callback_source *)self;
    for (size_t i = 0; i < count; i++) {
        double c = 1 / hypot(1, r[i]), c2 = c * c;
        values[i] =
            source->is_ndf ? source->density(c, source->user) * c2 * c2 : source->density(r[i], source->user);
    }
}

static void destroy(vndf_source *self)
{
    free(self->description);
    free(self);
}

/* `vndf build` has no such option, since a shell cannot bring a function. It says what the table came from. */
static vndf_source *make(int is_ndf, vndf_density_function *density, void *user, const char *name,
                         vndf_error *error)
{
    if (!density)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the callback is NULL; a function is needed"), NULL;
    char *description = vndf_text_pair(is_ndf ? "--ndf-callback" : "--slope-callback", name, "", error);
    callback_source *source = description ? malloc(sizeof *source) : NULL;
    if (source) {
        *source = (callback_source){
            {.p22 = p22, .destroy = destroy, .description = description, .operations = OPERATIONS},
            density,
            user,
            is_ndf};
        return &source->base;
    }
    if (description)
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
    free(description);
    return NULL;
}

vndf_source *vndf_source_ndf_callback(vndf_density_function *ndf, void *user, const char *name, vndf_error *error)
{
    return make(1, ndf, user, name, error);
}

vndf_source *vndf_source_slope_callback(vndf_density_function *density, void *user, const char *name,
                                        vndf_error *error)
{
    return make(0, density, user, name, error);
}

/* ---- descriptions ----------------------------------------------------------------------------------------------- */

/* Those that make the source again begin with one of these options and a word. */
enum { NDF, SLOPE, FAMILY, OTHER };
static const char *const options[OTHER] = {"--ndf", "--slope", "--family"};

static int option_of(const vndf_words *words)
{
    int i = 0;
    while (i < OTHER && (words->count < 2 || strcmp(words->word[0], options[i]) != 0))
        i++;
    return i;
}

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

vndf_source *vndf_source_from_description(const char *description, vndf_error *error)
{
    vndf_words words;
    vndf_parameter parameters[VNDF_LIMIT_PARAMETERS];
    size_t count = 0;
    vndf_source *source = NULL;
    char excerpt[VNDF_EXCERPT];
    if (vndf_words_split(description, &words, error) != VNDF_OK)
        return NULL;
    int option = option_of(&words);
    if (option == OTHER)
        vndf_fail(error, VNDF_ERROR_ARGUMENT,
                  "the source was '%s', and a table keeps only its name, not the file or function; "
                  "sources by --ndf, --slope and --family can be made again, for others bring the source itself",
                  vndf_excerpt(excerpt, description, strlen(description)));
    else if (read_settings(&words, parameters, &count, error) == VNDF_OK) {
        if (option == FAMILY && count > 0)
            vndf_fail(error, VNDF_ERROR_ARGUMENT, "--family takes no --set");
        else if (option == FAMILY)
            source = vndf_source_family(words.word[1], error);
        else
            source = (option == NDF ? vndf_source_ndf_expression
                                    : vndf_source_slope_expression)(words.word[1], parameters, count, error);
    }
    vndf_words_free(&words);
    return source;
}

vndf_source *vndf_source_of(const vndf_distribution *distribution, vndf_error *error)
{
    if (!distribution)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the distribution is NULL"), NULL;
    return vndf_source_from_description(vndf_distribution_info(distribution).source, error);
}

static vndf_status replace(char **text, const char *by, vndf_error *error)
{
    vndf_writer copy = {NULL, 0, 0, 0};
    vndf_text_add(&copy, by);
    char *own = vndf_text_finish(&copy, error);
    if (!own)
        return VNDF_ERROR_MEMORY;
    free(*text);
    *text = own;
    return VNDF_OK;
}

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
    return replace(&source->description, text, error);
}

vndf_status vndf_source_note(vndf_source *source, const char *notes, vndf_error *error)
{
    const char *why = source && notes ? vndf_notes_invalid(notes) : "a source and its notes are needed";
    if (why)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s", why);
    return replace(&source->notes, notes, error);
}
