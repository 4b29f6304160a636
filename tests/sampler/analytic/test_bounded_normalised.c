/* The integral of vndf_pdf_bounded over all normals is 1 within 1e-5, for tables, GGX and Beckmann, even,
 * stretched and at any angle; and so the density is 0 below the horizon and what is kept is right to that, small
 * parts included.
 *
 * Coordinates are those in which the density has its edges along lines: where the disc of bounded.h begins and
 * ends on a line is found by bisection of the sign of wo.z, and quadrature goes between. */
#include "oracle/oracle.h"
#include "sampler/bounded/bounded.h"
#include "sampler/tabulated/wedge.h"
#include "harness/constants.h"
#include "harness/test.h"

/* Real slopes are A R (x, y): the stretched frame turned to the stretched wi. */
typedef struct subject {
    vndf_view view;
    vndf_bounds bounds;
    double ax, ay, s, c, cos_phi, sin_phi;
    double line; /* the first coordinate */
} subject;

static subject subject_of(const vndf_distribution *d, const float alpha[2], double cosine)
{
    vndf_surface surface = {d, alpha[0], alpha[1]};
    double sine = sqrt((1 - cosine) * (1 + cosine));
    vndf_vec3 wi = {(float)(0.8 * sine), (float)(-0.6 * sine), (float)cosine};
    subject g = {.view = vndf_view_from(&surface, wi)};
    vndf_bounds_of(&g.view, &g.bounds);
    g.ax = g.view.alpha_x;
    g.ay = g.view.alpha_y;
    double x = g.ax * wi.x, y = g.ay * wi.y, across = hypot(x, y), length = hypot(across, wi.z);
    g.s = across / length;
    g.c = wi.z / length;
    g.cos_phi = across > 0 ? x / across : 1;
    g.sin_phi = across > 0 ? y / across : 0;
    return g;
}

/* The stretched normal of one of the unit problem. */
static vndf_normal stretched(const subject *g, double x, double y, double z)
{
    vndf_normal m = {g->ax * (g->cos_phi * x - g->sin_phi * y), g->ay * (g->sin_phi * x + g->cos_phi * y), z};
    return m;
}

static int is_inside(const subject *g, vndf_normal m)
{
    vndf_vec3 wi = g->view.wi;
    double square = m.x * m.x + m.y * m.y + m.z * m.z;
    return m.z > 0 && 2 * (wi.x * m.x + wi.y * m.y + wi.z * m.z) * m.z > wi.z * square;
}

/* At m = A R n, n of any length: density per the volume element of n over that of its length, dwm = ax ay
 * dn/|m|^3. */
static double density(const subject *g, vndf_normal m)
{
    double length = sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
    vndf_normal wm = {m.x / length, m.y / length, m.z / length};
    return vndf_pdf_bounded(&g->view, &g->bounds, wm) * (g->ax * g->ay) / (length * length * length);
}

/* Where the normals at(t) on a line cross the border, from a place inside to one outside. */
typedef vndf_normal place_on(const subject *g, double t);

static double border(const subject *g, place_on *at, double inside, double outside)
{
    for (int i = 0; i < 80; i++) {
        double middle = 0.5 * (inside + outside);
        if (is_inside(g, at(g, middle)))
            inside = middle;
        else
            outside = middle;
    }
    return inside;
}

/* ---- GGX: azimuth about w, then the angle to it ---- */

static vndf_normal at_angle(const subject *g, double angle)
{
    double x = cos(g->line), y = sin(g->line), sine = sin(angle), cosine = cos(angle);
    return stretched(g, cosine * g->s - sine * g->c * x, sine * y, cosine * g->c + sine * g->s * x);
}

static double over_angle(double angle, const void *user)
{
    return density(user, at_angle(user, angle)) * sin(angle);
}

/* An angle of the line in the disc, where 2 (wi.M) M.z - wi.z |M|^2 of M = M0 + tan(angle) M1 is largest; below 0
 * if there is none. 0 where w itself is in it. */
