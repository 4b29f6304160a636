/* The map from numbers to normals is continuous, and monotone in each number but for rounding, but at the seam behind
 * wi: of tables u1 turns the azimuth of the stretched normal and u2 moves its slope, of GGX they do so with the
 * mirrored direction, of Beckmann u1 moves the slope along wi and u2 that across. Steps of a number are halved towards
 * the largest change until they are 2^-23. It notices a jump where two cells, two sides or two formulas meet. */
#include "sampler/seen.h"

/* What u1 moves (which 0) and what u2 moves. */
static double coordinate(const seen *s, int which, vndf_vec3 wm)
{
    const slope_frame f = slope_frame_from(&s->of.lobe[0].surface, s->wi, 0);
    double n[3], length = hypot(f.s, f.c), facing;
    slope_over(&f, wm, n);
    if (s->of.lobe[0].surface.distribution == vndf_beckmann())
        return n[which] / n[2];
    if (s->of.lobe[0].surface.distribution == vndf_ggx()) {
        facing = (f.s * n[0] + f.c * n[2]) / length;
        n[0] = 2 * facing * n[0] - f.s / length;
        n[1] = 2 * facing * n[1];
        n[2] = 2 * facing * n[2] - f.c / length;
        return which ? -n[2] : atan2(n[1], n[0]);
    }
    return which ? hypot(n[0], n[1]) / n[2] : atan2(n[1], n[0]);
}

static vndf_vec3 at(const seen *s, int which, double u, double other)
{
    return which ? seen_draw(s, (float)other, (float)u, NULL) : seen_draw(s, (float)u, (float)other, NULL);
}

/* Between unit normals over the roughness, where the slope is at most 100. */
static double change(const seen *s, int which, double u, double v, double other)
{
    const slope_frame f = slope_frame_from(&s->of.lobe[0].surface, s->wi, 0);
    return seen_apart(&f, at(s, which, u, other), at(s, which, v, other));
}

static double largest_jump(const seen *s, int which, double u, double v, double other)
{
    while (v - u > 0x1p-23) {
        double middle = (u + v) / 2;
        if (change(s, which, u, middle, other) > change(s, which, middle, v, other))
            v = middle;
        else
            u = middle;
    }
    return change(s, which, u, v, other);
}

/* How much falls that should rise, beyond 2e-6 of it and what four roundings of the number do; of an azimuth, or a
 * slope of Beckmann's, which may be 0, beyond 2e-6 more: normals are rounded. */
static double falls(const seen *s, int which, double sign, double u, double v, double other)
{
    double a = coordinate(s, which, at(s, which, u, other)), b = coordinate(s, which, at(s, which, v, other));
    double slack = fabs(coordinate(s, which, at(s, which, u + 0x1p-22, other)) -
                        coordinate(s, which, at(s, which, u - 0x1p-22, other)));
    int may_be_0 = !which || s->of.lobe[0].surface.distribution == vndf_beckmann();
    return sign * (a - b) - slack - 2e-6 * (fabs(a) + (may_be_0 ? 1 : 0));
}

static void test_view(const seen *s, const char *name, int pairs, unsigned long long *state)
{
    for (int i = 0; i < pairs; i++) {
        int which = i % 2;
        double other = random_between(state, 1e-3, 1 - 1e-3), step = random_decade(state, -6, -1);
        double u = random_between(state, 1e-3, 1 - 1e-3 - step), v = u + step;
        double low = coordinate(s, which, at(s, which, 0.25, other)),
               high = coordinate(s, which, at(s, which, 0.75, other));
        double fall = falls(s, which, high > low ? 1 : -1, u, v, other),
               jump = largest_jump(s, which, u, v, other);
        if (TEST(fall <= 0) & TEST(jump < 1e-3))
            continue;
        seen_print(s, name);
        fprintf(stderr, "    u%d %.9g to %.9g, other %.9g: falls by %.3g, jumps by %.3g\n", which + 1, u, v, other,
                fall, jump);
    }
}

static void test_subject(const subject *of, size_t index)
{
    static const double thetas[] = {1, 30, 60, 85, 89.99, 90, 90.01, 92, 100, 130};
    unsigned long long state = 4 + index;
    for (size_t j = 0; j < 20; j++) {
        seen s = seen_surface(of->d, j % 2 ? 0.3f : 1, j % 4 < 2 ? 0.3f : 1,
                              oracle_direction(thetas[j / 2], 17.0 * (double)j));
        if (seen_quantity(&s, AREA, s.wi) > 1e-4f)
            test_view(&s, of->name, (int)test_amount(100, 400, 5000), &state);
    }
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
