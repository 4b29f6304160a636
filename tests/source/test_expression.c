/* A formula has the value that C gives it, up to the limits of its length, depth and parameters; numbers are read and
 * printed alike in every locale; a callback is the function it was given. */
#include <locale.h>

#include "source/sources.h"
#include "source/words.h"

/* Of a formula, or of words of `vndf build`. */
static double value_of(const char *text, double r)
{
    vndf_error error = {VNDF_OK, ""};
    int words = strncmp(text, "--slope ", 8) == 0;
    vndf_source *source = words ? made(vndf_source_from_description(text, &error), &error, text) : slope_of(text);
    double value = vndf_source_p22(source, r);
    vndf_source_free(source);
    return value;
}

/* At r = 0.7; a parameter may have a function's name: the parenthesis tells. */
static void test_values(void)
{
    const double r = 0.7;
    const struct {
        const char *text;
        double want;
    } values[] = {
        {"1+2*3", 7},
        {"(1+2)*3", 9},
        {"2-3-4", -5},
        {"2/4/8", 0.0625},
        {"2^3^2", 512},
        {"2^-3", 0.125},
        {"-2^2", -4},
        {"(-2)^2", 4},
        {"-r^2", -r * r},
        {"2*-3", -6},
        {"--+-1", -1},
        {".5 + 1. + 1e-1+1E+1", 11.6},
        {"pi", PI},
        {"--slope 1\\ +1", 2},
        {"--slope a*b_1 --set a=0.3 --set b_1=-2", -0.6},
        {"\t r \n", r},
        {"--slope gamma(gamma) --set gamma=2.5", tgamma(2.5)},
        {"--slope exp(-a*r) --set a=0.3", exp(-0.3 * r)},
        {"log(r)+sqrt(r)", log(r) + sqrt(r)},
        {"log1p(1e-20*r)", 1e-20 * r},
        {"sin(r)*cos(r)*tan(r)", sin(r) * cos(r) * tan(r)},
        {"asin(r)+acos(r)*atan(r)", asin(r) + acos(r) * atan(r)},
        {"sinh(r)+cosh(r)*tanh(r)", sinh(r) + cosh(r) * tanh(r)},
        {"erf(r)/erfc(r)", erf(r) / erfc(r)},
        {"lgamma(r)", lgamma(r)},
        {"abs (-2)", 2},
        {"min(3, max(1, 2))", 2},
        {"pow(r, 3)", pow(r, 3)},
        {"step(r-0.7)+step(r-0.8)+step(0)", 2},
    };
    static const char *const no_numbers[] = {"min(1, log(-1))", "min(log(-1), 1)", "max(1, log(-1))",
                                             "max(log(-1), 1)", "step(log(-1))"};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (!TEST_RELATIVE(value_of(values[i].text, r), values[i].want, 1e-15))
            fprintf(stderr, "  %s\n", values[i].text);
    for (size_t i = 0; i < 5; i++)
        TEST(isnan(value_of(no_numbers[i], r)));
}

/* D(c, theta, t) times c^4, also where 1 + r^2 overflows; and a callback of it. */
static double ndf(double c, void *user)
{
    return *(double *)user * (1 + c) * (2 + acos(c));
}

static void test_ndf(void)
{
    double factor = 3;
    vndf_error error = {VNDF_OK, ""};
    vndf_source *text = vndf_source_ndf_expression("3*(1 + c) * (2 + theta) + 0*t", NULL, 0, NULL);
    vndf_source *callback = vndf_source_ndf_callback(ndf, &factor, NULL, &error);
    vndf_source *slope = vndf_source_slope_callback(ndf, &factor, NULL, &error);
    for (double r = 1e-3; r < 1e9; r *= 7) {
        double c = 1 / sqrt(1 + r * r);
        TEST_RELATIVE(vndf_source_p22(text, r), 3 * (1 + c) * (2 + atan(r)) * pow(c, 4), 1e-14);
        TEST_RELATIVE(vndf_source_p22(callback, r), ndf(c, &factor) * pow(c, 4), 1e-14);
    }
    TEST_NEAR(vndf_source_p22(text, 1e200), 0, 0);
    TEST(isinf(value_of("1/r", 0)));
    TEST_RELATIVE(vndf_source_p22(slope, 0.5), ndf(0.5, &factor), 0);
    vndf_source_free(text);
    vndf_source_free(callback);
    vndf_source_free(slope);
    vndf_source_free(NULL);
}

