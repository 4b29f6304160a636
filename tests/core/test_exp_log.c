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

int main(void)
{
    unsigned long long state = 1;
    double worst[4] = {0}, cosine, sine; /* of exp, log, log1p, and a turn */
    for (int i = 0; i < POINTS; i++) {
        /* exp of every size; the logarithm near 1 too, where it is small and must keep its digits */
        const double u = test_uniform_double(&state), v = 2 * u - 1, y = exp(60 * v), turns = 3 * u - 1;
        const double e = v * (i % 3 == 0 ? 700 : i % 3 == 1 ? 1 : 1e-6);
        const double x = i % 2 ? exp(700 * v) : 1 + v * ldexp(1, -i % 50);
        const long double angle = 6.283185307179586476925286766559L * turns;
        vndf_turn_of(turns, &cosine, &sine);
        worst[0] = fmax(worst[0], off(vndf_exp(e), expl(e)));
        worst[1] = fmax(worst[1], x == 1 || !(x > 0) ? 0 : off(vndf_log(x), logl(x)));
        worst[2] = fmax(worst[2], off(vndf_log1p(y), log1pl(y)));
        worst[3] = fmax(worst[3], (double)fmaxl(fabsl(cosine - cosl(angle)), fabsl(sine - sinl(angle))));
    }
    fprintf(stderr, "exp, log, log1p, turn: %.2g, %.2g, %.2g, %.2g\n", worst[0], worst[1], worst[2], worst[3]);
    TEST(worst[0] < 4e-16 && worst[1] < 4e-16 && worst[2] < 8e-16 && worst[3] < 1e-14);
    TEST(vndf_exp(0.0) == 1.0 && vndf_exp(-0.0) == 1.0 && vndf_log(1.0) == 0.0 && vndf_log1p(0.0) == 0.0);
    TEST(vndf_exp(-746.0) == 0.0 && vndf_exp(-1e300) == 0.0 && vndf_exp(-INFINITY) == 0.0 && isnan(vndf_exp(NAN)));
    TEST(vndf_exp(710.0) == INFINITY && vndf_exp(1e300) == INFINITY && vndf_exp(709.0) < INFINITY);
    TEST_RELATIVE(vndf_exp(-705.0), (double)expl(-705.0L), 1e-15);
    TEST_RELATIVE(vndf_exp(709.0), (double)expl(709.0L), 1e-15);
    TEST_RELATIVE(vndf_exp(-720.0), (double)expl(-720.0L), 1e-10); /* a denormal has fewer digits */
    vndf_turn_of(1e4, &cosine, &sine);                             /* a whole number of turns to the bit */
    TEST(cosine == 1.0 && sine == 0.0);
    return test_done();
}
