/* The surface functions are what they are called: D is normalised and P22 its slopes, area and Lambda agree with
 * quadrature, and the identities of Lambda, G1 and G2 hold, for closed forms and tables alike.
 *
 * Tables hold areas within 2e-6 and P22 within 2e-4 of it or of 1e-4 of its largest value; closed forms within
 * 1e-6. On top comes what the rounding of the stretched direction to float, 2^-23 of it, does to the area: much,
 * in the tail below the horizon. */
#include "oracle/oracle_validate.h"
#include "harness/constants.h"
#include "harness/test.h"

static const float ALPHAS[][2] = {{1, 1}, {0.05f, 0.4f}, {3, 0.5f}};

/* A distribution under test: its oracle, what it is held as, and how well. */
typedef struct subject {
    const oracle *o;
    const vndf_distribution *d;
    double area, p22;
} subject;

static double reversed_area(const oracle *o, const vndf_surface *surface, vndf_vec3 w)
{
    vndf_vec3 back = {-w.x, -w.y, -w.z};
    return oracle_surface_area(o, surface, back);
}

/* Relative change of the area by a relative change of wi.z by 2^-23. */
static double rounding(const oracle *o, const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_vec3 moved = {wi.x, wi.y, wi.z * (1 + 0x1p-10f)};
    double l = sqrt((double)moved.x * moved.x + (double)moved.y * moved.y + (double)moved.z * moved.z);
    double ratio = l * oracle_surface_area(o, surface, moved) / oracle_surface_area(o, surface, wi);
    return fabs(log(ratio)) * 0x1p-13;
}

static void test_area(const subject *t, const vndf_surface *surface)
{
    for (double theta = 0; theta <= 125; theta += (double)test_amount(25, 15, 5)) {
        vndf_vec3 wi = oracle_direction(theta, 33), back = {-wi.x, -wi.y, -wi.z};
        double area = oracle_surface_area(t->o, surface, wi),
               up = (double)wi.z / sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + (double)wi.z * wi.z);
        if (area < 1e-10 * oracle_surface_area(t->o, surface, oracle_direction(90, 33)))
            continue;
        double got = vndf_projected_area(surface, wi), lambda = vndf_lambda(surface, wi);
        TEST_RELATIVE(got, area, t->area + rounding(t->o, surface, wi));
        TEST_NEAR(got, up + (double)vndf_projected_area(surface, back), 1e-6 * (got + fabs(up)));
        if (theta == 90)
            continue;
        TEST_NEAR(lambda + (double)vndf_lambda(surface, back), -1, 2e-7 * (1 + fabs(lambda)));
        if (theta < 90) {
            double reference = reversed_area(t->o, surface, wi) / up;
            double least = 2 * t->area + rounding(t->o, surface, back);
            TEST(lambda >= 0);
            TEST_NEAR(lambda, reference, reference > 1e-10 ? least * reference : 1e-9);
            TEST_RELATIVE((double)vndf_g1(surface, wi), up / area, 2 * t->area);
        } else
            TEST(vndf_g1(surface, wi) == 0);
    }
}

static void test_g2(const vndf_surface *surface)
{
    unsigned long long state = 29;
    for (int i = 0; i < 3000; i++) {
        vndf_vec3 wi = oracle_direction(100 * (double)test_uniform(&state), 360 * (double)test_uniform(&state));
        double u = (double)test_uniform(&state), v = (double)test_uniform(&state);
        vndf_vec3 wo = oracle_direction(90 * sqrt(u), 360 * v);
        float apart = vndf_g2(surface, wi, wo, VNDF_G2_SEPARABLE),
              joint = vndf_g2(surface, wi, wo, VNDF_G2_HEIGHT_CORRELATED);
        float gi = vndf_g1(surface, wi), go = vndf_g1(surface, wo);
        double lambdas = (double)vndf_lambda(surface, wi) + (double)vndf_lambda(surface, wo);
        TEST(apart >= 0 && apart <= 1 && joint >= 0 && joint <= 1 && gi >= 0 && gi <= 1);
        TEST(joint >= apart * (1 - 1e-6f) && joint <= fminf(gi, go) * (1 + 1e-6f)); /* Heitz 2014, section 5 */
        TEST(joint == vndf_g2(surface, wo, wi, VNDF_G2_HEIGHT_CORRELATED) &&
             apart == vndf_g2(surface, wo, wi, VNDF_G2_SEPARABLE));
        if (wi.z <= 0)
            TEST(apart == 0 && joint == 0);
        else if (gi > 1e-6f && go > 1e-6f)
            TEST_RELATIVE((double)joint, 1 / (1 + lambdas), 2e-6);
    }
}

