/* All normals, not only the visible ones: B. Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007, eq. 28 and 35. The density is D(wm) cos(theta_m), a radial law and an azimuth. No draw
 * reads wi.
 *
 * The radial law is a CDF, so that it serves any D. At the scale where the median slope is 1, y = sin^2(theta_m)
 * has the density pi D(y) in [0, 1]. The CDF has cells of equal mass with a constant D in each, so that the
 * density told is the density drawn and a coarse table only costs variance. Roughness stretches. */
#include <stdlib.h>

#include "evidence/methods/vector.h"

enum { CELLS = 1024, FINE = 1 << 15 };

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

method method_all_normals(const method_reference *reference)
{
    radial_cdf *t = malloc(sizeof *t);
    double *mass = t ? malloc((FINE + 1) * sizeof *mass) : NULL;
    method m = {.name = "all normals (2007)",
                .instructions = "scalar",
                .kind = ROW_PUBLISHED,
                .memory = sizeof *t,
                .state = t,
                .release = free,
                .turned = 1};
    if (mass) {
        t->scale = reference->scale;
        fill_cdf(t, mass, accumulate(reference, mass));
        m.each = each;
    }
    free(mass);
    return m;
}
