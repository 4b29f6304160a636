/* A family that is built is as far from the mixtures between its knots as it says: D of the mixture against the
 * family's formula, at many parameters, gives the same distances within a twentieth and what the tables add. They are
 * about the same between all knots, one knot less would not reach them, and the tables are those of vndf_build at the
 * knots. What is no family is refused by name. */
#include "harness/test.h"
#include "oracle/oracle.h"

enum { SLOPES = 16000, BYTES = 4096 };

/* Adds to *slopes the total variation of the slopes of the mixture at p and of the family, and to *grazing that of the
 * normals that are visible at grazing incidence: sums over log r, to where floats hold P22. */
static void measure(const vndf_family *family, const char *name, float p, double *slopes, double *grazing)
{
    static double mixed[SLOPES + 1], own[SLOPES + 1], slope[SLOPES + 1];
    const vndf_surface shape = vndf_rough(NULL, 1, 1);
    int count = (int)test_amount(4000, 4000, SLOPES);
    double first = log(1e-7), step = (log(1e28) - first) / count, mixed_area = 0, mass = 0, area = 0,
           d[2] = {0, 0};
    char text[64];
    vndf_mixture m;
    snprintf(text, sizeof text, "%s:%.9g", name, (double)p);
    vndf_source *source = oracle_source(text, NULL);
    TEST(vndf_family_at(family, p, &shape, &m) == VNDF_FAMILY_INSIDE);
    for (int i = 0; i <= count; i++) {
        double r = slope[i] = exp(first + step * i), at = vndf_source_p22(source, r);
        mixed[i] = at > 1e-36 ? 2 * PI * step * (double)vndf_mixture_p22(&m, (float)r, 0) * r * r : 0;
        own[i] = at > 1e-36 ? at * r * r : 0;
        mass += own[i];
        mixed_area += mixed[i] * r;
        area += own[i] * r;
    }
    for (int i = 0; i <= count; i++) {
        d[0] += 0.5 * fabs(mixed[i] - own[i] / mass);
        d[1] += 0.5 * fabs(mixed[i] / mixed_area - own[i] / area) * slope[i];
    }
    *slopes = fmax(*slopes, d[0]);
    *grazing = fmax(*grazing, d[1]);
    vndf_source_free(source);
}

static void test_scan(const vndf_family *family, const char *name)
{
    vndf_family_facts facts = vndf_family_info(family);
    double worst = 0, grazing = 0, tables = 0;
    int steps = (int)test_amount(20, 20, 70);
    for (size_t i = 0; i + 1 < facts.count; i++) {
        float a = vndf_family_parameter(family, i), b = vndf_family_parameter(family, i + 1);
        double here = 0, told = (double)vndf_family_distance(family, i);
        for (int k = 1; k < steps; k++)
            measure(family, name, a + (b - a) * (float)k / (float)steps, &here, &grazing);
        for (size_t k = i; k <= i + 1; k++)
            tables =
                fmax(tables, vndf_distribution_info(vndf_family_distribution(family, k)).certificate.tv_above);
        TEST_NEAR(told, here, 0.05 * here + tables);
        TEST(told > 0.85 * (double)facts.distance);
        worst = fmax(worst, here);
    }
    TEST(tables < 0.1 * worst);
    TEST_NEAR((double)facts.distance, worst, 0.05 * worst + tables);
    TEST_NEAR((double)facts.grazing, grazing, 0.05 * grazing + tables);
}

/* The bytes of vndf_build at a knot. */
static void test_knot(const vndf_family *family, size_t i)
{
    static unsigned char bytes[2][BYTES];
    const vndf_build_options options = {.max_bytes = BYTES};
    const vndf_distribution *table = vndf_family_distribution(family, i);
    vndf_info info = vndf_distribution_info(table);
    vndf_source *source = vndf_source_of(table, NULL);
    vndf_distribution *alone = vndf_build(source, &options, NULL, NULL);
    char text[64];
    snprintf(text, sizeof text, "--family student-t:%.7g", (double)vndf_family_parameter(family, i));
    TEST(strcmp(info.source, text) == 0 && vndf_distribution_info(alone).bytes == info.bytes);
    TEST(info.bytes <= BYTES && vndf_save_memory(alone, bytes[0], info.bytes, NULL) == VNDF_OK &&
         vndf_save_memory(table, bytes[1], info.bytes, NULL) == VNDF_OK);
    TEST(memcmp(bytes[0], bytes[1], info.bytes) == 0);
    vndf_free(alone);
    vndf_source_free(source);
}

static void test_student(void)
{
    const vndf_family_options options = {.knots = 4, .max_bytes = BYTES};
    vndf_family *family = vndf_build_family("student-t", 1.6, 6, &options, NULL);
    vndf_family_facts facts = vndf_family_info(family);
    if (!TEST(facts.count == 4 && facts.reciprocal == 1 && facts.low == 1.6f && facts.high == 6))
        return;
    TEST(strcmp(facts.source, "--family student-t --parameter 1.6..6") == 0);
    test_scan(family, "student-t");
    test_knot(family, 1);
    vndf_family_free(family);
}

