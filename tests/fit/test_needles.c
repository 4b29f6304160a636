/* No feature of a formula hides: needles of any kind, at any slope, of relative width 1e-2 to 1e-12 and with 0.1% to
 * 90% of the mass, are found - the builder finds the mass that an integration has which knows where
 * they are - or refused with their place. An argument: how many needles, 120 without. */
#include "harness/test.h"

#include "fit/profile/profile.h"

/* A formula with a needle at a, of width s and height k; in what variable a and s are. */
typedef enum variable { SLOPE, TANGENT, THETA, COSINE } variable;

typedef struct form {
    variable in;
    const char *text;
} form;

static const form forms[] = {
    {SLOPE, "exp(-r)+k*exp(-((r-a)/s)^2)"},
    {SLOPE, "(1+r^2)^-2+k*(1+((r-a)/s)^2)^-3"},
    {SLOPE, "exp(-r^2)+k*cosh((r-a)/s)^-2"},
    {SLOPE, "exp(-r)+k*exp(-(log(r/a)/(s/a))^2)"},
    {SLOPE, "exp(-r)*(1+k*exp(-((r-a)/s)^2))"},
    {SLOPE, "(1+r^2)^-2*(1+k/(1+((r-a)/s)^4))"},
    {SLOPE, "(1+r^2)^-2*exp(log(1+k)*exp(-((r-a)/s)^2))"},
    {SLOPE, "exp(-r)+k*(tanh((r-a)/s+2)-tanh((r-a)/s-2))"},
    {SLOPE, "(1+r^2)^-2*(1+k*(atan((r-a)/s+2)-atan((r-a)/s-2)))"},
    {SLOPE, "exp(-r)+k*exp(-abs((r-a)/s))"},
    {SLOPE, "exp(-r)+k*max(0,1-abs(r-a)/s)"},
    {SLOPE, "exp(-r)+k*(erf((r-a)/s+1)-erf((r-a)/s-1))"},
    {SLOPE, "exp(-r)+k*step(s^2-(r-a)^2)"},
    {SLOPE, "exp(-r)*(1+k*sin(min(max((r-a)/s,0),pi))^2)"},
    {SLOPE, "exp(-r)+k/(1+exp(abs(r-a)/s))"},
    {SLOPE, "exp(-r)+k*erfc(((r-a)/s)^2)"},
    {SLOPE, "exp(-r)+k*pow(2,-((r-a)/s)^2)"},
    {SLOPE, "(1+r^2)^-2+k*(1+((r^2-a^2)/(2*a*s))^2)^-2.5"},
    {SLOPE, "exp(-r)+k*sqrt(max(0,1-((r-a)/s)^2))"},
    {SLOPE, "exp(-r)+k*max(exp(-((r-a)/s)^2)-0.1,0)"},
    {SLOPE, "exp(-r)+k*exp(-((r-a)/s)^2)*cos(3*(r-a)/s)^2"},
    {TANGENT, "1+k*exp(-((t-a)/s)^2)"},
    {TANGENT, "exp(-t)*(2+k*tanh((t-a)/s+1)-k*tanh((t-a)/s-1))"},
    {THETA, "exp(-t)+k*exp(-((theta-a)/s)^2)"},
    {THETA, "c^3*(1+k*cosh((theta-a)/s)^-2)"},
    {THETA, "1+k*exp(-((acos(c)-a)/s)^2)"},
    {COSINE, "c+k*exp(-((c-a)/s)^2)"},
    {COSINE, "c^2*(1+k*(1+((c-a)/s)^2)^-2)"},
};
enum { FORMS = sizeof forms / sizeof *forms };

static vndf_source *source_of(const form *f, const vndf_parameter *parameters)
{
    return f->in == SLOPE ? vndf_source_slope_expression(f->text, parameters, 3, NULL)
                          : vndf_source_ndf_expression(f->text, parameters, 3, NULL);
}

/* P22 at a slope for a height. */
static double value_of(const form *f, vndf_parameter *parameters, double k, double r)
{
    parameters[2].value = k;
    vndf_source *source = source_of(f, parameters);
    double value = vndf_source_p22(source, r);
    vndf_source_free(source);
    return value;
}

/* integral of P22 r dr from a + x0 to a + x1. */
static double part(const vndf_source *source, double a, double x0, double x1)
{
    enum { PARTS = 6 };
    double sum = 0, h = (x1 - x0) / PARTS;
    for (int i = 0; i < PARTS * VNDF_GAUSS; i++) {
        double r = a + x0 + h * (i / VNDF_GAUSS + vndf_gauss_node[i % VNDF_GAUSS]);
        sum += h * vndf_gauss_weight[i % VNDF_GAUSS] * r * vndf_source_p22(source, r);
    }
    return sum;
}

/* All mass: parts that double on both sides of the needle up to half its slope, then beyond that. */
static double mass_of(const vndf_source *source, double a, double s)
{
    double sum = 0, x = 0, next = s / 8;
    for (; x < a / 2; x = next, next = fmin(x < 8 * s ? x + s / 8 : 1.3 * x, a / 2))
        sum += part(source, a, x, next) + part(source, a, -next, -x);
    for (double r = a / 2; r > 1e-9; r /= 1.5)
        sum += part(source, 0, r / 1.5, r);
    for (double r = 1.5 * a; r < 1e9; r *= 1.5)
        sum += part(source, 0, r, 1.5 * r);
    return 2 * PI * sum;
}

static int seen, refused;

/* At a slope, of this relative width, with about this share of the mass: that without a needle is some 4. */
static void test_needle(const form *f, double r0, double width, double share)
{
    double q = 1 + r0 * r0, s = r0 * width; /* a and s of the slope become those of the formula's own variable */
    vndf_parameter parameters[] = {{"a", f->in == THETA    ? atan(r0)
                                         : f->in == COSINE ? 1 / sqrt(q)
                                                           : r0},
                                   {"s", f->in == THETA    ? s / q
                                         : f->in == COSINE ? s * r0 / (q * sqrt(q))
                                                           : s},
                                   {"k", 0}};
    double at = r0 + s / 2, per = value_of(f, parameters, 1, at) - value_of(f, parameters, 0, at);
    parameters[2].value = share / (1 - share) * 0.4 / (per * r0 * s);
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = source_of(f, parameters);
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, &guard, &error);
    double mass = mass_of(source, r0, s), found = profile ? 1 / profile->normalization : 0;
    int good = profile ? TEST_RELATIVE(found, mass, 1e-4)
                       : TEST(error.status == VNDF_ERROR_DISTRIBUTION) & TEST_HAS(error.message, " slope ");
    if (!good)
        fprintf(stderr, "  %s at %g, width %g, share %g: %s %.9g for %.9g\n", f->text, r0, width, share,
                error.message, found, mass);
    seen += profile != NULL;
    refused += profile == NULL;
    vndf_profile_free(profile);
    vndf_source_free(source);
}

static double between(unsigned long long *state, double low, double high)
{
    return low * exp(log(high / low) * test_uniform(state));
}

int main(int argc, char **argv)
{
    int count = argc > 1 ? atoi(argv[1]) : (int)test_amount(60, 60, 2500);
    unsigned long long state = 20261;
    for (int i = 0; i < count; i++) {
        double r0 = between(&state, 0.01, 50), width = between(&state, 1e-12, 1e-2);
        test_needle(&forms[i % FORMS], r0, width, between(&state, 1e-3, 0.9));
    }
    fprintf(stderr, "%d needles seen, %d refused\n", seen, refused);
    TEST(seen > 5 * refused); /* formulas that doubles make rough, and widths near 1e-12 */
    return test_done();
}
