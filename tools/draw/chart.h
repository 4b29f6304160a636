/* Charts for the report: axes with ticks, curves with direct labels at their ends, points with labels beside them.
 *
 *   chart_draw      frame, grid, series (chart.c)
 *   chart_place     where a value lies on an axis (chart_axis.c)
 *   chart_ticks     which values are marked, and their names
 *   chart_label_*   texts that avoid each other and the marks (chart_label.c)
 *
 * Colours are classes, so that a page or a file of its own can change them for dark screens: chart_style writes
 * the rules. The palette is that of M. Okabe and K. Ito, "Color Universal Design" (2008), which people with any
 * kind of colour vision tell apart; series differ in mark or dashes as well. */
#ifndef TOOLS_DRAW_CHART_H
#define TOOLS_DRAW_CHART_H

#include <stddef.h>
#include <stdio.h>

/* CHART_BYTES is logarithmic, in powers of two. */
typedef enum chart_scale { CHART_LINEAR, CHART_LOG, CHART_BYTES } chart_scale;

typedef struct chart_axis {
    chart_scale scale;
    double low, high;  /* low > 0 on logarithmic scales */
    double step;       /* between the ticks of a linear axis */
    const char *label; /* with its unit */
} chart_axis;

typedef enum chart_mark {
    CHART_NO_MARK,
    CHART_DOT,
    CHART_RING,
    CHART_SQUARE,
    CHART_DIAMOND,
    CHART_TRIANGLE,
    CHART_CROSS
} chart_mark;

typedef enum chart_line { CHART_NO_LINE, CHART_SOLID, CHART_DASHED, CHART_DOTTED } chart_line;

typedef struct chart_series {
    const char *label;   /* at the end of the curve; may be NULL */
    const double *x, *y; /* what is not finite interrupts the curve */
    size_t count;
    unsigned colour; /* of the palette, 0 to CHART_COLOURS - 1 */
    chart_mark mark;
    chart_line line;
    const char *const *texts; /* NULL, or a label beside each point (an empty one is none) */
} chart_series;

/* An entry of the key below the title; without a mark a stroke shows the colour. */
typedef struct chart_key {
    const char *text;
    unsigned colour;
    chart_mark mark;
} chart_key;

enum { CHART_COLOURS = 8, CHART_WIDTH = 560, CHART_HEIGHT = 380 };

typedef struct chart {
    const char *title, *about; /* above the frame; for those who cannot see it */
    double width, height;      /* of all, pixels */
    double right;              /* of it, for the labels at the ends of curves */
    chart_axis x, y;
    const char *zero; /* NULL, or the name of a band below the frame for y = 0 on a logarithmic axis */
    double band;      /* its height */
    const chart_series *series;
    size_t count;
    const chart_key *key;
    size_t key_count;
} chart;

/* The inside of the frame. */
typedef struct chart_frame {
    double left, top, width, height;
    double band; /* height of the band of zeros below, or 0 */
} chart_frame;

/* As an <svg> element to stand in a page. */
void chart_draw(FILE *file, const chart *c);

/* As a file of its own, with a background and the colours inside. */
void chart_draw_alone(FILE *file, const chart *c);

/* The rules for the classes of chart_draw, those for dark screens included. */
void chart_style(FILE *file);

/* ---- axes: chart_axis.c ---- */

/* From 0 at the low end to 1 at the high end, beyond for what lies outside; NaN where a logarithm has none. */
double chart_place(const chart_axis *axis, double value);

/* Ends of a logarithmic axis that holds what lies from low to high: whole decades, or powers of two. */
void chart_fit(chart_axis *axis, double low, double high);

/* The least and the greatest positive number; {HUGE_VAL, 0} to begin with. */
typedef struct chart_range {
    double low, high;
} chart_range;

void chart_widen(chart_range *range, double value);

/* Fits both axes, which are logarithmic, to all series; an axis whose high end is set stays.
 * `least`: the lowest y that is shown. */
void chart_fit_series(chart *c, double least);

typedef struct chart_tick {
    double value;
    char name[16]; /* "" for a small one */
} chart_tick;

enum { CHART_TICKS_MAX = 160 };

size_t chart_ticks(const chart_axis *axis, chart_tick ticks[CHART_TICKS_MAX]);

/* ---- labels: chart_label.c ---- */

typedef struct chart_box {
    double left, top, right, bottom;
} chart_box;

enum { CHART_BOXES_MAX = 1024 };

/* What may not be written over. */
typedef struct chart_taken {
    chart_box box[CHART_BOXES_MAX];
    size_t count;
} chart_taken;

/* Pixels, roughly. */
double chart_text_width(const char *text);

void chart_take(chart_taken *taken, double x, double y, double radius);

/* Writes beside (x, y), inside the bounds, where the least is written over; takes the place. */
void chart_label_beside(FILE *file, chart_taken *taken, const chart_box *bounds, double x, double y,
                        unsigned colour, const char *text);

/* A label at the end of a curve that ends at (x, y), to be spread apart. */
typedef struct chart_end {
    double x, y, at; /* at: the height where it is written */
    unsigned colour;
    const char *text;
} chart_end;

/* Writes them in a column at `column`, in the order of y, a line apart, between top and bottom. */
void chart_label_ends(FILE *file, chart_end *ends, size_t count, double column, double top, double bottom);

#endif
