/* Inverting and sampling undo each other, the map from uniform numbers to normals has no jump, and for tables u1
 * turns the azimuth and u2 the slope monotonically. What vndf.h promises of vndf_invert holds also near the border
 * of the unit square, where a step of a number may lead far: the normal comes back within 1e-5, or within what
 * four steps of 2^-24 make. Numbers that inverse.h calls sure lead back within 1e-5 anywhere.
 *
 * A place is the stretched unit normal in stereographic projection, (x, y)/(1 + z), where float errors are some
 * 2^-24 everywhere. Between u and a place and back lie a dozen roundings, so with the Jacobian J of the map,
 * measured on steps of 2^-15 of u, float allows a normal to return within max(1e-5, 16 2^-24 |J|) and u within
 * 16 2^-24 (1 + |1/J|). A jump would stay when an interval of u shrinks from 2^-9 to 2^-21; what moves the normal
 * there is density. The parts of [0, 1] within 2^-7 of the ends, where tails run to infinity, are left out of
 * that. */
#include "oracle/oracle.h"
#include "harness/constants.h"
#include "harness/test.h"
#include "sampler/tabulated/inverse.h"
#include "vndf_build.h"

static const double THETAS[] = {0, 5, 30, 60, 80, 89, 90, 91, 100, 120};
static const float ALPHAS[][2] = {{1, 1}, {0.05f, 0.4f}, {1e-4f, 1e-4f}, {0.5f, 1e-3f}};
enum { POINTS = 400, HARD = 2000, STEPS = 512 };

/* A surface, its view, and what makes the coordinates of the stretched normal. */
typedef struct frame {
    vndf_surface surface;
    vndf_view view;
    double cos_phi, sin_phi, scale;
} frame;

typedef struct place {
    double x, y; /* projected */
    double a, r; /* azimuth about wi, part R/(1 + R) of the slope length */
} place;

static frame frame_of(const vndf_distribution *d, size_t alpha, double theta, double phi)
{
    vndf_surface surface = {d, ALPHAS[alpha][0], ALPHAS[alpha][1]};
    double t = theta * PI / 180, p = phi * PI / 180;
    vndf_vec3 wi = {(float)(sin(t) * cos(p)), (float)(sin(t) * sin(p)), theta == 90 ? 0 : (float)cos(t)};
    double x = (double)surface.alpha_x * wi.x, y = (double)surface.alpha_y * wi.y, l = hypot(x, y);
    double scale = vndf_distribution_info(d).scale;
    frame f = {surface, vndf_view_from(&surface, wi), l > 0 ? x / l : 1, l > 0 ? y / l : 0, scale > 0 ? scale : 1};
    return f;
}

static place place_of(const frame *f, vndf_vec3 wm)
{
    double x = wm.x / (f->surface.alpha_x * f->scale), y = wm.y / (f->surface.alpha_y * f->scale), z = wm.z;
    double across = f->cos_phi * x + f->sin_phi * y, along = f->cos_phi * y - f->sin_phi * x, r = hypot(x, y);
    double per = 1 / (hypot(r, z) + z);
    place p = {across * per, along * per, atan2(along, across), r / (r + z)};
    return p;
}

static vndf_vec3 sample(const frame *f, double u1, double u2)
{
    return vndf_sample(&f->view, (float)u1, (float)u2, NULL);
}

static place place_at(const frame *f, double u1, double u2)
{
    return place_of(f, sample(f, u1, u2));
}

static double distance(vndf_vec3 a, vndf_vec3 b)
{
    return hypot(hypot((double)a.x - b.x, (double)a.y - b.y), (double)a.z - b.z);
}

/* Norms of the Jacobian, as the real normal moves, and of the rows of its inverse; one-sided steps. */
typedef struct rates {
    double map, inverse1, inverse2;
} rates;

static rates rates_at(const frame *f, double u1, double u2)
{
    double h = 0x1p-15, h1 = u1 < 0.5 ? h : -h, h2 = u2 < 0.5 ? h : -h;
    place here = place_at(f, u1, u2), p = place_at(f, u1 + h1, u2), q = place_at(f, u1, u2 + h2);
    double x1 = (p.x - here.x) / h1, y1 = (p.y - here.y) / h1, x2 = (q.x - here.x) / h2, y2 = (q.y - here.y) / h2;
    double det = fabs(x1 * y2 - x2 * y1) + 1e-12;
    vndf_vec3 wm = sample(f, u1, u2);
    double map = distance(wm, sample(f, u1 + h1, u2)) + distance(wm, sample(f, u1, u2 + h2));
    rates j = {map / h, hypot(x2, y2) / det, hypot(x1, y1) / det};
    return j;
}

