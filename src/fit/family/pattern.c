#include "fit/family/pattern.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "source/number.h"
#include "source/words.h"

static const char PLACE[] = "{p}";

double vndf_pattern_number(double p)
{
    char text[VNDF_NUMBER_TEXT];
    snprintf(text, sizeof text, "%.6e", p);
    return strtod(text, NULL);
}

vndf_status vndf_pattern_check(const char *pattern, vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    if (!pattern)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the family's name is NULL");
    if (strlen(pattern) > VNDF_LIMIT_FAMILY_LENGTH)
        return vndf_fail(error, VNDF_ERROR_SYNTAX, "the family's name has %lu characters; at most %d are possible",
                         (unsigned long)strlen(pattern), VNDF_LIMIT_FAMILY_LENGTH);
    if (strchr(pattern, ':') && !strstr(pattern, PLACE))
        return vndf_fail(error, VNDF_ERROR_SYNTAX,
                         "'%s' does not say where the parameter stands; right would be {p} in its place, as in "
                         "abc:{p},0.8, or a name alone, as in student-t",
                         vndf_excerpt(excerpt, pattern, strlen(pattern)));
    return VNDF_OK;
}

/* The pattern with the number in its places. */
static void add_filled(vndf_text *text, const char *pattern, const char *number)
{
    const char *place;
    char piece[2] = "";
    while ((place = strstr(pattern, PLACE)) != NULL) {
        for (; pattern < place; pattern++) {
            piece[0] = *pattern;
            vndf_text_add(text, piece);
        }
        vndf_text_add(text, number);
        pattern = place + strlen(PLACE);
    }
    vndf_text_add(text, pattern);
}

vndf_source *vndf_pattern_source(const char *pattern, double p, vndf_error *error)
{
    char number[VNDF_NUMBER_TEXT];
    vndf_text text = {NULL, 0, 0, 0};
    vndf_number_print(number, p);
    add_filled(&text, pattern, number);
    if (!strchr(pattern, ':') && !strstr(pattern, PLACE)) {
        vndf_text_add(&text, ":");
        vndf_text_add(&text, number);
    }
    char *specification = vndf_text_finish(&text, error);
    vndf_source *source = specification ? vndf_source_family(specification, error) : NULL;
    free(specification);
    return source;
}

char *vndf_pattern_describe(const char *pattern, double low, double high, vndf_error *error)
{
    char number[VNDF_NUMBER_TEXT];
    vndf_text text = {NULL, 0, 0, 0};
    vndf_text_add_word(&text, "--family");
    vndf_text_add_word(&text, pattern);
    vndf_text_add_word(&text, "--parameter");
    vndf_text_add_word(&text, vndf_number_print(number, low));
    vndf_text_add(&text, "..");
    vndf_text_add(&text, vndf_number_print(number, high));
    return vndf_text_finish(&text, error);
}
