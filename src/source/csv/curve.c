/* The curve through the rows of a measured distribution, as csv.h says: Steffen's monotone cubic (slopes by eq. 11
 * inside, eqs. 24-29 at the ends, then Hermite's form), in Astronomy and Astrophysics 239 (1990). Its first
 * derivative is continuous, it never leaves the range of two neighbours, and it is exact for straight lines. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "source/csv/csv.h"
#include "source/source.h"

enum { BREAKS = 4096, OPERATIONS = 8 };

static const double ROUNDING_MOST = 1e-6; /* of P22: rows of six digits */

/* Points with x ascending, at least two, and dy/dx there. */
typedef struct curve {
    double *x, *y, *slope;
    size_t count;
} curve;

/* Of more rows than can be breaks: P22 r^2 over log r, and how far it strays from the chord to the next row. */
typedef struct many_rows {
    double *u, *f, *bend;
    size_t count;
} many_rows;

typedef struct csv_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_rows_over over;
    vndf_rows_of of;
    curve curve; /* over asinh(x/scale) */
    double scale;
    int logarithmic;   /* the curve is the logarithm of the second column */
    double last_slope; /* where the tail begins; infinite if the rows reach 90 degrees */
    double last_p22;
    double tail;         /* beyond it P22 falls as r^-tail */
    int falls_to_0;      /* the last row is 0 at 90 degrees, the row before is not 0 ... */
    double last_but_one; /* ... and stands at this slope */
    many_rows rows;      /* empty up to BREAKS rows */
    double *breaks;      /* owned: the block of all these numbers */
} csv_source;

/* ---- the cubic -------------------------------------------------------------------------------- */

/* The slope between the secants a and b of widths p and q: that of the parabola, reduced until both sides are monotone;
 * 0 at a local extremum. */
