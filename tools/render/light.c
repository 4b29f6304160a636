/* All lights are as likely. On a rectangle a point is drawn evenly by area, for a sphere a direction evenly in
 * the cone that it fills. Light from far away is not drawn: materials find it, for 1.6 times the work in a studio of
 * soft boxes. */
#include "render/scene.h"

/* ---- the environment ---- */

void environment_radiance(const environment *e, vec3 direction, float rgb[3])
{
    for (int i = 0; i < 3; i++)
        rgb[i] = e->constant[i];
    if (!e->map)
        return;
    const double turns = 0.5 + atan2(direction.x, -direction.z) / (2 * PI) + e->turn, half = 0.5 / e->map->height;
    const double down = atan2(hypot(direction.x, direction.z), direction.y) / PI;
    image_bilinear(e->map, turns, fmin(fmax(down, half), 1 - half), rgb); /* not across the poles */
    for (int i = 0; i < 3; i++)
        rgb[i] *= (float)e->scale;
}

/* ---- shapes ---- */

/* 1 - cos of the half angle of the cone that a sphere fills, without the difference, which would cancel; 0 inside. */
static double cone_height(const shape *is, double square)
{
    const double sine = is->radius * is->radius / square;
    return sine < 1 ? sine / (1 + sqrt(1 - sine)) : 0;
}

static double shape_density(const shape *is, vec3 place, vec3 direction, vec3 met)
{
    if (is->kind == SHAPE_SPHERE) {
        const vec3 way = subtract(is->corner, place);
        const double height = cone_height(is, dot(way, way));
        return height > 0 ? 1 / (2 * PI * height) : 0;
    }
    const vec3 area = cross(is->edge_u, is->edge_v), way = subtract(met, place);
    const double seen = -dot(direction, area);
    return seen > 0 ? dot(way, way) / seen : 0;
}

static void draw_shape(const shape *is, vec3 place, double u, double v, light_sample *sample)
{
    const int is_sphere = is->kind == SHAPE_SPHERE;
    const vec3 to = is_sphere ? is->corner : along(along(is->corner, u, is->edge_u), v, is->edge_v);
    const vec3 way = subtract(to, place);
    const double square = dot(way, way);
    sample->distance = sqrt(square);
    sample->direction = scale(way, 1 / sample->distance);
    if (is_sphere) {
        const double fall = u * cone_height(is, square), sine_square = fall * (2 - fall), sine = sqrt(sine_square);
        const double half_chord = sqrt(fmax(is->radius * is->radius - square * sine_square, 0));
        const frame f = frame_about(sample->direction, vec(1, 0, 0));
        sample->direction = unit(out_of(&f, vec(sine * cos(2 * PI * v), sine * sin(2 * PI * v), 1 - fall)));
        sample->distance = sample->distance * (1 - fall) - half_chord;
    }
    sample->density = shape_density(is, place, sample->direction, to);
}

/* ---- lights ---- */

int lights_make(scene *s)
{
    for (size_t i = 0; i < s->geometry.count; i++) {
        const shape *is = &s->geometry.shapes[i];
        const material *m = &s->materials[is->material];
        if (m->kind != MATERIAL_LIGHT || !(luminance(m->colour) > 0))
            continue;
        if (s->light_count == SCENE_LIGHTS_MAX)
            return 0;
        s->lights[s->light_count++] = is;
    }
    return 1;
}

int lights_draw(const scene *s, vec3 place, const double u[3], light_sample *sample)
{
    const double count = (double)s->light_count;
    const shape *is = s->lights[(size_t)(u[0] * count)];
    draw_shape(is, place, u[1], u[2], sample);
    sample->density /= count;
    for (int k = 0; k < 3; k++)
        sample->radiance[k] = s->materials[is->material].colour[k];
    return sample->density > 0 && sample->distance > 0;
}

double lights_density(const scene *s, vec3 place, vec3 direction, const hit *h)
{
    return h ? shape_density(h->shape, place, direction, h->place) / (double)s->light_count : 0;
}
