/* The first order of the walk is the known model of single scattering: for GGX and Beckmann, reflection and
 * transmission, eval with an order limit of 1 is the published formula (Walter et al. 2007, height-correlated
 * masking) to 2e-5 at every direction and two roundings of it, and samples that leave after one event follow it:
 * chi-square over 96 bins, level 1e-3 for all together. The formulas are written out here once more, with the C
 * library's functions. For tables eval is D G2/(4 cos_i) with the library's own D and G2. */
#include "bsdf/walk/walk_case.h"

typedef struct model {
    int beckmann;
    float ax, ay, eta; /* eta 0: a mirror */
} model;

static double ndf_of(const model *m, const double w[3])
{
    double x = w[0] / (w[2] * m->ax), y = w[1] / (w[2] * m->ay), r2 = x * x + y * y, c4 = pow(w[2], 4.0);
    double p22 = m->beckmann ? exp(-r2) : 1.0 / ((1.0 + r2) * (1.0 + r2));
    return w[2] > 0.0 ? p22 / (PI * m->ax * m->ay * c4) : 0.0;
}

static double lambda_of(const model *m, const double w[3])
{
    double a2 = (w[0] * w[0] * m->ax * m->ax + w[1] * w[1] * m->ay * m->ay) / (w[2] * w[2]), v = 1.0 / sqrt(a2);
    if (a2 == 0.0)
        return 0.0;
    return m->beckmann ? 0.5 * (exp(-v * v) / (v * sqrt(PI)) - erfc(v)) : 0.5 * (sqrt(1.0 + a2) - 1.0);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* f |cos_o|, importance. */
static double single(const model *m, const double i[3], const double o[3])
{
    double li = lambda_of(m, i), lo = lambda_of(m, o), h[3], length, r = o[2] > 0.0 ? 1.0 : (double)m->eta;
    if (r == 0.0)
        return 0.0;
    for (int k = 0; k < 3; k++)
        h[k] = i[k] + r * o[k];
    length = sqrt(dot(h, h)) * (h[2] < 0.0 ? -1.0 : 1.0);
    for (int k = 0; k < 3; k++)
        h[k] /= length;
    double facing_i = dot(i, h), facing_o = dot(o, h);
    if (facing_i <= 0.0 || (o[2] > 0.0) != (facing_o > 0.0))
        return 0.0;
    double f = m->eta > 0.0 ? walk_dielectric_at(facing_i, m->eta) : 1.0, d = ndf_of(m, h);
    if (o[2] > 0.0)
        return f * d / (4.0 * i[2] * (1.0 + li + lo));
    double beta = exp(lgamma(1.0 + li) + lgamma(1.0 + lo) - lgamma(2.0 + li + lo));
    return (1.0 - f) * d * beta * r * r * facing_i * -facing_o / (i[2] * length * length);
}

static void widen(vndf_vec3 w, double wide[3])
{
    wide[0] = w.x, wide[1] = w.y, wide[2] = w.z;
    double length = sqrt(dot(wide, wide));
    for (int k = 0; k < 3; k++)
        wide[k] /= length;
}

static void hit_of(const model *m, double cosine, walk_hit *h)
{
    vndf_description is = m->eta > 0.0f ? walk_of_glass(m->eta) : walk_of_mirror();
    is.order_limit = 1;
    walk_hit_at(h, &is, m->beckmann ? vndf_beckmann() : vndf_ggx(), m->ax, m->ay, walk_direction(cosine, 0.4));
}

/* How far two roundings of wi and wo move the formula: half vectors are floats. */
static double spread_of(const model *m, const double i[3], const double o[3], double want)
{
    double sum = 0.0;
    for (int k = 0; k < 6; k++) {
        double moved[2][3];
        memcpy(moved[0], i, sizeof moved[0]);
        memcpy(moved[1], o, sizeof moved[1]);
        moved[k / 3][k % 3] += 0x1p-22;
        sum += fabs(single(m, moved[0], moved[1]) - want);
    }
    return sum;
}

static void test_formula(const model *m, double cosine)
{
    unsigned long long state = 77;
    walk_hit h;
    double i[3], o[3], most = 0.0;
    hit_of(m, cosine, &h);
    widen(h.wi, i);
    for (int k = 0; k < 20000; k++) {
        double z = 2.0 * test_uniform_double(&state) - 1.0;
        vndf_vec3 wo = walk_direction(z, 2.0 * PI * test_uniform_double(&state));
        widen(wo, o);
        double want = single(m, i, o), spread = spread_of(m, i, o, want);
        most = want > most ? want : most;
        TEST_NEAR(walk_eval(&h, wo, 1), want, 2e-5 * want + spread + 1e-12 * most);
    }
    TEST(most > 0.0);
}

typedef struct lit {
    const model *m;
    double i[3];
} lit;

static double single_towards(double z, double phi, const void *of)
{
    const lit *l = of;
    double s = sqrt(1.0 - z * z), o[3] = {s * cos(phi), s * sin(phi), z};
    return single(l->m, l->i, o);
}

static void test_samples(const model *m, double cosine, double level)
{
    static grid g;
    size_t count = walk_count(400000);
    walk_hit h;
    unsigned long long state = 99;
    lit l = {m, {0}};
    hit_of(m, cosine, &h);
    widen(h.wi, l.i);
    walk_bins(&g);
    grid_expect(&g, single_towards, &l, (double)count, 1e-7);
    for (size_t k = 0; k < count; k++) {
        float u[3];
        vndf_scattered w;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&h.bsdf, u, &w);
        g.observed[w.lobe == VNDF_LOBE_NONE ? grid_elsewhere(&g) : walk_bin(w.wo)] += 1.0;
    }
    pearson found = grid_test(&g);
    if (!TEST(found.p > level && found.classes > 6))
        fprintf(stderr, "  beckmann %d, alpha %g %g, eta %g, cos %g: p %g, %lu classes\n", m->beckmann, m->ax,
                m->ay, m->eta, cosine, found.p, (unsigned long)found.classes);
}

