/* Bounds of a formula on all slopes between two, not only at points. */
#ifndef VNDF_SOURCE_FORMULA_EXPRESSION_BOUND_H
#define VNDF_SOURCE_FORMULA_EXPRESSION_BOUND_H

#include "source/formula/expression.h"
#include "source/interval/jet.h"
#include "source/source.h"

/* r itself. */
vndf_jet vndf_jet_of_slope(double low, double high);

/* The value of the formula. */
vndf_jet vndf_expression_jet(const vndf_expression *expression, const vndf_jet *variables);

/* The bounds of p22, with the stray of p22 r^2. */
vndf_reach vndf_reach_from(const vndf_jet *p22, const vndf_jet *r, double low, double high);

#endif
