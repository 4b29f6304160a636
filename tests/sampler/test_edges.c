/* What is invalid has the one result that vndf.h states, for surfaces, matrices and mixtures. What is valid gives a
 * unit normal with wm.z >= 0 that faces wi, with a density within [FLT_MIN, FLT_MAX] and a finite weight, or density 0
 * from straight below: mixtures with weights 1e-38 to 1e38, matrices, mean slopes and lengths of directions to the ends
 * of what is valid. No quantity is infinite or NaN. Where areas vanish weights are shares; one lobe has the bits of its
 * surface. What test_stress asks of one distribution holds too where the caller has the processor flush denormals to
 * zero and read them as zero, as renderers do (batches: test_batch). */
#include <float.h>

#include "evidence/measure/measure.h"
#include "sampler/seen.h"
#include "vndf_build.h"

/* ---- valid input ---- */

static void check_view(const seen *s, const char *name, unsigned long long *state)
{
    static const float edges[] = {0, FLT_TRUE_MIN, 0x1p-24f, 0.25f, 0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f, 1};
    int good = 1;
    for (int i = 0; i < 64 + 8; i++) {
        float u1 = test_uniform(state), u2 = test_uniform(state), pdf = -1, weight = 0;
        vndf_vec3 wm = seen_draw(s, i < 64 ? edges[i / 8] : u1, i < 64 ? edges[i % 8] : u2, &pdf);
        good &= fabs(length_of(wm) - 1) <= 4 * 0x1p-23 && wm.z >= 0 && pdf <= FLT_MAX;
        good &= pdf >= FLT_MIN ? dot_of(s->wi, wm) > 0 : pdf == 0 && seen_quantity(s, LAMBDA, s->wi) == -1;
        if (s->kind != SEEN_MIXTURE)
            vndf_sample_weight(&s->view, i < 64 ? edges[i / 8] : u1, i < 64 ? edges[i % 8] : u2, NULL, &weight);
        good &= weight >= 0 && weight <= FLT_MAX;
        for (int q = 0; q < QUANTITIES; q++)
            good &= fabsf(seen_quantity(s, (quantity)q, q < AREA ? wm : s->wi)) <= FLT_MAX;
    }
    if (!TEST(good) && test_failures < 20)
        seen_print(s, name);
}

/* Ordinary ones by turns with those at the ends of what is valid. */
static void check_valid(const vndf_distribution *d, const char *name, size_t count, unsigned long long *state)
{
    static const double cosines[] = {1,      0.5,   0.1,   1e-2, 1e-4, 1e-7, 1e-20, 1e-42, 0,     -0.0,
                                     -1e-42, -1e-7, -1e-2, -0.1, -0.3, -0.6, -0.9,  -0.97, -0.99, -1};
    const double unit = 1 / vndf_distribution_info(d).scale;
    size_t valid = 0;
    for (size_t i = 0; i < count; i++) {
        const int wild = i % 2;
        const double larger = unit * random_decade(state, wild ? -15 : -4, wild ? 15 : 0);
        const double lesser = larger * random_decade(state, i % 4 == 1 ? -15 : -9, 0);
        const double mean = i % 3 ? random_decade(state, -6, wild ? 6 : 0) : 0,
                     phi = random_between(state, -PI, PI);
        const double z = i % 7 ? cosines[i % (sizeof cosines / sizeof *cosines)] : sin(atan(mean * cos(phi)));
        const double length = wild ? random_decade(state, -20, 20) : 1, across = length * sqrt((1 - z) * (1 + z));
        const double wi[3] = {across * cos(phi), i % 11 ? across * sin(phi) : 0, length * z};
        vndf_mixture of = {2, {{oracle_turned(d, larger, lesser, (double)i, phi + 2 * (double)i), 0}}};
        of.lobe[0].surface.mean_x = (float)mean;
        of.lobe[0].weight = (float)random_decade(state, -38, 38);
        of.lobe[1].surface = oracle_turned(i % 3 ? vndf_ggx() : vndf_beckmann(), 1, 0.1, phi, phi);
        of.lobe[1].weight = (float)random_decade(state, -38, 38);
        const vndf_mixture alone = {1, {of.lobe[0]}};
        seen one = seen_from(SEEN_SURFACE, &alone, vec3_of(wi)), mixed = seen_from(SEEN_MIXTURE, &of, one.wi),
             lone = seen_from(SEEN_MIXTURE, &alone, one.wi);
        if (!one.view.distribution)
            continue;
        valid++;
        check_view(&one, name, state);
        check_view(&mixed, name, state);
        float u1 = test_uniform(state), u2 = test_uniform(state), pdf, density;
        vndf_vec3 a_wm = seen_draw(&one, u1, u2, &pdf), b_wm = seen_draw(&lone, u1, u2, &density);
        TEST(memcmp(&a_wm, &b_wm, sizeof a_wm) == 0 && pdf == density);
    }
    TEST(valid > count / 2);
}

