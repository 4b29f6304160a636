/* The functions of formulas: of each its value and its bounds. Every function lets NaN pass,
 * so that the builder can say where a formula has no value; fmin and fmax of the C library would hide it. */
#include <math.h>

#include "source/formula/expression.h"
#include "source/words.h"

enum { EXP, LOG, LOG1P, SQRT, SIN, COS, TAN, ASIN, ACOS, ATAN, SINH, COSH, TANH, ERF, ERFC, LGAMMA, GAMMA };
enum { ABS = GAMMA + 1, MIN, MAX, POW, STEP };

static const double PI = 3.14159265358979323846;
static const double FAR = 25; /* cosh is half an exponential in doubles; erfc is near its smallest value */

/* ---- values ---- */

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
    [EXP] = {"exp", exp, NULL},          [LOG] = {"log", log, NULL},        [LOG1P] = {"log1p", log1p, NULL},
    [SQRT] = {"sqrt", sqrt, NULL},       [SIN] = {"sin", sin, NULL},        [COS] = {"cos", cos, NULL},
    [TAN] = {"tan", tan, NULL},          [ASIN] = {"asin", asin, NULL},     [ACOS] = {"acos", acos, NULL},
    [ATAN] = {"atan", atan, NULL},       [SINH] = {"sinh", sinh, NULL},     [COSH] = {"cosh", cosh, NULL},
    [TANH] = {"tanh", tanh, NULL},       [ERF] = {"erf", erf, NULL},        [ERFC] = {"erfc", erfc, NULL},
    [LGAMMA] = {"lgamma", lgamma, NULL}, [GAMMA] = {"gamma", tgamma, NULL}, [ABS] = {"abs", fabs, NULL},
    [MIN] = {"min", NULL, smaller},      [MAX] = {"max", NULL, larger},     [POW] = {"pow", NULL, pow},
    [STEP] = {"step", step, NULL},
};

/* ---- bounds ---- */

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

/* ---- logarithm ---- */

static vndf_interval log1p_at(vndf_interval x)
{
    double low = vndf_interval_low(x);
    if (low > 1)
        return vndf_interval_log(vndf_interval_sum(vndf_interval_from(1, 1), x));
    return low < -1 ? vndf_interval_from(-HUGE_VAL, -HUGE_VAL) : vndf_interval_of_library(log1p(low), log1p(low));
}

static vndf_jet log1p_of(vndf_jet x)
{
    vndf_jet sum = vndf_jet_sum(vndf_jet_number(1), x);
    vndf_interval y = high_of(x) < -1 ? vndf_interval_all() : rising(log1p_at, x.at[0]);
    return sum.at[0].low.m > 0 ? vndf_jet_integral(y, x, vndf_jet_quotient(vndf_jet_number(1), sum))
                               : vndf_jet_value(y, x);
}

/* ---- circular and hyperbolic functions ---- */

/* Whether place + n period lies in [low, high] for some n, or nearly. */
static int meets(double low, double high, double place, double period)
{
    double margin = 1e-15 * (1 + fabs(low) + fabs(high));
    return floor((high + margin - place) / period) >= ceil((low - margin - place) / period);
}

/* sin and cos: 1 at top + 2 pi n, -1 half a turn later. */
static vndf_interval wave(double (*f)(double), vndf_jet x, double top)
{
    double low = low_of(x), high = high_of(x);
    if (!(high - low < 2 * PI) || fabs(low) > 1e9 || fabs(high) > 1e9)
        return vndf_interval_from(-1, 1);
    double a = f(low), b = f(high);
    vndf_interval y = vndf_interval_of_library(fmin(a, b), fmax(a, b));
    double least = vndf_interval_low(y), most = vndf_interval_high(y);
    return vndf_interval_from(meets(low, high, top + PI, 2 * PI) ? -1 : fmax(least, -1),
                              meets(low, high, top, 2 * PI) ? 1 : fmin(most, 1));
}

static vndf_jet tan_of(vndf_jet x)
{
    double low = low_of(x), high = high_of(x);
    int pole = !(high - low < PI) || fabs(low) > 1e9 || fabs(high) > 1e9 || meets(low, high, PI / 2, PI);
    vndf_interval y = pole ? vndf_interval_all() : vndf_interval_of_library(tan(low), tan(high));
    return vndf_jet_integral(y, x, vndf_jet_power(vndf_function_jet(&functions[COS], x, x), -2));
}

