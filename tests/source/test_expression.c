/* A formula has the value that C gives it, its errors name the column, its kinks are found, and its
 * description alone makes the same source again; a callback is the function it was given. */
#include "harness/test.h"

#include <locale.h>
#include <stdlib.h>

#include "source/formula/expression.h"
#include "source/source.h"
#include "source/words.h"

/* The formula with those of these parameters that it names. */
static vndf_source *slope_of(const char *text, vndf_error *error)
{
    static const vndf_parameter all[] = {{"a", 0.3}, {"gamma", 2.5}, {"b_1", -2}};
    static const char *const places[] = {"a*", "gamma)", "b_1"};
    vndf_parameter used[3];
    size_t count = 0;
    for (size_t i = 0; text && i < 3; i++)
        if (strstr(text, places[i]))
            used[count++] = all[i];
    return vndf_source_slope_expression(text, used, count, error);
}

static double slope_value(const char *text, double r)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = slope_of(text, &error);
    double value = source ? vndf_source_p22(source, r) : NAN;
    if (!TEST(source != NULL))
        fprintf(stderr, "  %s: %s\n", text, error.message);
    vndf_source_free(source);
    return value;
}

typedef struct formula {
    const char *text;
    double want;
} formula;

/* At r = 0.7; a parameter may have a function's name: the parenthesis tells. */
static void test_values(void)
{
    const double r = 0.7;
    const formula values[] = {
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
        {"pi", 3.14159265358979323846},
        {"a*b_1", -0.6},
        {"\t r \n", r},
        {"gamma(gamma)", tgamma(2.5)},
        {"exp(-a*r)", exp(-0.3 * r)},
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
        if (!TEST_RELATIVE(slope_value(values[i].text, r), values[i].want, 1e-15))
            fprintf(stderr, "  %s\n", values[i].text);
    for (size_t i = 0; i < 5; i++)
        TEST(isnan(slope_value(no_numbers[i], r)));
}

/* D(c, theta, t) times c^4, also where 1 + r^2 overflows. */
static void test_ndf(void)
{
    vndf_source *source = vndf_source_ndf_expression("(1 + c) * (2 + theta) / (3 + t)", NULL, 0, NULL);
    for (double r = 1e-9; r < 1e9; r *= 7) {
        double c = 1 / sqrt(1 + r * r);
        TEST_RELATIVE(vndf_source_p22(source, r), (1 + c) * (2 + atan(r)) / (3 + r) * pow(c, 4), 1e-14);
    }
    TEST_NEAR(vndf_source_p22(source, 1e200), 0, 0);
    vndf_source_free(source);
}

static void test_error(const char *text, vndf_status status, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = slope_of(text, &error);
    int good = TEST(source == NULL) & TEST(error.status == status) & TEST_HAS(error.message, message);
    if (!good)
        fprintf(stderr, "  %s: %s\n", text ? text : "NULL", error.message);
    vndf_source_free(source);
}

static void test_errors(void)
{
    static const char *const refused[][2] = {
        {"exp(-2*foo)+a*r",
         "column 8: unknown name 'foo'; known are r, a, pi, and with parentheses exp log log1p "},
        {"1 + theta", "column 5: unknown name 'theta'"},
        {"foo(1)", "column 1: unknown name 'foo'; known are r, pi"},
        {"exp(-r)*cso(r)", "column 9: unknown name 'cso'; did you mean 'cos'? known are"},
        {"R", "column 1: unknown name 'R'"},
        {"Exp(-r)", "column 1: unknown name 'Exp'; did you mean 'exp'?"},
        {"", "column 1: the expression ends here; a number, a name or '('"},
        {"1 +", "column 4: the expression ends here"},
        {"1 + * 2", "column 5: unexpected '*'; a number, a name or '(' would be right"},
        {"exp(-r**2)", "column 8: unexpected '*'; a power is written with ^, as in r^2"},
        {"2 r",
         "column 3: unexpected 'r'; an operator (+ - * / ^) or the end would be right; a product is written 2*r"},
        {"exp(-3r)", "column 7: unexpected 'r'; an operator, or ')' for the '(' of column 4, would be right; a "
                     "product is written 3*r"},
        {"(r)(r)", "column 4: unexpected '('; an operator (+ - * / ^) or the end would be right; a product is "
                   "written with *"},
        {"1.2.3", "column 4: unexpected '.'; an operator (+ - * / ^) or the end would be right"},
        {".", "column 1: unexpected '.'; a number has digits"},
        {"1e999", "column 1: the number 1e999 is too large"},
        {"2*(r+1", "column 7: the expression ends here; an operator, or ')' for the '(' of column 3"},
        {"r)", "column 2: unexpected ')'"},
        {"exp r", "column 5: unexpected 'r'; the function before it needs"},
        {"r(2)", "column 2: unexpected '('; the name before it is no function"},
        {"min(1)", "column 6: unexpected ')'; min, max and pow take two arguments"},
        {"exp(1,2)", "column 6: unexpected ','; this function takes one argument"},
        {"r\x01", "column 2: unexpected '?'"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        test_error(refused[i][0], VNDF_ERROR_SYNTAX, refused[i][1]);
    test_error(NULL, VNDF_ERROR_ARGUMENT, "NULL");
}

static void test_parameter_error(const char *name, double value, const char *message)
{
    vndf_parameter parameter = {name, value};
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_source_ndf_expression("c", &parameter, 1, &error) == NULL);
    TEST(error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, message);
}

static void test_parameter_errors(void)
{
    vndf_parameter twice[] = {{"a", 1}, {"a", 2}}, many[65];
    test_parameter_error("1a", 1, "'1a': a name is a letter");
    test_parameter_error("", 1, "a name is a letter");
    test_parameter_error(NULL, 1, "a name is a letter");
    test_parameter_error("theta", 1, "'theta': the name is taken");
    test_parameter_error("pi", 1, "'pi': the name is taken");
    test_parameter_error("a", NAN, "a finite number is needed");
    test_parameter_error("k", 1, "parameter 'k': the formula 'c' has no 'k'");
    test_parameter_error("exp", 1, "has no 'exp'");
    TEST(vndf_source_slope_expression("r", twice, 2, NULL) == NULL);
    TEST(vndf_source_slope_expression("r", NULL, 1, NULL) == NULL);
    for (int i = 0; i < 65; i++)
        many[i] = twice[0];
    TEST(vndf_source_slope_expression("r", many, 65, NULL) == NULL);
}

/* count times piece, then tail. */
static void repeat(char *out, size_t count, const char *piece, const char *tail)
{
    out[0] = '\0';
    for (size_t i = 0, size = strlen(piece); i < count; i++)
        memcpy(out + i * size, piece, size + 1);
    strcat(out, tail);
}

static void test_limits(void)
{
    char text[8192], close[80];
    repeat(close, 64, ")", "");
    repeat(text, 64, "(", "r");
    strcat(text, close);
    TEST_NEAR(slope_value(text, 3), 3, 0);
    repeat(text, 64, "1+1*1^min(0,", "r");
    strcat(text, close);
    test_error(text, VNDF_ERROR_SYNTAX, "nested deeper than 64 levels");
    repeat(text, 32, "1+1*1^min(0,", "r");
    repeat(close, 32, ")", "");
    strcat(text, close);
    TEST_NEAR(slope_value(text, 3), 2, 0);
    repeat(text, 65, "-", "r");
    test_error(text, VNDF_ERROR_SYNTAX, "column 66: nested deeper than 64 levels");
    repeat(text, 65, "1^", "r");
    test_error(text, VNDF_ERROR_SYNTAX, "nested deeper");
    repeat(text, 2047, "1+", "r");
    TEST_NEAR(slope_value(text, 1), 2048, 0);
    repeat(text, 2048, "1+", "r");
    test_error(text, VNDF_ERROR_SYNTAX, "the expression has 4097 characters; at most 4096");
}

static void test_description(const char *text, const char *want)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = slope_of(text, &error), *again;
    if (!TEST(source != NULL))
        return;
    TEST(strcmp(vndf_source_description(source), want) == 0);
    TEST(source->rebuildable == 1);
    again = vndf_source_from_description(want, &error);
    if (!TEST(again != NULL))
        fprintf(stderr, "  %s\n", error.message);
    for (double r = 0; again && r < 3; r += 0.1)
        TEST(vndf_source_p22(again, r) == vndf_source_p22(source, r));
    TEST(again == NULL || strcmp(vndf_source_description(again), want) == 0);
    vndf_source_free(source);
    vndf_source_free(again);
}

static void test_descriptions(void)
{
    vndf_parameter third = {"x", 1.0 / 3};
    vndf_source *source = vndf_source_ndf_expression("c^x", &third, 1, NULL);
    TEST(strcmp(vndf_source_description(source), "--ndf 'c^x' --set x=0.3333333333333333") == 0);
    vndf_source_free(source);
    test_description("exp(-a*r)", "--slope 'exp(-a*r)' --set a=0.3");
    test_description("1 /\n2", "--slope '1 / 2'");
}

static void test_no_description(const char *text, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_source_from_description(text, &error) == NULL);
    TEST(error.status != VNDF_OK);
    TEST_HAS(error.message, message);
}

