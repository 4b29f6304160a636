/* At a jump of D, where rounding may bring a normal to the other side, the density that comes with a sample is
 * still that of the normal that comes with it, within 1e-5. Uniform numbers are sought, by bisection of u2, whose
 * normals lie beside the jump, and their neighbours within 16 steps of float are tried; there are some on both
 * sides of the jump, whose two densities differ by a factor of 2. */
#include "oracle.h"
#include "test.h"

static const double JUMP = 1;
enum { NEIGHBOURS = 16 };

static double slope_at(const vndf_surface *surface, const vndf_view *view, float u1, float u2, double *error)
{
    float density;
    vndf_vec3 wm = vndf_sample(view, u1, u2, &density);
    *error = fabs(vndf_pdf(view, wm) / (double)density - 1);
    return hypot(wm.x / (double)surface->alpha_x, wm.y / (double)surface->alpha_y) / wm.z;
}

/* Slopes grow with u2. */
static float number_at_jump(const vndf_surface *surface, const vndf_view *view, float u1)
{
    float low = 0, high = 1;
    double error;
    while (nextafterf(low, high) < high) {
        float middle = low + (high - low) / 2;
        if (slope_at(surface, view, u1, middle, &error) < JUMP)
            low = middle;
        else
            high = middle;
    }
    return high;
}

static double test_azimuth(const vndf_surface *surface, const vndf_view *view, float u1, int *inside, int *outside)
{
    float u2 = number_at_jump(surface, view, u1);
    double worst = 0, error;
    if (u2 < 0.01f || u2 > 0.99f) /* the jump cannot be seen */
        return 0;
    for (int i = 0; i < NEIGHBOURS; i++)
        u2 = nextafterf(u2, 0);
    for (int i = 0; i < 2 * NEIGHBOURS; i++) {
        double slope = slope_at(surface, view, u1, u2, &error);
        *inside += slope < JUMP;
        *outside += slope >= JUMP;
        worst = fmax(worst, error);
        u2 = nextafterf(u2, 1);
    }
    return worst;
}

static void test_view(const vndf_surface *surface, vndf_vec3 wi, unsigned long long *state)
{
    vndf_view view = vndf_view_from(surface, wi);
    int inside = 0, outside = 0;
    double worst = 0;
    for (int i = 0; i < (oracle_quick() ? 100 : 1000); i++)
        worst = fmax(worst, test_azimuth(surface, &view, test_uniform(state), &inside, &outside));
    if (!(TEST(worst <= 1e-5) & TEST(inside > 100) & TEST(outside > 100)))
        fprintf(stderr, "  alpha %g %g, wi %g %g %g: worst %.3g, %d inside, %d outside\n",
                (double)surface->alpha_x, (double)surface->alpha_y, (double)wi.x, (double)wi.y, (double)wi.z, worst,
                inside, outside);
}

int main(void)
{
    static const float alphas[][2] = {{1, 1}, {0.05f, 0.4f}};
    static const vndf_vec3 directions[] = {{0, 0, 1}, {0.5f, 0, 0.8660254f}, {-0.64f, 0.48f, 0.6f}};
    unsigned long long state = 41;
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_slope_expression("exp(-r)*(1+step(r-1))", NULL, 0, &error);
    vndf_distribution *table = source ? vndf_build(source, NULL, NULL, &error) : NULL;
    for (int i = 0; TEST(table != NULL) && i < 6; i++) {
        vndf_surface surface = {table, alphas[i / 3][0], alphas[i / 3][1]};
        test_view(&surface, directions[i % 3], &state);
    }
    vndf_free(table);
    vndf_source_free(source);
    return test_done();
}
