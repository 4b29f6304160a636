/* The oracle of a table is itself right: its density integrates to 1 over the sphere of normals from above and
 * below the horizon, whatever the table's size; its D integrates to 1 with the cosine, and with max(0, wi.wm) to
 * its area. The first is exact by construction of every cell, so the bound is that of the quadrature here; the
 * others hold as far as the moments are floats and the area's spline is that of the cells: twice the
 * certificate's area_error, but for the disc, whose four cells do not know its edge as well as the spline does. */
#include "oracle/oracle.h"
#include "oracle/oracle_float.h"
#include "harness/constants.h"
#include "harness/test.h"

/* Gauss-Legendre, eight points; and panels of a cell, narrow at its ends, where rational densities bend. */
static const double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
static const double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
static const double panel[] = {0, 0x1p-10, 0x1p-5, 0.25, 0.75, 1 - 0x1p-5, 1 - 0x1p-10, 1};

enum { POINTS = 8, PANELS = sizeof panel / sizeof *panel - 1 };

/* The i-th of all points in [from, to], and the length that it stands for. */
static double place_in(double from, double to, int i, double *part)
{
    int p = i / POINTS % PANELS, n = i % POINTS;
    double half = (panel[p + 1] - panel[p]) / 2, at = n < 4 ? -node[n] : node[n - 4];
    *part = (to - from) * half * weight[n % 4];
    return from + (to - from) * (panel[p] + half + half * at);
}

/* One view at alpha times scale = 1, wi in the plane of x, and an azimuth. */
typedef struct line {
    const oracle_table *t;
    oracle_query q;
    double cosine, sine, k;
} line;

/* What is integrated over slopes: the density, D cos, D wi.wm. */
typedef enum integrand { DENSITY, NORMALS, AREA } integrand;

static double value_at(line *l, integrand what, double x, double z)
{
    double value[ORACLE_SIDES], length = hypot(x, z), seen = l->q.wi[2] * z + l->k * x;
    l->q.wm[0] = x * l->cosine;
    l->q.wm[1] = x * l->sine;
    l->q.wm[2] = z;
    if (what != NORMALS && !(seen > 0))
        return 0;
    if (what == DENSITY)
        oracle_table_densities(l->t, &l->q, value);
    else
        oracle_table_ndfs(l->t, &l->q, value);
    return value[0] * (what == DENSITY ? 1 : (what == NORMALS ? z : seen) / length);
}

/* Over a cell, or a part of one up to the cut; dw = cos^3 R dR da, dR = width/Z^2 dxi for X and Z linear in xi. */
static double part_of(line *l, integrand what, double x0, double z0, double x1, double z1)
{
    double sum = 0, part;
    for (int i = 0; i < PANELS * POINTS; i++) {
        double xi = place_in(0, 1, i, &part), x = x0 + xi * (x1 - x0), z = z0 + xi * (z1 - z0);
        double length = hypot(x, z);
        sum += value_at(l, what, x, z) * part * (x1 * z0 - x0 * z1) * x / (length * length * length);
    }
    return sum;
}

/* Over all slopes of the azimuth a. */
static double azimuth_of(line *l, integrand what, double a)
{
    const oracle_table *t = l->t;
    double sum = 0;
    l->cosine = cos(a);
    l->sine = sin(a);
    l->k = l->q.wi[0] * l->cosine;
    for (size_t j = 0; j < t->count; j++) {
        double w0 = l->q.wi[2] * t->z[j] + l->k * t->x[j], w1 = l->q.wi[2] * t->z[j + 1] + l->k * t->x[j + 1];
        double x = (t->x[j] * w1 - t->x[j + 1] * w0) / (w1 - w0);
        double z = (t->z[j] * w1 - t->z[j + 1] * w0) / (w1 - w0);
        int cut = w0 * w1 < 0;
        sum += part_of(l, what, t->x[j], t->z[j], cut ? x : t->x[j + 1], cut ? z : t->z[j + 1]);
        if (cut)
            sum += part_of(l, what, x, z, t->x[j + 1], t->z[j + 1]);
    }
    return sum;
}

