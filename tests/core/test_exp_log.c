/* The library's own exp, log and log1p have the relative errors that src/math/exp_log.h states, over their whole
 * domains, and a cosine and a sine in turns are within 1e-14; the oracle is the C library in long double. */
#include "math/exp_log.h"
#include "math/turn.h"
#include "harness/test.h"

enum { POINTS = 400000 };
enum { EXP, LOG, LOG1P, TURN, CASES };

static double off(double got, long double want)
{
    return (double)fabsl(((long double)got - want) / want);
}

/* Of case i a random point: arguments of exp of every size, and of the logarithm near 1 too, where it is small and must
 * keep its digits; any angle. */
static double error_at(int which, int i, double u)
{
    const double v = 2 * u - 1, reach = i % 3 == 0 ? 700 : i % 3 == 1 ? 1 : 1e-6;
    const double x = i % 2 ? exp(700 * v) : 1 + v * ldexp(1, -i % 50), y = exp(60 * v), turns = 3 * u - 1;
    const long double angle = 6.283185307179586476925286766559L * turns;
    double cosine, sine;
    switch (which) {
    case EXP: return off(vndf_exp(reach * v), expl(reach * v));
    case LOG: return x == 1 || !(x > 0) ? 0 : off(vndf_log(x), logl(x));
    case LOG1P: return off(vndf_log1p(y), log1pl(y));
    default: vndf_turn_of(turns, &cosine, &sine);
    }
    return fmax((double)fabsl(cosine - cosl(angle)), (double)fabsl(sine - sinl(angle)));
}

int main(void)
{
    static const double limit[CASES] = {4e-16, 4e-16, 8e-16, 1e-14};
    unsigned long long state = 1;
    double cosine, sine;
    for (int which = 0; which < CASES; which++) {
        double worst = 0;
        for (int i = 0; i < POINTS; i++)
            worst = fmax(worst, error_at(which, i, test_uniform_double(&state)));
        fprintf(stderr, "%s: error %.2g\n", (const char *const[]){"exp", "log", "log1p", "turn"}[which], worst);
        TEST(worst < limit[which] && worst > 0);
    }
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
