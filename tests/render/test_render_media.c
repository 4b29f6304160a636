/* Bodies absorb by Beer's law: one, several inside others or overlapping, with lamps in them; lights that are
 * drawn and lights that are met agree about it, also where a path never leaves a body that is open. Means of
 * independent samples with fixed seeds, within 4.5 sigma: 7e-6 for each of 7 to fail by chance. */
#include "render/path_case.h"

static const vndf_vec3 origin = {0.0f, 0.0f, 0.0f};
static const vndf_description rough_glass = {
    .eta = 1.5f, .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC}};

/* A body that does not refract. */
static void tinted(render_case *c, float absorb)
{
    material *m = case_material(c, MATERIAL_GLASS, 1.0f, 1.0f, 1.0f);
    m->is.eta = 1.0f;
    for (int i = 0; i < 3; i++)
        m->absorb[i] = absorb;
}

/* Matte, of reflectance 1/2, about the origin, its normal z. */
static void plate(render_case *c)
{
    case_material(c, MATERIAL_MATTE, 0.5f, 0.5f, 0.5f);
    TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){vec(-1, -1, 0), vec(2, 0, 0), vec(0, 2, 0)},
                                case_last(c)));
}

/* Straight through a slab without refraction. */
static void test_absorption(void)
{
    render_case c;
    case_begin(&c, vec(0.1f, 0.2f, 5.0f), vec(0.1f, 0.2f, 0.0f));
    case_constant(&c, 1.0f);
    tinted(&c, 1.25f);
    TEST(geometry_add_box(&c.scene.geometry, vec(-1, -1, -0.2f), vec(1, 1, 0.4f), case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_is("absorbed", case_render(&c, SAMPLER_MATERIAL, 0, 16, 5), exp(-1.25 * 0.6));
    case_is("clear", case_render(&c, SAMPLER_MATERIAL, EFFECT_ABSORPTION, 16, 5), 1);
    case_free(&c);
}

/* Straight through bodies inside others, one of them clear, and two that overlap. */
static void test_nested(void)
{
    render_case c;
    case_begin(&c, vec(0.1f, 0.2f, 5.0f), vec(0.1f, 0.2f, 0.0f));
    case_constant(&c, 1.0f);
    tinted(&c, 0.5f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(0.1f, 0.2f, 0), 2.0f}, case_last(&c)));
    tinted(&c, 0.0f);
    TEST(geometry_add_box(&c.scene.geometry, vec(-1, -1, -1), vec(1, 1, 1), case_last(&c)));
    tinted(&c, 1.5f);
    TEST(geometry_add_box(&c.scene.geometry, vec(-1, -1, 0), vec(1, 1, 0.5f), case_last(&c)));
    tinted(&c, 0.3f); /* from 0.8 to 1.2: the clear box is left inside of it */
    TEST(geometry_add_box(&c.scene.geometry, vec(-1.5f, -1, -1.2f), vec(1.5f, 1, -0.8f), case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    double truth = 0.5 * (1 + 0.8) + 1.5 * 0.5 + 0.3 * 0.4;
    case_is("nested", case_render(&c, SAMPLER_MATERIAL, 0, 16, 5), exp(-truth));
    case_free(&c);
}

/* A rough clear ball and a lamp, both inside a tinted body: the lamp is drawn from inside the ball, too. */
static void test_ball_in_tint(void)
{
    render_case c;
    case_begin(&c, vec(0.3f, 0.0f, 5.0f), vec(0.3f, 0.0f, 0.0f));
    tinted(&c, 0.5f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){origin, 3.0f}, case_last(&c)));
    case_rough(&c, 0.5f, 0.5f, rough_glass);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){origin, 0.8f}, case_last(&c)));
    case_material(&c, MATERIAL_LIGHT, 9.0f, 9.0f, 9.0f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(1.0f, 0.5f, -1.2f), 0.4f}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_mean drawn = case_render(&c, SAMPLER_MATERIAL, 0, 512, 9);
    case_agree("ball in tint", drawn, case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 10));
    case_free(&c);
}

/* A lamp inside glass, seen straight on: 1 - F of its radiance, and 1/eta^2 of that. */
static void test_lamp_in_glass(void)
{
    render_case c;
    case_begin(&c, vec(0, 0, 5), origin);
    case_material(&c, MATERIAL_GLASS, 1.0f, 1.0f, 1.0f)->is.eta = 1.5f;
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){origin, 1.0f}, case_last(&c)));
    case_material(&c, MATERIAL_LIGHT, 2.0f, 2.0f, 2.0f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){origin, 0.5f}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_is("lamp in glass", case_render(&c, SAMPLER_MATERIAL, 0, 64, 6), 2 * 0.96 / 2.25);
    case_free(&c);
}

/* A matte plate and a lamp in a tinted body that does not refract. */
static void test_tinted(void)
{
    render_case c;
    case_begin(&c, vec(0.3f, -3.0f, 1.0f), origin);
    plate(&c);
    tinted(&c, 0.4f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){origin, 2.5f}, case_last(&c)));
    case_material(&c, MATERIAL_LIGHT, 3.0f, 3.0f, 3.0f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(0.8f, 0.0f, 1.3f), 0.3f}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_mean drawn = case_render(&c, SAMPLER_MATERIAL, 0, 64, 7);
    case_agree("tinted", drawn, case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 8));
    case_free(&c);
}

/* A single sheet of what absorbs, above a matte plate: paths that pass it are inside for ever, for all they know.
 * Light from far away is in no body, wherever it is found; a colour of which nothing is absorbed is no NaN. */
static void test_open_body(void)
{
    render_case c;
    image sky;
    TEST(image_make(&sky, 16, 8));
    for (int i = 0; i < 3 * 16 * 8; i++)
        sky.rgb[i] = i == 3 * (2 * 16 + 5) ? 100.0f : 1.0f; /* uneven enough to be drawn */
    case_begin(&c, vec(0.0f, -1.0f, 3.0f), origin);
    c.scene.environment = (environment){.map = &sky, .scale = 1.0f, .turn = 90.0f};
    plate(&c);
    material *m = case_rough(&c, 0.3f, 0.3f, rough_glass);
    m->absorb[0] = 0.5f;
    m->absorb[1] = 0.1f;
    TEST(geometry_add_rectangle(&c.scene.geometry,
                                (rectangle){vec(-0.5f, -0.7f, 0.5f), vec(1, 0, 0), vec(0, 1, 0)}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_mean drawn = case_render(&c, SAMPLER_MATERIAL, 0, 256, 12);
    case_agree("open body", drawn, case_render(&c, SAMPLER_MATERIAL, EFFECT_ENVIRONMENT_MAP, 1024, 13));
    case_free(&c);
    image_free(&sky);
}

int main(void)
{
    test_absorption();
    test_nested();
    test_ball_in_tint();
    test_lamp_in_glass();
    test_tinted();
    test_open_body();
    return test_done();
}
