/* Perfect sampling leaves next to nothing of the variance of a BSDF alone, and is exact: for conductors,
 * dielectrics from both sides, axes turned and a table, at directions between its nodes, the relative variance of
 * the luminance of the weight (over what refraction makes of radiance) is below 0.02, and where it exceeds 0.001
 * below half of that of visible normals. Both have the same mean; values are the library's; the density of a
 * sample is that of its direction; and directions are drawn with that density: chi-square, where the probabilities
 * of the bins are means over visible normals, level 1e-3 for all.
 *
 * Means, and how much is reflected, are compared within 4.5 sigma: 7e-6 for each of 38 to fail by chance. */
#include "harness/constants.h"
#include "oracle/oracle_bsdf.h"
#include "render/path_case.h"
#include "render/perfect/perfect.h"
#include "measure/statistics.h"
#include "statistics/grid.h"

enum { BIN_SIDE = 12, BINS = BIN_SIDE * BIN_SIDE + 1, PILOTS = 4000 };

typedef struct subject {
    const char *name;
    const vndf_distribution *distribution; /* NULL: the table */
    float alpha_x, alpha_y;
    int transmits;
} subject;

/* A hit as both samplers see it, the axes of the roughness turned. */
typedef struct twin {
    perfect_hit perfect;
    vndf_material material;
    vndf_bsdf visible;
    vndf_vec3 wi;
    float eta;                  /* index on the other side over that on the side of wi */
    double reflected, variance; /* of all directions: how many more than expected, and its variance */
} twin;

static const vndf_roughness turned = {1.0f, 1.0f, 0.8f, 0.6f};
static unsigned long long state = 20231;

static vndf_description describe(const subject *s, const vndf_distribution *table)
{
    vndf_description is = {.distribution = s->distribution ? s->distribution : table,
                           .alpha_x = s->alpha_x,
                           .alpha_y = s->alpha_y,
                           .eta = 1.5f,
                           .rotation = 0.6435011f,
                           .conductor_eta = {0.2f, 0.5f, 1.2f},
                           .conductor_k = {3.9f, 2.3f, 1.7f}};
    is.effects.lobes = s->transmits ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is.effects.fresnel = s->transmits ? VNDF_FRESNEL_DIELECTRIC : VNDF_FRESNEL_CONDUCTOR;
    is.effects.shape = VNDF_SHAPE_ROTATED;
    return is;
}

static void draw(const twin *t, int perfect, vndf_scattered *s)
{
    float u[3];
    for (int i = 0; i < 3; i++)
        u[i] = test_uniform(&state);
    if (perfect)
        path_perfect_sample(&t->perfect, u, s);
    else
        vndf_bsdf_sample(&t->visible, u, s);
}

/* ---- variance ---- */

static double worth(const twin *t, const vndf_scattered *s)
{
    double back = s->lobe == VNDF_LOBE_TRANSMISSION ? (double)t->eta * (double)t->eta : 1;
    return back * (0.2126 * (double)s->weight[0] + 0.7152 * (double)s->weight[1] + 0.0722 * (double)s->weight[2]);
}

/* And the variance of one sample over the square of the mean. */
static case_mean mean_weight(const twin *t, int perfect, unsigned count, double *variance)
{
    double sum = 0, square = 0;
    for (unsigned i = 0; i < count; i++) {
        vndf_scattered s;
        draw(t, perfect, &s);
        double w = worth(t, &s);
        sum += w / count;
        square += w * w / count;
    }
    *variance = fmax(square / (sum * sum) - 1, 0);
    return (case_mean){sum, sum * sqrt(*variance / count)};
}

static void test_variance(const twin *t, const char *name, vndf_vec3 wi, unsigned count)
{
    double perfect, visible;
    case_mean drawn = mean_weight(t, 1, count, &perfect), mean = mean_weight(t, 0, count, &visible);
    case_agree(name, drawn, mean);
    if (!test_quick()) /* a few samples of large weight make up a good part of it */
        TEST(perfect < 0.02 && perfect < fmax(0.5 * visible, 0.001));
    printf("%-24s z %5.2f  albedo %.4f  variance of visible %.2e, perfect %.2e\n", name, (double)wi.z, mean.value,
           visible, perfect);
}

/* ---- densities ---- */

/* On a border between cells a rounding may change the cell: some 1 in 1e4. */
static void test_density(const twin *t, unsigned count)
{
    unsigned off = 0;
    for (unsigned i = 0; i < count; i++) {
        vndf_scattered s;
        float f[3], g[3];
        draw(t, 1, &s);
        if (s.lobe == VNDF_LOBE_NONE)
            continue;
        double pdf = (double)path_perfect_pdf(&t->perfect, s.wo);
        off += !(fabs(pdf / (double)s.density - 1) < 1e-3);
        path_perfect_eval(&t->perfect, s.wo, f);
        vndf_bsdf_eval(&t->visible, s.wo, 0, g);
        TEST_RELATIVE((double)f[1], (double)g[1], 2e-3);
    }
    TEST(off <= 4 + count / 1000);
}

/* ---- drawn with the density ---- */

static double azimuth(const twin *t, vndf_vec3 wo)
{
    return (double)atan2f(t->wi.x * wo.y - t->wi.y * wo.x, t->wi.x * wo.x + t->wi.y * wo.y);
}

