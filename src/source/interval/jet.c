/* Taylor coefficients of composed functions by the recurrences of automatic differentiation (Moore, Interval
 * Analysis, 1966; Griewank & Walther, Evaluating Derivatives, 2008, ch. 13): y' = d x' is
 * k y_k = sum of j x_j d_(k-j), j from 1 to k. */
#include "source/interval/interval.h"

vndf_jet vndf_jet_constant(vndf_interval value)
{
    return (vndf_jet){1, {value}};
}

vndf_jet vndf_jet_number(double x)
{
    return vndf_jet_constant(vndf_interval_from(x, x));
}

vndf_jet vndf_jet_value(vndf_interval value, vndf_jet x)
{
    vndf_interval all = vndf_interval_all();
    return x.constant ? vndf_jet_constant(value) : (vndf_jet){0, {value, all, all, all}};
}

int vndf_jet_is_number(vndf_jet x)
{
    vndf_wide low = x.at[0].low, high = x.at[0].high;
    return x.constant && low.m == high.m && low.e == high.e && isfinite(low.m);
}

/* ---- arithmetic ---- */

vndf_jet vndf_jet_negative(vndf_jet x)
{
    for (int k = 0; k <= VNDF_JET; k++)
        x.at[k] = vndf_interval_negative(x.at[k]);
    return x;
}

vndf_jet vndf_jet_sum(vndf_jet x, vndf_jet y)
{
    vndf_jet z = x.constant ? y : x;
    z.at[0] = vndf_interval_sum(x.at[0], y.at[0]);
    for (int k = 1; k <= VNDF_JET && !x.constant && !y.constant; k++)
        z.at[k] = vndf_interval_sum(x.at[k], y.at[k]);
    return z;
}

vndf_jet vndf_jet_difference(vndf_jet x, vndf_jet y)
{
    return vndf_jet_sum(x, vndf_jet_negative(y));
}

static vndf_jet multiple(vndf_jet x, vndf_interval factor)
{
    for (int k = 0; k <= (x.constant ? 0 : VNDF_JET); k++)
        x.at[k] = vndf_interval_product(x.at[k], factor);
    return x;
}

/* sum of x_j y_(k-j), j from `first` to k. */
static vndf_interval folded(const vndf_jet *x, const vndf_jet *y, int first, int k)
{
    vndf_interval sum = vndf_interval_product(x->at[first], y->at[k - first]);
    for (int j = first + 1; j <= k; j++)
        sum = vndf_interval_sum(sum, vndf_interval_product(x->at[j], y->at[k - j]));
    return sum;
}

vndf_jet vndf_jet_product(vndf_jet x, vndf_jet y)
{
    vndf_jet z = {0, {x.at[0]}};
    if (x.constant || y.constant)
        return x.constant ? multiple(y, x.at[0]) : multiple(x, y.at[0]);
    for (int k = 0; k <= VNDF_JET; k++)
        z.at[k] = folded(&x, &y, 0, k);
    return z;
}

vndf_jet vndf_jet_quotient(vndf_jet x, vndf_jet y)
{
    vndf_jet z = {0, {vndf_interval_quotient(x.at[0], y.at[0])}};
    if (vndf_interval_vanishes(y.at[0]))
        return vndf_jet_value(z.at[0], x.constant ? y : x);
    if (y.constant)
        return multiple(x, vndf_interval_quotient(vndf_interval_from(1, 1), y.at[0]));
    for (int k = 1; k <= VNDF_JET; k++)
        z.at[k] = vndf_interval_quotient(vndf_interval_difference(x.at[k], folded(&y, &z, 1, k)), y.at[0]);
    return z;
}

/* ---- functions by their derivative ---- */

/* j x_j for all coefficients: x' with its coefficients shifted by one. */
static vndf_jet inner(vndf_jet x)
{
    for (int j = 2; j <= VNDF_JET; j++)
        x.at[j] = vndf_interval_scaled(x.at[j], j);
    return x;
}

/* y_k of y' = d x'; dx is inner(x). */
static vndf_interval next(const vndf_jet *dx, const vndf_jet *d, int k)
{
    vndf_interval sum = folded(dx, d, 1, k);
    return k == 1 ? sum : vndf_interval_scaled(sum, 1.0 / k);
}

