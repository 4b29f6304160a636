/* Bounds of formulas on intervals of slopes, by Taylor coefficients of composed functions and the recurrences of
 * automatic differentiation (Moore, Interval Analysis, 1966; Griewank & Walther, Evaluating Derivatives, 2008, ch. 13):
 * y' = d x' is k y_k = sum of j x_j d_(k-j), j from 1 to k. */
#include <math.h>

#include "source/formula/expression.h"

static const double PI = 3.14159265358979323846;
static const double FAR = 25; /* cosh is half an exponential in doubles; erfc is near its smallest value */

static vndf_jet constant(vndf_interval value)
{
    return (vndf_jet){1, {value}};
}

vndf_jet vndf_jet_number(double x)
{
    return constant(vndf_interval_from(x, x));
}

/* Whether it is a finite number, known exactly. */
static int is_number(vndf_jet x)
{
    vndf_wide low = x.at[0].low, high = x.at[0].high;
    return x.constant && low.m == high.m && low.e == high.e;
}

/* A function of x of which only the value is known. */
static vndf_jet unsmooth(vndf_interval value, vndf_jet x)
{
    vndf_interval all = vndf_interval_all();
    return x.constant ? constant(value) : (vndf_jet){0, {value, all, all, all}};
}

/* Whether 0 lies in the value, ends included. */
static int vanishes(vndf_jet x)
{
    return x.at[0].low.m <= 0 && x.at[0].high.m >= 0;
}

/* ---- arithmetic ---- */

static vndf_jet negative(vndf_jet x)
{
    for (int k = 0; k <= VNDF_JET; k++)
        x.at[k] = vndf_interval_negative(x.at[k]);
    return x;
}

static vndf_jet sum(vndf_jet x, vndf_jet y)
{
    vndf_jet z = x.constant ? y : x;
    z.at[0] = vndf_interval_sum(x.at[0], y.at[0]);
    for (int k = 1; k <= VNDF_JET && !x.constant && !y.constant; k++)
        z.at[k] = vndf_interval_sum(x.at[k], y.at[k]);
    return z;
}

static vndf_jet difference(vndf_jet x, vndf_jet y)
{
    return sum(x, negative(y));
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
    vndf_interval all = vndf_interval_product(x->at[first], y->at[k - first]);
    for (int j = first + 1; j <= k; j++)
        all = vndf_interval_sum(all, vndf_interval_product(x->at[j], y->at[k - j]));
    return all;
}

static vndf_jet product(vndf_jet x, vndf_jet y)
{
    vndf_jet z = {0, {x.at[0]}};
    if (x.constant || y.constant)
        return x.constant ? multiple(y, x.at[0]) : multiple(x, y.at[0]);
    for (int k = 0; k <= VNDF_JET; k++)
        z.at[k] = folded(&x, &y, 0, k);
    return z;
}

static vndf_jet quotient(vndf_jet x, vndf_jet y)
{
    vndf_jet z = {0, {vndf_interval_quotient(x.at[0], y.at[0])}};
    if (vanishes(y))
        return unsmooth(z.at[0], x.constant ? y : x);
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
    vndf_interval all = folded(dx, d, 1, k);
    return k == 1 ? all : vndf_interval_scaled(all, 1.0 / k);
}

/* y and its derivative by x, which is d. */
static vndf_jet integral(vndf_interval value, vndf_jet x, vndf_jet d)
{
    vndf_jet y = {x.constant, {value}}, dx = inner(x);
    for (int k = 1; k <= VNDF_JET && !x.constant; k++)
        y.at[k] = next(&dx, &d, k);
    return y;
}

/* y and z with y' = z and z' = sign y, where sign is 1 or -1: sin, cosh and their kin. */
static vndf_jet wave(vndf_jet x, vndf_interval value, vndf_interval other, int sign)
{
    vndf_jet y = {x.constant, {value}}, z = {x.constant, {other}}, dx = inner(x);
    for (int k = 1; k <= VNDF_JET && !x.constant; k++) {
        vndf_interval back = next(&dx, &y, k);
        y.at[k] = next(&dx, &z, k);
        z.at[k] = sign < 0 ? vndf_interval_negative(back) : back;
    }
    return y;
}

static vndf_jet exponential(vndf_jet x)
{
    vndf_interval y = vndf_interval_exp(x.at[0]);
    return wave(x, y, y, 1);
}

/* ---- powers ---- */

