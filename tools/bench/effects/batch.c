/* The loops over the batch calls of vndf_bsdf.h: structures of arrays, with the best instructions of this machine.
 * Inputs are packed into arrays before these loops run, and results unpacked after. */
#include "bench/effects/effects.h"

void effects_pack(const effects_job *job)
{
    effects_arrays *a = job->arrays;
    for (size_t i = 0; i < job->count; i++) {
        const effects_input *in = &job->in[i];
        const float from[EFFECTS_ARRAYS_IN] = {in->wi.x, in->wi.y, in->wi.z, in->wo.x, in->wo.y,
                                               in->wo.z, in->u[0], in->u[1], in->u[2]};
        for (int n = 0; n < EFFECTS_ARRAYS_IN; n++)
            a->in[n][job->first + i] = from[n];
    }
}

void effects_unpack(const effects_job *job)
{
    const effects_arrays *a = job->arrays;
    if (job->of->set->kind != EFFECTS_BATCH)
        return;
    for (size_t i = 0; i < job->count; i++) {
        size_t at = job->first + i;
        vndf_scattered *to = &job->out[i];
        to->wo = (vndf_vec3){a->wo[0][at], a->wo[1][at], a->wo[2][at]};
        to->density = a->density[at];
        to->lobe = (vndf_lobe)a->lobe[at];
        for (int k = 0; k < job->of->material.is.wavelengths; k++)
            to->weight[k] = a->weight[k][at];
    }
}

static vndf_bsdf_batch batch_of(const effects_job *job, unsigned shared)
{
    const effects_arrays *a = job->arrays;
    vndf_bsdf_batch batch = {.material = &job->of->material, .count = job->count, .shared = shared};
    batch.wi_x = a->in[0] + job->first;
    batch.wi_y = a->in[1] + job->first;
    batch.wi_z = a->in[2] + job->first;
    return batch;
}

static void sample(const effects_job *job, unsigned shared)
{
    effects_arrays *a = job->arrays;
    size_t first = job->first;
    const vndf_bsdf_batch batch = batch_of(job, shared);
    const float *const u[3] = {a->in[6] + first, a->in[7] + first, a->in[8] + first};
    const vndf_scattered_n to = {{a->wo[0] + first, a->wo[1] + first, a->wo[2] + first},
                                 {a->weight[0] + first, a->weight[1] + first, a->weight[2] + first},
                                 a->density + first,
                                 a->lobe + first,
                                 {a->wm[0] + first, a->wm[1] + first, a->wm[2] + first}};
    vndf_bsdf_sample_n(&batch, u, to);
}

static void each(const effects_job *job)
{
    sample(job, 0);
}

static void shared(const effects_job *job)
{
    sample(job, VNDF_SHARED_WI | VNDF_SHARED_ALPHA);
}

static vndf_normals wo_of(const effects_job *job)
{
    effects_arrays *a = job->arrays;
    vndf_normals wo = {a->in[3] + job->first, a->in[4] + job->first, a->in[5] + job->first};
    return wo;
}

static void eval(const effects_job *job)
{
    effects_arrays *a = job->arrays;
    const vndf_bsdf_batch batch = batch_of(job, VNDF_SHARED_WI | VNDF_SHARED_ALPHA);
    float *const value[] = {a->weight[0] + job->first, a->weight[1] + job->first, a->weight[2] + job->first};
    vndf_bsdf_eval_n(&batch, wo_of(job), NULL, value);
}

static void pdf(const effects_job *job)
{
    const vndf_bsdf_batch batch = batch_of(job, VNDF_SHARED_WI | VNDF_SHARED_ALPHA);
    vndf_bsdf_pdf_n(&batch, wo_of(job), job->arrays->density + job->first);
}

const effects_loops effects_loops_batch = {each, shared, eval, pdf};
