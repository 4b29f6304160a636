/* Every set of effects is taken if it makes sense and refused if not, by a message that names what is wrong; so
 * is every number out of its range, and NaN. What is not asked for is not read. A material that was refused is
 * safe: it scatters nothing. The error is the caller's, may be NULL and is left alone where nothing is wrong. */
#include <stddef.h>

#include "bsdf/bsdf_case.h"

static vndf_description good(vndf_effects effects)
{
    vndf_description is = {.distribution = vndf_ggx(),
                           .effects = effects,
                           .alpha_x = 0.3f,
                           .alpha_y = 0.2f,
                           .eta = 1.5f,
                           .f0 = {0.04f, 0.04f, 0.04f},
                           .conductor_eta = {0.2f, 0.9f, 1.1f},
                           .conductor_k = {3.9f, 2.4f, 2.2f}};
    return is;
}

static void check_nothing(const vndf_material *material)
{
    const vndf_vec3 wi = {0.6f, 0, 0.8f}, wo = {-0.6f, 0, 0.8f};
    const float u[3] = {0.3f, 0.4f, 0.5f};
    vndf_roughness roughness = {0.1f, 0.1f, 1, 0};
    float f[VNDF_WAVELENGTHS] = {1, 1, 1};
    vndf_scattered s;
    vndf_bsdf bsdf;
    TEST(!vndf_bsdf_rough(&bsdf, material, &roughness, wi) && !vndf_bsdf_at(&bsdf, material, wi));
    vndf_bsdf_sample(&bsdf, u, &s);
    vndf_bsdf_eval(&bsdf, wo, 1, f);
    TEST(s.lobe == VNDF_LOBE_NONE && s.density == 0 && s.weight[0] == 0 && s.weight[1] == 0 && s.weight[2] == 0);
    TEST(f[0] == 0 && f[1] == 0 && f[2] == 0 && vndf_bsdf_pdf(&bsdf, wo) == 0);
}

static void test_sets(void)
{
    size_t taken = 0;
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects effects = oracle_effects(i);
        vndf_description is = good(effects);
        vndf_material material;
        vndf_error error = {VNDF_OK, "untouched"};
        char text[ORACLE_EFFECTS_TEXT];
        int sensible = oracle_effects_sensible(&effects);
        vndf_status status = vndf_material_resolve(&is, &material, &error);
        oracle_effects_name(&effects, text);
        if (!TEST(status == (sensible ? VNDF_OK : VNDF_ERROR_ARGUMENT)))
            fprintf(stderr, "  %s\n", text);
        TEST(error.status == status && (strcmp(error.message, "untouched") == 0) == sensible);
        taken += status == VNDF_OK;
        if (status != VNDF_OK) {
            TEST_HAS(error.message, "effects: ");
            check_nothing(&material);
            TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_ERROR_ARGUMENT);
        }
    }
    printf("%lu of %lu sets of effects make sense\n", (unsigned long)taken, (unsigned long)ORACLE_EFFECT_SETS);
}

static void refuse(const vndf_description *is, const char *name)
{
    vndf_material material;
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_material_resolve(is, &material, &error) == VNDF_ERROR_ARGUMENT);
    TEST(error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, name);
    check_nothing(&material);
}

