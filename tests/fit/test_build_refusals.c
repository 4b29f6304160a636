/* What cannot be the normals of a microsurface is refused with the true reason, and what only looks hard is not (nor
 * what test_small_tables and test_stress build). */
#include "harness/test.h"
#include "oracle/oracle.h"

static const char *const refusals[][2] = {
    {"1-r", "negative"}, /* negative beyond slope 1 */
    {"exp(-r)*sqrt(3-r)", "not a number"},
    {"exp(-r)/abs(r-1)", "cannot be resolved at slope 1"},
    {"exp(-r)/step(1-r)", "infinite at slope 1"},
    {"0", "zero"},
    {"step(-1-r)", "zero"},
    {"1", "infinite projected area"},
    {"1/(1+r^3)", "infinite projected area"}, /* r^-3: the first moment diverges like a logarithm */
    {"r^-2*exp(-r)", "at the pole"},
    {"(1+r*r)^-1.52", "tail"},               /* integrable, but in slopes that no float normal has */
    {"r^-1.9*exp(-r)", "below slope 1e-30"}, /* the same at the pole */
    {"1e-320*exp(-r*r)", "too small for doubles"},
    {"exp(-1e20*r)", "the median slope is 1.67835e-20"},
    {"exp(-r-lgamma(1+r))", "cannot be bounded at slope"},
    {"exp(-r)+step(r-1)*step(1.001-r)*sqrt(1.0001-r)", "not a number"},
    {"exp(-r)*(1+cos(1e12*r))", "too rough"},
    {"1/(1+r^2)^2*(1+0.5*cos(5*r))", "not resolved by 60000 panels"}, /* all its waves hold some mass */
    {"exp(-r)*(1+5e13*exp(-((r-1.37)/1e-15)^2))", "cannot be resolved at slope 1.3"},
};

static const char *const accepted[] = {
    "r^-1.7*exp(-r)",
    "(1+r*r)^-1.65",
    "1e30*exp(-r*r)",
    "exp(-((r-1)/1e-5)^2)",
    "exp(-((r-1.37)/2e-5)^2)", /* all mass in a narrow ring */
    "r^11*exp(-r^2)",
    "exp(r)/(1+exp(2*r))",
    "r^100/cosh(r)", /* far out infinity times 0 and over infinity */
    "1-pow(tanh(r),2)",
    "2*step(0.4-r)+1-step(r-1)", /* far out exactly 0, where bounds must not be rounded away */
    "1e-305*exp(-r*r)",
    "exp(-r)/sqrt(abs(r^2-2))", /* infinite, but at no double */
    "(1-cos(r))/r^2*exp(-r)",   /* few digits near 0 */
};

/* A table, or the reason why there is none. */
static void test_formula(const char *slope, const char *reason)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = oracle_build(slope, 4096, NULL, &error);
    if (!(reason ? TEST(!table && error.status == VNDF_ERROR_DISTRIBUTION) & TEST_HAS(error.message, reason)
                 : TEST(table != NULL)))
        fprintf(stderr, "  %s: %s\n", slope, error.message);
    vndf_free(table);
}

/* A density that turns into something else beyond the slope 2, or after some calls. */
typedef struct turncoat {
    long left;
    double value;
} turncoat;

static double turn(double r, void *user)
{
    turncoat *t = user;
    return t->left < 0 ? (r < 2 ? exp(-r * r) : t->value) : t->left-- > 0 ? exp(-r * r) : t->value;
}

/* The value is named, and the slope of the first that is bad, whenever a build comes upon it. */
static void test_where(void)
{
    static const double values[] = {-1, NAN, INFINITY};
    static const char *const words[] = {"negative", "not a number", "infinite"};
    static const long calls[] = {-1, 0, 1000, 100000, 300000, 330000};
    for (int i = 0; i < 18; i++) {
        turncoat t = {calls[i / 3], values[i % 3]};
        vndf_error error = {VNDF_OK, ""};
        vndf_source *source = vndf_source_slope_callback(turn, &t, "turncoat", &error);
        TEST(!vndf_build(source, NULL, NULL, &error) && error.status == VNDF_ERROR_DISTRIBUTION);
        TEST_HAS(error.message, words[i % 3]);
        const char *at = strstr(error.message, "slope ");
        double slope = 0;
        TEST(i >= 3 || (at && sscanf(at, "slope %lf", &slope) == 1 && slope >= 2 && slope < 2.2));
        vndf_source_free(source);
    }
}

int main(void)
{
    char staircase[1024] = "0";
    vndf_error error = {VNDF_OK, ""};
    for (int i = 1; i <= 40; i++)
        sprintf(staircase + strlen(staircase), "+step(%g-r)", 0.05 * i);
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++)
        test_formula(refusals[i][0], refusals[i][1]);
    for (size_t i = 0; i < sizeof accepted / sizeof *accepted; i++)
        test_formula(accepted[i], NULL);
    test_formula(staircase, NULL);
    test_where();
    TEST(!vndf_build(NULL, NULL, NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(vndf_certify(vndf_ggx(), NULL, NULL, &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_source_p22(NULL, 1) == 0 && vndf_source_description(NULL)[0] == '\0');
    return test_done();
}
