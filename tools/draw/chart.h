/* Charts: axes with ticks, a key, curves, points with labels beside them that avoid each other.
 *
 * Colours are classes, so that a page or a file of its own can change them for dark screens: chart_style writes
 * the rules. The palette is that of M. Okabe and K. Ito, "Color Universal Design" (2008), which people with any
 * kind of colour vision tell apart; series differ in mark or dashes as well. */
#ifndef TOOLS_DRAW_CHART_H
#define TOOLS_DRAW_CHART_H

#include <stddef.h>
#include <stdio.h>

typedef enum chart_scale { CHART_LINEAR, CHART_LOG } chart_scale;

typedef struct chart_axis {
    chart_scale scale;
    double low, high;  /* low > 0 on logarithmic scales */
    double step;       /* between the ticks of a linear axis */
    const char *label; /* with its unit */
} chart_axis;

typedef enum chart_mark { CHART_NO_MARK, CHART_DOT, CHART_RING, CHART_SQUARE, CHART_TRIANGLE } chart_mark;

typedef enum chart_line { CHART_NO_LINE, CHART_SOLID, CHART_DASHED, CHART_DOTTED } chart_line;

typedef struct chart_series {
    const double *x, *y; /* what is not finite, or outside, interrupts the curve */
    size_t count;
    unsigned colour; /* of the palette, 0 to CHART_COLOURS - 1 */
    chart_mark mark;
    chart_line line;
    const char *const *texts; /* NULL, or a label beside each point (an empty one is none) */
} chart_series;

/* An entry of the key below the title; without mark and line a stroke shows the colour. */
typedef struct chart_key {
    const char *text;
    unsigned colour;
    chart_mark mark;
    chart_line line;
} chart_key;

enum { CHART_COLOURS = 5 }; /* blue, orange, green, violet, grey */

typedef struct chart {
    const char *title;    /* above the frame */
    double left, top;     /* where it stands in a larger picture */
    double width, height; /* of all, pixels */
    chart_axis x, y;
    const char *zero; /* NULL, or the name of a band below the frame for y = 0 on a logarithmic axis */
    double band;      /* its height */
    const chart_series *series;
    size_t count;
    const chart_key *key;
    size_t key_count;
} chart;

/* As an <svg> element, or as a file of its own with the colours inside. */
void chart_draw(FILE *file, const chart *c);
void chart_draw_alone(FILE *file, const chart *c);

/* The head of a file of its own: colours, and a background. */
void chart_begin_alone(FILE *file, double width, double height, const char *about);

/* The rules for the classes, those for dark screens included. */
void chart_style(FILE *file);

/* Fits logarithmic axes to all series but for what is unbounded, by whole decades: of y at most so many. */
void chart_fit(chart *c, double decades);

#endif