/* Descriptions come out of files; none may be misread. */
static void test_bad_descriptions(void)
{
    test_no_description("", "the source was ''");
    test_no_description("--csv x.csv (crc32 00000000)", "the source was '--csv x.csv");
    test_no_description("--slope-callback f", "keeps only its name");
    test_no_description("--slope", "the source was '--slope'");
    test_no_description("--slope r --set", "--set NAME=NUMBER");
    test_no_description("--slope r --set a", "NAME=NUMBER");
    test_no_description("--slope r --set a=1x", "NAME=NUMBER");
    test_no_description("--slope r --out x", "'--out'");
    test_no_description("--slope 'r", "column 9: a quote");
    test_no_description("--slope r+", "column 3: the expression ends");
    test_no_description("--family ggx --set a=1", "takes no --set");
    test_no_description("--family gggx", "unknown family 'gggx'");
}

/* What a shell would split is what was put together. */
static void test_words(void)
{
    static const char *const in[] = {"plain", "", "two words", "it's", "''", "back\\slash", "tab\there"};
    static const char *const out[] = {"plain", "", "two words", "it's", "''", "back\\slash", "tab here"};
    vndf_text text = {NULL, 0, 0, 0};
    vndf_words words;
    for (size_t i = 0; i < 7; i++)
        vndf_text_add_word(&text, in[i]);
    char *line = vndf_text_finish(&text, NULL);
    TEST(vndf_words_split(line, &words, NULL) == VNDF_OK);
    TEST(words.count == 7);
    for (size_t i = 0; i < words.count; i++)
        TEST(strcmp(words.word[i], out[i]) == 0);
    vndf_words_free(&words);
    free(line);
}