/* ---- invalid input ---- */

static int gives_nothing(const seen *s)
{
    float pdf = -1, v1 = -1, v2 = -1;
    vndf_vec3 wm = seen_draw(s, 0.3f, 0.6f, &pdf), up = {0, 0, 1};
    if (s->kind == SEEN_SURFACE)
        vndf_invert(&s->view, up, &v1, &v2);
    else
        v1 = v2 = 0;
    return wm.x == 0 && wm.y == 0 && wm.z == 1 && pdf == 0 && seen_pdf(s, up) == 0 &&
           seen_quantity(s, VISIBLE, up) == 0 && v1 == 0 && v2 == 0;
}

static void check_invalid(const vndf_distribution *d)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e30f};
    const vndf_vec3 wi = {0.6f, 0, 0.8f};
    for (int i = 0; i < 6; i++) {
        const vndf_vec3 odd = {i < 3 ? bad[i] : 0, 0, i < 3 ? 1.0f : 0};
        seen rough = seen_surface(vndf_rough(d, bad[i], 0.3f), wi),
             turned_to = seen_surface(vndf_rough(d, 0.3f, 0.3f), odd);
        TEST(gives_nothing(&rough) & gives_nothing(&turned_to));
        TEST(vndf_projected_area(&rough.of.lobe[0].surface, wi) == 0);
        const vndf_mixture lobes = {2, {{vndf_rough(d, 1, 1), 1}, {vndf_rough(d, bad[i], 1), 1}}};
        const vndf_mixture weights = {2, {{vndf_rough(d, 1, 1), 1}, {vndf_rough(d, 1, 1), i == 3 ? NAN : bad[i]}}};
        seen a = seen_surface((vndf_surface){d, 1, 0, bad[i], i < 3 ? 1.0f : 0, 0, 0}, wi);
        seen b = seen_from(SEEN_MIXTURE, &lobes, wi), c = seen_from(SEEN_MIXTURE, &weights, wi);
        TEST(gives_nothing(&a) & gives_nothing(&b));
        TEST(i == 5 || gives_nothing(&c));
    }
    seen none = seen_surface(vndf_rough(NULL, 1, 1), wi),
         mirrored = seen_surface((vndf_surface){d, -1, 0, 0, 1, 0, 0}, wi);
    TEST(!vndf_view_from(NULL, wi).distribution && !vndf_mixture_view_from(NULL, wi).count);
    TEST(vndf_p22(NULL, NAN, 0) + vndf_p22(NULL, 0, NAN) == 0);
    TEST(gives_nothing(&none) && !gives_nothing(&mirrored));
}

/* Beyond the ends: a matrix, a mean slope, and a length of wi. */
static void check_beyond(void)
{
    static const float of[][7] = {{1.1e15f, 0, 0, 1, 0, 0, 1}, {1, 0, 0, 0.9e-15f, 0, 0, 1},
                                  {1, 1, 1, 1, 0, 0, 1},       {1, 0, 0, 1, 1.1e6f, 0, 1},
                                  {1, 0, 0, 1, 0, -1.1e6f, 1}, {1, 0, 0, 1, 0, 0, FLT_TRUE_MIN},
                                  {1, 0, 0, 1, 0, 0, 1.1e20f}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const float *a = of[i];
        const vndf_surface one = {vndf_ggx(), a[0], a[1], a[2], a[3], a[4], a[5]};
        seen s = seen_surface(one, (vndf_vec3){0, 0, a[6]});
        TEST(gives_nothing(&s));
    }
}

