/* Distributions given by name. A specification is FAMILY[:PARAMETER,...], FAMILY:MATERIAL, or
 *
 *     mix:(W1,S1,FAMILY1)+(W2,S2,FAMILY2)
 *
 * for two lobes: each P22 is divided by its mass and its slopes are multiplied by S, so that the weights
 * are shares of the surface's projected area:  P22(r) = sum of W/(S^2 mass) P22_i(r/S).
 * A family alone is one lobe with the factor and the scale 1. */
#include "source/family/family.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "core/nearest.h"
#include "source/formula/expression.h"
#include "source/source.h"
#include "source/words.h"

static const char mix_usage[] = "mix:(W,S,FAMILY)+(W,S,FAMILY), as in mix:(0.8,0.1,ggx)+(0.2,0.5,student-t:2)";

typedef struct lobe {
    const vndf_family_form *form;
    double parameter[VNDF_FAMILY_PARAMETERS];
    double weight, scale; /* weight 0: P22 as it is, not divided by its mass */
} lobe;

/* ---- numbers ---------------------------------------------------------------------------------- */

static vndf_status read_number(vndf_span p, const char *usage, double *value, vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    if (vndf_number_is_all(p.text, p.size, value))
        return isfinite(*value)
                   ? VNDF_OK
                   : vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: the number %s is too large for a double",
                               p.column, vndf_excerpt(excerpt, p.text, p.size));
    return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: '%s' is no number; right would be %s", p.column,
                     vndf_excerpt(excerpt, p.text, p.size), usage);
}

static vndf_status check_range(const vndf_family_range *range, double value, const char *what, const char *reason,
                               vndf_error *error)
{
    char text[VNDF_NUMBER_TEXT];
    if (value <= range->high && (range->open ? value > range->low : value >= range->low))
        return VNDF_OK;
    return vndf_fail(error, VNDF_ERROR_SYNTAX, "%s: %s is %s; it must be %s %g and at most %g%s%s", what,
                     range->name, vndf_number_print(text, value), range->open ? "above" : "at least", range->low,
                     range->high, reason[0] ? ": " : "", reason);
}

/* ---- one lobe --------------------------------------------------------------------------------- */

static vndf_status unknown_family(vndf_span name, vndf_error *error)
{
    char excerpt[VNDF_EXCERPT], known[160] = "", hint[48] = "";
    size_t used = 0, least = vndf_word_slip(name.size);
    if (name.size >= 3 && memcmp(name.text, "mix", 3) == 0)
        return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: a mix is %s, of families that are no mix",
                         name.column, mix_usage);
    for (size_t i = 0; i < VNDF_FAMILY_FORMS; i++) {
        const char *other = vndf_family_forms[i].name;
        used += (size_t)snprintf(known + used, sizeof known - used, "%s, ", other);
        if (vndf_word_is_nearer(name.text, name.size, other, &least))
            snprintf(hint, sizeof hint, "did you mean '%s'? ", other);
    }
    return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: unknown family '%s'; %sknown are %smix", name.column,
                     vndf_excerpt(excerpt, name.text, name.size), hint, known);
}

static vndf_status read_parameters(vndf_span rest, lobe *l, vndf_error *error)
{
    const vndf_family_form *form = l->form;
    size_t given = 0;
    if (rest.size > 0 && rest.text[rest.size - 1] == ',')
        return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: nothing follows the comma; right would be %s",
                         rest.column + rest.size, form->usage);
    while (rest.size > 0) {
        if (given == form->count)
            return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: too many parameters; right would be %s",
                             rest.column, form->usage);
        if (read_number(vndf_cut(&rest, ','), form->usage, &l->parameter[given], error) != VNDF_OK ||
            check_range(&form->range[given], l->parameter[given], form->name, form->reason, error) != VNDF_OK)
            return VNDF_ERROR_SYNTAX;
        given++;
    }
    if (given < form->required)
        return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: %s is missing; right would be %s", rest.column,
                         form->range[given].name, form->usage);
    for (; given < form->count; given++)
        l->parameter[given] = form->range[given].standard;
    return VNDF_OK;
}

/* A material's whole name, "sgd:alum-bronze/r", is in the list; it starts with a letter behind the family, as a number
 * does not. */
static vndf_status read_lobe(vndf_span whole, lobe *l, vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    vndf_span rest = whole, name = vndf_cut(&rest, ':');
    *l = (lobe){vndf_family_forms, {0, 0}, 0, 1};
    while (!vndf_is_word(name.text, name.size, l->form->name))
        if (++l->form == vndf_family_forms + VNDF_FAMILY_FORMS)
            return unknown_family(name, error);
    int has_materials = strcmp(l->form->name, "sgd") == 0 || strcmp(l->form->name, "abc") == 0;
    if (!has_materials || (rest.text[0] | 32) < 'a' || (rest.text[0] | 32) > 'z')
        return read_parameters(rest, l, error);
    const vndf_material_fit *material = vndf_material_near(whole.text, whole.size);
    memcpy(l->parameter, material->parameter, sizeof l->parameter);
    if (vndf_is_word(whole.text, whole.size, material->name))
        return VNDF_OK;
    return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: unknown material '%s'; the nearest is %s",
                     whole.column, vndf_excerpt(excerpt, whole.text, whole.size), material->name);
}

/* ---- mix -------------------------------------------------------------------------------------- */

static vndf_status bad_mix(vndf_span at, vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: unexpected '%s'; right would be %s", at.column,
                     vndf_excerpt(excerpt, at.text, at.size), mix_usage);
}