/* As few knots as reach the distance. */
static void test_reached(void)
{
    vndf_family_options options = {.max_distance = 0.03, .max_bytes = BYTES};
    vndf_family *family = vndf_build_family("epd", 0.4, 1, &options, NULL);
    vndf_family_facts facts = vndf_family_info(family);
    TEST(facts.count > 2 && facts.distance <= 0.03f && facts.distance > 0);
    test_scan(family, "epd");
    options = (vndf_family_options){.knots = facts.count - 1, .max_bytes = BYTES};
    vndf_family *fewer = vndf_build_family("epd", 0.4, 1, &options, NULL);
    TEST(vndf_family_info(fewer).distance > 0.03f && !vndf_family_info(fewer).reciprocal);
    vndf_family_free(family);
    vndf_family_free(fewer);
}

/* A place for the number, twice, in a mix, and a range that begins at 0. */
static void test_pattern(void)
{
    const vndf_family_options options = {.knots = 2, .max_bytes = BYTES};
    vndf_family *mix = vndf_build_family("mix:({p},0.1,phong:{p})+(1,1,ggx)", 2, 3, &options, NULL);
    vndf_family *phong = vndf_build_family("phong", 0, 1, &options, NULL);
    vndf_family_facts facts = vndf_family_info(phong);
    TEST_HAS(vndf_distribution_info(vndf_family_distribution(mix, 1)).source, "mix:(3,0.1,phong:3)+(1,1,ggx)");
    TEST_HAS(vndf_family_info(mix).source, "--family 'mix:({p},0.1,phong:{p})+(1,1,ggx)' --parameter 2..3");
    TEST(facts.low == 0 && facts.count == 2 && !facts.reciprocal);
    vndf_family_free(mix);
    vndf_family_free(phong);
}

/* ---- refused ---- */

static int stop(double done, const char *what, void *user)
{
    static double last;
    int *calls = user;
    TEST(done >= last && done <= 1 && what != NULL);
    last = --*calls > 0 ? done : 0;
    return *calls <= 0;
}

static void test_refusals(void)
{
    static const struct refusal {
        const char *family;
        double low, high, max_distance;
        size_t knots, max_bytes;
        vndf_status status;
        const char *part;
    } cases[] = {
        {NULL, 2, 3, 0, 0, 0, VNDF_ERROR_ARGUMENT, "NULL"},
        {"student", 2, 3, 0, 0, 0, VNDF_ERROR_SYNTAX, "unknown family 'student'"},
        {"abc:3,0.5", 2, 3, 0, 0, 0, VNDF_ERROR_SYNTAX, "does not say where the parameter stands"},
        {"abc:{p}", 2, 3, 0, 0, 0, VNDF_ERROR_SYNTAX, "at the parameter 2: column 6: C is missing"},
        {"ggx", 1, 2, 0, 0, 0, VNDF_ERROR_SYNTAX, "at the parameter 1: column 5: too many parameters"},
        {"student-t", 1.5, 3, 0, 0, 0, VNDF_ERROR_SYNTAX, "it must be above 1.5"},
        {"student-t", 2, 2.0000002, 0, 0, 0, VNDF_ERROR_ARGUMENT, "from 2 to 2: the first must be below"},
        {"student-t", 2, 2.000001, 0, 9, 0, VNDF_ERROR_ARGUMENT, "too close for 9 knots"},
        {"student-t", 2, 1e30, 0, 0, 0, VNDF_ERROR_ARGUMENT, "the first must be below"},
        {"student-t", (double)NAN, 2, 0, 0, 0, VNDF_ERROR_ARGUMENT, "the first must be below"},
        {"student-t", 2, 3, 0, 1, 0, VNDF_ERROR_ARGUMENT, "knots is 1"},
        {"student-t", 2, 3, 0, 257, 0, VNDF_ERROR_ARGUMENT, "knots is 257"},
        {"student-t", 2, 3, 1, 0, 0, VNDF_ERROR_ARGUMENT, "max_distance is 1"},
        {"student-t", 2, 3, -1, 0, 0, VNDF_ERROR_ARGUMENT, "max_distance is -1"},
        {"student-t", 2, 3, 0.1, 2, 0, VNDF_ERROR_ARGUMENT, "one of them"},
        {"student-t", 2, 3, 0, 2, 99, VNDF_ERROR_ARGUMENT, "max_bytes is 99"},
        {"phong", 1, 1e8, 1e-6, 0, 0, VNDF_ERROR_TARGET, "256 knots reach"},
    };
    vndf_error error = {VNDF_OK, ""};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct refusal *c = &cases[i];
        const vndf_family_options options = {
            .max_distance = c->max_distance, .knots = c->knots, .max_bytes = c->max_bytes};
        TEST(!vndf_build_family(c->family, c->low, c->high, &options, &error) && error.status == c->status);
        TEST_HAS(error.message, c->part);
    }
    for (int calls = 1; calls < 20; calls += 6) {
        int left = calls;
        const vndf_family_options options = {
            .knots = 2, .max_bytes = BYTES, .progress = stop, .progress_user = &left};
        TEST(!vndf_build_family("student-t", 2, 3, &options, &error) && error.status == VNDF_ERROR_ARGUMENT);
        TEST_HAS(error.message, "interrupted");
    }
}

int main(int arguments, char **argument)
{
    void (*const parts[])(void) = {test_student, test_reached, test_pattern, test_refusals};
    for (size_t i = 0; i < 4; i++)
        if (oracle_wanted(arguments, argument, i, NULL))
            parts[i]();
    return test_done();
}
