/* What is drawn from lights has the density that it says: lights_density and environment_density of the direction
 * are the density of the sample, and the mean of one over it is the solid angle that the lights fill; directions
 * come back from the pixels of an image as often as the image is bright there. Notices sums over pixels that are
 * off by one, a wrong angle of rows near the poles, a turn in the other sense, and choices that forget a light. */
#include "render/light.h"
#include "render_case.h"

enum { WIDTH = 24, HEIGHT = 14, SAMPLES = 200000 };

static const char text[] = "camera from 0 0 5 to 0 0 0\nimage sky pattern studio width 24 height 14\n"
                           "environment image sky turn 40\nmaterial lamp light radiance 1 2 3\n"
                           "sphere centre 0 3 0 radius 1 material lamp\n"
                           "rectangle corner -1 2 -3 edge-u 2 0 0 edge-v 0 0 1 material lamp\n";

static void test_densities(scene *s)
{
    const vec3 place = {0.3, 0.1, -0.2};
    unsigned long long state = 5;
    double inverse = 0, worst = 0;
    for (int i = 0; i < SAMPLES; i++) {
        double u[3];
        light_sample l;
        hit h;
        for (int k = 0; k < 3; k++)
            u[k] = test_uniform_double(&state);
        if (!lights_draw(s, place, u, &l))
            continue;
        const ray r = {place, l.direction, HUGE_VAL};
        const int is_met = geometry_hit(&s->geometry, &r, &h);
        if (isfinite(l.distance) && TEST(is_met))
            worst = fmax(worst, fabs(lights_density(s, place, l.direction, &h) / l.density - 1));
        else if (!isfinite(l.distance))
            worst = fmax(worst, fabs(environment_density(s, place, l.direction) / l.density - 1));
        inverse += isfinite(l.distance) ? 0 : 1 / l.density;
    }
    TEST(worst < 1e-5);
    TEST_RELATIVE(inverse / SAMPLES, 4 * PI, 0.02);
}

/* Bins are pixels; at a border between them a direction may fall on the other side. */
static void test_pixels(scene *s)
{
    double expected[WIDTH * HEIGHT] = {0}, found[WIDTH * HEIGHT] = {0}, all = 0;
    const environment *e = &s->environment;
    unsigned long long state = 9;
    s->light_count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const double longitude = 2 * PI * ((x + 0.5) / WIDTH - 0.5 - 40.0 / 360);
        const double theta = PI * (y + 0.5) / HEIGHT, angle = cos(PI * y / HEIGHT) - cos(PI * (y + 1) / HEIGHT);
        const vec3 w = {sin(theta) * sin(longitude), cos(theta), -sin(theta) * cos(longitude)};
        float rgb[3];
        environment_radiance(e, w, rgb);
        TEST_RELATIVE((double)rgb[1], (double)image_pixel(e->map, x, y)[1], 1e-4);
        expected[i] = SAMPLES * environment_density(s, vec(0, 0, 0), w) * angle * 2 * PI / WIDTH;
        all += expected[i];
    }
    TEST_NEAR(all / SAMPLES, 1, 1e-5);
    for (int i = 0; i < SAMPLES; i++) {
        light_sample l;
        const double u[3] = {test_uniform_double(&state), test_uniform_double(&state),
                             test_uniform_double(&state)};
        if (!TEST(lights_draw(s, vec(0, 0, 0), u, &l)))
            continue;
        const double turns = 0.5 + atan2(l.direction.x, -l.direction.z) / (2 * PI) + 40.0 / 360;
        const int x = (int)((turns - floor(turns)) * WIDTH), y = (int)(acos(l.direction.y) / PI * HEIGHT);
        found[y * WIDTH + x]++;
    }
    double chi = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        chi += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    TEST(chi < WIDTH * HEIGHT + 5 * sqrt(2.0 * WIDTH * HEIGHT)); /* level 1e-6 */
}

int main(void)
{
    scene *s = case_scene(text);
    if (s && TEST(s->environment.rows != NULL)) {
        test_densities(s);
        test_pixels(s);
    }
    scene_free(s);
    return test_done();
}
