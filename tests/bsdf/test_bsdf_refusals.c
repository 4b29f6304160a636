/* Every set of effects is taken if it makes sense and refused if not, by a message that names what is wrong; so
 * is every number out of its range, and NaN, and each way in which a mixture is invalid. What is not asked for is not
 * read. A material that was refused is safe: it scatters nothing. The error is the caller's, may be NULL and is left
 * alone where nothing is wrong. */
#include <stddef.h>

#include "bsdf/bsdf_case.h"

static const vndf_surface unplaced = {NULL, 0.3f, 0.1f, 0, 0.2f, 0.1f, 0};

static vndf_description good(vndf_effects effects)
{
    static vndf_mixture mixture;
    vndf_surface sound = unplaced;
    sound.distribution = vndf_ggx();
    mixture = (vndf_mixture){1, {{sound, 1}}};
    return (vndf_description){.surface = sound,
                              .effects = effects,
                              .mixture = &mixture,
                              .eta = 1.5f,
                              .f0 = {0.04f, 0.04f, 0.04f},
                              .conductor_eta = {0.2f, 0.9f, 1.1f},
                              .conductor_k = {3.9f, 2.4f, 2.2f}};
}

/* Refused for a reason that has this text, and safe. */
static void refuse(const vndf_description *is, const char *text)
{
    const vndf_vec3 wi = {0.6f, 0, 0.8f}, wo = {-0.6f, 0, 0.8f};
    const vndf_surface rough = vndf_rough(NULL, 0.1f, 0.1f);
    const float u[3] = {0.3f, 0.4f, 0.5f};
    float f[3] = {1, 1, 1};
    vndf_error error = {VNDF_OK, ""};
    vndf_material material;
    vndf_scattered s;
    vndf_bsdf bsdf;
    TEST(vndf_material_resolve(is, &material, NULL) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_material_resolve(is, &material, &error) == error.status && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, text);
    TEST(!vndf_bsdf_on(&bsdf, &material, &rough, wi) && !vndf_bsdf_at(&bsdf, &material, wi));
    vndf_bsdf_sample(&bsdf, u, &s);
    vndf_bsdf_eval(&bsdf, wo, 1, f);
    TEST(s.lobe == VNDF_LOBE_NONE && s.density == 0 && s.weight[0] == 0 && s.weight[1] == 0 && s.weight[2] == 0);
    TEST(f[0] == 0 && f[1] == 0 && f[2] == 0 && vndf_bsdf_pdf(&bsdf, wo) == 0 &&
         vndf_bsdf_cosine(&bsdf, (vndf_vec3){0, 0, 9}) == 0);
}

static int is_taken(const vndf_description *is)
{
    vndf_material material;
    vndf_error error = {VNDF_OK, "untouched"};
    return vndf_material_resolve(is, &material, &error) == VNDF_OK && error.status == VNDF_OK &&
           strcmp(error.message, "untouched") == 0;
}

/* ---- effects ---- */

static void test_sets(void)
{
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects effects = oracle_effects(i);
        vndf_description is = good(effects);
        if (!oracle_effects_sensible(&effects))
            refuse(&is, "effects: ");
        else if (!TEST(is_taken(&is)))
            bsdf_describe(&is, "set", (vndf_vec3){0, 0, 1}, (vndf_vec3){0, 0, 1});
    }
}

