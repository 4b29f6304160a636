/* Materials with energy compensation, by Turquin's factor or by the lobe of Kulla & Conty, vanish in a white furnace,
 * of GGX and of a heavy-tailed table, mirrors and glass, where single scattering is seen; lights that are drawn and
 * lights that are met agree about them. Their albedos are made once for each distribution and index, and for nothing
 * that has no shape. Means of independent samples with fixed seeds, within 4.5 sigma: 7e-6 for each of 14 to fail by
 * chance. */
#include "render/path_case.h"
#include "render/path/parts.h"

static const vndf_vec3 origin = {0.0f, 0.0f, 0.0f};

static vndf_description white(vndf_scattering scattering, int is_glass)
{
    vndf_description is = {.eta = 1.5f, .effects = {.scattering = scattering}};
    if (is_glass) {
        is.effects.lobes = VNDF_LOBES_BOTH;
        is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    }
    return is;
}

static void add_ball(render_case *c, const vndf_distribution *distribution, float alpha, vndf_description is)
{
    case_rough(c, alpha, alpha, is)->is.distribution = distribution;
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){origin, 1.0f}, case_last(c)));
}

static void make_albedos(render_case *c)
{
    char message[512] = "";
    if (!TEST(scene_make_albedos(&c->scene, NULL, NULL, message, sizeof message)))
        fprintf(stderr, "    %s\n", message);
}

static void end(render_case *c)
{
    scene_free_albedos(&c->scene);
    case_free(c);
}

/* ---- white furnaces ---- */

/* A ball seen at an angle of incidence whose sine is about `aside`. Makes albedos if the description has none. */
static case_mean furnace(const vndf_distribution *distribution, float alpha, vndf_description is, float aside,
                         unsigned without)
{
    render_case c;
    case_begin(&c, vec(aside, 0.0f, 5.0f), vec(aside, 0.0f, 0.0f));
    case_constant(&c, 1.0f);
    c.scene.integrator.depth = 1000;
    c.scene.integrator.roulette = 1000;
    add_ball(&c, distribution, alpha, is);
    if (!is.albedo)
        make_albedos(&c);
    TEST(geometry_build(&c.scene.geometry));
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, without, 128, 21);
    end(&c);
    return mean;
}

static void test_mirrors(const vndf_distribution *distribution, const char *what)
{
    static const float asides[] = {0.3f, 0.9f};
    for (int i = 0; i < 2; i++) {
        case_mean single = furnace(distribution, 1.0f, white(VNDF_SCATTERING_SINGLE, 0), asides[i], 0);
        TEST(single.value < 0.95);
        for (int k = 0; k < 2; k++) {
            vndf_description is = white(k ? VNDF_SCATTERING_KULLA_CONTY : VNDF_SCATTERING_TURQUIN, 0);
            case_is(what, furnace(distribution, 1.0f, is, asides[i], 0), 1);
        }
    }
    case_agree("compensation left out",
               furnace(distribution, 1.0f, white(VNDF_SCATTERING_TURQUIN, 0), 0.3f, EFFECT_COMPENSATION),
               furnace(distribution, 1.0f, white(VNDF_SCATTERING_SINGLE, 0), 0.3f, 0));
}

/* Albedos of glass take seconds, so both have the same. */
static void test_glass(void)
{
    const vndf_albedo_options options = {.eta = 1.5f};
    vndf_albedo *albedo = vndf_albedo_build(vndf_ggx(), &options, NULL);
    vndf_description is = white(VNDF_SCATTERING_TURQUIN, 1);
    is.albedo = albedo;
    case_is("glass, turquin", furnace(vndf_ggx(), 0.5f, is, 0.6f, 0), 1);
    is.effects.scattering = VNDF_SCATTERING_KULLA_CONTY;
    case_is("glass, kulla-conty", furnace(vndf_ggx(), 0.5f, is, 0.6f, 0), 1);
    TEST(furnace(vndf_ggx(), 0.5f, is, 0.6f, EFFECT_COMPENSATION).value < 0.98);
    vndf_albedo_free(albedo);
}