static double inner_slope(double a, double p, double b, double q)
{
    double parabola = fabs((a * q + b * p) / (p + q)), most = 2 * fmin(fabs(a), fabs(b));
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

static void fit_cubic(curve *c)
{
    size_t last = c->count - 1;
    double a = 0, p = 0; /* secant and width of the piece before */
    for (size_t i = 0; i < last; i++) {
        double q = c->x[i + 1] - c->x[i], b = (c->y[i + 1] - c->y[i]) / q;
        c->slope[i] = i > 0 ? inner_slope(a, p, b, q) : b;
        if (i == 1)
            c->slope[0] = end_slope(a, p, b, q);
        c->slope[last] = i > 0 ? end_slope(b, q, a, p) : b;
        a = b;
        p = q;
    }
}

/* The first place in ascending x beyond u. */
static size_t first_beyond(const double *x, size_t count, double u)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (x[middle] > u)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* The part of Hermite's form that comes from the slopes, at the part t of piece i; u is 1 - t. */
static double bend_at(const curve *c, size_t i, double t, double u)
{
    double h = c->x[i + 1] - c->x[i];
    return t * u * (u * (c->slope[i] * h) - t * (c->slope[i + 1] * h));
}

static double value_at(const curve *c, double x)
{
    size_t last = c->count - 1;
    if (!(x > c->x[0]))
        return c->y[0];
    if (x >= c->x[last])
        return c->y[last];
    size_t i = first_beyond(c->x, c->count, x) - 1;
    double t = (x - c->x[i]) / (c->x[i + 1] - c->x[i]), y0 = c->y[i], y1 = c->y[i + 1];
    double y = y0 + (y1 - y0) * t * t * (3 - 2 * t) + bend_at(c, i, t, 1 - t);
    /* Rounding alone could leave the range, and a density must not be negative. */
    return fmin(fmax(y, fmin(y0, y1)), fmax(y0, y1));
}

/* The value at the distance d before the last point, in the last piece, whose last value is 0. The values near it
 * keep all their digits, which those of value_at lose with x. */
static double value_before_end(const curve *c, double d)
{
    size_t i = c->count - 2;
    double u = d / (c->x[i + 1] - c->x[i]), y0 = c->y[i];
    return fmin(fmax(y0 * u * u * (3 - 2 * u) + bend_at(c, i, 1 - u, u), 0), y0);
}

/* ---- P22 -------------------------------------------------------------------------------------- */

/* cos(theta)^4 at the slope r: P22 = D c^4. */
static double cosine4(double r)
{
    double c = 1 / hypot(1, r), c2 = c * c;
    return c2 * c2;
}

/* Between the abscissas of the angle of the slope r and of 90 degrees: asinh a - asinh b for a^2 - b^2 that is
 * known with all its digits. */
static double distance_to_grazing(double scale, double r)
{
    double a = VNDF_RIGHT_ANGLE / scale, rest = atan(1 / r) / scale, b = a - rest;
    return asinh(rest * (a + b) / (a * hypot(1, b) + b * hypot(1, a)));
}

static double p22_at(const csv_source *source, double r)
{
    if (r > source->last_slope)
        return source->last_p22 == 0 ? 0 : source->last_p22 * pow(r / source->last_slope, -source->tail);
    double x = source->over == VNDF_ROWS_OVER_SLOPE ? r : atan(r);
    double y = source->falls_to_0 && r > source->last_but_one
                   ? value_before_end(&source->curve, distance_to_grazing(source->scale, r))
                   : value_at(&source->curve, asinh(x / source->scale));
    double value = source->logarithmic ? exp(y) : y;
    return source->of == VNDF_ROWS_OF_NDF ? value * cosine4(r) : value;
}

static void p22(const vndf_source *self, const double *r, size_t count, double *values)
{
    for (size_t i = 0; i < count; i++)
        values[i] = p22_at((const csv_source *)self, r[i]);
}

/* A bound of the integral of |f - chord| over [u0, u1]; f0 and f1 are f at the ends. It is 0 within one pair of
 * rows, where the rows say nothing more about the curve. */
static double stray_of(const many_rows *rows, double u0, double f0, double u1, double f1)
{
    double slope = (f1 - f0) / (u1 - u0), from = u0, off = 0.0, sum = 0.0, margin = 1e-9 * (u1 - u0) + 1e-13;
    size_t first = first_beyond(rows->u, rows->count, u0 + margin);
    size_t end = first_beyond(rows->u, rows->count, u1 - margin);
    for (size_t i = first; i < end; i++) {
        double here = fabs(rows->f[i] - f0 - slope * (rows->u[i] - u0));
        sum += (rows->u[i] - from) * (fmax(off, here) + (i > 0 ? rows->bend[i - 1] : 0.0));
        off = here;
        from = rows->u[i];
    }
    return end > first ? sum + (u1 - from) * (off + rows->bend[end - 1]) : 0.0;
}

/* Between rows that are breaks the curve is one cubic, or the exponential of one: a few points determine it. */
static vndf_reach reach(const vndf_source *self, double low, double high)
{
    const csv_source *source = (const csv_source *)self;
    vndf_reach at = {p22_at(source, low), p22_at(source, high), 0};
    if (source->rows.count)
        at.stray = stray_of(&source->rows, log(low), at.low * low * low, log(high), at.high * high * high);
    return at;
}

static void destroy(vndf_source *self)
{
    free(((csv_source *)self)->breaks);
    free(self->description);
    free(self);
}

/* ---- fits ------------------------------------------------------------------------------------- */

static double slope_of_row(const vndf_csv_rows *rows, size_t i)
{
    if (rows->over == VNDF_ROWS_OVER_SLOPE)
        return rows->x[i];
    return rows->x[i] >= VNDF_RIGHT_ANGLE ? INFINITY : tan(rows->x[i]);
}

static double p22_of_row(const vndf_csv_rows *rows, size_t i)
{
    return rows->of == VNDF_ROWS_OF_P22 ? rows->value[i] : rows->value[i] * cosine4(slope_of_row(rows, i));
}

static void fit_curve(csv_source *source, const vndf_csv_rows *rows)
{
    size_t last = rows->count - 1;
    double x = rows->x[last], first_step = rows->x[1] - rows->x[0], last_step = x - rows->x[last - 1];
    source->scale = fmax(x * fmin(fmax(first_step / last_step, 1e-12), 1e3), DBL_MIN);
    source->logarithmic = 1;
    for (size_t i = 0; i <= last; i++)
        source->logarithmic &= rows->value[i] > 0;
    for (size_t i = 0; i <= last; i++) {
        source->curve.x[i] = asinh(rows->x[i] / source->scale);
        source->curve.y[i] = source->logarithmic ? log(rows->value[i]) : rows->value[i];
    }
    fit_cubic(&source->curve);
}

static void fit_tail(csv_source *source, const vndf_csv_rows *rows)
{
    size_t last = rows->count - 1;
    double before = slope_of_row(rows, last - 1), p22_before = p22_of_row(rows, last - 1);
    source->last_slope = slope_of_row(rows, last);
    source->last_p22 = p22_of_row(rows, last);
    source->tail = 4;
    source->last_but_one = before;
    source->falls_to_0 = isinf(source->last_slope) && rows->value[last] == 0 && rows->value[last - 1] > 0;
    if (before > 0 && p22_before > 0 && source->last_p22 > 0 && isfinite(source->last_slope))
        source->tail = fmax(4, log(p22_before / source->last_p22) / log(source->last_slope / before));
}

/* The slopes of the rows except 0 and infinity; if there are too many, every n-th. */
static void fill_breaks(csv_source *source, const vndf_csv_rows *rows)
{
    size_t count = rows->count < BREAKS ? rows->count : BREAKS;
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        double slope = slope_of_row(rows, i * (rows->count - 1) / (count - 1));
        if (slope > 0 && isfinite(slope))
            source->breaks[kept++] = slope;
    }
    source->base.breaks = source->breaks;
    source->base.break_count = kept;
}

