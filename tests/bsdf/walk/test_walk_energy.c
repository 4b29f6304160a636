/* A lossless walk loses nothing: each sample that leaves has weight 1 (closed forms: to the bit; tables, whose
 * weight holds the ratio of true to drawn density: in the mean), and the order limit of 64 loses less than 1e-3
 * of any; directions are unit and on the side that the lobe says; reflectances multiply, once
 * for each event. Means at 4.5 sigmas, 7e-6 each, of 17 x 5 x 6 x 4. */
#include "bsdf/walk/walk_case.h"

static const float ALPHAS[][2] = {{0.05f, 0.05f}, {0.3f, 0.3f}, {1, 1}, {0.1f, 1}, {1e-3f, 1e-3f}};
static const double COSINES[] = {1, 0.8660254, 0.5, 0.1736482, 1e-3, 1e-6};
enum { ALPHA_COUNT = 5, COSINE_COUNT = 6, SAMPLES = 20000 };

static void check_sample(const vndf_walked *w, int closed)
{
    double length2 = (double)w->wo.x * w->wo.x + (double)w->wo.y * w->wo.y + (double)w->wo.z * w->wo.z;
    TEST_NEAR(length2, 1.0, 1e-6);
    if (w->lobe == VNDF_LOBE_NONE)
        TEST(w->weight[0] == 0.0f && w->weight[1] == 0.0f && w->weight[2] == 0.0f);
    else if (closed)
        TEST(w->weight[0] == 1.0f && w->weight[1] == 1.0f && w->weight[2] == 1.0f);
    TEST(w->lobe == VNDF_LOBE_NONE || (w->order >= 1 && w->order <= 64));
    TEST(w->lobe == VNDF_LOBE_NONE || (w->lobe == VNDF_LOBE_REFLECTION) == (w->wo.z > 0.0f));
}

/* Mean weight of what left, and how much was lost. */
static void test_view(const vndf_walk *walk, const vndf_view *view, const char *name, double most_lost)
{
    size_t count = walk_count(SAMPLES);
    int closed = view->distribution == vndf_ggx() || view->distribution == vndf_beckmann();
    unsigned long long state = 20160724;
    walk_mean weight = {0, 0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        float u[3];
        vndf_walked w;
        walk_numbers(&state, u);
        vndf_walk_sample(walk, view, u, &w);
        check_sample(&w, closed);
        weight.count += w.lobe != VNDF_LOBE_NONE;
        walk_add(&weight, w.weight[0]);
    }
    double lost = 1.0 - weight.count / (double)count, noise = 4.5 * sqrt(most_lost / (double)count);
    /* 2e-5: the density of a sample and the area are within 1e-5 of what they stand for */
    int good = TEST_NEAR(walk_value(&weight), 1.0, 4.5 * sqrt(walk_variance(&weight)) + 2e-5) &
               TEST(lost <= most_lost + noise);
    if (!good)
        fprintf(stderr, "  %s, alpha %g %g, cos %g, eta %g: lost %g\n", name, view->alpha_x, view->alpha_y,
                (double)view->wi.z, walk->transmits ? (double)walk->eta : 0.0, lost);
}

static void test_subject(int subject)
{
    const vndf_distribution *d = walk_subject(subject);
    vndf_walk walks[] = {walk_of_mirror(), walk_of_glass(1.5f), walk_of_glass(1.0f / 1.5f), walk_of_glass(2.4f)};
    for (size_t i = 0; d && i < ALPHA_COUNT; i++)
        for (size_t j = 0; j < COSINE_COUNT; j++)
            for (size_t k = 0; k < sizeof walks / sizeof *walks; k++) {
                vndf_view view = walk_view(d, ALPHAS[i][0], ALPHAS[i][1], COSINES[j], 0.4);
                test_view(&walks[k], &view, walk_subject_name(subject), 1e-3);
            }
    walk_subject_free(d);
}

/* Reflectances of (0.95, 0.6, 0.25): their powers by the order. A limit cuts the same walk short. */
static void test_orders(void)
{
    vndf_walk walk = {walk_constant, &walk_gold, 3, 1.0f, 0, VNDF_TRANSPORT_RADIANCE, 64}, shorter = walk;
    vndf_view view = walk_view(vndf_ggx(), 1.0f, 1.0f, 0.7, 0.0);
    unsigned long long state = 4;
    shorter.order_limit = 3;
    for (int i = 0; i < 3000; i++) {
        float u[3];
        vndf_walked w, v;
        walk_numbers(&state, u);
        vndf_walk_sample(&walk, &view, u, &w);
        vndf_walk_sample(&shorter, &view, u, &v);
        for (int j = 0; j < 3; j++)
            TEST_RELATIVE(w.weight[j], pow((double)walk_gold.f0[j], w.order), 1e-6);
        TEST(w.order <= 3 ? v.order == w.order && v.wo.z == w.wo.z : v.lobe == VNDF_LOBE_NONE);
    }
}

/* The weight after one event is what the table lacks to the true D at the normal it drew. */
static void test_ratio(void)
{
    const vndf_distribution *d = walk_subject(7);
    vndf_walk walk = walk_of_mirror();
    vndf_view view = walk_view(d, 1.0f, 0.6f, 0.4, 0.3);
    unsigned long long state = 6;
    double furthest = 0.0;
    for (int i = 0; i < 5000; i++) {
        float u[3];
        vndf_walked w;
        walk_numbers(&state, u);
        vndf_walk_sample(&walk, &view, u, &w);
        vndf_vec3 wm = vndf_sample(&view, u[0], u[1], NULL);
        double ratio = (double)vndf_visible(&view, wm) / (double)vndf_pdf(&view, wm);
        if (w.order == 1)
            TEST_NEAR(w.weight[0], ratio, 2e-5 * ratio);
        furthest = fmax(furthest, fabs(ratio - 1.0));
    }
    TEST(furthest > 0.01);
    walk_subject_free(d);
}

/* Radiance: the same walks, over the square of the index ratio where they end on the other side. */
static void test_radiance(void)
{
    vndf_walk walk = walk_of_glass(1.5f), radiance = walk;
    vndf_view view = walk_view(vndf_beckmann(), 0.4f, 0.4f, 0.6, 0.0);
    unsigned long long state = 5;
    radiance.transport = VNDF_TRANSPORT_RADIANCE;
    for (int i = 0; i < 1000; i++) {
        float u[3];
        vndf_walked w, r;
        walk_numbers(&state, u);
        vndf_walk_sample(&walk, &view, u, &w);
        vndf_walk_sample(&radiance, &view, u, &r);
        TEST(r.wo.x == w.wo.x && r.wo.y == w.wo.y && r.wo.z == w.wo.z && r.lobe == w.lobe);
        TEST_RELATIVE(r.weight[1], w.lobe == VNDF_LOBE_TRANSMISSION ? w.weight[1] / 2.25 : w.weight[1], 1e-6);
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
