/* Light comes out right. In a white furnace nothing is seen: light of 1 from everywhere onto surfaces that lose
 * none of it makes every pixel 1, under a dome and in a room whose walls are lights. Light of spheres and
 * rectangles on a matte floor is that of closed forms, and what stands before a light bars it. A wall shows the
 * integral over a sky, a rough floor f of the library under a small lamp. All samplers show the same of metals
 * and glass, also through refraction and walks; perfect sampling has no more variance than visible normals, which
 * have less than all normals at a grazing angle. Notices light that paths lose or gain: by rays that meet their
 * own surface, by weights of drawn light; rows and pixels of a sky that are off by one, choices that
 * forget a light; wrong densities, areas and cosines, lights that shine backwards, shadow rays that end
 * too early or too late, candidates that are not kept in proportion to their weight. */
#include "render_case.h"

/* ---- the furnace ---- */

static const char *const lossless[] = {
    "material m --matte 1,1,1\n",
    "material m --shape --distribution ggx --alpha 0.8 --scattering multiple\n",
    "material m --shape --distribution beckmann --alpha 0.2,0.9 --scattering multiple\n",
    "material m --dielectric 1.5 --distribution ggx --alpha 0.4 --scattering multiple\n",
};

#define DOME "environment --constant 1,1,1\n"
/* Six rectangles that shine inwards: their light is drawn. */
#define ROOM                                                                      \
  "material wall --light 1,1,1\n"                                                 \
  "rectangle --corner -6,-6,-6 --edge-u 0,0,12 --edge-v 12,0,0 --material wall\n" \
  "rectangle --corner -6,6,-6 --edge-u 12,0,0 --edge-v 0,0,12 --material wall\n"  \
  "rectangle --corner -6,-6,-6 --edge-u 0,12,0 --edge-v 0,0,12 --material wall\n" \
  "rectangle --corner 6,-6,-6 --edge-u 0,0,12 --edge-v 0,12,0 --material wall\n"  \
  "rectangle --corner -6,-6,-6 --edge-u 12,0,0 --edge-v 0,12,0 --material wall\n" \
  "rectangle --corner -6,-6,6 --edge-u 0,12,0 --edge-v 12,0,0 --material wall\n"

/* In a dome every sample is 1; in a room it is, on average. */
static void test_furnace(const char *kind, const char *lit, double most)
{
    char text[2048];
    snprintf(text, sizeof text,
             "camera --from 0,0,5 --to 0,0,0 --field 24 --width 24 --height 24 --depth 10000\n%s%s"
             "sphere --centre 0,0,0 --radius 1 --material m\n",
             lit, kind);
    scene *s = case_scene(text);
    film f = {.sum = NULL};
    double worst = 0;
    case_render(&f, s, SAMPLER_VISIBLE, test_amount(16, 64, 64), 1);
    for (size_t i = 0; i < film_pixels(&f); i++)
        worst = fmax(worst, fabs(film_light(&f, i) - 1));
    if (!(TEST(worst < most) & case_agrees(case_mean_of(&f), 1, 2e-4)))
        fprintf(stderr, "    %s%s    worst %g\n", lit, kind, worst);
    film_free(&f);
    scene_free(s);
}

/* ---- closed forms ---- */

#define FLOOR                                                                      \
  "camera --from 0,1,3 --to 0,0,0 --depth 1\nmaterial floor --matte 0.5,0.5,0.5\n" \
  "rectangle --corner -9,0,9 --edge-u 18,0,0 --edge-v 0,0,-18 --material floor\n"

/* From a point in the plane of the corner, at right angles below it: both sides over the distance (Siegel & Howell). */
static double corner_factor(double a, double b)
{
    double x = sqrt(1 + a * a), y = sqrt(1 + b * b);
    return (a / x * atan(b / x) + b / y * atan(a / y)) / (2 * PI);
}

#define LAMP "material lamp --light 8,8,8\n"

#define PANEL "rectangle --corner -1,2,-0.5 --edge-u 2,0,0 --edge-v 0,0,1 --material lamp\n"
#define ABOVE "sphere --centre 0,2,0 --radius 0.25 --material lamp\n"
#define ASIDE "sphere --centre 4,3,0 --radius 0.25 --material lamp\n"

