/* Surfaces with matrices, mean slopes, maps of slopes and several lobes bring the light that is there. A white plate
 * that leans sends back what the library's f sends to above the plate, by quadrature; lights that are drawn and lights
 * that are met agree about it, and light below the plate never comes through. Two equal lobes are one; a family at a
 * constant parameter is the mixture of its neighbours; a map of one normal is a mean slope; two slopes in turns are,
 * filtered, their second moment; heights that are filtered send back the light of the same heights as a mesh, within
 * 5%; a retroreflector shows the light behind the eye as a mirror shows
 * the light before it. Means of independent samples with fixed seeds, within 4.5 sigma: 7e-6 for each of some 20 to
 * fail by chance. */
#include "harness/constants.h"
#include "render/path_case.h"
#include "render/path/parts.h"

static const vndf_vec3 origin = {0.0f, 0.0f, 0.0f};
static const rectangle plate = {
    {-1.0f, -1.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}}; /* its normal is z */

static scene_lobe lobe_of(float xx, float xy, float yx, float yy)
{
    scene_lobe l = {.distribution = vndf_ggx(), .is_matrix = 1, .axes = {xx, xy, yx, yy}};
    l.alpha_x.value = l.alpha_y.value = l.weight.value = 1.0f;
    return l;
}

/* A material of the lobes, which must outlive it. */
static material *lay(render_case *c, vndf_description is, scene_lobe *lobes, int count)
{
    material *m = case_rough(c, 1.0f, 1.0f, is);
    m->lobes = lobes;
    m->lobe_count = count;
    m->is.effects.shape = scene_shape_of(lobes, count);
    return m;
}

static void end(render_case *c)
{
    TEST(geometry_add_rectangle(&c->scene.geometry, plate, 0));
    TEST(geometry_build(&c->scene.geometry));
}

/* ---- mean slopes ---- */

/* The part of light that is sent to above the plate: f times the cosine of the mean plane, by midpoints. */
static double sent_up(const scene_lobe *l, vndf_vec3 wi)
{
    enum { ROWS = 400, COLUMNS = 800 };
    vndf_description is = {.distribution = l->distribution, .effects = {.shape = VNDF_SHAPE_AFFINE}};
    vndf_material made;
    vndf_bsdf bsdf;
    double sum = 0;
    is.affine = scene_affine_of(l);
    TEST(vndf_material_resolve(&is, &made, NULL) == VNDF_OK && vndf_bsdf_at(&bsdf, &made, wi));
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        double z = (i / COLUMNS + 0.5) / ROWS, phi = 2 * PI * (i % COLUMNS + 0.5) / COLUMNS, s = sqrt(1 - z * z);
        vndf_vec3 wo = vec((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
        float f[3], cosine = vndf_bsdf_cosine(&bsdf, wo);
        vndf_bsdf_eval(&bsdf, wo, 0, f);
        sum += cosine > 0.0f ? (double)f[0] * (double)cosine : 0.0;
    }
    return sum * 2 * PI / ((double)ROWS * COLUMNS);
}

static void test_leaning_furnace(void)
{
    static const vndf_vec3 eyes[] = {{0.3f, -0.4f, 3.0f}, {2.0f, 0.5f, 1.5f}, {-2.0f, -1.0f, 1.0f}};
    for (size_t i = 0; i < sizeof eyes / sizeof eyes[0]; i++) {
        render_case c;
        vndf_description white = {.eta = 1.0f};
        scene_lobe l = lobe_of(0.5f, 0.2f, -0.1f, 0.3f);
        l.mean_x = 0.4f;
        l.mean_y = -0.2f;
        case_begin(&c, eyes[i], origin);
        case_constant(&c, 1.0f);
        lay(&c, white, &l, 1);
        end(&c);
        double truth = sent_up(&l, unit(eyes[i]));
        TEST(truth < 0.995 && truth > 0.3);
        case_is("a leaning white plate", case_render(&c, SAMPLER_MATERIAL, 0, 128, 51 + (uint64_t)i), truth);
        case_free(&c);
    }
}

static const vndf_description metal = {.f0 = {0.9f, 0.7f, 0.4f}, .effects = {.fresnel = VNDF_FRESNEL_SCHLICK}};

static void add_lamp(render_case *c, vndf_vec3 at, float radius)
{
    case_material(c, MATERIAL_LIGHT, 5.0f, 4.0f, 3.0f);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){at, radius}, case_last(c)));
}

