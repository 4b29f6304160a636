#include "measured/brdf/power.h"

#include <math.h>

enum { STEPS = 60 };

static const double pi = 3.14159265358979323846;

/* A bin reaches half way to its neighbours, and the last one to 90 degrees. */
void power_even(power_bins *made, int count, double place)
{
    made->count = count;
    for (int i = 0; i < count; i++) {
        double at = i + place, from = fmax(at - 0.5, 0) / count, to = i + 1 < count ? (at + 0.5) / count : 1;
        made->theta[i] = pi / 2 * at * at / count / count;
        made->share[i] = cos(pi / 2 * from * from) - cos(pi / 2 * to * to);
    }
}

/* The integral over phi of |a + b cos(phi)|, b >= 0. */
static double around(double a, double b)
{
    return fabs(a) >= b ? 2 * pi * fabs(a) : 4 * (a * asin(a / b) + sqrt(b * b - a * a));
}

/* The integral of |w.m| D(m) dm. */
static double both_sides(const power_bins *bins, const double *ndf, double theta)
{
    double sum = 0;
    for (int i = 0; i < bins->count; i++)
        sum +=
            bins->share[i] * ndf[i] * around(cos(theta) * cos(bins->theta[i]), sin(theta) * sin(bins->theta[i]));
    return sum;
}

double power_normalise(const power_bins *bins, double *ndf)
{
    double whole = 0;
    for (int i = 0; i < bins->count; i++)
        whole += 2 * pi * bins->share[i] * cos(bins->theta[i]) * ndf[i];
    for (int i = 0; i < bins->count && whole > 0; i++)
        ndf[i] /= whole;
    return whole;
}

/* F0 D by f at bin i and the D so far, which has the integral 1. */
static double next_at(const power_bins *bins, power_masking masking, double f, const double *ndf, int i)
{
    double area = power_area(bins, ndf, bins->theta[i]), c = cos(bins->theta[i]);
    return 4 * f * (masking == POWER_SEPARABLE ? area * area : c * (2 * area - c));
}

int power_iterate(const power_bins *bins, power_masking masking, const double *f, double *ndf, double *f0)
{
    double before = 0, next[POWER_ANGLES];
    if (!(power_normalise(bins, ndf) > 0))
        for (int i = 0; i < bins->count; i++)
            ndf[i] = 1 / pi;
    *f0 = 0;
    for (int step = 0; step < STEPS && (step < 4 || fabs(*f0 - before) > 1e-10 * *f0); step++) {
        before = *f0;
        for (int i = 0; i < bins->count; i++)
            next[i] = f[i] >= 0 ? next_at(bins, masking, f[i], ndf, i) : i > 0 ? next[i - 1] : 0;
        *f0 = power_normalise(bins, next);
        if (!(*f0 > 0))
            return 0;
        for (int i = 0; i < bins->count; i++)
            ndf[i] = next[i];
    }
    return 1;
}

double power_area(const power_bins *bins, const double *ndf, double theta)
{
    return (both_sides(bins, ndf, theta) + cos(theta)) / 2;
}

double power_ndf(const power_bins *bins, const double *ndf, double theta)
{
    int low = 0, high = bins->count - 1;
    if (theta <= bins->theta[0])
        return ndf[0];
    if (theta >= bins->theta[high])
        return ndf[high];
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(bins->theta[middle] <= theta ? &low : &high) = middle;
    }
    double part = (theta - bins->theta[low]) / (bins->theta[high] - bins->theta[low]);
    if (ndf[low] > 0 && ndf[high] > 0)
        return exp((1 - part) * log(ndf[low]) + part * log(ndf[high]));
    return (1 - part) * ndf[low] + part * ndf[high];
}
