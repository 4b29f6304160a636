#include "fit/family/pattern.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "source/family/family.h"
#include "source/words.h"

static const char PLACE[] = "{p}";

double vndf_pattern_number(double p)
{
    char text[VNDF_NUMBER_TEXT];
    snprintf(text, sizeof text, "%.6e", p);
    return strtod(text, NULL);
}

/* ---- what a pattern may be ---- */

/* The words of a specification with this name. */
static vndf_status unknown_family(const char *pattern, vndf_error *error)
{
    vndf_error inner = {VNDF_OK, ""};
    vndf_source_free(vndf_source_family(pattern, &inner));
    return inner.status == VNDF_OK ? VNDF_OK : vndf_fail(error, inner.status, "%s", inner.message);
}

static vndf_status no_parameter(const vndf_family_form *form, vndf_error *error)
{
    char known[160] = "";
    size_t used = 0;
    const vndf_family_form *other;
    for (size_t i = 0; (other = vndf_family_form_at(i)) != NULL && used < sizeof known; i++)
        if (other->count > 0 && other->required < 2)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", other->name);
    return vndf_fail(error, VNDF_ERROR_SYNTAX, "%s has no parameter; families that have one are %s", form->name,
                     known);
}

/* A name alone stands for one parameter. */
static vndf_status two_parameters(const vndf_family_form *form, vndf_error *error)
{
    const char *name = form->name, *first = form->range[0].name, *second = form->range[1].name;
    return vndf_fail(
        error, VNDF_ERROR_SYNTAX,
        "%s has the parameters %s and %s: right would be %s:{p},%s or %s:%s,{p}, with a number for the "
        "other",
        name, first, second, name, second, name, first);
}

static vndf_status check_form(const char *pattern, size_t name, vndf_error *error)
{
    const vndf_family_form *form = vndf_family_form_find(pattern, name);
    if (!form)
        return strncmp(pattern, "mix", 3) == 0 ? VNDF_OK : unknown_family(pattern, error);
    if (form->count == 0)
        return no_parameter(form, error);
    return form->required > 1 && !pattern[name] ? two_parameters(form, error) : VNDF_OK;
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
    return check_form(pattern, strcspn(pattern, ":"), error);
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
