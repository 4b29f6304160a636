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

#include "cli/random.h"
#include "render/lines.h"

enum { CANDIDATES = 32 };

const char *const path_sampler_names[SAMPLERS + 1] = {"visible", "all", "perfect", NULL};

struct path_plan {
    const scene *scene;
    path_sampler sampler;
    vndf_material materials[SCENE_MATERIALS_MAX];
    vec3 corner, right, down; /* of the film at distance 1 from the eye: pixels are at corner + x right + y down */
};

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

path_plan *path_prepare(const scene *s, path_sampler sampler, vndf_error *error)
{
    path_plan *plan = calloc(1, sizeof *plan);
    if (!plan)
        return refuse_at(error, "materials", 0, "there is no memory for %zu", s->material_count), NULL;
    for (size_t i = 0; i < s->material_count; i++) {
        const material *m = &s->materials[i];
        vndf_description is = m->is;
        vndf_error why = {VNDF_OK, ""};
        is.effects.normals = sampler == SAMPLER_ALL ? VNDF_NORMALS_ALL : VNDF_NORMALS_VISIBLE;
        if (m->kind != MATERIAL_ROUGH || vndf_material_resolve(&is, &plan->materials[i], &why) == VNDF_OK)
            continue;
        free(plan);
        snprintf(error->message, sizeof error->message, "material '%s' cannot have the sampler '%s': %.300s",
                 m->name, path_sampler_names[sampler], why.message);
        return NULL;
    }
    const vec3 forward = unit(subtract(s->to, s->from)), right = unit(cross(forward, s->up));
    const double step = 2 * tan(0.5 * s->field) / s->height;
    plan->scene = s;
    plan->sampler = sampler;
    plan->right = scale(right, step);
    plan->down = scale(cross(forward, right), step);
    plan->corner = along(along(forward, -0.5 * s->width, plan->right), -0.5 * s->height, plan->down);
    return plan;
}