static void test_breaks(const char *text, size_t count, const double *want)
{
    vndf_source *source = vndf_source_slope_expression(text, NULL, 0, NULL);
    if (!TEST(source != NULL) || !TEST(source->break_count == count)) {
        fprintf(stderr, "  %s: %zu breaks\n", text, source ? source->break_count : 0);
        vndf_source_free(source);
        return;
    }
    for (size_t i = 0; i < count; i++)
        TEST_RELATIVE(source->breaks[i], want[i], 1e-14);
    vndf_source_free(source);
}

static void test_kinks(void)
{
    vndf_source *disc = vndf_source_ndf_expression("step(0.25 - theta)", NULL, 0, NULL);
    TEST(disc->break_count == 1);
    TEST_RELATIVE(disc->breaks[0], tan(0.25), 1e-14);
    vndf_source_free(disc);
    test_breaks("exp(-r^2)", 0, NULL);
    test_breaks("step(1-r)", 1, (double[]){1});
    test_breaks("max(0, 1-r^2) + step(1-r)", 1, (double[]){1});
    test_breaks("step(r-1)*step(1.001-r)", 2, (double[]){1, 1.001});
    test_breaks("step(1e-7-abs(r-3))", 3, (double[]){3 - 1e-7, 3, 3 + 1e-7});
    test_breaks("step(1e-6-r)", 1, (double[]){1e-6});
    test_breaks("min(exp(-r), exp(-2*r)+0.1)", 2, /* exp(-r) = (1 +- sqrt 0.6)/2 */
                (double[]){-log((1 + sqrt(0.6)) / 2), -log((1 - sqrt(0.6)) / 2)});
}

static double cube(double x, void *user)
{
    return *(double *)user * x * x * x;
}

static void test_callbacks(void)
{
    double factor = 2, c = 1 / sqrt(1 + 0.5 * 0.5);
    vndf_error error = {VNDF_OK, ""};
    vndf_source *ndf = vndf_source_ndf_callback(cube, &factor, "it's mine", &error);
    vndf_source *p22 = vndf_source_slope_callback(cube, &factor, NULL, &error);
    TEST_RELATIVE(vndf_source_p22(ndf, 0.5), 2 * pow(c, 7), 1e-15);
    TEST_RELATIVE(vndf_source_p22(p22, 0.5), 0.25, 0);
    TEST(strcmp(vndf_source_description(ndf), "--ndf-callback 'it'\\''s mine'") == 0);
    TEST(strcmp(vndf_source_description(p22), "--slope-callback unnamed") == 0);
    TEST(!ndf->rebuildable && error.status == VNDF_OK);
    vndf_source_free(ndf);
    vndf_source_free(p22);
    vndf_source_free(NULL);
    TEST(vndf_source_ndf_callback(NULL, NULL, "x", &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
}

/* Numbers survive printing and reading, also under a locale with a decimal comma (if the machine has one). */
static void test_numbers(void)
{
    static const char *const locales[] = {"C", "de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"};
    unsigned long long state = 7;
    for (size_t i = 0; i < 5; i++) {
        if (!setlocale(LC_ALL, locales[i]))
            continue;
        for (int k = 0; k < 2000; k++) {
            char text[VNDF_NUMBER_TEXT];
            int exponent = (int)(test_random_bits(&state) % 2000) - 1000;
            double value = ldexp(test_uniform_double(&state) - 0.5, exponent), back = 0;
            vndf_number_print(text, value);
            TEST(strchr(text, ',') == NULL && vndf_number_is_all(text, strlen(text), &back) && back == value);
        }
        TEST_NEAR(slope_value("0.5+r", 1), 1.5, 0);
    }
    setlocale(LC_ALL, "C");
    double value = 0;
    TEST(vndf_number_read("1e", 2, &value) == 1 && vndf_number_read("-.5e+1x", 7, &value) == 6 && value == -5);
    TEST(vndf_number_read("0x10", 4, &value) == 1 && vndf_number_read("inf", 3, &value) == 0);
    TEST(vndf_number_read("", 0, &value) == 0 && vndf_number_read("-", 1, &value) == 0);
}

int main(void)
{
    test_values();
    test_ndf();
    test_errors();
    test_parameter_errors();
    test_limits();
    test_descriptions();
    test_bad_descriptions();
    test_words();
    test_kinks();
    test_callbacks();
    test_numbers();
    return test_done();
}
