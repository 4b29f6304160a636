/* Taylor coefficients of composed functions by the recurrences of automatic differentiation (Moore, Interval
 * Analysis, 1966; Griewank & Walther, Evaluating Derivatives, 2008, ch. 13): y' = d x' is
 * k y_k = sum of j x_j d_(k-j), j from 1 to k. */
#include "source/interval/jet.h"

static const vndf_interval zero = {{0, 0}, {0, 0}};

static vndf_jet constant_of(vndf_interval value)
{
    vndf_jet y = {1, {value, zero, zero, zero}};
    return y;
}

vndf_jet vndf_jet_number(double x)
{
    return constant_of(vndf_interval_from(x, x));
}

/* Only the value is known; if x is constant, y is constant too. */
static vndf_jet value_of(vndf_interval value, const vndf_jet *x)
{
    vndf_interval all = vndf_interval_all();
    vndf_jet y = {0, {value, all, all, all}};
    return x->constant ? constant_of(value) : y;
}

static vndf_jet unknown(const vndf_jet *x)
{
    return value_of(vndf_interval_all(), x);
}

/* ---- arithmetic ---- */

vndf_jet vndf_jet_negative(const vndf_jet *x)
{
    vndf_jet y = *x;
    for (int k = 0; k <= VNDF_JET; k++)
        y.at[k] = vndf_interval_negative(x->at[k]);
    return y;
}

vndf_jet vndf_jet_sum(const vndf_jet *x, const vndf_jet *y)
{
    vndf_jet z = x->constant ? *y : *x;
    z.at[0] = vndf_interval_sum(x->at[0], y->at[0]);
    if (!x->constant && !y->constant)
        for (int k = 1; k <= VNDF_JET; k++)
            z.at[k] = vndf_interval_sum(x->at[k], y->at[k]);
    return z;
}

vndf_jet vndf_jet_difference(const vndf_jet *x, const vndf_jet *y)
{
    vndf_jet negative = vndf_jet_negative(y);
    return vndf_jet_sum(x, &negative);
}

static vndf_jet multiple(const vndf_jet *x, vndf_interval factor)
{
    vndf_jet y = *x;
    for (int k = 0; k <= (x->constant ? 0 : VNDF_JET); k++)
        y.at[k] = vndf_interval_product(x->at[k], factor);
    return y;
}

/* sum of x_j y_(k-j), j from `first` to k. */
static vndf_interval folded(const vndf_jet *x, const vndf_jet *y, int first, int k)
{
    vndf_interval sum = vndf_interval_product(x->at[first], y->at[k - first]);
    for (int j = first + 1; j <= k; j++)
        sum = vndf_interval_sum(sum, vndf_interval_product(x->at[j], y->at[k - j]));
    return sum;
}

vndf_jet vndf_jet_product(const vndf_jet *x, const vndf_jet *y)
{
    vndf_jet z = {0, {zero, zero, zero, zero}};
    if (x->constant)
        return multiple(y, x->at[0]);
    if (y->constant)
        return multiple(x, y->at[0]);
    for (int k = 0; k <= VNDF_JET; k++)
        z.at[k] = folded(x, y, 0, k);
    return z;
}

vndf_jet vndf_jet_quotient(const vndf_jet *x, const vndf_jet *y)
{
    vndf_jet z = {0, {vndf_interval_quotient(x->at[0], y->at[0]), zero, zero, zero}};
    if (y->constant && !vndf_interval_vanishes(y->at[0]))
        return multiple(x, vndf_interval_quotient(vndf_interval_from(1, 1), y->at[0]));
    if (vndf_interval_vanishes(y->at[0]))
        return x->constant ? value_of(z.at[0], y) : value_of(z.at[0], x);
    for (int k = 1; k <= VNDF_JET; k++)
        z.at[k] = vndf_interval_quotient(vndf_interval_difference(x->at[k], folded(y, &z, 1, k)), y->at[0]);
    return z;
}