/* k x_0 y_k = sum of (p j - (k - j)) x_j y_(k-j). */
static vndf_jet power_off_zero(vndf_jet x, double p)
{
    vndf_jet y = {x.constant, {vndf_interval_power(x.at[0], p)}};
    for (int k = 1; k <= VNDF_JET && !x.constant; k++) {
        vndf_interval all = vndf_interval_from(0, 0);
        for (int j = 1; j <= k; j++) {
            vndf_interval term = vndf_interval_product(x.at[j], y.at[k - j]);
            all = vndf_interval_sum(all, vndf_interval_scaled(term, (p * j - (k - j)) / k));
        }
        y.at[k] = vndf_interval_quotient(all, x.at[0]);
    }
    return y;
}

/* Whole exponents of at least 0, by products. */
static vndf_jet power_by_products(vndf_jet x, int n)
{
    vndf_jet y = vndf_jet_number(1), square = x;
    for (int rest = n; rest > 0; rest /= 2) {
        if (rest % 2)
            y = product(y, square);
        if (rest > 1)
            square = product(square, square);
    }
    y.at[0] = vndf_interval_power(x.at[0], n);
    return y;
}

static vndf_jet power(vndf_jet x, double p)
{
    enum { PRODUCTS = 1 << 20 };
    if (!vanishes(x) && (x.at[0].low.m > 0 || p == floor(p)))
        return power_off_zero(x, p);
    if (p == floor(p) && p >= 0 && p < PRODUCTS)
        return power_by_products(x, (int)p);
    return unsmooth(vndf_interval_power(x.at[0], p), x);
}

/* ---- functions ---- */

static double low_of(vndf_jet x)
{
    return vndf_interval_low(x.at[0]);
}

static double high_of(vndf_jet x)
{
    return vndf_interval_high(x.at[0]);
}

/* A function that rises, from its bounds at the two ends. */
static vndf_interval rising(vndf_interval (*at)(vndf_interval), vndf_interval x)
{
    return (vndf_interval){at((vndf_interval){x.low, x.low}).low, at((vndf_interval){x.high, x.high}).high};
}

static vndf_interval rising_in_library(double (*f)(double), vndf_jet x, double least, double most)
{
    double low = low_of(x), high = high_of(x);
    if (low > most || high < least)
        return vndf_interval_all();
    return vndf_interval_of_library(f(fmax(low, least)), f(fmin(high, most)));
}

/* log(x), or log1p(x - 1), whose value is given. */
static vndf_jet logarithm(vndf_interval value, vndf_jet x)
{
    return x.at[0].low.m > 0 ? integral(value, x, quotient(vndf_jet_number(1), x)) : unsmooth(value, x);
}

static vndf_interval log1p_at(vndf_interval x)
{
    double low = vndf_interval_low(x);
    if (low > 1)
        return vndf_interval_log(vndf_interval_sum(vndf_interval_from(1, 1), x));
    return vndf_interval_of_library(log1p(low), log1p(low)); /* all, where that is not a number */
}

static vndf_jet power_of(vndf_jet x, vndf_jet y)
{
    if (is_number(y))
        return power(x, low_of(y));
    if (x.at[0].low.m < 0) /* unless the exponent is whole there is no value */
        return unsmooth(vndf_interval_all(), product(x, y));
    return exponential(product(y, logarithm(vndf_interval_log(x.at[0]), x)));
}

/* Whether place + n period lies in [low, high] for some n, or nearly. */
static int meets(double low, double high, double place, double period)
{
    double margin = 1e-15 * (1 + fabs(low) + fabs(high));
    return floor((high + margin - place) / period) >= ceil((low - margin - place) / period);
}

/* sin and cos: 1 at top + 2 pi n, -1 half a turn later. */
static vndf_interval circular(double (*f)(double), vndf_jet x, double top)
{
    double low = low_of(x), high = high_of(x);
    if (!(high - low < 2 * PI) || fabs(low) > 1e9)
        return vndf_interval_from(-1, 1);
    double a = f(low), b = f(high);
    vndf_interval y = vndf_interval_of_library(fmin(a, b), fmax(a, b));
    double least = vndf_interval_low(y), most = vndf_interval_high(y);
    return vndf_interval_from(meets(low, high, top + PI, 2 * PI) ? -1 : fmax(least, -1),
                              meets(low, high, top, 2 * PI) ? 1 : fmin(most, 1));
}

/* (1 + sign x^2)^p. */
static vndf_jet one_and_square(vndf_jet x, int sign, double p)
{
    vndf_jet square = power(x, 2), one = vndf_jet_number(1);
    return power(sign > 0 ? sum(one, square) : difference(one, square), p);
}

static double acos_of_negative(double x)
{
    return acos(-x);
}

