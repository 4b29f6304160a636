/* A path: from the eye through surfaces to light. At each surface it draws a light and weighs it against the
 * material; then the material draws the direction in which the path goes on, and light that this direction meets
 * is weighed against the lights: by the squares of the two densities (Veach & Guibas, "Optimally Combining
 * Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995). Lights are drawn for directions to the outside
 * of a surface only: inside a closed body its own surface hides them, and the material alone finds their light.
 *
 * Perfect sampling draws directions in proportion to f |cos|, the aim that others are measured by, whatever it
 * costs: it takes CANDIDATES samples of visible normals and keeps one in proportion to its weight (resampling:
 * Talbot, Cline & Egbert, EGSR 2005). The weight of that is the mean of all weights, whose variance is that of
 * visible normals over CANDIDATES; no table is made, and any material has it. */
#include "render/film.h"

#include <float.h>
#include <stdlib.h>

#include "cli/arguments.h"
#include "cli/random.h"

enum { CANDIDATES = 32 };

const char *const path_sampler_names[SAMPLERS + 1] = {"visible", "all", "perfect", NULL};

struct path_plan {
    const scene *scene;
    path_sampler sampler;
    vndf_material materials[SCENE_MATERIALS_MAX];
    vec3 corner, right, down; /* of the film at distance 1 from the eye: pixels are at corner + x right + y down */
};

/* ---- light that is drawn ----
 *
 * Half of all draws, or all where no light shines, are of the image of the environment, the others of lights, which
 * are as likely as one another. On a rectangle a point is drawn evenly by area, for a sphere a direction evenly in
 * the cone that it fills, in the image a pixel by its light and then a direction in it evenly by solid angle.
 *
 * Pixels count by the light of 3 x 3 of them, so that the density is positive wherever the image, which is
 * interpolated between pixels, is. An image that is nearly even is not drawn: every direction finds its light. */

typedef struct light_sample {
    vec3 direction; /* towards the light, unit */
    double distance;
    double density; /* per steradian */
    float radiance[3];
} light_sample;

/* u and v in [0, 1]. */
static void place_in_image(const environment *e, vec3 w, double *u, double *v)
{
    const double turns = 0.5 + atan2(w.x, -w.z) / (2 * PI) + e->turn / 360;
    *u = turns - floor(turns);
    *v = atan2(hypot(w.x, w.z), w.y) / PI;
}

static void environment_radiance(const environment *e, vec3 direction, float rgb[3])
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
    e->drawn = sum > 0 && square >= even * sum * sum;
    return e->sums != NULL;
}

/* The density per steradian of directions in a pixel. */
static double pixel_density(const environment *e, size_t i)
{
    const size_t last = (size_t)e->map->width * (size_t)e->map->height - 1;
    const double chance = (e->sums[i] - (i ? e->sums[i - 1] : 0)) / e->sums[last];
    double fall;
    row_top(e->map, i, &fall);
    return e->drawn * chance * e->map->width / (2 * PI * fall);
}

/* The pixel of the first sum above u, which gives the place across it, too. */
static void draw_environment(const environment *e, double u, double v, light_sample *sample)
{
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
        2 * PI * (((double)(low % (size_t)e->map->width) + across) / e->map->width - 0.5 - e->turn / 360);
    const double sine = sqrt(fmax(1 - height * height, 0));
    sample->direction = vec(sine * sin(longitude), height, -sine * cos(longitude));
    sample->distance = HUGE_VAL;
    sample->density = pixel_density(e, low);
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
    if (s->environment.map && !sum_up(&s->environment))
        return 0;
    s->environment.drawn *= s->light_count ? 0.5 : 1;
    return 1;
}

static int lights_any(const scene *s)
{
    return s->light_count > 0 || s->environment.drawn > 0;
}

