#include "measured/surface/heights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int heights_make(height_field *made, int width, int height, const char *name, refusal *why)
{
    *made = (height_field){0, 0, 1, 1, 0, NULL};
    if (width < 3 || height < 3 || width > HEIGHTS_SIDE_MAX || height > HEIGHTS_SIDE_MAX)
        return refuse_data(why, name, "%d x %d heights; both sides must be from 3 to %d", width, height,
                           HEIGHTS_SIDE_MAX);
    if ((size_t)width * (size_t)height > HEIGHTS_MAX)
        return refuse_data(why, name, "%d x %d heights are more than %d", width, height, HEIGHTS_MAX);
    made->z = malloc((size_t)width * (size_t)height * sizeof *made->z);
    if (!made->z)
        return refuse_data(why, name, "there is no memory for %d x %d heights", width, height);
    made->width = width;
    made->height = height;
    return 1;
}

void heights_free(height_field *freed)
{
    free(freed->z);
    *freed = (height_field){0, 0, 0, 0, 0, NULL};
}

/* ---- cut-off ------------------------------------------------------------------------------------- */

/* The mean of the numbers that are there, weighed by kernel[|i - at|], of `count` numbers `stride` apart. */
static double weighed(const float *line, size_t stride, int count, int at, const double *kernel, int reach)
{
    double sum = 0, whole = 0;
    for (int i = at - reach < 0 ? 0 : at - reach; i <= at + reach && i < count; i++) {
        double z = (double)line[(size_t)i * stride], w = kernel[i < at ? at - i : i - at];
        if (isnan(z))
            continue;
        sum += w * z;
        whole += w;
    }
    return whole > 0 ? sum / whole : NAN;
}

static void smooth_line(float *line, size_t stride, int count, const double *kernel, int reach, float *room)
{
    for (int i = 0; i < count; i++)
        room[i] = isnan(line[(size_t)i * stride]) ? NAN : (float)weighed(line, stride, count, i, kernel, reach);
    for (int i = 0; i < count; i++)
        line[(size_t)i * stride] = room[i];
}

/* exp(-pi (x/(a cutoff))^2), a = sqrt(ln 2/pi): half is left of a wave as long as the cut-off. */
int heights_smooth(height_field *changed, int cutoff)
{
    double kernel[CUTOFF_MAX + 1], a2 = log(2) / 3.14159265358979323846;
    int longer = changed->width > changed->height ? changed->width : changed->height;
    float *room = malloc((size_t)longer * sizeof *room);
    if (!room)
        return 0;
    for (int i = 0; i <= cutoff; i++)
        kernel[i] = exp(-3.14159265358979323846 * i * i / (a2 * cutoff * cutoff));
    for (int y = 0; y < changed->height; y++)
        smooth_line(changed->z + (size_t)y * (size_t)changed->width, 1, changed->width, kernel, cutoff, room);
    for (int x = 0; x < changed->width; x++)
        smooth_line(changed->z + x, (size_t)changed->width, changed->height, kernel, cutoff, room);
    free(room);
    changed->quantum = 0;
    return 1;
}

/* ---- slopes -------------------------------------------------------------------------------------- */

static double difference(const float *z, size_t stride)
{
    return (double)z[stride] - (double)*(z - stride);
}

/* One of 8 x 8 equal parts of the grid. */
static int part_of(const height_field *of, int x, int y)
{
    return (int)((long)y * 8 / of->height) * 8 + (int)((long)x * 8 / of->width);
}

