/* Light comes out right. In a white furnace nothing is seen: light of 1 from everywhere onto surfaces that lose none
 * of it makes every pixel 1, under a dome and in a room whose walls are lights. Light of spheres and rectangles on a
 * matte floor is that of closed forms, and what stands before a light bars it. A wall shows the integral over a sky.
 * All samplers show the same of metals and glass, also through refraction and walks; perfect sampling has no more
 * variance than visible normals, which have less than all normals at a grazing angle. Notices light that paths lose
 * or gain: by rays that meet their own surface, by weights of drawn light; rows and pixels of a sky that are off by
 * one, choices that forget a light; wrong densities, areas and cosines, lights that shine backwards, shadow rays
 * that end too early or too late, candidates that are not kept in proportion to their weight. */
#include "harness/test.h"
#include "render/film.h"

/* The mean light of a picture with its standard deviation, and the variance of one sample. */
typedef struct light {
    double value, sigma, variance;
} light;

/* That of a scene, or of one point of it, seen through a field so narrow that all pixels see it. It has to be the
 * light that is wanted to 4.5 sigma, 7e-6 by chance, and 1e-3. */
static light look(const char *text, int is_point, path_sampler sampler, uint64_t samples, light want)
{
    const size_t length = strlen(text);
    scene *s = scene_read("x.scene", strcpy(malloc(length + 1), text), length, 16);
    comparison c = {.count = 1, .samples = samples, .threads = 2, .seed = 1, .way = {{.sampler = sampler}}};
    const film *f = &c.way[0].film;
    double sum = 0, square = 0, count = 256 * (double)samples;
    if (!TEST(s != NULL))
        return want;
    s->field = is_point ? 1e-6 : s->field;
    s->height = 16;
    TEST(comparison_begin(&c, s) && comparison_run(&c) && f->counts.lost == 0);
    for (size_t i = 0; i < 256; i++) {
        sum += film_light(f, i) * (double)samples;
        square += f->square[i];
    }
    comparison_end(&c);
    scene_free(s);
    const double variance = fmax(square / count - sum * sum / (count * count), 0);
    const light is = {sum / count, sqrt(variance / count), variance};
    if (!TEST_NEAR(is.value, want.value, 4.5 * hypot(is.sigma, want.sigma) + 1e-3 * want.value))
        fprintf(stderr, "    %s", text);
    return is;
}

/* ---- light that is known ---- */

/* In a furnace. */
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
#define BALL(kind)                                                                 \
  "camera --from 0,0,5 --to 0,0,0 --field 24 --depth 10000\nmaterial m " kind "\n" \
  "sphere --centre 0,0,0 --radius 1 --material m\n"

/* On a floor. */
#define LAMP "material lamp --light 8,8,8\n"
#define FLOOR                                                                           \
  "camera --from 0,1,3 --to 0,0,0 --depth 1\nmaterial floor --matte 0.5,0.5,0.5\n" LAMP \
  "rectangle --corner -9,0,9 --edge-u 18,0,0 --edge-v 0,0,-18 --material floor\n"
#define PANEL "rectangle --corner -1,2,-0.5 --edge-u 2,0,0 --edge-v 0,0,1 --material lamp\n"
#define ASIDE "sphere --centre 4,3,0 --radius 0.25 --material lamp\n"

/* A wall that faces +x, lit by an image that is turned, and by a lamp too small to hide much of it. */
#define SKY                                                                            \
  "camera --from 3,0,0 --to 0,0,0 --depth 1\nmaterial wall --matte 0.5,0.5,0.5\n" LAMP \
  "rectangle --corner 0,-9,9 --edge-u 0,0,-18 --edge-v 0,18,0 --material wall\n"       \
  "environment --image studio:24,14 --turn 100\nsphere --centre 2,1.5,0 --radius 0.05 --material lamp\n"

/* From a point in the plane of the corner, at right angles below it: both sides over the distance (Siegel & Howell). */
static double corner_factor(double a, double b)
{
    double x = sqrt(1 + a * a), y = sqrt(1 + b * b);
    return (a / x * atan(b / x) + b / y * atan(a / y)) / (2 * PI);
}

/* The integral over the image by its own pixels and angles, not across the poles. */
static double sky_light(void)
{
    enum { WIDTH = 24, HEIGHT = 14, FINER = 8, ACROSS = WIDTH * FINER, POINTS = ACROSS * HEIGHT * FINER };
    double sum = 0, low = 0.5 / HEIGHT;
    image sky;
    TEST(image_make_pattern(&sky, IMAGE_STUDIO, WIDTH, HEIGHT));
    for (int i = 0; i < POINTS; i++) {
        const double u = (i % ACROSS + 0.5) / ACROSS, longitude = 2 * PI * (u - 0.5 - 100.0 / 360);
        const double v = ((double)(i / ACROSS) + 0.5) / (HEIGHT * FINER), across = sin(PI * v);
        float rgb[3];
        image_bilinear(&sky, u, fmin(fmax(v, low), 1 - low), rgb);
        sum += PI * luminance(rgb) * fmax(across * sin(longitude), 0) * across / POINTS;
    }
    image_free(&sky);
    return sum;
}

