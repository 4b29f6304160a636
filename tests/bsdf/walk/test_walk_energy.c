/* A lossless walk loses nothing: each sample that leaves has weight 1 (closed forms: to the bit; tables, whose
 * weight holds the ratio of true to drawn density: in the mean), and the order limit of 64 loses less than 1e-3 of
 * any; directions are unit and on the side that the lobe says; a limit of the order cuts the same walk short. Means
 * at 4.5 sigmas, 7e-6 each, of 17 x 5 x 6 x 4. */
#include "bsdf/walk/walk_case.h"

static const float ALPHAS[][2] = {{0.05f, 0.05f}, {0.3f, 0.3f}, {1, 1}, {0.1f, 1}, {1e-3f, 1e-3f}};
static const double COSINES[] = {1, 0.8660254, 0.5, 0.1736482, 1e-3, 1e-6};
enum { ALPHA_COUNT = 5, COSINE_COUNT = 6, SAMPLES = 20000 };

static void check_sample(const vndf_scattered *w, int closed)
{
    double length2 = (double)w->wo.x * w->wo.x + (double)w->wo.y * w->wo.y + (double)w->wo.z * w->wo.z;
    TEST_NEAR(length2, 1.0, 1e-6);
    if (w->lobe == VNDF_LOBE_NONE)
        TEST(w->weight[0] == 0.0f);
    else if (closed)
        TEST(w->weight[0] == 1.0f);
    TEST(w->lobe == VNDF_LOBE_NONE || (w->lobe == VNDF_LOBE_REFLECTION) == (w->wo.z > 0.0f));
}

/* Mean weight of what left, and how much was lost. */
static void test_view(const walk_hit *h, const char *name, double most_lost)
{
    size_t count = walk_count(SAMPLES);
    int closed = h->is.distribution == vndf_ggx() || h->is.distribution == vndf_beckmann();
    unsigned long long state = 20160724;
    walk_mean weight = {0, 0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        float u[3];
        vndf_scattered w;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&h->bsdf, u, &w);
        check_sample(&w, closed);
        weight.count += w.lobe != VNDF_LOBE_NONE;
        walk_add(&weight, (double)w.weight[0]);
    }
    double lost = 1.0 - weight.count / (double)count, noise = 4.5 * sqrt(most_lost / (double)count);
    /* the area of a table of default size is within some 1e-4 of that of its D, and a walk meets some facets */
    int good = TEST_NEAR(walk_value(&weight), 1.0, 4.5 * sqrt(walk_variance(&weight)) + (closed ? 1e-6 : 1e-3)) &
               TEST(lost <= most_lost + noise);
    if (!good) {
        walk_describe(h, name);
        fprintf(stderr, "    lost %g\n", lost);
    }
}

static void test_subject(int subject)
{
    const vndf_distribution *d = walk_subject(subject);
    vndf_description walks[] = {walk_of_mirror(), walk_of_glass(1.5f), walk_of_glass(1.0f / 1.5f),
                                walk_of_glass(2.4f)};
    for (size_t i = 0; d && i < ALPHA_COUNT; i++)
        for (size_t j = 0; j < COSINE_COUNT; j++)
            for (size_t k = 0; k < sizeof walks / sizeof *walks; k++) {
                walk_hit h;
                walk_hit_at(&h, &walks[k], d, ALPHAS[i][0], ALPHAS[i][1], walk_direction(COSINES[j], 0.4));
                test_view(&h, walk_subject_name(subject), 1e-3);
            }
    walk_subject_free(d);
}

static void test_orders(void)
{
    vndf_description is = walk_of_metal(), shorter = is;
    unsigned long long state = 4;
    size_t lost = 0;
    walk_hit whole, cut;
    shorter.order_limit = 2;
    walk_hit_at(&whole, &is, vndf_ggx(), 1.0f, 1.0f, walk_direction(0.7, 0.0));
    walk_hit_at(&cut, &shorter, vndf_ggx(), 1.0f, 1.0f, whole.wi);
    for (int i = 0; i < 3000; i++) {
        float u[3];
        vndf_scattered w, v;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&whole.bsdf, u, &w);
        vndf_bsdf_sample(&cut.bsdf, u, &v);
        TEST(v.lobe == VNDF_LOBE_NONE || (v.wo.z == w.wo.z && v.weight[0] == w.weight[0]));
        lost += v.lobe == VNDF_LOBE_NONE;
    }
    TEST(lost > 50 && lost < 1000);
}

/* The weight after one event is what the table lacks to the true D at the normal it drew. */
static void test_ratio(void)
{
    const vndf_distribution *d = walk_subject(7);
    vndf_description is = walk_of_mirror();
    unsigned long long state = 6;
    double furthest = 0.0;
    walk_hit h;
    is.order_limit = 1;
    walk_hit_at(&h, &is, d, 1.0f, 0.6f, walk_direction(0.4, 0.3));
    for (int i = 0; i < 5000; i++) {
        float u[3];
        vndf_scattered w;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&h.bsdf, u, &w);
        vndf_vec3 wm = vndf_sample(&h.view, u[0], u[1], NULL);
        double ratio = (double)vndf_visible(&h.view, wm) / (double)vndf_pdf(&h.view, wm);
        if (w.lobe != VNDF_LOBE_NONE)
            TEST_NEAR((double)w.weight[0], ratio, 2e-5 * ratio);
        furthest = fmax(furthest, fabs(ratio - 1.0));
    }
    TEST(furthest > 1e-4);
    walk_subject_free(d);
}

/* Radiance: the same walks, over the square of the index ratio where they end on the other side. */
static void test_radiance(void)
{
    vndf_description is = walk_of_glass(1.5f), radiance = is;
    unsigned long long state = 5;
    walk_hit h, r;
    radiance.effects.transport = VNDF_TRANSPORT_RADIANCE;
    walk_hit_at(&h, &is, vndf_beckmann(), 0.4f, 0.4f, walk_direction(0.6, 0.0));
    walk_hit_at(&r, &radiance, vndf_beckmann(), 0.4f, 0.4f, h.wi);
    for (int i = 0; i < 1000; i++) {
        float u[3];
        vndf_scattered w, v;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&h.bsdf, u, &w);
        vndf_bsdf_sample(&r.bsdf, u, &v);
        TEST(v.wo.x == w.wo.x && v.wo.y == w.wo.y && v.wo.z == w.wo.z && v.lobe == w.lobe);
        TEST_RELATIVE((double)v.weight[0], (double)w.weight[0] / (w.lobe == VNDF_LOBE_TRANSMISSION ? 2.25 : 1.0),
                      1e-6);
    }
}

int main(int arguments, char **argument)
{
    for (int i = 0; i < WALK_SUBJECTS; i++)
        if (arguments < 2 || atoi(argument[1]) == i)
            test_subject(i);
    test_orders();
    test_ratio();
    test_radiance();
    return test_done();
}