static double angle_inside(const subject *g)
{
    double value[3];
    if (is_inside(g, at_angle(g, 0)))
        return 0;
    for (int i = 0; i < 3; i++) {
        double angle = atan(i - 1), length = 1 / cos(angle);
        vndf_normal m = at_angle(g, angle);
        vndf_vec3 wi = g->view.wi;
        double square = m.x * m.x + m.y * m.y + m.z * m.z;
        value[i] = length * length * (2 * (wi.x * m.x + wi.y * m.y + wi.z * m.z) * m.z - wi.z * square);
    }
    double top = atan((value[2] - value[0]) / 2 / (2 * value[1] - value[0] - value[2]));
    return top > 0 && is_inside(g, at_angle(g, top)) ? top : -1;
}

static double over_azimuth(double azimuth, const void *user)
{
    subject g = *(const subject *)user;
    g.line = azimuth;
    double inside = angle_inside(&g);
    if (inside < 0)
        return 0;
    double low = inside > 0 ? border(&g, at_angle, inside, 0) : 0, high = border(&g, at_angle, inside, PI / 2);
    return oracle_integrate(over_angle, &g, low, high);
}

/* The last azimuth, from one that meets the disc towards `far`, that does. */
static double tangent(subject g, double azimuth, double far)
{
    for (int i = 0; i < 60; i++) {
        g.line = 0.5 * (azimuth + far);
        if (angle_inside(&g) < 0)
            far = g.line;
        else
            azimuth = g.line;
    }
    return azimuth;
}

/* Panels end where the front does. */
static double integral_ggx(const subject *g)
{
    subject probe = *g;
    double sum = 0, quarter = PI / 2, from = -PI, to = PI;
    probe.line = 0;
    if (angle_inside(&probe) != 0) {
        for (probe.line = -PI; angle_inside(&probe) < 0; probe.line += 0.01)
            ;
        double met = probe.line;
        from = tangent(probe, met, met - 0.02);
        for (; angle_inside(&probe) >= 0; probe.line += 0.01)
            ;
        to = tangent(probe, probe.line - 0.01, probe.line);
        from += 1e-10 * (to - from); /* at the very ends chords are rounding, and density has no bound */
        to -= 1e-10 * (to - from);
    }
    for (int i = -16; i < 24; i++) {
        double a = fmax(from, quarter * i / 8), b = fmin(to, quarter * (i + 1) / 8);
        sum += a < b ? oracle_integrate(over_azimuth, g, a, b) : 0;
    }
    return sum;
}

/* ---- Beckmann: the slope along wi, then that across ---- */

static vndf_normal at_slope(const subject *g, double y)
{
    return stretched(g, -g->line, -y, 1);
}

static double over_across(double y, const void *user)
{
    return density(user, at_slope(user, y));
}

/* Of a conic a chord's middle is where its ends are as far: with the quadratic form of real slopes. */
static double over_along(double x, const void *user)
{
    subject g = *(const subject *)user;
    vndf_normal along = stretched(&g, 1, 0, 0), across = stretched(&g, 0, 1, 0);
    double form = across.x * across.x + across.y * across.y;
    double middle = -x * (along.x * across.x + along.y * across.y) / form;
    g.line = x;
    if (!is_inside(&g, at_slope(&g, middle)))
        return 0;
    double high = border(&g, at_slope, middle, middle + 2 / sqrt(form) / g.view.wi.z), low = 2 * middle - high;
    high = high < 8 ? high : 8;
    low = low > -8 ? low : -8;
    return high > low ? oracle_integrate(over_across, &g, low, high) : 0;
}

/* The ends of the disc along x, where the middle of the chord leaves it. */
static double end_of(const subject *g, double far)
{
    double inside = 0, outside = far;
    vndf_normal along = stretched(g, 1, 0, 0), across = stretched(g, 0, 1, 0);
    double tilt = (along.x * across.x + along.y * across.y) / (across.x * across.x + across.y * across.y);
    for (int i = 0; i < 80; i++) {
        double middle = 0.5 * (inside + outside);
        if (is_inside(g, stretched(g, -middle, middle * tilt, 1)))
            inside = middle;
        else
            outside = middle;
    }
    return inside;
}

