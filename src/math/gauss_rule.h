/* Gauss-Legendre rules of any order by + - * / alone: integral_0^1 f ~ sum weight_i f(node_i), exact for polynomials
 * of degree 2n - 1. The nodes of each order lie between those of the order before, where they are bisected. */
#ifndef VNDF_MATH_GAUSS_RULE_H
#define VNDF_MATH_GAUSS_RULE_H

enum { VNDF_GAUSS_RULE_MAX = 64 };

typedef struct vndf_gauss_rule {
    int count;
    double node[VNDF_GAUSS_RULE_MAX], weight[VNDF_GAUSS_RULE_MAX];
} vndf_gauss_rule;

/* count from 1 to VNDF_GAUSS_RULE_MAX; errors below 1e-14. */
void vndf_gauss_rule_of(vndf_gauss_rule *rule, int count);

#endif
