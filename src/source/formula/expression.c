/* Evaluates formulas: the functions, and the stack machine. Every operation lets NaN pass, so that the
 * builder can say where a formula has no value; fmin and fmax of the C library would hide it. */
#include "source/formula/expression.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "source/words.h"

static double step(double x)
{
    return isnan(x) ? x : x >= 0;
}

static double smaller(double x, double y)
{
    return isnan(x) || x < y ? x : y;
}

static double larger(double x, double y)
{
    return isnan(x) || x > y ? x : y;
}

static const vndf_function functions[] = {
    {"exp", exp, NULL, VNDF_KINK_NONE, vndf_jet_exp, NULL},
    {"log", log, NULL, VNDF_KINK_NONE, vndf_jet_log, NULL},
    {"sqrt", sqrt, NULL, VNDF_KINK_NONE, vndf_jet_sqrt, NULL},
    {"sin", sin, NULL, VNDF_KINK_NONE, vndf_jet_sin, NULL},
    {"cos", cos, NULL, VNDF_KINK_NONE, vndf_jet_cos, NULL},
    {"tan", tan, NULL, VNDF_KINK_NONE, vndf_jet_tan, NULL},
    {"asin", asin, NULL, VNDF_KINK_NONE, vndf_jet_asin, NULL},
    {"acos", acos, NULL, VNDF_KINK_NONE, vndf_jet_acos, NULL},
    {"atan", atan, NULL, VNDF_KINK_NONE, vndf_jet_atan, NULL},
    {"sinh", sinh, NULL, VNDF_KINK_NONE, vndf_jet_sinh, NULL},
    {"cosh", cosh, NULL, VNDF_KINK_NONE, vndf_jet_cosh, NULL},
    {"tanh", tanh, NULL, VNDF_KINK_NONE, vndf_jet_tanh, NULL},
    {"erf", erf, NULL, VNDF_KINK_NONE, vndf_jet_erf, NULL},
    {"erfc", erfc, NULL, VNDF_KINK_NONE, vndf_jet_erfc, NULL},
    {"lgamma", lgamma, NULL, VNDF_KINK_NONE, vndf_jet_lgamma, NULL},
    {"gamma", tgamma, NULL, VNDF_KINK_NONE, vndf_jet_gamma, NULL},
    {"abs", fabs, NULL, VNDF_KINK_ZERO, vndf_jet_abs, NULL},
    {"min", NULL, smaller, VNDF_KINK_EQUAL, NULL, vndf_jet_min},
    {"max", NULL, larger, VNDF_KINK_EQUAL, NULL, vndf_jet_max},
    {"pow", NULL, pow, VNDF_KINK_NONE, NULL, vndf_jet_pow},
    {"step", step, NULL, VNDF_KINK_ZERO, vndf_jet_step, NULL},
};

const vndf_function *vndf_function_find(const char *name, size_t size)
{
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
        if (vndf_is_word(name, size, functions[i].name))
            return &functions[i];
    return NULL;
}

const char *vndf_function_name(size_t index)
{
    return index < sizeof functions / sizeof functions[0] ? functions[index].name : NULL;
}

typedef struct row {
    vndf_points at;
} row;

static double combine(const vndf_instruction *instruction, double x, double y)
{
    if (instruction->operation == VNDF_DIVIDE)
        return x / y;
    if (instruction->operation == VNDF_POWER)
        return y == 2.0 ? x * x : pow(x, y); /* squares are common, and powers slow */
    return instruction->function->two(x, y);
}

static void combine_rows(const vndf_instruction *instruction, row *x, const row *y, size_t count)
{
    switch (instruction->operation) {
    case VNDF_ADD:
        for (size_t i = 0; i < count; i++)
            x->at[i] += y->at[i];
        return;
    case VNDF_SUBTRACT:
        for (size_t i = 0; i < count; i++)
            x->at[i] -= y->at[i];
        return;
    case VNDF_MULTIPLY:
        for (size_t i = 0; i < count; i++)
            x->at[i] *= y->at[i];
        return;
    default:
        for (size_t i = 0; i < count; i++)
            x->at[i] = combine(instruction, x->at[i], y->at[i]);
    }
}

void vndf_expression_run(const vndf_expression *expression, size_t length, vndf_points *variables, size_t count,
                         double *values, double *below)
{
    row stack[VNDF_EXPRESSION_STACK];
    size_t top = 0; /* number of operands */
    for (const vndf_instruction *at = expression->program; at < expression->program + length; at++) {
        if (at->operation == VNDF_PUSH_NUMBER) {
            for (size_t i = 0; i < count; i++)
                stack[top].at[i] = at->number;
            top++;
        } else if (at->operation == VNDF_PUSH_VARIABLE) {
            memcpy(stack[top++].at, variables[at->variable], count * sizeof(double));
        } else if (at->operation == VNDF_NEGATE || (at->operation == VNDF_CALL && at->function->one)) {
            row *x = &stack[top - 1];
            for (size_t i = 0; i < count; i++)
                x->at[i] = at->operation == VNDF_NEGATE ? -x->at[i] : at->function->one(x->at[i]);
        } else {
            top--;
            combine_rows(at, &stack[top - 1], &stack[top], count);
        }
    }
    memcpy(values, stack[top > 1 ? top - 1 : 0].at, count * sizeof *values);
    for (size_t i = 0; below && i < count; i++)
        below[i] = top > 1 ? stack[top - 2].at[i] : 0;
}

void vndf_expression_free(vndf_expression *expression)
{
    free(expression->program);
    *expression = (vndf_expression){NULL, 0};
}