static void test_floors(void)
{
    const double above = 0.5 * 8 * 0.25 * 0.25 / (2 * 2), aside = 0.5 * 8 * 0.25 * 0.25 / 25 * (3 / 5.0);
    const double panel = 0.5 * 8 * 4 * corner_factor(0.5, 0.25);
    const struct {
        const char *lights;
        double want;
    } floors[] = {
        {ABOVE, above},
        {ASIDE, aside},
        {PANEL, panel},
        {"sphere --centre 0,2.2,0 --radius 0.1 --material lamp\n" ASIDE PANEL,
         panel + aside}, /* the panel hides it */
        {PANEL "rectangle --corner -1,1.999999,-0.5 --edge-u 1,0,0 --edge-v 0,0,1 --material floor\n", panel / 2},
        {"rectangle --corner -1,2,0.5 --edge-u 2,0,0 --edge-v 0,0,-1 --material lamp\n" ASIDE,
         aside},                                                    /* shines up */
        {"sphere --centre 0,0,0 --radius 40 --material lamp\n", 0}, /* all is inside, where it does not shine */
    };
    for (size_t i = 0; i < sizeof floors / sizeof *floors; i++) {
        char text[2048];
        snprintf(text, sizeof text, FLOOR LAMP "%s", floors[i].lights);
        scene *s = case_point(text);
        if (!case_agrees(case_light(s, SAMPLER_VISIBLE, test_amount(64, 512, 512)), floors[i].want, 1e-4))
            fprintf(stderr, "    %s", floors[i].lights);
        scene_free(s);
    }
}

/* ---- the sky ---- */

/* A wall that faces +x, lit by an image that is turned, and by a lamp too small to hide much of it: the integral
 * over the image by its own pixels and angles, and the closed form of a sphere. */
static void test_sky(void)
{
    enum { WIDTH = 24, HEIGHT = 14, FINER = 8 };
    scene *s = case_point("camera --from 3,0,0 --to 0,0,0 --depth 1\nmaterial wall --matte 0.5,0.5,0.5\n"
                          "rectangle --corner 0,-9,9 --edge-u 0,0,-18 --edge-v 0,18,0 --material wall\n"
                          "environment --image studio:24,14 --turn 40\n" LAMP
                          "sphere --centre 2,1.5,0 --radius 0.05 --material lamp\n");
    double want = 0.5 * 8 * 0.0025 / 6.25 * 0.8, low = 0.5 / HEIGHT;
    unsigned long long state = 4;
    TEST(s->environment.is_drawn);
    float up[3]; /* at a pole there is its row alone */
    environment_radiance(&s->environment, vec(0, 1, 0), up);
    TEST_RELATIVE((double)up[0], (double)image_pixel(s->environment.map, 0, 0)[0], 1e-6);
    for (int i = 0; i < 1000; i++) { /* the density of what is drawn is that of where it is */
        const double u[3] = {0, test_uniform_double(&state), test_uniform_double(&state)};
        light_sample l;
        TEST(lights_draw(s, vec(1, 0, 0), u, &l) && !isfinite(l.distance));
        TEST_RELATIVE(lights_density(s, vec(1, 0, 0), l.direction, NULL), l.density, 1e-9);
    }
    for (int i = 0; i < WIDTH * HEIGHT * FINER * FINER; i++) {
        const double u = (i % (WIDTH * FINER) + 0.5) / (WIDTH * FINER),
                     longitude = 2 * PI * (u - 0.5 - 40.0 / 360);
        const double v = ((double)(i / (WIDTH * FINER)) + 0.5) / (HEIGHT * FINER), across = sin(PI * v);
        float rgb[3];
        image_bilinear(s->environment.map, u, fmin(fmax(v, low), 1 - low), rgb);
        want += 0.5 / PI * luminance(rgb) * fmax(across * sin(longitude), 0) * across * 2 * PI * PI /
                (WIDTH * HEIGHT * FINER * FINER);
    }
    case_agrees(case_light(s, SAMPLER_VISIBLE, test_amount(256, 512, 512)), want, 1e-3);
    scene_free(s);
}

/* ---- gloss ---- */

