/* The hierarchy finds, for every ray, what a search through all shapes finds by formulas of its own: the nearest
 * shape, which hides all others and is hidden by none; and closed meshes have no leaks. */
#include "render/render_case.h"

/* ---- the slow truth ------------------------------------------------------------------------------ */

typedef struct point {
    double x, y, z;
} point;

static point point_of(vndf_vec3 v)
{
    const point p = {(double)v.x, (double)v.y, (double)v.z};
    return p;
}

static point minus(point a, point b)
{
    const point p = {a.x - b.x, a.y - b.y, a.z - b.z};
    return p;
}

static double inner(point a, point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static point outer(point a, point b)
{
    const point p = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return p;
}

/* Cramer's rule for  origin + t d = corner + a u + b v  (Moeller & Trumbore 1997); HUGE_VAL: no. */
static double flat_distance(point o, point d, point corner, point u, point v, double most)
{
    const point p = outer(d, v), s = minus(o, corner), q = outer(s, u);
    const double determinant = inner(u, p), a = inner(s, p) / determinant, b = inner(d, q) / determinant;
    const double t = inner(v, q) / determinant;
    const int is_met = a >= 0.0 && b >= 0.0 && (most > 1.0 ? a <= 1.0 && b <= 1.0 : a + b <= 1.0) && t > 0.0;
    return is_met ? t : HUGE_VAL;
}

static double sphere_distance(point o, point d, const sphere *s)
{
    const point c = minus(o, point_of(s->centre));
    const double a = inner(d, d), b = inner(c, d), r = (double)s->radius;
    const double root = b * b - a * (inner(c, c) - r * r);
    if (root < 0.0)
        return HUGE_VAL;
    const double near = (-b - sqrt(root)) / a, far = (-b + sqrt(root)) / a;
    return near > 0.0 ? near : far > 0.0 ? far : HUGE_VAL;
}

static double slow_distance(const geometry *g, const ray *r)
{
    const point o = point_of(r->origin), d = point_of(r->direction);
    double least = (double)r->to;
    for (size_t i = 0; i < g->sphere_count; i++)
        least = fmin(least, sphere_distance(o, d, &g->spheres[i]));
    for (size_t i = 0; i < g->rectangle_count; i++) {
        const rectangle *s = &g->rectangles[i];
        const point u = point_of(s->edge_u), v = point_of(s->edge_v);
        least = fmin(least, flat_distance(o, d, point_of(s->corner), u, v, 2.0));
    }
    for (size_t i = 0; i < g->triangle_count; i++) {
        const triangle *t = &g->triangles[i];
        const point a = point_of(t->corner[0]), u = minus(point_of(t->corner[1]), a);
        least = fmin(least, flat_distance(o, d, a, u, minus(point_of(t->corner[2]), a), 1.0));
    }
    return least;
}

/* ---- hierarchy ----------------------------------------------------------------------------------- */

static void compare_with_search(const geometry *g, unsigned long long *state, float spread, int count)
{
    int different = 0, blocked_different = 0, hidden_different = 0, met = 0;
    for (int i = 0; i < count; i++) {
        ray r = ray_along(point_in_box(state, spread), random_direction(state));
        if (i % 4 == 1) /* along an axis: infinite reciprocals */
            r.direction = i % 8 == 1 ? vec(0.0f, -1.0f, 0.0f) : vec(0.0f, 0.0f, 1.0f);
        if (i % 4 == 2)
            r.to = spread * test_uniform(state);
        hit h;
        const double want = slow_distance(g, &r);
        const int is_met = geometry_hit(g, &r, &h), should = want < (double)r.to;
        met += is_met;
        different += is_met != should || (is_met && fabs((double)h.distance - want) > 2e-7 * want);
        blocked_different += geometry_blocked(g, &r) != should;
        for (uint32_t k = 0; is_met && k < 3 && k < g->shape_count; k++) {
            const uint32_t at = (h.shape + k) % (uint32_t)g->shape_count;
            hidden_different += geometry_hides(g, &r, at) != (at != h.shape);
        }
    }
    TEST(met > count / 50);
    TEST_NEAR(different, 0, 0);
    TEST_NEAR(blocked_different, 0, 0);
    TEST_NEAR(hidden_different, 0, 0);
}

static void test_random_scenes(void)
{
    static const struct {
        int count;
        float spread, size;
    } cases[] = {
        {1, 1.0f, 2.0f},   {2, 1.0f, 1.0f},     {50, 1.0f, 0.3f}, {300, 1.0f, 0.1f},
        {200, 1e4f, 2e3f}, {200, 1e-3f, 2e-4f}, {60, 0.0f, 1.0f}}; /* the last: corners and centres all at one place */
    unsigned long long state = 0x5151;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        geometry g = {0};
        const float spread = cases[i].spread > 0.0f ? cases[i].spread : 1.0f;
        TEST(add_random(&g, &state, cases[i].count, cases[i].spread, cases[i].size) && geometry_build(&g));
        compare_with_search(&g, &state, 1.5f * spread, rays(20000));
        geometry_free(&g);
    }
}

