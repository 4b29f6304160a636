/* A ray that starts at a hit never meets the surface it starts on: spheres of radius 1e-3 to 1e4, plates and
 * meshes at any angle, grazing ones included; and it does meet what is there: the far side of a sphere. */
#include <stdlib.h>

#include "render/render_case.h"

/* On the side of n: cosines from 1e-6 to 1, evenly in the logarithm. */
static vndf_vec3 leaving(unsigned long long *state, vndf_vec3 n, float side)
{
    const float c = powf(10.0f, between(state, -6.0f, 0.0f));
    const vndf_vec3 along = unit(cross(n, random_direction(state)));
    return add(scale(along, sqrtf(fmaxf(0.0f, 1.0f - c * c))), scale(n, side * c));
}

static void test_spheres_outside(void)
{
    unsigned long long state = 0x5E1F;
    int again = 0, met = 0;
    for (int i = 0; i < rays(4000); i++) {
        geometry g = {0};
        const float radius = powf(10.0f, between(&state, -3.0f, 4.0f));
        const sphere s = {point_in_box(&state, i % 2 ? 100.0f : 10.0f * radius), radius};
        TEST(geometry_add_sphere(&g, s, 0) && geometry_build(&g));
        for (int j = 0; j < 50; j++) {
            const float away = between(&state, 1.1f, 100.0f) * radius;
            const vndf_vec3 from = add(s.centre, scale(random_direction(&state), away));
            const vndf_vec3 at = add(s.centre, scale(random_direction(&state), radius));
            const ray r = ray_along(from, unit(subtract(at, from)));
            hit h;
            if (!geometry_hit(&g, &r, &h))
                continue;
            const ray next = ray_from(&h, leaving(&state, h.normal, 1.0f));
            met++;
            again += geometry_blocked(&g, &next);
        }
        geometry_free(&g);
    }
    TEST(met > rays(4000) * 20);
    TEST_NEAR(again, 0, 0);
}

/* Chords of a sphere from inside are as long as they should be. */
static void test_spheres_inside(void)
{
    unsigned long long state = 0x1151DE;
    int wrong = 0;
    for (int i = 0; i < rays(2000); i++) {
        geometry g = {0};
        const float radius = powf(10.0f, between(&state, -3.0f, 4.0f));
        const sphere s = {point_in_box(&state, 10.0f * radius), radius};
        TEST(geometry_add_sphere(&g, s, 0) && geometry_build(&g));
        ray r = ray_along(s.centre, random_direction(&state));
        for (int j = 0; j < 30; j++) { /* a light path that never leaves */
            hit h, far;
            if (!TEST(geometry_hit(&g, &r, &h)))
                break;
            const vndf_vec3 in = leaving(&state, h.normal, -1.0f);
            const double chord = -2.0 * (double)dot(in, h.normal) * (double)radius;
            r = ray_from(&h, in);
            const int is_met = geometry_hit(&g, &r, &far);
            const double of_offset = 2e-5 * (double)radius * (double)radius / chord;
            wrong += !is_met || fabs((double)far.distance - chord) > 1e-2 * chord + of_offset;
        }
        geometry_free(&g);
    }
    TEST_NEAR(wrong, 0, 0);
}

/* Rays to near `middle` from both sides of n, and from there on: returns how many meet anything. */
static int count_flat(const geometry *g, unsigned long long *state, vndf_vec3 n, vndf_vec3 middle, float size)
{
    int again = 0;
    for (int j = 0; j < 40; j++) {
        const vndf_vec3 from = add(middle, scale(n, j % 2 ? size : -size));
        const vndf_vec3 towards = add(scale(n, j % 2 ? -1.0f : 1.0f), point_in_box(state, 0.15f));
        const ray r = ray_along(from, unit(towards));
        hit h;
        if (!TEST(geometry_hit(g, &r, &h)))
            continue;
        const ray up = ray_from(&h, leaving(state, h.normal, 1.0f));
        const ray down = ray_from(&h, leaving(state, h.normal, -1.0f));
        again += geometry_blocked(g, &up) + geometry_blocked(g, &down);
    }
    return again;
}