/* What each combination is refused for. */
static void test_names(void)
{
    const struct {
        vndf_effects effects;
        const char *names[2];
    } cases[] = {
        {{.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_CONDUCTOR}, {"CONDUCTOR", "LOBES_REFLECTION"}},
        {{.lobes = VNDF_LOBES_TRANSMISSION, .fresnel = VNDF_FRESNEL_CONDUCTOR}, {"CONDUCTOR", "LOBES_REFLECTION"}},
        {{.lobes = VNDF_LOBES_BOTH}, {"LOBES_BOTH", "FRESNEL_NONE"}},
        {{.lobes = VNDF_LOBES_TRANSMISSION, .normals = VNDF_NORMALS_BOUNDED},
         {"NORMALS_BOUNDED", "LOBES_REFLECTION"}},
        {{.normals = VNDF_NORMALS_V_CAVITY}, {"NORMALS_V_CAVITY", "MASKING_V_CAVITIES"}},
        {{.scattering = VNDF_SCATTERING_MULTIPLE, .masking = VNDF_MASKING_SEPARABLE},
         {"SCATTERING_MULTIPLE", "MASKING_HEIGHT_CORRELATED"}},
        {{.scattering = VNDF_SCATTERING_MULTIPLE, .normals = VNDF_NORMALS_ALL},
         {"SCATTERING_MULTIPLE", "NORMALS_VISIBLE"}},
        {{.scattering = VNDF_SCATTERING_MULTIPLE, .lobes = VNDF_LOBES_TRANSMISSION},
         {"SCATTERING_MULTIPLE", "LOBES_BOTH"}},
        {{.shape = VNDF_SHAPE_AFFINE, .normals = VNDF_NORMALS_ALL}, {"SHAPE_AFFINE", "NORMALS_VISIBLE"}},
        {{.shape = VNDF_SHAPE_MIXTURE, .normals = VNDF_NORMALS_BOUNDED}, {"SHAPE_MIXTURE", "NORMALS_VISIBLE"}},
        {{.shape = VNDF_SHAPE_MIXTURE, .masking = VNDF_MASKING_V_CAVITIES}, {"SHAPE_MIXTURE", "V_CAVITIES"}},
        {{.shape = VNDF_SHAPE_AFFINE, .scattering = VNDF_SCATTERING_MULTIPLE},
         {"SHAPE_AFFINE", "SCATTERING_SINGLE"}},
        {{.shape = VNDF_SHAPE_AFFINE, .reflection = VNDF_REFLECTION_RETRO}, {"REFLECTION_RETRO", "SHAPE_ALIGNED"}},
        {{.reflection = VNDF_REFLECTION_RETRO, .lobes = VNDF_LOBES_TRANSMISSION},
         {"REFLECTION_RETRO", "LOBES_TRANSMISSION"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vndf_description is = good(cases[i].effects);
        refuse(&is, cases[i].names[0]);
        refuse(&is, cases[i].names[1]);
    }
}

static void test_choices(void)
{
    const char *names[] = {"lobes",      "fresnel",   "masking", "normals",
                           "scattering", "transport", "shape",   "reflection"};
    for (int i = 0; i < 8; i++)
        for (int wrong = -1; wrong < 100; wrong += 50) {
            vndf_effects e = {.lobes = VNDF_LOBES_REFLECTION};
            e.lobes = (vndf_lobes)(i == 0 ? wrong : 0);
            e.fresnel = (vndf_fresnel)(i == 1 ? wrong : 0);
            e.masking = (vndf_masking)(i == 2 ? wrong : 0);
            e.normals = (vndf_normals_drawn)(i == 3 ? wrong : 0);
            e.scattering = (vndf_scattering)(i == 4 ? wrong : 0);
            e.transport = (vndf_transport)(i == 5 ? wrong : 0);
            e.shape = (vndf_shape)(i == 6 ? wrong : 0);
            e.reflection = (vndf_reflection)(i == 7 ? wrong : 0);
            vndf_description is = good(e);
            refuse(&is, names[i]);
        }
}

/* ---- numbers ---- */

/* A number of a description that `effects` asks for, and its range. */
typedef struct number {
    const char *name;
    size_t offset;
    vndf_effects effects;
    double least, most;
} number;

static const number NUMBERS[] = {
    {"rotation", offsetof(vndf_description, rotation), {.shape = VNDF_SHAPE_ROTATED}, -1e4, 1e4},
    {"eta", offsetof(vndf_description, eta), {.fresnel = VNDF_FRESNEL_DIELECTRIC}, 0.01, 100},
    {"eta", offsetof(vndf_description, eta), {.lobes = VNDF_LOBES_TRANSMISSION}, 0.01, 100},
    {"eta",
     offsetof(vndf_description, eta),
     {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_SCHLICK},
     0.01,
     100},
    {"f0", offsetof(vndf_description, f0), {.fresnel = VNDF_FRESNEL_SCHLICK}, 0, 1},
    {"f0", offsetof(vndf_description, f0) + 2 * sizeof(float), {.fresnel = VNDF_FRESNEL_SCHLICK}, 0, 1},
    {"conductor_eta", offsetof(vndf_description, conductor_eta), {.fresnel = VNDF_FRESNEL_CONDUCTOR}, 0, 1000},
    {"conductor_k", offsetof(vndf_description, conductor_k), {.fresnel = VNDF_FRESNEL_CONDUCTOR}, 0, 1000},
    {"conductor_k",
     offsetof(vndf_description, conductor_k) + 2 * sizeof(float),
     {.fresnel = VNDF_FRESNEL_CONDUCTOR},
     0,
     1000},
};

static vndf_description with(vndf_effects effects, size_t offset, float value)
{
    vndf_description is = good(effects);
    memcpy((char *)&is + offset, &value, sizeof value);
    return is;
}

static void test_numbers(void)
{
    for (size_t i = 0; i < sizeof NUMBERS / sizeof *NUMBERS; i++) {
        const number *n = &NUMBERS[i];
        const vndf_effects bare = {.lobes = VNDF_LOBES_REFLECTION};
        const float below = nextafterf((float)n->least, -INFINITY), above = nextafterf((float)n->most, INFINITY);
        const float wrong[] = {below, above, NAN, INFINITY, -INFINITY};
        const float right[] = {(float)n->least, (float)n->most};
        vndf_material material;
        for (size_t k = 0; k < 5; k++) {
            vndf_description is = with(n->effects, n->offset, wrong[k]), unread = with(bare, n->offset, wrong[k]);
            refuse(&is, n->name);
            TEST(vndf_material_resolve(&unread, &material, NULL) == VNDF_OK);
        }
        for (size_t k = 0; k < 2; k++) {
            vndf_description is = with(n->effects, n->offset, right[k]);
            TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK);
        }
    }
}

static void test_rest(void)
{
    const vndf_effects bare = {.lobes = VNDF_LOBES_REFLECTION}, metal = {.fresnel = VNDF_FRESNEL_CONDUCTOR};
    const float alphas[] = {0, -1, NAN, INFINITY, 1e-19f, 1e19f};
    vndf_description is = good(metal);
    is.conductor_eta[1] = is.conductor_k[1] = 0;
    refuse(&is, "conductor_eta[1]");
    is = good(bare);
    is.distribution = NULL;
    refuse(&is, "distribution");
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        is = with(bare, offsetof(vndf_description, alpha_x), alphas[i]);
        refuse(&is, "alpha_x");
        is = with(bare, offsetof(vndf_description, alpha_y), alphas[i]);
        refuse(&is, "alpha_y");
    }
}