/* Numbers outside are clamped, NaN is 0; a normal of NaN, or below the surface, has no density. */
static void check_numbers(const vndf_distribution *d)
{
    static const float odd[][2] = {{NAN, 0}, {-1, 0}, {2, 1}, {INFINITY, 1}, {-INFINITY, 0}, {-0.0f, 0}};
    for (int i = 0; i < 6; i++)
        for (int z = -1; z <= 1; z++) {
            seen s = seen_surface(vndf_rough(d, 0.3f, 0.7f), (vndf_vec3){0.8f, 0.1f, 0.5f * (float)z});
            float a, b;
            vndf_vec3 v = seen_draw(&s, odd[i][0], 0.3f, &a), w = seen_draw(&s, odd[i][1], 0.3f, &b);
            TEST(memcmp(&v, &w, sizeof v) == 0 && a == b);
            v = seen_draw(&s, 0.3f, odd[i][0], &a), w = seen_draw(&s, 0.3f, odd[i][1], &b);
            TEST(memcmp(&v, &w, sizeof v) == 0 && a == b);
            TEST(seen_pdf(&s, (vndf_vec3){odd[0][0], 0, 1}) == 0 &&
                 seen_pdf(&s, (vndf_vec3){0.6f, 0, -0.8f}) == 0);
        }
}

/* Straight below no lobe has an area that a float can hold: lobes are drawn by their weights. A lobe whose share is 0
 * does not take the end of u1. */
static void check_vanished(const vndf_distribution *d)
{
    const vndf_mixture of = {2, {{vndf_rough(d, 1e-3f, 1e-3f), 1}, {vndf_rough(d, 1e-3f, 1e-3f), 3}}};
    seen s = seen_from(SEEN_MIXTURE, &of, (vndf_vec3){0, 0, -1});
    int before = -1, after = -1;
    vndf_mixture_sample(&s.mixture, 0.2499f, 0.5f, NULL, &before);
    vndf_mixture_sample(&s.mixture, 0.2501f, 0.5f, NULL, &after);
    TEST(before == 0 && after == 1);
    const vndf_mixture faint = {2, {{vndf_rough(d, 1, 1), 1}, {vndf_rough(d, 1e-6f, 1e-6f), 1e-44f}}};
    s = seen_from(SEEN_MIXTURE, &faint, (vndf_vec3){1, 0, 0});
    vndf_mixture_sample(&s.mixture, 1, 0.5f, NULL, &after);
    TEST(after == 0);
}

static void check_flushed(const subject *of)
{
    if (!set_flushing(1))
        return; /* no way is known here */
    stress_result result = stress_run(of->d, test_amount(73, 37, 19), 1);
    set_flushing(0);
    for (int id = 0; id < STRESS_COUNT; id++)
        if (!(TEST(result.found[id].failed == 0) & TEST(result.found[id].checked > 0)))
            fprintf(stderr, "  %s, %s: worst %g\n", of->name, stress_properties[id].name, result.found[id].worst);
}

static void test_subject(const subject *of, size_t index)
{
    unsigned long long state = 1 + index;
    check_valid(of->d, of->name, test_amount(120, 1200, 12000), &state);
    check_invalid(of->d);
    check_numbers(of->d);
    check_vanished(of->d);
    if (index < 2 || index % 3 == 2)
        check_flushed(of);
}

/* The tail of c^-0.7, r^-3.3, leads to normals so level that a matrix may make nothing of them. */
int main(int arguments, char **argument)
{
    unsigned long long state = 5;
    vndf_source *source = vndf_source_ndf_expression("c^-0.7+20*c^30", NULL, 0, NULL);
    vndf_distribution *tail = source ? vndf_build(source, NULL, NULL, NULL) : NULL;
    if (TEST(tail != NULL))
        check_valid(tail, "c^-0.7", test_amount(1200, 1200, 12000), &state);
    check_beyond();
    TEST(strcmp(vndf_version(), VNDF_VERSION) == 0);
    vndf_free(tail);
    vndf_source_free(source);
    return subjects_test(arguments, argument, test_subject);
}