static void place_bins(const twin *t, grid *g)
{
    static double z[PILOTS], phi[PILOTS];
    size_t count = 0;
    grid_even(g, BIN_SIDE, -1, 1, BIN_SIDE, -PI, PI);
    for (int i = 0; i < PILOTS; i++) {
        vndf_scattered s;
        draw(t, 1, &s);
        if (s.lobe == VNDF_LOBE_NONE)
            continue;
        z[count] = (double)s.wo.z;
        phi[count++] = azimuth(t, s.wo);
    }
    grid_quantiles(g->x, BIN_SIDE, z, count);
    grid_quantiles(g->y, BIN_SIDE, phi, count);
}

static size_t bin_of(const grid *g, const twin *t, const vndf_scattered *s)
{
    return s->lobe == VNDF_LOBE_NONE ? grid_elsewhere(g) : grid_bin(g, (double)s->wo.z, azimuth(t, s->wo));
}

/* Visible normals count by the ratio of the densities; what they miss of 1 is what is lost. An expectation is a mean,
 * so its own variance counts as well. */
static void count_bins(twin *t, unsigned count, grid *g, double *variance)
{
    const size_t lost = grid_elsewhere(g);
    g->expected[lost] = count;
    for (unsigned i = 0; i < count; i++) {
        vndf_scattered s;
        draw(t, 1, &s);
        g->observed[bin_of(g, t, &s)] += 1;
        t->reflected += s.lobe == VNDF_LOBE_REFLECTION;
        t->variance += s.lobe == VNDF_LOBE_REFLECTION;
        draw(t, 0, &s);
        if (s.lobe == VNDF_LOBE_NONE)
            continue;
        double ratio = (double)path_perfect_pdf(&t->perfect, s.wo) / (double)s.density;
        g->expected[bin_of(g, t, &s)] += ratio;
        variance[bin_of(g, t, &s)] += ratio * ratio;
        g->expected[lost] -= ratio;
        variance[lost] += (ratio - 1) * (ratio - 1);
        t->reflected -= s.lobe == VNDF_LOBE_REFLECTION ? ratio : 0;
        t->variance += s.lobe == VNDF_LOBE_REFLECTION ? ratio * ratio : 0;
    }
    for (size_t i = 0; i <= lost; i++)
        variance[i] += fmax(g->expected[i], 0);
}

static double test_chi_square(twin *t, unsigned count)
{
    static grid g;
    double variance[BINS] = {0};
    place_bins(t, &g);
    count_bins(t, count, &g, variance);
    return pearson_of(g.expected, g.observed, variance, BINS, 25).p;
}

/* ---- subjects ---- */

static void test_subject(const subject *s, const vndf_distribution *table, double level)
{
    static const float heights[] = {0.96f, 0.71f, 0.33f, 0.06f, -0.93f, -0.72f, -0.41f, -0.12f};
    unsigned count = test_quick() ? 4000 : 20000;
    vndf_description is = describe(s, table);
    vndf_error error = {VNDF_OK, ""};
    path_perfect *perfect = path_perfect_make(&is, &error);
    twin t = {.reflected = 0};
    if (!TEST(perfect != NULL))
        return;
    TEST(path_perfect_bytes(perfect) > 100000 && path_perfect_bytes(perfect) < 20000000);
    TEST(vndf_material_resolve(&is, &t.material, NULL) == VNDF_OK);
    for (int i = 0; i < (s->transmits ? 8 : 4); i++) {
        vndf_vec3 wi = oracle_toward((double)heights[i], 0.4 + 0.9 * i);
        t.wi = wi;
        t.eta = wi.z > 0 ? is.eta : 1 / is.eta;
        TEST(path_perfect_begin(&t.perfect, perfect, &turned, wi) && vndf_bsdf_at(&t.visible, &t.material, wi));
        test_variance(&t, s->name, wi, count);
        test_density(&t, count / 10);
        double p = test_chi_square(&t, count);
        if (!TEST(p > level))
            fprintf(stderr, "    %s, z %g: p %.3g\n", s->name, (double)wi.z, p);
    }
    TEST_NEAR(t.reflected, 0, 4.5 * sqrt(t.variance));
    path_perfect_free(perfect);
}

static void test_subjects(void)
{
    const subject list[] = {{"conductor, GGX 0.15", vndf_ggx(), 0.15f, 0.15f, 0},
                            {"conductor, GGX 0.8", vndf_ggx(), 0.8f, 0.8f, 0},
                            {"dielectric, GGX 0.05", vndf_ggx(), 0.05f, 0.05f, 1},
                            {"dielectric, GGX 0.5", vndf_ggx(), 0.5f, 0.5f, 1},
                            {"Beckmann 0.05 x 0.4", vndf_beckmann(), 0.05f, 0.4f, 0},
                            {"Student-T 2.5, 0.5", NULL, 0.5f, 0.5f, 0}};
    size_t count = sizeof list / sizeof list[0];
    double level = statistics_sidak(1e-3, 32);
    oracle_ndf table;
    if (!TEST(oracle_ndf_open(&table, "student-t-2.5")))
        return;
    for (size_t i = 0; i < count; i++)
        test_subject(&list[i], table.distribution, level);
    oracle_ndf_close(&table);
}

int main(void)
{
    test_subjects();
    return test_done();
}
