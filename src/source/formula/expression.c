/* Evaluates formulas: the functions, and the stack machine. Every operation lets NaN pass, so that the
 * builder can say where a formula has no value; fmin and fmax of the C library would hide it. */
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
        if (strlen(functions[i].name) == size && memcmp(functions[i].name, name, size) == 0)
            return &functions[i];
    return NULL;
}

const char *vndf_function_names(void)
{
    return "exp log sqrt sin cos tan asin acos atan sinh cosh tanh erf erfc lgamma gamma abs min max pow step";
}

/* Operations with two operands. */
static double combine(const vndf_instruction *instruction, double x, double y)
{
    switch (instruction->operation) {
    case VNDF_ADD: return x + y;
    case VNDF_SUBTRACT: return x - y;
    case VNDF_MULTIPLY: return x * y;
    case VNDF_DIVIDE: return x / y;
    case VNDF_POWER: return y == 2.0 ? x * x : pow(x, y); /* squares are common, and powers slow */
    default: return instruction->function->two(x, y);
    }
}

double vndf_expression_run(const vndf_expression *expression, size_t count, const double *variables, double *below)
{
    double stack[VNDF_EXPRESSION_STACK];
    size_t top = 0; /* number of operands */
    for (const vndf_instruction *at = expression->program; at < expression->program + count; at++) {
        if (at->operation == VNDF_PUSH_NUMBER)
            stack[top++] = at->number;
        else if (at->operation == VNDF_PUSH_VARIABLE)
            stack[top++] = variables[at->variable];
        else if (at->operation == VNDF_NEGATE)
            stack[top - 1] = -stack[top - 1];
        else if (at->operation == VNDF_CALL && at->function->one)
            stack[top - 1] = at->function->one(stack[top - 1]);
        else {
            top--;
            stack[top - 1] = combine(at, stack[top - 1], stack[top]);
        }
    }
    if (below)
        *below = top > 1 ? stack[top - 2] : 0;
    return stack[top - 1];
}

typedef struct row {
    double at[VNDF_SOURCE_MANY];
} row;

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

static void apply_to_row(const vndf_instruction *instruction, row *x, size_t count)
{
    for (size_t i = 0; i < count; i++)
        x->at[i] = instruction->operation == VNDF_NEGATE ? -x->at[i] : instruction->function->one(x->at[i]);
}

void vndf_expression_run_many(const vndf_expression *expression, double (*variables)[VNDF_SOURCE_MANY],
                              size_t count, double *values)
{
    row stack[VNDF_EXPRESSION_STACK];
    size_t top = 0; /* number of operands */
    for (const vndf_instruction *at = expression->program; at < expression->program + expression->count; at++) {
        if (at->operation == VNDF_PUSH_NUMBER)
            for (size_t i = 0; i < count; i++)
                stack[top].at[i] = at->number;
        else if (at->operation == VNDF_PUSH_VARIABLE)
            memcpy(stack[top].at, variables[at->variable], count * sizeof(double));
        else if (at->operation == VNDF_NEGATE || (at->operation == VNDF_CALL && at->function->one))
            apply_to_row(at, &stack[top - 1], count);
        else {
            top--;
            combine_rows(at, &stack[top - 1], &stack[top], count);
        }
        top += at->operation == VNDF_PUSH_NUMBER || at->operation == VNDF_PUSH_VARIABLE;
    }
    memcpy(values, stack[top - 1].at, count * sizeof *values);
}

void vndf_expression_free(vndf_expression *expression)
{
    free(expression->program);
    *expression = (vndf_expression){NULL, 0};
}
