/* A family at a parameter is the mixture of the knots on either side of it, with weights that are linear in p or in 1/p
 * and the matrix and mean slope that are asked for; D, area, Lambda and densities are sums of theirs; at a knot it has
 * the bits of the one distribution; a parameter outside is taken to the nearer end, NaN gives an invalid mixture, and
 * no lobe behind those two is written. */
#include <float.h>

#include "harness/test.h"
#include "table/family/family.h"

enum { KNOTS = 3 };
static const float parameters[KNOTS] = {0.5f, 1.7f, 40};

static double uniform(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

static vndf_affine random_shape(unsigned long long *state)
{
    vndf_affine m = {NULL,
                     (float)uniform(state, 0.1, 0.5),
                     (float)uniform(state, -0.1, 0.1),
                     (float)uniform(state, -0.1, 0.1),
                     (float)uniform(state, 0.1, 0.5),
                     (float)uniform(state, -0.3, 0.3),
                     (float)uniform(state, -0.3, 0.3)};
    return m;
}

static vndf_vec3 random_direction(unsigned long long *state)
{
    double z = uniform(state, -0.7, 1), phi = uniform(state, 0, 6.283185307), s = sqrt(1 - z * z);
    vndf_vec3 w = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)z};
    return w;
}

static int same_shape(const vndf_affine *a, const vndf_affine *b)
{
    return memcmp(&a->xx, &b->xx, 6 * sizeof(float)) == 0;
}

/* ---- between knots ---- */

static void test_sums(const vndf_mixture *m, double t, const vndf_affine *shape,
                      const vndf_distribution *const *all, size_t knot, unsigned long long *state)
{
    vndf_affine low = *shape, high = *shape;
    vndf_vec3 wi = random_direction(state);
    vndf_mixture_view view = vndf_mixture_view_from(m, wi);
    float pdf;
    vndf_vec3 wm = vndf_mixture_sample(&view, test_uniform(state), test_uniform(state), &pdf, NULL);
    low.distribution = all[knot];
    high.distribution = all[knot + 1];
    double area_low = vndf_affine_projected_area(&low, wi), area_high = vndf_affine_projected_area(&high, wi);
    double area = (1 - t) * area_low + t * area_high, part = t * area_high / area;
    double up = wi.z - ((double)wi.x * shape->mean_x + (double)wi.y * shape->mean_y);
    vndf_view view_low = vndf_affine_view_from(&low, wi), view_high = vndf_affine_view_from(&high, wi);
    double ndf = (1 - t) * vndf_affine_ndf(&low, wm) + t * vndf_affine_ndf(&high, wm);
    double density = (1 - part) * vndf_pdf(&view_low, wm) + part * vndf_pdf(&view_high, wm);
    TEST_RELATIVE((double)vndf_mixture_ndf(m, wm), ndf, 1e-6);
    TEST_RELATIVE((double)vndf_mixture_projected_area(m, wi), area, 1e-6);
    TEST_RELATIVE((double)vndf_mixture_pdf(&view, wm), density, 1e-5);
    TEST_RELATIVE((double)pdf, density, 1e-4); /* of the normal as it was rounded */
    if (up > 0.01) {
        TEST_NEAR((double)vndf_mixture_g1(m, wi), fmin(up / area, 1), 1e-5);
        TEST_NEAR((double)vndf_mixture_lambda(m, wi), area / up - 1, 1e-5 * area / up);
    }
}

static void test_between(const vndf_family *family, const vndf_distribution *const *all, unsigned long long *state)
{
    size_t knot = test_random_bits(state) % (KNOTS - 1);
    double a = parameters[knot], b = parameters[knot + 1];
    float p = (float)uniform(state, a * 1.0001, b * 0.9999);
    vndf_affine shape = random_shape(state);
    vndf_mixture m, untouched;
    memset(&m, 0x5a, sizeof m);
    untouched = m;
    TEST(vndf_family_at(family, p, &shape, &m) == VNDF_FAMILY_INSIDE && m.count == 2);
    double t = family->reciprocal ? (1 / (double)p - 1 / a) / (1 / b - 1 / a) : (p - a) / (b - a);
    TEST_NEAR((double)m.lobe[1].weight, t, 1e-6);
    TEST_NEAR((double)m.lobe[0].weight + (double)m.lobe[1].weight, 1, 1e-7);
    TEST(m.lobe[0].surface.distribution == all[knot] && m.lobe[1].surface.distribution == all[knot + 1]);
    TEST(same_shape(&m.lobe[0].surface, &shape) && same_shape(&m.lobe[1].surface, &shape));
    TEST(memcmp(&m.lobe[2], &untouched.lobe[2], sizeof m.lobe[2]) == 0);
    if (m.count == 2)
        test_sums(&m, t, &shape, all, knot, state);
}

/* ---- one lobe ---- */

static void test_one(const vndf_family *family, float p, vndf_family_place place, const vndf_distribution *of,
                     unsigned long long *state)
{
    vndf_affine shape = random_shape(state), own = shape;
    vndf_mixture m;
    TEST(vndf_family_at(family, p, &shape, &m) == place);
    if (!TEST(m.count == 1 && m.lobe[0].weight == 1.0f && m.lobe[0].surface.distribution == of))
        return;
    own.distribution = of;
    vndf_vec3 wi = random_direction(state);
    vndf_mixture_view view = vndf_mixture_view_from(&m, wi);
    vndf_view alone = vndf_affine_view_from(&own, wi);
    float u1 = test_uniform(state), u2 = test_uniform(state), pdf, density;
    vndf_vec3 a = vndf_mixture_sample(&view, u1, u2, &pdf, NULL), b = vndf_sample(&alone, u1, u2, &density);
    TEST(memcmp(&a, &b, sizeof a) == 0 && pdf == density);
    TEST(vndf_mixture_ndf(&m, a) == vndf_affine_ndf(&own, a));
}

