/* A family at a parameter is the mixture of the knots on either side of it, with weights that are linear in p or in 1/p
 * and the matrix and mean slope that are asked for (what a mixture is: test_oracle); at a knot it is the one
 * distribution; a parameter outside is taken to the nearer end, NaN gives an invalid mixture, and no lobe behind
 * those two is written. It notices a share that is linear in the other, and a neighbour's knot. */
#include "sampler/seen.h"
#include "table/family/family.h"

enum { KNOTS = 3 };
static const float parameters[KNOTS] = {0.5f, 1.7f, 40};
static const vndf_surface shape = {NULL, 0.3f, 0.1f, -0.05f, 0.2f, 0.15f, -0.3f};

/* What is to be found at p. */
static void test_at(const vndf_family *family, float p, vndf_family_place place)
{
    vndf_mixture m, untouched;
    memset(&m, 0x5a, sizeof m);
    untouched = m;
    const double at = fmin(fmax((double)p, (double)family->parameter[0]), (double)vndf_family_info(family).high);
    size_t knot = 0;
    while (knot + 1 < family->count && (double)family->parameter[knot + 1] <= at)
        knot++;
    const double a = (double)family->parameter[knot], b = (double)family->parameter[(knot + 1) % KNOTS];
    const double t = at == a ? 0 : family->reciprocal ? (1 / at - 1 / a) / (1 / b - 1 / a) : (at - a) / (b - a);
    int count = t > 0 ? 2 : 1;
    TEST(vndf_family_at(family, p, &shape, &m) == place && m.count == count);
    for (int i = 0; i < count; i++) {
        vndf_surface want = shape;
        want.distribution = family->distribution[knot + (size_t)i];
        TEST(memcmp(&m.lobe[i].surface, &want, sizeof want) == 0);
        TEST(fabs((double)m.lobe[i].weight - (i ? t : 1 - t)) <= 1e-6 && m.lobe[i].weight >= 0);
    }
    TEST_NEAR((double)m.lobe[0].weight + (count > 1 ? (double)m.lobe[1].weight : 0), 1, 1e-7);
    TEST(memcmp(&m.lobe[count], &untouched.lobe[count], sizeof m.lobe[0]) == 0);
}

static void test_places(const vndf_family *family)
{
    unsigned long long state = 20261123;
    vndf_mixture m;
    for (size_t i = 0; i < test_amount(1000, 10000, 100000); i++) {
        const size_t knot = i % (KNOTS - 1);
        test_at(family, (float)random_between(&state, parameters[knot] * 1.0001, parameters[knot + 1] * 0.9999),
                VNDF_FAMILY_INSIDE);
    }
    for (size_t i = 0; i < KNOTS; i++) {
        test_at(family, parameters[i], VNDF_FAMILY_INSIDE);
        test_at(family, nextafterf(parameters[i], 1), VNDF_FAMILY_INSIDE);
    }
    test_at(family, 0.49999f, VNDF_FAMILY_BELOW);
    test_at(family, -HUGE_VALF, VNDF_FAMILY_BELOW);
    test_at(family, 40.001f, VNDF_FAMILY_ABOVE);
    test_at(family, HUGE_VALF, VNDF_FAMILY_ABOVE);
    TEST(vndf_family_at(family, NAN, &shape, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    TEST(vndf_family_at(NULL, 1, &shape, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    TEST(vndf_family_at(family, 1, NULL, &m) == VNDF_FAMILY_INVALID && m.count == 0);
}

static void test_facts(const vndf_family *family, const vndf_distribution *second)
{
    vndf_family_facts facts = vndf_family_info(family), none = vndf_family_info(NULL);
    TEST(facts.count == KNOTS && facts.low == parameters[0] && facts.high == parameters[2] && !facts.reciprocal);
    TEST(facts.bytes == 0 && facts.distance == 0 && !facts.source[0] && facts.memory > 0 && none.count == 0);
    TEST(vndf_family_distribution(family, 1) == second && vndf_family_parameter(family, 1) == parameters[1]);
    TEST(!vndf_family_distribution(family, KNOTS) && vndf_family_parameter(family, KNOTS) == 0);
    TEST(!vndf_family_distribution(NULL, 0) && vndf_family_distance(family, KNOTS) == 0);
    vndf_family_free(NULL);
}

static void test_refused(const vndf_distribution *const *all, const float *p, size_t count, const char *part)
{
    vndf_error error = {VNDF_OK, ""};
    TEST(!vndf_family_of(all, p, count, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, part);
}

static void test_refusals(const vndf_distribution *const *all)
{
    static const float bad[][KNOTS] = {{1, 2, 2}, {1, 3, 2}, {1, NAN, 3}, {1, 2, HUGE_VALF}};
    const vndf_distribution *const hole[KNOTS] = {all[0], NULL, all[2]};
    for (int i = 0; i < 4; i++)
        test_refused(all, bad[i], KNOTS, i < 2 ? "must ascend" : i == 2 ? "not a number" : "infinite");
    test_refused(NULL, parameters, KNOTS, "1 to 256 distributions");
    test_refused(all, parameters, 0, "1 to 256 distributions");
    test_refused(all, parameters, 257, "1 to 256 distributions");
    test_refused(hole, parameters, KNOTS, "1 to 256 distributions");
}

int main(void)
{
    vndf_distribution *table = oracle_shipped("student-t-2.5-small");
    const vndf_distribution *all[KNOTS] = {vndf_ggx(), vndf_beckmann(), table};
    vndf_family *family = table ? vndf_family_of(all, parameters, KNOTS, NULL) : NULL;
    vndf_family *one = vndf_family_of(all, parameters, 1, NULL);
    if (!TEST(family && one))
        return test_done();
    test_facts(family, all[1]);
    test_refusals(all);
    test_at(one, parameters[0], VNDF_FAMILY_INSIDE);
    test_at(one, 7, VNDF_FAMILY_ABOVE);
    for (family->reciprocal = 0; family->reciprocal < 2; family->reciprocal++)
        test_places(family);
    vndf_family_free(family);
    vndf_family_free(one);
    vndf_free(table);
    return test_done();
}