/* Leaves out rows at slope 0 and at 90 degrees. */
static void fill_rows(csv_source *source, const vndf_csv_rows *given)
{
    many_rows *rows = &source->rows;
    const curve *c = &source->curve;
    for (size_t i = 0; i < given->count; i++) {
        double r = slope_of_row(given, i), f = p22_of_row(given, i) * r * r, bend = 0;
        if (!(r > 0) || !isfinite(r))
            continue;
        if (i + 1 < given->count) { /* of the curve from its chord, in its own unit */
            double h = c->x[i + 1] - c->x[i], rise = c->y[i + 1] - c->y[i];
            bend = 4.0 / 27 * (fabs(c->slope[i] * h - rise) + fabs(c->slope[i + 1] * h - rise));
        }
        double unit = source->logarithmic ? f : given->value[i] > 0 ? f / given->value[i] : 0;
        rows->u[rows->count] = log(r);
        rows->f[rows->count] = f;
        rows->bend[rows->count++] = bend * unit;
    }
}

/* How far rounding moves the rows, relative: two standard deviations. The last digits of many rows make fourth
 * differences of 6.7 standard deviations in the mean. Differences above ROUNDING_MOST do not come from
 * rounding. */
static double rounding_of(const csv_source *source)
{
    const double *y = source->curve.y;
    double sum = 0, most = 0;
    for (size_t i = 2; i + 2 < source->curve.count; i++) {
        sum += fabs(y[i - 2] - 4 * y[i - 1] + 6 * y[i] - 4 * y[i + 1] + y[i + 2]);
        most = fmax(most, fabs(y[i]));
    }
    double deviation = sum / (double)source->curve.count / 6.7;
    return fmin(2 * deviation / (source->logarithmic ? 1 : fmax(most, DBL_MIN)), ROUNDING_MOST);
}

vndf_source *vndf_csv_source(const vndf_csv_rows *rows, char *description, vndf_error *error)
{
    csv_source *source = calloc(1, sizeof *source);
    size_t n = rows->count;
    double *block = malloc(((n > BREAKS ? 6 : 3) * n + BREAKS) * sizeof *block);
    if (!source || !block) {
        free(source);
        free(block);
        free(description);
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %zu rows", n);
        return NULL;
    }
    source->base = (vndf_source){
        .p22 = p22, .destroy = destroy, .description = description, .operations = OPERATIONS, .reach = reach};
    source->over = rows->over;
    source->of = rows->of;
    source->breaks = block;
    source->curve = (curve){block + BREAKS, block + BREAKS + n, block + BREAKS + 2 * n, n};
    fit_curve(source, rows);
    fit_tail(source, rows);
    fill_breaks(source, rows);
    if (n > BREAKS) {
        source->rows = (many_rows){block + BREAKS + 3 * n, block + BREAKS + 4 * n, block + BREAKS + 5 * n, 0};
        fill_rows(source, rows);
        source->base.rounding = rounding_of(source);
    }
    return &source->base;
}
