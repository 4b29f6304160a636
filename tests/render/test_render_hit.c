/* What a hit says of its place is true: u and v, frames, normals, for shapes of each kind. */
#include "harness/constants.h"
#include "render/render_case.h"

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
        const vndf_vec3 n =
            vec((float)(sin(theta) * sin(longitude)), (float)cos(theta), (float)(sin(theta) * cos(longitude)));
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
        const triangle t = {{a, b, c},
                            {{0.0f, 0.0f, 0.0f}},
                            {0.1f, test_uniform(&state), test_uniform(&state)},
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
    test_frames();
    test_sphere_coordinates();
    test_box();
    test_triangle_tangent();
    return test_done();
}
