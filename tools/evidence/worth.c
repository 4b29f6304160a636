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

#include "cli/subject.h"
#include "evidence/evidence.h"
#include "evidence/measure/measure.h"

static const float gold_n = 0.43f, gold_k = 2.455f;
static const double alpha_measured = 0.5;

static double dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

findings worth_of_normals(const method *m, const method_reference *reference, double theta, size_t replicates,
                          block *b)
{
    const float alpha = (float)alpha_measured / reference->scale;
    const vndf_surface surface = vndf_rough(reference->canonical.distribution, alpha, alpha);
    const vndf_vec3 wi = direction_from(theta, 0), light = direction_from(fabs(theta - 15), 160);
    const double area = (double)vndf_projected_area(&surface, wi), lambda = (double)vndf_lambda(&surface, wi);
    const double count = (double)replicates * BLOCK, cone = cos(5 * acos(-1.0) / 180);
    double sum = 0, square = 0, lit = 0, lit_square = 0, means_square = 0, excess = 0, most = 0;
    block_aim(b, wi, alpha);
    for (size_t replicate = 0; replicate < replicates; replicate++) {
        double before = sum;
        for (uint32_t i = 0; i < BLOCK; i++)
            stratified_point(i, 77 + (uint32_t)replicate, &b->u[0][i], &b->u[1][i]);
        block_pack(b);
        m->each(m, b);
        for (size_t i = 0; i < BLOCK; i++) {
            const vndf_vec3 wm = {b->x[i], b->y[i], b->z[i]};
            double facing = dot(wi, wm), pdf = (double)b->pdf[i], d = (double)vndf_ndf(&surface, wm), value = 0;
            double weight = pdf > 0 ? fmax(facing, 0) * d / (area * pdf) : 0;
            const float twice = (float)(2 * facing);
            const vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
            if (weight > 0 && wo.z > 0) {
                double g2 = 1 / (1 + lambda + (double)vndf_lambda(&surface, wo));
                value = (double)vndf_fresnel_conductor((float)facing, gold_n, gold_k) * weight * area * g2 /
                        (double)wi.z; /* (1) */
            }
            sum += value;
            square += value * value;
            lit += dot(wo, light) > cone ? value : 0;
            lit_square += dot(wo, light) > cone ? value * value : 0;
            excess += fmax(0, 1 - weight);
            most = fmax(most, weight);
        }
        means_square += (sum - before) * (sum - before) / (BLOCK * BLOCK);
    }
    double mean = sum / count, spread = fmax(means_square / (double)replicates - mean * mean, 0);
    return (findings){.albedo = mean,
                      .albedo_noise = replicates > 1 ? sqrt(spread / (double)(replicates - 1)) : INFINITY,
                      .variance = square / count - mean * mean,
                      .light_variance = lit_square / count - lit * lit / (count * count),
                      .tv = excess / count,
                      .max_weight = most};
}

void worth_of_material(const method *m, const block_law *law, double theta, block *b, size_t blocks,
                       double found[COLUMNS])
{
    const double n = (double)(blocks * BLOCK);
    double sum = 0, square = 0, lost = 0, most = 0;
    block_law of = *law;
    of.theta = theta;
    for (size_t i = 0; i < blocks; i++) {
        block_fill(b, &of, 1000 + i);
        block_aim(b, direction_from(theta, 25), 1);
        m->each(m, b);
        for (size_t k = 0; k < BLOCK; k++) {
            double weight = (double)b->out[k].weight[0];
            sum += weight;
            square += weight * weight;
            lost += b->out[k].lobe == VNDF_LOBE_NONE;
            most = fmax(most, weight);
        }
    }
    found[COL_MEAN] = sum / n;
    found[COL_VARIANCE] = fmax(square / n - sum / n * (sum / n), 0) * n / (n - 1);
    found[COL_NOISE] = sqrt(found[COL_VARIANCE] / n);
    found[COL_LOST] = lost / n;
    found[COL_WEIGHT] = most;
}
