/* Paths bring the light that is there: nothing is seen in a white furnace; spheres and rectangles light a matte
 * plate as closed forms say; materials alone, lights alone and both together agree; so do all samplers. Means of
 * independent samples with fixed seeds, within 4.5 sigma: 7e-6 for each of some 30 to fail by chance. */
#include "harness/constants.h"
#include "render/path_case.h"
#include "render/path/parts.h"

static const vndf_vec3 origin = {0.0f, 0.0f, 0.0f};

/* ---- white furnaces ---- */

static vndf_description rough(vndf_lobes lobes, vndf_scattering scattering)
{
    vndf_description is = {.eta = 1.5f, .order_limit = 1000};
    is.effects.lobes = lobes;
    is.effects.fresnel = lobes == VNDF_LOBES_BOTH ? VNDF_FRESNEL_DIELECTRIC : VNDF_FRESNEL_NONE;
    is.effects.scattering = scattering;
    return is;
}

static void furnace_begin(render_case *c, unsigned roulette)
{
    case_begin(c, vec(0.6f, 0.0f, 5.0f), vec(0.6f, 0.0f, 0.0f)); /* a sphere of radius 1 at some 37 degrees */
    case_constant(c, 1.0f);
    c->scene.integrator.depth = 1000;
    c->scene.integrator.roulette = roulette;
}

static void furnace_end(const char *what, render_case *c, unsigned samples)
{
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){origin, 1.0f}, case_last(c)));
    TEST(geometry_build(&c->scene.geometry));
    case_is(what, case_render(c, SAMPLER_MATERIAL, 0, samples, 11), 1);
    case_free(c);
}

static void test_furnace(unsigned roulette)
{
    render_case c;
    furnace_begin(&c, roulette);
    case_material(&c, MATERIAL_MATTE, 1.0f, 1.0f, 1.0f);
    furnace_end("matte", &c, 4);
    furnace_begin(&c, roulette);
    case_material(&c, MATERIAL_MIRROR, 1.0f, 1.0f, 1.0f);
    furnace_end("mirror", &c, 4);
    furnace_begin(&c, roulette);
    case_material(&c, MATERIAL_GLASS, 1.0f, 1.0f, 1.0f)->is.eta = 1.5f;
    furnace_end("glass", &c, 64);
    furnace_begin(&c, roulette);
    case_rough(&c, 0.8f, 0.3f, rough(VNDF_LOBES_REFLECTION, VNDF_SCATTERING_MULTIPLE));
    furnace_end("lossless walk", &c, 128);
    furnace_begin(&c, roulette);
    case_rough(&c, 0.5f, 0.5f, rough(VNDF_LOBES_BOTH, VNDF_SCATTERING_MULTIPLE));
    furnace_end("glass walk", &c, 128);
}

/* ---- closed forms ---- */

/* A matte plate of reflectance 1/2 about the origin, normal z, seen from aside. */
static void plate_begin(render_case *c)
{
    case_begin(c, vec(0.3f, -3.0f, 1.0f), origin);
    case_material(c, MATERIAL_MATTE, 0.5f, 0.5f, 0.5f);
    TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){vec(-1, -1, 0), vec(2, 0, 0), vec(0, 2, 0)},
                                case_last(c)));
}

/* Radiance 1/2 L sin^2(half angle) cos(theta). */
static void test_sphere_light(void)
{
    render_case c;
    plate_begin(&c);
    case_material(&c, MATERIAL_LIGHT, 3.0f, 3.0f, 3.0f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(1.2f, 0.0f, 1.6f), 0.5f}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    double truth = 0.5 * 3 * (0.25 / 4) * 0.8;
    case_is("sphere, drawn", case_render(&c, SAMPLER_MATERIAL, 0, 64, 1), truth);
    case_is("sphere, met", case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 256, 2), truth);
    case_free(&c);
}

/* The form factor of a parallel rectangle with a corner above the point (Howell's catalogue, B-3). */
static double corner_factor(double a, double b)
{
    double p = sqrt(1 + a * a), q = sqrt(1 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2 * PI);
}

static void test_rectangle_light(void)
{
    render_case c;
    plate_begin(&c);
    case_material(&c, MATERIAL_LIGHT, 2.0f, 2.0f, 2.0f);
    TEST(geometry_add_rectangle(&c.scene.geometry, /* its front is below */
                                (rectangle){vec(0, 0, 0.8f), vec(0, 1.2f, 0), vec(0.7f, 0, 0)}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    double truth = 0.5 * 2 * corner_factor(0.7 / 0.8, 1.2 / 0.8);
    case_is("rectangle, drawn", case_render(&c, SAMPLER_MATERIAL, 0, 64, 3), truth);
    case_is("rectangle, met", case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 256, 4), truth);
    case_free(&c);
}

/* Half of the paths end at the plate, and the others bring twice as much. */
static void test_roulette(void)
{
    render_case c;
    plate_begin(&c);
    case_constant(&c, 1.0f);
    c.scene.integrator.roulette = 1;
    TEST(geometry_build(&c.scene.geometry));
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, 0, 64, 9);
    case_is("roulette", mean, 0.5);
    TEST(mean.sigma > 0);
    case_free(&c);
}

