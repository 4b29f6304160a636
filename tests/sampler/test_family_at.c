/* A family at a parameter is the mixture of the knots on either side of it, with weights that are linear in p or in 1/p
 * and the matrix and mean slope that are asked for (what a mixture is: test_oracle); at a knot it is the one
 * distribution; a parameter outside is taken to the nearer end, NaN gives an invalid mixture, and no lobe behind
 * those two is written. It notices a share that is linear in the other, and a neighbour's knot. */
#include "sampler/seen.h"
#include "table/family/family.h"

enum { KNOTS = 3 };
static const float parameters[KNOTS] = {0.5f, 1.7f, 40};
static const vndf_affine shape = {NULL, 0.3f, 0.1f, -0.05f, 0.2f, 0.15f, -0.3f};

/* The lobe is this distribution with that shape. */
static int is_lobe(const vndf_mixture *m, int i, const vndf_distribution *d)
{
    const vndf_affine *a = &m->lobe[i].surface;
    return a->distribution == d && memcmp(&a->xx, &shape.xx, 6 * sizeof(float)) == 0;
}

static vndf_family_place at(const vndf_family *family, float p, vndf_mixture *m)
{
    memset(m, 0x5a, sizeof *m);
    return vndf_family_at(family, p, &shape, m);
}

static void test_between(const vndf_family *family, const vndf_distribution *const *all, unsigned long long *state)
{
    size_t knot = test_random_bits(state) % (KNOTS - 1);
    double a = parameters[knot], b = parameters[knot + 1];
    float p = (float)random_between(state, a * 1.0001, b * 0.9999);
    vndf_mixture m, untouched;
    memset(&untouched, 0x5a, sizeof untouched);
    TEST(at(family, p, &m) == VNDF_FAMILY_INSIDE && m.count == 2);
    double t = family->reciprocal ? (1 / (double)p - 1 / a) / (1 / b - 1 / a) : (p - a) / (b - a);
    TEST_NEAR((double)m.lobe[1].weight, t, 1e-6);
    TEST_NEAR((double)m.lobe[0].weight + (double)m.lobe[1].weight, 1, 1e-7);
    TEST(is_lobe(&m, 0, all[knot]) && is_lobe(&m, 1, all[knot + 1]));
    TEST(memcmp(&m.lobe[2], &untouched.lobe[2], sizeof m.lobe[2]) == 0);
}

/* At a knot and beyond the ends there is one lobe, which is that distribution; beside a knot the neighbour is next to
 * nothing. */
static void test_ends(const vndf_family *family, const vndf_distribution *const *all)
{
    const struct end {
        float p;
        vndf_family_place place;
        int knot;
    } ends[] = {{parameters[0], VNDF_FAMILY_INSIDE, 0}, {parameters[1], VNDF_FAMILY_INSIDE, 1},
                {parameters[2], VNDF_FAMILY_INSIDE, 2}, {0.49999f, VNDF_FAMILY_BELOW, 0},
                {-HUGE_VALF, VNDF_FAMILY_BELOW, 0},     {40.001f, VNDF_FAMILY_ABOVE, 2},
                {HUGE_VALF, VNDF_FAMILY_ABOVE, 2}};
    vndf_mixture m;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        TEST(at(family, ends[i].p, &m) == ends[i].place && m.count == 1 && m.lobe[0].weight == 1 &&
             is_lobe(&m, 0, all[ends[i].knot]));
    for (size_t i = 0; i < KNOTS; i++) {
        TEST(at(family, nextafterf(parameters[i], 1), &m) == VNDF_FAMILY_INSIDE && m.count == 2);
        TEST(fminf(m.lobe[0].weight, m.lobe[1].weight) < 2e-6f && m.lobe[0].weight >= 0 && m.lobe[1].weight >= 0);
    }
    TEST(at(family, NAN, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    TEST(at(NULL, 1, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    TEST(vndf_family_at(family, 1, NULL, &m) == VNDF_FAMILY_INVALID && m.count == 0);
}

static void test_facts(const vndf_family *family, const vndf_distribution *const *all)
{
    vndf_family_facts facts = vndf_family_info(family), none = vndf_family_info(NULL);
    TEST(facts.count == KNOTS && facts.low == parameters[0] && facts.high == parameters[2] && !facts.reciprocal);
    TEST(facts.bytes == 0 && facts.distance == 0 && !facts.source[0] && !facts.tool[0] && facts.memory > 0);
    TEST(none.count == 0 && !none.source[0] && none.memory == 0);
    TEST(vndf_family_distribution(family, 1) == all[1] && vndf_family_parameter(family, 1) == parameters[1]);
    TEST(!vndf_family_distribution(family, KNOTS) && vndf_family_parameter(family, KNOTS) == 0);
    TEST(!vndf_family_distribution(NULL, 0) && vndf_family_distance(family, KNOTS) == 0);
    vndf_family_free(NULL);
}

static void test_refusals(const vndf_distribution *const *all)
{
    const vndf_distribution *hole[KNOTS] = {all[0], NULL, all[2]};
    const struct refusal {
        const vndf_distribution *const *d;
        float p[KNOTS];
        size_t count;
        const char *part;
    } refused[] = {{NULL, {1, 2, 3}, KNOTS, "1 to 256 distributions"},
                   {all, {1, 2, 3}, 0, "1 to 256 distributions"},
                   {all, {1, 2, 3}, 257, "1 to 256 distributions"},
                   {hole, {1, 2, 3}, 3, "1 to 256 distributions"},
                   {all, {1, 2, 2}, KNOTS, "must ascend"},
                   {all, {1, 3, 2}, KNOTS, "must ascend"},
                   {all, {1, (float)NAN, 3}, KNOTS, "not a number"},
                   {all, {1, 2, HUGE_VALF}, KNOTS, "infinite"}};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        vndf_error error = {VNDF_OK, ""};
        TEST(!vndf_family_of(refused[i].d, refused[i].p, refused[i].count, &error));
        TEST(error.status == VNDF_ERROR_ARGUMENT && TEST_HAS(error.message, refused[i].part));
    }
    TEST(!vndf_family_of(NULL, NULL, 0, NULL));
    vndf_family *one = vndf_family_of(all, parameters, 1, NULL);
    vndf_mixture m;
    TEST(at(one, 7, &m) == VNDF_FAMILY_ABOVE && m.count == 1);
    TEST(at(one, parameters[0], &m) == VNDF_FAMILY_INSIDE && m.count == 1);
    vndf_family_free(one);
}

int main(void)
{
    unsigned long long state = 20261123;
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", NULL);
    const vndf_distribution *all[KNOTS] = {vndf_ggx(), vndf_beckmann(), table};
    vndf_family *family = table ? vndf_family_of(all, parameters, KNOTS, NULL) : NULL;
    if (!TEST(family != NULL))
        return test_done();
    test_facts(family, all);
    for (family->reciprocal = 0; family->reciprocal < 2; family->reciprocal++) {
        for (size_t i = 0; i < test_amount(1000, 10000, 100000); i++)
            test_between(family, all, &state);
        test_ends(family, all);
    }
    test_refusals(all);
    vndf_family_free(family);
    vndf_free(table);
    return test_done();
}