/* (1 + sign x^2)^p. */
static vndf_jet one_and_square(vndf_jet x, int sign, double p)
{
    vndf_jet square = vndf_jet_power(x, 2), one = vndf_jet_number(1);
    return vndf_jet_power(sign > 0 ? vndf_jet_sum(one, square) : vndf_jet_difference(one, square), p);
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

/* ---- the error function ---- */

/* factor exp(-x^2), factor = 2/sqrt(pi) but for its sign. */
static vndf_jet bell(vndf_jet x, double sign)
{
    vndf_interval factor = vndf_interval_scaled(vndf_interval_from(1.1283791670955125, 1.1283791670955127), sign);
    return vndf_jet_product(vndf_jet_exp(vndf_jet_negative(vndf_jet_power(x, 2))), vndf_jet_constant(factor));
}

/* erfc(-x), which rises: exp(-x^2)/(2 |x|) < erfc |x| < 0.6 exp(-x^2)/|x| for |x| >= 25. */
static vndf_interval erfc_of_negative(vndf_interval x)
{
    double d = vndf_interval_low(x);
    if (d > -FAR || isinf(d))
        return vndf_interval_of_library(erfc(-d), erfc(-d));
    vndf_interval bell = vndf_interval_exp(vndf_interval_negative(vndf_interval_product(x, x)));
    vndf_interval part = vndf_interval_quotient(vndf_interval_from(0.5, 0.6), vndf_interval_negative(x));
    return vndf_interval_product(bell, part);
}

/* ---- gamma ---- */

/* Of a number alone: formulas have it in constants. */
static vndf_jet gamma_of(double (*f)(double), vndf_jet x)
{
    double value = f(low_of(x)), error = 1e-13 * (1 + fabs(value));
    int known = vndf_jet_is_number(x) && isfinite(value);
    return vndf_jet_value(known ? vndf_interval_from(value - error, value + error) : vndf_interval_all(), x);
}

/* ---- the list ---- */

vndf_jet vndf_function_jet(const vndf_function *function, vndf_jet x, vndf_jet y)
{
    vndf_interval value = x.at[0], size = vndf_interval_size(value);
    vndf_jet negative = vndf_jet_negative(x);
    switch (function - functions) {
    case EXP: return vndf_jet_exp(x);
    case LOG: return vndf_jet_log(x);
    case LOG1P: return log1p_of(x);
    case SQRT: return vndf_jet_power(x, 0.5);
    case SIN: return vndf_jet_wave(x, wave(sin, x, PI / 2), wave(cos, x, 0), -1);
    case COS: return vndf_jet_wave(x, wave(cos, x, 0), vndf_interval_negative(wave(sin, x, PI / 2)), -1);
    case TAN: return tan_of(x);
    case ASIN: return vndf_jet_integral(rising_in_library(asin, x, -1, 1), x, one_and_square(x, -1, -0.5));
    case ACOS:
        return vndf_jet_integral(rising_in_library(acos_of_negative, negative, -1, 1), x,
                                 vndf_jet_negative(one_and_square(x, -1, -0.5)));
    case ATAN:
        return vndf_jet_integral(rising_in_library(atan, x, -HUGE_VAL, HUGE_VAL), x, one_and_square(x, 1, -1));
    case SINH: return vndf_jet_wave(x, rising(sinh_at, value), rising(cosh_at, size), 1);
    case COSH: return vndf_jet_wave(x, rising(cosh_at, size), rising(sinh_at, value), 1);
    case TANH: /* 1 - tanh^2 would lose its digits */
        return vndf_jet_integral(saturating(tanh, x, 20), x,
                                 vndf_jet_power(vndf_function_jet(&functions[COSH], x, x), -2));
    case ERF: return vndf_jet_integral(saturating(erf, x, 6), x, bell(x, 1));
    case ERFC: return vndf_jet_integral(rising(erfc_of_negative, negative.at[0]), x, bell(x, -1));
    case LGAMMA:
    case GAMMA: return gamma_of(function->one, x);
    case ABS: return vndf_jet_max(x, negative);
    case MIN: return vndf_jet_negative(vndf_jet_max(negative, vndf_jet_negative(y)));
    case MAX: return vndf_jet_max(x, y);
    case POW: return vndf_jet_pow(x, y);
    default: /* STEP */
        if (value.low.m >= 0 || value.high.m < 0)
            return vndf_jet_number(value.low.m >= 0);
        return vndf_jet_value(vndf_interval_from(0, 1), x);
    }
}

const vndf_function *vndf_function_at(size_t index)
{
    return index < sizeof functions / sizeof *functions ? &functions[index] : NULL;
}

const vndf_function *vndf_function_find(const char *name, size_t size)
{
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (vndf_is_word(name, size, functions[i].name))
            return &functions[i];
    return NULL;
}