int heights_slopes(const height_field *of, int margin, const char *name, slope_set *made, refusal *why)
{
    size_t width = (size_t)of->width;
    int rim = margin > 0 ? margin : 1;
    if (2 * rim >= of->width || 2 * rim >= of->height)
        return refuse_data(why, name, "%d x %d heights: nothing is left inside a rim of %d, half the cut-off",
                           of->width, of->height, rim);
    if (!slopes_make(made, width * (size_t)of->height))
        return refuse_data(why, name, "there is no memory for %d x %d slopes", of->width, of->height);
    made->quantum = of->quantum / 2 / fmax(of->step_x, of->step_y);
    for (int y = rim; y < of->height - rim; y++)
        for (int x = rim; x < of->width - rim; x++) {
            const float *z = of->z + (size_t)y * width + (size_t)x;
            double sx = difference(z, 1) / (2 * of->step_x), sy = difference(z, width) / (2 * of->step_y);
            if (fabs(sx) <= 1e30 && fabs(sy) <= 1e30) /* false for NaN */
                slopes_add(made, sx, sy, part_of(of, x, y));
        }
    return 1;
}

/* ---- Smith's assumption -------------------------------------------------------------------------- */

enum { SMITH_BINS = 24, LEAD_IN = 8 }; /* the first part of a line hides others, and nothing hides it */

static const double SMITH_RANGE = 4; /* slopes over their rms that bins are for; what is steeper joins the last */

typedef struct smith {
    double cotangent, rms;
    double facing[SMITH_BINS], seen[SMITH_BINS]; /* projected area over slopes */
} smith;

/* A line of the grid, seen from its beginning: a place is seen if no place before it is above the ray. */
static void look_along(const float *z, ptrdiff_t stride, int count, double step, smith *s)
{
    double highest = -INFINITY; /* of z - cot * distance: what the place has to reach */
    for (int i = 0; i < count; i++) {
        double here = (double)z[i * stride] + s->cotangent * step * i; /* the ray falls towards later places */
        int is_seen = here >= highest;
        if (isnan(here)) {
            highest = -INFINITY;
            continue;
        }
        highest = fmax(highest, here);
        if (i < count / LEAD_IN || i == 0 || i + 1 == count)
            continue;
        double slope = ((double)z[(i + 1) * stride] - (double)z[(i - 1) * stride]) / (2 * step);
        double area = s->cotangent + slope; /* rising away from the eye it faces it */
        if (!(area > 0))
            continue;
        double place = (slope / s->rms / SMITH_RANGE + 1) / 2 * SMITH_BINS;
        int bin = place < 0 ? 0 : place < SMITH_BINS ? (int)place : SMITH_BINS - 1;
        s->facing[bin] += area;
        s->seen[bin] += is_seen ? area : 0;
    }
}

static double total_variation(const smith *s)
{
    double facing = 0, seen = 0, off = 0;
    for (int i = 0; i < SMITH_BINS; i++) {
        facing += s->facing[i];
        seen += s->seen[i];
    }
    if (!(facing > 0) || !(seen > 0))
        return -1;
    for (int i = 0; i < SMITH_BINS; i++)
        off += fabs(s->facing[i] / facing - s->seen[i] / seen) / 2;
    return off;
}

static double rms_along(const height_field *of)
{
    double square = 0, count = 0;
    for (int y = 0; y < of->height; y++)
        for (int x = 1; x + 1 < of->width; x++) {
            double slope = difference(of->z + (size_t)y * (size_t)of->width + x, 1) / (2 * of->step_x);
            if (isnan(slope))
                continue;
            square += slope * slope;
            count++;
        }
    return count > 0 ? sqrt(square / count) : 0;
}

double heights_smith(const height_field *of, double elevation)
{
    smith s = {.cotangent = 1 / tan(elevation), .rms = rms_along(of)};
    ptrdiff_t width = of->width;
    if (!(s.rms > 0))
        return -1;
    for (int y = 0; y < of->height; y++) {
        const float *row = of->z + y * width;
        look_along(row, 1, of->width, of->step_x, &s);
        look_along(row + width - 1, -1, of->width, of->step_x, &s);
    }
    for (int x = 0; x < of->width; x++) {
        look_along(of->z + x, width, of->height, of->step_y, &s);
        look_along(of->z + x + (of->height - 1) * width, -width, of->height, of->step_y, &s);
    }
    return total_variation(&s);
}