/* ---- shapes ---- */

/* Each way in which a mixture is invalid has a text of its own, which names the lobe. */
static void test_mixtures(void)
{
    const vndf_effects several = {.shape = VNDF_SHAPE_MIXTURE};
    const vndf_mixture_lobe sound = {{vndf_ggx(), 0.3f, 0.1f, 0, 0.2f, 0.1f, 0}, 1};
    vndf_mixture none = {.count = 0}, many = {.count = VNDF_MIXTURE_LOBES + 1}, lightless = {2, {sound, sound}};
    vndf_mixture negative = {2, {sound, sound}}, infinite = negative, missing = negative, singular = negative;
    const struct {
        const vndf_mixture *is;
        const char *text;
    } cases[] = {
        {&none, "mixture->count is 0, it must be in [1, 8]"},
        {&many, "mixture->count is 9, it must be in [1, 8]"},
        {&lightless, "mixture: the weights of all lobes are 0"},
        {&negative, "mixture->lobe[1].weight is -1, it must be finite and at least 0"},
        {&infinite, "mixture->lobe[0].weight is inf"},
        {&missing, "mixture->lobe[1].surface has the distribution NULL"},
        {&singular, "mixture->lobe[1].surface is the matrix (1 2; 2 4) with mean slope (0.1, 0); its singular"},
    };
    vndf_material material;
    vndf_description is = good(several);
    lightless.lobe[0].weight = lightless.lobe[1].weight = 0;
    negative.lobe[1].weight = -1;
    infinite.lobe[0].weight = INFINITY;
    missing.lobe[1].surface.distribution = NULL;
    singular.lobe[1].surface = (vndf_affine){vndf_ggx(), 1, 2, 2, 4, 0.1f, 0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        is.mixture = cases[i].is;
        refuse(&is, cases[i].text);
    }
    singular.lobe[1].weight = 0; /* which is not looked at */
    is.mixture = &singular;
    TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK);
}

