/* Distributions given by a formula: P22(r) itself, or D in c = cos(theta), theta, t = tan(theta), for
 * which P22(r) = D c^4 at t = r. 1 + r^2 is never formed, so that r = 1e200 has its right cosine. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "source/formula/expression.h"
#include "source/source.h"
#include "source/words.h"

enum { BREAKS = 4096 };
/* The cost of an evaluation besides its instructions; of a power, or a function other than abs, min, max and
 * step. */
enum { OPERATIONS = 4, CALL_OPERATIONS = 8 };

static const double TIGHT = 1e-9; /* bounds this close count as a value */

/* The differences between the two kinds of formulas. */
typedef struct form {
    const char *option;
    const char *names[3];
    size_t count;
    vndf_variables_of_slope *variables;
    vndf_jet (*jet)(const vndf_expression *expression, const vndf_jet *r);
} form;

typedef struct expression_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    const form *form;
    vndf_expression expression;
    double *breaks; /* owned */
} expression_source;

static void slope_variables(const double *r, size_t count, vndf_points *variables)
{
    memcpy(variables[0], r, count * sizeof *r);
}

static void ndf_variables(const double *r, size_t count, vndf_points *variables)
{
    for (size_t i = 0; i < count; i++) {
        variables[0][i] = 1 / hypot(1, r[i]);
        variables[1][i] = atan(r[i]);
        variables[2][i] = r[i];
    }
}

/* The formula in c, theta, t, times c^4. */
static vndf_jet ndf_jet(const vndf_expression *expression, const vndf_jet *r)
{
    vndf_jet one = vndf_jet_number(1), minus_half = vndf_jet_number(-0.5);
    vndf_jet square = vndf_jet_product(r, r), q = vndf_jet_sum(&one, &square), q2 = vndf_jet_product(&q, &q);
    vndf_jet variables[3] = {vndf_jet_pow(&q, &minus_half), vndf_jet_atan(r), *r};
    vndf_jet ndf = vndf_expression_jet(expression, variables);
    return vndf_jet_quotient(&ndf, &q2);
}

static vndf_reach reach(const vndf_source *self, double low, double high)
{
    const expression_source *source = (const expression_source *)self;
    vndf_jet r = vndf_jet_of_slope(low, high), p22 = source->form->jet(&source->expression, &r);
    return vndf_reach_from(&p22, &r, low, high);
}

/* The value at a slope where doubles overflow on the way, as in r^11 exp(-r^2) far out: the value that the bounds
 * leave, if they are close enough. */
static double bounded_value(const expression_source *source, double r, double value)
{
    vndf_jet at = vndf_jet_number(r), jet = source->form->jet(&source->expression, &at);
    double low = vndf_interval_low(jet.at[0]), high = vndf_interval_high(jet.at[0]);
    double size = fmax(fabs(low), fabs(high));
    return isfinite(size) && high - low <= fmax(TIGHT * size, 8 * DBL_MIN) ? fmax(low, 0) : value;
}

static void p22_many(const vndf_source *self, const double *r, size_t count, double *values)
{
    const expression_source *source = (const expression_source *)self;
    vndf_points variables[3];
    source->form->variables(r, count, variables);
    vndf_expression_run(&source->expression, source->expression.count, variables, count, values, NULL);
    for (size_t i = 0; i < count; i++) {
        double c2 = variables[0][i] * variables[0][i];
        if (source->form->jet == ndf_jet)
            values[i] = values[i] * c2 * c2;
        if (!isfinite(values[i]) && r[i] > 0 && r[i] < HUGE_VAL)
            values[i] = bounded_value(source, r[i], values[i]);
    }
}

static double p22(const vndf_source *self, double r)
{
    double value;
    p22_many(self, &r, 1, &value);
    return value;
}

static void destroy(vndf_source *self)
{
    expression_source *source = (expression_source *)self;
    vndf_expression_free(&source->expression);
    free(source->breaks);
    free(source->base.description);
    free(source);
}

/* "--slope 'exp(-a*r)' --set a=0.3" */
static char *describe(const char *option, const char *text, const vndf_names *names, vndf_error *error)
{
    vndf_text words = {NULL, 0, 0, 0};
    vndf_text_add_word(&words, option);
    vndf_text_add_word(&words, text);
    for (size_t i = 0; i < names->parameter_count; i++) {
        char value[VNDF_NUMBER_TEXT];
        vndf_text_add_word(&words, "--set");
        vndf_text_add_word(&words, names->parameters[i].name);
        vndf_text_add(&words, "=");
        vndf_text_add(&words, vndf_number_print(value, names->parameters[i].value));
    }
    return vndf_text_finish(&words, error);
}

static double operations_of(const vndf_expression *expression)
{
    double sum = OPERATIONS;
    for (size_t i = 0; i < expression->count; i++) {
        const vndf_instruction *at = &expression->program[i];
        int long_call = at->operation == VNDF_CALL && at->function->kink == VNDF_KINK_NONE;
        sum += long_call || at->operation == VNDF_POWER ? CALL_OPERATIONS : 1;
    }
    return sum;
}

/* 0 if there is no memory: without breaks the build would give another table. */
static int find_breaks(expression_source *source, vndf_variables_of_slope *variables)
{
    source->breaks = malloc(BREAKS * sizeof *source->breaks);
    if (!source->breaks ||
        !vndf_expression_breaks(&source->expression, variables, source->breaks, BREAKS, &source->base.break_count))
        return 0;
    source->base.breaks = source->base.break_count > 0 ? source->breaks : NULL;
    return 1;
}

static vndf_source *make(const form *of, const char *text, const vndf_parameter *parameters, size_t count,
                         vndf_error *error)
{
    vndf_expression expression;
    vndf_names names = {of->names, of->count, parameters, count};
    if (vndf_expression_parse(text, &names, &expression, error) != VNDF_OK)
        return NULL;
    expression_source *source = calloc(1, sizeof *source);
    char *description = describe(of->option, text, &names, error);
    if (!source || !description) {
        free(source);
        free(description);
        vndf_expression_free(&expression);
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
        return NULL;
    }
    source->base = (vndf_source){.p22 = p22,
                                 .p22_many = p22_many,
                                 .destroy = destroy,
                                 .description = description,
                                 .rebuildable = 1,
                                 .operations = operations_of(&expression),
                                 .reach = reach};
    source->form = of;
    source->expression = expression;
    if (find_breaks(source, of->variables))
        return &source->base;
    destroy(&source->base);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
    return NULL;
}

vndf_source *vndf_source_ndf_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                        vndf_error *error)
{
    static const form ndf = {"--ndf", {"c", "theta", "t"}, 3, ndf_variables, ndf_jet};
    return make(&ndf, text, parameters, count, error);
}

vndf_source *vndf_source_slope_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                          vndf_error *error)
{
    static const form slope = {"--slope", {"r"}, 1, slope_variables, vndf_expression_jet};
    return make(&slope, text, parameters, count, error);
}
