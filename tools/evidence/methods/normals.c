/* All normals, not only the visible ones: B. Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007, eq. 28 and 35. The density is D(wm) cos(theta_m), a radial law and an azimuth. GGX
 * (tan^2 = alpha^2 u/(1-u)) and Beckmann (tan^2 = -alpha^2 log(1-u)) have closed forms. No draw reads wi.
 *
 * Any other D has a radial CDF. At the scale where the median slope is 1, y = sin^2(theta_m) has the density pi
 * D(y) in [0, 1]. The CDF has cells of equal mass with a constant D in each, so that the density told is the
 * density drawn and a coarse table only costs variance. Roughness stretches. */
#include <stdlib.h>
#include <string.h>

#include "evidence/methods/vector.h"

/* The normal for slope^2 over alpha^2, the density of slopes there times pi alpha^2, and an azimuth. */
static inline vndf_vec3 normal_from(float slope2, float p22, float alpha, float u1, float *pdf)
{
    float phi = 2 * method_pi * u1, z2 = 1.0f / (1.0f + alpha * alpha * slope2), z = sqrtf(z2);
    float across = alpha * sqrtf(slope2) * z;
    *pdf = p22 / (method_pi * alpha * alpha * z2 * z);
    return (vndf_vec3){across * cosf(phi), across * sinf(phi), z};
}

static inline vndf_vec3 draw_ggx(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    float rest = 1.0f - in->u[1];
    return normal_from(in->u[1] / rest, rest * rest, in->alpha, in->u[0], pdf);
}

static inline vndf_vec3 draw_beckmann(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    float rest = 1.0f - in->u[1];
    return normal_from(-logf(rest), rest, in->alpha, in->u[0], pdf);
}

/* ---- any D ------------------------------------------------------------------------------------- */

enum { CELLS = 1024, FINE = 1 << 15 };

typedef struct radial_cdf {
    float y[CELLS + 1]; /* sin^2(theta_m) at masses j/CELLS */
    float scale;
} radial_cdf;

static inline vndf_vec3 draw_any(const method *m, const method_input *in, float *pdf)
{
    const radial_cdf *t = m->state;
    float place = in->u[1] * CELLS, width;
    int j = (int)place;
    j = j < CELLS ? j : CELLS - 1;
    width = t->y[j + 1] - t->y[j];
    float y = fminf(t->y[j] + (place - (float)j) * width, 1 - 0x1p-24f), z2 = 1.0f - y;
    return normal_from(y / z2, z2 * z2 / ((float)CELLS * width), in->alpha * t->scale, in->u[0], pdf);
}

static double ndf_at(const method_reference *reference, double y)
{
    vndf_vec3 wm = {(float)sqrt(y), 0, (float)sqrt(1 - y)};
    return (double)vndf_ndf(&reference->canonical, wm);
}

/* Edges for the midpoint rule in v with y = v^2 (3 - 2 v): finer at both ends, where peaks and tails are. */
static double edge_of(int i)
{
    double v = (double)i / FINE;
    return v * v * (3 - 2 * v);
}

/* Fills mass[i], the mass up to edge i. Returns the first edge with all of the mass: where D ends or vanishes,
 * or the horizon. */
static int accumulate(const method_reference *reference, double *mass)
{
    int top = FINE;
    mass[0] = 0;
    for (int i = 0; i < FINE; i++) {
        double low = edge_of(i), high = edge_of(i + 1);
        mass[i + 1] = mass[i] + ndf_at(reference, 0.5 * (low + high)) * (high - low);
    }
    while (mass[top - 1] >= mass[FINE])
        top--;
    return top;
}

static void fill_cdf(radial_cdf *t, const double *mass, int top)
{
    int cell = 1;
    for (int i = 0; i < top; i++)
        for (; cell < CELLS && mass[i + 1] * CELLS >= mass[FINE] * cell; cell++) {
            double part = (mass[FINE] * cell / CELLS - mass[i]) / (mass[i + 1] - mass[i]);
            t->y[cell] = (float)(edge_of(i) + part * (edge_of(i + 1) - edge_of(i)));
        }
    t->y[0] = 0;
    for (; cell <= CELLS; cell++)
        t->y[cell] = (float)edge_of(top);
}

/* ---- loops ------------------------------------------------------------------------------------- */

static void each_ggx(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw_ggx, m, b, first, count);
}

static void each_beckmann(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw_beckmann, m, b, first, count);
}

static void each_any(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw_any, m, b, first, count);
}

static method all_normals(method_one *one, method_run *each)
{
    return (method){.name = "all normals (2007)",
                    .instructions = "scalar",
                    .kind = ROW_PUBLISHED,
                    .one = one,
                    .each = each,
                    .turned = 1};
}

method method_ggx_all_normals(void)
{
    return all_normals(draw_ggx, each_ggx);
}

method method_beckmann_all_normals(void)
{
    return all_normals(draw_beckmann, each_beckmann);
}

method method_any_all_normals(const method_reference *reference)
{
    method m = all_normals(draw_any, NULL);
    memcpy(m.name, "all normals (2007), radial CDF", 31);
    m.memory = sizeof(radial_cdf);
    m.release = free;
    if (!reference)
        return m;
    radial_cdf *t = malloc(sizeof *t);
    double *mass = malloc((FINE + 1) * sizeof *mass);
    if (t && mass) {
        t->scale = reference->scale;
        fill_cdf(t, mass, accumulate(reference, mass));
        m.state = t;
        m.each = each_any;
    } else {
        free(t);
    }
    free(mass);
    return m;
}
