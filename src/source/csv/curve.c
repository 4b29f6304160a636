/* Steffen's monotone cubic: slopes (eq. 11 inside, eqs. 24-29 at the ends), then Hermite's form. */
#include "source/csv/curve.h"

#include <math.h>
#include <stdlib.h>

int vndf_curve_allocate(vndf_curve *curve, size_t count)
{
    *curve = (vndf_curve){NULL, NULL, NULL, 0};
    if (count > (size_t)-1 / (3 * sizeof *curve->x))
        return 0;
    curve->x = malloc(3 * count * sizeof *curve->x);
    if (!curve->x)
        return 0;
    curve->y = curve->x + count;
    curve->slope = curve->y + count;
    curve->count = count;
    return 1;
}

void vndf_curve_free(vndf_curve *curve)
{
    free(curve->x);
    *curve = (vndf_curve){NULL, NULL, NULL, 0};
}

static double secant(const vndf_curve *curve, size_t i)
{
    return (curve->y[i + 1] - curve->y[i]) / (curve->x[i + 1] - curve->x[i]);
}

/* The slope of the parabola at a point between the secants a and b of widths p and q, reduced until both sides are
 * monotone; 0 at a local extremum. */
static double inner_slope(double a, double p, double b, double q)
{
    double parabola = fabs((a * q + b * p) / (p + q));
    double most = 2 * fmin(fabs(a), fabs(b));
    return (a > 0) != (b > 0) ? 0 : copysign(fmin(parabola, most), a);
}

/* The same at an end, whose secant is a; b is the next one. */
static double end_slope(double a, double p, double b, double q)
{
    double parabola = a + (a - b) * p / (p + q);
    if ((parabola > 0) != (a > 0))
        return 0;
    return fabs(parabola) > 2 * fabs(a) ? 2 * a : parabola;
}

void vndf_curve_fit(vndf_curve *curve)
{
    const double *x = curve->x;
    size_t last = curve->count - 1;
    if (last == 1) {
        curve->slope[0] = curve->slope[1] = secant(curve, 0);
        return;
    }
    for (size_t i = 1; i < last; i++)
        curve->slope[i] = inner_slope(secant(curve, i - 1), x[i] - x[i - 1], secant(curve, i), x[i + 1] - x[i]);
    curve->slope[0] = end_slope(secant(curve, 0), x[1] - x[0], secant(curve, 1), x[2] - x[1]);
    curve->slope[last] = end_slope(secant(curve, last - 1), x[last] - x[last - 1], secant(curve, last - 2),
                                   x[last - 1] - x[last - 2]);
}

/* The piece i with x[i] <= x < x[i + 1]. */
static size_t piece(const vndf_curve *curve, double x)
{
    size_t low = 0, high = curve->count - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (curve->x[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double vndf_curve_value(const vndf_curve *curve, double x)
{
    size_t last = curve->count - 1;
    if (!(x > curve->x[0]))
        return curve->y[0];
    if (x >= curve->x[last])
        return curve->y[last];
    size_t i = piece(curve, x);
    double h = curve->x[i + 1] - curve->x[i], t = (x - curve->x[i]) / h, u = 1 - t;
    double y0 = curve->y[i], y1 = curve->y[i + 1];
    double bend = t * u * (u * (curve->slope[i] * h) - t * (curve->slope[i + 1] * h));
    double y = y0 + (y1 - y0) * t * t * (3 - 2 * t) + bend;
    /* Rounding alone could leave the range, and a density must not be negative. */
    return fmin(fmax(y, fmin(y0, y1)), fmax(y0, y1));
}

double vndf_curve_before_end(const vndf_curve *curve, double d)
{
    size_t last = curve->count - 1;
    double h = curve->x[last] - curve->x[last - 1], u = d / h, t = 1 - u;
    double y0 = curve->y[last - 1];
    double bend = t * u * (u * (curve->slope[last - 1] * h) - t * (curve->slope[last] * h));
    return fmin(fmax(y0 * u * u * (3 - 2 * u) + bend, 0), y0);
}