/* P22 against the oracle, and D = P22/cos^4, at slopes that hold nearly all of the mass. */
static void test_ndf(const subject *t, const vndf_surface *surface)
{
    unsigned long long state = 31;
    double scale = vndf_distribution_info(t->d).scale, ax = surface->alpha_x, ay = surface->alpha_y;
    scale = scale > 0 ? scale : 1;
    for (int i = 0; i < 3000; i++) {
        double r = scale * 3 * test_uniform_double(&state), a = 2 * PI * test_uniform_double(&state);
        float x = (float)(ax * r * cos(a)), y = (float)(ay * r * sin(a));
        double z = 1 / sqrt(1 + (double)x * x + (double)y * y),
               reference = oracle_p22(t->o, hypot(x / ax, y / ay)) / (ax * ay);
        double most = oracle_p22(t->o, scale) / (ax * ay);
        vndf_vec3 wm = {(float)(-x * z), (float)(-y * z), (float)z};
        double got = vndf_p22(surface, x, y);
        if (t->o->breaks[0] > 0 && fabs(r - t->o->breaks[0]) < 1e-5)
            continue;
        if (!TEST_NEAR(got, reference, t->p22 * (reference + 1e-4 * most)))
            fprintf(stderr, "  %s at slope %g\n", oracle_name(t->o), r);
        TEST_NEAR((double)vndf_ndf(surface, wm), reference / pow(wm.z, 4),
                  (t->p22 + 2e-6) * (reference + 1e-4 * most) / pow(z, 4));
    }
}

/* At the pole, where the slope's azimuth means nothing, the density drawn is that of one of its neighbours, which
 * differ by the error of azimuth cells (measured: 1e-3), and near the visible one (measured: 1.7e-2, at 75
 * degrees). */
static void test_pole(const vndf_surface *surface)
{
    const vndf_vec3 up = {0, 0, 1}, beside = {1e-7f * surface->alpha_x, 0, 1};
    for (double theta = 0; theta < 90; theta += 15) {
        vndf_view view = vndf_view_from(surface, oracle_direction(theta, 33));
        double pdf = vndf_pdf(&view, up);
        if (!(TEST_RELATIVE(pdf, (double)vndf_visible(&view, up), 0.03) &
              TEST_RELATIVE(pdf, (double)vndf_pdf(&view, beside), 2e-3)))
            fprintf(stderr, "  alpha %g %g, theta %g\n", surface->alpha_x, surface->alpha_y, theta);
    }
}

typedef struct projected {
    const vndf_surface *surface;
    double sum;
} projected;

static void add_ndf(const oracle_point *point, void *user)
{
    projected *p = user;
    p->sum += (double)vndf_ndf(p->surface, point->wm) * point->wm.z * point->weight;
}

/* integral of D cos over the hemisphere, on the grid of what is seen from straight above. */
static void test_normalised(const vndf_surface *surface, const oracle *o)
{
    projected p = {surface, 0};
    vndf_vec3 up = {0, 0, 1};
    oracle_visit(o, surface, up, add_ndf, &p);
    TEST_NEAR(p.sum, 1, 1e-5); /* the grid does not follow the cells of the table */
}

static void test_subject(const subject *t)
{
    if (!TEST(t->d != NULL))
        return;
    for (size_t i = 0; i < sizeof ALPHAS / sizeof *ALPHAS; i++) {
        vndf_surface surface = {t->d, ALPHAS[i][0], ALPHAS[i][1]};
        test_area(t, &surface);
        test_g2(&surface);
        test_ndf(t, &surface);
        test_pole(&surface);
        if (i == 0 || !test_quick())
            test_normalised(&surface, t->o);
    }
}

int main(int arguments, char **argument)
{
    oracle ggx = oracle_get(ORACLE_GGX), beckmann = oracle_get(ORACLE_BECKMANN), disc = oracle_get(ORACLE_DISC);
    vndf_distribution *tables[] = {oracle_build(&ggx, 0, NULL), oracle_build(&beckmann, 0, NULL),
                                   oracle_build(&disc, 0, NULL)};
    subject subjects[] = {{&ggx, vndf_ggx(), 1e-6, 1e-6},
                          {&beckmann, vndf_beckmann(), 1e-6, 2e-6},
                          {&ggx, tables[0], 2e-6, 2e-4},
                          {&beckmann, tables[1], 2e-6, 2e-4},
                          {&disc, tables[2], 2e-6, 2e-4}};
    for (int i = 0; i < 5; i++)
        if (oracle_wanted(arguments, argument, (size_t)i, NULL))
            test_subject(&subjects[i]);
    for (int i = 0; i < 3; i++)
        vndf_free(tables[i]);
    return test_done();
}