vndf_jet vndf_jet_integral(vndf_interval value, vndf_jet x, vndf_jet d)
{
    vndf_jet y = {x.constant, {value}}, dx = inner(x);
    for (int k = 1; k <= VNDF_JET && !x.constant; k++)
        y.at[k] = next(&dx, &d, k);
    return y;
}

vndf_jet vndf_jet_wave(vndf_jet x, vndf_interval value, vndf_interval other, int sign)
{
    vndf_jet y = {x.constant, {value}}, z = {x.constant, {other}}, dx = inner(x);
    for (int k = 1; k <= VNDF_JET && !x.constant; k++) {
        vndf_interval back = next(&dx, &y, k);
        y.at[k] = next(&dx, &z, k);
        z.at[k] = sign < 0 ? vndf_interval_negative(back) : back;
    }
    return y;
}

vndf_jet vndf_jet_exp(vndf_jet x)
{
    vndf_interval y = vndf_interval_exp(x.at[0]);
    return vndf_jet_wave(x, y, y, 1);
}

vndf_jet vndf_jet_log(vndf_jet x)
{
    vndf_interval y = vndf_interval_log(x.at[0]);
    if (!(x.at[0].low.m > 0))
        return vndf_jet_value(y, x);
    return vndf_jet_integral(y, x, vndf_jet_quotient(vndf_jet_number(1), x));
}

/* ---- powers ---- */

/* k x_0 y_k = sum of (p j - (k - j)) x_j y_(k-j). */
static vndf_jet power_off_zero(vndf_jet x, double p)
{
    vndf_jet y = {x.constant, {vndf_interval_power(x.at[0], p)}};
    for (int k = 1; k <= VNDF_JET && !x.constant; k++) {
        vndf_interval sum = vndf_interval_from(0, 0);
        for (int j = 1; j <= k; j++) {
            vndf_interval term = vndf_interval_product(x.at[j], y.at[k - j]);
            sum = vndf_interval_sum(sum, vndf_interval_scaled(term, (p * j - (k - j)) / k));
        }
        y.at[k] = vndf_interval_quotient(sum, x.at[0]);
    }
    return y;
}

/* Whole exponents of at least 0, by products. */
static vndf_jet power_by_products(vndf_jet x, int n)
{
    vndf_jet y = vndf_jet_number(1), square = x;
    for (int rest = n; rest > 0; rest /= 2) {
        if (rest % 2)
            y = vndf_jet_product(y, square);
        if (rest > 1)
            square = vndf_jet_product(square, square);
    }
    y.at[0] = vndf_interval_power(x.at[0], n);
    return y;
}

vndf_jet vndf_jet_power(vndf_jet x, double p)
{
    enum { PRODUCTS = 1 << 20 };
    if (!vndf_interval_vanishes(x.at[0]) && (x.at[0].low.m > 0 || p == floor(p)))
        return power_off_zero(x, p);
    if (p == floor(p) && p >= 0 && p < PRODUCTS)
        return power_by_products(x, (int)p);
    return vndf_jet_value(vndf_interval_power(x.at[0], p), x);
}

vndf_jet vndf_jet_pow(vndf_jet x, vndf_jet y)
{
    if (vndf_jet_is_number(y))
        return vndf_jet_power(x, vndf_interval_low(y.at[0]));
    if (x.at[0].low.m < 0) /* unless the exponent is whole there is no value */
        return vndf_jet_value(vndf_interval_all(), x.constant ? y : x);
    return vndf_jet_exp(vndf_jet_product(y, vndf_jet_log(x)));
}

/* ---- kinks ---- */

/* Where x and y overlap, either of them, which may differ from point to point. */
vndf_jet vndf_jet_max(vndf_jet x, vndf_jet y)
{
    vndf_interval a = x.at[0], b = y.at[0], larger = vndf_interval_hull(a, b);
    if (!vndf_wide_less(b.low, a.high))
        return y;
    if (!vndf_wide_less(a.low, b.high))
        return x;
    larger.low = vndf_wide_less(a.low, b.low) ? b.low : a.low;
    vndf_jet z = vndf_jet_value(larger, x.constant ? y : x);
    if (!z.constant)
        z.at[1] = vndf_interval_hull(x.at[1], y.at[1]);
    return z;
}
