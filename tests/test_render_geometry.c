/* The hierarchy finds, for every ray, what a search through all shapes finds by formulas of its own; closed meshes
 * have no leaks; and what a hit says of its place is true: u and v, frames, normals. */
#include <stdlib.h>

#include "render_case.h"

#define PI 3.14159265358979323846

static int rays(int most)
{
    return getenv("VNDF_TEST_QUICK") ? most / 10 : most;
}

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

/* `spread`: of places; `size`: of shapes. */
static int add_random(geometry *g, unsigned long long *state, int count, float spread, float size)
{
    int is_added = 1;
    for (int i = 0; i < count; i++) {
        const vndf_vec3 at = point_in_box(state, spread), u = scale(random_direction(state), size);
        const vndf_vec3 across = scale(unit(cross(u, random_direction(state))), between(state, 0.2f, 2.0f) * size);
        const sphere s = {at, between(state, 0.1f, 1.0f) * size};
        const rectangle r = {at, u, across};
        const triangle t = bare_triangle(at, add(at, u), add(at, across));
        is_added &= i % 3 == 0   ? geometry_add_sphere(g, s, i)
                    : i % 3 == 1 ? geometry_add_rectangle(g, r, i)
                                 : geometry_add_triangle(g, &t, i);
    }
    return is_added;
}

static void compare_with_search(const geometry *g, unsigned long long *state, float spread, int count)
{
    int different = 0, blocked_different = 0, met = 0;
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
    }
    TEST(met > count / 50);
    TEST_NEAR(different, 0, 0);
    TEST_NEAR(blocked_different, 0, 0);
}