/* A lamp before the plate, and one that hangs half below the mean plane. */
static void test_lights(int count)
{
    render_case c;
    scene_lobe l[2] = {lobe_of(0.4f, 0.1f, 0.0f, 0.3f), lobe_of(0.8f, 0.0f, 0.3f, 0.6f)};
    l[0].mean_x = 0.5f;
    l[1].mean_y = 0.3f;
    case_begin(&c, vec(-1.0f, -2.5f, 1.5f), origin);
    lay(&c, metal, l, count);
    add_lamp(&c, vec(0.0f, 2.0f, 1.2f), 0.4f);
    add_lamp(&c, vec(2.0f, 0.5f, 1.1f), 0.5f);
    end(&c);
    case_agree("lights drawn and met", case_render(&c, SAMPLER_MATERIAL, 0, 256, 61),
               case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 62));
    case_free(&c);
}

/* From a plate that leans away nearly all mirrored light goes into it; what glows below must not be seen. */
static void test_no_leak(void)
{
    render_case c;
    scene_lobe l = lobe_of(0.3f, 0.0f, 0.0f, 0.3f);
    l.mean_x = -0.8f;
    case_begin(&c, vec(0.5f, 0.0f, 1.0f), origin);
    lay(&c, metal, &l, 1);
    case_material(&c, MATERIAL_LIGHT, 9.0f, 9.0f, 9.0f);
    TEST(geometry_add_rectangle(&c.scene.geometry,
                                (rectangle){vec(-50, -50, -0.5f), vec(100, 0, 0), vec(0, 100, 0)}, case_last(&c)));
    end(&c);
    TEST(case_render(&c, SAMPLER_MATERIAL, 0, 64, 71).value == 0.0);
    TEST(case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 64, 72).value == 0.0);
    TEST(case_render(&c, SAMPLER_MATERIAL, EFFECT_MEAN_SLOPES, 64, 73).value == 0.0);
    case_free(&c);
}

/* ---- lobes ---- */

static case_mean lit_plate(scene_lobe *l, int count, vndf_distribution const *plain, const float alpha[2])
{
    render_case c;
    case_begin(&c, vec(0.5f, -3.0f, 1.5f), origin);
    case_constant(&c, 0.1f);
    if (l)
        lay(&c, metal, l, count);
    else
        case_rough(&c, alpha[0], alpha[1], metal)->is.distribution = plain;
    add_lamp(&c, vec(-0.3f, 2.0f, 1.2f), 0.4f);
    end(&c);
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, 0, 256, l ? 81 : 82);
    case_free(&c);
    return mean;
}

static void test_equal_lobes(void)
{
    static const float alpha[2] = {0.3f, 0.5f};
    scene_lobe l[2] = {lobe_of(0.3f, 0.0f, 0.0f, 0.5f), lobe_of(0.3f, 0.0f, 0.0f, 0.5f)};
    l[0].weight.value = 0.3f;
    l[1].weight.value = 1.7f;
    case_mean one = lit_plate(NULL, 0, vndf_ggx(), alpha);
    case_agree("two equal lobes", lit_plate(l, 2, NULL, NULL), one);
    case_agree("a matrix", lit_plate(l, 1, NULL, NULL), one);
    l[1].axes[0] = 1.5f;
    TEST(fabs(lit_plate(l, 2, NULL, NULL).value - one.value) > 0.05 * one.value);
}

/* Weights of a map: where it is 0 the other lobe is alone. */
static void test_weight_map(void)
{
    static const float alpha[2] = {0.3f, 0.5f};
    scene_lobe l[2] = {lobe_of(0.3f, 0.0f, 0.0f, 0.5f), lobe_of(1.5f, 0.0f, 0.0f, 1.5f)};
    image none;
    TEST(image_make(&none, 2, 2));
    l[1].weight.map = &none;
    case_agree("a lobe of weight 0", lit_plate(l, 2, NULL, NULL), lit_plate(NULL, 0, vndf_ggx(), alpha));
    image_free(&none);
}

/* ---- families ---- */

static case_mean of_family(const vndf_family *family, scene_parameter parameter, unsigned without)
{
    render_case c;
    scene_lobe l[2] = {lobe_of(0.3f, 0.0f, 0.1f, 0.4f), lobe_of(1.5f, 0.0f, 0.0f, 1.5f)};
    l[0].family = family;
    l[0].parameter = parameter;
    l[0].weight.value = 2.0f;
    l[0].mean_x = 0.1f;
    case_begin(&c, vec(0.5f, -3.0f, 1.5f), origin);
    case_constant(&c, 0.1f);
    lay(&c, metal, l, 2);
    add_lamp(&c, vec(-0.3f, 2.0f, 1.2f), 0.4f);
    end(&c);
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, without, 256, 83);
    case_free(&c);
    return mean;
}

