/* Emitting shapes; they emit from their front. Up to LIGHTS_SEEN lights are chosen by the light that each may send
 * to a place; if there are more, by their power alone. On rectangles and triangles a point is drawn evenly by
 * area; for a sphere a direction is drawn evenly in the cone that it fills.
 *
 * The light that a source may send is its power over the square of its distance, times the cosines at both ends
 * for its best placed point: positive wherever a part of the source is visible. */
#include "render/path/parts.h"

#include <stdlib.h>

static const float pi = 3.14159265f, two_pi = 6.28318531f;

/* ---- making ---- */

static void describe_sphere(path_light *l, const sphere *s)
{
    l->sphere = *s;
    l->area = 4.0f * pi * s->radius * s->radius;
    l->power = (float)luminance(l->radiance) * 0.25f * l->area;
}

/* The sphere about the middle of a rectangle, or of the triangle of a corner and its two neighbours. The fourth
 * corner of a rectangle is as far away as the first. */
static sphere sphere_about(const rectangle *r, float middle)
{
    vndf_vec3 to_middle = scale(add(r->edge_u, r->edge_v), middle);
    vndf_vec3 u = subtract(r->edge_u, to_middle), v = subtract(r->edge_v, to_middle);
    float square = fmaxf(dot(to_middle, to_middle), fmaxf(dot(u, u), dot(v, v)));
    sphere s = {add(r->corner, to_middle), sqrtf(square)};
    return s;
}

static void describe_flat(path_light *l, const rectangle *r, float part)
{
    vndf_vec3 normal = cross(r->edge_u, r->edge_v);
    float length = sqrtf(dot(normal, normal));
    l->rectangle = *r;
    l->area = part * length;
    l->normal = scale(normal, 1.0f / length);
    l->power = (float)luminance(l->radiance) * l->area;
    l->sphere = sphere_about(r, part > 0.5f ? 0.5f : 1.0f / 3.0f);
}

/* 0 if the shape is no light that is drawn. */
static int describe(path_light *l, const scene *s, const shape *of)
{
    const material *m = &s->materials[of->material];
    if (m->kind != MATERIAL_LIGHT || !(luminance(m->colour) > 0.0))
        return 0;
    l->kind = of->kind;
    for (int i = 0; i < 3; i++)
        l->radiance[i] = m->colour[i];
    if (of->kind == SHAPE_SPHERE) {
        describe_sphere(l, &s->geometry.spheres[of->at]);
    } else if (of->kind == SHAPE_RECTANGLE) {
        describe_flat(l, &s->geometry.rectangles[of->at], 1.0f);
    } else {
        const vndf_vec3 *corner = s->geometry.triangles[of->at].corner;
        rectangle half = {corner[0], subtract(corner[1], corner[0]), subtract(corner[2], corner[0])};
        describe_flat(l, &half, 0.5f);
    }
    return l->power > 0.0f && l->power < INFINITY;
}

/* 0 if there is no memory. */
static int weigh(path_lights *made)
{
    if (made->count <= LIGHTS_SEEN)
        return 1;
    double *weights = malloc(made->count * sizeof *weights);
    for (uint32_t i = 0; weights && i < made->count; i++)
        weights[i] = (double)made->lights[i].power;
    if (weights)
        made->by_power = alias_make(weights, made->count);
    free(weights);
    return made->by_power != NULL;
}

static size_t emitting(const scene *s)
{
    size_t count = 0;
    for (size_t i = 0; i < s->geometry.shape_count; i++)
        count += s->materials[s->geometry.shapes[i].material].kind == MATERIAL_LIGHT;
    return count;
}

int path_lights_make(path_lights *made, const scene *s)
{
    const geometry *g = &s->geometry;
    size_t count = emitting(s);
    *made = (path_lights){NULL, 0, NULL, NULL};
    if (!count)
        return 1;
    made->lights = calloc(count, sizeof *made->lights);
    made->of_shape = malloc(g->shape_count * sizeof *made->of_shape);
    if (!made->lights || !made->of_shape)
        return 0;
    for (size_t i = 0; i < g->shape_count; i++) {
        path_light l = {.shape = (uint32_t)i};
        int drawn = describe(&l, s, &g->shapes[i]);
        made->of_shape[i] = drawn ? (int32_t)made->count : -1;
        if (drawn)
            made->lights[made->count++] = l;
    }
    if (!weigh(made))
        return 0;
    if (!made->count)
        path_lights_free(made);
    return 1;
}

void path_lights_free(path_lights *lights)
{
    free(lights->lights);
    free(lights->of_shape);
    free(lights->by_power);
    *lights = (path_lights){NULL, 0, NULL, NULL};
}

/* ---- choosing ---- */

/* 1 - cos of the half angle of the cone, without the difference, which would cancel for far spheres; 0 inside the
 * sphere. */