/* What is refused is what has no view. */
static void test_odd_mixtures(void)
{
    static const float odd[] = {0, -1, 1e-20f, 1e-40f, 1e7f, 1e20f, INFINITY, NAN};
    const vndf_vec3 up = {0, 0, 1};
    unsigned long long state = 1;
    size_t taken = 0, count = 20000;
    for (size_t n = 0; n < count; n++) {
        vndf_description is = good((vndf_effects){.shape = VNDF_SHAPE_MIXTURE});
        vndf_mixture mixture = {.count = (int)(n % 200 == 7 ? 9 : n % 4)};
        vndf_material material;
        for (int i = 0; i < mixture.count && i < VNDF_MIXTURE_LOBES; i++) {
            float lobe[7] = {0.3f, 0.1f, 0, 0.2f, 0.1f, 0, i % 3 ? 0.5f : 0};
            unsigned long long bits = test_random_bits(&state) >> 20;
            if (bits % 3 == 0)
                lobe[bits / 3 % 7] = odd[bits / 21 % 8];
            mixture.lobe[i].surface = (vndf_affine){
                bits / 168 % 20 ? vndf_beckmann() : NULL, lobe[0], lobe[1], lobe[2], lobe[3], lobe[4], lobe[5]};
            mixture.lobe[i].weight = lobe[6];
        }
        is.mixture = &mixture;
        vndf_status status = vndf_material_resolve(&is, &material, NULL);
        TEST((status == VNDF_OK) == (vndf_mixture_view_from(&mixture, up).count > 0));
        taken += status == VNDF_OK;
    }
    TEST(taken > count / 10 && taken < count / 2);
}

/* A matrix alone: its mean slope is not read, neither of the material nor of a hit. */
static void test_matrix(void)
{
    const vndf_effects matrix = {.shape = VNDF_SHAPE_MATRIX}, leaning = {.shape = VNDF_SHAPE_AFFINE};
    const vndf_vec3 wi = {0.6f, 0, 0.8f}, wo = {-0.36f, 0.48f, 0.8f};
    const vndf_affine straight = {NULL, 0.3f, 0.1f, 0, 0.2f, 0, 0};
    const float means[] = {0, 0.5f, 1e7f, INFINITY, NAN};
    float expected[VNDF_WAVELENGTHS], f[VNDF_WAVELENGTHS];
    for (size_t i = 0; i < sizeof means / sizeof *means; i++) {
        vndf_description is = good(matrix);
        vndf_material material;
        vndf_bsdf bsdf;
        is.affine = straight;
        is.affine.mean_x = is.affine.mean_y = means[i];
        TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK);
        TEST(vndf_bsdf_at(&bsdf, &material, wi));
        vndf_bsdf_eval(&bsdf, wo, 0, i ? f : expected);
        TEST(i ? f[0] == expected[0] : expected[0] > 0);
        TEST(vndf_bsdf_affine(&bsdf, &material, &is.affine, wi));
        vndf_bsdf_eval(&bsdf, wo, 0, f);
        TEST(f[0] == expected[0]);
        is.effects = leaning;
        TEST((vndf_material_resolve(&is, &material, NULL) == VNDF_OK) == (means[i] < 1));
    }
}

int main(void)
{
    test_mixtures();
    test_odd_mixtures();
    test_matrix();
    test_sets();
    test_names();
    test_choices();
    test_numbers();
    test_rest();
    return test_done();
}