static int test_point(const frame *f, float u1, float u2)
{
    float v1 = -1, v2 = -1;
    vndf_vec3 wm = vndf_sample(&f->view, u1, u2, NULL);
    rates j = rates_at(f, u1, u2);
    vndf_invert(&f->view, wm, &v1, &v2);
    vndf_vec3 back = vndf_sample(&f->view, v1, v2, NULL);
    double moved1 = fabs((double)u1 - v1), moved2 = fabs((double)u2 - v2), moved = distance(wm, back);
    int good = TEST(moved <= fmax(1e-5, 0x1p-20 * j.map));
    good &= TEST(moved1 <= 0x1p-20 * (1 + j.inverse1)) & TEST(moved2 <= 0x1p-20 * (1 + j.inverse2));
    if (!good)
        fprintf(stderr, "  u %.9g %.9g -> %.9g %.9g, normal moved %.3g, rates %.3g %.3g %.3g\n", u1, u2, v1, v2,
                moved, j.map, j.inverse1, j.inverse2);
    return good;
}

static int test_round_trip(const frame *f, unsigned long long *state)
{
    int good = 1;
    for (int i = 0; i < POINTS; i++) {
        float u1 = test_uniform(state), u2 = test_uniform(state);
        good &= test_point(f, u1, u2);
    }
    return good;
}

/* Anywhere, or within 2^-2 of an end and not within 2^-22, the nearer the likelier, often just there. */
static float hard_uniform(unsigned long long *state)
{
    float which = test_uniform(state), near = exp2f(fmaxf(-22, 24 * test_uniform(state) - 26));
    return which < 0.5f ? fmaxf(0x1p-22f, test_uniform(state)) : which < 0.75f ? near : 1 - near;
}