/* The lobes that a family of GGX, from 1, to Beckmann, at 3, is at 1.5; with that of of_family. */
static case_mean of_mixture(void)
{
    render_case c;
    scene_lobe l[3] = {lobe_of(0.3f, 0.0f, 0.1f, 0.4f), lobe_of(0.3f, 0.0f, 0.1f, 0.4f),
                       lobe_of(1.5f, 0.0f, 0.0f, 1.5f)};
    l[0].mean_x = l[1].mean_x = 0.1f;
    l[0].weight.value = 1.5f;
    l[1].weight.value = 0.5f;
    l[1].distribution = vndf_beckmann();
    case_begin(&c, vec(0.5f, -3.0f, 1.5f), origin);
    case_constant(&c, 0.1f);
    lay(&c, metal, l, 3);
    add_lamp(&c, vec(-0.3f, 2.0f, 1.2f), 0.4f);
    end(&c);
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, 0, 256, 84);
    case_free(&c);
    return mean;
}

/* A constant parameter, and a map of one colour, are the mixture of both knots; left out, the family is the
 * distribution that stands for it. */
static void test_family(void)
{
    const vndf_distribution *const knots[2] = {vndf_ggx(), vndf_beckmann()};
    const float parameters[2] = {1.0f, 3.0f};
    vndf_family *family = vndf_family_of(knots, parameters, 2, NULL);
    image half;
    if (!TEST(family && image_make(&half, 2, 2)))
        return;
    for (int i = 0; i < 12; i++)
        half.rgb[i] = 0.5f;
    case_mean mixed = of_mixture(), ggx = of_family(family, (scene_parameter){1.0f, 1.0f, NULL}, 0);
    case_agree("a family", of_family(family, (scene_parameter){1.5f, 3.0f, NULL}, 0), mixed);
    case_agree("a map", of_family(family, (scene_parameter){2.0f, 1.0f, &half}, 0), mixed);
    case_agree("no family", of_family(family, (scene_parameter){2.0f, 3.0f, &half}, EFFECT_FAMILIES), ggx);
    TEST(fabs(mixed.value - ggx.value) > 6 * (mixed.sigma + ggx.sigma));
    image_free(&half);
    vndf_family_free(family);
}

/* ---- maps of slopes ---- */

/* Normals of slope (x, 0) and (other, 0) in turns along u. */
static int make_normals(image *made, float x, float other)
{
    if (!TEST(image_make(made, 4, 4)))
        return 0;
    for (int i = 0; i < 16; i++) {
        float slope = i % 2 ? other : x, z = 1.0f / sqrtf(1.0f + slope * slope);
        made->rgb[3 * i] = 0.5f - 0.5f * slope * z;
        made->rgb[3 * i + 1] = 0.5f;
        made->rgb[3 * i + 2] = 0.5f + 0.5f * z;
    }
    return 1;
}

static void test_mean_map(void)
{
    const relief_form plain = {1.0f, 1.0f, 0};
    scene_lobe mapped = lobe_of(0.3f, 0.0f, 0.0f, 0.5f), said = mapped;
    image normals;
    relief r;
    if (!make_normals(&normals, 0.25f, 0.25f) || !TEST(relief_of_normals(&r, &normals, &plain)))
        return;
    mapped.relief = &r;
    said.mean_x = 0.25f;
    case_agree("a map of one normal", lit_plate(&mapped, 1, NULL, NULL), lit_plate(&said, 1, NULL, NULL));
    TEST_NEAR(r.steepest, 0.25, 1e-6);
    relief_free(&r);
    image_free(&normals);
}

static void test_filtered_map(void)
{
    const relief_form squares = {2.0f, 2.0f, 2};
    const float alpha[2] = {sqrtf(0.09f + 2.0f * 0.16f), 0.3f};
    scene_lobe l = lobe_of(0.0f, 0.3f, -0.3f, 0.0f); /* a quarter of a turn: round */
    image normals;
    relief r;
    relief_slopes s;
    if (!make_normals(&normals, -0.2f, 0.2f) || !TEST(relief_of_normals(&r, &normals, &squares)))
        return;
    relief_at(&r, 0.4f, 0.7f, &s);
    TEST(r.first.width == 2 && fabsf(s.mean_x) < 1e-6f && fabsf(s.mean_y) < 1e-6f);
    TEST_NEAR(s.xx, 0.16, 1e-6); /* (2 x 0.2)^2 */
    TEST(fabsf(s.xy) < 1e-6f && fabsf(s.yy) < 1e-6f);
    l.relief = &r;
    l.distribution = vndf_beckmann();
    case_agree("slopes in turns", lit_plate(&l, 1, NULL, NULL), lit_plate(NULL, 0, vndf_beckmann(), alpha));
    relief_free(&r);
    image_free(&normals);
}