/* No plane separates them, or there is nothing, or nothing finite. */
static void test_degenerate_scenes(void)
{
    geometry g = {0};
    const ray r = ray_along(vec(0.0f, 0.0f, 5.0f), vec(0.0f, 0.0f, -1.0f));
    const sphere s = {{0.0f, 0.0f, 0.0f}, 1.0f}, far = {{3e38f, 0.0f, 0.0f}, 1e38f};
    const sphere bad = {{NAN, 0.0f, 0.0f}, 1.0f};
    const ray nowhere = ray_along(vec(0.0f, 0.0f, 5.0f), vec(0.0f, 0.0f, 0.0f));
    const ray not_a_number = ray_along(vec(0.0f, NAN, 5.0f), vec(0.0f, 0.0f, -1.0f));
    hit h;
    TEST(!geometry_hit(&g, &r, &h) && geometry_build(&g));
    TEST(!geometry_hit(&g, &r, &h) && !geometry_blocked(&g, &r));
    TEST(geometry_add_sphere(&g, bad, 0) && geometry_add_sphere(&g, far, 0) && geometry_build(&g));
    TEST(!geometry_hit(&g, &r, &h));
    for (int i = 0; i < 5000; i++)
        TEST(geometry_add_sphere(&g, s, i));
    TEST(geometry_build(&g) && geometry_build(&g) && geometry_hit(&g, &r, &h));
    TEST_NEAR((double)h.distance, 4.0, 0.0);
    TEST(!geometry_hit(&g, &nowhere, &h) && !geometry_hit(&g, &not_a_number, &h));
    geometry_free(&g);
    for (int i = 0; i < 120; i++) { /* as uneven as float allows: planes split off a few at a time */
        const sphere small = {{ldexpf(1.0f, i - 60), 0.0f, 0.0f}, ldexpf(0.1f, i - 60)};
        TEST(geometry_add_sphere(&g, small, i));
    }
    TEST(geometry_build(&g));
    for (int i = 0; i < 120; i++) {
        const ray down = ray_along(vec(ldexpf(1.0f, i - 60), ldexpf(1.0f, i - 60), 0.0f), vec(0.0f, -1.0f, 0.0f));
        TEST(geometry_hit(&g, &down, &h) && h.material == i);
    }
    geometry_free(&g);
}

static void test_closed_mesh(void)
{
    enum { ROWS = 24 };
    geometry g = {0};
    unsigned long long state = 0xC105ED;
    int leaks = 0;
    TEST(add_globe(&g, ROWS, 3.0f) && geometry_build(&g));
    for (int i = 0; i < rays(100000); i++) {
        const ray r = ray_along(point_in_box(&state, 1.5f), random_direction(&state));
        hit h;
        leaks += !geometry_hit(&g, &r, &h) || !geometry_blocked(&g, &r);
    }
    for (int i = 0; i < rays(100000); i++) { /* at corners, and along edges */
        const int row = i % ROWS, column = (int)between(&state, 0.0f, 2.0f * ROWS - 0.01f);
        const vndf_vec3 a = globe_corner(ROWS, row, column, 3.0f);
        const vndf_vec3 b = globe_corner(ROWS, row + 1, column + i % 2, 3.0f);
        const vndf_vec3 from = i % 4 == 0 ? vec(0.0f, 0.0f, 0.0f) : point_in_box(&state, 1.5f);
        const vndf_vec3 at = i % 3 == 0 ? a : add(a, scale(subtract(b, a), test_uniform(&state)));
        const ray r = ray_along(from, unit(subtract(at, from)));
        hit h;
        leaks += !geometry_hit(&g, &r, &h);
    }
    TEST_NEAR(leaks, 0, 0);
    geometry_free(&g);
}

int main(void)
{
    test_random_scenes();
    test_degenerate_scenes();
    test_closed_mesh();
    return test_done();
}
