/* The nearest shape along a ray is that of all shapes one by one; a ray from a hit does not meet the same place
 * again, and no ray leaves a closed mesh between its triangles. Notices boxes that
 * are too small, a walk that ends too early or takes the farther child for the nearer, edges with gaps, and rays
 * that start on the wrong side. */
#include "harness/test.h"
#include "render/geometry.h"

enum { SHAPES = 600, ROWS = 24 };

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

/* Small, large and far from the origin. */
static int add_shapes(geometry *g, unsigned long long *state, vec3 origin)
{
    int good = 1;
    for (int i = 0; i < SHAPES; i++) {
        const double size = exp(between(state, -4, i % 50 ? -1 : 1));
        shape s = {
            .kind = (shape_kind)(i % 3), .corner = add(origin, place(state, 2)), .radius = i % 3 ? 0 : size};
        if (i % 3) {
            s.edge_u = scale(direction(state), size);
            s.edge_v = scale(unit(cross(s.edge_u, direction(state))), between(state, 0.1, 2) * size);
        }
        good &= geometry_add(g, &s);
    }
    return good;
}

/* With one shape at a time, which a hierarchy cannot get wrong. */
static double nearest_of_all(const geometry *g, const ray *r)
{
    double nearest = HUGE_VAL;
    for (size_t i = 0; i < g->count; i++) {
        geometry one = {0};
        hit h;
        if (geometry_add(&one, &g->shapes[i]) && geometry_build(&one) && geometry_hit(&one, r, &h))
            nearest = fmin(nearest, h.distance);
        geometry_free(&one);
    }
    return nearest;
}

static void test_nearest(vec3 origin, double exactness)
{
    unsigned long long state = 3;
    geometry g = {0};
    if (!TEST(add_shapes(&g, &state, origin) && geometry_build(&g)))
        return;
    for (int i = 0; i < 300; i++) {
        const ray r = {add(origin, place(&state, 3)), direction(&state), HUGE_VAL};
        const double want = nearest_of_all(&g, &r);
        hit h;
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
    geometry_free(&g);
}

/* A corner of a globe about the origin. */
static vec3 globe(int row, int column)
{
    const double theta = PI * row / ROWS, phi = PI * (column % (2 * ROWS)) / ROWS;
    const double s = row % ROWS ? sin(theta) : 0;
    return vec(s * sin(phi), cos(theta), s * cos(phi));
}

static int add_triangle(geometry *g, vec3 a, vec3 b, vec3 c)
{
    const shape s = {.kind = SHAPE_TRIANGLE, .corner = a, .edge_u = subtract(b, a), .edge_v = subtract(c, a)};
    return geometry_add(g, &s);
}

static int add_globe(geometry *g)
{
    int good = 1;
    for (int row = 0; row < ROWS; row++)
        for (int k = 0; k < 2 * ROWS; k++) {
            const vec3 a = globe(row, k), b = globe(row + 1, k), c = globe(row + 1, k + 1), d = globe(row, k + 1);
            good &= row == ROWS - 1 || add_triangle(g, a, b, c);
            good &= row == 0 || add_triangle(g, a, c, d);
        }
    return good;
}

/* From inside, at edges too; then on from what was met to both sides. */
static void test_closed(void)
{
    unsigned long long state = 8;
    geometry g = {0};
    int left = 0, met_again = 0;
    if (!TEST(add_globe(&g) && geometry_build(&g)))
        return;
    for (int i = 0; i < 100000; i++) {
        const vec3 from = place(&state, 0.2);
        const vec3 edge = globe(i % ROWS, i / ROWS);
        const ray r = {from, i % 2 ? direction(&state) : unit(subtract(edge, from)), HUGE_VAL};
        hit h, next;
        if (!geometry_hit(&g, &r, &h)) {
            left++;
            continue;
        }
        if (i % 2 == 0)
            continue; /* met at an edge, where going in may mean going out of another side */
        const vec3 on = direction(&state);
        const ray further = ray_from(&h, on);
        const int is_inside = dot(on, h.normal) < 0;
        met_again += is_inside ? !geometry_hit(&g, &further, &next) || next.distance < 1e-9 : 0;
        met_again += !is_inside && geometry_hit(&g, &further, &next); /* outside all of it is convex */
    }
    TEST(left == 0);
    TEST(met_again == 0);
    geometry_free(&g);
}

int main(void)
{
    test_nearest(vec(0, 0, 0), 1e-13);
    test_nearest(vec(1e5, -1e5, 2e5), 1e-8);
    test_closed();
    return test_done();
}
