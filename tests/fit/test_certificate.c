/* Nothing between the directions that the builder looked at exceeds what it certifies by more than a tenth: total
 * variation, largest weight and area error, at angles of incidence several times as dense - twenty times with the
 * argument `all` - wherever the area at alpha 1 is above 1e-10 of that at grazing incidence. And default tables
 * are as good as README says: no sawtooth below the horizon, rings and discs up to the edge of what is seen.
 *
 * The total variation at one direction is measured with the builder's own quadrature, which engine_accuracy holds
 * against another; what is tested here is where it looks. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fit/certificate/validate.h"
#include "oracle/oracle.h"
#include "harness/constants.h"
#include "harness/test.h"
#include "vndf_build.h"

/* A slope expression or a family; the most that the default table may have as total variation, 0: not said; and
 * whether it is tried without `all`. */
static const struct subject {
    const char *name;
    double tv;
    int quick;
} SUBJECTS[] = {
    {"ggx", 6e-5, 1},
    {"beckmann", 1.5e-4, 0},
    {"student-t:1.6", 0, 0},
    {"student-t:1.7", 0, 0},
    {"student-t:2.5", 9e-5, 0},
    {"student-t:6", 0, 0},
    {"student-t:10", 0, 0},
    {"gtr:0.7", 0, 0},
    {"gtr:1.5", 0, 0},
    {"gtr:5", 0, 0},
    {"epd:0.3", 0, 0},
    {"epd:0.6", 0, 0},
    {"epd:1.7", 0, 0},
    {"epd:3", 0, 0},
    {"phong:2", 0, 0},
    {"phong:20", 0, 0},
    {"phong:200", 0, 0},
    {"sgd:alum-bronze/r", 0, 0},
    {"sgd:red-fabric/r", 0, 0},
    {"sgd:nickel/g", 0, 0},
    {"abc:two-layer-gold", 0, 0},
    {"mix:(0.5,1,ggx)+(0.5,0.01,ggx)", 1e-4, 1},
    {"mix:(0.7,0.1,ggx)+(0.3,0.4,ggx)", 1e-4, 0},
    {"mix:(0.5,1,ggx)+(0.5,0.0001,ggx)", 1e-4, 0},
    {"mix:(0.5,1,ggx)+(0.5,0.001,ggx)", 0, 0},
    {"mix:(0.5,1,student-t:6)+(0.5,0.1,ggx)", 0, 0},
    {"mix:(0.9,1,beckmann)+(0.1,0.05,beckmann)", 0, 0},
    {"mix:(0.01,1,beckmann)+(0.99,0.01,beckmann)", 0, 0},
    {"exp(-3*r)*(1+0.8*cos(6*r))", 1e-3, 1},
    {"exp(-3*r)*(1+0.8*cos(12*r))", 0, 0},
    {"exp(-r)*(1+0.5*sin(20*r))", 0, 0},
    {"exp(-r)*(1+0.9*cos(3*r))", 3.1e-3, 0}, /* 32768 bytes reach 1.07e-3, which is no reason to grow to them */
    {"exp(-r^2)*(1+0.9*cos(8*r))", 1e-3, 0},
    {"1/(1+r^2)^3*(1+0.9*cos(10*log(1+r)))", 1e-3, 0},
    {"exp(-((r-1)/0.3)^2)", 0, 0},
    {"exp(-((r-1)/0.1)^2)", 1e-3, 0},
    {"exp(-((r-1)/0.03)^2)", 1e-3, 0},
    {"exp(-((r-1)/0.01)^2)", 1e-3, 1},
    {"exp(-((r-1)/0.001)^2)", 1e-3, 0},
    {"exp(-((r-1)/0.0001)^2)", 0, 0},
    {"exp(-((r-5)/0.5)^2)+exp(-r^2)", 0, 0},
    {"exp(-r^2)+0.01*exp(-((r-3)/0.05)^2)", 1e-3, 0},
    {"exp(-r)+100*exp(-((r-2)/0.001)^2)", 0, 0},
    {"step(1-r)", 1.6e-3, 1}, /* where 1e-10 of the area is left 1.5e-4 of a slope is seen, 2000 floats */
    {"step(1-abs(r-1)*5)", 1e-3, 0},
    {"step(2-r)*step(r-1)", 0, 0},
    {"step(1-r)+0.1*step(3-r)", 0, 0},
    {"max(0,1-r)", 0, 0},
    {"max(0,1-r)^2", 0, 0},
    {"max(0,1-r^2)", 0, 0},
    {"sqrt(max(0,1-r^2))", 0, 0},
    {"exp(-r)", 0, 0},
    {"r*exp(-r)", 0, 0},
    {"r^2*exp(-r^2)", 0, 0},
    {"r^4*exp(-r^2)", 0, 0},
    {"exp(-r^4)", 0, 0},
    {"exp(-sqrt(r))", 0, 0},
    {"exp(-r^0.3)", 0, 0},
    {"r^-1*exp(-r^2)", 0, 0},
    {"r^-1.5*exp(-r)", 0, 0},
    {"1/(1+r^4)", 0, 0},
    {"1/(1+r^3.3)", 0, 0},
    {"1/(0.01+(r-1)^2)^2", 0, 0},
};