/* ---- functions by their derivative ---- */

/* j x_j for all coefficients: x' with its coefficients shifted by one. */
static vndf_jet inner(const vndf_jet *x)
{
    vndf_jet y = *x;
    for (int j = 2; j <= VNDF_JET; j++)
        y.at[j] = vndf_interval_scaled(x->at[j], j);
    return y;
}

/* y_k of y' = d x'; dx is inner(x). */
static vndf_interval next(const vndf_jet *dx, const vndf_jet *d, int k)
{
    vndf_interval sum = folded(dx, d, 1, k);
    return k == 1 ? sum : vndf_interval_scaled(sum, 1.0 / k);
}

static vndf_jet by_derivative(vndf_interval value, const vndf_jet *x, const vndf_jet *d)
{
    vndf_jet y = constant_of(value), dx = inner(x);
    y.constant = x->constant;
    for (int k = 1; k <= VNDF_JET && !x->constant; k++)
        y.at[k] = next(&dx, d, k);
    return y;
}

vndf_jet vndf_jet_exp(const vndf_jet *x)
{
    vndf_jet y = constant_of(vndf_interval_exp(x->at[0])), dx = inner(x);
    y.constant = x->constant;
    for (int k = 1; k <= VNDF_JET && !x->constant; k++)
        y.at[k] = next(&dx, &y, k);
    return y;
}

static vndf_jet reciprocal(const vndf_jet *x)
{
    vndf_jet one = vndf_jet_number(1);
    return vndf_jet_quotient(&one, x);
}

vndf_jet vndf_jet_log(const vndf_jet *x)
{
    vndf_jet d = reciprocal(x);
    vndf_interval y = vndf_interval_log(x->at[0]);
    return x->at[0].low.m > 0 ? by_derivative(y, x, &d) : value_of(y, x);
}

/* y and its derivative z together: y' = z x'; z' = y x', or -y x' if `negative`. */
static vndf_jet coupled(const vndf_jet *x, vndf_interval value, vndf_interval other, int negative)
{
    vndf_jet y = constant_of(value), z = constant_of(other), dx = inner(x);
    y.constant = x->constant;
    for (int k = 1; k <= VNDF_JET && !x->constant; k++) {
        vndf_interval back = next(&dx, &y, k);
        y.at[k] = next(&dx, &z, k);
        z.at[k] = negative ? vndf_interval_negative(back) : back;
    }
    return y;
}

vndf_jet vndf_jet_sin(const vndf_jet *x)
{
    return coupled(x, vndf_interval_sin(x->at[0]), vndf_interval_cos(x->at[0]), 1);
}

vndf_jet vndf_jet_cos(const vndf_jet *x)
{
    return coupled(x, vndf_interval_cos(x->at[0]), vndf_interval_negative(vndf_interval_sin(x->at[0])), 1);
}

vndf_jet vndf_jet_sinh(const vndf_jet *x)
{
    return coupled(x, vndf_interval_sinh(x->at[0]), vndf_interval_cosh(x->at[0]), 0);
}

vndf_jet vndf_jet_cosh(const vndf_jet *x)
{
    return coupled(x, vndf_interval_cosh(x->at[0]), vndf_interval_sinh(x->at[0]), 0);
}

/* ---- powers ---- */

/* k x_0 y_k = sum of (p j - (k - j)) x_j y_(k-j). */
static vndf_jet power_off_zero(const vndf_jet *x, double p)
{
    vndf_jet y = constant_of(vndf_interval_power(x->at[0], p));
    y.constant = x->constant;
    for (int k = 1; k <= VNDF_JET && !x->constant; k++) {
        vndf_interval sum = zero;
        for (int j = 1; j <= k; j++) {
            vndf_interval term = vndf_interval_product(x->at[j], y.at[k - j]);
            sum = vndf_interval_sum(sum, vndf_interval_scaled(term, (p * j - (k - j)) / k));
        }
        y.at[k] = vndf_interval_quotient(sum, x->at[0]);
    }
    return y;
}

