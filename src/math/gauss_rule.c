#include "math/gauss_rule.h"

/* Legendre's polynomial of degree n at x in [-1, 1], and the one before it. */
static double legendre(int n, double x, double *before)
{
    double p0 = 1.0, p1 = x;
    for (int k = 2; k <= n; k++) {
        double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
    }
    *before = p0;
    return p1;
}

/* The one root between low and high, by halving until no double lies between. */
static double root_between(int n, double low, double high)
{
    double before, sign = legendre(n, low, &before) < 0.0 ? -1.0 : 1.0;
    for (;;) {
        double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high))
            return middle;
        if (sign * legendre(n, middle, &before) > 0.0)
            low = middle;
        else
            high = middle;
    }
}

void vndf_gauss_rule_of(vndf_gauss_rule *rule, int count)
{
    double *node = rule->node;
    rule->count = count;
    node[0] = 0.0;
    for (int n = 2; n <= count; n++) {
        double low = -1.0;
        for (int i = 0; i < n; i++) {
            double high = i < n - 1 ? node[i] : 1.0;
            node[i] = root_between(n, low, high);
            low = high;
        }
    }
    for (int i = 0; i < count; i++) {
        double before, x = node[i];
        legendre(count, x, &before);
        rule->weight[i] = (1.0 - x * x) / (count * before * (count * before));
        node[i] = 0.5 + 0.5 * x;
    }
}
