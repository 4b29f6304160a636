#include "bsdf/walk/walk.h"

#include "bsdf/walk/path.h"

/* A walk that leaves towards -back. On the other side all of space is turned about. */
static void leave(const vndf_bsdf *b, const vndf_walk *walk, const vndf_walk_path *path, vndf_vec3 back,
                  vndf_scattered *s)
{
    double factor = vndf_walk_transport(walk, path->turned);
    vndf_vec3 wo = vndf_turned(back, path->turned ? 1.0f : -1.0f);
    s->wo = vndf_turned(wo, b->side);
    s->wm = vndf_vec3_of(0.0f, 0.0f, 0.0f);
    s->density = vndf_positive(vndf_walk_pdf(b, wo));
    s->lobe = path->turned ? VNDF_LOBE_TRANSMISSION : VNDF_LOBE_REFLECTION;
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_density_from(path->weight[i] * factor);
}

/* The first normal is drawn with u[0] and u[1], its lobe with u[2]; all other numbers are a hash of the three. */
static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_walk walk = vndf_walk_of(b);
    vndf_walk_path path;
    float pair[2] = {u[0], u[1]};
    double lobe = (double)vndf_clamp_unit(u[2]);
    vndf_walk_enter(&walk, &b->view.of.one, b->wi, vndf_walk_seed_of(u), &path);
    vndf_scatter_nothing(s);
    for (unsigned order = 1; order <= b->material->is.order_limit; order++) {
        vndf_vec3 back = vndf_walk_bounce(&walk, &path, pair[0], pair[1], lobe);
        if (vndf_walk_is_dark(&walk, &path))
            return;
        if (!vndf_walk_travel(&walk, &path, back)) {
            leave(b, &walk, &path, back, s);
            return;
        }
        lobe = vndf_walk_numbers(&walk, &path, pair);
    }
}

static void eval(const vndf_bsdf *b, vndf_vec3 given, uint64_t seed, float *value, float *pdf)
{
    vndf_vec3 wo = vndf_turned(given, b->side);
    double f[VNDF_WAVELENGTHS];
    int transmits = b->material->is.effects.lobes != VNDF_LOBES_REFLECTION;
    vndf_see_nothing(b, value, pdf);
    if (!vndf_is_near_unit(wo) || !(transmits ? wo.z != 0.0f : wo.z > 0.0f))
        return;
    if (pdf)
        *pdf = vndf_walk_pdf(b, wo);
    if (!value)
        return;
    vndf_walk_eval(b, wo, seed, f);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] = vndf_density_from(f[i] / fabs((double)wo.z));
}

const vndf_routines vndf_routines_walk = {NULL, sample, eval, NULL};

/* ---- eta = 1 ---- */

static void sample_unbent(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    (void)u;
    vndf_scatter_nothing(s);
    s->wo = vndf_turned(b->wi, -b->side);
    s->density = 1.0f;
    s->lobe = VNDF_LOBE_STRAIGHT;
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = 1.0f;
}

static void eval_unbent(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)wo;
    (void)seed;
    vndf_see_nothing(b, value, pdf);
}

const vndf_routines vndf_routines_unbent = {NULL, sample_unbent, eval_unbent, NULL};