/* What each combination is refused for: both texts are in the message. */
static void test_names(void)
{
    static const struct {
        vndf_effects effects;
        const char *names[2];
    } cases[] = {
        {{.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_CONDUCTOR}, {"CONDUCTOR", "LOBES_REFLECTION"}},
        {{.lobes = VNDF_LOBES_BOTH}, {"LOBES_BOTH", "FRESNEL_NONE"}},
        {{.lobes = VNDF_LOBES_TRANSMISSION, .normals = VNDF_NORMALS_BOUNDED}, {"BOUNDED", "LOBES_REFLECTION"}},
        {{.normals = VNDF_NORMALS_V_CAVITY}, {"NORMALS_V_CAVITY", "MASKING_V_CAVITIES"}},
        {{.scattering = VNDF_SCATTERING_MULTIPLE, .masking = VNDF_MASKING_SEPARABLE}, {"MULTIPLE", "HEIGHT"}},
        {{.scattering = VNDF_SCATTERING_MULTIPLE, .normals = VNDF_NORMALS_ALL}, {"MULTIPLE", "NORMALS_VISIBLE"}},
        {{.scattering = VNDF_SCATTERING_MULTIPLE, .lobes = VNDF_LOBES_TRANSMISSION}, {"MULTIPLE", "LOBES_BOTH"}},
        {{.shape = VNDF_SHAPE_TILTED, .normals = VNDF_NORMALS_ALL}, {"SHAPE_TILTED", "NORMALS_VISIBLE"}},
        {{.shape = VNDF_SHAPE_MIXTURE, .masking = VNDF_MASKING_V_CAVITIES}, {"SHAPE_MIXTURE", "V_CAVITIES"}},
        {{.shape = VNDF_SHAPE_TILTED, .scattering = VNDF_SCATTERING_MULTIPLE}, {"SHAPE_TILTED", "SINGLE"}},
        {{.shape = VNDF_SHAPE_TILTED, .reflection = VNDF_REFLECTION_RETRO}, {"SHAPE_TILTED", "SPECULAR"}},
        {{.reflection = VNDF_REFLECTION_RETRO, .lobes = VNDF_LOBES_TRANSMISSION}, {"RETRO", "LOBES_TRANSMISSION"}},
    };
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        vndf_description is = good(cases[i / 2].effects);
        refuse(&is, cases[i / 2].names[i % 2]);
    }
    for (size_t i = 0; i < 8 * 3; i++) { /* each effect has choices, from 0 to some number */
        static const char *const effects[] = {"lobes",      "fresnel",   "masking", "normals",
                                              "scattering", "transport", "shape",   "reflection"};
        static const int wrong[] = {-1, 49, 99};
        vndf_effects e = {.lobes = VNDF_LOBES_REFLECTION};
        memcpy((char *)&e + i / 3 * sizeof e.lobes, &wrong[i % 3], sizeof e.lobes);
        vndf_description is = good(e);
        refuse(&is, effects[i / 3]);
    }
}

/* ---- numbers ---- */

#define AT(member) offsetof(vndf_description, member)

