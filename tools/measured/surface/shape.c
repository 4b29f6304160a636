#include "measured/surface/shape.h"

#include <math.h>
#include <string.h>

#include "cli/random.h"

enum { STEPS = 60, DRAWS = 200 };

static const double RATIO_MOST = 100;

typedef struct symmetric {
    double xx, xy, yy;
} symmetric;

static double determinant(symmetric m)
{
    return m.xx * m.yy - m.xy * m.xy;
}

static symmetric scaled(symmetric m, double by)
{
    return (symmetric){by * m.xx, by * m.xy, by * m.yy};
}

static symmetric inverse(symmetric m)
{
    return scaled((symmetric){m.yy, -m.xy, m.xx}, 1 / determinant(m));
}

/* Of a matrix with determinant 1: (V + 1)/sqrt(trace V + 2), by Cayley and Hamilton. */
static symmetric root(symmetric v)
{
    double by = 1 / sqrt(v.xx + v.yy + 2);
    return (symmetric){by * (v.xx + 1), by * v.xy, by * (v.yy + 1)};
}

/* The larger axis of V^1/2 over the smaller. */
static double ratio_of(symmetric v)
{
    double middle = (v.xx + v.yy) / 2, away = hypot((v.xx - v.yy) / 2, v.xy);
    return middle > away ? sqrt((middle + away) / (middle - away)) : INFINITY;
}

/* The sums of s s^T / (s^T V^-1 s) over the slopes of each part. */
static void sum_parts(const slope_set *slopes, symmetric v, symmetric part[SLOPE_PARTS])
{
    symmetric w = inverse(v);
    memset(part, 0, SLOPE_PARTS * sizeof *part);
    for (size_t i = 0; i < slopes->count; i++) {
        double x = (double)slopes->x[i], y = (double)slopes->y[i];
        double square = w.xx * x * x + 2 * w.xy * x * y + w.yy * y * y;
        symmetric *to = &part[slopes->part[i]];
        if (!(square > 0))
            continue;
        to->xx += x * x / square;
        to->xy += x * y / square;
        to->yy += y * y / square;
    }
}

static void add(symmetric *to, symmetric more)
{
    to->xx += more.xx;
    to->xy += more.xy;
    to->yy += more.yy;
}

static symmetric unit(symmetric m)
{
    return scaled(m, 1 / sqrt(determinant(m)));
}

/* One step from the solution moves about half as far as the solution itself does when parts are drawn again (the
 * derivative of Tyler's map in two dimensions), so the spread counts twice. */
static double error_of(const symmetric part[SLOPE_PARTS], symmetric v)
{
    random_stream stream = random_from(2);
    symmetric across = inverse(root(v));
    double square = 0;
    for (int draw = 0; draw < DRAWS; draw++) {
        symmetric sum = {0, 0, 0};
        for (int i = 0; i < SLOPE_PARTS; i++)
            add(&sum, part[random_bits(&stream) % SLOPE_PARTS]);
        if (!(determinant(sum) > 0))
            continue;
        sum = unit(sum);
        /* In the frame where V is 1 the sum is 1 but for chance. */
        double a = across.xx * sum.xx + across.xy * sum.xy, b = across.xx * sum.xy + across.xy * sum.yy;
        double c = across.xy * sum.xx + across.yy * sum.xy, d = across.xy * sum.xy + across.yy * sum.yy;
        symmetric whitened = {a * across.xx + b * across.xy, a * across.xy + b * across.yy,
                              c * across.xy + d * across.yy};
        /* For isotropic slopes the two components of the distortion spread alike; each is a deviation of the ratio. */
        double stretch = (whitened.xx - whitened.yy) / 2;
        square += (stretch * stretch + whitened.xy * whitened.xy) / 2 / DRAWS;
    }
    return 2 * sqrt(square);
}

int shape_of(const slope_set *slopes, const char *name, slope_shape *shape, refusal *why)
{
    symmetric v = {1, 0, 1}, part[SLOPE_PARTS];
    double change = 1;
    for (int step = 0; step < STEPS && change > 1e-7; step++) {
        symmetric sum = {0, 0, 0};
        sum_parts(slopes, v, part);
        for (int i = 0; i < SLOPE_PARTS; i++)
            add(&sum, part[i]);
        if (!(determinant(sum) > 0))
            return refuse_data(why, name,
                               "the slopes lie on a line: grooves that are all parallel have no D of two "
                               "dimensions");
        sum = unit(sum);
        change = fabs(sum.xx - v.xx) + fabs(sum.xy - v.xy) + fabs(sum.yy - v.yy);
        v = sum;
        if (!(ratio_of(v) < RATIO_MOST))
            return refuse_data(why, name,
                               "the slopes lie nearly on a line, %.3g times as wide one way as the other; "
                               "%.0f times is the most",
                               ratio_of(v), RATIO_MOST);
    }
    symmetric m = root(v), back = inverse(m);
    *shape = (slope_shape){{m.xx, m.xy, m.yy}, {back.xx, back.xy, back.yy}, ratio_of(v), 0};
    shape->error = shape->ratio * error_of(part, v);
    return 1;
}
