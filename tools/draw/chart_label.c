/* Placing of texts. Labels beside points are placed one after the other: of some places around the point, near
 * ones first, the one that covers the least of what is there already. Labels at the ends of curves stand in a
 * column and push each other apart. */
#include "draw/chart.h"
#include "draw/svg.h"

#include <math.h>
#include <stdlib.h>

static const double text_height = 12, glyph_width = 5.9, line_step = 15;

double chart_text_width(const char *text)
{
    double glyphs = 0;
    for (; *text; text++)
        glyphs += ((unsigned char)*text & 0xc0) != 0x80; /* the first byte of each character of UTF-8 */
    return glyphs * glyph_width;
}

static void take_box(chart_taken *taken, const chart_box *box)
{
    if (taken->count < CHART_BOXES_MAX)
        taken->box[taken->count++] = *box;
}

void chart_take(chart_taken *taken, double x, double y, double radius)
{
    chart_box box = {x - radius, y - radius, x + radius, y + radius};
    take_box(taken, &box);
}

static double overlap(const chart_box *a, const chart_box *b)
{
    double width = fmin(a->right, b->right) - fmax(a->left, b->left);
    double height = fmin(a->bottom, b->bottom) - fmax(a->top, b->top);
    return width > 0 && height > 0 ? width * height : 0;
}

static double covered(const chart_taken *taken, const chart_box *bounds, const chart_box *box)
{
    double area = (box->right - box->left) * (box->bottom - box->top), sum = 0;
    for (size_t i = 0; i < taken->count; i++)
        sum += overlap(box, &taken->box[i]);
    return sum + 20 * (area - overlap(box, bounds));
}

/* The box of a text whose near side or middle is `distance` from the point in direction k of 12. */
static chart_box box_around(double x, double y, double width, double distance, int k)
{
    double turn = k * acos(-1.0) / 6, across = cos(turn), down = sin(turn);
    double cx = x + across * (distance + width / 2), cy = y + down * (distance + text_height / 2);
    chart_box box = {cx - width / 2, cy - text_height / 2, cx + width / 2, cy + text_height / 2};
    return box;
}

static void write_text(FILE *file, double x, double y, unsigned colour, const char *text)
{
    fprintf(file, "<text class=\"name t%u\" x=\"%.1f\" y=\"%.1f\">", colour, x, y);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

void chart_label_beside(FILE *file, chart_taken *taken, const chart_box *bounds, double x, double y,
                        unsigned colour, const char *text)
{
    static const double distances[] = {7, 12, 20, 30, 42, 56};
    double width = chart_text_width(text), least = HUGE_VAL, chosen = 0;
    chart_box best = {0, 0, 0, 0};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 12; k++) {
            chart_box box = box_around(x, y, width, distances[i], k);
            double cost = covered(taken, bounds, &box) + 1.5 * distances[i] + (k % 6 == 0 ? 0 : 2);
            if (cost < least) {
                least = cost;
                best = box;
                chosen = distances[i];
            }
        }
    if (chosen > 14) {
        double tx = fmin(fmax(x, best.left), best.right), ty = fmin(fmax(y, best.top), best.bottom);
        fprintf(file, "<line class=\"lead\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", x, y, tx, ty);
    }
    take_box(taken, &best);
    write_text(file, best.left, best.bottom - 2.5, colour, text);
}

static int by_height(const void *a, const void *b)
{
    const chart_end *p = a, *q = b;
    return (p->y > q->y) - (p->y < q->y);
}

/* Down from the top, each at least a line below the one before; then up from the bottom, likewise. */
static void spread(chart_end *ends, size_t count, double top, double bottom)
{
    double at = top;
    for (size_t i = 0; i < count; i++) {
        ends[i].at = fmax(ends[i].y, at);
        at = ends[i].at + line_step;
    }
    at = bottom;
    for (size_t i = count; i-- > 0;) {
        ends[i].at = fmin(ends[i].at, at);
        at = ends[i].at - line_step;
    }
}

void chart_label_ends(FILE *file, chart_end *ends, size_t count, double column, double top, double bottom)
{
    qsort(ends, count, sizeof ends[0], by_height);
    spread(ends, count, top, bottom);
    for (size_t i = 0; i < count; i++) {
        fprintf(file, "<path class=\"lead\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", ends[i].x + 4, ends[i].y, column - 4,
                ends[i].at);
        write_text(file, column, ends[i].at + 4, ends[i].colour, ends[i].text);
    }
}