/* Whole exponents of at least 0, by products. */
static vndf_jet power_by_products(const vndf_jet *x, int n)
{
    vndf_jet y = vndf_jet_number(1), square = *x;
    for (int rest = n; rest > 0; rest /= 2) {
        if (rest % 2)
            y = vndf_jet_product(&y, &square);
        if (rest > 1)
            square = vndf_jet_product(&square, &square);
    }
    y.at[0] = vndf_interval_power(x->at[0], n);
    return y;
}

static vndf_jet power_of(const vndf_jet *x, double p)
{
    enum { PRODUCTS = 1 << 20 };
    if (!vndf_interval_vanishes(x->at[0]) && (x->at[0].low.m > 0 || p == floor(p)))
        return power_off_zero(x, p);
    if (p == floor(p) && p >= 0 && p < PRODUCTS)
        return power_by_products(x, (int)p);
    return value_of(vndf_interval_power(x->at[0], p), x);
}

vndf_jet vndf_jet_sqrt(const vndf_jet *x)
{
    return power_of(x, 0.5);
}

static int is_point(const vndf_jet *x)
{
    return x->constant && x->at[0].low.m == x->at[0].high.m && x->at[0].low.e == x->at[0].high.e;
}

vndf_jet vndf_jet_pow(const vndf_jet *x, const vndf_jet *y)
{
    if (is_point(y) && isfinite(vndf_wide_double(y->at[0].low)))
        return power_of(x, vndf_wide_double(y->at[0].low));
    if (x->at[0].low.m < 0) /* unless the exponent is whole there is no value */
        return x->constant && y->constant ? unknown(x) : x->constant ? unknown(y) : unknown(x);
    vndf_jet log = vndf_jet_log(x), product = vndf_jet_product(y, &log);
    return vndf_jet_exp(&product);
}

/* ---- arcs and their kin ---- */

/* (1 + sign x^2)^p. */
static vndf_jet one_and_square(const vndf_jet *x, int sign, double p)
{
    vndf_jet square = power_of(x, 2), one = vndf_jet_number(1);
    vndf_jet sum = sign > 0 ? vndf_jet_sum(&one, &square) : vndf_jet_difference(&one, &square);
    return p == -1 ? reciprocal(&sum) : power_of(&sum, p);
}

vndf_jet vndf_jet_tan(const vndf_jet *x)
{
    vndf_jet cosine = vndf_jet_cos(x), d = power_of(&cosine, -2);
    return by_derivative(vndf_interval_tan(x->at[0]), x, &d);
}

vndf_jet vndf_jet_asin(const vndf_jet *x)
{
    vndf_jet d = one_and_square(x, -1, -0.5);
    return by_derivative(vndf_interval_asin(x->at[0]), x, &d);
}

vndf_jet vndf_jet_acos(const vndf_jet *x)
{
    vndf_jet d = one_and_square(x, -1, -0.5), e = vndf_jet_negative(&d);
    return by_derivative(vndf_interval_acos(x->at[0]), x, &e);
}

vndf_jet vndf_jet_atan(const vndf_jet *x)
{
    vndf_jet d = one_and_square(x, 1, -1);
    return by_derivative(vndf_interval_atan(x->at[0]), x, &d);
}

/* 1 - tanh^2 would lose its digits. */
vndf_jet vndf_jet_tanh(const vndf_jet *x)
{
    vndf_jet cosh = vndf_jet_cosh(x), d = power_of(&cosh, -2);
    return by_derivative(vndf_interval_tanh(x->at[0]), x, &d);
}

/* factor exp(-x^2), factor = 2/sqrt(pi) but for its sign. */
static vndf_jet bell(const vndf_jet *x, double sign)
{
    vndf_jet square = power_of(x, 2), negative = vndf_jet_negative(&square), y = vndf_jet_exp(&negative);
    return multiple(&y, vndf_interval_scaled(vndf_interval_from(1.1283791670955125, 1.1283791670955127), sign));
}

