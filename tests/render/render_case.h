/* What the tests of the renderer's geometry share: random directions and shapes, and rays. */
#ifndef TESTS_RENDER_RENDER_CASE_H
#define TESTS_RENDER_RENDER_CASE_H

#include <math.h>
#include <stdlib.h>

#include "harness/constants.h"
#include "render/geometry/geometry.h"
#include "harness/test.h"

/* How many of them, less in quick mode. */
static inline int rays(int most)
{
    return test_quick() ? most / 10 : most;
}

static inline float between(unsigned long long *state, float low, float high)
{
    return low + (high - low) * test_uniform(state);
}

static inline vndf_vec3 point_in_box(unsigned long long *state, float half)
{
    const float x = between(state, -half, half), y = between(state, -half, half);
    return vec(x, y, between(state, -half, half));
}

static inline vndf_vec3 random_direction(unsigned long long *state)
{
    for (;;) {
        const vndf_vec3 p = point_in_box(state, 1.0f);
        if (dot(p, p) > 1e-3f && dot(p, p) <= 1.0f)
            return unit(p);
    }
}

static inline ray ray_along(vndf_vec3 origin, vndf_vec3 direction)
{
    const ray r = {origin, direction, 0.0f, HUGE_VALF};
    return r;
}

static inline triangle bare_triangle(vndf_vec3 a, vndf_vec3 b, vndf_vec3 c)
{
    const triangle t = {{a, b, c}, {{0.0f, 0.0f, 0.0f}}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    return t;
}

/* Corner of a sphere of `radius` about the origin, cut into rows x 2 rows: the same bits for all neighbours. */
static inline vndf_vec3 globe_corner(int rows, int row, int column, float radius)
{
    const double theta = PI * row / rows;
    const double phi = PI * (column % (2 * rows)) / rows, s = row % rows == 0 ? 0.0 : sin(theta);
    const double r = (double)radius;
    return vec((float)(r * s * sin(phi)), (float)(r * cos(theta)), (float)(r * s * cos(phi)));
}

static inline int add_globe(geometry *g, int rows, float radius)
{
    int is_added = 1;
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < 2 * rows; column++) {
            const vndf_vec3 a = globe_corner(rows, row, column, radius);
            const vndf_vec3 b = globe_corner(rows, row + 1, column, radius);
            const vndf_vec3 c = globe_corner(rows, row + 1, column + 1, radius);
            const vndf_vec3 d = globe_corner(rows, row, column + 1, radius);
            triangle t = bare_triangle(a, b, c);
            if (row < rows - 1)
                is_added &= geometry_add_triangle(g, &t, 0);
            t.corner[1] = c;
            t.corner[2] = d;
            if (row > 0)
                is_added &= geometry_add_triangle(g, &t, 0);
        }
    return is_added;
}

/* `spread`: of places; `size`: of shapes. */
static inline int add_random(geometry *g, unsigned long long *state, int count, float spread, float size)
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

#endif