/* A number of a description that `effects` asks for, and its range. */
static const struct number {
    const char *name;
    size_t offset;
    vndf_effects effects;
    double least, most;
} NUMBERS[] = {
    {"eta", AT(eta), {.fresnel = VNDF_FRESNEL_DIELECTRIC}, 0.01, 100},
    {"eta", AT(eta), {.lobes = VNDF_LOBES_TRANSMISSION}, 0.01, 100},
    {"eta", AT(eta), {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_SCHLICK}, 0.01, 100},
    {"f0[0]", AT(f0), {.fresnel = VNDF_FRESNEL_SCHLICK}, 0, 1},
    {"f0[2]", AT(f0) + 2 * sizeof(float), {.fresnel = VNDF_FRESNEL_SCHLICK}, 0, 1},
    {"conductor_eta[0]", AT(conductor_eta), {.fresnel = VNDF_FRESNEL_CONDUCTOR}, 0, 1000},
    {"conductor_k[0]", AT(conductor_k), {.fresnel = VNDF_FRESNEL_CONDUCTOR}, 0, 1000},
    {"conductor_k[2]", AT(conductor_k) + 2 * sizeof(float), {.fresnel = VNDF_FRESNEL_CONDUCTOR}, 0, 1000},
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
        const struct number *n = &NUMBERS[i];
        const float least = (float)n->least, most = (float)n->most;
        const float wrong[] = {nextafterf(least, -INFINITY), nextafterf(most, INFINITY), NAN, INFINITY, -INFINITY};
        for (size_t k = 0; k < 5; k++) {
            vndf_description is = with(n->effects, n->offset, wrong[k]);
            vndf_description unread = with((vndf_effects){.shape = VNDF_SHAPE_LEVEL}, n->offset, wrong[k]);
            refuse(&is, n->name);
            TEST(is_taken(&unread));
        }
        vndf_description low = with(n->effects, n->offset, least), high = with(n->effects, n->offset, most);
        TEST(is_taken(&low) && is_taken(&high));
    }
    vndf_description metal = good((vndf_effects){.fresnel = VNDF_FRESNEL_CONDUCTOR}), none = good(metal.effects);
    metal.conductor_eta[1] = metal.conductor_k[1] = 0;
    refuse(&metal, "conductor_eta[1]");
    metal.wavelengths = 5;
    refuse(&metal, "wavelengths");
    none.surface = unplaced;
    refuse(&none, "distribution");
    refuse(NULL, "the description is NULL");
    const vndf_effects walk = {
        .lobes = 2, .fresnel = VNDF_FRESNEL_SCHLICK, .scattering = VNDF_SCATTERING_MULTIPLE};
    const vndf_description straight = with(walk, AT(eta), 1);
    refuse(&straight, "eta is 1: a walk needs another");
    vndf_description unbent = straight; /* a dielectric, through which light goes straight on */
    vndf_material material;
    vndf_bsdf b;
    vndf_scattered s;
    unbent.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    TEST(vndf_material_resolve(&unbent, &material, NULL) == VNDF_OK);
    TEST(vndf_bsdf_at(&b, &material, (vndf_vec3){0.6f, 0, 0.8f}) && vndf_fresnel_dielectric(0.5f, 0) == 1);
    vndf_bsdf_sample(&b, (float[3]){0.3f, 0.3f, 0.3f}, &s);
    TEST(s.lobe == VNDF_LOBE_STRAIGHT && s.wo.x == -0.6f && s.weight[0] == 1 && vndf_bsdf_pdf(&b, s.wo) == 0);
    for (int i = 0; i < 4; i++) { /* a mean slope counts where the shape has one */
        const float means[] = {0.5f, 1e7f, INFINITY, NAN};
        vndf_description is = with((vndf_effects){.shape = VNDF_SHAPE_LEVEL}, AT(surface.mean_x), means[i]);
        TEST(is_taken(&is));
        is.effects.shape = VNDF_SHAPE_TILTED;
        TEST(is_taken(&is) == (i == 0));
    }
    vndf_description flat = good((vndf_effects){.shape = VNDF_SHAPE_TILTED});
    flat.surface = (vndf_surface){vndf_ggx(), 1, 2, 2, 4, 0, 0};
    refuse(&flat, "surface is the matrix (1 2; 2 4)");
    for (int i = 0; i < 5; i++) { /* whose singular values are as one expects, or no numbers above 0 */
        const float alphas[] = {0, -1, NAN, 1e-19f, 1e19f};
        vndf_description is = good((vndf_effects){.shape = VNDF_SHAPE_LEVEL});
        is.surface = vndf_rough(vndf_ggx(), alphas[i], 0.2f);
        refuse(&is, "surface is the matrix (");
    }
}

/* Each way in which a mixture is invalid has a text of its own, which names the lobe. */
static void test_mixtures(void)
{
    const vndf_surface sound = vndf_rough(vndf_ggx(), 0.3f, 0.1f), singular = {vndf_ggx(), 1, 2, 2, 4, 0.1f, 0};
    const struct {
        vndf_mixture is;
        const char *text;
    } cases[] = {
        {{.count = 0}, "mixture->count is 0, it must be in [1, 8]"},
        {{.count = VNDF_MIXTURE_LOBES + 1}, "mixture->count is 9, it must be in [1, 8]"},
        {{2, {{sound, 0}, {sound, 0}}}, "mixture: the weights of all lobes are 0"},
        {{2, {{sound, 1}, {sound, -1}}}, "mixture->lobe[1].weight is -1, it must be in [0, "},
        {{2, {{sound, INFINITY}, {sound, 1}}}, "mixture->lobe[0].weight is inf"},
        {{2, {{sound, 1}, {unplaced, 1}}}, "mixture->lobe[1].surface has the distribution NULL"},
        {{2, {{sound, 1}, {singular, 1}}},
         "mixture->lobe[1].surface is the matrix (1 2; 2 4) with mean slope (0.1, 0)"},
    };
    vndf_description is = good((vndf_effects){.shape = VNDF_SHAPE_MIXTURE});
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        is.mixture = &cases[i].is;
        refuse(&is, cases[i].text);
    }
    const vndf_mixture unseen = {2, {{sound, 1}, {singular, 0}}}; /* which is not looked at */
    is.mixture = &unseen;
    TEST(is_taken(&is));
    is.mixture = NULL; /* hits bring their own */
    TEST(is_taken(&is));
}

int main(void)
{
    test_sets();
    test_names();
    test_numbers();
    test_mixtures();
    return test_done();
}
