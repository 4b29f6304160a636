/* Batches one element after the other, by the calls for one: single elements, lobes without a distribution, and all
 * where the compiler has no lanes. */
#include "sampler/batch/call.h"

static float number(const vndf_lobe_call *c, int which, size_t i)
{
    const float *array = c->read[which];
    return array ? array[c->shared >> which & 1 ? 0 : i] : 0.0f;
}

static vndf_vec3 triple(const vndf_lobe_call *c, int first, size_t i)
{
    vndf_vec3 v = {number(c, first, i), number(c, first + 1, i), number(c, first + 2, i)};
    return v;
}

static vndf_affine surface_at(const vndf_lobe_call *c, size_t i)
{
    vndf_affine s = {c->distribution,
                     number(c, VNDF_READ_XX, i),
                     number(c, VNDF_READ_XY, i),
                     number(c, VNDF_READ_YX, i),
                     number(c, VNDF_READ_YY, i),
                     number(c, VNDF_READ_MEAN_X, i),
                     number(c, VNDF_READ_MEAN_Y, i)};
    return s;
}

static void put_normal(const vndf_call *c, size_t i, vndf_vec3 wm)
{
    c->write[0][i] = wm.x;
    c->write[1][i] = wm.y;
    c->write[2][i] = wm.z;
}

static float *place_of(const vndf_call *c, int which, size_t i)
{
    return c->write[which] ? &c->write[which][i] : NULL;
}

static void one_surface(const vndf_call *c, size_t i)
{
    vndf_affine s = surface_at(c->lobe, i);
    const vndf_vec3 wi = triple(c->lobe, VNDF_READ_WI_X, i), wm = triple(c->lobe, VNDF_READ_A, i);
    const vndf_surface rough = {s.distribution, s.xx, s.yy};
    float *to = &c->write[0][i], *pdf = place_of(c, 3, i), *weight = place_of(c, 4, i), u1, u2;
    vndf_view view;
    if (c->task < VNDF_TASK_NDF)
        view = c->diagonal ? vndf_view_from(&rough, wi) : vndf_affine_view_from(&s, wi);
    if (c->diagonal && !(s.xx > 0.0f && s.yy > 0.0f))
        s.distribution = NULL; /* which is invalid */
    switch (c->task) {
    case VNDF_TASK_SAMPLE:
        put_normal(c, i,
                   weight ? vndf_sample_weight(&view, wm.x, wm.y, pdf, weight)
                          : vndf_sample(&view, wm.x, wm.y, pdf));
        break;
    case VNDF_TASK_PDF: *to = vndf_pdf(&view, wm); break;
    case VNDF_TASK_VISIBLE: *to = vndf_visible(&view, wm); break;
    case VNDF_TASK_INVERT:
        vndf_invert(&view, wm, &u1, &u2);
        *to = u1;
        c->write[1][i] = u2;
        break;
    case VNDF_TASK_NDF: *to = vndf_affine_ndf(&s, wm); break;
    case VNDF_TASK_LAMBDA: *to = vndf_affine_lambda(&s, wi); break;
    case VNDF_TASK_G1: *to = vndf_affine_g1(&s, wi); break;
    default: *to = vndf_affine_projected_area(&s, wi);
    }
}

static void one_mixture(const vndf_call *c, size_t i)
{
    const vndf_vec3 wi = triple(c->lobe, VNDF_READ_WI_X, i), wm = triple(c->lobe, VNDF_READ_A, i);
    float *to = &c->write[0][i], u1, u2;
    int lobe = -1;
    vndf_mixture m = {.count = c->lobes};
    vndf_mixture_view view;
    for (int l = 0; l < c->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        m.lobe[l].surface = surface_at(&c->lobe[l], i);
        m.lobe[l].weight = number(&c->lobe[l], VNDF_READ_WEIGHT, i);
    }
    if (c->task < VNDF_TASK_NDF)
        view = vndf_mixture_view_from(&m, wi);
    switch (c->task) {
    case VNDF_TASK_SAMPLE:
        put_normal(c, i, vndf_mixture_sample(&view, wm.x, wm.y, place_of(c, 3, i), &lobe));
        break;
    case VNDF_TASK_PDF: *to = vndf_mixture_pdf(&view, wm); break;
    case VNDF_TASK_VISIBLE: *to = vndf_mixture_visible(&view, wm); break;
    case VNDF_TASK_INVERT:
        lobe = vndf_mixture_invert(&view, wm, c->asked ? c->asked[i] : -1, &u1, &u2);
        *to = u1;
        c->write[1][i] = u2;
        break;
    case VNDF_TASK_NDF: *to = vndf_mixture_ndf(&m, wm); break;
    case VNDF_TASK_LAMBDA: *to = vndf_mixture_lambda(&m, wi); break;
    case VNDF_TASK_G1: *to = vndf_mixture_g1(&m, wi); break;
    default: *to = vndf_mixture_projected_area(&m, wi);
    }
    if (c->drawn)
        c->drawn[i] = lobe;
}

void vndf_one_by_one(const vndf_call *call)
{
    for (size_t i = 0; i < call->count; i++)
        (call->mixed ? one_mixture : one_surface)(call, i);
}