/* A quarter turn of the density on cells q: tan a = 2 r q/(p (1 - q^2)); both halves of the turn are alike. */
static double quarter_of(line *l, const double *q, size_t cells, double p, double r, int away)
{
    double sum = 0, part;
    for (size_t j = 0; j < cells; j++)
        for (int i = 0; i < PANELS * POINTS; i++) {
            double at = place_in(q[j], q[j + 1], i, &part), x = p * (1 - at * at), y = 2 * r * at, a = atan2(y, x);
            double da = 2 * p * r * (1 + at * at) / (x * x + y * y) * part;
            sum += 2 * da * azimuth_of(l, DENSITY, away ? PI - a : a);
        }
    return sum;
}

/* A turn of what is smooth in the azimuth but at the ends of quarters. */
static double turn_of(line *l, integrand what)
{
    double sum = 0, part;
    for (int i = 0; i < 2 * PANELS * POINTS; i++) {
        double from = i < PANELS * POINTS ? 0 : PI / 2, a = place_in(from, from + PI / 2, i, &part);
        sum += 2 * part * azimuth_of(l, what, a);
    }
    return sum;
}

/* A wedge at y, with its aspect. */
static double wedge_of(line *l, const oracle_wedge *w, double y, int away)
{
    size_t i = 0;
    double p = 0, r = 0;
    while (i + 2 < (w->rows + 1) / 2 && w->row_y[i + 1] <= y)
        i++;
    double m = (y - w->row_y[i]) / (w->row_y[i + 1] - w->row_y[i]);
    double share[3] = {(1 - m) * (1 - m), 2 * m * (1 - m), m * m};
    for (size_t n = 0; n < 3; n++) {
        p += share[n] * w->aspect_p[2 * i + n];
        r += share[n] * w->aspect_r[2 * i + n];
    }
    return quarter_of(l, w->q, w->cells, p, r, away);
}

static void test_view(const float_subject *subject, double degrees)
{
    const oracle_table *t = &subject->reference;
    double s = sin(degrees * PI / 180), c = cos(degrees * PI / 180), q[21];
    line l = {t, {{s, 0, c}, {1 / t->scale, 1 / t->scale}, {0, 0, 1}}, 1, 0, 0};
    for (int i = 0; i <= 20; i++)
        q[i] = i < 20 ? tan(PI / 4 * i / 20 * (1.5 - 0.5 * i / 20)) : 1;
    double density = wedge_of(&l, c > 0 ? &t->above : &t->below, c > 0 ? c / (s + c) : s / (s - c), c > 0);
    if (c > 0)
        density += quarter_of(&l, q, 20, 1, 1, 0);
    double near = 2e-6 + 2 * (double)vndf_distribution_info(subject->table).certificate.area_error;
    int good = TEST_NEAR(density, 1, 1e-9) & TEST_NEAR(turn_of(&l, NORMALS), 1, 1e-6);
    if (strcmp(subject->name, "disc.vndf") != 0)
        good &= TEST_RELATIVE(turn_of(&l, AREA), oracle_table_area(t, &l.q), near);
    if (!good)
        fprintf(stderr, "  %s at %g degrees\n", subject->name, degrees);
}

int main(void)
{
    static const char *const names[] = {"student-t-2.5-small.vndf", "disc.vndf", "exponential.vndf"};
    static const double angles[] = {130, 60, 100, 85};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        float_subject subject;
        if (!TEST(float_subject_open(&subject, names[i], "")))
            continue;
        for (size_t j = 0; j < (test_quick() ? 1 : sizeof angles / sizeof *angles); j++)
            test_view(&subject, angles[j]);
        float_subject_close(&subject);
    }
    return test_done();
}
