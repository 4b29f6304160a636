/* Lines against spheres, rectangles and triangles, in double from coordinates in float. Results are exact to some
 * 1e-15 of the coordinates, so ray_from only makes up for the rounding of a place to float.
 *
 *   sphere     a t^2 + 2 b t + c = 0 with the discriminant from the part of the centre across the line,
 *              r^2 - |across|^2, which small and distant spheres do not cancel, and the roots q / a and c / q
 *   rectangle  the plane n.(corner - origin) / n.direction, then u and v by the dual edges
 *   triangle   watertight (Woop, Benthin & Wald, "Watertight Ray/Triangle Intersection", JCGT 2013): corners
 *              relative to the origin and sheared so that the line is the z axis; the edges' signed areas, of
 *              which neighbours compute the same number with the other sign, are then the weights of the
 *              opposite corners */
#include "render/geometry/shape.h"

#ifdef __clang__ /* a fused product would break the antisymmetry of `turn`; gcc does not fuse in ISO mode */
#  pragma STDC FP_CONTRACT OFF
#endif

int line_from(line *l, const ray *r)
{
    const double d[3] = {(double)r->direction.x, (double)r->direction.y, (double)r->direction.z};
    int z = fabs(d[0]) > fabs(d[1]) ? 0 : 1;
    z = fabs(d[z]) > fabs(d[2]) ? z : 2;
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    const line made = {widen(r->origin), widen(r->direction), (double)r->from, {x, y, z},
                       d[x] / d[z],      d[y] / d[z],         1.0 / d[z]};
    *l = made;
    return fabs(d[x] + d[y] + d[z] + wide_dot(made.origin, made.origin)) < HUGE_VAL && d[z] != 0.0;
}

static int closer(meeting *m, const line *l, double distance, double a, double b)
{
    if (!(distance > l->from && distance < m->distance))
        return 0;
    m->distance = distance;
    m->a = a;
    m->b = b;
    return 1;
}

static int sphere_meets(const sphere *s, const line *l, meeting *m)
{
    const wide from_centre = wide_subtract(l->origin, widen(s->centre));
    const double r2 = (double)s->radius * (double)s->radius;
    const double a = wide_dot(l->direction, l->direction), b = wide_dot(from_centre, l->direction);
    const wide across = wide_along(from_centre, -b / a, l->direction);
    const double rest = r2 - wide_dot(across, across);
    if (!(rest >= 0.0))
        return 0;
    const double q = -b - copysign(sqrt(a * rest), b); /* a sum of two terms of one sign */
    const double c = wide_dot(from_centre, from_centre) - r2;
    const double one = q / a, other = q != 0.0 ? c / q : one;
    const double near = one < other ? one : other, far = one < other ? other : one;
    return closer(m, l, near > l->from ? near : far, 0.0, 0.0);
}

static int rectangle_meets(const rectangle *r, const line *l, meeting *m)
{
    const double slack = 1e-13; /* in u and v: a ray through the edge of a box must meet one of its sides */
    const wide u = widen(r->edge_u), v = widen(r->edge_v), n = wide_cross(u, v);
    const wide to_corner = wide_subtract(widen(r->corner), l->origin);
    const double distance = wide_dot(n, to_corner) / wide_dot(n, l->direction);
    if (!(distance > l->from && distance < m->distance)) /* NaN: the line lies in the plane */
        return 0;
    const wide p = wide_subtract(wide_scale(l->direction, distance), to_corner);
    const double n2 = wide_dot(n, n);
    const double a = wide_dot(wide_cross(p, v), n) / n2, b = wide_dot(wide_cross(u, p), n) / n2;
    if (!(a >= -slack && a <= 1.0 + slack && b >= -slack && b <= 1.0 + slack))
        return 0;
    return closer(m, l, distance, fmin(fmax(a, 0.0), 1.0), fmin(fmax(b, 0.0), 1.0));
}

