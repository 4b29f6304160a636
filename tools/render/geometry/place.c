/* Place, frame and texture coordinates of a hit. The place is computed from the shape, not along the ray, so that
 * it lies on the shape but for the rounding to float. In a frame z is the normal, and x the direction in which u
 * grows, made perpendicular to z.
 *
 * A triangle with corners p and texture coordinates (u, v) has  p1 - p0 = du1 dp/du + dv1 dp/dv,  and the same for
 * p2 - p0; hence dp/du ~ dv2 (p1 - p0) - dv1 (p2 - p0), with the sign of the determinant du1 dv2 - du2 dv1. */
#include "render/geometry/shape.h"

#define PI 3.14159265358979323846

/* Below 1, where a texture would begin again. */
static float texture(double u)
{
    const float last = 1.0f - 0x1p-24f;
    const float rounded = (float)u;
    return rounded < last ? rounded : last;
}

static wide unit_or(wide a, wide otherwise)
{
    const double length = wide_length(a);
    return length > 0.0 ? wide_scale(a, 1.0 / length) : otherwise;
}

/* Any direction across z: the product of z and the axis that is farthest from it. */
static wide any_across(wide z)
{
    const double x2 = z.x * z.x, y2 = z.y * z.y, z2 = z.z * z.z;
    const wide axis = {x2 <= y2 && x2 <= z2, !(x2 <= y2 && x2 <= z2) && y2 <= z2, 0.0};
    const wide last = {0.0, 0.0, 1.0};
    const wide across = wide_cross(axis.x + axis.y > 0.0 ? axis : last, z);
    return wide_scale(across, 1.0 / wide_length(across));
}

/* x towards `along`; any x if `along` has no part across z. */
static frame frame_from(wide z, wide along)
{
    const wide across = wide_along(along, -wide_dot(along, z), z);
    const int is_parallel = !(wide_dot(across, across) > 1e-12 * wide_dot(along, along));
    const wide x = is_parallel ? any_across(z) : wide_scale(across, 1.0 / wide_length(across));
    const frame f = {narrow(x), narrow(wide_cross(z, x)), narrow(z)};
    return f;
}

static void set_place(hit *h, wide place, wide normal, double extent)
{
    h->place = narrow(place);
    h->normal = narrow(normal);
    h->error = (float)(1e-14 * extent); /* some 90 roundings of double */
}

static void describe_sphere(const sphere *s, const line *l, double distance, hit *h)
{
    const wide centre = widen(s->centre), up = {0.0, 1.0, 0.0};
    const wide from_centre = wide_subtract(wide_along(l->origin, distance, l->direction), centre);
    const wide n = unit_or(from_centre, up);
    const double longitude = atan2(n.x, n.z), r = (double)s->radius;
    const wide along = {n.z, 0.0, -n.x};
    set_place(h, wide_along(centre, r, n), n, fabs(centre.x) + fabs(centre.y) + fabs(centre.z) + r);
    h->shading = frame_from(n, along);
    h->u = texture(longitude < 0.0 ? 1.0 + longitude / (2.0 * PI) : longitude / (2.0 * PI));
    h->v = texture(atan2(sqrt(n.x * n.x + n.z * n.z), n.y) / PI);
}

static void describe_rectangle(const rectangle *r, const meeting *m, hit *h)
{
    const wide corner = widen(r->corner), u = widen(r->edge_u), v = widen(r->edge_v), n = wide_cross(u, v);
    const wide z = wide_scale(n, 1.0 / wide_length(n));
    const double extent = fabs(corner.x) + fabs(corner.y) + fabs(corner.z) + wide_length(u) + wide_length(v);
    set_place(h, wide_along(wide_along(corner, m->a, u), m->b, v), z, extent);
    h->shading = frame_from(z, u);
    h->u = texture(m->a);
    h->v = texture(1.0 - m->b);
}

static wide blend(const vndf_vec3 *at, double b, double c)
{
    const wide a = widen(at[0]), to_b = wide_subtract(widen(at[1]), a), to_c = wide_subtract(widen(at[2]), a);
    return wide_along(wide_along(a, b, to_b), c, to_c);
}

static double blend_number(const float *at, double b, double c)
{
    const double a = (double)at[0];
    return a + b * ((double)at[1] - a) + c * ((double)at[2] - a);
}

static wide triangle_along_u(const triangle *t, wide edge_1, wide edge_2)
{
    const double du_1 = (double)t->u[1] - (double)t->u[0], dv_1 = (double)t->v[1] - (double)t->v[0];
    const double du_2 = (double)t->u[2] - (double)t->u[0], dv_2 = (double)t->v[2] - (double)t->v[0];
    const double determinant = du_1 * dv_2 - du_2 * dv_1;
    const double sign = determinant > 0.0 ? 1.0 : determinant < 0.0 ? -1.0 : 0.0;
    return wide_scale(wide_along(wide_scale(edge_1, dv_2), -dv_1, edge_2), sign);
}

static void describe_triangle(const triangle *t, const meeting *m, hit *h)
{
    const wide a = widen(t->corner[0]), up = {0.0, 1.0, 0.0};
    const wide edge_1 = wide_subtract(widen(t->corner[1]), a), edge_2 = wide_subtract(widen(t->corner[2]), a);
    const wide normal = unit_or(wide_cross(edge_1, edge_2), up);
    wide shading = unit_or(blend(t->normal, m->a, m->b), normal);
    if (!(wide_dot(shading, normal) > 0.0)) /* an interpolated normal can turn below the surface */
        shading = normal;
    set_place(h, blend(t->corner, m->a, m->b), normal,
              fabs(a.x) + fabs(a.y) + fabs(a.z) + wide_length(edge_1) + wide_length(edge_2));
    h->shading = frame_from(shading, triangle_along_u(t, edge_1, edge_2));
    h->u = (float)blend_number(t->u, m->a, m->b);
    h->v = (float)blend_number(t->v, m->a, m->b);
}

void shape_describe(const geometry *g, const line *l, const meeting *m, hit *h)
{
    const shape *s = &g->shapes[m->shape];
    switch (s->kind) {
    case SHAPE_SPHERE: describe_sphere(&g->spheres[s->at], l, m->distance, h); break;
    case SHAPE_RECTANGLE: describe_rectangle(&g->rectangles[s->at], m, h); break;
    case SHAPE_TRIANGLE: describe_triangle(&g->triangles[s->at], m, h); break;
    }
    h->distance = (float)m->distance;
    h->shape = m->shape;
    h->material = s->material;
}