/* From one unit normal of the unit problem to another. */
static double apart_on_sphere(place p, place q)
{
    double square = (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    return 2 * sqrt(square / ((1 + p.x * p.x + p.y * p.y) * (1 + q.x * q.x + q.y * q.y)));
}

static double led_by_steps(const frame *f, double u1, double u2, place here)
{
    double most = 0;
    for (int i = 0; i < 9; i++) {
        place there = place_at(f, u1 + (i % 3 - 1) * 0x1p-22, u2 + (i / 3 - 1) * 0x1p-22);
        most = fmax(most, apart_on_sphere(here, there));
    }
    return most;
}

static int test_promise(const frame *f, unsigned long long *state)
{
    int good = 1;
    for (int i = 0; i < HARD && good; i++) {
        float u1 = hard_uniform(state), u2 = hard_uniform(state), v1 = -1, v2 = -1;
        vndf_vec3 wm = vndf_sample(&f->view, u1, u2, NULL);
        vndf_invert(&f->view, wm, &v1, &v2);
        place here = place_of(f, wm);
        double lost = apart_on_sphere(here, place_at(f, v1, v2));
        good &= TEST(lost <= 1e-5 || lost <= led_by_steps(f, u1, u2, here));
        if (!good)
            fprintf(stderr, "  u %.9g %.9g -> %.9g %.9g, %.3g apart\n", u1, u2, v1, v2, lost);
    }
    return good;
}

static vndf_inverse inverse_of(const vndf_view *view, vndf_vec3 wm)
{
    const struct vndf_table_view *of = &view->of.table;
    const vndf_inverse_view w = {of->s, of->c, of->front, of->wedge};
    const vndf_inverse_frame heading = {view->ax, view->ay, of->cos_phi, of->sin_phi};
    vndf_turned n = vndf_turned_of(&heading, wm.x, wm.y, wm.z);
    return n.x >= 0 ? vndf_inverse_in_front(view->distribution, &w, &n)
                    : vndf_inverse_in_wedge(view->distribution, &w, &n);
}

static int test_sure(const frame *f, unsigned long long *state)
{
    int good = 1;
    for (int i = 0; i < HARD && good; i++) {
        float u1 = hard_uniform(state), u2 = hard_uniform(state);
        vndf_vec3 wm = vndf_sample(&f->view, u1, u2, NULL);
        vndf_inverse found = inverse_of(&f->view, wm);
        double lost = apart_on_sphere(place_of(f, wm), place_at(f, found.u1, found.u2));
        good &= TEST(!found.sure || lost <= 1e-5);
        if (!good)
            fprintf(stderr, "  u %.9g %.9g -> %.9g %.9g, sure, but %.3g apart\n", u1, u2, found.u1, found.u2,
                    lost);
    }
    return good;
}

/* Along u1 or u2 (which = 0, 1), the other number fixed. */
static place along(const frame *f, int which, double u, double fixed)
{
    return which ? place_at(f, fixed, u) : place_at(f, u, fixed);
}

static double apart(place p, place q)
{
    return hypot(p.x - q.x, p.y - q.y);
}

/* What is left of a step when its interval is halved towards the larger half. */
static double left_of_step(const frame *f, int which, double low, double high, double fixed)
{
    place at_low = along(f, which, low, fixed), at_high = along(f, which, high, fixed);
    while (high - low > 0x1p-21) {
        double middle = (low + high) / 2;
        place at = along(f, which, middle, fixed);
        if (apart(at, at_low) > apart(at_high, at))
            high = middle, at_high = at;
        else
            low = middle, at_low = at;
    }
    return apart(at_high, at_low);
}

/* Straight behind, an azimuth is -pi and pi at once: the first half of u1 counts from -pi. */
static double turned(place p, double u)
{
    return fabs(p.a) < PI - 1e-5 ? p.a : u < 0.5 ? -PI : PI;
}

static int is_forward(const frame *f, int which, double u, place from, place to)
{
    double step = which ? to.r - from.r : turned(to, u) - turned(from, u - 1.0 / STEPS);
    return vndf_distribution_info(f->surface.distribution).bytes == 0 || step >= -0x1p-22 * (which ? 1 : PI);
}

static int test_line(const frame *f, int which, double fixed)
{
    place last = along(f, which, 0, fixed);
    double largest = 0, where = 0.5;
    int forward = 1;
    for (int i = 1; i <= STEPS; i++) {
        double u = (double)i / STEPS;
        place at = along(f, which, u, fixed);
        forward &= is_forward(f, which, u, last, at);
        if (u > 0x1p-7 && u < 1 - 0x1p-7 && apart(at, last) > largest) {
            largest = apart(at, last);
            where = u;
        }
        last = at;
    }
    double left = left_of_step(f, which, where - 1.0 / STEPS, where, fixed);
    int good = TEST(forward) & TEST(left <= 1e-3);
    if (!good)
        fprintf(stderr, "  along u%d, the other %g: step %.3g at %g, %.3g of it left\n", which + 1, fixed, largest,
                where, left);
    return good;
}

static int test_frame(const frame *f, unsigned long long *state)
{
    int good = test_round_trip(f, state) & test_promise(f, state);
    if (vndf_distribution_info(f->surface.distribution).bytes > 0 && f->view.trusted)
        good &= test_sure(f, state);
    const double fixed[] = {0.01, 0.3, 0.5, 0.75, 0.99};
    for (int i = 0; i < 10; i++)
        good &= test_line(f, i % 2, fixed[i / 2]);
    return good;
}

static void test_distribution(const vndf_distribution *d, const char *name)
{
    unsigned long long state = 7;
    if (!TEST(d != NULL))
        return;
    for (size_t a = 0; a < sizeof ALPHAS / sizeof *ALPHAS; a += test_quick() ? 3 : 1)
        for (size_t i = 0; i < sizeof THETAS / sizeof *THETAS; i++) {
            frame f = frame_of(d, a, THETAS[i], 33);
            if (f.view.of.table.area > 1e-10f && !test_frame(&f, &state))
                fprintf(stderr, "  %s (%lu bytes), alpha %g %g, theta %g\n", name,
                        (unsigned long)vndf_distribution_info(d).bytes, f.surface.alpha_x, f.surface.alpha_y,
                        THETAS[i]);
        }
}

/* Normals beside a hole are rounded into it, where no mass is. */
static void test_hole(void)
{
    unsigned long long state = 7;
    vndf_distribution *table = oracle_build_of("exp(-r)*step(r-2)", 2048, NULL, NULL);
    for (size_t i = 0; TEST(table != NULL) && i < 40; i++) {
        frame f = frame_of(table, i % 4, THETAS[i / 4], 33);
        if (!test_promise(&f, &state))
            fprintf(stderr, "  hole, alpha %g %g, theta %g\n", ALPHAS[i % 4][0], ALPHAS[i % 4][1], THETAS[i / 4]);
    }
    vndf_free(table);
}

int main(int arguments, char **argument)
{
    if (oracle_wanted(arguments, argument, 0, "ggx"))
        test_distribution(vndf_ggx(), "closed ggx");
    if (oracle_wanted(arguments, argument, 1, "beckmann"))
        test_distribution(vndf_beckmann(), "closed beckmann");
    for (size_t i = 0; i < ORACLE_COUNT; i++) {
        oracle o = oracle_get(i);
        if (!oracle_wanted(arguments, argument, i + 2, oracle_name(&o)))
            continue;
        vndf_distribution *table = oracle_build(&o, i % 2 ? 0 : 2048, NULL);
        test_distribution(table, oracle_name(&o));
        vndf_free(table);
    }
    if (oracle_wanted(arguments, argument, ORACLE_COUNT + 2, "hole"))
        test_hole();
    return test_done();
}