static void test_random_scenes(void)
{
    static const struct {
        int count;
        float spread, size;
    } cases[] = {{1, 1.0f, 2.0f}, {2, 1.0f, 1.0f}, {50, 1.0f, 0.3f}, {300, 1.0f, 0.1f}, {200, 1e4f, 2e3f},
                 {200, 1e-3f, 2e-4f}, {60, 0.0f, 1.0f}}; /* the last: corners and centres all at one place */
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

/* ---- what a hit says ----------------------------------------------------------------------------- */

static void check_frame(const hit *h)
{
    const frame *f = &h->shading;
    const double e = 5e-7;
    TEST_NEAR((double)dot(f->x, f->x), 1.0, e);
    TEST_NEAR((double)dot(f->y, f->y), 1.0, e);
    TEST_NEAR((double)dot(f->z, f->z), 1.0, e);
    TEST_NEAR((double)dot(f->x, f->y), 0.0, e);
    TEST_NEAR((double)dot(f->y, f->z), 0.0, e);
    TEST_NEAR((double)dot(f->z, f->x), 0.0, e);
    TEST_NEAR((double)dot(cross(f->x, f->y), f->z), 1.0, e);
    TEST(dot(f->z, h->normal) > 0.0f);
}

static void test_frames(void)
{
    geometry g = {0};
    unsigned long long state = 0xF7A3E;
    TEST(add_random(&g, &state, 90, 1.0f, 0.5f) && geometry_build(&g));
    for (int i = 0; i < rays(20000); i++) {
        const ray r = ray_along(point_in_box(&state, 2.0f), random_direction(&state));
        hit h;
        if (!geometry_hit(&g, &r, &h))
            continue;
        const vndf_vec3 off = subtract(h.place, add(r.origin, scale(r.direction, h.distance)));
        check_frame(&h);
        TEST_NEAR((double)dot(off, off), 0.0, 1e-11);
        TEST(h.material == (int)h.shape);
    }
    geometry_free(&g);
}

static void test_sphere_coordinates(void)
{
    geometry g = {0};
    unsigned long long state = 0x0B;
    const sphere s = {{1.0f, -2.0f, 3.0f}, 0.5f};
    TEST(geometry_add_sphere(&g, s, 7) && geometry_build(&g));
    for (int i = 0; i < 3000; i++) {
        const double longitude = 2.0 * PI * test_uniform_double(&state);
        const double theta = 0.01 + 3.12 * test_uniform_double(&state);
        const vndf_vec3 n = vec((float)(sin(theta) * sin(longitude)), (float)cos(theta),
                                (float)(sin(theta) * cos(longitude)));
        const ray r = ray_along(add(s.centre, scale(n, 2.0f)), scale(n, -1.0f));
        hit h;
        if (!TEST(geometry_hit(&g, &r, &h)))
            continue;
        const double round_trip = fabs((double)h.u - longitude / (2.0 * PI));
        TEST_NEAR(fmin(round_trip, 1.0 - round_trip) * sin(theta), 0.0, 1e-6);
        TEST_NEAR((double)h.v, theta / PI, 1e-6);
        TEST_NEAR((double)h.shading.x.x, cos(longitude), 1e-6 / sin(theta));
        TEST_NEAR((double)h.shading.x.z, -sin(longitude), 1e-6 / sin(theta));
        TEST(dot(h.normal, n) > 0.999999f && h.u < 1.0f && h.v < 1.0f && h.material == 7);
    }
    const ray pole = ray_along(vec(1.0f, 5.0f, 3.0f), vec(0.0f, -1.0f, 0.0f));
    hit h;
    TEST(geometry_hit(&g, &pole, &h));
    check_frame(&h);
    geometry_free(&g);
}

/* All six sides face outwards; u and v run along the edges. */
static void test_box(void)
{
    geometry g = {0};
    const vndf_vec3 low = vec(-1.0f, -2.0f, -3.0f), high = vec(2.0f, 1.0f, 4.0f);
    unsigned long long state = 0xB0;
    TEST(geometry_add_box(&g, low, high, 1) && geometry_build(&g) && g.rectangle_count == 6);
    for (int i = 0; i < 20000; i++) {
        const ray out = ray_along(point_in_box(&state, 0.9f), random_direction(&state));
        hit h;
        if (!TEST(geometry_hit(&g, &out, &h)))
            continue;
        const rectangle *side = &g.rectangles[g.shapes[h.shape].at];
        const vndf_vec3 at = add(side->corner, add(scale(side->edge_u, h.u), scale(side->edge_v, 1.0f - h.v)));
        TEST(dot(h.normal, out.direction) > 0.0f && dot(h.shading.x, side->edge_u) > 0.0f);
        TEST_NEAR((double)dot(subtract(at, h.place), subtract(at, h.place)), 0.0, 1e-11);
    }
    for (int i = 0; i < 1000; i++) { /* through edges, from outside */
        const vndf_vec3 edge = vec(high.x, high.y, between(&state, low.z, high.z)), from = vec(9.0f, 8.0f, 7.0f);
        const vndf_vec3 inside = scale(point_in_box(&state, 0.1f), 1e-5f);
        const ray r = ray_along(from, unit(subtract(subtract(edge, vec(1e-5f, 1e-5f, 0.0f)), add(from, inside))));
        TEST(geometry_blocked(&g, &r));
    }
    geometry_free(&g);
}

/* A step along x from a hit increases u and leaves v, on any triangle with texture coordinates. */
static void test_triangle_tangent(void)
{
    unsigned long long state = 0x7A6;
    for (int i = 0; i < 2000; i++) {
        geometry g = {0};
        const vndf_vec3 a = point_in_box(&state, 1.0f), b = add(a, random_direction(&state));
        const vndf_vec3 c = add(a, random_direction(&state)), n = cross(subtract(b, a), subtract(c, a));
        const triangle t = {{a, b, c}, {{0.0f, 0.0f, 0.0f}}, {0.1f, test_uniform(&state), test_uniform(&state)},
                            {0.7f, test_uniform(&state), test_uniform(&state)}};
        const float area = (t.u[1] - t.u[0]) * (t.v[2] - t.v[0]) - (t.u[2] - t.u[0]) * (t.v[1] - t.v[0]);
        if (dot(n, n) < 0.1f || fabsf(area) < 0.05f)
            continue;
        const vndf_vec3 middle = scale(add(a, add(b, c)), 1.0f / 3.0f), down = scale(unit(n), -1.0f);
        const ray one = ray_along(subtract(middle, down), down);
        hit h, next;
        TEST(geometry_add_triangle(&g, &t, 0) && geometry_build(&g) && geometry_hit(&g, &one, &h));
        const ray other = ray_along(add(one.origin, scale(h.shading.x, 0.02f)), down);
        TEST(geometry_hit(&g, &other, &next));
        TEST(next.u > h.u + 1e-4f);
        TEST_NEAR((double)next.v, (double)h.v, 2e-6 / (double)fabsf(area));
        TEST(dot(h.normal, unit(n)) > 0.999999f);
        geometry_free(&g);
    }
}

int main(void)
{
    test_random_scenes();
    test_degenerate_scenes();
    test_closed_mesh();
    test_frames();
    test_sphere_coordinates();
    test_box();
    test_triangle_tangent();
    return test_done();
}
