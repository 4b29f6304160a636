/* The functions of formulas, and the stack machine over numbers. Every function lets NaN pass, so that the builder can
 * say where a formula has no value; fmin and fmax of the C library would hide it. */
#include "source/formula/expression.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

const vndf_function vndf_functions[VNDF_FUNCTIONS] = {
    {"exp", exp, NULL},      {"log", log, NULL},   {"log1p", log1p, NULL}, {"sqrt", sqrt, NULL},
    {"sin", sin, NULL},      {"cos", cos, NULL},   {"tan", tan, NULL},     {"asin", asin, NULL},
    {"acos", acos, NULL},    {"atan", atan, NULL}, {"sinh", sinh, NULL},   {"cosh", cosh, NULL},
    {"tanh", tanh, NULL},    {"erf", erf, NULL},   {"erfc", erfc, NULL},   {"lgamma", lgamma, NULL},
    {"gamma", tgamma, NULL}, {"abs", fabs, NULL},  {"min", NULL, smaller}, {"max", NULL, larger},
    {"pow", NULL, pow},      {"step", step, NULL},
};

static double combined(const vndf_instruction *at, double x, double y)
{
    switch (at->operation) {
    case '+': return x + y;
    case '-': return x - y;
    case '*': return x * y;
    case '/': return x / y;
    case '^': return y == 2.0 ? x * x : pow(x, y); /* squares are common, and powers slow */
    default: return vndf_functions[at->function].two(x, y);
    }
}

void vndf_expression_run(const vndf_expression *expression, vndf_points *variables, size_t count, double *values)
{
    vndf_points stack[VNDF_EXPRESSION_STACK], *top = stack; /* behind the last operand */
    for (const vndf_instruction *at = expression->program; at < expression->program + expression->count; at++) {
        top += at->change;
        double *x = top[-1];
        if (at->operation == VNDF_PUSH_VARIABLE)
            memcpy(x, variables[at->variable], count * sizeof *x);
        else if (at->operation == VNDF_PUSH_NUMBER)
            for (size_t i = 0; i < count; i++)
                x[i] = at->number;
        else if (at->operation == VNDF_NEGATE)
            for (size_t i = 0; i < count; i++)
                x[i] = -x[i];
        else if (at->change == 0)
            for (size_t i = 0; i < count; i++)
                x[i] = vndf_functions[at->function].one(x[i]);
        else
            for (size_t i = 0; i < count; i++)
                x[i] = combined(at, x[i], (*top)[i]);
    }
    memcpy(values, stack[0], count * sizeof *values);
}

void vndf_expression_free(vndf_expression *expression)
{
    free(expression->program);
    *expression = (vndf_expression){NULL, 0};
}
