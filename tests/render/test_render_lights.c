/* Lights are drawn with the density that they say: directions of an environment by chi-square, over cells of one
 * pixel and of several, with odd sides, and its density integrates to 1; points of emitting shapes, few that are
 * chosen by what they send and many that are chosen by power, against the density of what a ray meets and
 * against paths that only meet them; what stands right before a light bars it. Two chi-squares of level 1e-5 / 2;
 * means within 4.5 sigma, 7e-6 each. */
#include "harness/constants.h"
#include "render/path_case.h"
#include "render/path/parts.h"
#include "measure/pearson.h"
#include "measure/statistics.h"

/* ---- the environment ---- */

/* Longitude and latitude from the left and the top, in pixels. */
static void place_of(const image *map, float turn, vndf_vec3 w, double *x, double *y)
{
    double u = 0.5 + atan2((double)w.x, -(double)w.z) / (2 * PI) + (double)turn / 360;
    *x = (u - floor(u)) * map->width;
    *y = atan2(sqrt((double)(w.x * w.x + w.z * w.z)), (double)w.y) / PI * map->height;
}

static vndf_vec3 direction_of(const image *map, float turn, double x, double y)
{
    double longitude = 2 * PI * (x / map->width - 0.5 - (double)turn / 360), theta = PI * y / map->height;
    return vec((float)(sin(theta) * sin(longitude)), (float)cos(theta), (float)(-sin(theta) * cos(longitude)));
}

static double height_of(const image *map, double y)
{
    return cos(PI * y / map->height);
}

/* What is expected in a bin for each pixel and half of its height: its density times its solid angle. */
static double expect(const path_environment *e, float turn, int bin_pixels, double *bins, size_t columns)
{
    const image *map = e->is->map;
    double sum = 0;
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++) {
            float rgb[3], density;
            e->radiance(e, direction_of(map, turn, x + 0.5, y + 0.5), rgb, &density);
            double middle = 0.5 * (height_of(map, y) + height_of(map, y + 1));
            double half = (height_of(map, y) - middle) * 2 * PI / map->width * (double)density;
            size_t bin = (size_t)(y / bin_pixels) * columns + (size_t)(x / bin_pixels);
            bins[2 * bin] += half;
            bins[2 * bin + 1] += half;
            sum += 2 * half;
        }
    return sum;
}

static size_t bin_of(const image *map, float turn, vndf_vec3 w, int bin_pixels, size_t columns)
{
    double x, y;
    place_of(map, turn, w, &x, &y);
    int row = (int)fmin(y, map->height - 1), column = (int)fmin(x, map->width - 1);
    double middle = 0.5 * (height_of(map, row) + height_of(map, row + 1));
    return 2 * ((size_t)(row / bin_pixels) * columns + (size_t)(column / bin_pixels)) + ((double)w.y < middle);
}

static void test_environment(int width, int height, int bin_pixels)
{
    enum { SAMPLES = 200000 };
    image map;
    path_environment e;
    const float turn = 40.0f;
    unsigned long long state = 9;
    if (!TEST(image_make(&map, width, height)))
        return;
    for (size_t i = 0; i < 3 * (size_t)width * (size_t)height; i++) { /* a bright region; dark pixels everywhere */
        float high = i / 3 % (size_t)width < (size_t)width / 9 ? 9.0f : 0.0f;
        map.rgb[i] = test_uniform(&state) < 0.3f ? 0.0f : high + test_uniform(&state);
    }
    environment is = {.map = &map, .scale = 1.0f, .turn = turn};
    size_t columns = (size_t)((width + bin_pixels - 1) / bin_pixels);
    size_t count = 2 * columns * (size_t)((height + bin_pixels - 1) / bin_pixels);
    double *expected = calloc(count, sizeof *expected), *found = calloc(count, sizeof *found);
    if (TEST(path_environment_make(&e, &is, 1) && e.cells && expected && found)) {
        TEST_NEAR(expect(&e, turn, bin_pixels, expected, columns), 1, 1e-5);
        for (int i = 0; i < SAMPLES; i++) {
            uint64_t choice = test_random_bits(&state);
            float u[2] = {test_uniform(&state), test_uniform(&state)}, rgb[3], density;
            light_sample s;
            path_environment_draw(&e, choice, u, &s);
            found[bin_of(&map, turn, s.direction, bin_pixels, columns)]++;
            e.radiance(&e, s.direction, rgb, &density);
            TEST_NEAR((double)dot(s.direction, s.direction), 1, 1e-6);
            if (fabsf(u[0] - 0.5f) < 0.49f && fabsf(u[1] - 0.5f) < 0.49f) /* not on the border of two cells */
                TEST_RELATIVE((double)density, (double)s.density, 1e-5);
        }
        for (size_t i = 0; i < count; i++)
            expected[i] *= SAMPLES;
        TEST(pearson_of(expected, found, NULL, count, 10).p > statistics_sidak(1e-5, 2));
    }
    free(expected);
    free(found);
    path_environment_free(&e);
    image_free(&map);
}

