/* Every family is its published formula, its mass is the integral of its P22, every parameter in its range and
 * every measured material gives finite values at all slopes. */
#include "core/checksum.h"
#include "source/family/family.h"
#include "source/sources.h"

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

static void test_finite(const char *specification)
{
    vndf_source *source = family_of(specification);
    double before = vndf_source_p22(source, 0);
    int good = before > 0 && isfinite(before);
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

/* Of the materials a digit that slips changes the checksum. */
static void test_all_finite(void)
{
    size_t materials = 0;
    uint32_t crc = 0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        test_finite(all[i]);
    for (; vndf_family_material(materials); materials++) {
        char text[128];
        const vndf_material_fit *fit = &vndf_material_fits[materials];
        int size =
            snprintf(text, sizeof text, "%s %.12g %.12g\n", fit->name, fit->parameter[0], fit->parameter[1]);
        crc = vndf_crc32(crc, text, (size_t)size);
        test_finite(vndf_family_material(materials));
    }
    TEST(materials == 312 && crc == 0xb51f384c);
    TEST(vndf_family_material((size_t)-1) == NULL);
}

/* The ratio to the value at 1 against the formula in its plain form, at slopes where that keeps its digits. */
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
        {"charlie:0.3", "sin(atan(r))^(1/0.3)*cos(atan(r))^4"},
        {"charlie:1", "sin(atan(r))*cos(atan(r))^4"},
    };
    for (size_t k = 0; k < sizeof plain / sizeof *plain; k++) {
        vndf_source *source = family_of(plain[k][0]), *formula = slope_of(plain[k][1]);
        for (size_t i = 0; i < 6; i++) {
            double ratio = vndf_source_p22(source, slopes[i]) / vndf_source_p22(source, 1);
            if (!TEST_RELATIVE(ratio, vndf_source_p22(formula, slopes[i]) / vndf_source_p22(formula, 1), 1e-12))
                fprintf(stderr, "  %s at %g\n", plain[k][0], slopes[i]);
        }
        vndf_source_free(source);
        vndf_source_free(formula);
    }
}

/* Weights are shares of the projected area, whatever the families and scales: 2 pi integral P22 r dr by Simpson's rule
 * in log r. */
static void test_mass(const char *specification, double tolerance)
{
    enum { STEPS = 200000 };
    char text[128];
    snprintf(text, sizeof text, "mix:(2.5,0.3,%s)+(0.5,1,beckmann)", specification);
    vndf_source *source = family_of(text);
    double low = 1e-16, h = log(1e32) / STEPS, sum = 0;
    for (int i = 0; i <= STEPS; i++) {
        double r = low * exp(i * h);
        sum += vndf_source_p22(source, r) * r * r * (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2);
    }
    if (!TEST_NEAR(2 * PI * sum * h / 3, 3, tolerance))
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
    for (size_t i = 0; i < sizeof smooth / sizeof *smooth; i++)
        test_mass(smooth[i], 1e-10);
    test_mass("charlie:0.05", 1e-10);
    test_mass("charlie:1", 1e-10);
    test_mass("epd:1000", 3e-6); /* all but a jump, which Simpson's rule does not like */
}

/* The help names each family with its usage and its limits. */
static void test_help(void)
{
    for (size_t i = 0; i < VNDF_FAMILY_FORMS; i++) {
        const vndf_family_form *form = &vndf_family_forms[i];
        char start[80], limit[80];
        snprintf(start, sizeof start, "%.*s ", (int)strcspn(form->usage, " "), form->usage); /* the first of two */
        const char *line = strstr(vndf_family_help(), start);
        for (size_t k = 0; TEST(line != NULL) && k < form->count; k++) {
            const vndf_family_range *range = &form->range[k];
            snprintf(limit, sizeof limit, range->open ? " < %s <= " : " <= %s <= ", range->name);
            const char *found = strstr(line, limit);
            if (!TEST(found && strtod(found + strlen(limit), NULL) == range->high))
                continue;
            while (found > line && found[-1] != ' ')
                found--;
            TEST(strtod(found, NULL) == range->low);
        }
    }
    TEST_HAS(vndf_family_help(), "mix:(W,S,FAMILY)+(W,S,FAMILY)");
}

int main(void)
{
    test_all_finite();
    test_formulas();
    test_masses();
    test_help();
    return test_done();
}
