/* Every family is its published formula, its mass is the integral of its P22, every parameter in its range and
 * every measured material gives finite values at all slopes, and whatever is out of range is refused. */
#include "harness/constants.h"
#include "harness/test.h"

#include <stdlib.h>

#include "source/family/family.h"
#include "source/source.h"

/* At ends and in the middle of all ranges. */
/* clang-format off */
static const char *const all[] = {
    "ggx", "beckmann", "student-t:1.5000001", "student-t:1.6", "student-t:4", "student-t:1e9", "gtr:1e-9",
    "gtr:0.5", "gtr:1", "gtr:1,1", "gtr:2,1e-9", "gtr:3.5,0.2", "gtr:1000,0.5", "gtr:1000,1e-9", "gtr:0.3,1e-9",
    "epd:0.05", "epd:0.5", "epd:1", "epd:3", "epd:1000", "abc:1e-300,1", "abc:48.57,1.7", "abc:1e15,0.1",
    "abc:1e15,1000", "abc:1,1e-300", "sgd:1e-9,0", "sgd:1e-9,1000", "sgd:1.6e-5,0.4", "sgd:0.5,1.2", "sgd:1e6,0",
    "sgd:1e6,1000", "hyper-cauchy:1.5000001", "hyper-cauchy:1e9", "hyper-cauchy:2.2,1e-9", "hyper-cauchy:2,1e9",
    "phong:0", "phong:50", "phong:1e9", "mix:(1,1e-9,sgd:1e-9,1000)+(1e12,1e9,epd:0.05)",
    "mix:(0.8,0.01,ggx)+(0.2,1,student-t:2)", "mix:(1,1,sgd:alum-bronze/r)+(2,0.5,abc:two-layer-gold)",
};
/* clang-format on */

static vndf_source *family(const char *specification)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_family(specification, &error);
    if (!TEST(source != NULL))
        fprintf(stderr, "  %s: %s\n", specification, error.message);
    return source;
}

static void test_finite(const char *specification)
{
    vndf_source *source = family(specification);
    int good = source != NULL && vndf_source_p22(source, 0) > 0 && isfinite(vndf_source_p22(source, 0));
    double before = good ? vndf_source_p22(source, 0) : 0;
    for (double r = 1e-30; good && r <= 1.1e30; r *= 1.5) {
        double value = vndf_source_p22(source, r);
        good = isfinite(value) && value >= 0 && value <= before * (1 + 1e-9); /* and all of them fall */
        before = value;
    }
    good = good && vndf_source_p22(source, 1e200) >= 0 && vndf_source_p22(source, INFINITY) >= 0;
    if (!TEST(good))
        fprintf(stderr, "  %s\n", specification);
    vndf_source_free(source);
}

static void test_all_finite(void)
{
    size_t materials = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        test_finite(all[i]);
    for (; vndf_family_material(materials); materials++)
        test_finite(vndf_family_material(materials));
    TEST(materials == 312);
}

/* The ratio to the value at 0 against the formula in its plain form, at slopes where that keeps its digits. */
static void test_formulas(void)
{
    static const double slopes[] = {0.01, 0.1, 0.5, 1, 2, 5};
    static const char *const plain[][2] = {
        {"ggx", "(1+r^2)^-2"},
        {"gtr:2,0.1", "(0.01+r^2)^-2"},
        {"gtr:1.5", "(0.01*cos(atan(r))^2+sin(atan(r))^2)^-1.5*cos(atan(r))^4"},
        {"beckmann", "exp(-r^2)"},
        {"student-t:2.5", "(1+r^2/1.5)^-2.5"},
        {"hyper-cauchy:1.7,0.5", "(2+r^2/0.25)^-1.7"},
        {"epd:0.7", "exp(-r^1.4)"},
        {"phong:30", "cos(atan(r))^34"},
        {"abc:50,1.7", "(1+50*(1-cos(atan(r))))^-1.7*cos(atan(r))^4"},
        {"gtr:1.5,0.2", "(0.04*cos(atan(r))^2+sin(atan(r))^2)^-1.5*cos(atan(r))^4"},
        {"sgd:0.2,0.7", "exp(-0.2-r^2/0.2)*(0.2+r^2/0.2)^-0.7"},
    };
    for (size_t k = 0; k < sizeof plain / sizeof *plain; k++) {
        vndf_source *source = family(plain[k][0]);
        vndf_source *formula = vndf_source_slope_expression(plain[k][1], NULL, 0, NULL);
        for (size_t i = 0; source && i < 6; i++) {
            double ratio = vndf_source_p22(source, slopes[i]) / vndf_source_p22(source, 0);
            if (!TEST_RELATIVE(ratio, vndf_source_p22(formula, slopes[i]) / vndf_source_p22(formula, 0), 1e-12))
                fprintf(stderr, "  %s at %g\n", plain[k][0], slopes[i]);
        }
        vndf_source_free(source);
        vndf_source_free(formula);
    }
}