/* ---- lights ---- */

static void test_lights(vndf_scattering scattering)
{
    render_case c;
    vndf_description is = {.f0 = {0.9f, 0.7f, 0.4f}};
    is.effects.fresnel = VNDF_FRESNEL_SCHLICK;
    is.effects.scattering = scattering;
    case_begin(&c, vec(2.0f, 1.0f, 3.0f), origin);
    add_ball(&c, vndf_ggx(), 0.9f, is);
    case_material(&c, MATERIAL_LIGHT, 5.0f, 4.0f, 3.0f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(-1.0f, 2.0f, 3.0f), 0.6f}, 1));
    make_albedos(&c);
    TEST(geometry_build(&c.scene.geometry));
    case_agree("lights drawn and met", case_render(&c, SAMPLER_MATERIAL, 0, 64, 31),
               case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 32));
    end(&c);
}

/* ---- sharing ---- */

typedef struct watch {
    double done;
    int calls, stop;
} watch;

static int follow(double done, const char *what, void *user)
{
    watch *w = user;
    (void)what;
    TEST(done >= w->done - 1e-9 && done <= 1.0 + 1e-9);
    w->done = done;
    w->calls++;
    return w->stop;
}

static void test_sharing(void)
{
    render_case c;
    watch w = {0, 0, 1};
    char message[512] = "";
    case_begin(&c, vec(0.0f, 0.0f, 5.0f), origin);
    add_ball(&c, vndf_ggx(), 1.0f, white(VNDF_SCATTERING_TURQUIN, 0));
    add_ball(&c, vndf_ggx(), 0.2f, white(VNDF_SCATTERING_KULLA_CONTY, 0));
    add_ball(&c, vndf_beckmann(), 0.2f, white(VNDF_SCATTERING_TURQUIN, 0));
    add_ball(&c, vndf_ggx(), 0.2f, white(VNDF_SCATTERING_TURQUIN, 1));
    add_ball(&c, vndf_beckmann(), 0.2f, white(VNDF_SCATTERING_SINGLE, 1));
    case_rough(&c, 0.2f, 0.2f, white(VNDF_SCATTERING_TURQUIN, 1))->is.eta = 1.7f; /* has no shape */
    TEST(!scene_make_albedos(&c.scene, follow, &w, message, sizeof message));
    TEST_HAS(message, "energy compensation: interrupted");
    TEST(w.calls == 1);
    w.stop = 0;
    TEST(scene_make_albedos(&c.scene, follow, &w, message, sizeof message));
    TEST(w.calls > 30 && w.done > 0.9 && c.scene.albedo_count == 3 && c.scene.albedo_seconds > 0);
    TEST(scene_albedo_bytes(&c.scene) > 3000 && scene_albedo_bytes(&c.scene) < 1 << 20);
    TEST(c.materials[0].is.albedo && c.materials[0].is.albedo == c.materials[1].is.albedo);
    TEST(c.materials[2].is.albedo && c.materials[2].is.albedo != c.materials[0].is.albedo);
    TEST(vndf_albedo_info(c.materials[3].is.albedo).eta == 1.5f);
    TEST(!c.materials[4].is.albedo && !c.materials[5].is.albedo);
    int before = w.calls;
    TEST(scene_make_albedos(&c.scene, follow, &w, message, sizeof message)); /* all are there */
    TEST(w.calls == before && c.scene.albedo_count == 3);
    TEST(path_material_effects(&c.materials[0]) == (EFFECT_MICROFACETS | EFFECT_COMPENSATION));
    end(&c);
}

int main(void)
{
    vndf_error error;
    vndf_distribution *tail = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-1.8.vndf", &error);
    test_mirrors(vndf_ggx(), "GGX");
    if (TEST(tail != NULL))
        test_mirrors(tail, "a heavy tail");
    test_glass();
    test_lights(VNDF_SCATTERING_TURQUIN);
    test_lights(VNDF_SCATTERING_KULLA_CONTY);
    test_sharing();
    vndf_free(tail);
    return test_done();
}
