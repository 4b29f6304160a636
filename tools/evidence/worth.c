/* What samples are worth: error and variance of a method that draws normals, from its own samples and the
 * densities it tells; and the weights of materials.
 *
 * Reflection from microfacets that mirror, with Smith's height-correlated masking: one normal wm gives wo, and
 *
 *     F(wi.wm) D(wm) G2(wi, wo) (wi.wm) / (wi.z pdf)      is an estimate of the albedo              (1)
 *
 * of gold at 550 nm, n = 0.43, k = 2.455 (P. Johnson, R. Christy, Phys. Rev. B 6, 1972). The same where wo falls
 * into a cone of 5 degrees and 0 elsewhere is the radiance of a small light. D and Lambda are those of the
 * reference. The other terms of (1) cost all methods the same, and efficiencies do not count their time.
 *
 * Total variation of a density p that is known, Dv being true: integral of max(0, p - Dv) = mean of max(0, 1 -
 * Dv/p) over the samples.
 *
 * Points are scrambled Sobol' points in replicates of 1024: means converge fast, their noise is seen from
 * replicate to replicate, and the variance of one sample is what it is. */
#include <math.h>
#include <stdlib.h>

#include "cli/subject.h"
#include "evidence/evidence.h"

static const double gold_n = 0.43, gold_k = 2.455, alpha_measured = 0.5;
static const double noise_limit = 6; /* standard errors between two halves of the same samples */

typedef struct integral {
    method_reference reference;
    vndf_vec3 wi, light;
    float alpha, area, lambda, cone;
    block *block;                                   /* samples */
    float wo[3][BLOCK], d[BLOCK], wo_lambda[BLOCK]; /* where they reflect to; D, Lambda(wo) */
} integral;

typedef struct sums {
    double value, value2, light, light2, means2, excess, max_weight;
} sums;

/* Complex Fresnel for polarised light, in terms of a^2 + b^2 = |sqrt(m^2 - sin^2)|^2. */
double worth_fresnel(double cosine, double n, double k)
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
    const block *b = x->block;
    return (double)b->x[i] * (double)x->wi.x + (double)b->y[i] * (double)x->wi.y +
           (double)b->z[i] * (double)x->wi.z;
}

static void evaluate(integral *x)
{
    block *b = x->block;
    for (size_t i = 0; i < BLOCK; i++) {
        float twice = (float)(2 * dot_of(x, i));
        x->wo[0][i] = twice * b->x[i] - x->wi.x;
        x->wo[1][i] = twice * b->y[i] - x->wi.y;
        x->wo[2][i] = twice * b->z[i] - x->wi.z;
    }
    vndf_batch batch = {x->reference.canonical.distribution,
                        BLOCK,
                        VNDF_SHARED_ALPHA,
                        VNDF_INSTRUCTIONS_BEST,
                        &x->alpha,
                        &x->alpha,
                        x->wo[0],
                        x->wo[1],
                        x->wo[2]};
    vndf_ndf_n(&batch, (vndf_normals){b->x, b->y, b->z}, x->d);
    vndf_lambda_n(&batch, x->wo_lambda);
}

/* (1); *visible is the true density of the normal. */
static double value_at(const integral *x, size_t i, double *visible)
{
    double dot = dot_of(x, i), pdf = (double)x->block->pdf[i], d = (double)x->d[i];
    *visible = fmax(dot, 0) * d / (double)x->area;
    if (!(dot > 0) || !(pdf > 0) || !(x->wo[2][i] > 0))
        return 0;
    double g2 = 1 / (1 + (double)x->lambda + (double)x->wo_lambda[i]);
    return worth_fresnel(dot, gold_n, gold_k) * d * g2 * dot / ((double)x->wi.z * pdf);
}

static int lit(const integral *x, size_t i)
{
    return x->wo[0][i] * x->light.x + x->wo[1][i] * x->light.y + x->wo[2][i] * x->light.z > x->cone;
}