/* 2 pi integral P22 r dr by Simpson's rule in log r, between breaks so that steps can be fine there. */
static double mass(const vndf_source *source, double low, double high)
{
    int steps = 200000;
    double h = log(high / low) / steps, sum = 0;
    for (int i = 0; i <= steps; i++) {
        double r = low * exp(i * h);
        sum += vndf_source_p22(source, r) * r * r * (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2);
    }
    return 2 * PI * sum * h / 3;
}

/* Weights are shares of the projected area, whatever the families and scales. */
static void test_mass(const char *specification, double tolerance)
{
    char text[128];
    snprintf(text, sizeof text, "mix:(2.5,0.3,%s)+(0.5,1,beckmann)", specification);
    vndf_source *source = family(text);
    if (source && !TEST_NEAR(mass(source, 1e-16, 1e16), 3, tolerance))
        fprintf(stderr, "  %s\n", specification);
    vndf_source_free(source);
}

static void test_masses(void)
{
    static const char *const smooth[] = {
        "ggx",          "beckmann",    "student-t:1.8",        "student-t:50",   "gtr:0.01",    "gtr:0.5,0.001",
        "gtr:1,0.3",    "gtr:1,1",     "gtr:1.0000001,0.3",    "gtr:6,0.01",     "gtr:200,0.9", "epd:0.2",
        "epd:1",        "epd:4",       "abc:50,1.7",           "abc:1e6,0.2",    "abc:0.1,5",   "sgd:0.2,0.7",
        "sgd:1e-5,0.4", "sgd:0.7,1.8", "hyper-cauchy:1.8,0.3", "hyper-cauchy:9", "phong:0",     "phong:1e5",
    };
    for (size_t i = 0; i < sizeof smooth / sizeof smooth[0]; i++)
        test_mass(smooth[i], 1e-10);
    test_mass("epd:1000", 3e-6); /* all but a jump, which Simpson's rule does not like */
}

/* Closed forms of the two masses that the library integrates: incomplete gamma, and powers. */
static void test_closed_masses(void)
{
    const vndf_family_form *forms[] = {vndf_family_form_find("sgd", 3), vndf_family_form_find("abc", 3)};
    for (double a = 1e-4; a < 1; a *= 2.3) {
        double half[] = {a, 0.5}, none[] = {a, 0}, B = 1 / a;
        /* p = 1/2: pi alpha e^alpha alpha^p Gamma(1/2, alpha) */
        TEST_RELATIVE(vndf_family_mass(forms[0], half), PI * a * exp(a) * sqrt(a) * sqrt(PI) * erfc(sqrt(a)),
                      1e-13);
        TEST_RELATIVE(vndf_family_mass(forms[0], none), PI * a, 1e-13);
        /* C = 3: 2 pi integral (1 + B v)^-3 (1 - v) dv over [0, 1] = pi / (1 + B) */
        TEST_RELATIVE(vndf_family_mass(forms[1], (double[]){B, 3}), PI / (1 + B), 1e-13);
    }
}

static void test_error(const char *specification, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_family(specification, &error);
    if (!(TEST(source == NULL) & TEST(error.status == VNDF_ERROR_SYNTAX) & TEST_HAS(error.message, message)))
        fprintf(stderr, "  %s: %s\n", specification, error.message);
    vndf_source_free(source);
}

