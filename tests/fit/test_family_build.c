/* A family that is built is as far from the mixtures between its knots as it says: another quadrature at ten times as
 * many parameters finds the same distances within a twentieth; they are about the same between all knots, one knot less
 * would not reach them, and the tables are those of vndf_build at the knots, so that D of the mixture is as near to
 * the family as both errors allow. What is no family is refused by name. */
#include <stdio.h>

#include "harness/constants.h"
#include "oracle/oracle.h"
#include "harness/test.h"

enum { SLOPES = 16000, BYTES = 2048 };

/* Steps of an integral, and parameters between two knots. */
static int slopes(void)
{
    return (int)test_amount(4000, 4000, SLOPES);
}

static int scans(void)
{
    return (int)test_amount(20, 20, 70);
}

/* ---- the families, once more ---- */

typedef double density(double p, double r);

static double student(double p, double r)
{
    return pow(1 + r * r / (p - 1), -p) / PI;
}

static double epd(double p, double r)
{
    return exp(-pow(r, 2 * p)) / (PI * tgamma(1 + 1 / p));
}

/* Total variation of slopes and of the normals that are visible at grazing incidence: sums over log r. */
typedef struct distances {
    double slopes, grazing;
} distances;

static distances distance_at(density *f, double a, double b, double t, double p)
{
    int count = slopes();
    double first = log(1e-7), step = (log(1e28) - first) / count, mixed_area = 0, area = 0;
    static double mixed[SLOPES + 1], own[SLOPES + 1], slope[SLOPES + 1];
    distances d = {0, 0};
    for (int i = 0; i <= count; i++) {
        double r = slope[i] = exp(first + step * i);
        mixed[i] = ((1 - t) * f(a, r) + t * f(b, r)) * r * r * step;
        own[i] = f(p, r) * r * r * step;
        mixed_area += mixed[i] * r;
        area += own[i] * r;
    }
    for (int i = 0; i <= count; i++) {
        d.slopes += PI * fabs(mixed[i] - own[i]);
        d.grazing += 0.5 * fabs(mixed[i] / mixed_area - own[i] / area) * slope[i];
    }
    return d;
}

static double weight_of(double a, double b, double p, int reciprocal)
{
    return reciprocal ? (1 / p - 1 / a) / (1 / b - 1 / a) : (p - a) / (b - a);
}

static void test_scan(const vndf_family *family, density *f)
{
    vndf_family_facts facts = vndf_family_info(family);
    double worst = 0, grazing = 0;
    for (size_t i = 0; i + 1 < facts.count; i++) {
        double a = vndf_family_parameter(family, i), b = vndf_family_parameter(family, i + 1), here = 0;
        for (int k = 1, last = scans(); k < last; k++) {
            double p = a + (b - a) * k / scans();
            distances d = distance_at(f, a, b, weight_of(a, b, p, facts.reciprocal), p);
            here = fmax(here, d.slopes);
            grazing = fmax(grazing, d.grazing);
        }
        TEST_RELATIVE((double)vndf_family_distance(family, i), here, 0.05);
        TEST((double)vndf_family_distance(family, i) > 0.85 * (double)facts.distance);
        worst = fmax(worst, here);
    }
    TEST_RELATIVE((double)facts.distance, worst, 0.05);
    TEST_RELATIVE((double)facts.grazing, grazing, 0.05);
}

/* ---- tables ---- */

/* As the certificate says it of slopes, which are the visible normals from straight above. */
static double table_tv(const vndf_family *family, size_t i)
{
    return (double)vndf_distribution_info(vndf_family_distribution(family, i)).certificate.tv_above;
}

