/* One light is chosen by what it may send to a place, its power over the square of its distance; the image of the
 * environment by half of all draws, or by all where no light shines. On a rectangle a point is drawn evenly by
 * area, for a sphere a direction evenly in the cone that it fills, in the image a pixel by its light and then a
 * direction in it evenly by solid angle.
 *
 * Pixels count by the mean luminance of 3 x 3 of them, so that the density is positive wherever the image, which
 * is interpolated between pixels, is. An image that is nearly even is not drawn: every direction finds its light.
 */
#include "render/light.h"

#include <stdlib.h>

/* ---- making ---- */

static emitter emitter_of(const scene *s, uint32_t at)
{
    const shape *is = &s->geometry.shapes[at];
    const float *radiance = s->materials[is->material].colour;
    emitter l = {.shape = at, .radiance = {radiance[0], radiance[1], radiance[2]}, .centre = is->corner};
    double seen = PI * is->radius * is->radius; /* from far away */
    l.radius = is->radius;
    l.area = 4 * seen;
    if (is->kind == SHAPE_RECTANGLE) {
        l.centre = along(along(is->corner, 0.5, is->edge_u), 0.5, is->edge_v);
        l.radius = 0.5 * length(add(is->edge_u, is->edge_v));
        l.area = seen = length(cross(is->edge_u, is->edge_v));
    }
    l.power = luminance(radiance) * seen;
    return l;
}

static double pixel_light(const image *map, int x, int y)
{
    double sum = 0;
    for (int k = y > 0 ? y - 1 : y; k <= y + 1 && k < map->height; k++)
        for (int i = x - 1; i <= x + 1; i++) {
            const float *p = image_pixel(map, (i + map->width) % map->width, k);
            const float size[3] = {fabsf(p[0]), fabsf(p[1]), fabsf(p[2])};
            sum += luminance(size);
        }
    return sum;
}

/* Divides sums by the last of them; 0: all are 0. */
static int normalise(float *sums, int count)
{
    float all = sums[count - 1];
    for (int i = 0; i < count; i++)
        sums[i] = all > 0.0f ? fminf(sums[i] / all, 1.0f) : (float)(i + 1) / (float)count;
    return all > 0.0f;
}

/* 0 if there is no memory. An image is drawn if the mean square of its light is `even` times the square of its mean:
 * below that, drawing costs more than it gives. */
static int sum_up(environment *e)
{
    static const double even = 2;
    const size_t width = (size_t)e->map->width, height = (size_t)e->map->height;
    double all = 0, square = 0, area = 0;
    e->rows = calloc(height, sizeof *e->rows);
    e->cells = calloc(width * height, sizeof *e->cells);
    const int is_made = e->rows && e->cells;
    for (size_t y = 0; y < height && is_made; y++) {
        const double sine = sin(PI * ((double)y + 0.5) / (double)height);
        float *row = e->cells + y * width;
        double sum = 0;
        for (size_t x = 0; x < width; x++) {
            const double here = pixel_light(e->map, (int)x, (int)y);
            row[x] = (float)(sum += here);
            square += here * here * sine;
        }
        normalise(row, e->map->width);
        e->rows[y] = (float)(all += sum * sine);
        area += sine * (double)width;
    }
    if (is_made && (!normalise(e->rows, e->map->height) || square * area < even * all * all)) {
        free(e->rows);
        e->rows = NULL;
    }
    return is_made;
}

int lights_make(scene *s)
{
    for (size_t i = 0; i < s->geometry.count; i++) {
        const material *m = &s->materials[s->geometry.shapes[i].material];
        if (m->kind != MATERIAL_LIGHT || !(luminance(m->colour) > 0))
            continue;
        if (s->light_count == SCENE_LIGHTS_MAX)
            return 0;
        s->lights[s->light_count++] = emitter_of(s, (uint32_t)i);
    }
    return !s->environment.map || sum_up(&s->environment);
}

int lights_any(const scene *s)
{
    return s->light_count > 0 || s->environment.rows != NULL;
}

/* ---- choosing ---- */

static double sends(const scene *s, const emitter *l, vec3 place)
{
    const shape *is = &s->geometry.shapes[l->shape];
    const vec3 way = subtract(place, l->centre);
    if (is->kind == SHAPE_RECTANGLE ? !(dot(way, cross(is->edge_u, is->edge_v)) > 0)
                                    : !(dot(way, way) > l->radius * l->radius))
        return 0;
    return l->power / (dot(way, way) + l->radius * l->radius);
}

/* The probabilities of all lights; returns that of the environment. */
static double choices(const scene *s, vec3 place, double part[SCENE_LIGHTS_MAX])
{
    double sum = 0;
    for (size_t i = 0; i < s->light_count; i++)
        sum += part[i] = sends(s, &s->lights[i], place);
    double far = !s->environment.rows ? 0 : sum > 0 ? 0.5 : 1;
    for (size_t i = 0; i < s->light_count && sum > 0; i++)
        part[i] *= (1 - far) / sum;
    return far;
}

/* 1 - cos of the half angle of the cone that a sphere fills, without the difference, which would cancel. */
static double cone_height(const emitter *l, double square)
{
    double sine = l->radius * l->radius / square;
    return sine < 1 ? sine / (1 + sqrt(1 - sine)) : 0;
}

/* ---- the environment ---- */

/* u in [0, 1), v in [0, 1]. */
static void to_image(const environment *e, vec3 w, double *u, double *v)
{
    double turns = 0.5 + atan2(w.x, -w.z) / (2 * PI) + e->turn;
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
    to_image(e, direction, &u, &v);
    image_bilinear(e->map, u, fmin(fmax(v, half), 1 - half), rgb); /* not across the poles */
    for (int i = 0; i < 3; i++)
        rgb[i] *= e->scale;
}

