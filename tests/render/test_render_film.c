/* A film is the same to the bit for any number of threads, but for the rounding of sums also in two runs, and
 * another one for another seed; an interrupt leaves whole passes. Plans say what a scene calls for and refuse what
 * a material of a shape cannot have. An image of the surroundings brings its energy, seen where it should be,
 * drawn or met: within 4.5 sigma, 7e-6 each to fail by chance. */
#include "harness/constants.h"
#include "render/path_case.h"
#include "render/path/parts.h"

/* A glass ball and a metal one over a matte floor, with a lamp. */
static void room_begin(render_case *c)
{
    vndf_description glass = {.eta = 1.5f}, metal = {.f0 = {0.9f, 0.7f, 0.4f}};
    glass.effects.lobes = VNDF_LOBES_BOTH;
    glass.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    metal.effects.fresnel = VNDF_FRESNEL_SCHLICK;
    case_begin(c, vec(0.0f, 1.0f, 5.0f), vec(0.0f, 0.5f, 0.0f));
    c->scene.width = 33;
    c->scene.height = 21;
    c->scene.camera.field = 35.0f;
    case_constant(c, 0.5f);
    case_rough(c, 0.1f, 0.3f, glass);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){vec(-0.7f, 0.6f, 0.0f), 0.6f}, case_last(c)));
    case_rough(c, 0.2f, 0.2f, metal);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){vec(0.7f, 0.6f, 0.0f), 0.6f}, case_last(c)));
    case_material(c, MATERIAL_MATTE, 0.7f, 0.6f, 0.5f);
    TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){vec(-3, 0, 3), vec(6, 0, 0), vec(0, 0, -6)},
                                case_last(c)));
    case_material(c, MATERIAL_LIGHT, 9.0f, 9.0f, 9.0f);
    TEST(geometry_add_sphere(&c->scene.geometry, (sphere){vec(0, 3, 1), 0.3f}, case_last(c)));
    TEST(geometry_build(&c->scene.geometry));
}

/* ---- films ---- */

static int stop_in_second_half(double done, void *user)
{
    (void)user;
    return done > 0.6;
}

static void render(film *f, const path_plan *plan, const scene *s, unsigned threads, uint64_t samples,
                   uint64_t seed)
{
    film_run run = {.samples = samples, .threads = threads, .seed = seed};
    TEST(film_make(f, s->width, s->height));
    TEST(film_render(f, plan, &run));
}

static int is_same(const film *a, const film *b)
{
    size_t count = (size_t)a->width * (size_t)a->height;
    return a->samples == b->samples && memcmp(a->sum, b->sum, 3 * count * sizeof *a->sum) == 0 &&
           memcmp(a->square, b->square, count * sizeof *a->square) == 0;
}

static void test_threads(const render_case *c)
{
    path_plan *plan = case_plan(c, SAMPLER_MATERIAL, 0);
    film one, other;
    render(&one, plan, &c->scene, 1, 9, 1);
    for (unsigned threads = 1; threads <= 3; threads++) {
        render(&other, plan, &c->scene, threads, 9, 1);
        TEST(is_same(&one, &other));
        TEST(other.counts.segments == one.counts.segments && other.counts.paths == 9 * 33 * 21);
        film_free(&other);
    }
    render(&other, plan, &c->scene, 2, 9, 2);
    TEST(!is_same(&one, &other));
    film_free(&other);
    film_free(&one);
    path_free(plan);
}

/* In two runs the sums are rounded otherwise, to some parts in 1e16. */
static void test_continued(const render_case *c)
{
    path_plan *plan = case_plan(c, SAMPLER_MATERIAL, 0);
    film one, two;
    film_run more = {.samples = 5, .threads = 2, .seed = 1};
    render(&one, plan, &c->scene, 1, 9, 1);
    render(&two, plan, &c->scene, 1, 4, 1);
    TEST(film_render(&two, plan, &more) && two.samples == 9);
    for (int i = 0; i < 3 * 33 * 21; i++)
        TEST_NEAR(two.sum[i], one.sum[i], 1e-13 * one.sum[i]);
    film_free(&one);
    film_free(&two);
    path_free(plan);
}