vndf_jet vndf_jet_erf(const vndf_jet *x)
{
    vndf_jet d = bell(x, 1);
    return by_derivative(vndf_interval_erf(x->at[0]), x, &d);
}

vndf_jet vndf_jet_erfc(const vndf_jet *x)
{
    vndf_jet d = bell(x, -1);
    return by_derivative(vndf_interval_erfc(x->at[0]), x, &d);
}

/* By Faa di Bruno's formula from the derivatives of lgamma itself. */
vndf_jet vndf_jet_lgamma(const vndf_jet *x)
{
    vndf_jet y = value_of(vndf_interval_lgamma(x->at[0]), x);
    if (x->constant || !(x->at[0].low.m > 0))
        return y;
    vndf_interval t1 = vndf_interval_polygamma(0, x->at[0]);
    vndf_interval t2 = vndf_interval_scaled(vndf_interval_polygamma(1, x->at[0]), 0.5);
    vndf_interval t3 = vndf_interval_scaled(vndf_interval_polygamma(2, x->at[0]), 1.0 / 6);
    vndf_interval square = vndf_interval_power(x->at[1], 2), cube = vndf_interval_power(x->at[1], 3);
    vndf_interval cross = vndf_interval_scaled(vndf_interval_product(x->at[1], x->at[2]), 2);
    y.at[1] = vndf_interval_product(t1, x->at[1]);
    y.at[2] = vndf_interval_sum(vndf_interval_product(t1, x->at[2]), vndf_interval_product(t2, square));
    y.at[3] =
        vndf_interval_sum(vndf_interval_product(t1, x->at[3]),
                          vndf_interval_sum(vndf_interval_product(t2, cross), vndf_interval_product(t3, cube)));
    return y;
}

static vndf_jet gamma_of_number(const vndf_jet *x)
{
    double low = tgamma(vndf_interval_low(x->at[0])), error = 1e-13 * fabs(low);
    return is_point(x) && isfinite(low) ? constant_of(vndf_interval_from(low - error, low + error)) : unknown(x);
}

vndf_jet vndf_jet_gamma(const vndf_jet *x)
{
    vndf_jet log = vndf_jet_lgamma(x);
    return x->at[0].low.m > 0 ? vndf_jet_exp(&log) : gamma_of_number(x);
}

/* ---- kinks and jumps ---- */

/* x or y, which may differ from point to point; the caller gives the value. */
static vndf_jet either(const vndf_jet *x, const vndf_jet *y, vndf_interval value)
{
    vndf_jet z = value_of(value, x->constant ? y : x);
    if (!z.constant)
        z.at[1] = vndf_interval_hull(x->at[1], y->at[1]);
    return z;
}

vndf_jet vndf_jet_max(const vndf_jet *x, const vndf_jet *y)
{
    vndf_interval a = x->at[0], b = y->at[0], larger = vndf_interval_hull(a, b);
    if (!vndf_wide_less(b.low, a.high))
        return *y;
    if (!vndf_wide_less(a.low, b.high))
        return *x;
    larger.low = vndf_wide_less(a.low, b.low) ? b.low : a.low;
    return either(x, y, larger);
}

vndf_jet vndf_jet_min(const vndf_jet *x, const vndf_jet *y)
{
    vndf_jet a = vndf_jet_negative(x), b = vndf_jet_negative(y), larger = vndf_jet_max(&a, &b);
    return vndf_jet_negative(&larger);
}

vndf_jet vndf_jet_abs(const vndf_jet *x)
{
    vndf_jet negative = vndf_jet_negative(x);
    return vndf_jet_max(x, &negative);
}

vndf_jet vndf_jet_step(const vndf_jet *x)
{
    if (x->at[0].low.m >= 0)
        return vndf_jet_number(1);
    return x->at[0].high.m < 0 ? vndf_jet_number(0) : value_of(vndf_interval_from(0, 1), x);
}
