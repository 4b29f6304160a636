/* In a white furnace nothing is seen: light of 1 from everywhere onto surfaces that lose none of it makes every
 * pixel 1, under a dome and in a room whose walls are lights. Notices light that paths lose or gain: by rays that
 * meet their own surface, by roulette, by weights of drawn light, at shading normals. */
#include "render_case.h"

static const char *const all[] = {
    "material m matte colour 1 1 1\n",
    "material m shape distribution ggx alpha 0.8 scattering multiple\n",
    "material m shape distribution beckmann alpha 0.2 0.9 scattering multiple\n",
    "material m dielectric index 1.5 distribution ggx alpha 0.4 scattering multiple\n",
};

#define DOME "environment constant 1 1 1\n"
/* Six rectangles that shine inwards: their light is drawn. */
#define ROOM                                                              \
  "material wall light radiance 1 1 1\n"                                  \
  "rectangle corner -6 -6 -6 edge-u 0 0 12 edge-v 12 0 0 material wall\n" \
  "rectangle corner -6 6 -6 edge-u 12 0 0 edge-v 0 0 12 material wall\n"  \
  "rectangle corner -6 -6 -6 edge-u 0 12 0 edge-v 0 0 12 material wall\n" \
  "rectangle corner 6 -6 -6 edge-u 0 0 12 edge-v 0 12 0 material wall\n"  \
  "rectangle corner -6 -6 -6 edge-u 12 0 0 edge-v 0 12 0 material wall\n" \
  "rectangle corner -6 -6 6 edge-u 0 12 0 edge-v 12 0 0 material wall\n"

/* In a dome every sample is 1; in a room it is, on average. */
static void test_material(const char *kind, const char *lit, double most)
{
    char text[2048];
    snprintf(text, sizeof text,
             "film width 24 height 24\ncamera from 0 0 5 to 0 0 0 field 24\nintegrator depth 10000\n%s%s"
             "sphere centre 0 0 0 radius 1 material m\n",
             lit, kind);
    scene *s = case_scene(text);
    film f = {.sum = NULL};
    double worst = 0;
    if (!s)
        return;
    case_render(&f, s, SAMPLER_VISIBLE, test_amount(16, 64, 64), 1);
    for (size_t i = 0; i < film_pixels(&f); i++)
        worst = fmax(worst, fabs(film_light(&f, i) - 1));
    if (!(TEST(worst < most) & case_agrees(case_mean_of(&f), 1, 2e-4)))
        fprintf(stderr, "    %s%s    worst %g\n", lit, kind, worst);
    film_free(&f);
    scene_free(s);
}

int main(void)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        test_material(all[i], DOME, 2e-3);
        test_material(all[i], ROOM, 0.5);
    }
    return test_done();
}
