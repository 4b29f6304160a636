/* Batches one element after the other, by the calls for one: single elements, mixtures, and all where the compiler has
 * no lanes. */
#include "sampler/batch/elements.h"
#include "sampler/sampler.h"

static float at(const float *array, size_t i, int shared)
{
    return array ? array[shared ? 0 : i] : 0.0f;
}

static vndf_vec3 direction(const float *x, const float *y, const float *z, size_t i, int shared)
{
    vndf_vec3 w = {at(x, i, shared), at(y, i, shared), at(z, i, shared)};
    return w;
}

/* ---- surfaces ---- */

static float number(const vndf_call *c, int which, size_t i)
{
    return at(c->read[which], i, (int)(c->shared >> which & 1));
}

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
    const vndf_vec3 wi = {number(c, VNDF_READ_WI_X, i), number(c, VNDF_READ_WI_Y, i),
                          number(c, VNDF_READ_WI_Z, i)};
    const vndf_vec3 wm = {number(c, VNDF_READ_A, i), number(c, VNDF_READ_B, i), number(c, VNDF_READ_C, i)};
    vndf_view view;
    float *to = &c->write[0][i], numbers[2];
    switch (c->task) {
    case VNDF_TASK_SAMPLE:
        view = vndf_affine_view_from(&surface, wi);
        sample(c, i, &view);
        break;
    case VNDF_TASK_PDF:
        view = vndf_affine_view_from(&surface, wi);
        *to = vndf_pdf(&view, wm);
        break;
    case VNDF_TASK_VISIBLE:
        view = vndf_affine_view_from(&surface, wi);
        *to = vndf_visible(&view, wm);
        break;
    case VNDF_TASK_INVERT:
        view = vndf_affine_view_from(&surface, wi);
        vndf_invert(&view, wm, &numbers[0], &numbers[1]);
        *to = numbers[0];
        c->write[1][i] = numbers[1];
        break;
    case VNDF_TASK_NDF: *to = vndf_affine_ndf(&surface, wm); break;
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

vndf_mixture vndf_batch_mixture(const vndf_mixture_batch *b, size_t i)
{
    int shared = (b->shared & VNDF_SHARED_ALPHA) != 0, one_weight = (b->shared & VNDF_SHARED_WEIGHT) != 0;
    vndf_mixture m;
    m.count = b->lobes;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *a = &b->lobe[l];
        vndf_affine s = {a->distribution,         at(a->xx, i, shared), at(a->xy, i, shared),
                         at(a->yx, i, shared),    at(a->yy, i, shared), at(a->mean_x, i, shared),
                         at(a->mean_y, i, shared)};
        m.lobe[l].surface = s;
        m.lobe[l].weight = at(a->weight, i, one_weight);
    }
    return m;
}

vndf_vec3 vndf_batch_mixture_direction(const vndf_mixture_batch *b, size_t i)
{
    return direction(b->wi_x, b->wi_y, b->wi_z, i, (b->shared & VNDF_SHARED_WI) != 0);
}
