/* Batches one element after the other, by the calls for one: single elements, mixtures, and all where the compiler has
 * no lanes. */
#include "sampler/batch/elements.h"
#include "sampler/sampler.h"

static float number(const vndf_call *c, int which, size_t i)
{
    const float *array = c->read[which];
    return array ? array[c->shared >> which & 1 ? 0 : i] : 0.0f;
}

static vndf_vec3 triple(const vndf_call *c, int first, size_t i)
{
    vndf_vec3 v = {number(c, first, i), number(c, first + 1, i), number(c, first + 2, i)};
    return v;
}

/* ---- surfaces ---- */

/* A roughness that is not above 0 is invalid: it has no distribution. */
static vndf_affine surface_at(const vndf_call *c, size_t i)
{
    vndf_affine s = {c->distribution,
                     number(c, VNDF_READ_XX, i),
                     number(c, VNDF_READ_XY, i),
                     number(c, VNDF_READ_YX, i),
                     number(c, VNDF_READ_YY, i),
                     number(c, VNDF_READ_MEAN_X, i),
                     number(c, VNDF_READ_MEAN_Y, i)};
    if (c->diagonal && !(s.xx > 0.0f && s.yy > 0.0f))
        s.distribution = NULL;
    return s;
}

static vndf_view view_at(const vndf_call *c, const vndf_affine *s, vndf_vec3 wi)
{
    const vndf_surface plain = {s->distribution, s->xx, s->yy};
    return c->diagonal ? vndf_view_from(&plain, wi) : vndf_affine_view_from(s, wi);
}

static void sample(const vndf_call *c, size_t i, const vndf_view *view)
{
    float u1 = c->read[VNDF_READ_A][i], u2 = c->read[VNDF_READ_B][i], *pdf = c->write[3] ? &c->write[3][i] : NULL;
    vndf_vec3 wm =
        c->write[4] ? vndf_sample_weight(view, u1, u2, pdf, &c->write[4][i]) : vndf_sample(view, u1, u2, pdf);
    c->write[0][i] = wm.x;
    c->write[1][i] = wm.y;
    c->write[2][i] = wm.z;
}

static void one(const vndf_call *c, size_t i)
{
    const vndf_affine surface = surface_at(c, i);
    const vndf_vec3 wi = triple(c, VNDF_READ_WI_X, i), wm = triple(c, VNDF_READ_A, i);
    vndf_view view;
    float *to = &c->write[0][i], numbers[2];
    if (c->task < VNDF_TASK_NDF)
        view = view_at(c, &surface, wi);
    switch (c->task) {
    case VNDF_TASK_SAMPLE: sample(c, i, &view); break;
    case VNDF_TASK_PDF: *to = vndf_pdf(&view, wm); break;
    case VNDF_TASK_VISIBLE: *to = vndf_visible(&view, wm); break;
    case VNDF_TASK_INVERT:
        vndf_invert(&view, wm, &numbers[0], &numbers[1]);
        *to = numbers[0];
        c->write[1][i] = numbers[1];
        break;
    case VNDF_TASK_NDF: *to = vndf_affine_ndf(&surface, wm); break;
    case VNDF_TASK_DRAWN_AREA: break; /* lanes alone ask for it */
    case VNDF_TASK_AREA: *to = vndf_affine_projected_area(&surface, wi); break;
    case VNDF_TASK_LAMBDA: *to = vndf_affine_lambda(&surface, wi); break;
    case VNDF_TASK_G1: *to = vndf_affine_g1(&surface, wi); break;
    }
}

void vndf_one_by_one(const vndf_call *call)
{
    for (size_t i = 0; i < call->count; i++)
        one(call, i);
}

/* ---- mixtures ---- */

static vndf_mixture mixture_at(const vndf_mixture_call *c, size_t i)
{
    vndf_mixture m;
    m.count = c->lobes;
    for (int l = 0; l < c->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        m.lobe[l].surface = surface_at(&c->lobe[l], i);
        m.lobe[l].weight = number(&c->lobe[l], VNDF_READ_WEIGHT, i);
    }
    return m;
}

static void sample_mixture(const vndf_mixture_call *c, size_t i, const vndf_mixture_view *view)
{
    int *lobe = c->drawn ? &c->drawn[i] : NULL;
    vndf_vec3 wm = vndf_mixture_sample(view, c->lobe[0].read[VNDF_READ_A][i], c->lobe[0].read[VNDF_READ_B][i],
                                       c->write[3] ? &c->write[3][i] : NULL, lobe);
    c->write[0][i] = wm.x;
    c->write[1][i] = wm.y;
    c->write[2][i] = wm.z;
}

static void one_mixture(const vndf_mixture_call *c, size_t i)
{
    const vndf_mixture m = mixture_at(c, i);
    const vndf_vec3 wi = triple(&c->lobe[0], VNDF_READ_WI_X, i), wm = triple(&c->lobe[0], VNDF_READ_A, i);
    vndf_mixture_view view;
    float *to = &c->write[0][i], numbers[2];
    int lobe;
    if (c->task < VNDF_TASK_NDF)
        view = vndf_mixture_view_from(&m, wi);
    switch (c->task) {
    case VNDF_TASK_SAMPLE: sample_mixture(c, i, &view); break;
    case VNDF_TASK_PDF: *to = vndf_mixture_pdf(&view, wm); break;
    case VNDF_TASK_VISIBLE: *to = vndf_mixture_visible(&view, wm); break;
    case VNDF_TASK_INVERT:
        lobe = vndf_mixture_invert(&view, wm, c->asked ? c->asked[i] : -1, &numbers[0], &numbers[1]);
        *to = numbers[0];
        c->write[1][i] = numbers[1];
        if (c->drawn)
            c->drawn[i] = lobe;
        break;
    case VNDF_TASK_NDF: *to = vndf_mixture_ndf(&m, wm); break;
    case VNDF_TASK_DRAWN_AREA: break; /* lanes alone ask for it */
    case VNDF_TASK_AREA: *to = vndf_mixture_projected_area(&m, wi); break;
    case VNDF_TASK_LAMBDA: *to = vndf_mixture_lambda(&m, wi); break;
    case VNDF_TASK_G1: *to = vndf_mixture_g1(&m, wi); break;
    }
}

void vndf_mixture_one_by_one(const vndf_mixture_call *call)
{
    for (size_t i = 0; i < call->count; i++)
        one_mixture(call, i);
}
