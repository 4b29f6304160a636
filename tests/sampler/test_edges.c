/* Whatever a renderer hands over on a bad day, a sample is a unit normal within 4 ulps, wm.z >= 0, that faces wi, and
 * its density is within [FLT_MIN, FLT_MAX]: directions straight up and down, grazing, with cosines of 1e-7, 0 and
 * denormals, below the horizon until 1e-10 of the area is left; numbers 0, 1 and beside them; roughness 1e-4 to 1e4,
 * matrices of condition 1e8, mean slopes of a thousand times the roughness, mixtures with weights 1e-30 to 1e30. What
 * is invalid has the one result that vndf.h states. Where areas vanish weights are shares. Some 1.9 million samples. */
#include <float.h>

#include "sampler/seen.h"

static const float edges[] = {0,    FLT_TRUE_MIN,    0x1p-24f,     0.25f, 0.5f - 0x1p-25f,
                              0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f, 1};
enum { EDGES = sizeof edges / sizeof *edges };

static size_t samples, views, told, messages; /* told: the view whose failure was printed last, one for each */

/* ---- one sample ---- */

/* wi.wm to the last bit, or nearly: products of floats are exact. */
static int faces(vndf_vec3 wi, vndf_vec3 wm)
{
    return (long double)wi.x * (long double)wm.x + (long double)wi.y * (long double)wm.y +
               (long double)wi.z * (long double)wm.z >
           0;
}

static int is_good(const seen *s, vndf_vec3 wm, float pdf)
{
    int down = s->wi.x == 0 && s->wi.y == 0 && s->wi.z < 0; /* no normal faces that */
    if (!(fabs(length_of(wm) - 1) <= 4 * 0x1p-23 && wm.z >= 0))
        return 0;
    return down ? pdf == 0 : pdf >= FLT_MIN && pdf <= FLT_MAX && faces(s->wi, wm);
}

static void check_sample(const seen *s, float u1, float u2, const char *name)
{
    float pdf = -1;
    vndf_vec3 wm = seen_draw(s, u1, u2, &pdf);
    samples++;
    if (!TEST(is_good(s, wm, pdf)) && told != views && messages++ < 20) {
        told = views;
        seen_print(s, name);
        fprintf(stderr, "    u %.9g %.9g: wm %.9g %.9g %.9g, length - 1 %.3g, wi.wm %.3g, pdf %.9g\n", (double)u1,
                (double)u2, (double)wm.x, (double)wm.y, (double)wm.z, length_of(wm) - 1, dot_of(s->wi, wm),
                (double)pdf);
    }
}

static void check_view(const seen *s, const char *name, unsigned long long *state)
{
    views++;
    for (int i = 0; i < EDGES * EDGES; i++)
        check_sample(s, edges[i / EDGES], edges[i % EDGES], name);
    for (int i = 0; i < 11; i++) {
        float u1 = test_uniform(state), u2 = test_uniform(state);
        check_sample(s, u1, i % 2 ? u2 : 1 - u2 * u2 * u2 * u2, name);
    }
}

/* ---- directions ---- */

enum { DIRECTIONS = 30 };

/* Below the horizon the depth, in what is seen, falls from one direction to the next. */
static vndf_vec3 direction_at(int i, unsigned long long *state)
{
    static const double cosines[DIRECTIONS] = {
        1,      1,     1,     0.99,  0.9,   0.5,  0.1,  1e-2, 1e-4,  1e-7, 1e-20, 1e-42, 0,     -0.0, -1e-42,
        -1e-20, -1e-7, -1e-4, -1e-2, -0.03, -0.1, -0.2, -0.3, -0.45, -0.6, -0.75, -0.9,  -0.97, -1,   -1};
    double phi = i % 3 ? random_between(state, -PI, PI) : 0, length = i % 4 ? 1 : 1 + 1e-6, z = cosines[i];
    double across = i == 1 ? 1e-7 : i == 2 ? 1e-4 : i == DIRECTIONS - 2 ? 1e-4 : sqrt((1 - z) * (1 + z));
    vndf_vec3 w = {(float)(length * across * cos(phi)), (float)(length * across * sin(phi)), (float)(length * z)};
    return w;
}

