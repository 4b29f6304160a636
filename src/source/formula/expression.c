/* Runs formulas: the stack machine, over doubles and over bounds. */
#include "source/formula/expression.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct row {
    vndf_points at;
} row;

static double combined(const vndf_instruction *at, double x, double y)
{
    switch (at->operation) {
    case '+': return x + y;
    case '-': return x - y;
    case '*': return x * y;
    case '/': return x / y;
    case '^': return y == 2.0 ? x * x : pow(x, y); /* squares are common, and powers slow */
    default: return at->function->two(x, y);
    }
}

void vndf_expression_run(const vndf_expression *expression, vndf_points *variables, size_t count, double *values)
{
    row stack[VNDF_EXPRESSION_STACK];
    size_t top = 0; /* number of operands */
    for (const vndf_instruction *at = expression->program; at < expression->program + expression->count; at++) {
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
            row *x = &stack[--top - 1], *y = &stack[top];
            for (size_t i = 0; i < count; i++)
                x->at[i] = combined(at, x->at[i], y->at[i]);
        }
    }
    memcpy(values, stack->at, count * sizeof *values);
}

void vndf_expression_free(vndf_expression *expression)
{
    free(expression->program);
    *expression = (vndf_expression){NULL, 0};
}

/* ---- bounds ----------------------------------------------------------------------------------- */

static vndf_jet combine_jets(const vndf_instruction *at, vndf_jet x, vndf_jet y)
{
    switch (at->operation) {
    case '+': return vndf_jet_sum(x, y);
    case '-': return vndf_jet_difference(x, y);
    case '*': return vndf_jet_product(x, y);
    case '/': return vndf_jet_quotient(x, y);
    case '^': return vndf_jet_pow(x, y);
    default: return vndf_function_jet(at->function, x, y);
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
            stack[top - 1] = vndf_jet_negative(stack[top - 1]);
        else if (at->operation == VNDF_CALL && at->function->one)
            stack[top - 1] = vndf_function_jet(at->function, stack[top - 1], stack[top - 1]);
        else {
            top--;
            stack[top - 1] = combine_jets(at, stack[top - 1], stack[top]);
        }
    }
    return stack[top - 1];
}

/* r = exp(u): all derivatives are r. */
vndf_jet vndf_jet_of_slope(double low, double high)
{
    vndf_interval r = vndf_interval_from(low, high);
    return (vndf_jet){0, {r, r, vndf_interval_scaled(r, 0.5), vndf_interval_scaled(r, 1.0 / 6)}};
}

/* If the k-th Taylor coefficient of f lies within an interval of width w on a whole piece of width h with middle
 * m, f is within w/2 |u - m|^k of a polynomial of degree k, and the integral of the difference is at most w
 * (h/2)^(k+1)/(k+1). */
vndf_reach vndf_reach_from(vndf_jet p22, vndf_jet r, double low, double high)
{
    vndf_jet f = vndf_jet_product(vndf_jet_product(p22, r), r);
    double h = log(high / low) * (1 + 1e-9), power = h / 2;
    vndf_reach reach = {vndf_interval_low(p22.at[0]), vndf_interval_high(p22.at[0]), HUGE_VAL};
    for (int k = 0; k <= VNDF_JET; k++, power *= h / 2) {
        double stray = vndf_interval_high(vndf_interval_difference(f.at[k], f.at[k])) * power / (k + 1);
        reach.stray = stray < reach.stray ? stray : reach.stray;
    }
    return reach;
}
