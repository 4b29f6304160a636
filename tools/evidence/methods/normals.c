/* All normals, not only the visible ones: B. Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007, eq. 28 and 35. The density is D(wm) cos(theta_m), a radial law and an azimuth. No draw
 * reads wi.
 *
 * The radial law is a CDF, so that it serves any D. At the scale where the median slope is 1, y = sin^2(theta_m)
 * has the density pi D(y) in [0, 1]. The CDF has cells of equal mass with a constant D in each, so that the
 * density told is the density drawn and a coarse table only costs variance. Roughness stretches. */
#include <stdlib.h>

#include "evidence/methods/vector.h"

enum { CELLS = 1024 };

typedef struct radial_cdf {
    float y[CELLS + 1]; /* sin^2(theta_m) at masses j/CELLS */
    float scale;
} radial_cdf;

static inline vndf_vec3 draw(const method *m, const method_input *in, float *pdf)
{
    const radial_cdf *t = m->state;
    float place = in->u[1] * CELLS, alpha = in->alpha * t->scale, phi = 2 * method_pi * in->u[0];
    int j = (int)place;
    j = j < CELLS ? j : CELLS - 1;
    float width = t->y[j + 1] - t->y[j], y = fminf(t->y[j] + (place - (float)j) * width, 1 - 0x1p-24f);
    float rest = 1.0f - y, slope = alpha * sqrtf(y / rest), z2 = 1.0f / (1.0f + slope * slope), z = sqrtf(z2);
    *pdf = rest * rest / ((float)CELLS * width) / (method_pi * alpha * alpha * z2 * z);
    return (vndf_vec3){slope * z * cosf(phi), slope * z * sinf(phi), z};
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw, m, b, first, count);
}

/* sin^2(theta_m) of the normal that a part `mass` of D cos(theta_m) lies within. From straight above all normals are
 * visible, and u2 is that part; but of Beckmann it moves one of two slopes. */
static double sine2_at(const method_reference *reference, double mass)
{
    const vndf_surface *surface = &reference->canonical;
    if (surface->distribution == vndf_beckmann())
        return 1 / (1 + 1 / (-log1p(-mass) * (double)surface->alpha_x * (double)surface->alpha_x));
    vndf_view view = vndf_view_from(surface, (vndf_vec3){0, 0, 1});
    vndf_vec3 wm = vndf_sample(&view, 0.5f, (float)mass, NULL);
    return (double)wm.x * (double)wm.x + (double)wm.y * (double)wm.y;
}

method method_all_normals(const method_reference *reference)
{
    radial_cdf *t = malloc(sizeof *t);
    for (int j = 0; t && j <= CELLS; j++)
        t->y[j] = (float)sine2_at(reference, (double)j / CELLS);
    if (t)
        t->scale = reference->scale;
    return (method){.name = "all normals (2007)",
                    .kind = ROW_PUBLISHED,
                    .memory = sizeof *t,
                    .state = t,
                    .release = free,
                    .each = t ? each : NULL,
                    .turned = 1};
}