/* Where less than 1e-10 of what is seen at grazing incidence is left, nothing is promised but no harm. */
static int sees(const seen *s)
{
    vndf_vec3 level = {s->wi.x, s->wi.y, 0};
    return s->wi.z >= 0 || (s->wi.x == 0 && s->wi.y == 0) || seen_area(s, s->wi) > 1e-10f * seen_area(s, level);
}

static void check_harmless(const seen *s, unsigned long long *state)
{
    for (int i = 0; i < 8; i++) {
        float pdf = -1;
        vndf_vec3 wm = seen_draw(s, test_uniform(state), test_uniform(state), &pdf);
        TEST(fabs(length_of(wm) - 1) <= 4 * 0x1p-23 && wm.z >= 0 && pdf >= 0 && pdf <= FLT_MAX);
    }
}

static void check_directions(seen_kind kind, const vndf_mixture *of, const char *name, unsigned long long *state)
{
    for (int i = 0; i < DIRECTIONS; i++) {
        seen s = seen_from(kind, of, direction_at(i, state));
        if (sees(&s))
            check_view(&s, name, state);
        else
            check_harmless(&s, state);
    }
}

/* ---- surfaces ---- */

/* A matrix of singular values a and b, and a mean slope. */
static vndf_affine turned(const vndf_distribution *d, double a, double b, double mean, unsigned long long *state)
{
    double p = random_between(state, -PI, PI), q = random_between(state, -PI, PI),
           t = random_between(state, -PI, PI);
    vndf_affine m = {d,
                     (float)(a * cos(p) * cos(q) - b * sin(p) * sin(q)),
                     (float)(-a * cos(p) * sin(q) - b * sin(p) * cos(q)),
                     (float)(a * sin(p) * cos(q) + b * cos(p) * sin(q)),
                     (float)(-a * sin(p) * sin(q) + b * cos(p) * cos(q)),
                     (float)(mean * cos(t)),
                     (float)(mean * sin(t))};
    return m;
}

static void check_surfaces(const vndf_distribution *d, const char *name, unsigned long long *state)
{
    static const float alphas[] = {1e-4f, 1e-2f, 0.3f, 1, 1e4f};
    for (int i = 0; i < 25; i++) {
        const vndf_mixture of = {1, {{seen_straight(d, alphas[i / 5], alphas[i % 5]), 1}}};
        check_directions(SEEN_SURFACE, &of, name, state);
    }
    for (int i = 0; i < (int)test_amount(4, 34, 240); i++) {
        double a = random_decade(state, -4, 1), b = a * random_decade(state, -8 * (i % 2), 0);
        double mean = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e3 * a : random_between(state, 0, 2);
        const vndf_mixture of = {1, {{turned(d, a, b, fmin(mean, 1e5), state), 1}}};
        check_directions(SEEN_AFFINE, &of, name, state);
    }
    for (int i = 0; i < (int)test_amount(3, 15, 150); i++) {
        const vndf_distribution *other = i % 2 ? vndf_ggx() : vndf_beckmann();
        double a = random_decade(state, -4, 0), b = random_decade(state, -4, 0),
               mean = i % 3 ? random_between(state, 0, 1) : 0;
        const vndf_mixture of = {2,
                                 {{turned(d, a, b, mean, state), (float)random_decade(state, -30, 30)},
                                  {turned(other, b, a, mean, state), (float)random_decade(state, -30, 30)}}};
        check_directions(SEEN_MIXTURE, &of, name, state);
    }
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
    return wm.x == 0 && wm.y == 0 && wm.z == 1 && pdf == 0 && seen_pdf(s, up) == 0 && seen_visible(s, up) == 0 &&
           v1 == 0 && v2 == 0;
}