static int lights_draw(const scene *s, vec3 place, const double u[3], light_sample *sample)
{
    const double from = s->environment.drawn;
    if (u[0] < from)
        draw_environment(&s->environment, u[1], u[2], sample);
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

static double lights_density(const scene *s, vec3 place, vec3 direction, const hit *h)
{
    const environment *e = &s->environment;
    double u, v;
    if (h)
        return shape_density(h->shape, place, direction, h->place) * (1 - e->drawn) / (double)s->light_count;
    if (!(e->drawn > 0))
        return 0;
    place_in_image(e, direction, &u, &v);
    const int x = (int)fmin(u * e->map->width, e->map->width - 1);
    const int y = (int)fmin(v * e->map->height, e->map->height - 1);
    return pixel_density(e, (size_t)y * (size_t)e->map->width + (size_t)x);
}

/* ---- a material at a hit ---- */

typedef struct surface {
    const path_plan *plan;
    const material *is;
    frame frame;  /* of shading; geometric where the two differ about the side of the ray */
    vndf_vec3 wi; /* in that frame */
    float colour[3];
    vndf_bsdf bsdf; /* of rough materials */
} surface;

typedef struct bounce {
    vndf_vec3 wo;    /* in the frame */
    float weight[3]; /* f |cos| / density */
    double density;  /* 0: a Dirac, which nothing else finds */
    double carried;  /* the factor of refraction in the weight: 1 or 1/eta^2 */
} bounce;

static vndf_vec3 into_frame(const frame *f, vec3 w)
{
    return narrow(unit(vec(dot(f->x, w), dot(f->y, w), dot(f->z, w))));
}

/* 0: the material scatters nothing. */
static int begin(surface *s, const path_plan *plan, const hit *h, vec3 direction)
{
    const vec3 wi = scale(direction, -1);
    const material *is = &plan->scene->materials[h->shape->material];
    float map[3] = {1.0f, 1.0f, 1.0f};
    s->plan = plan;
    s->is = is;
    s->frame = h->shading;
    if (!(dot(wi, h->shading.z) * dot(wi, h->normal) > 0))
        s->frame = frame_about(h->normal, h->shading.x);
    s->wi = into_frame(&s->frame, wi);
    if (is->colour_map)
        image_bilinear(is->colour_map, h->u, h->v, map);
    for (int i = 0; i < 3; i++)
        s->colour[i] = is->colour[i] * map[i];
    if (is->kind != MATERIAL_ROUGH)
        return s->wi.z > 0.0f;
    if (is->alpha_map)
        image_bilinear(is->alpha_map, h->u, h->v, map);
    const vndf_surface rough = vndf_rough(NULL, is->is.surface.xx * map[0], is->is.surface.yy * map[0]);
    return vndf_bsdf_on(&s->bsdf, &plan->materials[h->shape->material], is->alpha_map ? &rough : NULL, s->wi);
}

/* f |cos| without the colour; returns the density with which the material draws wo. Perfect sampling of an albedo
 * near 1 has the density f |cos|; random walks know f by chance only, which no weight may depend on. */
static double evaluate(const surface *s, vndf_vec3 wo, uint64_t seed, float value[3])
{
    float pdf = fmaxf(wo.z, 0.0f) / (float)PI;
    value[0] = value[1] = value[2] = pdf;
    if (s->is->kind == MATERIAL_MATTE)
        return (double)pdf;
    vndf_bsdf_eval_pdf(&s->bsdf, wo, seed, value, &pdf);
    for (int i = 0; i < 3; i++)
        value[i] *= fabsf(wo.z);
    const int is_walk = s->is->is.effects.scattering == VNDF_SCATTERING_MULTIPLE;
    return s->plan->sampler == SAMPLER_PERFECT && !is_walk ? fmax(luminance(value), DBL_MIN) : (double)pdf;
}

/* A sample of a matte surface, or of the library: 0 if it is lost. */
static int sample_normals(const surface *s, random_stream *random, bounce *b)
{
    float u[3];
    for (int i = 0; i < 3; i++)
        u[i] = random_float(random);
    if (s->is->kind == MATERIAL_MATTE) {
        const float turn = 2.0f * (float)PI * u[1], radius = sqrtf(u[0]), height = sqrtf(1.0f - u[0]);
        *b = (bounce){
            {radius * cosf(turn), radius * sinf(turn), height}, {1.0f, 1.0f, 1.0f}, (double)height / PI, 1};
        return height > 0.0f;
    }
    vndf_scattered drawn;
    vndf_bsdf_sample(&s->bsdf, u, &drawn);
    const double eta = (double)s->is->is.eta, square = s->wi.z > 0.0f ? eta * eta : 1 / (eta * eta);
    *b = (bounce){drawn.wo,
                  {drawn.weight[0], drawn.weight[1], drawn.weight[2]},
                  drawn.lobe == VNDF_LOBE_STRAIGHT ? 0 : (double)drawn.density,
                  drawn.lobe == VNDF_LOBE_TRANSMISSION ? 1 / square : 1};
    return drawn.lobe != VNDF_LOBE_NONE;
}

/* Keeps one of the candidates with the probability of its weight, seen one after the other. */
static int sample_perfect(const surface *s, random_stream *random, bounce *b)
{
    double sum = 0, kept = 0;
    float value[3];
    for (int i = 0; i < CANDIDATES; i++) {
        bounce one;
        const double worth = sample_normals(s, random, &one) ? luminance(one.weight) / one.carried : 0;
        sum += worth;
        if (worth > 0 && random_double(random) * sum < worth) {
            *b = one;
            kept = worth;
        }
    }
    for (int i = 0; i < 3 && kept > 0; i++)
        b->weight[i] *= (float)(sum / (CANDIDATES * kept));
    if (kept > 0 && b->density > 0 && s->is->is.effects.scattering == VNDF_SCATTERING_SINGLE)
        b->density = evaluate(s, b->wo, 0, value);
    return kept > 0;
}

/* ---- the path ---- */

typedef struct walk {
    const path_plan *plan;
    path_counts *counts;
    random_stream random;
    ray ray;
    double throughput[3], radiance[3];
    double density; /* of the direction, if lights could have drawn it from `place`; else 0 */
    vec3 place;
} walk;

static void gain(walk *w, const float radiance[3], double weight)
{
    for (int i = 0; i < 3; i++)
        w->radiance[i] += w->throughput[i] * (double)radiance[i] * weight;
}

/* The weight of an estimate of density `mine` beside another of density `other`. */
static double share(double mine, double other)
{
    const double ratio = other / mine;
    return 1 / (1 + ratio * ratio);
}

/* Light that the ray has met, on a shape or (NULL) from far away. */
static void meet_light(walk *w, const hit *h)
{
    const scene *s = w->plan->scene;
    float far[3];
    if (!h)
        environment_radiance(&s->environment, w->ray.direction, far);
    else if (!(dot(w->ray.direction, h->normal) < 0))
        return;
    const double other = w->density > 0 ? lights_density(s, w->place, w->ray.direction, h) : 0;
    gain(w, h ? s->materials[h->shape->material].colour : far, w->density > 0 ? share(w->density, other) : 1);
}

/* Draws a light; the cheap tests come first. */
static void reach_light(walk *w, const surface *p, const hit *h)
{
    const scene *s = w->plan->scene;
    light_sample l;
    double u[3];
    float value[3];
    for (int i = 0; i < 3; i++)
        u[i] = random_double(&w->random);
    if (!lights_draw(s, h->place, u, &l) || !(dot(l.direction, h->normal) > 0))
        return;
    const vndf_vec3 wo = into_frame(&p->frame, l.direction);
    if (!(wo.z > 0.0f))
        return;
    const double density = evaluate(p, wo, random_bits(&w->random), value);
    if (!(value[0] + value[1] + value[2] > 0.0f))
        return;
    ray r = ray_from(h, l.direction);
    r.to = l.distance * (1 - 1e-9); /* the light itself hides nothing */
    w->counts->rays++;
    if (geometry_blocked(&s->geometry, &r))
        return;
    for (int i = 0; i < 3; i++)
        value[i] *= l.radiance[i] * p->colour[i];
    gain(w, value, share(l.density, density) / l.density);
}

/* 0: the path ends. */
static int go_on(walk *w, const surface *p, const hit *h)
{
    bounce b;
    const int is_perfect = p->plan->sampler == SAMPLER_PERFECT && p->is->kind == MATERIAL_ROUGH;
    if (!(is_perfect ? sample_perfect(p, &w->random, &b) : sample_normals(p, &w->random, &b)))
        return 0;
    const vec3 direction = unit(out_of(&p->frame, widen(b.wo)));
    const double side = dot(direction, h->normal);
    if (!(side * (double)b.wo.z > 0)) /* the shading normal and the geometric one disagree */
        return 0;
    for (int i = 0; i < 3; i++)
        w->throughput[i] *= (double)b.weight[i] * (double)p->colour[i];
    w->density = side > 0 && lights_any(w->plan->scene) ? b.density : 0;
    w->place = h->place;
    w->ray = ray_from(h, direction);
    return 1;
}

/* The random numbers of a path are a stream of their own: a hash of seed, pixel and index. */
void path_trace(const path_plan *plan, int x, int y, uint64_t index, uint64_t seed, path_counts *counts,
                float rgb[3])
{
    const scene *s = plan->scene;
    const uint64_t pixel = (uint64_t)y * (uint64_t)s->width + (uint64_t)x;
    walk w = {.plan = plan, .counts = counts, .throughput = {1, 1, 1}};
    surface p;
    hit h;
    w.random = random_from(random_from(random_from(seed).start ^ pixel).start ^ index);
    const double dx = random_double(&w.random), dy = random_double(&w.random);
    const vec3 to = along(along(plan->corner, x + dx, plan->right), y + dy, plan->down);
    w.ray = (ray){s->from, unit(to), HUGE_VAL};
    for (unsigned count = 1;; count++) {
        w.counts->rays++;
        const int is_met = geometry_hit(&s->geometry, &w.ray, &h);
        if (!is_met || s->materials[h.shape->material].kind == MATERIAL_LIGHT) {
            meet_light(&w, is_met ? &h : NULL);
            break;
        }
        if (count > (unsigned)s->depth || !begin(&p, plan, &h, w.ray.direction))
            break;
        if (lights_any(s))
            reach_light(&w, &p, &h);
        if (!go_on(&w, &p, &h))
            break;
    }
    const int is_good = fabs(w.radiance[0]) + fabs(w.radiance[1]) + fabs(w.radiance[2]) < (double)FLT_MAX;
    counts->lost += !is_good;
    for (int i = 0; i < 3; i++)
        rgb[i] = is_good ? (float)w.radiance[i] : 0.0f;
}

/* ---- preparing ---- */

path_plan *path_prepare(const scene *s, path_sampler sampler)
{
    path_plan *plan = calloc(1, sizeof *plan);
    if (!plan)
        return complain("vndf render", "there is no memory for %zu materials", s->material_count), NULL;
    for (size_t i = 0; i < s->material_count; i++) {
        const material *m = &s->materials[i];
        vndf_description is = m->is;
        vndf_error why = {VNDF_OK, ""};
        is.effects.normals = sampler == SAMPLER_ALL ? VNDF_NORMALS_ALL : VNDF_NORMALS_VISIBLE;
        if (m->kind != MATERIAL_ROUGH || vndf_material_resolve(&is, &plan->materials[i], &why) == VNDF_OK)
            continue;
        complain("vndf render", "material '%s' cannot have the sampler '%s': %s", m->name,
                 path_sampler_names[sampler], why.message);
        return free(plan), NULL;
    }
    const vec3 forward = unit(subtract(s->to, s->from)), right = unit(cross(forward, s->up));
    const double step = 2 * tan(0.5 * (s->field * (PI / 180))) / s->height;
    plan->scene = s;
    plan->sampler = sampler;
    plan->right = scale(right, step);
    plan->down = scale(cross(forward, right), step);
    plan->corner = along(along(forward, -0.5 * s->width, plan->right), -0.5 * s->height, plan->down);
    return plan;
}
