/* Error, variance and bias of a method, from its own samples and the densities it tells.
 *
 * Reflection from microfacets that mirror, with Smith's height-correlated masking: one normal wm gives wo, and
 *
 *     F(wi.wm) D(wm) G2(wi, wo) (wi.wm) / (wi.z pdf)      is an estimate of the albedo              (1)
 *
 * of gold at 550 nm, n = 0.43, k = 2.455 (P. Johnson, R. Christy, Phys. Rev. B 6, 1972). The same where wo falls
 * into a cone of 5 degrees and 0 elsewhere is the radiance of a small light. D and Lambda are those of the reference.
 * The other terms of (1) cost all methods the same, and efficiencies do not count their time.
 *
 * Total variation of a density p that is known, Dv being true: integral of max(0, p - Dv) = mean of
 * max(0, 1 - Dv/p) over the samples. Where a method draws with another density than it tells, its histogram is
 * compared with that of the reference, half the sum of differences: with 384 bins and 64 replicates that floors at
 * some 0.007, and the largest weight, over bins that hold samples enough, at 1.1. A hole is a bin that no sample
 * meets: infinite weight.
 *
 * Points are Hammersley's in replicates of 1024 with random shifts: means converge fast, their noise is seen from
 * replicate to replicate, and the variance of one sample is what it is. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/parts.h"
#include "cli/subject.h"

enum { BINS_ACROSS = 24, BINS_AROUND = 16, BINS = BINS_ACROSS * BINS_AROUND, HOLE_LEAST = 20, RATIO_LEAST = 200 };

static const double gold_n = 0.43, gold_k = 2.455, alpha_measured = 0.5;

typedef struct integral {
    const method *m;
    method_reference reference;
    vndf_vec3 wi, light;
    float alpha, area, lambda, cone;
    float *d, *wo_lambda;        /* of a block */
    bench_block *block, *turned; /* samples; their wo as directions wi */
} integral;

typedef struct sums {
    double value, value2, light, light2, means, means2, excess, max_weight;
    double drawn[BINS];
} sums;

/* Complex Fresnel for polarised light, in terms of a^2 + b^2 = |sqrt(m^2 - sin^2)|^2. */
double bench_fresnel(double cosine, double n, double k)
{
    double c = fmin(fabs(cosine), 1), s2 = 1 - c * c, t = n * n - k * k - s2;
    double square = sqrt(t * t + 4 * n * n * k * k), a = sqrt(fmax(0.5 * (square + t), 0));
    double across = (square - 2 * a * c + c * c) / (square + 2 * a * c + c * c);
    double sum = square * c * c + s2 * s2, cross = 2 * a * c * s2;
    double along = across * (sum - cross) / (sum + cross);
    return 0.5 * (across + along);
}

/* ---- one block --------------------------------------------------------------------------------- */

static double dot_of(const integral *x, size_t i)
{
    const bench_block *b = x->block;
    return (double)b->x[i] * (double)x->wi.x + (double)b->y[i] * (double)x->wi.y +
           (double)b->z[i] * (double)x->wi.z;
}

static void mirror(const integral *x)
{
    const bench_block *b = x->block;
    for (size_t i = 0; i < BENCH_BLOCK; i++) {
        float twice = (float)(2 * dot_of(x, i));
        x->turned->wi_x[i] = twice * b->x[i] - x->wi.x;
        x->turned->wi_y[i] = twice * b->y[i] - x->wi.y;
        x->turned->wi_z[i] = twice * b->z[i] - x->wi.z;
    }
}

static void evaluate(const integral *x)
{
    bench_block *b = x->block, *t = x->turned;
    vndf_batch batch = {x->reference.canonical.distribution,
                        BENCH_BLOCK,
                        VNDF_SHARED_ALPHA,
                        VNDF_INSTRUCTIONS_BEST,
                        &x->alpha,
                        &x->alpha,
                        t->wi_x,
                        t->wi_y,
                        t->wi_z};
    mirror(x);
    vndf_ndf_n(&batch, (vndf_normals){b->x, b->y, b->z}, x->d);
    vndf_lambda_n(&batch, x->wo_lambda);
}

/* (1); *visible is the true density of the normal. */
static double value_at(const integral *x, size_t i, double *visible)
{
    double dot = dot_of(x, i), pdf = (double)x->block->pdf[i], d = (double)x->d[i];
    *visible = fmax(dot, 0) * d / (double)x->area;
    if (!(dot > 0) || !(pdf > 0) || !(x->turned->wi_z[i] > 0))
        return 0;
    double g2 = 1 / (1 + (double)x->lambda + (double)x->wo_lambda[i]);
    return bench_fresnel(dot, gold_n, gold_k) * d * g2 * dot / ((double)x->wi.z * pdf);
}

static int lit(const integral *x, size_t i)
{
    const bench_block *t = x->turned;
    return t->wi_x[i] * x->light.x + t->wi_y[i] * x->light.y + t->wi_z[i] * x->light.z > x->cone;
}