static float cone_height(const sphere *s, float square)
{
    float sine = s->radius * s->radius / square;
    return sine < 1.0f ? sine / (1.0f + sqrtf(1.0f - sine)) : 0.0f;
}

static inline float at_most_one(float x)
{
    return x < 1.0f ? x : 1.0f;
}

static float sends(const path_light *l, vndf_vec3 place, vndf_vec3 normal)
{
    vndf_vec3 way = subtract(l->sphere.centre, place);
    float reach = l->sphere.radius, square = dot(way, way), above = dot(normal, way), before = 1.0f;
    if (l->kind == SHAPE_SPHERE) {
        if (!(square > reach * reach))
            return 0.0f;
    } else {
        before = -dot(l->normal, way);
        if (!(before > 0.0f))
            return 0.0f;
        square += reach * reach;
    }
    if (!(above + reach > 0.0f))
        return 0.0f;
    float inverse = 1.0f / square, nearness = sqrtf(inverse);
    if (l->kind != SHAPE_SPHERE)
        before = at_most_one((before + reach) * nearness);
    return l->power * inverse * before * at_most_one((above + reach) * nearness);
}

void path_lights_look(const path_lights *lights, float far, vndf_vec3 place, vndf_vec3 normal, light_view *v)
{
    float sum = 0.0f;
    int by_power = lights->by_power != NULL;
    v->place = place;
    for (uint32_t i = 0; i < lights->count && !by_power; i++)
        sum += v->part[i] = sends(&lights->lights[i], place, normal);
    v->lights = by_power || sum > 0.0f ? 1.0f : 0.0f;
    if (far > 0.0f)
        v->lights *= by_power ? 0.5f : fminf(fmaxf(sum / (sum + 0.25f * far), 0.1f), 0.9f);
    v->environment = far > 0.0f ? 1.0f - v->lights : 0.0f;
    for (uint32_t i = 0; sum > 0.0f && i < lights->count; i++)
        v->part[i] *= v->lights / sum;
}

/* ---- drawing ---- */

static int draw_flat(const path_light *l, vndf_vec3 place, float u, float v, light_sample *s)
{
    const rectangle *r = &l->rectangle;
    int mirrored = l->kind == SHAPE_TRIANGLE && u + v > 1.0f;
    vndf_vec3 across = scale(r->edge_u, mirrored ? 1.0f - u : u), up = scale(r->edge_v, mirrored ? 1.0f - v : v);
    vndf_vec3 way = subtract(add(r->corner, add(across, up)), place);
    float square = dot(way, way);
    s->distance = sqrtf(square);
    s->direction = scale(way, 1.0f / s->distance);
    float cosine = -dot(s->direction, l->normal);
    if (!(cosine > 0.0f && square > 0.0f))
        return 0;
    s->density = square / (l->area * cosine);
    return 1;
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

/* The entry whose part holds u; if rounding leaves none, the last entry that has a part. */
static uint32_t choose_seen(const path_lights *lights, const light_view *v, float u)
{
    uint32_t chosen = 0;
    for (uint32_t i = 0; i < lights->count; i++) {
        if (!(v->part[i] > 0.0f))
            continue;
        chosen = i;
        if (u < v->part[i])
            break;
        u -= v->part[i];
    }
    return chosen;
}

int path_lights_draw(const path_lights *lights, const light_view *v, uint64_t choice, const float u[3],
                     light_sample *s)
{
    float probability;
    uint32_t at;
    if (lights->by_power) {
        at = alias_draw(lights->by_power, lights->count, choice, &probability);
        probability *= v->lights;
    } else {
        at = choose_seen(lights, v, u[0]);
        probability = v->part[at];
    }
    const path_light *l = &lights->lights[at];
    int seen =
        l->kind == SHAPE_SPHERE ? draw_sphere(l, v->place, u[1], u[2], s) : draw_flat(l, v->place, u[1], u[2], s);
    if (!seen)
        return 0;
    s->density *= probability;
    s->radiance = l->radiance;
    s->shape = l->shape;
    return 1;
}

float path_lights_density(const path_lights *lights, const light_view *v, vndf_vec3 direction, const hit *h)
{
    int32_t at = lights->of_shape ? lights->of_shape[h->shape] : -1;
    if (at < 0)
        return 0.0f;
    const path_light *l = &lights->lights[at];
    float probability = lights->by_power ? v->lights * lights->by_power[at].own : v->part[at];
    vndf_vec3 way = subtract(l->kind == SHAPE_SPHERE ? l->sphere.centre : h->place, v->place);
    float square = dot(way, way);
    if (l->kind == SHAPE_SPHERE) {
        float height = cone_height(&l->sphere, square);
        return height > 0.0f ? probability / (two_pi * height) : 0.0f;
    }
    float cosine = -dot(direction, l->normal);
    return cosine > 0.0f ? probability * square / (l->area * cosine) : 0.0f;
}