/* Tables: the library's own D and G2. Half vectors are rounded to float: 1e-4 of D at these roughnesses. */
static void test_table(int subject)
{
    const vndf_distribution *d = walk_subject(subject);
    float scale = (float)vndf_distribution_info(d).scale;
    vndf_surface surface = {d, 0.8f / scale, 0.4f / scale};
    vndf_description is = walk_of_mirror();
    unsigned long long state = 78;
    walk_hit at;
    is.order_limit = 1;
    walk_hit_at(&at, &is, d, surface.alpha_x, surface.alpha_y, walk_direction(0.4, 1.0));
    for (int k = 0; k < 3000; k++) {
        double i[3], o[3], z = test_uniform_double(&state);
        vndf_vec3 wo = walk_direction(z, 2.0 * PI * test_uniform_double(&state));
        widen(at.wi, i);
        widen(wo, o);
        double h[3] = {i[0] + o[0], i[1] + o[1], i[2] + o[2]}, length = sqrt(dot(h, h));
        vndf_vec3 wm = {walk_rounded(h[0] / length), walk_rounded(h[1] / length), walk_rounded(h[2] / length)};
        double want = (double)vndf_ndf(&surface, wm) / (4.0 * i[2]) *
                      (double)vndf_g2(&surface, at.wi, wo, VNDF_G2_HEIGHT_CORRELATED);
        TEST_NEAR(walk_eval(&at, wo, 1), want, 1e-4 * want + 1e-21); /* rounding of wm shows in D's far tail */
    }
    walk_subject_free(d);
}

int main(void)
{
    static const model models[] = {{0, 0.3f, 0.3f, 0},     {0, 1, 1, 0},          {0, 0.4f, 1, 0},
                                   {1, 0.5f, 0.5f, 0},     {0, 0.5f, 0.5f, 1.5f}, {1, 0.7f, 0.7f, 1.5f},
                                   {0, 1, 1, 1.0f / 1.5f}, {0, 0.4f, 0.7f, 2.4f}};
    static const double cosines[] = {1.0, 0.5, 0.15};
    enum { MODELS = sizeof models / sizeof *models, COSINES = 3 };
    for (int i = 0; i < MODELS; i++)
        for (int j = 0; j < COSINES; j++) {
            test_formula(&models[i], cosines[j]);
            test_samples(&models[i], cosines[j], statistics_sidak(1e-3, MODELS * COSINES));
        }
    for (int i = 2; i < WALK_SUBJECTS; i++)
        test_table(i);
    return test_done();
}