static double row_top(const image *map, int y)
{
    return cos(PI * y / map->height);
}

static double pixel_density(const environment *e, int x, int y)
{
    const float *row = e->cells + (size_t)y * (size_t)e->map->width;
    double of_row = (double)(e->rows[y] - (y ? e->rows[y - 1] : 0.0f));
    double of_pixel = (double)(row[x] - (x ? row[x - 1] : 0.0f));
    return of_row * of_pixel * e->map->width / (2 * PI * (row_top(e->map, y) - row_top(e->map, y + 1)));
}

/* The first sum above *u; *u becomes the place in its part. */
static int draw_part(const float *sums, int count, double *u)
{
    int low = 0, high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if ((double)sums[middle] > *u)
            high = middle;
        else
            low = middle + 1;
    }
    double before = low ? (double)sums[low - 1] : 0;
    *u = fmin((*u - before) / ((double)sums[low] - before), 1);
    return low;
}

static void draw_environment(const environment *e, double u, double v, light_sample *sample)
{
    int y = draw_part(e->rows, e->map->height, &v);
    int x = draw_part(e->cells + (size_t)y * (size_t)e->map->width, e->map->width, &u);
    double height = row_top(e->map, y) + v * (row_top(e->map, y + 1) - row_top(e->map, y));
    double longitude = 2 * PI * ((x + u) / e->map->width - 0.5 - e->turn),
           sine = sqrt(fmax(1 - height * height, 0));
    sample->direction = vec(sine * sin(longitude), height, -sine * cos(longitude));
    sample->distance = HUGE_VAL;
    sample->density = pixel_density(e, x, y);
    environment_radiance(e, sample->direction, sample->radiance);
}

double environment_density(const scene *s, vec3 place, vec3 direction)
{
    const environment *e = &s->environment;
    double part[SCENE_LIGHTS_MAX], u, v;
    if (!e->rows)
        return 0;
    to_image(e, direction, &u, &v);
    int x = (int)fmin(u * e->map->width, e->map->width - 1), y = (int)fmin(v * e->map->height, e->map->height - 1);
    return choices(s, place, part) * pixel_density(e, x, y);
}

/* ---- lights ---- */

static int draw_rectangle(const emitter *l, const shape *is, vec3 place, double u, double v, light_sample *sample)
{
    vec3 way = subtract(along(along(is->corner, u, is->edge_u), v, is->edge_v), place);
    sample->distance = length(way);
    sample->direction = scale(way, 1 / sample->distance);
    double cosine = -dot(sample->direction, unit(cross(is->edge_u, is->edge_v)));
    sample->density = dot(way, way) / (l->area * cosine);
    return cosine > 0 && sample->distance > 0;
}

static int draw_sphere(const emitter *l, vec3 place, double u, double v, light_sample *sample)
{
    vec3 way = subtract(l->centre, place);
    double square = dot(way, way), height = cone_height(l, square), fall = u * height; /* 1 - cos */
    double sine_square = fall * (2 - fall), sine = sqrt(sine_square);
    frame f = frame_about(scale(way, 1 / sqrt(square)), vec(1, 0, 0));
    vec3 across = along(scale(f.x, sine * cos(2 * PI * v)), sine * sin(2 * PI * v), f.y);
    sample->direction = unit(along(across, 1 - fall, f.z));
    sample->distance = sqrt(square) * (1 - fall) - sqrt(fmax(l->radius * l->radius - square * sine_square, 0));
    sample->density = 1 / (2 * PI * height);
    return sample->distance > 0;
}

int lights_draw(const scene *s, vec3 place, const double u[3], light_sample *sample)
{
    double part[SCENE_LIGHTS_MAX], far = choices(s, place, part), left = u[0] - far;
    if (left < 0) {
        draw_environment(&s->environment, u[1], u[2], sample);
        sample->density *= far;
        return sample->density > 0;
    }
    for (size_t i = 0; i < s->light_count; i++) {
        const emitter *l = &s->lights[i];
        const shape *is = &s->geometry.shapes[l->shape];
        if (!(part[i] > 0) || (left -= part[i]) >= 0)
            continue;
        int is_seen = is->kind == SHAPE_RECTANGLE ? draw_rectangle(l, is, place, u[1], u[2], sample)
                                                  : draw_sphere(l, place, u[1], u[2], sample);
        sample->density *= part[i];
        for (int k = 0; k < 3; k++)
            sample->radiance[k] = l->radiance[k];
        return is_seen;
    }
    return 0; /* none sends, or rounding leaves a part of 1e-16 */
}

double lights_density(const scene *s, vec3 place, vec3 direction, const hit *h)
{
    double part[SCENE_LIGHTS_MAX];
    size_t i = 0;
    while (i < s->light_count && &s->geometry.shapes[s->lights[i].shape] != h->shape)
        i++;
    if (i == s->light_count)
        return 0;
    choices(s, place, part);
    const emitter *l = &s->lights[i];
    vec3 way = subtract(h->shape->kind == SHAPE_RECTANGLE ? h->place : l->centre, place);
    double square = dot(way, way), cosine = -dot(direction, h->normal);
    if (h->shape->kind == SHAPE_RECTANGLE)
        return cosine > 0 ? part[i] * square / (l->area * cosine) : 0;
    double height = cone_height(l, square);
    return height > 0 ? part[i] / (2 * PI * height) : 0;
}