/* Covariances against sums over the triangles of a mesh, each seen by its share of the plate. */
static void test_moments_of_mesh(void)
{
    const relief_form whole = {0.1f, 0.1f, 16};
    geometry mesh = {0};
    image heights;
    image_error error;
    relief r;
    relief_slopes s;
    double sum[5] = {0};
    if (!TEST(image_make_pattern(&heights, "hammered", 16, 16, &error)) ||
        !TEST(relief_of_heights(&r, &heights, &whole)) ||
        !TEST(geometry_add_displaced(&mesh, plate, &heights, 0.2f, 0) && mesh.triangle_count == 512))
        return;
    for (size_t i = 0; i < mesh.triangle_count; i++) {
        const vndf_vec3 *at = mesh.triangles[i].corner;
        vndf_vec3 n = cross(subtract(at[1], at[0]), subtract(at[2], at[0]));
        double x = -(double)n.x / (double)n.z, y = -(double)n.y / (double)n.z, part = 0.5 * (double)n.z / 4;
        double moments[5] = {x, y, x * x, x * y, y * y};
        for (int k = 0; k < 5; k++)
            sum[k] += part * moments[k];
        TEST(n.z > 0.0f);
    }
    relief_at(&r, 0.3f, 0.3f, &s);
    TEST_NEAR(s.mean_x - sum[0], 0.0, 1e-5);
    TEST_NEAR(s.mean_y - sum[1], 0.0, 1e-5);
    TEST_NEAR(s.xx / (sum[2] - sum[0] * sum[0]), 1.0, 1e-4);
    TEST_NEAR(s.xy - (sum[3] - sum[0] * sum[1]), 0.0, 1e-4 * sum[2]);
    TEST_NEAR(s.yy / (sum[4] - sum[1] * sum[1]), 1.0, 1e-4);
    geometry_free(&mesh);
    relief_free(&r);
    image_free(&heights);
}

/* A plate of heights seen as a whole, under a lamp whose mirror image the waves spread. */
static case_mean of_heights(const image *heights, scene_lobe *l)
{
    render_case c;
    case_begin(&c, vec(0.5f, -9.0f, 8.0f), origin);
    c.scene.camera.field = 5.0f;
    c.scene.integrator.depth = 1;
    case_constant(&c, 0.2f);
    lay(&c, metal, l, 1);
    add_lamp(&c, vec(1.0f, 9.0f, 6.0f), 1.0f);
    if (l->relief)
        TEST(geometry_add_rectangle(&c.scene.geometry, plate, 0));
    else
        TEST(geometry_add_displaced(&c.scene.geometry, plate, heights, 0.0375f, 0));
    TEST(geometry_build(&c.scene.geometry));
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, 0, 256, l->relief ? 91 : 92);
    case_free(&c);
    return mean;
}

/* Heights without order, nearly normal: slopes of 0.2 in the root of the mean square. */
static int make_heights(image *made)
{
    unsigned long long state = 5;
    if (!TEST(image_make(made, 64, 64)))
        return 0;
    for (int i = 0; i < 64 * 64; i++)
        for (int k = 0; k < 6; k++)
            made->rgb[3 * i] += test_uniform(&state) / 6.0f;
    return 1;
}

static void test_heights(void)
{
    const relief_form squares = {0.01875f, 0.01875f, 8};
    scene_lobe mesh = lobe_of(0.1f, 0.0f, 0.0f, 0.1f), filtered;
    image heights;
    relief r;
    mesh.distribution = vndf_beckmann();
    filtered = mesh;
    if (!make_heights(&heights) || !TEST(relief_of_heights(&r, &heights, &squares)))
        return;
    filtered.relief = &r;
    case_mean truth = of_heights(&heights, &mesh), made = of_heights(&heights, &filtered);
    TEST_NEAR(made.value / truth.value, 1.0, 0.05);
    relief_free(&r);
    image_free(&heights);
}

