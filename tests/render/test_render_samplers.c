/* All samplers show the same, of metals and glass, smooth and rough, also through refraction and walks; perfect
 * sampling has no more variance than visible normals, which have less than all normals at a grazing angle. Notices
 * candidates that are not kept in proportion to their weight, factors of refraction that are lost, and a sampler
 * that is not used. */
#include "render_case.h"

static void test_scene(const char *kind, int has_all, double order[3])
{
    char text[2048];
    snprintf(text, sizeof text,
             "camera from 0 0.25 3 to 0 0 0\nimage sky pattern studio width 64 height 32\nenvironment image sky\n"
             "material m %s\nmaterial floor matte colour 0.5 0.5 0.5\n"
             "rectangle corner -3 0 3 edge-u 6 0 0 edge-v 0 0 -6 material m\n"
             "rectangle corner -3 -0.5 3 edge-u 6 0 0 edge-v 0 0 -6 material m\n"
             "rectangle corner -9 -1 9 edge-u 18 0 0 edge-v 0 0 -18 material floor\n",
             kind);
    scene *s = case_point(text);
    for (int i = 0; i < SAMPLERS && s; i++) {
        const case_mean mean = case_light(s, i == SAMPLER_ALL && !has_all ? SAMPLER_VISIBLE : (path_sampler)i,
                                          test_amount(64, 256, 256));
        static case_mean visible;
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
    double variance[3];
    test_scene("conductor of gold distribution ggx alpha 0.1", 1, variance);
    test_scene("dielectric index 1.5 distribution ggx alpha 0.3", 1, variance);
    test_scene("dielectric index 1.5 distribution beckmann alpha 0.05 0.4", 1, variance);
    test_scene("dielectric index 1 distribution ggx alpha 0.3", 1, variance);
    test_scene("dielectric index 1.3 distribution ggx alpha 0.4 scattering multiple", 0, variance);
    test_scene("shape distribution ggx alpha 0.5", 1, variance);
    TEST(variance[SAMPLER_PERFECT] < variance[SAMPLER_VISIBLE] &&
         variance[SAMPLER_VISIBLE] < variance[SAMPLER_ALL]);
    return test_done();
}
