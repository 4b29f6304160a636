/* A hit whose principal axes are turned costs no more roundings than one whose axes are not. In 40000 samples of each,
 * of Beckmann and a table, bare and of glass, roughness 0.05 to 0.15, the density of a sample is as close to that of
 * vndf_bsdf_pdf, root of the mean square, within 8%; and as many samples, within a hundredth, are evaluated anew
 * where they went: their density is that of vndf_bsdf_pdf to the bit. A rotation that a hit brings gives the bits of
 * the same rotation of a material. Walks have the density of vndf_bsdf_pdf, within 1e-5, and so have hits that a
 * rounding might take from the front of a table to its wedge. */
#include "bsdf/bsdf_case.h"

enum { SAMPLES = 40000, OF_ONE = 20 };

typedef struct tally {
    double squares;
    size_t kept, same;
} tally;

/* Above the horizon by 3 degrees at least. */
static vndf_vec3 direction(unsigned long long *state)
{
    double z = 0.05 + 0.95 * test_uniform_double(state);
    return oracle_toward(z, 2 * PI * test_uniform_double(state));
}

/* ---- roundings ---- */

static vndf_description describe(const oracle_ndf *ndf, int both, vndf_shape shape, unsigned long long *state)
{
    vndf_description is = {.distribution = ndf->distribution, .eta = 1.5f, .effects = {.shape = shape}};
    is.alpha_x = 0.05f + 0.1f * test_uniform(state);
    is.alpha_y = 0.05f + 0.1f * test_uniform(state);
    is.rotation = 6.2831853f * test_uniform(state);
    if (both) {
        is.effects.lobes = VNDF_LOBES_BOTH;
        is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    }
    return is;
}

static void add_sample(const vndf_material *m, unsigned long long *state, tally *t)
{
    vndf_bsdf b;
    vndf_scattered s;
    float u[3];
    vndf_vec3 wi = direction(state);
    bsdf_numbers(state, u);
    TEST(vndf_bsdf_at(&b, m, wi));
    vndf_bsdf_sample(&b, u, &s);
    if (s.lobe == VNDF_LOBE_NONE)
        return;
    float pdf = vndf_bsdf_pdf(&b, s.wo);
    double off = (double)pdf / (double)s.density - 1;
    t->kept++;
    t->same += pdf == s.density;
    t->squares += off * off;
}

static tally sample(const oracle_ndf *ndf, int both, vndf_shape shape)
{
    unsigned long long state = 5;
    tally t = {0, 0, 0};
    for (int k = 0; k < SAMPLES / OF_ONE; k++) {
        vndf_description is = describe(ndf, both, shape, &state);
        vndf_material m;
        TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK);
        for (int i = 0; i < OF_ONE; i++)
            add_sample(&m, &state, &t);
    }
    return t;
}

static void test_roundings(const oracle_ndf *ndf, int both)
{
    tally aligned = sample(ndf, both, VNDF_SHAPE_ALIGNED), turned = sample(ndf, both, VNDF_SHAPE_ROTATED);
    double root = sqrt(aligned.squares / (double)aligned.kept),
           root_turned = sqrt(turned.squares / (double)turned.kept);
    double same = (double)aligned.same / (double)aligned.kept,
           same_turned = (double)turned.same / (double)turned.kept;
    printf("%s, %s: density within %.3g of the pdf, turned %.3g; %.2f%% of samples have its bits, turned %.2f%%\n",
           ndf->name, both ? "glass" : "bare", root, root_turned, 100 * same, 100 * same_turned);
    TEST(turned.kept > aligned.kept / 2 && root_turned < 1.08 * root && same_turned < same + 0.01);
}

/* ---- a rotation of the hit ---- */

static int is_same(const vndf_scattered *a, const vndf_scattered *b)
{
    return a->wo.x == b->wo.x && a->wo.y == b->wo.y && a->wo.z == b->wo.z && a->density == b->density &&
           a->weight[0] == b->weight[0] && a->lobe == b->lobe;
}