/* A rough floor under a lamp so small that f is the same all over it. */
static void test_gloss(float alpha)
{
    const vndf_description is = {.surface = vndf_rough(vndf_ggx(), alpha, alpha)};
    const vec3 lamp = vec(0.3, 2, -2.5), to = unit(lamp);
    vndf_material resolved;
    vndf_bsdf bsdf;
    float f[3];
    char text[2048];
    snprintf(text, sizeof text,
             "camera --from 0,1,1 --to 0,0,0 --depth 1\n" LAMP
             "material floor --shape --distribution ggx --alpha %g\n"
             "rectangle --corner -2,0,2 --edge-u 4,0,0 --edge-v 0,0,-4 --material floor\n"
             "sphere --centre 0.3,2,-2.5 --radius 0.01 --material lamp\n",
             (double)alpha);
    scene *s = case_point(text);
    TEST(vndf_material_resolve(&is, &resolved, NULL) == VNDF_OK);
    vndf_bsdf_at(&bsdf, &resolved, (vndf_vec3){0.0f, -(float)sqrt(0.5), (float)sqrt(0.5)});
    vndf_bsdf_eval(&bsdf, (vndf_vec3){(float)to.x, -(float)to.z, (float)to.y}, 0, f);
    const double want = 8 * (double)f[0] * to.y * PI * 1e-4 / dot(lamp, lamp);
    for (int sampler = 0; sampler < SAMPLERS; sampler++)
        case_agrees(case_light(s, (path_sampler)sampler, test_amount(16, 32, 256)), want, 2e-3);
    scene_free(s);
}

/* ---- samplers ---- */

/* Walks have no sampler by all normals. */
static void test_samplers(const char *kind, double order[3])
{
    char text[2048];
    snprintf(text, sizeof text,
             "camera --from 0,0.25,3 --to 0,0,0\n"
             "environment --image studio:64,32\n"
             "material m %s\nmaterial floor --matte 0.5,0.5,0.5\n"
             "rectangle --corner -3,0,3 --edge-u 6,0,0 --edge-v 0,0,-6 --material m\n"
             "rectangle --corner -3,-0.5,3 --edge-u 6,0,0 --edge-v 0,0,-6 --material m\n"
             "rectangle --corner -9,-1,9 --edge-u 18,0,0 --edge-v 0,0,-18 --material floor\n",
             kind);
    scene *s = case_point(text);
    case_mean visible = {0, 0, 0};
    for (int i = 0; i < SAMPLERS; i++) {
        const case_mean mean =
            case_light(s, i == SAMPLER_ALL && strstr(kind, "multiple") ? SAMPLER_VISIBLE : (path_sampler)i,
                       i == SAMPLER_PERFECT ? test_amount(16, 32, 256) : test_amount(64, 128, 256));
        if (i == SAMPLER_VISIBLE)
            visible = mean;
        if (!TEST_NEAR(mean.value, visible.value, 4.5 * hypot(mean.sigma, visible.sigma)))
            fprintf(stderr, "    %s: %s\n", kind, path_sampler_names[i]);
        order[i] = mean.variance;
    }
    scene_free(s);
}

int main(void)
{
    static const char *const kinds[] = {"--conductor gold --distribution ggx --alpha 0.1",
                                        "--dielectric 1.5 --distribution ggx --alpha 0.3",
                                        "--dielectric 1.5 --distribution beckmann --alpha 0.05,0.4",
                                        "--dielectric 1 --distribution ggx --alpha 0.3",
                                        "--dielectric 1.3 --distribution ggx --alpha 0.4 --scattering multiple",
                                        "--shape --distribution ggx --alpha 0.5"};
    double variance[3];
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        test_samplers(kinds[i], variance);
    TEST(variance[SAMPLER_PERFECT] < variance[SAMPLER_VISIBLE] &&
         variance[SAMPLER_VISIBLE] < variance[SAMPLER_ALL]);
    for (size_t i = 0; i < sizeof lossless / sizeof *lossless; i++) {
        test_furnace(lossless[i], DOME, 2e-3);
        test_furnace(lossless[i], ROOM, 0.5);
    }
    test_floors();
    test_gloss(0.1f);
    test_gloss(0.5f);
    test_sky();
    return test_done();
}