static void test_plates(void)
{
    unsigned long long state = 0x91A7E;
    int again = 0;
    for (int i = 0; i < rays(4000); i++) {
        geometry g = {0};
        const float size = powf(10.0f, between(&state, -3.0f, 4.0f));
        const vndf_vec3 n = i % 4 == 0 ? vec(0.0f, 1.0f, 0.0f) : random_direction(&state);
        const vndf_vec3 u = unit(cross(n, random_direction(&state))), v = cross(n, u);
        const vndf_vec3 middle = i % 3 == 0 ? vec(0.0f, 0.0f, 0.0f) : point_in_box(&state, 100.0f);
        const vndf_vec3 corner = subtract(middle, scale(add(u, v), 0.5f * size));
        const rectangle r = {corner, scale(u, size), scale(v, size)};
        const vndf_vec3 top = add(corner, add(scale(v, 4.0f * size), scale(u, 0.5f * size)));
        const vndf_vec3 left = subtract(corner, scale(u, size)), right = add(corner, scale(u, 3.0f * size));
        const triangle t = bare_triangle(left, right, top);
        TEST((i % 2 ? geometry_add_rectangle(&g, r, 0) : geometry_add_triangle(&g, &t, 0)) && geometry_build(&g));
        again += count_flat(&g, &state, n, middle, size);
        geometry_free(&g);
    }
    TEST_NEAR(again, 0, 0);
}

/* A floor of many triangles in one plane: the neighbours are not met either. */
static void test_floor(void)
{
    enum { SIDE = 40 };
    static const float heights[] = {0.0f, -1.7f, 1234.5f};
    unsigned long long state = 0xF1002;
    int again = 0;
    for (int k = 0; k < 3; k++) {
        geometry g = {0};
        for (int i = 0; i < SIDE * SIDE; i++) {
            const float x = 100.0f * (float)(i % SIDE - SIDE / 2), z = 100.0f * (float)(i / SIDE - SIDE / 2);
            const float y = heights[k];
            const vndf_vec3 a = vec(x, y, z), b = vec(x + 100.0f, y, z), c = vec(x + 100.0f, y, z + 100.0f);
            const triangle one = bare_triangle(a, c, b), two = bare_triangle(a, vec(x, y, z + 100.0f), c);
            TEST(geometry_add_triangle(&g, &one, 0) && geometry_add_triangle(&g, &two, 0));
        }
        TEST(geometry_build(&g));
        for (int i = 0; i < rays(100); i++) {
            const vndf_vec3 middle = vec(between(&state, -900.0f, 900.0f), heights[k], 3.0f);
            again += count_flat(&g, &state, vec(0.0f, 1.0f, 0.0f), middle, 500.0f);
        }
        geometry_free(&g);
    }
    TEST_NEAR(again, 0, 0);
}

/* From inside a closed mesh, paths stay inside: no offset steps through the next triangle's plane and out. */
static void test_mesh_inside(void)
{
    geometry g = {0};
    unsigned long long state = 0x3E5;
    int left = 0;
    TEST(add_globe(&g, 16, 2.0f) && geometry_build(&g));
    for (int i = 0; i < rays(2000); i++) {
        ray r = ray_along(point_in_box(&state, 1.0f), random_direction(&state));
        for (int j = 0; j < 20; j++) {
            hit h;
            if (!geometry_hit(&g, &r, &h)) {
                left++;
                break;
            }
            const vndf_vec3 w = random_direction(&state);
            r = ray_from(&h, dot(w, h.normal) < 0.0f ? w : scale(w, -1.0f));
        }
    }
    TEST_NEAR(left, 0, 0);
    geometry_free(&g);
}

int main(void)
{
    test_spheres_outside();
    test_spheres_inside();
    test_plates();
    test_floor();
    test_mesh_inside();
    return test_done();
}