/* Bins of the slope length over (1 + slope length) at median slope 1, and of the azimuth from wi. */
static size_t bin_of(const integral *x, size_t i)
{
    const bench_block *b = x->block;
    double across = sqrt((double)b->x[i] * (double)b->x[i] + (double)b->y[i] * (double)b->y[i]);
    double slope = across / ((double)b->z[i] * (double)x->alpha * (double)x->reference.scale);
    double turn = atan2(fabs((double)b->y[i]), (double)b->x[i]) / acos(-1.0);
    size_t radius = (size_t)((b->z[i] > 0 ? slope / (1 + slope) : 1) * BINS_ACROSS);
    size_t around = (size_t)(turn * BINS_AROUND);
    radius = radius < BINS_ACROSS ? radius : BINS_ACROSS - 1;
    return radius * BINS_AROUND + (around < BINS_AROUND ? around : BINS_AROUND - 1);
}

static void add_block(const integral *x, sums *s)
{
    double before = s->value;
    evaluate(x);
    for (size_t i = 0; i < BENCH_BLOCK; i++) {
        double visible, value = value_at(x, i, &visible), pdf = (double)x->block->pdf[i];
        s->value += value;
        s->value2 += value * value;
        s->light += lit(x, i) ? value : 0;
        s->light2 += lit(x, i) ? value * value : 0;
        s->excess += pdf > 0 ? fmax(0, 1 - visible / pdf) : 1;
        s->max_weight = pdf > 0 ? fmax(s->max_weight, visible / pdf) : s->max_weight;
        s->drawn[bin_of(x, i)] += 1;
    }
    double mean = (s->value - before) / BENCH_BLOCK;
    s->means += mean;
    s->means2 += mean * mean;
}

static void run_blocks(const integral *x, sums *s, size_t replicates)
{
    method_outputs out = bench_block_outputs(x->block);
    memset(s, 0, sizeof *s);
    bench_block_aim(x->block, x->wi, x->alpha);
    for (size_t i = 0; i < replicates; i++) {
        bench_block_spread(x->block, 77 + i);
        method_inputs in = bench_block_inputs(x->block);
        x->m->each(x->m, &in, &out);
        add_block(x, s);
    }
}

/* ---- findings ---------------------------------------------------------------------------------- */

static void compare_bins(const sums *method_sums, const sums *true_sums, double count, bench_findings *f)
{
    double sum = 0;
    f->max_weight = 0;
    for (size_t i = 0; i < BINS; i++) {
        double drawn = method_sums->drawn[i], wanted = true_sums->drawn[i];
        sum += fabs(drawn - wanted);
        if (wanted >= RATIO_LEAST || (wanted >= HOLE_LEAST && drawn <= 0))
            f->max_weight = fmax(f->max_weight, wanted / drawn);
    }
    f->tv = 0.5 * sum / count;
}

static void conclude(const sums *s, size_t replicates, bench_findings *f)
{
    double count = (double)replicates * BENCH_BLOCK, mean = s->value / count, light = s->light / count;
    double spread = s->means2 / (double)replicates - mean * mean;
    f->albedo = mean;
    f->albedo_noise = replicates > 1 ? sqrt(fmax(spread, 0) / (double)(replicates - 1)) : INFINITY;
    f->variance = s->value2 / count - mean * mean;
    f->light_variance = s->light2 / count - light * light;
    f->tv = s->excess / count;
    f->max_weight = s->max_weight;
}

static int allocate(integral *x)
{
    x->d = malloc(2 * BENCH_BLOCK * sizeof *x->d);
    x->block = malloc(sizeof *x->block);
    x->turned = malloc(sizeof *x->turned);
    if (!x->d)
        return 0;
    x->wo_lambda = x->d + BENCH_BLOCK;
    return x->block && x->turned;
}

static void measure(integral *x, size_t replicates, sums *s, bench_findings *findings)
{
    run_blocks(x, s, replicates);
    conclude(s, replicates, findings);
    if (x->m->biased) {
        method reference = method_ours(x->reference.canonical.distribution, "reference", VNDF_INSTRUCTIONS_BEST);
        x->m = &reference;
        run_blocks(x, s + 1, replicates);
        compare_bins(s, s + 1, (double)replicates * BENCH_BLOCK, findings);
    }
}

int bench_integrate(const method *m, const method_reference *reference, double theta, size_t replicates,
                    bench_findings *findings)
{
    const double degree = acos(-1.0) / 180;
    integral x = {.m = m, .reference = *reference, .wi = direction_from(theta, 0)};
    x.light = direction_from(fabs(theta - 15), 160);
    x.alpha = (float)alpha_measured / reference->scale;
    x.cone = (float)cos(5 * degree);
    vndf_surface surface = {reference->canonical.distribution, x.alpha, x.alpha};
    x.area = vndf_projected_area(&surface, x.wi);
    x.lambda = vndf_lambda(&surface, x.wi);
    sums *s = malloc(2 * sizeof *s);
    int good = allocate(&x) && s;
    if (good)
        measure(&x, replicates, s, findings);
    free(s);
    free(x.d);
    free(x.block);
    free(x.turned);
    return good;
}