/* Nothing is drawn of what is nearly even, nor of what is black. */
static void test_even(void)
{
    image map;
    path_environment e;
    environment is = {.map = &map, .scale = 1.0f};
    TEST(image_make(&map, 16, 8));
    TEST(path_environment_make(&e, &is, 1) && !e.cells);
    for (int i = 0; i < 3 * 16 * 8; i++)
        map.rgb[i] = i % 2 ? 1.0f : 0.8f;
    TEST(path_environment_make(&e, &is, 1) && !e.cells);
    image_free(&map);
}

/* ---- shapes ---- */

static void add_triangle(render_case *c, vndf_vec3 a, vndf_vec3 b, vndf_vec3 d)
{
    const triangle t = {{a, b, d}, {{0, 0, 0}}, {0, 0, 0}, {0, 0, 0}};
    TEST(geometry_add_triangle(&c->scene.geometry, &t, case_last(c)));
}

/* A matte floor, and `count` spheres, rectangles and triangles that emit: one from another material. */
static void lights_begin(render_case *c, int count)
{
    unsigned long long state = 3;
    case_begin(c, vec(0.3f, -3.0f, 1.0f), vec(0, 0, 0));
    case_material(c, MATERIAL_MATTE, 0.5f, 0.5f, 0.5f);
    TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){vec(-1, -1, 0), vec(2, 0, 0), vec(0, 2, 0)}, 0));
    for (int i = 0; i < count; i++) {
        float x = 4.0f * test_uniform(&state) - 2.0f, y = 4.0f * test_uniform(&state) - 2.0f;
        vndf_vec3 at = vec(x, y, 2.0f * test_uniform(&state) - 0.3f); /* some are below the floor */
        if (i < 2)
            case_material(c, MATERIAL_LIGHT, 1.0f + 9.0f * (float)i, 3.0f, 2.0f);
        if (i % 3 == 0)
            TEST(geometry_add_sphere(&c->scene.geometry, (sphere){at, 0.2f}, case_last(c)));
        else if (i % 3 == 1)
            TEST(geometry_add_rectangle(&c->scene.geometry, (rectangle){at, vec(0, 0.3f, 0), vec(0.4f, 0, 0.1f)},
                                        case_last(c)));
        else
            add_triangle(c, at, add(at, vec(0.1f, 0.5f, -0.1f)), add(at, vec(0.5f, 0, 0.3f)));
    }
    TEST(geometry_build(&c->scene.geometry));
}

