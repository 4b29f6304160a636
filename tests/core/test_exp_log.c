/* The library's own exp, log and log1p have the relative errors that src/math/exp_log.h states, over their whole
 * domains, and a cosine and a sine in turns are within 1e-14; the oracle is the C library in long double. */
#include "math/exp_log.h"
#include "math/turn.h"
#include "harness/test.h"

enum { POINTS = 400000 };

static double off(double got, long double want)
{
    return (double)fabsl(((long double)got - want) / want);
}

static double between(unsigned long long *state, double low, double high)
{
    return low + (high - low) * test_uniform_double(state);
}

static void exp_is_exact(void)
{
    unsigned long long state = 1;
    double worst = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double reach = i % 3 == 0 ? 700.0 : i % 3 == 1 ? 1.0 : 1e-6, x = between(&state, -reach, reach);
        worst = fmax(worst, off(vndf_exp(x), expl(x)));
    }
    fprintf(stderr, "exp: relative error %.2g\n", worst);
    TEST(worst < 4e-16);
    TEST(vndf_exp(0.0) == 1.0 && vndf_exp(-0.0) == 1.0);
    TEST(vndf_exp(-746.0) == 0.0 && vndf_exp(-1e300) == 0.0 && vndf_exp(-INFINITY) == 0.0);
    TEST(vndf_exp(710.0) == INFINITY && vndf_exp(1e300) == INFINITY && vndf_exp(709.0) < INFINITY);
    TEST(isnan(vndf_exp(NAN)));
    TEST_RELATIVE(vndf_exp(-705.0), (double)expl(-705.0L), 1e-15);
    TEST_RELATIVE(vndf_exp(709.0), (double)expl(709.0L), 1e-15);
    TEST_RELATIVE(vndf_exp(-720.0), (double)expl(-720.0L), 1e-10); /* a denormal has fewer digits */
}

/* Near 1 the logarithm itself is small, and must keep its digits. */
static void log_is_exact(void)
{
    unsigned long long state = 2;
    double worst = 0.0, worst1p = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double x =
            i % 2 ? exp(between(&state, -700.0, 700.0)) : 1.0 + between(&state, -1.0, 1.0) * ldexp(1.0, -i % 50);
        double y = exp(between(&state, -60.0, 60.0));
        if (x != 1.0 && x > 0.0)
            worst = fmax(worst, off(vndf_log(x), logl(x)));
        worst1p = fmax(worst1p, off(vndf_log1p(y), log1pl(y)));
    }
    fprintf(stderr, "log: relative error %.2g, log1p: %.2g\n", worst, worst1p);
    TEST(worst < 4e-16);
    TEST(worst1p < 8e-16);
    TEST(vndf_log(1.0) == 0.0 && vndf_log1p(0.0) == 0.0);
}

/* Of any angle in turns; at multiples of a quarter to the bit but for the sign of 0. */
static void turns_are_exact(void)
{
    unsigned long long state = 4;
    double worst = 0.0, cosine, sine;
    for (int i = 0; i < POINTS; i++) {
        double turns = between(&state, -1.0, 2.0);
        long double angle = 6.283185307179586476925286766559L * turns;
        vndf_turn_of(turns, &cosine, &sine);
        worst = fmax(worst, fmax((double)fabsl(cosine - cosl(angle)), (double)fabsl(sine - sinl(angle))));
    }
    fprintf(stderr, "turns: absolute error %.2g\n", worst);
    TEST(worst < 1e-14);
    vndf_turn_of(1e4, &cosine, &sine);
    TEST(cosine == 1.0 && sine == 0.0);
}

int main(void)
{
    exp_is_exact();
    log_is_exact();
    turns_are_exact();
    return test_done();
}
