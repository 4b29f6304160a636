/* The quadrature of albedos is right: for closed forms, shipped tables and a disc, mirrors and dielectrics, it agrees
 * with a midpoint rule over slopes and azimuths that shares no code with src/ (D and areas of the oracle, Fresnel by
 * complex arithmetic, Beta by lgamma), and with what is known exactly: E = 1 - log 2 for GGX of alpha 1 from straight
 * above, E = 1 at grazing incidence and in the limit of no roughness, and reciprocity, which makes what passes from
 * above eta^2 times what passes from below.
 *
 * For GGX with alpha = 1 D is 1/pi and G1 = 2 cos_o/(1 + cos_o), cos_o = cos(2 theta_m), so with u = cos_o the albedo
 * is the integral of u/(1 + u) from 0 to 1. */
#include "bsdf/albedo/quadrature.h"
#include "bsdf/bsdf_case.h"

/* One wi, and what the rule needs of it. */
typedef struct incidence {
    const oracle_ndf *ndf;
    double alpha[2], wi[3], eta, area;
} incidence;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* cos_i A(wo) and so on: G2/G1 = A_i cos_o/(A_i cos_o + cos_i A(-wo)). */
static double reflected_weight(const incidence *at, const double wm[3], double facing)
{
    double cos_o = 2 * facing * wm[2] - at->wi[2];
    double below[3] = {at->wi[0] - 2 * facing * wm[0], at->wi[1] - 2 * facing * wm[1], -cos_o};
    if (!(cos_o > 0))
        return 0;
    return at->area * cos_o / (at->area * cos_o + at->wi[2] * oracle_ndf_area(at->ndf, at->alpha, below));
}

/* Beta(1 + Lambda_i, 1 + Lambda_o) (1 + Lambda_i). */
static double transmitted_weight(const incidence *at, const double wm[3], double facing)
{
    double square = 1 - (1 - facing * facing) / (at->eta * at->eta), wo[3];
    if (!(square > 0))
        return 0;
    for (int i = 0; i < 3; i++)
        wo[i] = at->wi[i] / at->eta - (facing / at->eta - sqrt(square)) * wm[i]; /* turned up */
    if (!(wo[2] > 0))
        return 0;
    double i = at->area / at->wi[2], o = oracle_ndf_area(at->ndf, at->alpha, wo) / wo[2];
    return i * exp(lgamma(i) + lgamma(o) - lgamma(i + o));
}

static vndf_parts by_midpoints(const oracle_ndf *ndf, double cosine, double alpha, double eta)
{
    int slopes = (int)test_amount(300, 500, 1000), turns = (int)test_amount(200, 300, 500);
    double median = vndf_distribution_info(ndf->distribution).scale * alpha, sine = sqrt(1 - cosine * cosine);
    incidence at = {ndf, {alpha, alpha}, {sine, 0, cosine}, eta, 0};
    vndf_parts sum = {0, 0};
    at.area = oracle_ndf_area(ndf, at.alpha, at.wi);
    for (int i = 0; i < slopes; i++) {
        double q = (i + 0.5) / slopes, r = median * q / (1 - q), z = 1 / sqrt(1 + r * r);
        double ring = z * z * z * r * median / ((1 - q) * (1 - q)) / slopes * 2 * PI / turns; /* dwm */
        const double up[3] = {-r * z, 0, z};
        double density = oracle_ndf_density(ndf, at.alpha, up);
        for (int j = 0; j < turns && density > 0; j++) {
            double turn = PI * (j + 0.5) / turns, wm[3] = {r * z * cos(turn), r * z * sin(turn), z};
            double facing = dot(at.wi, wm);
            if (!(facing > 0))
                continue;
            double visible = density * facing / at.area * ring;
            double f = eta > 0 ? (double)oracle_fresnel((long double)facing, (long double)eta, 0) : 1;
            sum.reflected += visible * f * reflected_weight(&at, wm, facing);
            if (f < 1)
                sum.transmitted += visible * (1 - f) * transmitted_weight(&at, wm, facing);
        }
    }
    return sum;
}

/* `within`: the midpoint rule's own error, largest where D jumps and where F has a root. */
static void test_subject(const char *name, double within)
{
    static const double alphas[] = {0.05, 0.3, 1}, cosines[] = {1, 0.6, 0.15, 0.02}, etas[] = {0, 1.5, 1 / 1.5};
    oracle_ndf ndf;
    vndf_quadrature q;
    if (!TEST(oracle_ndf_open(&ndf, name)) || !TEST(vndf_quadrature_of(&q, ndf.distribution, 1)))
        return;
    double worst = 0;
    for (int i = 0; i < 3 * 4 * 3; i++) {
        double alpha = alphas[i / 12], cosine = cosines[i / 3 % 4], eta = etas[i % 3];
        if (!test_long() && (i + i / 3) % 2)
            continue;
        vndf_parts got = vndf_quadrature_albedo(&q, cosine, alpha, eta);
        vndf_parts want = by_midpoints(&ndf, cosine, alpha, eta);
        int good = TEST_NEAR(got.reflected, want.reflected, within);
        good &= TEST_NEAR(got.transmitted, want.transmitted, within);
        if (!good)
            fprintf(stderr, "  %s, cosine %g, alpha %g, eta %g\n", name, cosine, alpha, eta);
        worst = fmax(worst, fmax(fabs(got.reflected - want.reflected), fabs(got.transmitted - want.transmitted)));
    }
    printf("%s: at most %.2g from the midpoint rule\n", name, worst);
    vndf_quadrature_free(&q);
    oracle_ndf_close(&ndf);
}

