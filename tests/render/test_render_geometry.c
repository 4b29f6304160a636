/* The nearest shape along a ray is that of all shapes one by one; a ray from a hit does not meet the same place
 * again, and no ray leaves a closed mesh between its triangles. Notices boxes that are too small, a walk that ends
 * too early or takes the farther child for the nearer, edges with gaps, and rays that start on the wrong side. */
#include "harness/test.h"
#include "render/geometry.h"

static vec3 place(unsigned long long *state, double half)
{
    const double x = test_uniform_double(state), y = test_uniform_double(state), z = test_uniform_double(state);
    return scale(vec(2 * x - 1, 2 * y - 1, 2 * z - 1), half);
}

static vec3 direction(unsigned long long *state)
{
    return unit(place(state, 1));
}

/* Small and large shapes about an origin; one at a time cannot be put in the wrong box. */
static void test_nearest(vec3 origin, double exactness)
{
    enum { SHAPES = 600, RAYS = 300 };
    unsigned long long state = 3;
    geometry g = {0};
    hit h;
    for (int i = 0; i < SHAPES; i++) {
        const double size = exp((i % 50 ? 3 : 5) * test_uniform_double(&state) - 4);
        shape s = {.kind = (shape_kind)(i % 3), .corner = along(origin, 1, place(&state, 2)), .radius = size};
        if (s.kind != SHAPE_SPHERE) {
            s.radius = 0;
            s.edge_u = scale(direction(&state), size);
            s.edge_v = scale(unit(cross(s.edge_u, direction(&state))), 2 * size * test_uniform_double(&state));
        }
        TEST(geometry_add(&g, &s));
    }
    TEST(geometry_build(&g));
    for (int i = 0; i < RAYS; i++) {
        const ray r = {along(origin, 1, place(&state, 3)), direction(&state), HUGE_VAL};
        ray before = r;
        double want = HUGE_VAL;
        for (int k = 0; k < SHAPES; k++) {
            geometry alone = {.shapes = &g.shapes[k], .count = 1};
            want = TEST(geometry_build(&alone)) && geometry_hit(&alone, &r, &h) ? fmin(want, h.distance) : want;
            free(alone.nodes);
        }
        before.to = want * (1 - 1e-9);
        TEST(!geometry_blocked(&g, &before) && geometry_blocked(&g, &r) == isfinite(want));
        if (!TEST(geometry_hit(&g, &r, &h) == isfinite(want)) || !isfinite(want))
            continue;
        TEST(h.distance == want && length(subtract(h.place, along(r.origin, want, r.direction))) < exactness);
        TEST(fabs(length(h.normal) - 1) < 1e-12 && fabs(dot(h.shading.x, h.shading.z)) < 1e-9);
    }
    geometry_free(&g);
}

/* From inside, at edges too; then on from what was met to both sides. */
static void test_closed(void)
{
    unsigned long long state = 8;
    geometry g = {0};
    char text[8192] = "";
    const size_t size =
        read_bytes(VNDF_SOURCE_DIR "/tools/scenes/gem.obj", (unsigned char *)text, sizeof text - 1);
    int left = 0, met_again = 0;
    if (!TEST(obj_read_text(&g, "gem.obj", text, size, 0) && geometry_build(&g)))
        return;
    for (int i = 0; i < 100000; i++) {
        const shape *s = &g.shapes[(size_t)i / 2 % g.count];
        const vec3 from = place(&state, 0.2), on = direction(&state);
        const vec3 edge = along(s->corner, test_uniform_double(&state), s->edge_u);
        const ray r = {from, i % 2 ? direction(&state) : unit(subtract(edge, from)), HUGE_VAL};
        hit h, next;
        if (!geometry_hit(&g, &r, &h))
            left++;
        else if (i % 2) { /* at an edge going in may mean going out of another side */
            const ray further = ray_from(&h, on);
            const int is_met = geometry_hit(&g, &further, &next); /* outside all of it is convex */
            met_again += dot(on, h.normal) < 0 ? !is_met || next.distance < 1e-9 : is_met;
        }
    }
    TEST(left == 0 && met_again == 0);
    geometry_free(&g);
}

int main(void)
{
    test_nearest(vec(0, 0, 0), 1e-13);
    test_nearest(vec(1e5, -1e5, 2e5), 1e-8);
    test_closed();
    return test_done();
}
