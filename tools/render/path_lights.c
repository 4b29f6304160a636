/* Emitting shapes. One is chosen by its power; on a rectangle a point is drawn evenly by area, on a sphere a
 * direction evenly in the cone that it fills. Shapes emit from their front. Emitting triangles are not drawn:
 * paths meet them. */
#include "render/path_parts.h"

#include <stdlib.h>

static const float two_pi = 6.28318531f;

/* ---- making ---- */

static void describe_sphere(path_light *l, const sphere *s)
{
    l->sphere = *s;
    l->area = 2.0f * two_pi * s->radius * s->radius;
}

static void describe_rectangle(path_light *l, const rectangle *r)
{
    vndf_vec3 normal = cross(r->edge_u, r->edge_v);
    l->rectangle = *r;
    l->area = sqrtf(dot(normal, normal));
    l->normal = scale(normal, 1.0f / l->area);
}

/* 0: not one that is drawn. */
static int describe(path_light *l, const scene *s, const shape *of)
{
    const material *m = &s->materials[of->material];
    if (m->kind != MATERIAL_LIGHT || of->kind == SHAPE_TRIANGLE || !(luminance(m->colour) > 0.0f))
        return 0;
    l->kind = of->kind;
    for (int i = 0; i < 3; i++)
        l->radiance[i] = m->colour[i];
    if (of->kind == SHAPE_SPHERE)
        describe_sphere(l, &s->geometry.spheres[of->at]);
    else
        describe_rectangle(l, &s->geometry.rectangles[of->at]);
    return l->area > 0.0f;
}

static void weigh(path_lights *made)
{
    double total = 0, below = 0;
    for (size_t i = 0; i < made->count; i++)
        total += (double)(made->lights[i].area * luminance(made->lights[i].radiance));
    for (size_t i = 0; i < made->count; i++) {
        path_light *l = &made->lights[i];
        double part = (double)(l->area * luminance(l->radiance)) / total;
        l->probability = (float)part;
        l->below = (float)below;
        below += part;
    }
}

int path_lights_make(path_lights *made, const scene *s)
{
    const geometry *g = &s->geometry;
    *made = (path_lights){NULL, 0, NULL};
    if (!g->shape_count)
        return 1;
    made->lights = calloc(g->shape_count, sizeof *made->lights);
    made->of_shape = malloc(g->shape_count * sizeof *made->of_shape);
    if (!made->lights || !made->of_shape)
        return 0;
    for (size_t i = 0; i < g->shape_count; i++) {
        int drawn = describe(&made->lights[made->count], s, &g->shapes[i]);
        made->of_shape[i] = drawn ? (int32_t)made->count : -1;
        made->count += (size_t)drawn;
    }
    weigh(made);
    if (!made->count)
        path_lights_free(made);
    return 1;
}

void path_lights_free(path_lights *lights)
{
    free(lights->lights);
    free(lights->of_shape);
    *lights = (path_lights){NULL, 0, NULL};
}

/* ---- drawing ---- */

static int draw_rectangle(const path_light *l, vndf_vec3 place, float u, float v, light_sample *s)
{
    const rectangle *r = &l->rectangle;
    vndf_vec3 point = add(r->corner, add(scale(r->edge_u, u), scale(r->edge_v, v)));
    vndf_vec3 way = subtract(point, place);
    float square = dot(way, way);
    s->distance = sqrtf(square);
    s->direction = scale(way, 1.0f / s->distance);
    float cosine = -dot(s->direction, l->normal);
    if (!(cosine > 0.0f && square > 0.0f))
        return 0;
    s->density = square / (l->area * cosine);
    return 1;
}

/* 1 - cos of the half angle of the cone, without the difference that is lost for far spheres; 0 inside the
 * sphere. */
static float cone_height(const sphere *s, float square)
{
    float sine = s->radius * s->radius / square;
    return sine < 1.0f ? sine / (1.0f + sqrtf(1.0f - sine)) : 0.0f;
}

/* x and y of a frame about a unit z (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017). */
static frame frame_about(vndf_vec3 z)
{
    float side = copysignf(1.0f, z.z), a = -1.0f / (side + z.z), b = z.x * z.y * a;
    frame f = {{1.0f + side * z.x * z.x * a, side * b, -side * z.x}, {b, side + z.y * z.y * a, -z.y}, z};
    return f;
}

static int draw_sphere(const path_light *l, vndf_vec3 place, float u, float v, light_sample *s)
{
    vndf_vec3 way = subtract(l->sphere.centre, place);
    float square = dot(way, way), height = cone_height(&l->sphere, square);
    if (!(height > 0.0f))
        return 0;
    float distance = sqrtf(square), fall = u * height; /* 1 - cos */
    float sine_square = fall * (2.0f - fall), cosine = 1.0f - fall, sine = sqrtf(sine_square);
    frame f = frame_about(scale(way, 1.0f / distance));
    s->direction = unit(from_frame(&f, vec(sine * cosf(two_pi * v), sine * sinf(two_pi * v), cosine)));
    float inside = l->sphere.radius * l->sphere.radius - square * sine_square;
    s->distance = distance * cosine - sqrtf(fmaxf(inside, 0.0f));
    s->density = 1.0f / (two_pi * height);
    return s->distance > 0.0f;
}

/* The last one whose sum before it is not above u. */
static const path_light *choose(const path_lights *lights, float u)
{
    size_t low = 0, high = lights->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (lights->lights[middle].below <= u)
            low = middle;
        else
            high = middle;
    }
    return &lights->lights[low];
}

int path_lights_draw(const path_lights *lights, vndf_vec3 place, const float u[3], light_sample *s)
{
    const path_light *l = choose(lights, u[0]);
    int seen = l->kind == SHAPE_SPHERE ? draw_sphere(l, place, u[1], u[2], s)
                                       : draw_rectangle(l, place, u[1], u[2], s);
    if (!seen)
        return 0;
    s->density *= l->probability;
    for (int i = 0; i < 3; i++)
        s->radiance[i] = l->radiance[i];
    return 1;
}

float path_lights_density(const path_lights *lights, vndf_vec3 place, vndf_vec3 direction, const hit *h)
{
    int32_t at = lights->of_shape ? lights->of_shape[h->shape] : -1;
    if (at < 0)
        return 0.0f;
    const path_light *l = &lights->lights[at];
    vndf_vec3 way = subtract(l->kind == SHAPE_SPHERE ? l->sphere.centre : h->place, place);
    float square = dot(way, way);
    if (l->kind == SHAPE_SPHERE) {
        float height = cone_height(&l->sphere, square);
        return height > 0.0f ? l->probability / (two_pi * height) : 0.0f;
    }
    float cosine = -dot(direction, l->normal);
    return cosine > 0.0f ? l->probability * square / (l->area * cosine) : 0.0f;
}