static inline wide shear(const line *l, vndf_vec3 corner)
{
    const wide from_origin = wide_subtract(widen(corner), l->origin);
    const double p[3] = {from_origin.x, from_origin.y, from_origin.z};
    const double z = p[l->axis[2]];
    const wide sheared = {p[l->axis[0]] - l->shear_x * z, p[l->axis[1]] - l->shear_y * z, l->depth * z};
    return sheared;
}

/* Twice the signed area of 0, a, b; for 0, b, a it is exactly the negative. */
static inline double turn(wide a, wide b)
{
    return a.x * b.y - a.y * b.x;
}

static int triangle_meets(const triangle *t, const line *l, meeting *m)
{
    const wide a = shear(l, t->corner[0]), b = shear(l, t->corner[1]), c = shear(l, t->corner[2]);
    const double of_a = turn(b, c), of_b = turn(c, a), of_c = turn(a, b);
    if ((of_a < 0.0 || of_b < 0.0 || of_c < 0.0) && (of_a > 0.0 || of_b > 0.0 || of_c > 0.0))
        return 0;
    const double all = of_a + of_b + of_c;
    if (!(fabs(all) > 0.0)) /* seen from its edge */
        return 0;
    return closer(m, l, (of_a * a.z + of_b * b.z + of_c * c.z) / all, of_b / all, of_c / all);
}

int shape_meets(const geometry *g, uint32_t at, const line *l, meeting *m)
{
    const shape *s = &g->shapes[at];
    int is_met = 0;
    switch (s->kind) {
    case SHAPE_TRIANGLE: is_met = triangle_meets(&g->triangles[s->at], l, m); break;
    case SHAPE_SPHERE: is_met = sphere_meets(&g->spheres[s->at], l, m); break;
    case SHAPE_RECTANGLE: is_met = rectangle_meets(&g->rectangles[s->at], l, m); break;
    }
    if (is_met)
        m->shape = at;
    return is_met;
}

/* ---- boxes -------------------------------------------------------------------------------------- */

/* Rounds towards `to`; a value too large for float, and NaN, become infinite. */
static float rounded(double value, float to)
{
    if (!(fabs(value) <= (double)GEOMETRY_REACH))
        return to;
    const float near = (float)value;
    return (to < 0.0f ? (double)near > value : (double)near < value) ? nextafterf(near, to) : near;
}

static void enclose(box *b, wide p, double margin)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int axis = 0; axis < 3; axis++) {
        b->bound[0][axis] = fminf(b->bound[0][axis], rounded(at[axis] - margin, -HUGE_VALF));
        b->bound[1][axis] = fmaxf(b->bound[1][axis], rounded(at[axis] + margin, HUGE_VALF));
    }
}

static void enclose_rectangle(box *b, const rectangle *r)
{
    const wide corner = widen(r->corner), u = widen(r->edge_u), v = widen(r->edge_v);
    enclose(b, corner, 0.0);
    enclose(b, wide_add(corner, u), 0.0);
    enclose(b, wide_add(corner, v), 0.0);
    enclose(b, wide_add(wide_add(corner, u), v), 0.0);
}

int shape_box(const geometry *g, const shape *s, box *b)
{
    for (int axis = 0; axis < 3; axis++) {
        b->bound[0][axis] = HUGE_VALF;
        b->bound[1][axis] = -HUGE_VALF;
    }
    if (s->kind == SHAPE_SPHERE)
        enclose(b, widen(g->spheres[s->at].centre), (double)g->spheres[s->at].radius);
    else if (s->kind == SHAPE_RECTANGLE)
        enclose_rectangle(b, &g->rectangles[s->at]);
    else
        for (int i = 0; i < 3; i++)
            enclose(b, widen(g->triangles[s->at].corner[i]), 0.0);
    int is_finite = 1;
    for (int axis = 0; axis < 3; axis++)
        is_finite &= b->bound[0][axis] >= -GEOMETRY_REACH && b->bound[1][axis] <= GEOMETRY_REACH &&
                     b->bound[0][axis] <= b->bound[1][axis];
    return is_finite;
}
