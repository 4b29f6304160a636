/* The loops over vndf_bsdf.h, which do the work of a renderer at a hit. They are compiled without vector loops, as
 * method_*.c are. */
#include "bench/effects/effects.h"

static void each(const effects_job *job)
{
    for (size_t i = 0; i < job->count; i++) {
        vndf_bsdf bsdf;
        vndf_bsdf_at(&bsdf, &job->of->material, job->in[i].wi);
        vndf_bsdf_sample(&bsdf, job->in[i].u, &job->out[i]);
    }
}

static void rough_each(const effects_job *job)
{
    for (size_t i = 0; i < job->count; i++) {
        vndf_bsdf bsdf;
        vndf_bsdf_rough(&bsdf, &job->of->material, &job->of->roughness[i], job->in[i].wi);
        vndf_bsdf_sample(&bsdf, job->in[i].u, &job->out[i]);
    }
}

/* ---- one hit for all --------------------------------------------------------------------------- */

static void sample_all(const vndf_bsdf *bsdf, const effects_job *job)
{
    for (size_t i = 0; i < job->count; i++)
        vndf_bsdf_sample(bsdf, job->in[i].u, &job->out[i]);
}

static void eval_all(const vndf_bsdf *bsdf, const effects_job *job)
{
    for (size_t i = 0; i < job->count; i++)
        vndf_bsdf_eval(bsdf, job->in[i].wo, i, job->out[i].weight);
}

static void pdf_all(const vndf_bsdf *bsdf, const effects_job *job)
{
    for (size_t i = 0; i < job->count; i++)
        job->out[i].density = vndf_bsdf_pdf(bsdf, job->in[i].wo);
}

static void shared(const effects_job *job)
{
    vndf_bsdf bsdf;
    vndf_bsdf_at(&bsdf, &job->of->material, job->in[0].wi);
    sample_all(&bsdf, job);
}

static void eval(const effects_job *job)
{
    vndf_bsdf bsdf;
    vndf_bsdf_at(&bsdf, &job->of->material, job->in[0].wi);
    eval_all(&bsdf, job);
}

static void pdf(const effects_job *job)
{
    vndf_bsdf bsdf;
    vndf_bsdf_at(&bsdf, &job->of->material, job->in[0].wi);
    pdf_all(&bsdf, job);
}

static void rough_shared(const effects_job *job)
{
    vndf_bsdf bsdf;
    vndf_bsdf_rough(&bsdf, &job->of->material, &job->of->roughness[0], job->in[0].wi);
    sample_all(&bsdf, job);
}

static void rough_eval(const effects_job *job)
{
    vndf_bsdf bsdf;
    vndf_bsdf_rough(&bsdf, &job->of->material, &job->of->roughness[0], job->in[0].wi);
    eval_all(&bsdf, job);
}

static void rough_pdf(const effects_job *job)
{
    vndf_bsdf bsdf;
    vndf_bsdf_rough(&bsdf, &job->of->material, &job->of->roughness[0], job->in[0].wi);
    pdf_all(&bsdf, job);
}

const effects_loops effects_loops_library = {each, shared, eval, pdf};
const effects_loops effects_loops_rough = {rough_each, rough_shared, rough_eval, rough_pdf};