/* 100 samples are passes of 47, 47 and 6: the second is stopped, and only the first is there. */
static void test_stopped(const render_case *c)
{
    path_plan *plan = case_plan(c, SAMPLER_MATERIAL, 0);
    film f, whole;
    film_run run = {.samples = 100, .threads = 2, .seed = 1, .progress = stop_in_second_half};
    TEST(film_make(&f, c->scene.width, c->scene.height));
    TEST(!film_render(&f, plan, &run));
    TEST(f.samples == 47);
    render(&whole, plan, &c->scene, 1, 47, 1);
    TEST(is_same(&f, &whole));
    film_free(&f);
    film_free(&whole);
    path_free(plan);
}

static void test_seconds(const render_case *c)
{
    path_plan *plan = case_plan(c, SAMPLER_MATERIAL, 0);
    film f;
    film_run run = {.samples = 1000000000, .seconds = 0.05, .threads = 1, .seed = 1};
    TEST(film_make(&f, c->scene.width, c->scene.height));
    TEST(film_render(&f, plan, &run) && f.samples > 0 && f.seconds >= 0.05);
    film_free(&f);
    path_free(plan);
}

/* ---- plans ---- */

static unsigned effects_of(const render_case *c, unsigned without)
{
    path_plan *plan = case_plan(c, SAMPLER_MATERIAL, without);
    unsigned effects = path_effects(plan);
    path_free(plan);
    return effects;
}

static void test_effects(const render_case *c)
{
    const unsigned all =
        EFFECT_MICROFACETS | EFFECT_REFRACTION | EFFECT_LIGHTS | EFFECT_ENVIRONMENT | EFFECT_MATTE;
    TEST(effects_of(c, 0) == all);
    TEST(effects_of(c, EFFECT_LIGHTS) == (all & ~(unsigned)EFFECT_LIGHTS));
}

static void check_refusal(const render_case *c, path_sampler sampler, const char *text)
{
    char message[512] = "";
    path_plan *plan = path_prepare(&c->scene, sampler, 0, message, sizeof message);
    TEST(plan == NULL);
    TEST_HAS(message, text);
    path_free(plan);
}

static void test_refusals(const render_case *c)
{
    check_refusal(c, SAMPLER_BOUNDED, "material 'material'");
}

/* Materials that no shape has are not prepared: they cannot refuse. */
static void test_unused(void)
{
    render_case c;
    const vndf_effects both = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC};
    const vndf_description glass = {.effects = both, .eta = 1.5f};
    case_begin(&c, vec(0, 0, 5), vec(0, 0, 0));
    case_constant(&c, 1.0f);
    case_rough(&c, 0.3f, 0.3f, glass);
    case_material(&c, MATERIAL_MIRROR, 0.5f, 0.5f, 0.5f);
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(0, 0, 0), 1.0f}, case_last(&c)));
    TEST(geometry_build(&c.scene.geometry));
    case_is("one material of two", case_render(&c, SAMPLER_BOUNDED, 0, 1, 1), 0.5);
    case_free(&c);
}

/* ---- surroundings ---- */

static void surround(render_case *c, const image *map)
{
    case_begin(c, vec(0.3f, 1.0f, 2.0f), vec(0, 0, 0));
    c->scene.environment = (environment){.map = map, .scale = 2.0f, .turn = 30.0f};
    case_material(c, MATERIAL_MATTE, 0.5f, 0.5f, 0.5f);
    TEST(geometry_add_rectangle(&c->scene.geometry, /* its normal is +y */
                                (rectangle){vec(-1, 0, 1), vec(2, 0, 0), vec(0, 0, -2)}, case_last(c)));
    TEST(geometry_build(&c->scene.geometry));
}

static void fill(image *map, float grey)
{
    for (int i = 0; i < 3 * map->width * map->height; i++)
        map->rgb[i] = grey;
}

static void brighten(image *map, int x, int y, float grey)
{
    for (int k = 0; k < 3; k++)
        map->rgb[3 * (y * map->width + x) + k] = grey;
}

/* One bright pixel in a dim image: 1/pi of the reflectance times the integral of the light that falls in, of
 * pixels as if they were even; between pixels a tent keeps the mass but for sine and cosine, 1 percent here. */
