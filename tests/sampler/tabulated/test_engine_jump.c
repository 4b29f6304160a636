/* Where rounding may bring a normal over a border at which the density changes, the density that comes with a
 * sample is still that of the normal that comes with it, within 1e-5. Such borders are jumps of D: uniform
 * numbers are sought, by bisection of u2, whose normals lie beside the jump, and their neighbours within 128
 * steps of float are tried; there are some on both sides of the jump. The cell before it may be so narrow that
 * a rounding goes through a part of it. Knots of the table where D does not jump, since rounding of a sum may be
 * a large part of a cell in the tail. And the side of wi, where azimuths of the front end and those of the
 * wedge begin: u1 is sought likewise, and slopes are large as well, for which a rounding of the azimuth shows
 * in wi.wm. */
#include "oracle/oracle.h"
#include "table/layout.h"
#include "harness/test.h"

enum { NEIGHBOURS = 16 };

static double slope_at(const vndf_surface *surface, const vndf_view *view, float u1, float u2, double *error)
{
    float density;
    vndf_vec3 wm = vndf_sample(view, u1, u2, &density);
    *error = fabs(vndf_pdf(view, wm) / (double)density - 1);
    return hypot(wm.x / (double)surface->alpha_x, wm.y / (double)surface->alpha_y) / wm.z;
}

/* Slopes grow with u2. */
static float number_at_jump(const vndf_surface *surface, const vndf_view *view, float u1, double jump)
{
    float low = 0, high = 1;
    double error;
    while (nextafterf(low, high) < high) {
        float middle = low + (high - low) / 2;
        if (slope_at(surface, view, u1, middle, &error) < jump)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* What was tried, and on which side of the border it came. */
typedef struct tried {
    double worst;
    int inside, outside;
} tried;

static void try_azimuth(const vndf_surface *surface, const vndf_view *view, float u1, double jump, double rest,
                        tried *t)
{
    float at = number_at_jump(surface, view, u1, jump);
    if (at < rest || at > 1 - rest) /* the jump cannot be seen */
        return;
    for (int i = -NEIGHBOURS; i < NEIGHBOURS; i++)
        for (int stride = 1; stride <= 8; stride += 7) {
            double error, slope = slope_at(surface, view, u1, at + (float)(i * stride) * 0x1p-24f, &error);
            t->inside += slope < jump;
            t->outside += slope >= jump;
            t->worst = fmax(t->worst, error);
        }
}

/* Of wi and the normal for u1: its sign tells front from wedge. */
static double toward(const vndf_view *view, float u1)
{
    vndf_vec3 wm = vndf_sample(view, u1, 0.5f, NULL);
    return (double)view->wi.x * wm.x + (double)view->wi.y * wm.y;
}

static void try_side(const vndf_surface *surface, const vndf_view *view, unsigned long long *state, tried *t)
{
    float low = 0.5f, high = 1, u2 = (float)(1 - pow(10, -4 * test_uniform_double(state)));
    while (nextafterf(low, high) < high) {
        float middle = low + (high - low) / 2;
        if (toward(view, middle) > 0)
            low = middle;
        else
            high = middle;
    }
    for (int i = -NEIGHBOURS; i < NEIGHBOURS; i++) {
        double far = 0.005 * (test_uniform_double(state) - 0.5), error;
        float number[2] = {high + (float)i * 0x1p-24f, high + (float)far};
        for (int n = 0; n < 2; n++) {
            slope_at(surface, view, number[n], u2, &error);
            t->inside += number[n] < high;
            t->outside += number[n] >= high;
            t->worst = fmax(t->worst, error);
        }
    }
}

static void test_view(const vndf_surface *surface, vndf_vec3 wi, double jump, unsigned long long *state)
{
    vndf_view view = vndf_view_from(surface, wi);
    tried t = {0, 0, 0};
    for (int i = 0; i < (test_quick() ? 100 : 1000); i++)
        if (jump > 0)
            try_azimuth(surface, &view, test_uniform(state), jump, 0.01, &t);
        else
            try_side(surface, &view, state, &t);
    if (!(TEST(t.worst <= 1e-5) & TEST(t.inside > 100) & TEST(t.outside > 100)))
        fprintf(stderr, "  %s, alpha %g %g, wi %g %g %g: worst %.3g, %d inside, %d outside\n",
                vndf_distribution_info(surface->distribution).source, (double)surface->alpha_x,
                (double)surface->alpha_y, (double)wi.x, (double)wi.y, (double)wi.z, t.worst, t.inside, t.outside);
}

static void test_knots(const char *p22)
{
    unsigned long long state = 43;
    tried t = {0, 0, 0};
    vndf_distribution *table = oracle_build_of(p22, 65536, NULL, NULL);
    for (int i = 0; TEST(table != NULL) && i < (test_quick() ? 1000 : 5000); i++) {
        double z = 0.2 + 0.8 * test_uniform_double(&state);
        double knot = table->radial_count * test_uniform_double(&state);
        vndf_surface surface = {table, 0.5f, 0.5f};
        vndf_vec3 wi = {(float)sqrt(1 - z * z), 0, (float)z};
        vndf_view view = vndf_view_from(&surface, wi);
        try_azimuth(&surface, &view, test_uniform(&state), vndf_knot_slope(table, (uint32_t)knot) * table->scale,
                    1.1e-4, &t);
    }
    if (!(TEST(t.worst <= 1e-5) & TEST(t.inside > 1000) & TEST(t.outside > 1000)))
        fprintf(stderr, "  %s: beside knots worst %.3g, %d inside, %d outside\n", p22, t.worst, t.inside,
                t.outside);
    vndf_free(table);
}

/* `jump` is 0 for the side of wi, which is no border straight up. */
static void test_source(const char *p22, size_t bytes, double jump)
{
    static const float alphas[][2] = {{1, 1}, {0.05f, 0.4f}};
    static const vndf_vec3 directions[] = {{0, 0, 1}, {0.5f, 0, 0.8660254f}, {-0.64f, 0.48f, 0.6f}};
    unsigned long long state = 41;
    vndf_distribution *table = oracle_build_of(p22, bytes, NULL, NULL);
    for (int i = 0; TEST(table != NULL) && i < 6; i++) {
        vndf_surface surface = {table, alphas[i / 3][0], alphas[i / 3][1]};
        if (jump > 0 || i % 3 > 0)
            test_view(&surface, directions[i % 3], jump, &state);
    }
    vndf_free(table);
}

int main(void)
{
    test_knots("(1+r*r)^-2.5");
    test_source("exp(-r)*(1+step(r-1))", 0, 1);
    test_source("exp(-r)*(1-0.85*step(r-0.8))", 65536, 0.8);
    test_source("1/cosh(1.7*r)^2", 0, 0);
    test_source("(1+4*r^2)^-1.65", 2048, 0);
    return test_done();
}
