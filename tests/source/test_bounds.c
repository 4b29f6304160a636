/* What the interval arithmetic says of a formula holds: every value on a piece lies within its bounds, Taylor
 * coefficients of a point within those of every piece about it, and each coefficient is the derivative of the one
 * before. For every function and operator, at pieces of relative width 1e-12 to 1, at numbers of any size, and for the
 * formulas that stand for families. */
#include "harness/test.h"

#include "source/formula/expression.h"
#include "source/family/family.h"

/* clang-format off */
static const char *const formulas[] = {
    "r", "1/r", "-r+2-r/3", "(r-1)*(r-2)", "(r-1)/(r^2+1)", "1/(r-1.5)", "exp(-r)", "exp(-(r/1e-3)^2)", "log(r)",
    "sqrt(r)", "sqrt(abs(r-1))", "sqrt(max(0,1-r))", "sin(r)", "cos(3*r)", "tan(r)", "sin(1e10*r)", "asin(r/3)",
    "acos(r/100)", "atan(r-1)", "atan(1e9*(r-1))", "sinh(r-1)", "cosh(r)", "tanh(r-1)", "tanh((r-1)/1e-6)",
    "log1p(r-1)", "log1p(1e-9*r)", "erf(r-1)",
    "erfc(r-1)", "erfc(10*r)", "lgamma(r)", "lgamma(7)*r", "gamma(r+1)", "gamma(-0.5)*r", "abs(r-1)", "min(r,1)",
    "max(r,1/r)", "step(r-1)", "step(1-r)*exp(-r)", "r^2", "(r-1)^2", "(r-1)^3", "(r-1)^-2", "(r-1)^-1", "r^-1.7",
    "r^0.3", "(-r)^3", "(1-r)^0.5", "r^r", "2^(-r)", "pow(r,sin(r))", "cosh((r-1)/1e-4)^-2", "1/(1+exp((r-1)/1e-5))",
    "1+5*exp(-((r-1)/1e-8)^2)", "r^11*exp(-r^2)", "exp(r)/(1+exp(2*r))", "exp(-abs(r-1)/1e-3)", "(r-1)^0",
    "erf(r-1)-erf(r-2)", "exp(1e5*r)*exp(-1e5*r)", "1e300*r*1e300*1e-300*1e-300", "0^r", "0*log(r)", "log(r)^2",
    "(1-r)^r", "(r-1)^2e6", "log1p(-2*r)", "erfc(1/(1-r))", "1/min(r-1,0)", "1/exp(exp(exp(r)))", "r*gamma(200)",
};
/* clang-format on */

static vndf_expression expression;

static vndf_jet jet_of(double low, double high)
{
    vndf_jet r = vndf_jet_of_slope(low, high);
    return vndf_expression_jet(&expression, &r);
}

static double value_of(double r)
{
    vndf_points variables[1] = {{r}};
    double value;
    vndf_expression_run(&expression, variables, 1, &value);
    return value;
}

static int holds(vndf_interval a, double x)
{
    return vndf_interval_low(a) <= x && x <= vndf_interval_high(a);
}

static int meet(vndf_interval a, vndf_interval b)
{
    return !vndf_wide_less(a.high, b.low) && !vndf_wide_less(b.high, a.low);
}

static double middle(vndf_interval a)
{
    return 0.5 * vndf_interval_low(a) + 0.5 * vndf_interval_high(a);
}

static double size(vndf_interval a)
{
    return fmax(fabs(vndf_interval_low(a)), fabs(vndf_interval_high(a)));
}

static int is_close(vndf_interval a)
{
    return isfinite(size(a)) && vndf_interval_high(a) - vndf_interval_low(a) <= 1e-9 * size(a);
}

static void test_piece(const char *text, double low, double high, unsigned long long *state)
{
    vndf_jet all = jet_of(low, high);
    double r = fmin(fmax(low * exp(log(high / low) * test_uniform(state)), low), high);
    double value = value_of(r);
    vndf_jet at = jet_of(r, r);
    int good = isnan(value) || isinf(value) || TEST(holds(all.at[0], value));
    for (int k = 0; k <= VNDF_JET; k++)
        good &= TEST(meet(all.at[k], at.at[k]));
    if (!good)
        fprintf(stderr, "  %s at %.17g in [%.17g, %.17g]: %g, bounds %g to %g\n", text, r, low, high, value,
                vndf_interval_low(all.at[0]), vndf_interval_high(all.at[0]));
}

/* (k + 1) c_(k+1) is the derivative of c_k by log r; by differences, where points are known well and what they step
 * over is no more than a part of what is. */
static void test_derivatives(const char *text, double r)
{
    double h = 1e-5;
    vndf_jet at = jet_of(r, r), before = jet_of(r * exp(-h), r * exp(-h)), after = jet_of(r * exp(h), r * exp(h));
    for (int k = 0; k < VNDF_JET; k++) {
        if (!is_close(at.at[k + 1]) || !is_close(before.at[k]) || !is_close(after.at[k]))
            return;
        double want = (middle(after.at[k]) - middle(before.at[k])) / (2 * h) / (k + 1), got = middle(at.at[k + 1]);
        if (size(at.at[k + 1]) * h > 0.1 * size(at.at[k]) || size(at.at[k + 1]) < 1e-2 * size(at.at[k]))
            return;
        if (!TEST(fabs(got - want) <= 0.02 * fabs(got)))
            fprintf(stderr, "  %s at %g: coefficient %d is %g, not %g\n", text, r, k + 1, got, want);
    }
}

static void test_formula(const char *text, const vndf_parameter *parameters, size_t count)
{
    static const char *const variables[] = {"r"};
    vndf_names names = {variables, 1, parameters, count};
    unsigned long long state = 7;
    if (!TEST(vndf_expression_parse(text, &names, &expression, NULL) == VNDF_OK))
        return;
    for (int i = 0; i < 400; i++) {
        double low = exp(8 * (test_uniform(&state) - 0.5)) * (i % 10 ? 1 : 1e25 * test_uniform(&state));
        double width = exp(-27.6 * test_uniform(&state));
        test_piece(text, low, low * (1 + width), &state);
        if (i % 4 == 0 && i % 10)
            test_derivatives(text, low);
    }
    vndf_expression_free(&expression);
}

static void test_family(const vndf_family_form *form, double a, double b)
{
    const vndf_parameter parameters[] = {{"a", a}, {"b", b}};
    test_formula(form->formula, parameters, form->count);
}

int main(void)
{
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++)
        test_formula(formulas[i], NULL, 0);
    for (size_t i = 0; i < VNDF_FAMILY_FORMS; i++) {
        test_family(&vndf_family_forms[i], 1.7, 0.3);
        test_family(&vndf_family_forms[i], 60, 2.5);
    }
    return test_done();
}
