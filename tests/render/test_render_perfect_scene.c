/* Perfect sampling in scenes: pictures are those of visible normals, with lights drawn and met, reflected and
 * through glass, axes turned (within 4.5 sigma, 7e-6 for each of 2 to fail by chance); materials of one BSDF share
 * what is prepared, which is told; and what cannot be precomputed is refused by name. */
#include "render/path_case.h"

/* ---- pictures ---- */

/* A plate of metal and a ball of glass under a light, dim light from far away; the eye looks at one of them. */
static void scene_begin(render_case *c, int glass, float rotation)
{
    vndf_description metal = {.f0 = {0.9f, 0.7f, 0.4f}, .rotation = rotation}, is = {.eta = 1.5f};
    metal.effects.fresnel = VNDF_FRESNEL_SCHLICK;
    metal.effects.shape = VNDF_SHAPE_ROTATED;
    is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    is.effects.lobes = VNDF_LOBES_BOTH;
    case_begin(c, vec(0.5f, -3.0f, 1.5f), glass ? vec(0.2f, -1.0f, 0.6f) : vec(0.0f, 0.5f, 0.0f));
    case_constant(c, 0.1f);
    case_rough(c, 0.2f, 0.5f, metal);
    TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){vec(-2, -2, 0), vec(4, 0, 0), vec(0, 4, 0)}, 0));
    case_rough(c, 0.3f, 0.3f, is);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){vec(0.2f, -1.0f, 0.6f), 0.4f}, 1));
    case_material(c, MATERIAL_LIGHT, 5.0f, 4.0f, 3.0f);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){vec(-0.3f, 2.0f, 1.2f), 0.4f}, 2));
    case_rough(c, 0.2f, 0.5f, metal); /* no other BSDF than that of the plate */
    TEST(geometry_build(&c->scene.geometry));
}

static void test_pictures(void)
{
    for (int i = 0; i < 2; i++) {
        render_case c;
        scene_begin(&c, i, 0.7f);
        case_agree(i ? "glass" : "metal", case_render(&c, SAMPLER_PERFECT, 0, 192, 3 + (uint64_t)i),
                   case_render(&c, SAMPLER_VISIBLE, 0, 384, 13 + (uint64_t)i));
        case_free(&c);
    }
}

/* What is prepared is told; materials of one BSDF share it, and other samplers prepare nothing. */
static void test_cost(void)
{
    render_case c;
    scene_begin(&c, 0, 0.0f);
    path_plan *plan = case_plan(&c, SAMPLER_PERFECT, 0), *visible = case_plan(&c, SAMPLER_VISIBLE, 0);
    path_precomputed cost = path_perfect_cost(plan);
    TEST(cost.count == 2 && cost.bytes > 1000000 && cost.seconds > 0 && cost.seconds < 60);
    TEST(path_perfect_cost(visible).count == 0 && path_perfect_cost(visible).bytes == 0);
    path_free(plan);
    path_free(visible);
    case_free(&c);
}

/* ---- refusals ---- */

static void refused(const render_case *c, const char *why)
{
    char message[512] = "";
    path_plan *plan = path_prepare(&c->scene, SAMPLER_PERFECT, 0, message, sizeof message);
    int good = TEST(plan == NULL && strncmp(message, "material 'material': ", 21) == 0);
    if (!TEST_HAS(message, why) || !good)
        fprintf(stderr, "    %s\n", message);
    path_free(plan);
}

static void test_refusals(void)
{
    vndf_description both = {.eta = 1.5f, .f0 = {0.5f, 0.5f, 0.5f}};
    both.effects.lobes = VNDF_LOBES_BOTH;
    both.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    render_case c;
    scene_begin(&c, 0, 0.0f);
    image map = {0};
    c.materials[0].alpha_x.map = &map;
    c.materials[0].is_textured = 1;
    refused(&c, "one roughness, this one has a map");
    c.materials[0].is_textured = 0;
    c.materials[0].is.effects.scattering = VNDF_SCATTERING_MULTIPLE;
    refused(&c, "single scattering, this one has 'scattering multiple'");
    c.materials[0].is.effects.scattering = VNDF_SCATTERING_KULLA_CONTY;
    TEST(scene_make_albedos(&c.scene, NULL, NULL, NULL, 0));
    refused(&c, "single scattering alone, this one is compensated by 'scattering turquin' or 'kulla-conty'");
    scene_free_albedos(&c.scene);
    c.materials[0].is = both;
    c.materials[0].is.distribution = vndf_ggx();
    c.materials[0].is.alpha_x = c.materials[0].is.alpha_y = 0.1f;
    c.materials[0].is.eta = 1.0f;
    refused(&c, "'index 1'");
    c.materials[0].is.eta = 1.5f;
    c.materials[0].is.effects.fresnel = VNDF_FRESNEL_SCHLICK;
    refused(&c, "for dielectrics alone");
    c.materials[0].is.effects.lobes = VNDF_LOBES_REFLECTION;
    c.materials[0].is.effects.reflection = VNDF_REFLECTION_RETRO;
    refused(&c, "for mirrored light, this one is 'retroreflective'");
    c.materials[0].is.affine = (vndf_affine){.xx = 0.1f, .yy = 0.2f};
    c.materials[0].is.effects.shape = VNDF_SHAPE_MATRIX;
    refused(&c, "for alpha, this one has a matrix, slopes or lobes");
    case_free(&c);
}

int main(void)
{
    test_pictures();
    test_cost();
    test_refusals();
    return test_done();
}