static void test_between(const vndf_family *family, density *f)
{
    const vndf_affine shape = {NULL, 1, 0, 0, 1, 0, 0};
    vndf_family_facts facts = vndf_family_info(family);
    int count = slopes();
    double first = log(1e-7), step = (log(1e28) - first) / count;
    for (size_t i = 0; i + 1 < facts.count; i++) {
        vndf_mixture m;
        float p = 0.5f * (vndf_family_parameter(family, i) + vndf_family_parameter(family, i + 1));
        double sum = 0;
        TEST(vndf_family_at(family, p, &shape, &m) == VNDF_FAMILY_INSIDE);
        for (int k = 0; k <= count; k++) {
            double r = exp(first + step * k);
            if (f((double)p, r) > 1e-36) /* as floats hold it */
                sum += PI * fabs((double)vndf_mixture_p22(&m, (float)r, 0) - f((double)p, r)) * r * r * step;
        }
        TEST(sum <
             (double)vndf_family_distance(family, i) * 1.1 + fmax(table_tv(family, i), table_tv(family, i + 1)));
        TEST(sum > 0.2 * (double)vndf_family_distance(family, i));
    }
}

static void test_knot(const vndf_family *family, size_t i)
{
    static unsigned char single[BYTES], of_family[BYTES];
    const vndf_distribution *table = vndf_family_distribution(family, i);
    vndf_info info = vndf_distribution_info(table);
    vndf_source *source = vndf_source_of(table, NULL);
    vndf_build_options options = {.max_bytes = BYTES};
    vndf_distribution *alone = source ? vndf_build(source, &options, NULL, NULL) : NULL;
    char text[64];
    snprintf(text, sizeof text, "--family student-t:%.7g", (double)vndf_family_parameter(family, i));
    TEST(strcmp(info.source, text) == 0);
    if (!TEST(alone && vndf_distribution_info(alone).bytes == info.bytes && info.bytes <= BYTES))
        return;
    TEST(vndf_save_memory(alone, single, info.bytes, NULL) == VNDF_OK);
    TEST(vndf_save_memory(table, of_family, info.bytes, NULL) == VNDF_OK);
    TEST(memcmp(single, of_family, info.bytes) == 0);
    vndf_free(alone);
    vndf_source_free(source);
}

static void test_student(void)
{
    const vndf_family_options options = {.knots = 4, .max_bytes = BYTES};
    vndf_error error = {VNDF_OK, ""};
    vndf_family *family = vndf_build_family("student-t", 1.6, 6, &options, &error);
    if (!TEST(family != NULL))
        return;
    vndf_family_facts facts = vndf_family_info(family);
    TEST(facts.count == 4 && facts.reciprocal == 1 && facts.low == 1.6f && facts.high == 6);
    TEST(strcmp(facts.source, "--family student-t --parameter 1.6..6") == 0);
    test_scan(family, student);
    test_between(family, student);
    test_knot(family, 1);
    vndf_family_free(family);
}

/* As few knots as reach the distance. */
static void test_reached(void)
{
    vndf_family_options options = {.max_distance = 0.03, .max_bytes = BYTES};
    vndf_family *family = vndf_build_family("epd", 0.4, 1, &options, NULL), *fewer = NULL;
    vndf_family_facts facts = vndf_family_info(family);
    TEST(facts.count > 2 && facts.distance <= 0.03f && facts.distance > 0);
    test_scan(family, epd);
    if (facts.count > 2) {
        options = (vndf_family_options){.knots = facts.count - 1, .max_bytes = BYTES};
        fewer = vndf_build_family("epd", 0.4, 1, &options, NULL);
        TEST(vndf_family_info(fewer).distance > 0.03f && !vndf_family_info(fewer).reciprocal);
    }
    vndf_family_free(family);
    vndf_family_free(fewer);
}

