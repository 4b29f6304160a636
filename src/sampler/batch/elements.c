/* Batches one element after the other, by the calls for one: single elements, lobes without a distribution, inverses,
 * and all where the compiler has no lanes. */
#include "sampler/batch/call.h"
#include "sampler/sampler.h"

static void run_one(const vndf_call *c, size_t i)
{
    vndf_affine s = vndf_call_surface(c, i);
    const vndf_vec3 wi = vndf_call_vec3(c, VNDF_READ_WI_X, i), given = vndf_call_vec3(c, VNDF_READ_A, i);
    const vndf_surface rough = {s.distribution, s.xx, s.yy};
    const vndf_view view = c->diagonal ? vndf_view_from(&rough, wi) : vndf_affine_view_from(&s, wi);
    vndf_vec3 wm;
    float to[VNDF_WRITES] = {0.0f};
    if (c->diagonal && !(s.xx > 0.0f && s.yy > 0.0f))
        s.distribution = NULL; /* which is invalid */
    switch (c->task) {
    case VNDF_TASK_SAMPLE:
        wm = c->write[4] ? vndf_sample_weight(&view, given.x, given.y, &to[3], &to[4])
                         : vndf_sample(&view, given.x, given.y, &to[3]);
        to[0] = wm.x, to[1] = wm.y, to[2] = wm.z;
        break;
    case VNDF_TASK_PDF: to[0] = vndf_pdf(&view, given); break;
    case VNDF_TASK_VISIBLE: to[0] = vndf_visible(&view, given); break;
    case VNDF_TASK_INVERT: vndf_invert(&view, given, &to[0], &to[1]); break;
    case VNDF_TASK_NDF: to[0] = vndf_affine_ndf(&s, given); break;
    case VNDF_TASK_LAMBDA: to[0] = vndf_affine_lambda(&s, wi); break;
    case VNDF_TASK_G1: to[0] = vndf_affine_g1(&s, wi); break;
    case VNDF_TASK_AREA: to[0] = vndf_affine_projected_area(&s, wi); break;
    case VNDF_TASK_DRAWN_AREA: to[0] = view.distribution ? vndf_view_drawn_area(&view) : 0.0f; break;
    }
    to[1] = c->task == VNDF_TASK_AREA || c->task == VNDF_TASK_DRAWN_AREA ? view.distribution != NULL : to[1];
    for (int w = 0; w < VNDF_WRITES; w++)
        if (c->write[w])
            c->write[w][i] = to[w];
}

static void prepare(const vndf_distribution *distribution, vndf_prepared *prepared)
{
    (void)distribution;
    (void)prepared;
}

static void run(const vndf_call *call)
{
    for (size_t i = 0; i < call->count; i++)
        run_one(call, call->at ? (size_t)call->at[i] : i);
}

const vndf_lanes vndf_one_by_one = {prepare, run};
