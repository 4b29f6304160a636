/* Evaluates formulas: the functions, and the stack machine, over doubles and over jets. Every operation lets NaN
 * pass, so that the builder can say where a formula has no value; fmin and fmax of the C library would hide it. */
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

/* ---- bounds ----------------------------------------------------------------------------------- */

static vndf_jet combine_jets(const vndf_instruction *at, const vndf_jet *x, const vndf_jet *y)
{
    switch (at->operation) {
    case VNDF_ADD: return vndf_jet_sum(x, y);
    case VNDF_SUBTRACT: return vndf_jet_difference(x, y);
    case VNDF_MULTIPLY: return vndf_jet_product(x, y);
    case VNDF_DIVIDE: return vndf_jet_quotient(x, y);
    case VNDF_POWER: return vndf_jet_pow(x, y);
    default: return at->function->jet_two(x, y);
    }
}

vndf_jet vndf_expression_jet(const vndf_expression *expression, const vndf_jet *variables)
{
    vndf_jet stack[VNDF_EXPRESSION_STACK];
    size_t top = 0;
    for (const vndf_instruction *at = expression->program; at < expression->program + expression->count; at++) {
        if (at->operation == VNDF_PUSH_NUMBER)
            stack[top++] = vndf_jet_number(at->number);
        else if (at->operation == VNDF_PUSH_VARIABLE)
            stack[top++] = variables[at->variable];
        else if (at->operation == VNDF_NEGATE)
            stack[top - 1] = vndf_jet_negative(&stack[top - 1]);
        else if (at->operation == VNDF_CALL && at->function->one)
            stack[top - 1] = at->function->jet_one(&stack[top - 1]);
        else {
            top--;
            stack[top - 1] = combine_jets(at, &stack[top - 1], &stack[top]);
        }
    }
    return stack[top - 1];
}

/* r = exp(u): all derivatives are r. */
vndf_jet vndf_jet_of_slope(double low, double high)
{
    vndf_interval r = vndf_interval_from(low, high);
    vndf_jet jet = {0, {r, r, vndf_interval_scaled(r, 0.5), vndf_interval_scaled(r, 1.0 / 6)}};
    return jet;
}

/* If the k-th Taylor coefficient of f lies within an interval of width w on a whole piece of width h with middle
 * m, f is within w/2 |u - m|^k of a polynomial of degree k, and the integral of the difference is at most w
 * (h/2)^(k+1)/(k+1). */
vndf_reach vndf_reach_from(const vndf_jet *p22, const vndf_jet *r, double low, double high)
{
    vndf_jet f = vndf_jet_product(p22, r), g = vndf_jet_product(&f, r);
    double h = log(high / low) * (1 + 1e-9), power = h / 2;
    vndf_reach reach = {vndf_interval_low(p22->at[0]), vndf_interval_high(p22->at[0]), HUGE_VAL};
    for (int k = 0; k <= VNDF_JET; k++, power *= h / 2) {
        vndf_interval width = vndf_interval_difference(g.at[k], g.at[k]);
        double stray = vndf_wide_double(width.high) * power / (k + 1);
        reach.stray = stray < reach.stray ? stray : reach.stray;
    }
    return reach;
}

void vndf_expression_free(vndf_expression *expression)
{
    free(expression->program);
    *expression = (vndf_expression){NULL, 0};
}