static void test_knots_and_ends(const vndf_family *family, const vndf_distribution *const *all,
                                unsigned long long *state)
{
    for (size_t i = 0; i < KNOTS; i++)
        test_one(family, parameters[i], VNDF_FAMILY_INSIDE, all[i], state);
    test_one(family, 0.49999f, VNDF_FAMILY_BELOW, all[0], state);
    test_one(family, -HUGE_VALF, VNDF_FAMILY_BELOW, all[0], state);
    test_one(family, 40.001f, VNDF_FAMILY_ABOVE, all[2], state);
    test_one(family, HUGE_VALF, VNDF_FAMILY_ABOVE, all[2], state);
    for (size_t i = 0; i < KNOTS; i++) { /* beside a knot the neighbour is next to nothing */
        vndf_affine shape = random_shape(state);
        vndf_mixture m;
        vndf_family_place place = vndf_family_at(family, nextafterf(parameters[i], 1), &shape, &m);
        TEST(place == VNDF_FAMILY_INSIDE && m.count == 2);
        TEST(fminf(m.lobe[0].weight, m.lobe[1].weight) < 2e-6f && m.lobe[0].weight >= 0 && m.lobe[1].weight >= 0);
    }
}

static void test_invalid(const vndf_family *family)
{
    vndf_affine shape = {NULL, 1, 0, 0, 1, 0, 0};
    vndf_mixture m = {1, {{shape, 1}}};
    TEST(vndf_family_at(family, (float)NAN, &shape, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    m.count = 1;
    TEST(vndf_family_at(NULL, 1, &shape, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    m.count = 1;
    TEST(vndf_family_at(family, 1, NULL, &m) == VNDF_FAMILY_INVALID && m.count == 0);
    TEST(vndf_mixture_view_from(&m, (vndf_vec3){0, 0, 1}).count == 0);
}

/* ---- the family itself ---- */

static void test_facts(const vndf_family *family, const vndf_distribution *const *all)
{
    vndf_family_facts facts = vndf_family_info(family), none = vndf_family_info(NULL);
    TEST(facts.count == KNOTS && facts.low == parameters[0] && facts.high == parameters[2] && !facts.reciprocal);
    TEST(facts.bytes == 0 && facts.distance == 0 && facts.source[0] == '\0' && facts.tool[0] == '\0');
    TEST(facts.memory == vndf_distribution_info(all[2]).memory && facts.memory > 0);
    TEST(none.count == 0 && none.source[0] == '\0' && none.memory == 0);
    TEST(vndf_family_distribution(family, 1) == all[1] && vndf_family_parameter(family, 1) == parameters[1]);
    TEST(!vndf_family_distribution(family, KNOTS) && vndf_family_parameter(family, KNOTS) == 0);
    TEST(!vndf_family_distribution(NULL, 0) && vndf_family_distance(family, KNOTS) == 0);
    vndf_family_free(NULL);
}

static void test_refused(const vndf_distribution *const *d, const float *p, size_t count, const char *part)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_family *family = vndf_family_of(d, p, count, &error);
    TEST(!family && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, part);
    vndf_family_free(family);
}

static void test_refusals(const vndf_distribution *const *all)
{
    const vndf_distribution *hole[KNOTS] = {all[0], NULL, all[2]};
    const float equal[KNOTS] = {1, 2, 2}, falling[KNOTS] = {1, 3, 2}, nan[KNOTS] = {1, (float)NAN, 3},
                infinite[KNOTS] = {1, 2, HUGE_VALF};
    test_refused(NULL, parameters, KNOTS, "1 to 256 distributions");
    test_refused(all, NULL, KNOTS, "1 to 256 distributions");
    test_refused(all, parameters, 0, "1 to 256 distributions");
    test_refused(all, parameters, 257, "1 to 256 distributions");
    test_refused(hole, parameters, KNOTS, "1 to 256 distributions");
    test_refused(all, equal, KNOTS, "must ascend");
    test_refused(all, falling, KNOTS, "must ascend");
    test_refused(all, nan, KNOTS, "not a number");
    test_refused(all, infinite, KNOTS, "infinite");
    TEST(!vndf_family_of(NULL, NULL, 0, NULL));
    vndf_family *one = vndf_family_of(all, parameters, 1, NULL);
    vndf_affine shape = {NULL, 1, 0, 0, 1, 0, 0};
    vndf_mixture m;
    TEST(vndf_family_at(one, 7, &shape, &m) == VNDF_FAMILY_ABOVE && m.count == 1);
    TEST(vndf_family_at(one, parameters[0], &shape, &m) == VNDF_FAMILY_INSIDE && m.count == 1);
    vndf_family_free(one);
}

int main(void)
{
    unsigned long long state = 20261123;
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", NULL);
    const vndf_distribution *all[KNOTS] = {vndf_ggx(), vndf_beckmann(), table};
    vndf_family *family = table ? vndf_family_of(all, parameters, KNOTS, NULL) : NULL;
    size_t many = test_amount(1000, 10000, 100000);
    if (!TEST(family != NULL))
        return test_done();
    test_facts(family, all);
    for (family->reciprocal = 0; family->reciprocal < 2; family->reciprocal++) {
        for (size_t i = 0; i < many; i++)
            test_between(family, all, &state);
        test_knots_and_ends(family, all, &state);
    }
    test_invalid(family);
    test_refusals(all);
    vndf_family_free(family);
    vndf_free(table);
    return test_done();
}