/* A place for the number, twice, in a mix, and a range that begins at 0. */
static void test_pattern(void)
{
    const vndf_family_options options = {.knots = 2, .max_bytes = BYTES};
    vndf_error error = {VNDF_OK, ""};
    vndf_family *mix = vndf_build_family("mix:({p},0.1,phong:{p})+(1,1,ggx)", 2, 3, &options, &error);
    vndf_family *phong = vndf_build_family("phong", 0, 1, &options, &error);
    vndf_info info = vndf_distribution_info(vndf_family_distribution(mix, 1));
    TEST_HAS(info.source, "mix:(3,0.1,phong:3)+(1,1,ggx)");
    TEST_HAS(vndf_family_info(mix).source, "--family 'mix:({p},0.1,phong:{p})+(1,1,ggx)' --parameter 2..3");
    TEST(vndf_family_info(phong).low == 0 && vndf_family_info(phong).count == 2 &&
         !vndf_family_info(phong).reciprocal);
    vndf_family_free(mix);
    vndf_family_free(phong);
}

/* ---- refused ---- */

static int stop(double done, const char *what, void *user)
{
    int *calls = user;
    TEST(done >= 0 && done <= 1 && what != NULL);
    return --*calls <= 0;
}

static void test_refusals(void)
{
    static const struct refusal {
        const char *family;
        double low, high;
        vndf_family_options options;
        vndf_status status;
        const char *part;
    } cases[] = {
        {NULL, 2, 3, {.knots = 0}, VNDF_ERROR_ARGUMENT, "NULL"},
        {"student", 2, 3, {.knots = 0}, VNDF_ERROR_SYNTAX, "unknown family 'student'"},
        {"abc:3,0.5", 2, 3, {.knots = 0}, VNDF_ERROR_SYNTAX, "does not say where the parameter stands"},
        {"abc:{p}", 2, 3, {.knots = 0}, VNDF_ERROR_SYNTAX, "at the parameter 2: column 6: C is missing"},
        {"ggx", 1, 2, {.knots = 0}, VNDF_ERROR_SYNTAX, "at the parameter 1: column 5: too many parameters"},
        {"student-t", 1.5, 3, {.knots = 0}, VNDF_ERROR_SYNTAX, "it must be above 1.5"},
        {"student-t", 2, 2, {.knots = 0}, VNDF_ERROR_ARGUMENT, "from 2 to 2: the first must be below"},
        {"student-t", 2, (double)NAN, {.knots = 0}, VNDF_ERROR_ARGUMENT, "the first must be below"},
        {"student-t", 2, 3, {.knots = 1}, VNDF_ERROR_ARGUMENT, "knots is 1"},
        {"student-t", 2, 3, {.knots = 257}, VNDF_ERROR_ARGUMENT, "knots is 257"},
        {"student-t", 2, 3, {.max_distance = -1}, VNDF_ERROR_ARGUMENT, "max_distance is -1"},
        {"student-t", 2, 3, {.max_distance = 0.1, .knots = 2}, VNDF_ERROR_ARGUMENT, "one of them"},
        {"student-t", 2, 3, {.knots = 2, .max_bytes = 99}, VNDF_ERROR_ARGUMENT, "max_bytes is 99"},
        {"phong", 1, 1e8, {.max_distance = 1e-6}, VNDF_ERROR_TARGET, "256 knots reach"},
        {"student-t",
         2,
         3,
         {.knots = 2, .max_bytes = BYTES, .progress = stop},
         VNDF_ERROR_ARGUMENT,
         "interrupted"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int calls = 1; calls < (cases[i].options.progress ? 20 : 2); calls += 6) {
            int left = calls;
            vndf_error error = {VNDF_OK, ""};
            vndf_family_options options = cases[i].options;
            options.progress_user = &left;
            TEST(!vndf_build_family(cases[i].family, cases[i].low, cases[i].high, &options, &error));
            TEST(error.status == cases[i].status && TEST_HAS(error.message, cases[i].part));
        }
}

int main(int arguments, char **argument)
{
    if (oracle_wanted(arguments, argument, 0, "student"))
        test_student();
    if (oracle_wanted(arguments, argument, 1, "reached"))
        test_reached();
    if (oracle_wanted(arguments, argument, 2, "pattern"))
        test_pattern();
    if (oracle_wanted(arguments, argument, 3, "refusals"))
        test_refusals();
    return test_done();
}