/* 2 integral T mu dmu from a side. */
static double passes(const vndf_quadrature *q, double alpha, double eta)
{
    enum { CELLS = 64 };
    vndf_gauss_rule rule;
    double sum = 0;
    vndf_gauss_rule_of(&rule, 3);
    for (int i = 0; i < CELLS * 3; i++) {
        double root = (i / 3 + rule.node[i % 3]) / CELLS, cosine = root * root; /* many near grazing */
        sum += rule.weight[i % 3] / CELLS * 4 * root * cosine *
               vndf_quadrature_albedo(q, cosine, alpha, eta).transmitted;
    }
    return sum;
}

static void test_known(const vndf_distribution *d, const char *name)
{
    static const double etas[] = {1.33, 1.5, 2.4};
    vndf_quadrature q;
    if (!TEST(vndf_quadrature_of(&q, d, 1)))
        return;
    for (int i = 0; i < 3; i++) {
        double alpha = i == 0 ? 0.1 : 0.4 * i, eta = etas[i];
        double above = passes(&q, alpha, eta), below = passes(&q, alpha, 1 / eta);
        if (!TEST_RELATIVE(above, eta * eta * below, 3e-4))
            fprintf(stderr, "  %s, alpha %g, eta %g: %.7g from above, %.7g from below\n", name, alpha, eta, above,
                    below);
        /* cells of a table keep the mass of slopes; their mean is that of the areas within 1e-4 */
        TEST_NEAR(vndf_quadrature_albedo(&q, 0, alpha, 0).reflected, 1, 1e-4);
        TEST(vndf_quadrature_albedo(&q, 0, alpha, eta).transmitted == 0);
        TEST_NEAR(vndf_quadrature_albedo(&q, 0.5, 1e-5, 0).reflected, 1, 1e-3);
        vndf_parts smooth = vndf_quadrature_albedo(&q, 0.5, 1e-5, eta);
        TEST_NEAR(smooth.reflected, (double)vndf_fresnel_dielectric(0.5f, (float)eta), 1e-3);
        TEST_NEAR(smooth.reflected + smooth.transmitted, 1, 1e-3);
    }
    vndf_quadrature_free(&q);
}

/* Twice the nodes change nothing: panels are cut where the integrand is not smooth. */
static void test_closed(void)
{
    static const double cosines[] = {1, 0.83, 0.55, 0.1};
    vndf_quadrature q, finer;
    if (!TEST(vndf_quadrature_of(&q, vndf_ggx(), 1)) || !TEST(vndf_quadrature_of(&finer, vndf_ggx(), 2)))
        return;
    for (int i = 0; i < 12; i++) {
        double cosine = cosines[i % 4], alpha = 0.13 + 0.4 * (i / 4);
        TEST_NEAR(vndf_quadrature_albedo(&q, cosine, alpha, 0).reflected,
                  vndf_quadrature_albedo(&finer, cosine, alpha, 0).reflected, 5e-7);
        vndf_parts p = vndf_quadrature_albedo(&q, cosine, alpha, 0.7);
        TEST(p.reflected == vndf_quadrature_reflected(&q, cosine, alpha, 0.7));
    }
    vndf_quadrature_free(&finer);
    TEST_NEAR(vndf_quadrature_albedo(&q, 1, 1, 0).reflected, 1 - log(2), 1e-6);
    vndf_quadrature_free(&q);
}

/* A polynomial of degree 2 n - 1 is integrated exactly. */
static void test_rules(void)
{
    for (int n = 1; n <= VNDF_GAUSS_RULE_MAX; n++) {
        vndf_gauss_rule rule;
        double sum = 0;
        vndf_gauss_rule_of(&rule, n);
        for (int i = 0; i < n; i++)
            sum += rule.weight[i] * pow(rule.node[i], 2 * n - 1);
        TEST_RELATIVE(sum, 1 / (2.0 * n), 1e-11);
    }
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5-small", "hazy", "gtr-1.5"};
    if (oracle_wanted(arguments, argument, 0, "known")) {
        test_rules();
        test_closed();
        test_known(vndf_ggx(), "ggx");
        test_known(vndf_beckmann(), "beckmann");
        vndf_distribution *table = oracle_shipped("student-t-2.5-small");
        test_known(table, "student-t-2.5-small");
        vndf_free(table);
    }
    for (size_t i = 0; i < 5; i++)
        if (oracle_wanted(arguments, argument, i + 1, names[i]))
            test_subject(names[i], test_quick() ? 1.5e-3 : 5e-4);
    return test_done();
}