/* What is worst over some directions. */
typedef struct worst {
    double tv, tv_theta, above, max_weight, area_error;
} worst;

static void look(vndf_validation *v, double theta, worst *w)
{
    double t = theta * PI / 180, s = sin(t), c = cos(t), across = s * v->profile->scale, length = hypot(across, c);
    if (!(vndf_profile_area(v->profile, across, c) > 1e-10 * vndf_profile_area(v->profile, v->profile->scale, 0)))
        return;
    v->profile->guard->spent = 0;
    vndf_finding f = vndf_validation_direction(v, across / length, c / length);
    TEST(f.measured);
    if (f.tv > w->tv) {
        w->tv = f.tv;
        w->tv_theta = theta;
    }
    w->above = fmax(w->above, theta <= 90 ? f.tv : 0);
    w->max_weight = fmax(w->max_weight, f.max_weight);
    w->area_error = fmax(w->area_error, f.area_error);
}

/* Even in the angle, and even in the logarithm of the slope at which the horizon of wi cuts, to either side. */
static worst look_all(vndf_validation *v, int count)
{
    worst w = {0, 0, 0, 0, 0};
    for (int i = 0; i < count; i++) {
        double cut = pow(10, -3 + 7 * (i + 0.5) / count) * v->profile->scale;
        look(v, 180 * (i + 0.5) / count, &w);
        look(v, 90 - atan(cut) * 180 / PI, &w);
        look(v, 90 + atan(cut) * 180 / PI, &w);
    }
    return w;
}

static void test_dense(const struct subject *s, const vndf_source *source, const vndf_distribution *table,
                       const vndf_certificate *claim, int count)
{
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, NULL);
    vndf_validation v;
    if (!TEST(profile != NULL))
        return;
    if (TEST(vndf_validation_from(&v, table, profile, vndf_validation_close))) {
        worst w = look_all(&v, count);
        int good = TEST(w.tv <= 1.1 * (double)claim->tv + 1e-7) &
                   TEST(w.above <= 1.1 * (double)claim->tv_above + 1e-7) &
                   TEST(w.max_weight - 1 <= 1.1 * ((double)claim->max_weight - 1)) &
                   TEST(w.area_error <= 1.1 * (double)claim->area_error + 1e-7) &
                   TEST(s->tv == 0 || (double)claim->tv <= s->tv);
        if (!good)
            fprintf(stderr,
                    "  %s (%lu bytes) certifies TV %.4g at %g (%.4g above), weight %.5g, area %.3g; found TV %.4g"
                    " at %.9g (%.4g), weight %.5g, area %.3g\n",
                    s->name, (unsigned long)table->bytes, (double)claim->tv, (double)claim->tv_theta,
                    (double)claim->tv_above, (double)claim->max_weight, (double)claim->area_error, w.tv,
                    w.tv_theta, w.above, w.max_weight, w.area_error);
    }
    vndf_validation_free(&v);
    vndf_profile_free(profile);
}

