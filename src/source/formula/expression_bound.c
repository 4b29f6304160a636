/* Evaluates a formula over jets, and bounds how far from a cubic it strays. If the k-th Taylor coefficient of f
 * lies within an interval of width w on a whole piece of width h with middle m, f is within w/2 |u - m|^k of a
 * polynomial of degree k, and the integral of the difference is at most w (h/2)^(k+1)/(k+1). */
#include "source/formula/expression_bound.h"

#include <math.h>

static vndf_jet combine(const vndf_instruction *at, const vndf_jet *x, const vndf_jet *y)
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
            stack[top - 1] = combine(at, &stack[top - 1], &stack[top]);
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
