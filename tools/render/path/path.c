/* A path: from the eye through surfaces to light. At each surface the path draws a light and weighs it against the
 * material; then the material draws the direction in which the path goes on. Light that this direction meets is
 * weighed against the lights (parts.h). The loop is compiled four times, with and without lights to draw and
 * absorption. */
#include "render/path/media.h"
#include "render/path/parts.h"

#include "cli/random.h"

struct path_walk {
    const path_plan *plan;
    path_counts *counts;
    random_stream random;
    ray ray;
    float throughput[3], radiance[3];
    float carried;    /* the factor of refraction in the throughput */
    float density;    /* of the direction, if lights could have drawn it; else 0 */
    light_view view;  /* the lights from the place where it was drawn */
    path_media media; /* for scenes that absorb */
};

static void draw(path_walk *w, float u[3])
{
    for (int i = 0; i < 3; i++)
        u[i] = random_float(&w->random);
}

static void gain(path_walk *w, const float radiance[3], float weight)
{
    for (int i = 0; i < 3; i++)
        w->radiance[i] += w->throughput[i] * radiance[i] * weight;
}

/* The weight of an estimate of density `mine` beside another of density `other`. */
static float share(float mine, float other)
{
    float ratio = other / mine;
    return 1.0f / (1.0f + ratio * ratio);
}

/* ---- light that is met ---- */

static inline void meet_environment(path_walk *w, int lit)
{
    const path_plan *plan = w->plan;
    int weighs = lit && w->density > 0.0f && plan->environment.cells;
    float rgb[3], density = 0.0f;
    if (!(plan->effects & EFFECT_ENVIRONMENT))
        return;
    plan->environment.radiance(&plan->environment, w->ray.direction, rgb, weighs ? &density : NULL);
    gain(w, rgb, weighs ? share(w->density, w->view.environment * density) : 1.0f);
}

static inline void meet_light(path_walk *w, const path_material *m, const hit *h, int lit)
{
    float weight = 1.0f;
    if (!(dot(w->ray.direction, h->normal) < 0.0f))
        return;
    if (lit && w->density > 0.0f && w->plan->lights.count)
        weight = share(w->density, path_lights_density(&w->plan->lights, &w->view, w->ray.direction, h));
    gain(w, m->colour, weight);
}

/* ---- a surface ---- */

static frame geometric_frame(const hit *h)
{
    frame f = {h->shading.x, h->shading.y, h->normal};
    vndf_vec3 x = subtract(f.x, scale(f.z, dot(f.x, f.z)));
    f.x = dot(x, x) > 1e-6f ? unit(x) : unit(cross(h->shading.y, f.z));
    f.y = cross(f.z, f.x);
    return f;
}

/* 0: the material scatters nothing. */
static inline int begin(path_point *p, const path_material *m, const hit *h, vndf_vec3 direction)
{
    vndf_vec3 wi = scale(direction, -1.0f);
    p->material = m;
    p->hit = h;
    p->frame = h->shading;
    p->colour = m->colour;
    p->wi = unit(to_frame(&p->frame, wi));
    float side = dot(wi, h->normal);
    if (!(p->wi.z * side > 0.0f)) {
        p->frame = geometric_frame(h);
        p->wi = unit(to_frame(&p->frame, wi));
    }
    return m->run.begin(p);
}

/* ---- light that is drawn ---- */

/* Draws one of the two kinds of light. */
static int draw_light(path_walk *w, light_sample *s)
{
    const path_plan *plan = w->plan;
    uint64_t choice = random_bits(&w->random);
    float u[3];
    draw(w, u);
    if (u[0] < w->view.lights)
        return path_lights_draw(&plan->lights, &w->view, choice, u, s);
    if (!(w->view.environment > 0.0f))
        return 0;
    path_environment_draw(&plan->environment, choice, u + 1, s);
    s->density *= w->view.environment;
    return 1;
}

static int is_barred(path_walk *w, const path_point *p, const light_sample *s)
{
    const geometry *g = &w->plan->scene->geometry;
    ray r = ray_from(p->hit, s->direction);
    w->counts->shadow_rays++;
    if (!s->radiance)
        return geometry_blocked(g, &r);
    r.to = s->distance;
    return geometry_hides(g, &r, s->shape);
}

static void add_light(path_walk *w, const light_sample *s, float value[3], float weight)
{
    const path_environment *e = &w->plan->environment;
    float far[3];
    const float *radiance = s->radiance ? s->radiance : far;
    if (!s->radiance)
        e->radiance(e, s->direction, far, NULL);
    for (int i = 0; i < 3; i++)
        value[i] *= radiance[i];
    gain(w, value, weight);
}

