/* The nearest shape along a ray is that of all shapes one by one; a ray from a hit does not meet the same place again,
 * and no ray leaves a closed mesh between its triangles. Notices boxes that are too small, a walk that ends too early
 * or takes the farther child for the nearer, edges with gaps, and rays that start on the wrong side. */
#include "harness/test.h"
#include "render/geometry.h"

enum { SHAPES = 600 };

static double between(unsigned long long *state, double low, double high)
{
    return low + (high - low) * test_uniform_double(state);
}

static vec3 direction(unsigned long long *state)
{
    const double z = between(state, -1, 1), turn = between(state, 0, 2 * PI), r = sqrt(1 - z * z);
    return vec(r * cos(turn), r * sin(turn), z);
}

static vec3 place(unsigned long long *state, double half)
{
    const double x = between(state, -half, half), y = between(state, -half, half);
    return vec(x, y, between(state, -half, half));
}

/* Small and large shapes about an origin; one at a time cannot be put in the wrong box. */
static void test_nearest(vec3 origin, double exactness)
{
    static geometry alone[SHAPES];
    unsigned long long state = 3;
    geometry g = {0};
    int good = 1;
    for (int i = 0; i < SHAPES; i++) {
        const double size = exp(between(&state, -4, i % 50 ? -1 : 1));
        shape s = {
            .kind = (shape_kind)(i % 3), .corner = add(origin, place(&state, 2)), .radius = i % 3 ? 0 : size};
        s.edge_u = i % 3 ? scale(direction(&state), size) : s.edge_u;
        s.edge_v =
            i % 3 ? scale(unit(cross(s.edge_u, direction(&state))), between(&state, 0.1, 2) * size) : s.edge_v;
        good &= geometry_add(&g, &s) && geometry_add(&alone[i], &s) && geometry_build(&alone[i]);
    }
    TEST(good && geometry_build(&g));
    for (int i = 0; i < 300; i++) {
        const ray r = {add(origin, place(&state, 3)), direction(&state), HUGE_VAL};
        double want = HUGE_VAL;
        hit h;
        for (int k = 0; k < SHAPES; k++)
            want = geometry_hit(&alone[k], &r, &h) ? fmin(want, h.distance) : want;
        if (!geometry_hit(&g, &r, &h)) {
            TEST(!isfinite(want) && !geometry_blocked(&g, &r));
            continue;
        }
        const ray before = {r.origin, r.direction, h.distance * (1 - 1e-9)};
        const ray behind = {r.origin, r.direction, h.distance * (1 + 1e-9)};
        TEST(h.distance == want && !geometry_blocked(&g, &before) && geometry_blocked(&g, &behind));
        TEST(length(subtract(h.place, along(r.origin, h.distance, r.direction))) < exactness);
        TEST(fabs(length(h.normal) - 1) < 1e-12 && fabs(dot(h.shading.x, h.shading.z)) < 1e-9);
    }
    for (int k = 0; k < SHAPES; k++)
        geometry_free(&alone[k]);
    geometry_free(&g);
}

/* From inside, at edges too; then on from what was met to both sides. */
static void test_closed(void)
{
    unsigned long long state = 8;
    geometry g = {0};
    vndf_error error;
    char text[8192] = "";
    const size_t size =
        read_bytes(VNDF_SOURCE_DIR "/tools/scenes/gem.obj", (unsigned char *)text, sizeof text - 1);
    int left = 0, met_again = 0;
    if (!TEST(obj_read_text(&g, "gem.obj", text, size, 0, &error) && geometry_build(&g)))
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
