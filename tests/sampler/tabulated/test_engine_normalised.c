/* The integral of vndf_pdf over the sphere is 1 within 1e-6, whatever the distribution, size of the table,
 * roughness and direction.
 *
 * pdf is piecewise smooth in stretched slopes in polar form. The panels of the quadrature end at the cells of
 * the table, read from its memory, and where normals turn away: any other panels would give the same integral,
 * of many more points. */
#include "oracle/oracle_validate.h"
#include "sampler/tabulated/wedge.h"
#include "harness/constants.h"
#include "harness/test.h"

static const double ANGLES[] = {0, 20, 45, 60, 75, 85, 89, 89.9, 90, 91, 100, 115, 130};

/* Gauss-Legendre with four points on [0, 1], in one to six equal parts of a panel: more for coarse tables, whose
 * cells are steep. */
static const double NODE[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263};
static const double WEIGHT[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                 0.17392742256872693};

/* One view, its direction once more in double, and the sum. */
typedef struct integral {
    const vndf_distribution *table;
    vndf_surface surface;
    vndf_view view;
    double s, c, cos_phi, sin_phi, sum;
    int parts;
    unsigned long count;
} integral;

static int points(const integral *g)
{
    return 4 * g->parts;
}

static double node(const integral *g, int i)
{
    return (i / 4 + NODE[i % 4]) / g->parts;
}

static double weight_of(const integral *g, int i)
{
    return WEIGHT[i % 4] / g->parts;
}

static double pdf_per_slope(const integral *g, double r, double cos_a, double sin_a)
{
    double ax = g->surface.alpha_x, ay = g->surface.alpha_y;
    double x = ax * r * (g->cos_phi * cos_a - g->sin_phi * sin_a),
           y = ay * r * (g->sin_phi * cos_a + g->cos_phi * sin_a);
    double z = 1 / sqrt(1 + x * x + y * y);
    vndf_vec3 wm = {(float)(x * z), (float)(y * z), (float)z};
    return vndf_pdf(&g->view, wm) * ax * ay * z * z * z;
}

/* Slopes r0 to r1 <= infinity, in the variable in which r/(scale + r) is linear. */
static void add_panel(integral *g, double cos_a, double sin_a, double weight, double r0, double r1)
{
    double scale = g->table->scale, x0 = r0 / (scale + r0), x1 = isinf(r1) ? 1 : r1 / (scale + r1);
    double z0 = scale / (scale + r0), z1 = isinf(r1) ? 0 : scale / (scale + r1);
    for (int i = 0; i < points(g); i++) {
        double x = x0 + (x1 - x0) * node(g, i), z = z0 + (z1 - z0) * node(g, i), r = scale * x / z;
        double dr = scale * (x1 * z0 - x0 * z1) / (z * z);
        g->sum += pdf_per_slope(g, r, cos_a, sin_a) * r * dr * weight * weight_of(g, i);
    }
}

/* Of a knot, unrounded: a jump of D may stand there. */
static double slope_of(const integral *g, uint32_t j)
{
    double x = g->table->knots.at[j].x, z = g->table->knots.at[j].z;
    return z > 0 ? x / z * g->table->scale : INFINITY;
}

static void add_azimuth(integral *g, double a, double weight)
{
    double cos_a = cos(a), sin_a = g->count++ % 2 ? sin(a) : -sin(a), k = g->s * cos_a,
           cut = g->c * k < 0 ? -g->c / k : 0;
    for (uint32_t j = 0; j < g->table->radial_count; j++) {
        double r0 = slope_of(g, j), r1 = slope_of(g, j + 1);
        if (g->c > 0 && k < 0)
            r1 = fmin(r1, cut);
        else if (g->c <= 0)
            r0 = fmax(r0, cut);
        if (r0 < r1)
            add_panel(g, cos_a, sin_a, weight, r0, r1);
    }
}

/* A quarter turn between nodes q: tan a = 2 r q/(p (1 - q^2)), the azimuths where the density has its kinks. */
static void add_quarter(integral *g, const float *q, uint32_t cells, double p, double r, int away)
{
    for (uint32_t j = 0; j < cells; j++)
        for (int i = 0; i < points(g); i++) {
            double q0 = q[j], width = q[j + 1] - q0, at = q0 + width * node(g, i);
            double x = p * (1 - at * at), y = 2 * r * at, a = atan2(y, x);
            double da = 2 * p * r * (1 + at * at) / (x * x + y * y) * width;
            add_azimuth(g, away ? PI - a : a, 2 * da * weight_of(g, i));
        }
}

/* The side of wi, where the density is that of c + s cos a: even panels. */
static void add_front(integral *g)
{
    enum { PANELS = 32 };
    for (int i = 0; i < PANELS * 4; i++)
        add_azimuth(g, PI / 2 * (i / 4 + NODE[i % 4]) / PANELS, PI / PANELS * WEIGHT[i % 4]);
}

static double mass_of(const vndf_surface *surface, vndf_vec3 wi)
{
    integral g = {surface->distribution, *surface, vndf_view_from(surface, wi), 0, 0, 1, 0, 0, 1, 0};
    double x = surface->alpha_x * wi.x, y = surface->alpha_y * wi.y;
    const vndf_wedge *side = vndf_wedge_of(g.table, (double)wi.z);
    vndf_azimuth_row row = vndf_wedge_row(side, (float)vndf_wedge_y(g.view.of.table.s, g.view.of.table.c));
    g.parts = g.table->radial_count < 16    ? 24
              : g.table->radial_count < 64  ? 6
              : g.table->radial_count < 128 ? 2
                                            : 1;
    g.s = hypot(x, y);
    g.c = wi.z;
    if (g.s > 0) {
        g.cos_phi = x / g.s;
        g.sin_phi = y / g.s;
    }
    if (wi.z >= 0)
        add_front(&g);
    if (wi.z < 0 || row.p > 0)
        add_quarter(&g, side->q, side->cell_count, row.p, row.r, wi.z >= 0);
    return g.sum;
}

/* Below the horizon only where the area is one that the certificate speaks of. */
static void test_surface(const oracle *o, const vndf_surface *surface, double phi, size_t first)
{
    double grazing = oracle_surface_area(o, surface, oracle_direction(90, phi));
    for (size_t i = first; i < sizeof ANGLES / sizeof *ANGLES; i += test_amount(4, 3, 1)) {
        vndf_vec3 wi = oracle_direction(ANGLES[i], phi);
        if (!(oracle_surface_area(o, surface, wi) > 1e-10 * grazing))
            continue;
        if (!TEST_NEAR(mass_of(surface, wi), 1, 1e-6))
            fprintf(stderr, "  %s, %lu bytes, alpha %g %g, theta %g\n", oracle_name(o),
                    (unsigned long)vndf_distribution_info(surface->distribution).bytes, surface->alpha_x,
                    surface->alpha_y, ANGLES[i]);
    }
}

static void test_size(const oracle *o, size_t bytes, size_t first)
{
    vndf_distribution *table = oracle_build(o, bytes, NULL);
    vndf_surface even = {table, 1.0f, 1.0f}, stretched = {table, 0.05f, 0.4f};
    if (TEST(table != NULL)) {
        test_surface(o, &even, 0, first);
        test_surface(o, &stretched, 33, first);
    }
    vndf_free(table);
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < ORACLE_COUNT; i++) {
        oracle o = oracle_get(i);
        if (!oracle_wanted(arguments, argument, i, oracle_name(&o)))
            continue;
        test_size(&o, 2048, test_amount(0, i % 3, 0));
        test_size(&o, 0, test_amount(0, (i + 1) % 3, 0));
    }
    return test_done();
}
