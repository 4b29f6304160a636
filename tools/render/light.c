/* Half of all draws, or all where no light shines, are of the image of the environment, the others of lights, which are
 * as likely as one another. On a rectangle a point is drawn evenly by area, for a sphere a direction evenly in the cone
 * that it fills, in the image a pixel by its light and then a direction in it evenly by solid angle.
 *
 * Pixels count by the light of 3 x 3 of them, so that the density is positive wherever the image, which is interpolated
 * between pixels, is. An image that is nearly even is not drawn: every direction finds its light. */
#include "render/scene.h"

#include <stdlib.h>

/* ---- the environment ---- */

/* u and v in [0, 1]. */
static void place_in_image(const environment *e, vec3 w, double *u, double *v)
{
    const double turns = 0.5 + atan2(w.x, -w.z) / (2 * PI) + e->turn;
    *u = turns - floor(turns);
    *v = atan2(hypot(w.x, w.z), w.y) / PI;
}

void environment_radiance(const environment *e, vec3 direction, float rgb[3])
{
    double u, v, half = e->map ? 0.5 / e->map->height : 0;
    for (int i = 0; i < 3; i++)
        rgb[i] = e->constant[i];
    if (!e->map)
        return;
    place_in_image(e, direction, &u, &v);
    image_bilinear(e->map, u, fmin(fmax(v, half), 1 - half), rgb); /* not across the poles */
    for (int i = 0; i < 3; i++)
        rgb[i] *= (float)e->scale;
}

static double light_around(const image *map, size_t i)
{
    const int x = (int)(i % (size_t)map->width), y = (int)(i / (size_t)map->width);
    double sum = 0;
    for (int k = y > 0 ? y - 1 : y; k <= y + 1 && k < map->height; k++)
        for (int n = x - 1; n <= x + 1; n++)
            sum += luminance(image_pixel(map, (n + map->width) % map->width, k));
    return sum;
}

/* The cosines at the top of the row of a pixel, and by how much they fall across it. */
static double row_top(const image *map, size_t i, double *fall)
{
    const double y = (double)(i / (size_t)map->width), top = cos(PI * y / map->height);
    *fall = top - cos(PI * (y + 1) / map->height);
    return top;
}

/* 0 if there is no memory. An image is drawn if the mean square of its light is `even` times the square of its mean:
 * below that, drawing costs more than it gives. */
static int sum_up(environment *e)
{
    const double even = 2;
    const size_t count = (size_t)e->map->width * (size_t)e->map->height;
    double sum = 0, square = 0, fall;
    e->sums = malloc(count * sizeof *e->sums);
    for (size_t i = 0; i < count && e->sums; i++) {
        const double here = light_around(e->map, i);
        row_top(e->map, i, &fall);
        const double part = fall / (2.0 * e->map->width); /* of the sphere */
        e->sums[i] = sum += here * part;
        square += here * here * part;
    }
    e->is_drawn = sum > 0 && square >= even * sum * sum;
    return e->sums != NULL;
}

/* The density per steradian of directions in a pixel. */
static double pixel_density(const scene *s, size_t i)
{
    const environment *e = &s->environment;
    const size_t last = (size_t)e->map->width * (size_t)e->map->height - 1;
    const double chance = (e->sums[i] - (i ? e->sums[i - 1] : 0)) / e->sums[last];
    double fall;
    row_top(e->map, i, &fall);
    return (s->light_count ? 0.5 : 1) * chance * e->map->width / (2 * PI * fall);
}

/* The pixel of the first sum above u, which gives the place across it, too. */
static void draw_environment(const scene *s, double u, double v, light_sample *sample)
{
    const environment *e = &s->environment;
    size_t low = 0, high = (size_t)e->map->width * (size_t)e->map->height - 1;
    const double aim = u * e->sums[high];
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (e->sums[middle] > aim)
            high = middle;
        else
            low = middle + 1;
    }
    const double before = low ? e->sums[low - 1] : 0, across = (aim - before) / (e->sums[low] - before);
    double fall, top = row_top(e->map, low, &fall), height = top - v * fall;
    const double longitude =
        2 * PI * (((double)(low % (size_t)e->map->width) + across) / e->map->width - 0.5 - e->turn);
    const double sine = sqrt(fmax(1 - height * height, 0));
    sample->direction = vec(sine * sin(longitude), height, -sine * cos(longitude));
    sample->distance = HUGE_VAL;
    sample->density = pixel_density(s, low);
    environment_radiance(e, sample->direction, sample->radiance);
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
    return !s->environment.map || sum_up(&s->environment);
}

int lights_any(const scene *s)
{
    return s->light_count > 0 || s->environment.is_drawn;
}

int lights_draw(const scene *s, vec3 place, const double u[3], light_sample *sample)
{
    const double from = !s->environment.is_drawn ? 0 : s->light_count ? 0.5 : 1;
    if (u[0] < from)
        draw_environment(s, u[1], u[2], sample);
    else {
        const double per = (1 - from) / (double)s->light_count;
        const shape *is = s->lights[(size_t)fmin((u[0] - from) / per, (double)s->light_count - 1)];
        draw_shape(is, place, u[1], u[2], sample);
        sample->density *= per;
        for (int k = 0; k < 3; k++)
            sample->radiance[k] = s->materials[is->material].colour[k];
    }
    return sample->density > 0 && sample->distance > 0;
}

double lights_density(const scene *s, vec3 place, vec3 direction, const hit *h)
{
    const environment *e = &s->environment;
    double u, v;
    if (h)
        return shape_density(h->shape, place, direction, h->place) * (e->is_drawn ? 0.5 : 1) /
               (double)s->light_count;
    if (!e->is_drawn)
        return 0;
    place_in_image(e, direction, &u, &v);
    const int x = (int)fmin(u * e->map->width, e->map->width - 1);
    const int y = (int)fmin(v * e->map->height, e->map->height - 1);
    return pixel_density(s, (size_t)y * (size_t)e->map->width + (size_t)x);
}
