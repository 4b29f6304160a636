/* Distributions given by a formula: P22(r) itself, or D in c = cos(theta), theta, t = tan(theta), for
 * which P22(r) = D c^4 at t = r. 1 + r^2 is never formed, so that r = 1e200 has its right cosine. */
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "distribution/expression_bound.h"
#include "distribution/number.h"
#include "distribution/source.h"
#include "distribution/words.h"

enum { BREAKS = 4096 };
/* Of an evaluation besides its instructions; of a function or power. */
enum { OPERATIONS = 4, CALL_OPERATIONS = 8 };

typedef struct expression_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_expression expression;
    double *breaks; /* owned */
} expression_source;

static void slope_variables(double r, double *variables)
{
    variables[0] = r;
}

static void ndf_variables(double r, double *variables)
{
    variables[0] = 1 / hypot(1, r);
    variables[1] = atan(r);
    variables[2] = r;
}

static double slope_p22(const vndf_source *self, double r)
{
    const vndf_expression *expression = &((const expression_source *)self)->expression;
    return vndf_expression_run(expression, expression->count, &r, NULL);
}

static double ndf_p22(const vndf_source *self, double r)
{
    const vndf_expression *expression = &((const expression_source *)self)->expression;
    double variables[3];
    ndf_variables(r, variables);
    double c2 = variables[0] * variables[0];
    return vndf_expression_run(expression, expression->count, variables, NULL) * c2 * c2;
}

static vndf_reach slope_reach(const vndf_source *self, double low, double high)
{
    vndf_jet r = vndf_jet_of_slope(low, high);
    vndf_jet p22 = vndf_expression_jet(&((const expression_source *)self)->expression, &r);
    return vndf_reach_from(&p22, &r, low, high);
}

/* c, theta, t; c^4 apart. */
static vndf_reach ndf_reach(const vndf_source *self, double low, double high)
{
    vndf_jet r = vndf_jet_of_slope(low, high), one = vndf_jet_number(1), minus_half = vndf_jet_number(-0.5);
    vndf_jet square = vndf_jet_product(&r, &r), q = vndf_jet_sum(&one, &square), q2 = vndf_jet_product(&q, &q);
    vndf_jet variables[3] = {vndf_jet_pow(&q, &minus_half), vndf_jet_atan(&r), r};
    vndf_jet ndf = vndf_expression_jet(&((const expression_source *)self)->expression, variables);
    vndf_jet p22 = vndf_jet_quotient(&ndf, &q2);
    return vndf_reach_from(&p22, &r, low, high);
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
    vndf_text words = { NULL, 0, 0, 0 };
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
        vndf_operation operation = expression->program[i].operation;
        sum += operation == VNDF_CALL || operation == VNDF_POWER ? CALL_OPERATIONS : 1;
    }
    return sum;
}

/* 0 if there is no memory: a table without them would be another one. */
static int find_breaks(expression_source *source, vndf_variables_of_slope *variables)
{
    source->breaks = malloc(BREAKS * sizeof *source->breaks);
    if (!source->breaks ||
        !vndf_expression_breaks(&source->expression, variables, source->breaks, BREAKS, &source->base.break_count))
        return 0;
    source->base.breaks = source->base.break_count > 0 ? source->breaks : NULL;
    return 1;
}

/* option says which of the two kinds it is; p22, reach and variables belong to it. */
static vndf_source *make(const char *option, const char *text, const vndf_names *names,
                         double (*p22)(const vndf_source *, double),
                         vndf_reach (*reach)(const vndf_source *, double, double),
                         vndf_variables_of_slope *variables, vndf_error *error)
{
    vndf_expression expression;
    if (vndf_expression_parse(text, names, &expression, error) != VNDF_OK)
        return NULL;
    expression_source *source = calloc(1, sizeof *source);
    char *description = describe(option, text, names, error);
    if (!source || !description) {
        free(source);
        free(description);
        vndf_expression_free(&expression);
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
        return NULL;
    }
    source->base = (vndf_source){ p22, destroy, description, NULL, 0, 1, operations_of(&expression), reach };
    source->expression = expression;
    if (find_breaks(source, variables))
        return &source->base;
    destroy(&source->base);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
    return NULL;
}

vndf_source *vndf_source_ndf_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                        vndf_error *error)
{
    static const char *const variables[] = { "c", "theta", "t" };
    vndf_names names = { variables, 3, parameters, count };
    return make("--ndf", text, &names, ndf_p22, ndf_reach, ndf_variables, error);
}

vndf_source *vndf_source_slope_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                          vndf_error *error)
{
    static const char *const variables[] = { "r" };
    vndf_names names = { variables, 1, parameters, count };
    return make("--slope", text, &names, slope_p22, slope_reach, slope_variables, error);
}