/* Names of 64 characters, and one more; and their number. */
static void test_parameters(void)
{
    static char name[66];
    vndf_parameter many[65] = {{name, 1}};
    vndf_error error = {VNDF_OK, ""};
    memset(name, 'a', 64);
    vndf_source_free(made(vndf_source_slope_expression(name, many, 1, &error), &error, name));
    name[64] = 'a';
    refused(vndf_source_slope_expression("a", many, 1, &error), &error, VNDF_ERROR_ARGUMENT,
            "digits or _; at most 64");
    refused(vndf_source_slope_expression("a", many, 65, &error), &error, VNDF_ERROR_ARGUMENT,
            "65 parameters; at most 64");
}

/* count times piece, then "r", then as many parentheses. */
static const char *repeated(size_t count, const char *piece, size_t closed)
{
    static char text[8192];
    size_t used = 0;
    for (size_t i = 0; i < count; i++)
        used += (size_t)sprintf(text + used, "%s", piece);
    text[used++] = 'r';
    memset(text + used, ')', closed);
    text[used + closed] = '\0';
    return text;
}

static void refuse(const char *text, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    refused(vndf_source_slope_expression(text, NULL, 0, &error), &error, VNDF_ERROR_SYNTAX, message);
}

static void test_limits(void)
{
    TEST_NEAR(value_of(repeated(64, "(", 64), 3), 3, 0);
    TEST_NEAR(value_of(repeated(32, "1+1*1^min(0,", 32), 3), 2, 0);
    TEST_NEAR(value_of(repeated(2047, "1+", 0), 1), 2048, 0);
    refuse(repeated(64, "1+1*1^min(0,", 64), "nested deeper than 64 levels");
    refuse(repeated(65, "-", 0), "column 66: nested deeper than 64 levels");
    refuse(repeated(65, "(", 65), "nested deeper");
    refuse(repeated(65, "abs(", 65), "nested deeper");
    refuse(repeated(2048, "1+", 0), "the expression has 4097 characters; at most 4096");
}

/* Numbers survive printing and reading, also under a locale with a decimal comma (if the machine has one). */
static void test_numbers(void)
{
    static const char *const locales[] = {"C", "de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"};
    unsigned long long state = 7;
    double value = 0;
    for (size_t i = 0; i < 5; i++) {
        for (int k = 0; setlocale(LC_ALL, locales[i]) && k < 2000; k++) {
            char text[VNDF_NUMBER_TEXT];
            double x = ldexp(test_uniform_double(&state) - 0.5, (int)(test_random_bits(&state) % 2000) - 1000);
            vndf_number_print(text, x);
            TEST(strchr(text, ',') == NULL && vndf_number_is_all(text, strlen(text), &value) && value == x);
        }
        TEST_NEAR(value_of("0.5+r", 1), 1.5, 0);
    }
    setlocale(LC_ALL, "C");
    TEST(vndf_number_read("1e", 2, &value) == 1 && vndf_number_read("-.5e+1x", 7, &value) == 6 && value == -5);
    TEST(vndf_number_read("0x10", 4, &value) == 1 && vndf_number_read("inf", 3, &value) == 0);
    TEST(vndf_number_read("", 0, &value) == 0 && vndf_number_read("-", 1, &value) == 0 &&
         vndf_number_read("-.", 2, &value) == 0 && !vndf_number_read(repeated(4097, "1", 0), 4097, &value));
}

int main(void)
{
    test_values();
    test_ndf();
    test_parameters();
    test_limits();
    test_numbers();
    return test_done();
}
