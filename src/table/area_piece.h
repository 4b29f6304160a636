/* One piece of the spline of a wedge's mass: the quintic with given values, slopes and second derivatives at its
 * ends, as Bernstein coefficients times their binomials. None is below the one before: so the mass ascends, as it
 * must, and nothing cancels where it changes by orders of magnitude within a piece. The mass is twice an integral
 * of D along lines: its second derivative is a plain integral of D, and known. */
#ifndef VNDF_TABLE_AREA_PIECE_H
#define VNDF_TABLE_AREA_PIECE_H

#include "simd/doubles.h"
#include "simd/lanes_lines.h"
#include "table/guide.h"
#include "table/table.h"

typedef struct vndf_area_knot {
    double mass, slope, curve;
} vndf_area_knot;

VNDF_INLINE double vndf_area_between(double value, double least, double most)
{
    return value > least ? (value < most ? value : most) : least;
}

VNDF_INLINE void vndf_area_piece(double width, vndf_area_knot a, vndf_area_knot b,
                                 double coefficient[VNDF_AREA_ORDER])
{
    double a1 = a.mass + width * a.slope / 5, b1 = b.mass - width * b.slope / 5;
    double a2 = 2 * a1 - a.mass + width * width * a.curve / 20;
    double b2 = 2 * b1 - b.mass + width * width * b.curve / 20;
    a1 = vndf_area_between(a1, a.mass, b.mass);
    a2 = vndf_area_between(a2, a1, b.mass);
    b1 = vndf_area_between(b1, a2, b.mass);
    b2 = vndf_area_between(b2, a2, b1);
    double made[VNDF_AREA_ORDER] = {a.mass, 5 * a1, 10 * a2, 10 * b2, 5 * b1, b.mass};
    for (int i = 0; i < VNDF_AREA_ORDER; i++)
        coefficient[i] = made[i];
}

/* The piece at t in [0, 1]. */
VNDF_INLINE doubles vndf_area_piece_at(const doubles coefficient[VNDF_AREA_ORDER], doubles t)
{
    const doubles *b = coefficient;
    doubles u = 1.0 - t, uu = u * u, ut = u * t, tt = t * t;
    return uu * u * (uu * b[0] + (ut * b[1] + tt * b[2])) + tt * t * (uu * b[3] + (ut * b[4] + tt * b[5]));
}

/* Powers of the distance from a knot in float. The mass, its slope and its second derivative are not below 0, so that
 * the first three are sums of what is not; the others hardly cancel. */
VNDF_INLINE lanes_f vndf_area_quick_sum(const lanes_f b[VNDF_AREA_ORDER], lanes_f t)
{
    lanes_f square = t * t;
    return ((b[0] + b[1] * t) + square * (b[2] + b[3] * t)) + square * square * (b[4] + b[5] * t);
}

/* Piece i, within 3e-7 of the mass but for the rounding of y, which counts where one over its width is large. */
VNDF_INLINE lanes_f vndf_area_quick_at(const vndf_area_quick *piece, lanes_u i, lanes_f y, lanes_f *per_width)
{
    lanes_lines lines = lanes_lines_at(piece->coefficient, sizeof *piece / sizeof(float), i);
    lanes_four from = lanes_load_four(&lines, 0), to = lanes_load_four(&lines, 4);
    lanes_f b[VNDF_AREA_ORDER] = {from.a, from.b, from.c, from.d, to.a, to.b};
    *per_width = to.d;
    return vndf_area_quick_sum(b, y - to.c);
}

/* Where there are `count` knots and no more than VNDF_FEW pieces: read in registers. */
VNDF_INLINE lanes_f vndf_area_few_at(const float *few, uint32_t pitch, uint32_t count, lanes_f y,
                                     lanes_f *per_width)
{
    const float *begin = few + VNDF_AREA_ORDER * pitch;
    lanes_u i = vndf_guide_count(begin, count, y);
    lanes_f b[VNDF_AREA_ORDER];
    for (int n = 0; n < VNDF_AREA_ORDER; n++)
        b[n] = lanes_few(few + (uint32_t)n * pitch, count - 1, i);
    *per_width = lanes_few(begin + pitch, count - 1, i);
    return vndf_area_quick_sum(b, y - lanes_few(begin, count - 1, i));
}

#endif
