/* The mean weight of samples is the albedo, the integral of f cos over directions, by quadrature, for visible,
 * bounded and all normals and V-cavities, within 4.5 sigma (7e-6 each); it is at most 1 wherever masking
 * conserves energy, for lossless reflection and glass that carries importance; weights of visible normals never
 * exceed Fresnel's term, for tables times the certificate's largest weight, and bounded normals of tables lose nothing.
 * Prints the largest weights side by side, and what single scattering loses. */
#include "bsdf/bsdf_case.h"

typedef struct tally {
    double sum, square, largest, lost;
} tally;

static tally tally_of(const vndf_bsdf *bsdf, size_t samples, unsigned long long *state)
{
    tally t = {0, 0, 0, 0};
    for (size_t i = 0; i < samples; i++) {
        vndf_scattered s;
        float u[3];
        bsdf_numbers(state, u);
        vndf_bsdf_sample(bsdf, u, &s);
        double w = (double)s.weight[0];
        t.sum += w / (double)samples;
        t.square += w * w / (double)samples;
        t.largest = fmax(t.largest, w);
        t.lost += s.lobe == VNDF_LOBE_NONE;
    }
    return t;
}

/* The integral of f |cos| over the sphere: the mean of f |cos|/pdf over bins, each with its own rule. */
static double albedo_by_quadrature(const vndf_bsdf *bsdf)
{
    enum { RINGS = 400, TURNS = 256 };
    double sum = 0;
    for (int i = 0; i < RINGS; i++) /* cosines even: f cos is smooth for these rough surfaces */
        for (int j = 0; j < TURNS; j++) {
            float f[VNDF_WAVELENGTHS];
            double z = 2 * (i + 0.5) / RINGS - 1;
            vndf_bsdf_eval(bsdf, oracle_toward(z, 2 * PI * (j + 0.5) / TURNS), 0, f);
            sum += (double)f[0] * fabs(z);
        }
    return sum * 4 * PI / (RINGS * TURNS);
}

static vndf_description material_of(const oracle_ndf *ndf, vndf_normals_drawn normals, int glass, float alpha)
{
    vndf_description is = {.distribution = ndf->distribution, .alpha_x = alpha, .alpha_y = alpha, .eta = 1.5f};
    is.effects.normals = normals;
    is.effects.lobes = glass ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is.effects.fresnel = glass ? VNDF_FRESNEL_DIELECTRIC : VNDF_FRESNEL_NONE;
    is.effects.transport = VNDF_TRANSPORT_IMPORTANCE;
    is.effects.masking =
        normals == VNDF_NORMALS_V_CAVITY ? VNDF_MASKING_V_CAVITIES : VNDF_MASKING_HEIGHT_CORRELATED;
    return is;
}

static tally check_one(const oracle_ndf *ndf, const vndf_description *is, double z, unsigned long long seed)
{
    unsigned long long state = seed;
    size_t samples = test_quick() ? 5000 : 40000;
    vndf_info info = vndf_distribution_info(ndf->distribution);
    vndf_certificate certificate = info.certificate;
    double scale = (double)is->alpha_x * info.scale; /* of slopes: what a quadrature of even cosines resolves */
    double most = certificate.weight_bounded > 0 ? (double)certificate.max_weight : 1;
    vndf_material material;
    vndf_bsdf bsdf;
    TEST(vndf_material_resolve(is, &material, NULL) == VNDF_OK);
    TEST(vndf_bsdf_at(&bsdf, &material, oracle_toward(z, 0.3)));
    tally t = tally_of(&bsdf, samples, &state);
    double sigma = sqrt(fmax(t.square - t.sum * t.sum, 0) / (double)samples);
    int good = TEST(t.sum <= 1 + 4.5 * sigma + 1e-5);
    if (is->effects.normals == VNDF_NORMALS_VISIBLE)
        good &= TEST(t.largest <= most * (1 + 1e-5));
    if (is->effects.normals == VNDF_NORMALS_BOUNDED && info.certificate.tv > 0) /* a table */
        good &= TEST(t.lost == 0);
    if (scale >= 0.5 && fabs(z) > 0.3)
        good &= TEST_NEAR(t.sum, albedo_by_quadrature(&bsdf), 4.5 * sigma + 2e-3);
    if (!good) {
        bsdf_describe(is, ndf->name, oracle_toward(z, 0.3), oracle_toward(z, 0.3));
        fprintf(stderr, "    albedo %.6g +- %.2g, largest weight %.6g\n", t.sum, sigma, t.largest);
    }
    return t;
}

static void test_ndf(const char *name, unsigned long long seed)
{
    static const float alphas[] = {0.05f, 0.3f, 1};
    static const double cosines[] = {1, 0.5, 0.05, -0.7};
    oracle_ndf ndf;
    if (!TEST(oracle_ndf_open(&ndf, name)))
        return;
    for (int glass = 0; glass < 2; glass++)
        for (int a = 0; a < 3; a++)
            for (int k = 0; k < 3 + glass; k++) {
                double largest[4] = {0, 0, 0, 0}, albedo = 0;
                for (int n = 0; n < 4; n++) {
                    vndf_description is = material_of(&ndf, (vndf_normals_drawn)n, glass, alphas[a]);
                    if (!oracle_effects_sensible(&is.effects))
                        continue;
                    tally t = check_one(&ndf, &is, cosines[k], ++seed);
                    largest[n] = t.largest;
                    albedo = n == VNDF_NORMALS_VISIBLE ? t.sum : albedo;
                }
                printf(
                    "%s, %s, alpha %.2f, cos %.2f: lost %.4f; largest weight visible %.3f, bounded %.3f, all %.4g, "
                    "V-cavity %.3f\n",
                    name, glass ? "glass" : "mirror", (double)alphas[a], cosines[k], 1 - albedo, largest[0],
                    largest[1], largest[2], largest[3]);
            }
    oracle_ndf_close(&ndf);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5", "sgd-nickel-g"};
    for (size_t i = 0; i < 4; i++)
        if (oracle_wanted(arguments, argument, i, names[i]))
            test_ndf(names[i], 1000 * i + 77);
    return test_done();
}