/* "(W,S,FAMILY)" at the start of `rest`, which moves behind it. */
static vndf_status read_component(vndf_span *rest, lobe *l, vndf_error *error)
{
    static const vndf_family_range weights = {"the weight W", 0, 1e12, 1, 0};
    static const vndf_family_range scales = {"the scale S", 1e-9, 1e9, 0, 0};
    double weight = 0, scale = 0;
    vndf_span open = vndf_cut(rest, '(');
    if (open.size > 0 || rest->size == 0 || !memchr(rest->text, ')', rest->size))
        return bad_mix(open.size > 0 ? open : *rest, error);
    vndf_span inside = vndf_cut(rest, ')'), first = vndf_cut(&inside, ','), second = vndf_cut(&inside, ',');
    if (read_number(first, mix_usage, &weight, error) != VNDF_OK ||
        read_number(second, mix_usage, &scale, error) != VNDF_OK ||
        check_range(&weights, weight, "mix", "", error) != VNDF_OK ||
        check_range(&scales, scale, "mix", "", error) != VNDF_OK || read_lobe(inside, l, error) != VNDF_OK)
        return VNDF_ERROR_SYNTAX;
    l->weight = weight;
    l->scale = scale;
    return VNDF_OK;
}

static vndf_status read_mix(vndf_span rest, lobe lobes[VNDF_LOBES], vndf_error *error)
{
    if (read_component(&rest, &lobes[0], error) != VNDF_OK)
        return VNDF_ERROR_SYNTAX;
    vndf_span plus = rest;
    if (vndf_cut(&rest, '+').size > 0)
        return bad_mix(plus, error);
    if (read_component(&rest, &lobes[1], error) != VNDF_OK)
        return VNDF_ERROR_SYNTAX;
    return rest.size > 0 ? bad_mix(rest, error) : VNDF_OK;
}

/* ---- the whole -------------------------------------------------------------------------------- */

static vndf_status read_specification(const char *specification, lobe lobes[VNDF_LOBES], size_t *count,
                                      vndf_error *error)
{
    if (!specification)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the family's name is NULL");
    vndf_span whole = {specification, strlen(specification), 1}, rest = whole, name = vndf_cut(&rest, ':');
    if (whole.size > VNDF_LIMIT_FAMILY_LENGTH)
        return vndf_fail(error, VNDF_ERROR_SYNTAX, "the family's name has %zu characters; at most %d are possible",
                         whole.size, VNDF_LIMIT_FAMILY_LENGTH);
    *count = vndf_is_word(name.text, name.size, "mix") ? 2 : 1;
    return *count == 2 ? read_mix(rest, lobes, error) : read_lobe(whole, lobes, error);
}

/* A formula in r, of a form that has these parameters. */
static vndf_status compile(const vndf_family_form *form, const char *text, const double *parameter,
                           vndf_expression *formula, vndf_error *error)
{
    static const char *const variables[] = {"r"};
    const vndf_parameter parameters[VNDF_FAMILY_PARAMETERS] = {{"a", parameter[0]}, {"b", parameter[1]}};
    const vndf_names names = {variables, 1, parameters, form->count};
    return vndf_expression_parse(text, &names, formula, error);
}

/* The mass under P22; 0 if there is no memory. Quadrature: 2 pi integral P22 r^2 ds over s = log r by the trapezoidal
 * rule, whose error for an integrand that is analytic for |Im s| < d is of the order of exp(-2 pi d/h). All that need
 * it have d >= pi/4: exp(-158) at h = 1/32. Below e^-64 = 1.6e-28 the mass goes as r^2, beyond e^64 as r^-2 at least,
 * with scales within [1e-11, 1e3]: less than 1e-20 of the mass is cut off. */
static double mass_of(const vndf_family_form *form, const double *parameter)
{
    const int steps = 32, end = form->mass ? 0 : 64 * steps;
    double sum = 0;
    vndf_expression formula;
    if (compile(form, form->mass ? form->mass : form->formula, parameter, &formula, NULL) != VNDF_OK)
        return 0;
    for (int i = -end; i <= end; i++) {
        double r = exp((double)i / steps), value;
        vndf_points variables[1] = {{r}};
        vndf_expression_run(&formula, variables, 1, &value);
        sum += value * r * r;
    }
    vndf_expression_free(&formula);
    return form->mass ? sum : 2 * 3.14159265358979323846 * sum / steps;
}

vndf_source *vndf_source_family(const char *specification, vndf_error *error)
{
    lobe lobes[VNDF_LOBES];
    vndf_lobe made[VNDF_LOBES] = {{{NULL, 0}, 1, 1}, {{NULL, 0}, 1, 1}};
    size_t count = 0, done = 0;
    if (read_specification(specification, lobes, &count, error) != VNDF_OK)
        return NULL;
    for (const lobe *l = lobes; done < count; l++, done++) {
        made[done].scale = l->scale;
        if (l->weight > 0)
            made[done].factor = l->weight / (mass_of(l->form, l->parameter) * l->scale * l->scale);
        if (compile(l->form, l->form->formula, l->parameter, &made[done].formula, error) != VNDF_OK)
            break;
    }
    if (done == count && isfinite(made[0].factor) && isfinite(made[1].factor)) {
        char *description = vndf_text_pair("--family", specification, "", error);
        return vndf_formula_source(VNDF_FORMULA_OF_P22, made, count, description, error);
    }
    for (size_t i = 0; i < done; i++)
        vndf_expression_free(&made[i].formula);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
    return NULL;
}