static void test_rotation_of_hit(const oracle_ndf *ndf)
{
    unsigned long long state = 6;
    for (int k = 0; k < 500; k++) {
        vndf_description is = describe(ndf, k % 2, VNDF_SHAPE_ROTATED, &state), other = is;
        other.rotation += 1.0f;
        vndf_material m, turned;
        vndf_bsdf of_hit, of_material;
        vndf_scattered a, b;
        vndf_vec3 wi = bsdf_direction(&state);
        float u[3];
        wi.z = fabsf(wi.z);
        bsdf_numbers(&state, u);
        TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK);
        TEST(vndf_material_resolve(&other, &turned, NULL) == VNDF_OK);
        vndf_roughness own = turned.roughness;
        TEST(vndf_bsdf_rough(&of_hit, &m, &own, wi) && vndf_bsdf_at(&of_material, &turned, wi));
        vndf_bsdf_sample(&of_hit, u, &a);
        vndf_bsdf_sample(&of_material, u, &b);
        TEST(is_same(&a, &b) && vndf_bsdf_pdf(&of_hit, a.wo) == vndf_bsdf_pdf(&of_material, a.wo));
    }
}

/* ---- the side of wi ---- */

/* u1 of a normal between the front of a table and its wedge, within some roundings. */
static float at_side(const vndf_bsdf *b, unsigned long long *state)
{
    double front = (double)b->view.of.table.front, part = front / (front + (double)b->view.of.table.wedge);
    return (float)(0.5 + 0.5 * part + 4e-7 * (test_uniform_double(state) - 0.5));
}

/* The border between front and wedge, where the density of a table jumps: of turned hits, and of others. */
static void test_side(const oracle_ndf *ndf, int both)
{
    unsigned long long state = 8;
    double worst = 0;
    for (int k = 0; k < 4000; k++) {
        vndf_description is = describe(ndf, both, k % 2 ? VNDF_SHAPE_ROTATED : VNDF_SHAPE_ALIGNED, &state);
        vndf_material m;
        vndf_bsdf b;
        vndf_scattered s;
        float u[3];
        is.alpha_y = is.alpha_x *= 3.0f;
        vndf_vec3 wi = direction(&state);
        bsdf_numbers(&state, u);
        TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK && vndf_bsdf_at(&b, &m, wi));
        u[0] = at_side(&b, &state);
        vndf_bsdf_sample(&b, u, &s);
        if (s.lobe != VNDF_LOBE_NONE)
            worst = fmax(worst, fabs((double)vndf_bsdf_pdf(&b, s.wo) / (double)s.density - 1));
    }
    printf("%s, %s: density beside the wedge within %.2g\n", ndf->name, both ? "glass" : "bare", worst);
    TEST(worst <= 1e-5);
}

/* ---- walks ---- */

static void test_walks(const oracle_ndf *ndf)
{
    unsigned long long state = 7;
    double worst = 0;
    for (int k = 0; k < 2000; k++) {
        vndf_description is = describe(ndf, 0, VNDF_SHAPE_ROTATED, &state);
        vndf_material m;
        vndf_bsdf b;
        vndf_scattered s;
        vndf_vec3 wi = direction(&state);
        float u[3];
        is.effects.scattering = VNDF_SCATTERING_MULTIPLE;
        is.alpha_x *= 0.02f;
        bsdf_numbers(&state, u);
        TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK && vndf_bsdf_at(&b, &m, wi));
        vndf_bsdf_sample(&b, u, &s);
        if (s.lobe == VNDF_LOBE_REFLECTION)
            worst = fmax(worst, fabs((double)vndf_bsdf_pdf(&b, s.wo) / (double)s.density - 1));
    }
    printf("%s: density of walks within %.2g\n", ndf->name, worst);
    TEST(worst <= 1e-5);
}

int main(void)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5"};
    for (size_t i = 0; i < 3; i++) {
        oracle_ndf ndf;
        if (!TEST(oracle_ndf_open(&ndf, names[i])))
            continue;
        if (i > 0)
            test_roundings(&ndf, 0);
        test_roundings(&ndf, 1);
        test_rotation_of_hit(&ndf);
        test_walks(&ndf);
        for (int both = 0; both < 2 && i == 2; both++)
            test_side(&ndf, both);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
