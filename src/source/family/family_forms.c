/* The formulas of the families, as P22(r) = D cos^4(theta) at r = tan(theta), with P22(0) near 1 so that no
 * parameter overflows, and their masses 2 pi integral P22 r dr, closed wherever there is a closed form.
 *
 *   ggx           (1 + r^2)^-2 / pi                          Walter et al., EGSR 2007
 *   beckmann      exp(-r^2) / pi                             Beckmann & Spizzichino 1963
 *   student-t     (1 + r^2/(gamma-1))^-gamma / pi            Ribardiere et al., CGF 36(2), 2017, unit roughness
 *   gtr           D ~ (alpha^2 cos^2 + sin^2)^-gamma         Burley, SIGGRAPH course 2012; not a family of
 *                 stretched slopes: at alpha = 1 it is constant, so alpha is 0.1 if it is not given
 *   epd           exp(-(r^2)^p)                              Holzschuch & Pacanowski, ACM TOG 36(4), 2017
 *   abc           D ~ (1 + B (1 - cos))^-C                   Low et al., ACM TOG 31(1), 2012
 *   sgd           exp(-x)/x^p, x = alpha + r^2/alpha         Bagher et al., CGF 31(4), 2012
 *   hyper-cauchy  (2 + r^2/sigma^2)^-q                       Wellems et al., J. Opt. A 8, 2006
 *   phong         D ~ cos^N                                  Blinn 1977, from Phong 1975
 *
 * Powers are formed as exp(-n log1p(x)), which keeps its digits for large n and small x. The formulas in text are
 * the same functions, for interval arithmetic. */
#include <math.h>

#include "source/family/family.h"
#include "source/words.h"
#include "vndf_build.h"

static const double pi = 3.14159265358979323846;

static double ggx_p22(const double *parameter, double r)
{
    double q = 1 + r * r;
    (void)parameter;
    return 1 / (pi * q * q);
}

static double beckmann_p22(const double *parameter, double r)
{
    (void)parameter;
    return exp(-r * r) / pi;
}

static double student_p22(const double *parameter, double r)
{
    double gamma = parameter[0];
    return exp(-gamma * log1p(r * r / (gamma - 1))) / pi;
}

static double unit_mass(const double *parameter)
{
    (void)parameter;
    return 1;
}

/* With cos^2 = 1/(1+r^2); multiplied by alpha^(2 gamma). */
static double gtr_p22(const double *parameter, double r)
{
    double gamma = parameter[0], a2 = parameter[1] * parameter[1], q = 1 + r * r;
    return pow(a2 * q / (a2 + r * r), gamma) / (q * q);
}

/* pi integral (a2/(1 - (1-a2) z))^gamma dz over z = cos^2 in [0, 1]
 *   = pi (a2 - a2^gamma) / ((gamma-1) (1-a2)),
 * written with l = -log a2 so that gamma = 1 and alpha = 1 are limits and nothing overflows. */
static double gtr_mass(const double *parameter)
{
    double gamma = parameter[0], l = -2 * log(parameter[1]), x = (gamma - 1) * l;
    double wide = l > 0 ? l / -expm1(-l) : 1;
    if (x > 1)
        return pi * wide * (exp(-l) - exp(-gamma * l)) / x;
    return pi * wide * exp(-gamma * l) * (fabs(x) > 0 ? expm1(x) / x : 1);
}

static double epd_p22(const double *parameter, double r)
{
    return exp(-pow(r, 2 * parameter[0]));
}

static double epd_mass(const double *parameter)
{
    return pi * tgamma(1 + 1 / parameter[0]);
}

/* 1 - cos = r^2/(q + sqrt q), q = 1 + r^2: no cancellation. */
static double abc_p22(const double *parameter, double r)
{
    double q = 1 + r * r, versine = r * r / (q + sqrt(q));
    return exp(-parameter[1] * log1p(parameter[0] * versine)) / (q * q);
}

/* Divided by its value at r = 0, exp(-alpha)/alpha^p, which would underflow. */
static double sgd_p22(const double *parameter, double r)
{
    double alpha = parameter[0], p = parameter[1], x = r / alpha;
    return exp(-r * r / alpha - p * log1p(x * x));
}

/* The two families whose mass is no elementary function: 2 pi integral P22 r^2 ds over s = log r by the
 * trapezoidal rule, whose error for an integrand that is analytic for |Im s| < d is of the order of
 * exp(-2 pi d/h). Both have d >= pi/4: exp(-158) at h = 1/32. Below e^-64 = 1.6e-28 the mass goes as r^2, beyond
 * e^64 as r^-2 at least, with scales within [1e-9, 1e3]: less than 1e-20 of the mass is cut off. */
static double mass_by_trapezoids(double (*p22)(const double *, double), const double *parameter)
{
    const int steps = 32, end = 64 * steps;
    double sum = 0;
    for (int i = -end; i <= end; i++) {
        double r = exp((double)i / steps);
        sum += p22(parameter, r) * r * r;
    }
    return 2 * pi * sum / steps;
}

static double abc_mass(const double *parameter)
{
    return mass_by_trapezoids(abc_p22, parameter);
}

static double sgd_mass(const double *parameter)
{
    return mass_by_trapezoids(sgd_p22, parameter);
}

/* Published with the factor (q-1) 2^(q-1) / (pi sigma^2), for which the mass is 1. */
static double hyper_cauchy_p22(const double *parameter, double r)
{
    double x = r / parameter[1];
    return exp(-parameter[0] * log1p(x * x / 2));
}

static double hyper_cauchy_mass(const double *parameter)
{
    return 2 * pi * parameter[1] * parameter[1] / (parameter[0] - 1);
}

