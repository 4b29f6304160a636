/* No feature of a formula hides: needles of any kind, at any slope, of relative width 1e-2 to 1e-12 and with 0.1% to
 * 90% of the mass, are found - the builder finds the mass that an integration has which knows where
 * they are - or refused with their place. An argument: how many needles, 120 without. */
#include "harness/test.h"

#include "fit/profile/profile.h"
#include "vndf_build.h"

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

typedef struct needle {
    const form *form;
    double r0, width, share;     /* slope, width relative to it, part of the mass */
    vndf_parameter parameter[3]; /* a, s, k */
} needle;

static vndf_source *source_of(needle *n, double k)
{
    n->parameter[2].value = k;
    return n->form->in == SLOPE ? vndf_source_slope_expression(n->form->text, n->parameter, 3, NULL)
                                : vndf_source_ndf_expression(n->form->text, n->parameter, 3, NULL);
}

/* a and s in the formula's own variable. */
static void place(needle *n)
{
    double a = n->r0, s = n->r0 * n->width, q = 1 + a * a;
    const vndf_parameter own[4][2] = {{{"a", a}, {"s", s}},
                                      {{"a", a}, {"s", s}},
                                      {{"a", atan(a)}, {"s", s / q}},
                                      {{"a", 1 / sqrt(q)}, {"s", s * a / (q * sqrt(q))}}};
    n->parameter[0] = own[n->form->in][0];
    n->parameter[1] = own[n->form->in][1];
    n->parameter[2].name = "k";
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

static double mass_with(needle *n, double k)
{
    vndf_source *source = source_of(n, k);
    double mass = TEST(source != NULL) ? mass_of(source, n->r0, n->r0 * n->width) : 0;
    vndf_source_free(source);
    return mass;
}

/* The height for the share; the needle's mass grows with it, but not always in proportion. */
static double height_of(needle *n)
{
    double none = mass_with(n, 0), k = 1 / n->width, want = n->share / (1 - n->share) * none;
    for (int i = 0; i < 4; i++)
        k *= fmin(fmax(want / (mass_with(n, k) - none), 1e-8), 1e8);
    return k;
}

static int seen, refused;

static void test_needle(needle *n)
{
    vndf_error error = {VNDF_OK, ""};
    double k = height_of(n), mass = mass_with(n, k);
    vndf_source *source = source_of(n, k);
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, &guard, &error);
    double found = profile ? 1 / profile->normalization : 0;
    int good = profile ? TEST_RELATIVE(found, mass, 1e-4)
                       : TEST(error.status == VNDF_ERROR_DISTRIBUTION) & TEST_HAS(error.message, " slope ");
    if (!good)
        fprintf(stderr, "  %s at %g, width %g, share %g: %s %.9g for %.9g\n", n->form->text, n->r0, n->width,
                n->share, error.message, found, mass);
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
        needle n = {.form = &forms[i % FORMS],
                    .r0 = between(&state, 0.01, 50),
                    .width = between(&state, 1e-12, 1e-2),
                    .share = between(&state, 1e-3, 0.9)};
        place(&n);
        test_needle(&n);
    }
    fprintf(stderr, "%d needles seen, %d refused\n", seen, refused);
    TEST(seen > 5 * refused); /* formulas that doubles make rough, and widths near 1e-12 */
    return test_done();
}