/* ---- lights against materials ---- */

/* A rough metal plate under a sphere, a rectangle and dim light from far away. */
static void metal_begin(render_case *c, float alpha_x, float alpha_y)
{
    vndf_description is = {.f0 = {0.9f, 0.7f, 0.4f}};
    is.effects.fresnel = VNDF_FRESNEL_SCHLICK;
    case_begin(c, vec(0.5f, -3.0f, 1.5f), origin);
    case_constant(c, 0.1f);
    case_rough(c, alpha_x, alpha_y, is);
    TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){vec(-1, -1, 0), vec(2, 0, 0), vec(0, 2, 0)},
                                case_last(c)));
    case_material(c, MATERIAL_LIGHT, 5.0f, 4.0f, 3.0f);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){vec(-0.3f, 2.0f, 1.2f), 0.4f}, case_last(c)));
    TEST(geometry_add_rectangle(
        &c->scene.geometry, (rectangle){vec(0.2f, 0.9f, 0.7f), vec(0, 0, 0.5f), vec(0.6f, 0, 0)}, case_last(c)));
    TEST(geometry_build(&c->scene.geometry));
}

/* The rest is an estimate with lights alone and the library's values: shares no code with paths but the lights. */
static case_mean lights_alone(const render_case *c, unsigned samples)
{
    path_lights lights;
    light_view v;
    vndf_material made;
    vndf_bsdf bsdf;
    unsigned long long state = 77;
    double sum = 0, square = 0;
    unsigned count = 256 * (test_quick() ? samples / 4 : samples);
    TEST(path_lights_make(&lights, &c->scene) && lights.count == 2);
    path_lights_look(&lights, 0.0f, origin, vec(0, 0, 1), &v);
    TEST(vndf_material_resolve(&c->materials[0].is, &made, NULL) == VNDF_OK);
    TEST(vndf_bsdf_at(&bsdf, &made, unit(c->scene.camera.from)));
    for (unsigned i = 0; i < count; i++) {
        float u[3] = {test_uniform(&state), test_uniform(&state), test_uniform(&state)}, f[3];
        light_sample s;
        if (!path_lights_draw(&lights, &v, 0, u, &s) || s.direction.z <= 0.0f)
            continue;
        vndf_bsdf_eval(&bsdf, s.direction, 0, f);
        for (int k = 0; k < 3; k++)
            f[k] *= s.radiance[k] * s.direction.z / s.density;
        double light = luminance(f);
        sum += light / count;
        square += light * light / count;
    }
    path_lights_free(&lights);
    case_mean mean = {sum, sqrt((square - sum * sum) / count)};
    return mean;
}

static void test_mis(float alpha_x, float alpha_y)
{
    render_case c;
    metal_begin(&c, alpha_x, alpha_y);
    case_mean both = case_render(&c, SAMPLER_MATERIAL, 0, 256, 21);
    case_mean met = case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 22);
    case_agree("lights drawn and met", both, met);
    TEST(both.sigma < met.sigma * 2);
    case_constant(&c, 0.0f);
    case_mean drawn = lights_alone(&c, 512), both_dark = case_render(&c, SAMPLER_MATERIAL, 0, 256, 23);
    case_agree("paths and lights alone", both_dark, drawn);
    TEST(both_dark.sigma * sqrt(0.5) < drawn.sigma * 2);
    case_free(&c);
}

static void test_samplers(void)
{
    render_case c;
    metal_begin(&c, 0.5f, 0.3f);
    case_mean visible = case_render(&c, SAMPLER_VISIBLE, 0, 256, 31);
    case_agree("all", case_render(&c, SAMPLER_ALL, 0, 256, 32), visible);
    case_agree("bounded", case_render(&c, SAMPLER_BOUNDED, 0, 256, 33), visible);
    case_free(&c);
}

/* A light outside and one inside a rough glass ball: the second is never drawn from its skin. */
static void test_glass_lights(vndf_scattering scattering)
{
    render_case c;
    case_begin(&c, vec(0.5f, 0.0f, 5.0f), vec(0.5f, 0.0f, 0.0f));
    case_rough(&c, 0.4f, 0.4f, rough(VNDF_LOBES_BOTH, scattering));
    for (int i = 0; i < 3; i++)
        c.materials[0].absorb[i] = 0.3f;
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){origin, 1.0f}, case_last(&c)));
    case_material(&c, MATERIAL_LIGHT, 4.0f, 4.0f, 4.0f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(1.5f, 1.5f, 1.5f), 0.7f}, case_last(&c)));
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(-0.3f, 0.1f, -0.2f), 0.3f}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_mean both = case_render(&c, SAMPLER_MATERIAL, 0, 256, 41);
    case_agree("glass", both, case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 42));
    case_free(&c);
}

int main(void)
{
    test_furnace(1000);
    test_furnace(2);
    test_sphere_light();
    test_rectangle_light();
    test_roulette();
    test_mis(0.3f, 0.3f);
    test_mis(0.08f, 0.5f);
    test_samplers();
    test_glass_lights(VNDF_SCATTERING_SINGLE);
    test_glass_lights(VNDF_SCATTERING_MULTIPLE);
    return test_done();
}