static void test_errors(void)
{
    static const char *const refused[][2] = {
        {"", "column 1: unknown family ''; known are ggx, beckmann, student-t, gtr, epd, abc, sgd, hyper-cauchy, "
             "phong, mix"},
        {"GGX", "column 1: unknown family 'GGX'; did you mean 'ggx'? known are ggx, "},
        {"student", "column 1: unknown family 'student'; did you mean 'student-t'?"},
        {"ggx:1", "column 5: too many parameters; right would be ggx"},
        {"student-t", "column 10: GAMMA is missing; right would be student-t:GAMMA"},
        {"student-t:x", "column 11: 'x' is no number"},
        {"student-t:1e400", "column 11: the number 1e400 is too large for a double"},
        {"student-t:1.5", "GAMMA is 1.5; it must be above 1.5 and at most 1e+09: P22 falls as"},
        {"gtr:2,", "column 7: nothing follows the comma; right would be gtr:GAMMA[,ALPHA]"},
        {"abc:,2", "column 5: '' is no number"},
        {"gtr:2,1.1", "gtr: ALPHA is 1.1; it must be at least 1e-09 and at most 1"},
        {"epd:0.04", "epd: P is 0.04; it must be at least 0.05 and at most 1000"},
        {"abc:1", "column 6: C is missing; right would be abc:B,C or abc:MATERIAL"},
        {"sgd:alum-bronz/r", "unknown material 'sgd:alum-bronz/r'; the nearest are sgd:alum-bronze/r, "},
        {"abc:gold", "unknown material 'abc:gold'; the nearest are "},
        {"mix", "column 4: something is missing; right would be mix:(W,S,FAMILY)+(W,S,FAMILY)"},
        {"mix:ggx", "column 5: unexpected 'ggx'"},
        {"mix:(1,1,ggx)", "column 14: something is missing"},
        {"mix:(1,1,ggx)(1,1,ggx)", "column 14: unexpected '(1,1,ggx)'"},
        {"mix:(1,1,ggx)+", "column 15: something is missing"},
        {"mix:(1,1,ggx)+(1,1,ggx)+(1,1,ggx)", "column 24: unexpected '+(1,1,ggx)'"},
        {"mix:(1,1,ggx)+(1,1,ggx", "column 16: unexpected '1,1,ggx'"},
        {"mix:(1,1,gggx)+(1,1,ggx)", "column 10: unknown family 'gggx'"},
        {"mix:(1,1,mix:(1,1,ggx)+(1,1,ggx))+(1,1,ggx)", "column 10: a mix is"},
        {"mix:(0,1,ggx)+(1,1,ggx)", "mix: the weight W is 0; it must be above 0 and at most 1e+12"},
        {"mix:(1,0,ggx)+(1,1,ggx)", "mix: the scale S is 0; it must be at least 1e-09 and at most 1e+09"},
        {"mix:(1,1,student-t:1)+(1,1,ggx)", "student-t: GAMMA is 1;"},
    };
    vndf_error error = {VNDF_OK, ""};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        test_error(refused[i][0], refused[i][1]);
    TEST(vndf_source_family(NULL, &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
}

static void test_descriptions(void)
{
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        vndf_source *source = family(all[i]), *again;
        TEST(strncmp(vndf_source_description(source), "--family ", 9) == 0 && source->rebuildable);
        again = vndf_source_from_description(vndf_source_description(source), NULL);
        TEST(again && strcmp(vndf_source_description(again), vndf_source_description(source)) == 0);
        TEST(again && vndf_source_p22(again, 0.3) == vndf_source_p22(source, 0.3));
        vndf_source_free(source);
        vndf_source_free(again);
    }
}

/* The help names each family with its usage and its limits. */
static void test_help(void)
{
    const vndf_family_form *form;
    for (size_t i = 0; (form = vndf_family_form_at(i)) != NULL; i++) {
        char start[80], limit[80];
        size_t usage = strcspn(form->usage, " "); /* the first of two ways */
        snprintf(start, sizeof start, "%.*s ", (int)usage, form->usage);
        const char *line = strstr(vndf_family_help(), start);
        if (!TEST(line != NULL))
            continue;
        for (size_t k = 0; k < form->count; k++) {
            const vndf_family_range *range = &form->range[k];
            double low = 0, high = 0;
            snprintf(limit, sizeof limit, range->open ? " < %s <= " : " <= %s <= ", range->name);
            const char *found = strstr(line, limit);
            if (!TEST(found != NULL))
                continue;
            high = strtod(found + strlen(limit), NULL);
            while (found > line && found[-1] != ' ')
                found--;
            low = strtod(found, NULL);
            TEST(low == range->low && high == range->high);
        }
    }
    TEST_HAS(vndf_family_help(), "mix:(W,S,FAMILY)+(W,S,FAMILY)");
}

/* The materials are those of the tables that are shipped, in their order. */
static size_t compare_table(const char *path, int channels, size_t index)
{
    char line[256];
    FILE *file = fopen(path, "r");
    if (!TEST(file != NULL))
        return index;
    while (fgets(line, sizeof line, file)) {
        char material[64] = "", channel[8] = "", name[128];
        double a = 0, b = 0;
        int fields = channels ? sscanf(line, "%63[^,],%7[^,],%lf,%lf", material, channel, &a, &b)
                              : sscanf(line, "%63[^,],%lf,%lf", material, &a, &b);
        if (line[0] == '#' || fields < (channels ? 4 : 3))
            continue;
        snprintf(name, sizeof name, channels ? "sgd:%s/%s" : "abc:%s", material, channel);
        const vndf_material_fit *found = vndf_material_fit_find(name, strlen(name));
        TEST(found == &vndf_material_fits[index] && found->parameter[0] == a && found->parameter[1] == b);
        index++;
    }
    fclose(file);
    return index;
}

static void test_tables(void)
{
    size_t count = compare_table(VNDF_SOURCE_DIR "/tables/merl_sgd.csv", 1, 0);
    TEST(count == 300);
    TEST(compare_table(VNDF_SOURCE_DIR "/tables/merl_abc.csv", 0, count) == 312);
    TEST(vndf_family_material(312) == NULL && vndf_family_material((size_t)-1) == NULL);
}

int main(void)
{
    test_all_finite();
    test_formulas();
    test_masses();
    test_closed_masses();
    test_errors();
    test_descriptions();
    test_help();
    test_tables();
    return test_done();
}