static void check_invalid(const vndf_distribution *d)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e30f};
    const vndf_vec3 wi = {0.6f, 0, 0.8f};
    for (int i = 0; i < 6; i++) {
        const vndf_vec3 odd = {i < 3 ? bad[i] : 0, 0, i < 3 ? 1.0f : 0};
        seen rough = seen_surface(d, bad[i], 0.3f, wi), turned_to = seen_surface(d, 0.3f, 0.3f, odd);
        TEST(gives_nothing(&rough) & gives_nothing(&turned_to));
        TEST(vndf_projected_area(&(vndf_surface){d, bad[i], 1}, wi) == 0);
        const vndf_mixture lobes = {2, {{seen_straight(d, 1, 1), 1}, {seen_straight(d, bad[i], 1), 1}}};
        const vndf_mixture weights = {
            2, {{seen_straight(d, 1, 1), 1}, {seen_straight(d, 1, 1), i == 3 ? NAN : bad[i]}}};
        seen a = seen_from(SEEN_AFFINE, &(vndf_mixture){1, {{{d, 1, 0, bad[i], i < 3 ? 1.0f : 0, 0, 0}, 1}}}, wi);
        seen b = seen_from(SEEN_MIXTURE, &lobes, wi), c = seen_from(SEEN_MIXTURE, &weights, wi);
        TEST(gives_nothing(&a));
        TEST(i == 4 || gives_nothing(&b)); /* a matrix may mirror */
        TEST(i == 5 || gives_nothing(&c));
    }
    seen none = seen_surface(NULL, 1, 1, wi);
    TEST(gives_nothing(&none));
}

/* Numbers outside are clamped, NaN is 0; a normal of NaN, or below the surface, has no density. */
static void check_numbers(const vndf_distribution *d)
{
    static const float odd[][2] = {{NAN, 0}, {-1, 0}, {2, 1}, {INFINITY, 1}, {-INFINITY, 0}, {-0.0f, 0}};
    for (int i = 0; i < 6; i++)
        for (int z = -1; z <= 1; z++) {
            seen s = seen_surface(d, 0.3f, 0.7f, (vndf_vec3){0.8f, 0.1f, 0.5f * (float)z});
            float a, b;
            vndf_vec3 v = seen_draw(&s, odd[i][0], 0.3f, &a), w = seen_draw(&s, odd[i][1], 0.3f, &b);
            TEST(memcmp(&v, &w, sizeof v) == 0 && a == b);
            v = seen_draw(&s, 0.3f, odd[i][0], &a), w = seen_draw(&s, 0.3f, odd[i][1], &b);
            TEST(memcmp(&v, &w, sizeof v) == 0 && a == b);
            TEST(seen_pdf(&s, (vndf_vec3){odd[0][0], 0, 1}) == 0 &&
                 seen_pdf(&s, (vndf_vec3){0.6f, 0, -0.8f}) == 0);
        }
}

/* Straight below no lobe has an area that a float can hold: lobes are drawn by their weights. */
static void check_vanished(const vndf_distribution *d)
{
    const vndf_mixture of = {2, {{seen_straight(d, 1e-3f, 1e-3f), 1}, {seen_straight(d, 1e-3f, 1e-3f), 3}}};
    seen s = seen_from(SEEN_MIXTURE, &of, (vndf_vec3){0, 0, -1});
    int before = -1, after = -1;
    vndf_mixture_sample(&s.mixture, 0.2499f, 0.5f, NULL, &before);
    vndf_mixture_sample(&s.mixture, 0.2501f, 0.5f, NULL, &after);
    TEST(before == 0 && after == 1);
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < SUBJECT_COUNT; i++) {
        unsigned long long state = 1 + i;
        subject s = subject_open(i);
        if (s.d && oracle_wanted(arguments, argument, i, s.name)) {
            check_surfaces(s.d, s.name, &state);
            check_invalid(s.d);
            check_numbers(s.d);
            check_vanished(s.d);
        }
        vndf_free(s.owned);
    }
    fprintf(stderr, "%lu samples\n", (unsigned long)samples);
    return test_done();
}