static void test_subject(const struct subject *s, int count)
{
    vndf_certificate claim;
    vndf_source *source = oracle_source_of(s->name, NULL);
    vndf_distribution *table = source ? vndf_build(source, NULL, &claim, NULL) : NULL;
    if (TEST(table != NULL))
        test_dense(s, source, table, &claim, count);
    else
        fprintf(stderr, "  %s\n", s->name);
    vndf_free(table);
    vndf_source_free(source);
}

/* A needle that no cell can hold is missed by the table, and its certificate says so: it has 18% of the mass, and
 * cells are 2e-5 of their slope wide at least. */
static void test_needles(void)
{
    static const struct {
        const char *p22;
        float least, most;
    } needles[] = {
        {"exp(-r)+1e5*exp(-((r-1.2345)/1e-6)^2)", 0.12f, 0.17f},
        {"exp(-r)+1e6*exp(-((r-1.2345)/1e-7)^2)", 0.165f, 0.185f},
    };
    for (size_t i = 0; i < sizeof needles / sizeof *needles; i++) {
        vndf_certificate claim = {0};
        vndf_distribution *table = oracle_build_of(needles[i].p22, 4096, &claim, NULL);
        TEST(table != NULL);
        if (!(TEST(claim.tv > needles[i].least && claim.tv < needles[i].most) & TEST(claim.ndf_error > 100)))
            fprintf(stderr, "  %s certifies TV %.4g\n", needles[i].p22, (double)claim.tv);
        vndf_free(table);
    }
}

/* A heavy tail that oscillates for ever is refused: all its waves hold some mass. */
static void test_endless_waves(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = oracle_source_of("1/(1+r^2)^2*(1+0.5*cos(5*r))", NULL);
    vndf_distribution *table = vndf_build(source, NULL, NULL, &error);
    TEST(source != NULL && table == NULL && error.status == VNDF_ERROR_DISTRIBUTION);
    TEST(strstr(error.message, "not resolved by 60000 panels") != NULL);
    vndf_free(table);
    vndf_source_free(source);
}

/* The edge of a disc of radius 1 stands in a table at the slope next to it, of the floats that there are for x and z
 * together, on the far side: next to the edge so little is seen that a step of floats shows. */
static void test_edge(void)
{
    vndf_distribution *table = oracle_build_of("step(1-r)", 4096, NULL, NULL);
    double nearest = 1;
    for (uint32_t j = 0; TEST(table != NULL) && j < table->radial_count; j++) {
        double slope = (double)table->knots.at[j].x / (double)table->knots.at[j].z * table->scale;
        nearest = fabs(slope - 1) < fabs(nearest) ? slope - 1 : nearest;
    }
    if (!TEST(nearest >= -1e-12 && nearest < 3e-8))
        fprintf(stderr, "  the knot stands %.3g beyond the edge\n", nearest);
    vndf_free(table);
}

/* D of student-t:1.7 grows as cos^-0.6 towards the horizon; that of GGX has a limit there. */
static void test_horizon(void)
{
    static const struct {
        const char *name;
        double power;
    } cases[] = {{"student-t:1.7", -0.6}, {"ggx", 0}};
    for (int i = 0; i < 2; i++) {
        vndf_certificate claim = {0};
        vndf_distribution *table = oracle_build_of(cases[i].name, 4096, &claim, NULL);
        TEST(table != NULL);
        TEST_NEAR(claim.horizon_power, cases[i].power, 1e-3);
        TEST(claim.weight_bounded == (float)(cases[i].power == 0));
        TEST(cases[i].power == 0 ? claim.max_weight < 3 : claim.max_weight > 1000); /* 1e-6 is far out there */
        TEST(claim.tv_above <= claim.tv && claim.tv_above > 0 && claim.tv_above_theta <= 90);
        vndf_free(table);
    }
}

int main(void)
{
    for (size_t i = 0; i < sizeof SUBJECTS / sizeof *SUBJECTS; i++)
        if (test_long() || SUBJECTS[i].quick)
            test_subject(&SUBJECTS[i], (int)test_amount(20, 60, 1300));
    test_needles();
    if (test_long())
        test_endless_waves();
    test_edge();
    test_horizon();
    return test_done();
}