static double phong_p22(const double *parameter, double r)
{
    return exp(-(parameter[0] + 4) / 2 * log1p(r * r));
}

static double phong_mass(const double *parameter)
{
    return 2 * pi / (parameter[0] + 2);
}

/* clang-format off */
static const vndf_family_form forms[] = {
    { "ggx", "ggx", 0, 0, { { NULL, 0, 0, 0, 0 } }, "", ggx_p22, unit_mass,
      "1/(pi*(1+r^2)^2)" },
    { "beckmann", "beckmann", 0, 0, { { NULL, 0, 0, 0, 0 } }, "", beckmann_p22, unit_mass,
      "exp(-r^2)/pi" },
    { "student-t", "student-t:GAMMA", 1, 1, { { "GAMMA", 1.5, 1e9, 1, 0 } },
      "P22 falls as r^(-2 GAMMA), which has to be faster than r^-3", student_p22, unit_mass,
      "exp(-a*log(1+r^2/(a-1)))/pi" },
    { "gtr", "gtr:GAMMA[,ALPHA]", 1, 2, { { "GAMMA", 0, 1000, 1, 0 }, { "ALPHA", 1e-9, 1, 0, 0.1 } },
      "GAMMA = 2 is ggx of roughness ALPHA, larger GAMMA has shorter tails", gtr_p22, gtr_mass,
      "(b^2*(1+r^2)/(b^2+r^2))^a/(1+r^2)^2" },
    { "epd", "epd:P", 1, 1, { { "P", 0.05, 1000, 0, 0 } },
      "P = 1 is beckmann, smaller P has longer tails, large P is a disc", epd_p22, epd_mass,
      "exp(-r^(2*a))" },
    { "abc", "abc:B,C or abc:MATERIAL", 2, 2, { { "B", 0, 1e15, 1, 0 }, { "C", 0, 1000, 1, 0 } },
      "both grow with the sharpness of the peak", abc_p22, abc_mass,
      "exp(-b*log(1+a*r^2/(1+r^2+sqrt(1+r^2))))/(1+r^2)^2" },
    { "sgd", "sgd:ALPHA,P or sgd:MATERIAL/CHANNEL", 2, 2, { { "ALPHA", 1e-9, 1e6, 0, 0 }, { "P", 0, 1000, 0, 0 } },
      "ALPHA is the width of the peak, P the strength of its core", sgd_p22, sgd_mass,
      "exp(-r^2/a-b*log(1+(r/a)^2))" },
    { "hyper-cauchy", "hyper-cauchy:Q[,SIGMA]", 1, 2, { { "Q", 1.5, 1e9, 1, 0 }, { "SIGMA", 1e-9, 1e9, 0, 1 } },
      "P22 falls as r^(-2 Q), which has to be faster than r^-3", hyper_cauchy_p22, hyper_cauchy_mass,
      "exp(-a*log(1+(r/b)^2/2))" },
    { "phong", "phong:N", 1, 1, { { "N", 0, 1e9, 0, 0 } }, "N = 0 is a constant D", phong_p22, phong_mass,
      "exp(-(a+4)/2*log(1+r^2))" },
};
/* clang-format on */

const vndf_family_form *vndf_family_form_at(size_t index)
{
    return index < sizeof forms / sizeof forms[0] ? &forms[index] : NULL;
}

const vndf_family_form *vndf_family_form_find(const char *name, size_t size)
{
    const vndf_family_form *form;
    for (size_t i = 0; (form = vndf_family_form_at(i)) != NULL; i++)
        if (vndf_is_word(name, size, form->name))
            return form;
    return NULL;
}

/* The ranges are those above; a test compares them. */
const char *vndf_family_help(void)
{
    return "ggx                       P22 ~ (1+r^2)^-2 (Walter et al. 2007)\n"
           "beckmann                  P22 ~ exp(-r^2) (Beckmann & Spizzichino 1963)\n"
           "student-t:GAMMA           1.5 < GAMMA <= 1e9; P22 ~ (1 + r^2/(GAMMA-1))^-GAMMA (Ribardiere et al. 2017)\n"
           "gtr:GAMMA[,ALPHA]         0 < GAMMA <= 1000, 1e-9 <= ALPHA <= 1 (0.1 if not given); "
           "D ~ (ALPHA^2 cos^2 + sin^2)^-GAMMA (Burley 2012)\n"
           "epd:P                     0.05 <= P <= 1000; P22 ~ exp(-(r^2)^P) (Holzschuch & Pacanowski 2017)\n"
           "abc:B,C                   0 < B <= 1e15, 0 < C <= 1000; D ~ (1 + B (1-cos))^-C (Low et al. 2012)\n"
           "abc:MATERIAL              a fit of a measured material, as in abc:two-layer-gold (Low et al. 2012)\n"
           "sgd:ALPHA,P               1e-9 <= ALPHA <= 1e6, 0 <= P <= 1000; P22 ~ exp(-x)/x^P, "
           "x = ALPHA + r^2/ALPHA (Bagher et al. 2012)\n"
           "sgd:MATERIAL/CHANNEL      a fit of a measured material, as in sgd:alum-bronze/r (Bagher et al. 2012)\n"
           "hyper-cauchy:Q[,SIGMA]    1.5 < Q <= 1e9, 1e-9 <= SIGMA <= 1e9 (1 if not given); "
           "P22 ~ (2 + r^2/SIGMA^2)^-Q (Wellems et al. 2006)\n"
           "phong:N                   0 <= N <= 1e9; D ~ cos^N (Blinn 1977)\n"
           "mix:(W,S,FAMILY)+(W,S,FAMILY)  two of the above, each normalised, its slopes scaled by S "
           "(1e-9 <= S <= 1e9), weighted by W (0 < W <= 1e12)\n";
}