static double integral_beckmann(const subject *g)
{
    const double in = 1 - 1e-10; /* as above */
    double from = end_of(g, -9) * in, to = end_of(g, 9) * in, sum = 0;
    for (int i = 0; i < 4; i++)
        sum += oracle_integrate(over_along, g, from + (to - from) * i / 4, from + (to - from) * (i + 1) / 4);
    return sum;
}

/* ---- tables: azimuth about z, then the slope length ---- */

static const double NODE[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263};
static const double WEIGHT[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                 0.17392742256872693};

/* X = t, Z = 1 - t. */
static vndf_normal at_radius(const subject *g, double t)
{
    return stretched(g, t * cos(g->line), t * sin(g->line), 1 - t);
}

/* Cells of the radial table as far as they are in the disc, four points and two halves each. */
static double over_radius(const subject *g)
{
    const vndf_distribution *d = g->view.distribution;
    double sum = 0, end = border(g, at_radius, 0, 1);
    for (uint32_t j = 0; j < d->radial_count && d->knots.at[j].x < end; j++) {
        double from = d->knots.at[j].x, to = fmin(d->knots.at[j + 1].x, end);
        for (int i = 0; i < 8; i++) {
            double t = from + (to - from) * (i / 4 + NODE[i % 4]) / 2;
            vndf_normal m = at_radius(g, t);
            sum += WEIGHT[i % 4] / 2 * (to - from) * t * density(g, m);
        }
    }
    return sum;
}

/* Panels that end where the azimuth's density has its kinks. */
static double integral_table(subject *g)
{
    enum { PANELS = 16 };
    const vndf_wedge *wedge = &g->view.distribution->above;
    vndf_azimuth_row row = vndf_wedge_row(wedge, (float)(g->c / (g->s + g->c)));
    double sum = 0;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < 4 * PANELS; i++) {
            g->line = side * PI / 2 * (i / 4 + NODE[i % 4]) / PANELS;
            sum += PI / 2 / PANELS * WEIGHT[i % 4] * over_radius(g);
        }
    for (int side = -1; side <= 1 && row.p > 0; side += 2)
        for (uint32_t i = 0; i < 4 * wedge->cell_count; i++) {
            double q0 = wedge->q[i / 4], width = wedge->q[i / 4 + 1] - q0, q = q0 + width * NODE[i % 4];
            double x = row.p * (1 - q * q), y = row.r * 2 * q;
            g->line = side * (PI - atan2(y, x));
            sum += 2 * row.p * row.r * (1 + q * q) / (x * x + y * y) * width * WEIGHT[i % 4] * over_radius(g);
        }
    return sum;
}

static void test_subject(const char *name, const vndf_distribution *d)
{
    const float alpha[][2] = {{1, 1}, {0.7f, 0.1f}, {2, 2}, {10, 10}, {0.5f, 0.5f}};
    const double cosine[] = {1, 0.7, 0.3, 0.05};
    int wanted = test_quick() ? 4 : 5;
    for (int a = 0; a < wanted; a++)
        for (int c = 0; c < 4; c++) {
            subject g = subject_of(d, alpha[a], cosine[c]);
            double sum = d == vndf_ggx()        ? integral_ggx(&g)
                         : d == vndf_beckmann() ? integral_beckmann(&g)
                                                : integral_table(&g);
            if (!TEST_NEAR(sum, 1, 1e-5))
                fprintf(stderr, "  %s, alpha %g %g, cos %g\n", name, alpha[a][0], alpha[a][1], cosine[c]);
        }
}

int main(int arguments, char **argument)
{
    vndf_error error;
    if (oracle_wanted(arguments, argument, 0, "ggx"))
        test_subject("ggx", vndf_ggx());
    if (oracle_wanted(arguments, argument, 1, "beckmann"))
        test_subject("beckmann", vndf_beckmann());
    for (size_t i = 2; i < 4; i++) {
        const char *path =
            i == 2 ? VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf" : VNDF_SOURCE_DIR "/tables/epd-0.6.vndf";
        if (!oracle_wanted(arguments, argument, i, path))
            continue;
        vndf_distribution *table = vndf_load(path, &error);
        if (TEST(table != NULL))
            test_subject(path, table);
        vndf_free(table);
    }
    return test_done();
}