static void add_block(integral *x, sums *s)
{
    double before = s->value;
    evaluate(x);
    for (size_t i = 0; i < BLOCK; i++) {
        double visible, value = value_at(x, i, &visible), pdf = (double)x->block->pdf[i];
        s->value += value;
        s->value2 += value * value;
        s->light += lit(x, i) ? value : 0;
        s->light2 += lit(x, i) ? value * value : 0;
        s->excess += pdf > 0 ? fmax(0, 1 - visible / pdf) : 1;
        s->max_weight = pdf > 0 ? fmax(s->max_weight, visible / pdf) : s->max_weight;
    }
    double mean = (s->value - before) / BLOCK;
    s->means2 += mean * mean;
}

static void conclude(const sums *s, size_t replicates, findings *f)
{
    double count = (double)replicates * BLOCK, mean = s->value / count, light = s->light / count;
    double spread = s->means2 / (double)replicates - mean * mean;
    *f = (findings){.albedo = mean,
                    .albedo_noise = replicates > 1 ? sqrt(fmax(spread, 0) / (double)(replicates - 1)) : INFINITY,
                    .variance = s->value2 / count - mean * mean,
                    .light_variance = s->light2 / count - light * light,
                    .tv = s->excess / count,
                    .max_weight = s->max_weight};
}

int worth_of_normals(const method *m, const method_reference *reference, double theta, size_t replicates,
                     findings *found)
{
    integral *x = calloc(1, sizeof *x);
    block *b = calloc(1, sizeof *b);
    sums s = {0};
    if (x && b) {
        *x = (integral){.reference = *reference, .wi = direction_from(theta, 0), .block = b};
        x->light = direction_from(fabs(theta - 15), 160);
        x->alpha = (float)alpha_measured / reference->scale;
        x->cone = (float)cos(5 * acos(-1.0) / 180);
        vndf_surface surface = {reference->canonical.distribution, x->alpha, x->alpha};
        x->area = vndf_projected_area(&surface, x->wi);
        x->lambda = vndf_lambda(&surface, x->wi);
        block_aim(b, x->wi, x->alpha);
        for (size_t i = 0; i < replicates; i++) {
            block_spread(b, 77 + (uint32_t)i);
            m->each(m, b, 0, BLOCK);
            add_block(x, &s);
        }
        conclude(&s, replicates, found);
    }
    int good = x && b;
    free(x);
    free(b);
    return good;
}

/* ---- materials ----------------------------------------------------------------------------------- */

typedef struct tally {
    double count, sum, square, lost, most;
} tally;

static double variance_of(const tally *t)
{
    double mean = t->sum / t->count;
    return fmax(t->square / t->count - mean * mean, 0) * t->count / (t->count - 1);
}

static tally weigh(const method *m, const block_law *law, double theta, block *b, size_t blocks, uint64_t seed)
{
    tally t = {0, 0, 0, 0, 0};
    block_law of = *law;
    vndf_vec3 wi = direction_from(theta, 25);
    of.theta = theta;
    for (size_t i = 0; i < blocks; i++) {
        block_fill(b, &of, seed + i);
        block_aim(b, wi, 1);
        m->each(m, b, 0, BLOCK);
        for (size_t k = 0; k < BLOCK; k++) {
            double weight = (double)(m->limit ? b->value[0][k] : b->out[k].weight[0]);
            t.count += 1;
            t.sum += weight;
            t.square += weight * weight;
            t.lost += (m->limit ? b->lobe[k] : b->out[k].lobe) == VNDF_LOBE_NONE;
            t.most = fmax(t.most, weight);
        }
    }
    return t;
}

int worth_of_material(const method *m, const block_law *law, double theta, block *b, size_t blocks,
                      evidence_row *found)
{
    tally x = weigh(m, law, theta, b, blocks, 1u << 20), y = weigh(m, law, theta, b, blocks, 2u << 20);
    tally t = {x.count + y.count, x.sum + y.sum, x.square + y.square, x.lost + y.lost, fmax(x.most, y.most)};
    double between = sqrt(variance_of(&x) / x.count + variance_of(&y) / y.count), *to = found->number;
    to[COL_MEAN] = t.sum / t.count;
    to[COL_VARIANCE] = variance_of(&t);
    to[COL_NOISE] = sqrt(to[COL_VARIANCE] / t.count);
    to[COL_LOST] = t.lost / t.count;
    to[COL_WEIGHT] = t.most;
    return fabs(x.sum / x.count - y.sum / y.count) <= noise_limit * between + 1e-5;
}