static void test_image(void)
{
    render_case c;
    image map;
    TEST(image_make(&map, 64, 32));
    fill(&map, 1.0f);
    surround(&c, &map);
    case_is("even", case_render(&c, SAMPLER_MATERIAL, 0, 64, 51), 0.5 * 2);
    brighten(&map, 10, 8, 1000.0f);
    double theta = PI * 8.5 / 32, solid = 2 * PI * PI / (64.0 * 32.0) * sin(theta);
    case_mean drawn = case_render(&c, SAMPLER_MATERIAL, 0, 256, 52);
    case_mean met = case_render(&c, SAMPLER_MATERIAL, EFFECT_ENVIRONMENT_MAP, 4096, 53);
    double truth = 0.5 * 2 * (1 + 999 * solid * cos(theta) / PI);
    TEST_NEAR(drawn.value, truth, 0.01 * truth + 4.5 * drawn.sigma);
    TEST(drawn.sigma < met.sigma);
    case_agree("drawn and met", drawn, met);
    case_free(&c);
    image_free(&map);
}

/* An image and a lamp take turns. */
static void test_image_and_lamp(void)
{
    render_case c;
    image map;
    TEST(image_make(&map, 16, 8));
    fill(&map, 1.0f);
    surround(&c, &map);
    brighten(&map, 5, 2, 100.0f); /* an image that is more even would not be drawn */
    case_material(&c, MATERIAL_LIGHT, 4.0f, 4.0f, 4.0f);
    geometry_free(&c.scene.geometry);
    TEST(geometry_add_rectangle(&c.scene.geometry, (rectangle){vec(-1, 0, 1), vec(2, 0, 0), vec(0, 0, -2)}, 0));
    TEST(geometry_add_sphere(&c.scene.geometry, (sphere){vec(0, 2, 0), 1.0f}, 1));
    TEST(geometry_build(&c.scene.geometry));
    case_mean met = case_render(&c, SAMPLER_MATERIAL, EFFECT_ENVIRONMENT_MAP | EFFECT_LIGHTS, 1024, 61);
    case_agree("both drawn", case_render(&c, SAMPLER_MATERIAL, 0, 256, 62), met);
    case_agree("lamp drawn", case_render(&c, SAMPLER_MATERIAL, EFFECT_ENVIRONMENT_MAP, 256, 63), met);
    case_agree("image drawn", case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 256, 64), met);
    case_free(&c);
    image_free(&map);
}

/* The centre of the image is along -z, its right along +x. */
static void test_directions(void)
{
    image map;
    environment is = {.map = &map, .scale = 1.0f};
    path_environment e;
    float rgb[3];
    TEST(image_make(&map, 16, 8));
    for (int i = 0; i < 16 * 8; i++)
        brighten(&map, i % 16, i / 16, (float)(i % 16 + 100 * (i / 16)));
    TEST(path_environment_make(&e, &is, 1));
    e.radiance(&e, vec(0, 0, -1), rgb, NULL);
    TEST_NEAR((double)rgb[0], 7.5 + 350, 1e-2);
    e.radiance(&e, vec(1, 0, 0), rgb, NULL);
    TEST_NEAR((double)rgb[0], 11.5 + 350, 1e-2);
    e.radiance(&e, unit(vec(1e-3f, 1, 0)), rgb, NULL);
    TEST_NEAR((double)rgb[0], 11.5, 1e-2);
    e.radiance(&e, unit(vec(1e-3f, -1, 0)), rgb, NULL);
    TEST_NEAR((double)rgb[0], 11.5 + 700, 1e-2);
    path_environment_free(&e);
    is.turn = 60.0f; /* z towards x, hence what was along -z towards -x */
    TEST(path_environment_make(&e, &is, 0));
    e.radiance(&e, vec(-sqrtf(0.75f), 0, -0.5f), rgb, NULL);
    TEST_NEAR((double)rgb[0], 7.5 + 350, 1e-2);
    path_environment_free(&e);
    image_free(&map);
}

int main(void)
{
    render_case c;
    room_begin(&c);
    test_threads(&c);
    test_continued(&c);
    test_stopped(&c);
    test_seconds(&c);
    test_effects(&c);
    test_refusals(&c);
    case_free(&c);
    test_unused();
    test_image();
    test_image_and_lamp();
    test_directions();
    return test_done();
}