/* ---- retroreflection ---- */

/* A plate that is lit by a lamp behind the eye, or by one in the place where a mirror would show it. */
static case_mean reflected(vndf_reflection reflection, int behind)
{
    render_case c;
    vndf_description is = metal;
    is.effects.reflection = reflection;
    case_begin(&c, vec(0.0f, -1.0f, 1.2f), origin);
    case_rough(&c, 0.15f, 0.15f, is);
    add_lamp(&c, vec(0.0f, behind ? -2.5f : 2.5f, 3.0f), 0.3f);
    end(&c);
    case_mean mean = case_render(&c, SAMPLER_MATERIAL, 0, 256, 101 + (uint64_t)reflection);
    case_free(&c);
    return mean;
}

static void test_retroreflection(void)
{
    case_mean mirrored = reflected(VNDF_REFLECTION_SPECULAR, 0);
    case_agree("the light behind the eye", reflected(VNDF_REFLECTION_RETRO, 1), mirrored);
    TEST(reflected(VNDF_REFLECTION_SPECULAR, 1).value < 0.01 * mirrored.value);
    TEST(reflected(VNDF_REFLECTION_RETRO, 0).value < 0.01 * mirrored.value);
}

/* ---- effects ---- */

/* What is left out is not there: the heaviest lobe is alone, and lies as its alpha says. */
static void test_left_out(void)
{
    const unsigned all =
        EFFECT_MIXTURES | EFFECT_MEAN_SLOPES | EFFECT_RELIEFS | EFFECT_MATRICES | EFFECT_RETROREFLECTION;
    render_case c;
    scene_lobe l[2] = {lobe_of(2.0f, 0.0f, 0.0f, 2.0f), lobe_of(0.0f, 0.3f, -0.3f, 0.0f)};
    vndf_description is = metal;
    relief none = {.steepest = 0.0f};
    l[0].weight.value = 0.4f;
    l[1].mean_x = 0.7f;
    l[1].relief = &none; /* has no image, which nobody looks at */
    case_begin(&c, vec(0.5f, -3.0f, 1.5f), origin);
    case_constant(&c, 0.1f);
    is.effects.reflection = VNDF_REFLECTION_RETRO;
    lay(&c, is, l, 2);
    add_lamp(&c, vec(-0.3f, 2.0f, 1.2f), 0.4f);
    end(&c);
    case_mean left = case_render(&c, SAMPLER_MATERIAL, all, 256, 111);
    c.materials[0].lobe_count = 0;
    c.materials[0].is = metal;
    c.materials[0].is.distribution = vndf_ggx();
    c.materials[0].is.alpha_x = c.materials[0].is.alpha_y = 0.3f;
    case_agree("all left out", left, case_render(&c, SAMPLER_MATERIAL, 0, 256, 112));
    case_free(&c);
}

static void test_effects(void)
{
    material m = {.kind = MATERIAL_MICROFACET};
    scene_lobe l[2] = {lobe_of(0.3f, 0.1f, 0.0f, 0.5f), lobe_of(0.3f, 0.0f, 0.0f, 0.5f)};
    image map = {0};
    TEST(path_material_effects(&m) == EFFECT_MICROFACETS);
    m.lobes = l;
    m.lobe_count = 1;
    TEST(path_material_effects(&m) == (EFFECT_MICROFACETS | EFFECT_MATRICES));
    l[0].mean_y = 0.1f;
    TEST(path_material_effects(&m) == (EFFECT_MICROFACETS | EFFECT_MATRICES | EFFECT_MEAN_SLOPES));
    m.lobe_count = 2;
    l[1].weight.map = &map;
    l[1].family = (const vndf_family *)&map; /* nobody looks at it */
    m.is.effects.reflection = VNDF_REFLECTION_RETRO;
    TEST(path_material_effects(&m) ==
         (EFFECT_MICROFACETS | EFFECT_MATRICES | EFFECT_MEAN_SLOPES | EFFECT_MIXTURES | EFFECT_TEXTURED_WEIGHTS |
          EFFECT_RETROREFLECTION | EFFECT_FAMILIES));
}

int main(void)
{
    test_leaning_furnace();
    test_lights(1);
    test_lights(2);
    test_no_leak();
    test_equal_lobes();
    test_weight_map();
    test_family();
    test_mean_map();
    test_filtered_map();
    test_moments_of_mesh();
    test_heights();
    test_retroreflection();
    test_left_out();
    test_effects();
    return test_done();
}
