/* A rough metal under lights shows the integral of f cos over them, from narrow lobes and small lights to wide
 * ones, for all samplers: light that is drawn and light that is met share it. The integral is a sum over points of
 * the light with vndf_bsdf_eval, which shares no code with paths. Notices a wrong density of either kind, shares
 * that do not add up to 1, a cosine too many, and samplers that show something else. */
#include "render_case.h"

enum { SIDE = 400 };

/* Seen from (0, 1, 1) towards the origin, a point of the plane y = 0 whose u goes along x. */
static double integral(float alpha, vec3 corner, vec3 u, vec3 v)
{
    const vndf_description is = {.distribution = vndf_ggx(), .alpha_x = alpha, .alpha_y = alpha};
    const vec3 n = cross(u, v);
    vndf_material resolved;
    vndf_bsdf bsdf;
    double sum = 0;
    if (!TEST(vndf_material_resolve(&is, &resolved, NULL) == VNDF_OK))
        return 0;
    vndf_bsdf_at(&bsdf, &resolved, (vndf_vec3){0.0f, -(float)sqrt(0.5), (float)sqrt(0.5)});
    for (int i = 0; i < SIDE * SIDE; i++) {
        const vec3 p = along(along(corner, (i % SIDE + 0.5) / SIDE, u), ((double)(i / SIDE) + 0.5) / SIDE, v);
        const vec3 w = unit(p);
        float f[3];
        vndf_bsdf_eval(&bsdf, (vndf_vec3){(float)w.x, -(float)w.z, (float)w.y}, 0, f);
        sum += (double)f[0] * w.y * -dot(w, n) / dot(p, p); /* n is the area, too */
    }
    return sum / (SIDE * SIDE);
}

static void test_light(double alpha, double size)
{
    char text[2048];
    snprintf(text, sizeof text,
             "camera from 0 1 1 to 0 0 0\nintegrator depth 1\nmaterial lamp light radiance 3 3 3\n"
             "material floor shape distribution ggx alpha %g\n"
             "rectangle corner -2 0 2 edge-u 4 0 0 edge-v 0 0 -4 material floor\n"
             "rectangle corner %g 2 %g edge-u %g 0 0 edge-v 0 0 %g material lamp\n",
             alpha, -0.3 * size, -2 - 0.5 * size, size, size);
    const double want =
        3 * integral((float)alpha, vec(-0.3 * size, 2, -2 - 0.5 * size), vec(size, 0, 0), vec(0, 0, size));
    scene *s = case_point(text);
    for (int sampler = 0; sampler < SAMPLERS && s; sampler++)
        if (!case_agrees(case_light(s, (path_sampler)sampler, test_amount(64, 512, 512)), want, 1e-3))
            fprintf(stderr, "    alpha %g, size %g, %s\n", alpha, size, path_sampler_names[sampler]);
    scene_free(s);
}

int main(void)
{
    static const double alphas[] = {0.02, 0.1, 0.4, 1}, sizes[] = {0.05, 0.5, 3};
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 3; k++)
            test_light(alphas[i], sizes[k]);
    return test_done();
}