/* Half of exp(x) + sign exp(-x). */
static vndf_interval half_exps(vndf_interval x, double sign)
{
    vndf_interval up = vndf_interval_exp(x), down = vndf_interval_exp(vndf_interval_negative(x));
    return vndf_interval_scaled(vndf_interval_sum(up, vndf_interval_scaled(down, sign)), 0.5);
}

static vndf_interval sinh_at(vndf_interval x)
{
    double d = vndf_interval_low(x);
    return fabs(d) < FAR ? vndf_interval_of_library(sinh(d), sinh(d)) : half_exps(x, -1);
}

static vndf_interval cosh_at(vndf_interval x)
{
    double d = vndf_interval_low(x);
    return fabs(d) < FAR ? vndf_interval_of_library(cosh(d), cosh(d)) : half_exps(x, 1);
}

/* A function that rises from -1 to 1, and is 1 in doubles from x = full on. There the interval has no width, so
 * that the difference of two such functions vanishes. */
static vndf_interval saturating(double (*f)(double), vndf_jet x, double full)
{
    double low = low_of(x), high = high_of(x);
    vndf_interval y = vndf_interval_of_library(f(low), f(high));
    if (fabs(low) >= full)
        y.low.m = low < 0 ? -1 : 1;
    if (fabs(high) >= full)
        y.high.m = high < 0 ? -1 : 1;
    return y;
}

/* factor exp(-x^2), factor = 2/sqrt(pi) but for its sign. */
static vndf_jet bell(vndf_jet x, double sign)
{
    vndf_interval factor = vndf_interval_scaled(vndf_interval_from(1.1283791670955125, 1.1283791670955127), sign);
    return multiple(exponential(negative(power(x, 2))), factor);
}

/* erfc(-x), which rises: exp(-x^2)/(2 |x|) < erfc |x| < 0.6 exp(-x^2)/|x| for |x| >= 25. */
static vndf_interval erfc_of_negative(vndf_interval x)
{
    double d = vndf_interval_low(x);
    if (d > -FAR)
        return vndf_interval_of_library(erfc(-d), erfc(-d));
    vndf_interval shape = vndf_interval_exp(vndf_interval_negative(vndf_interval_product(x, x)));
    vndf_interval part = vndf_interval_quotient(vndf_interval_from(0.5, 0.6), vndf_interval_negative(x));
    return vndf_interval_product(shape, part);
}

/* Of a number alone: formulas have it in constants. */
static vndf_jet gamma_of(double (*f)(double), vndf_jet x)
{
    double value = f(low_of(x)), error = 1e-13 * (1 + fabs(value));
    int known = is_number(x) && isfinite(value);
    return unsmooth(known ? vndf_interval_from(value - error, value + error) : vndf_interval_all(), x);
}

/* Where x and y overlap, either of them, which may differ from point to point. */
static vndf_jet larger(vndf_jet x, vndf_jet y)
{
    vndf_interval a = x.at[0], b = y.at[0], both = vndf_interval_hull(a, b);
    if (!vndf_wide_less(b.low, a.high))
        return y;
    if (!vndf_wide_less(a.low, b.high))
        return x;
    both.low = vndf_wide_less(a.low, b.low) ? b.low : a.low;
    vndf_jet z = unsmooth(both, x.constant ? y : x);
    if (!z.constant)
        z.at[1] = vndf_interval_hull(x.at[1], y.at[1]);
    return z;
}

/* y is of no matter where the function has one argument. */
static vndf_jet of_function(int function, vndf_jet x, vndf_jet y)
{
    vndf_interval value = x.at[0], size = vndf_interval_size(value);
    vndf_jet one = vndf_jet_number(1), less = negative(x);
    switch (function) {
    case VNDF_EXP: return exponential(x);
    case VNDF_LOG: return logarithm(vndf_interval_log(value), x);
    case VNDF_LOG1P: return logarithm(rising(log1p_at, value), sum(one, x));
    case VNDF_SQRT: return power(x, 0.5);
    case VNDF_SIN: return wave(x, circular(sin, x, PI / 2), circular(cos, x, 0), -1);
    case VNDF_COS: return wave(x, circular(cos, x, 0), vndf_interval_negative(circular(sin, x, PI / 2)), -1);
    case VNDF_TAN: return quotient(of_function(VNDF_SIN, x, x), of_function(VNDF_COS, x, x));
    case VNDF_ASIN: return integral(rising_in_library(asin, x, -1, 1), x, one_and_square(x, -1, -0.5));
    case VNDF_ACOS:
        return integral(rising_in_library(acos_of_negative, less, -1, 1), x,
                        negative(one_and_square(x, -1, -0.5)));
    case VNDF_ATAN: return integral(rising_in_library(atan, x, -HUGE_VAL, HUGE_VAL), x, one_and_square(x, 1, -1));
    case VNDF_SINH: return wave(x, rising(sinh_at, value), rising(cosh_at, size), 1);
    case VNDF_COSH: return wave(x, rising(cosh_at, size), rising(sinh_at, value), 1);
    case VNDF_TANH: /* 1 - tanh^2 would lose its digits */
        return integral(saturating(tanh, x, 20), x, power(of_function(VNDF_COSH, x, x), -2));
    case VNDF_ERF: return integral(saturating(erf, x, 6), x, bell(x, 1));
    case VNDF_ERFC: return integral(rising(erfc_of_negative, less.at[0]), x, bell(x, -1));
    case VNDF_LGAMMA: return gamma_of(lgamma, x);
    case VNDF_GAMMA: return gamma_of(tgamma, x);
    case VNDF_ABS: return larger(x, less);
    case VNDF_MIN: return negative(larger(less, negative(y)));
    case VNDF_MAX: return larger(x, y);
    case VNDF_POW: return power_of(x, y);
    default: /* VNDF_STEP */
        if (value.low.m >= 0 || value.high.m < 0)
            return vndf_jet_number(value.low.m >= 0);
        return unsmooth(vndf_interval_from(0, 1), x);
    }
}

