/* The oracle of vndf_build.h agrees with the closed forms of GGX and Beckmann at any scale and factor: P22, and
 * the projected area from straight above far below the horizon, to 1e-8 of them. */
#include "harness/constants.h"
#include "harness/test.h"
#include "vndf_build.h"

static double ggx_p22(double r)
{
    double q = 1 + r * r;
    return 1 / (PI * q * q);
}

static double beckmann_p22(double r)
{
    return exp(-r * r) / PI;
}

/* For the stretched direction (s, c) of any length: Walter et al. 2007, Heitz 2014. */
static double ggx_area(double s, double c)
{
    double length = sqrt(s * s + c * c);
    return c > 0 ? (c + length) / 2 : s * s / (2 * (length - c));
}

static double beckmann_area(double s, double c)
{
    double a = c / s;
    return s > 0 ? c / 2 * (c > 0 ? 1 + erf(a) : erfc(-a)) + s * exp(-a * a) / (2 * sqrt(PI)) : c > 0 ? c : 0;
}

typedef struct form {
    const char *p22; /* in r, with the scale a */
    double (*at)(double r), (*area)(double s, double c);
    double deepest; /* degrees: beyond, the closed form cancels */
} form;

static void test_form(const form *f, double scale)
{
    static const double theta[] = {0, 1, 30, 60, 85, 89.9, 90, 90.1, 95, 120, 150, 170};
    vndf_parameter a = {"a", scale};
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_slope_expression(f->p22, &a, 1, &error);
    vndf_reference *reference = source ? vndf_reference_from(source, &error) : NULL;
    if (!TEST(reference != NULL))
        fprintf(stderr, "  %s\n", error.message);
    for (int i = -6; reference && i <= 6; i++) {
        double r = scale * exp(0.5 * i);
        TEST_RELATIVE(vndf_reference_p22(reference, r), f->at(r / scale) / (scale * scale), 1e-9);
    }
    for (unsigned i = 0; reference && i < sizeof theta / sizeof *theta && theta[i] <= f->deepest; i++) {
        double angle = theta[i] * PI / 180;
        TEST_RELATIVE(vndf_reference_area(reference, angle), f->area(scale * sin(angle), cos(angle)), 1e-8);
    }
    vndf_reference_free(reference);
    vndf_source_free(source);
}

/* Areas of exp(-r)/(2 pi) down to 1e-8 of that at grazing incidence, by quadrature with 30 digits. */
static void test_deep_areas(void)
{
    static const struct {
        double theta, area;
    } deep[] = {{150, 0.073703088805636}, {170, 6.89553179981653e-4}, {176.43, 1.17646841603251e-8}};
    vndf_source *source = vndf_source_slope_expression("exp(-r)", NULL, 0, NULL);
    vndf_reference *reference = source ? vndf_reference_from(source, NULL) : NULL;
    for (size_t i = 0; TEST(reference != NULL) && i < sizeof deep / sizeof *deep; i++)
        TEST_RELATIVE(vndf_reference_area(reference, deep[i].theta * PI / 180), deep[i].area, 1e-9);
    vndf_reference_free(reference);
    vndf_source_free(source);
}

int main(void)
{
    static const form forms[] = {{"7*(1+(r/a)^2)^-2", ggx_p22, ggx_area, 170},
                                 {"0.01*exp(-(r/a)^2)", beckmann_p22, beckmann_area, 120}};
    vndf_error error = {VNDF_OK, ""};
    for (int i = 0; i < 2; i++) {
        test_form(&forms[i], 1);
        test_form(&forms[i], 0.3);
    }
    TEST(vndf_reference_from(NULL, &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
    vndf_reference_free(NULL);
    test_deep_areas();
    return test_done();
}