/* Draws find lights with the density of what is met, and the parts of all are 1. */
static void test_density(const render_case *c)
{
    path_lights lights;
    light_view v;
    unsigned long long state = 5;
    int met = 0;
    TEST(path_lights_make(&lights, &c->scene) && lights.count > 0);
    for (int i = 0; i < 3000; i++) {
        uint64_t choice = test_random_bits(&state);
        float u[3] = {test_uniform(&state), 0.02f + 0.96f * test_uniform(&state), test_uniform(&state)};
        light_sample s;
        hit h;
        path_lights_look(&lights, 0.0f, vec(test_uniform(&state), test_uniform(&state), 0.01f), vec(0, 0, 1), &v);
        double sum = 0;
        for (uint32_t k = 0; !lights.by_power && k < lights.count; k++)
            sum += (double)v.part[k];
        TEST_NEAR(lights.by_power ? 1 : sum, 1, 1e-5);
        if (!path_lights_draw(&lights, &v, choice, u, &s))
            continue;
        ray r = {v.place, s.direction, 0.0f, INFINITY};
        if (!TEST(geometry_hit(&c->scene.geometry, &r, &h)) || lights.of_shape[h.shape] < 0 ||
            lights.lights[lights.of_shape[h.shape]].radiance != s.radiance)
            continue; /* something else stands before it */
        met++;
        TEST_RELATIVE((double)path_lights_density(&lights, &v, s.direction, &h), (double)s.density, 1e-3);
    }
    TEST(met > 500);
    path_lights_free(&lights);
}

/* No corner of a light is outside of the sphere that stands for it, however obtuse a triangle is. */
static void test_spheres_about(void)
{
    render_case c;
    path_lights lights;
    unsigned long long state = 8;
    case_begin(&c, vec(0, 0, 1), vec(0, 0, 0));
    case_material(&c, MATERIAL_LIGHT, 1, 1, 1);
    for (int i = 0; i < 200; i++) {
        vndf_vec3 a = vec(test_uniform(&state), test_uniform(&state), test_uniform(&state));
        vndf_vec3 b = vec(test_uniform(&state), test_uniform(&state), test_uniform(&state));
        add_triangle(&c, a, b, vec(test_uniform(&state), test_uniform(&state), test_uniform(&state)));
    }
    TEST(path_lights_make(&lights, &c.scene) && lights.count == 200);
    for (uint32_t i = 0; i < lights.count; i++)
        for (int k = 0; k < 3; k++) {
            const path_light *l = &lights.lights[i];
            vndf_vec3 way = subtract(c.scene.geometry.triangles[l->shape].corner[k], l->sphere.centre);
            TEST(sqrtf(dot(way, way)) <= l->sphere.radius * 1.000001f);
        }
    path_lights_free(&lights);
    case_free(&c);
}

/* A lamp far above a matte floor; behind a plate that is close to it, nothing comes from it. */
static void test_close_blocker(float before, int is_dark)
{
    render_case c;
    case_begin(&c, vec(0.3f, -3.0f, 1.0f), vec(0, 0, 0));
    case_material(&c, MATERIAL_MATTE, 0.5f, 0.5f, 0.5f);
    TEST(geometry_add_rectangle(&c.scene.geometry, (rectangle){vec(-1, -1, 0), vec(2, 0, 0), vec(0, 2, 0)}, 0));
    TEST(geometry_add_rectangle(&c.scene.geometry, /* their fronts are below */
                                (rectangle){vec(-9, -9, 100.0f - before), vec(0, 18, 0), vec(18, 0, 0)}, 0));
    case_material(&c, MATERIAL_LIGHT, 50, 50, 50);
    TEST(
        geometry_add_rectangle(&c.scene.geometry, (rectangle){vec(-5, -5, 100), vec(0, 10, 0), vec(10, 0, 0)}, 1));
    TEST(geometry_build(&c.scene.geometry));
    case_mean drawn = case_render(&c, SAMPLER_MATERIAL, 0, 16, 3);
    TEST(is_dark ? drawn.value == 0 : drawn.value > 0);
    case_free(&c);
}

static void test_shapes(int count)
{
    render_case c;
    lights_begin(&c, count);
    test_density(&c);
    case_mean drawn = case_render(&c, SAMPLER_MATERIAL, 0, 256, 1);
    case_mean met = case_render(&c, SAMPLER_MATERIAL, EFFECT_LIGHTS, 1024, 2);
    case_agree("lights", drawn, met);
    case_free(&c);
}

int main(void)
{
    test_environment(37, 19, 1);
    test_environment(1601, 801, 40);
    test_even();
    test_spheres_about();
    test_close_blocker(0.005f, 1);
    test_close_blocker(-0.005f, 0);
    test_shapes(7);
    test_shapes(40);
    return test_done();
}