/* The cheap tests come first. */
static inline void reach_light(path_walk *w, const path_point *p, int absorbing)
{
    float value[3];
    light_sample s;
    path_lights_look(&w->plan->lights, w->plan->environment.power, p->hit->place, p->hit->normal, &w->view);
    if (!draw_light(w, &s) || !(dot(s.direction, p->hit->normal) > 0.0f))
        return;
    vndf_vec3 wo = unit(to_frame(&p->frame, s.direction));
    if (!(wo.z > 0.0f))
        return;
    float cosine = p->material->run.eval(p, wo, random_bits(&w->random), value);
    if (!(cosine > 0.0f) || !(value[0] + value[1] + value[2] > 0.0f) || is_barred(w, p, &s))
        return;
    if (absorbing) /* the light is outside of the surface, the path may be inside */
        media_absorb(&w->media, p->wi.z < 0.0f ? p->material : NULL, s.distance, value);
    add_light(w, &s, value, cosine / s.density * share(s.density, p->material->run.pdf(p, wo)));
}

/* ---- going on ---- */

/* 0: the path ends. */
static inline int go_on(path_walk *w, const path_point *p, int absorbing)
{
    float u[3];
    bounce b;
    draw(w, u);
    if (!p->material->run.sample(p, u, &b))
        return 0;
    vndf_vec3 direction = unit(from_frame(&p->frame, b.wo));
    float side = dot(direction, p->hit->normal);
    if (!(side * b.wo.z > 0.0f))
        return 0;
    if (absorbing && p->wi.z * b.wo.z < 0.0f) {
        if (side < 0.0f)
            media_enter(&w->media, p->material);
        else
            media_leave(&w->media, p->material);
    }
    for (int i = 0; i < 3; i++)
        w->throughput[i] *= b.weight[i];
    w->carried *= b.carried;
    w->density = side > 0.0f ? b.density : 0.0f;
    w->ray = ray_from(p->hit, direction);
    return 1;
}

/* Leaves out the factor of refraction, which the way out undoes: it says nothing about the worth of a path. */
static int survives(path_walk *w)
{
    float worth = fmaxf(fmaxf(w->throughput[0], w->throughput[1]), w->throughput[2]) / w->carried;
    if (worth >= 1.0f)
        return 1;
    if (!(random_float(&w->random) < worth))
        return 0;
    for (int i = 0; i < 3; i++)
        w->throughput[i] /= worth;
    return 1;
}

static inline void trace(path_walk *w, int lit, int absorbing)
{
    const scene *s = w->plan->scene;
    path_point p;
    hit h;
    for (unsigned surface = 1;; surface++) {
        w->counts->segments++;
        if (!geometry_hit(&s->geometry, &w->ray, &h)) {
            meet_environment(w, lit);
            return;
        }
        const path_material *m = &w->plan->materials[h.material];
        if (absorbing)
            media_absorb(&w->media, NULL, h.distance, w->throughput);
        if (m->emits) {
            meet_light(w, m, &h, lit);
            return;
        }
        if (surface > s->integrator.depth || !begin(&p, m, &h, w->ray.direction))
            return;
        if (lit && m->run.eval)
            reach_light(w, &p, absorbing);
        if (!go_on(w, &p, absorbing) || (surface >= s->integrator.roulette && !survives(w)))
            return;
    }
}

static void trace_plain(path_walk *w)
{
    trace(w, 0, 0);
}

static void trace_lit(path_walk *w)
{
    trace(w, 1, 0);
}

static void trace_absorbing(path_walk *w)
{
    trace(w, 0, 1);
}

static void trace_lit_absorbing(path_walk *w)
{
    trace(w, 1, 1);
}

void (*path_loop(int lit, int absorbing))(path_walk *w)
{
    if (absorbing)
        return lit ? trace_lit_absorbing : trace_absorbing;
    return lit ? trace_lit : trace_plain;
}

/* ---- from the eye ---- */

/* The random numbers of a path are a stream of their own: a hash of seed, pixel and index. */
static random_stream stream_of(uint64_t seed, uint64_t pixel, uint64_t index)
{
    uint64_t of_pixel = random_from(random_from(seed).start ^ pixel).start;
    return random_from(of_pixel ^ index);
}

static ray ray_of(const path_plan *plan, float x, float y)
{
    vndf_vec3 way = add(plan->corner, add(scale(plan->right, x), scale(plan->down, y)));
    ray r = {plan->scene->camera.from, unit(way), 0.0f, INFINITY};
    return r;
}

void path_trace(const path_plan *plan, int x, int y, uint64_t index, uint64_t seed, path_counts *counts,
                float rgb[3])
{
    uint64_t pixel = (uint64_t)y * (uint64_t)plan->scene->width + (uint64_t)x;
    path_walk w = {.plan = plan,
                   .counts = counts,
                   .random = stream_of(seed, pixel, index),
                   .throughput = {1, 1, 1},
                   .carried = 1};
    float dx = random_float(&w.random), dy = random_float(&w.random);
    w.ray = ray_of(plan, (float)x + dx, (float)y + dy);
    counts->paths++;
    plan->trace(&w);
    int good = isfinite(w.radiance[0] + w.radiance[1] + w.radiance[2]);
    counts->samples_lost += !good;
    for (int i = 0; i < 3; i++)
        rgb[i] = good ? w.radiance[i] : 0.0f;
}