/* ---- formulas ---- */

static vndf_jet combined(const vndf_instruction *at, vndf_jet x, vndf_jet y)
{
    switch (at->operation) {
    case '+': return sum(x, y);
    case '-': return difference(x, y);
    case '*': return product(x, y);
    case '/': return quotient(x, y);
    case '^': return power_of(x, y);
    case VNDF_NEGATE: return negative(x);
    default: return of_function(at->function, x, y);
    }
}

vndf_jet vndf_expression_jet(const vndf_expression *expression, const vndf_jet *variables)
{
    vndf_jet stack[VNDF_EXPRESSION_STACK], *top = stack; /* behind the last operand */
    for (const vndf_instruction *at = expression->program; at < expression->program + expression->count; at++) {
        top += at->change;
        if (at->change > 0)
            top[-1] = at->operation == VNDF_PUSH_NUMBER ? vndf_jet_number(at->number) : variables[at->variable];
        else
            top[-1] = combined(at, top[-1], top[-1 - at->change]);
    }
    return top[-1];
}

/* r = exp(u): all derivatives are r. */
vndf_jet vndf_jet_of_slope(double low, double high)
{
    vndf_interval r = vndf_interval_from(low, high);
    return (vndf_jet){0, {r, r, vndf_interval_scaled(r, 0.5), vndf_interval_scaled(r, 1.0 / 6)}};
}

/* F at r; of D, it is the formula times c^4. */
static vndf_jet unit_lobe(vndf_formula_of of, const vndf_expression *formula, vndf_jet r)
{
    if (of == VNDF_FORMULA_OF_P22)
        return vndf_expression_jet(formula, &r);
    vndf_jet q = sum(vndf_jet_number(1), product(r, r));
    vndf_jet variables[VNDF_VARIABLES] = {power(q, -0.5), of_function(VNDF_ATAN, r, r), r};
    return quotient(vndf_expression_jet(formula, variables), product(q, q));
}

vndf_jet vndf_lobes_jet(vndf_formula_of of, const vndf_lobe *lobes, size_t count, vndf_jet r)
{
    vndf_jet all = vndf_jet_number(0);
    for (const vndf_lobe *l = lobes; l < lobes + count; l++) {
        vndf_jet value = unit_lobe(of, &l->formula, quotient(r, vndf_jet_number(l->scale)));
        all = sum(all, product(vndf_jet_number(l->factor), value));
    }
    return all;
}

/* If the k-th Taylor coefficient of f lies within an interval of width w on a whole piece of width h with middle
 * m, f is within w/2 |u - m|^k of a polynomial of degree k, and the integral of the difference is at most w
 * (h/2)^(k+1)/(k+1). */
vndf_reach vndf_lobes_reach(vndf_formula_of of, const vndf_lobe *lobes, size_t count, double low, double high)
{
    vndf_jet r = vndf_jet_of_slope(low, high), p22 = vndf_lobes_jet(of, lobes, count, r),
             f = product(product(p22, r), r);
    double h = log(high / low) * (1 + 1e-9), way = h / 2;
    vndf_reach reach = {low_of(p22), high_of(p22), HUGE_VAL};
    for (int k = 0; k <= VNDF_JET; k++, way *= h / 2) {
        double stray = vndf_interval_high(vndf_interval_difference(f.at[k], f.at[k])) * way / (k + 1);
        reach.stray = stray < reach.stray ? stray : reach.stray;
    }
    return reach;
}
