/* Given its slope R, the azimuth a of a table's sample solves Kepler's equation: c a + s R sin a is the part |2 u1 - 1|
 * of what it is at the end of the arc that is seen, within 3e-5 at worst and 2e-7 in the mean, above the horizon and
 * below it, but for what the rounding of the normal does to a short arc. It notices a start or a step of the solver
 * that is too coarse. */
#include "sampler/seen.h"

static double arc_of(double c, double k)
{
    return k <= fabs(c) ? PI : 2 * atan2(sqrt(k + c), sqrt(k - c));
}

/* |C a + K sin a|/(C A + K sin A); differences as products, for arcs that are small. */
static double part_of(double c, double k, double a)
{
    double end = arc_of(c, k), part[2];
    for (int i = 0; i < 2; i++) {
        double x = i ? end : fabs(a),
               cube =
                   x > 0.1 ? x - sin(x) : x * x * x / 6 * (1 - x * x / 20 * (1 - x * x / 42 * (1 - x * x / 72)));
        part[i] = (c + k) * x - k * cube;
    }
    return part[0] / part[1];
}

int main(int arguments, char **argument)
{
    for (size_t i = 2; i < SUBJECT_COUNT; i++) {
        unsigned long long state = 8;
        double worst = 0, sum = 0, count = 0, at[3] = {0};
        subject of = subject_open(i);
        for (size_t n = 0; of.d && n < test_amount(20000, 200000, 5000000); n++) {
            vndf_vec3 wi = random_direction(&state, -0.7), level = {wi.x, wi.y, 0};
            seen s = seen_surface(of.d, 1, 1, wi);
            float u1 = test_uniform(&state), u2 = test_uniform(&state);
            u1 = n % 10 == 0   ? (float)random_decade(&state, -7, 0)
                 : n % 10 == 1 ? 0.5f + (float)random_decade(&state, -7, -0.31)
                               : u1;
            if (!oracle_wanted(arguments, argument, i, of.name) ||
                seen_area(&s, wi) < 1e-6f * seen_area(&s, level))
                continue;
            slope_frame f = seen_frame(&s);
            vndf_vec3 wm = seen_draw(&s, u1, u2, NULL);
            if (wm.z < 1e-4f) /* there the azimuth has fewer digits */
                continue;
            double x = f.x * wm.x + f.y * wm.y, y = f.x * wm.y - f.y * wm.x, r = hypot(x, y) / (f.xx * wm.z);
            double error = fabs(part_of(f.c, f.s * r, atan2(y, x)) - fabs(2 * (double)u1 - 1)),
                   arc = arc_of(f.c, f.s * r);
            error = fmax(0, error - 1e-6 / (arc * arc));
            sum += error, count += 1;
            if (!(error <= worst))
                worst = error, at[0] = (double)wi.z, at[1] = (double)u1, at[2] = (double)u2;
        }
        if (!(TEST(worst < 3e-5) & TEST(sum <= 2e-7 * count)) || test_long())
            fprintf(stderr, "  %s: worst %.3g (wi.z %.9g, u %.9g %.9g), mean %.3g\n", of.name, worst, at[0], at[1],
                    at[2], sum / count);
        vndf_free(of.owned);
    }
    return test_done();
}