/* A rough floor under a lamp so small that f is the same all over it. */
#define GLOSS                                                                                                 \
  "camera --from 0,1,1 --to 0,0,0 --depth 1\n" LAMP "material floor --shape --distribution ggx --alpha 0.5\n" \
  "rectangle --corner -2,0,2 --edge-u 4,0,0 --edge-v 0,0,-4 --material floor\n"                               \
  "sphere --centre 0.3,2,-2.5 --radius 0.01 --material lamp\n"

static double gloss_light(void)
{
    const vndf_description is = {.surface = vndf_rough(vndf_ggx(), 0.5f, 0.5f)};
    const vec3 lamp = vec(0.3, 2, -2.5), to = unit(lamp);
    vndf_material resolved;
    vndf_bsdf bsdf;
    float f[3];
    TEST(vndf_material_resolve(&is, &resolved, NULL) == VNDF_OK);
    vndf_bsdf_at(&bsdf, &resolved, (vndf_vec3){0.0f, -(float)sqrt(0.5), (float)sqrt(0.5)});
    vndf_bsdf_eval(&bsdf, (vndf_vec3){(float)to.x, -(float)to.z, (float)to.y}, 0, f);
    return 8 * (double)f[0] * to.y * PI * 1e-4 / dot(lamp, lamp);
}

static void test_known(void)
{
    const double aside = 0.5 * 8 * 0.25 * 0.25 / 25 * (3 / 5.0), panel = 0.5 * 8 * 4 * corner_factor(0.5, 0.25);
    const struct {
        const char *text;
        int is_point;
        double want;
    } known[] = {
        {DOME BALL("--matte 1,1,1"), 0, 1},
        {ROOM BALL("--matte 1,1,1"), 0, 1},
        {DOME BALL("--shape --distribution ggx --alpha 0.8 --scattering multiple"), 0, 1},
        {ROOM BALL("--shape --distribution beckmann --alpha 0.2,0.9 --scattering multiple"), 0, 1},
        {DOME BALL("--dielectric 1.5 --distribution ggx --alpha 0.4 --scattering multiple"), 0, 1},
        {ROOM BALL("--dielectric 1.5 --distribution ggx --alpha 0.4 --scattering multiple"), 0, 1},
        {FLOOR "sphere --centre 0,2,0 --radius 0.25 --material lamp\n", 1, 0.5 * 8 * 0.25 * 0.25 / (2 * 2)},
        /* the panel hides one of three */
        {FLOOR "sphere --centre 0,2.2,0 --radius 0.1 --material lamp\n" ASIDE PANEL, 1, panel + aside},
        {FLOOR PANEL "rectangle --corner -1,1.999999,-0.5 --edge-u 1,0,0 --edge-v 0,0,1 --material floor\n", 1,
         panel / 2},
        /* shines up */
        {FLOOR "rectangle --corner -1,2,0.5 --edge-u 2,0,0 --edge-v 0,0,-1 --material lamp\n" ASIDE, 1, aside},
        /* all is inside, where it does not shine */
        {FLOOR "sphere --centre 0,0,0 --radius 40 --material lamp\n", 1, 0},
        {GLOSS, 1, gloss_light()},
        {SKY, 1, 0.5 * 8 * 0.0025 / 6.25 * 0.8 + sky_light()},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        look(known[i].text, known[i].is_point, SAMPLER_VISIBLE, test_amount(128, 512, 512),
             (light){.value = known[i].want});
}

/* ---- samplers ---- */

/* Walks have no sampler by all normals. */
static void test_samplers(void)
{
    static const char *const kinds[] = {"--conductor gold --distribution ggx --alpha 0.1",
                                        "--dielectric 1.5 --distribution beckmann --alpha 0.05,0.4",
                                        "--dielectric 1 --distribution ggx --alpha 0.3",
                                        "--dielectric 1.3 --distribution ggx --alpha 0.4 --scattering multiple",
                                        "--shape --distribution ggx --alpha 0.5"};
    light is[SAMPLERS];
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "camera --from 0,0.25,3 --to 0,0,0\nenvironment --image studio:64,32\n"
                 "material m %s\nmaterial floor --matte 0.5,0.5,0.5\n"
                 "rectangle --corner -3,0,3 --edge-u 6,0,0 --edge-v 0,0,-6 --material m\n"
                 "rectangle --corner -3,-0.5,3 --edge-u 6,0,0 --edge-v 0,0,-6 --material m\n"
                 "rectangle --corner -9,-1,9 --edge-u 18,0,0 --edge-v 0,0,-18 --material floor\n",
                 kinds[k]);
        is[0] = (light){0, HUGE_VAL, 0};
        for (path_sampler i = 0; i < SAMPLERS; i++)
            if (i != SAMPLER_ALL || !strstr(text, "multiple"))
                is[i] = look(text, 1, i,
                             i == SAMPLER_PERFECT ? test_amount(16, 32, 256) : test_amount(64, 128, 256), is[0]);
    }
    TEST(is[SAMPLER_PERFECT].variance < is[SAMPLER_VISIBLE].variance &&
         is[SAMPLER_VISIBLE].variance < is[SAMPLER_ALL].variance);
}

int main(void)
{
    test_samplers();
    test_known();
    return test_done();
}
