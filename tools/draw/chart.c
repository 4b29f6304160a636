#include "cli/figures.h"
#include "draw/draw.h"

#include <math.h>

static const double text_height = 12, glyph_width = 6.5;

enum { BOXES_MAX = 1024 };

typedef struct box {
    double left, top, right, bottom;
} box;

/* The inside of the frame, with the height of the band of zeros below; both axes; and what may not be written over. */
typedef struct picture {
    FILE *file;
    const chart *c;
    double left, top, width, height, band;
    double low[2], high[2], step[2]; /* of x and y; step 0: logarithmic */
    box taken[BOXES_MAX];
    size_t count;
} picture;

static void fit(picture *p, int is_y)
{
    const chart_axis *axis = is_y ? &p->c->y : &p->c->x;
    double low = HUGE_VAL, high = 0;
    for (const chart_series *s = p->c->series; s < p->c->series + p->c->count; s++)
        for (size_t i = 0; i < s->count; i++) {
            const double at = is_y ? s->point[i].y : s->point[i].x;
            low = at > 0 && at < 1e37 ? fmin(low, at) : low;
            high = at > 0 && at < 1e37 ? fmax(high, at) : high;
        }
    if (is_y)
        low = fmax(low, high / 1e7);
    const int is_known = low <= high;
    const double first = is_known ? floor(log10(low) + 1e-3) : -1, last = is_known ? ceil(log10(high) - 1e-3) : 0;
    p->step[is_y] = axis->step;
    p->low[is_y] = axis->step > 0 ? 0 : pow(10, first);
    p->high[is_y] = axis->step > 0 ? axis->high : pow(10, fmax(last, first + 1));
}

/* From 0 at the low end to 1 at the high end, beyond for what lies outside; NaN where a logarithm has none. */
static double place_of(const picture *p, int is_y, double value)
{
    if (p->step[is_y] > 0)
        return value / p->high[is_y];
    return value > 0 ? log(value / p->low[is_y]) / log(p->high[is_y] / p->low[is_y]) : (double)NAN;
}

/* A zero lies in the band, if the chart has one. */
static double pixel(const picture *p, int is_y, double value)
{
    if (!is_y)
        return p->left + p->width * place_of(p, 0, value);
    if (p->band > 0 && value == 0)
        return p->top + p->height + p->band / 2;
    return p->top + p->height * (1 - place_of(p, 1, value));
}

/* Linear axes have a tick every step. Logarithmic ones have decades, where there are many every second of them with
 * a name, and small ticks at 2 to 9 between; where fewer than three decades are shown, 2 and 5 have names too. 0 where
 * they end. */
static int tick_at(const picture *p, int is_y, int index, double *at, int *is_named)
{
    const int digit = 1 + index % 9;
    const double decade = round(log10(p->low[is_y])) + index / 9, many = log10(p->high[is_y] / p->low[is_y]);
    if (p->step[is_y] > 0) {
        *at = index * p->step[is_y];
        *is_named = 1;
    } else {
        *at = digit * pow(10, decade);
        *is_named = digit == 1 ? fmod(decade, many > 9 ? 2 : 1) == 0 : many < 2.5 && (digit == 2 || digit == 5);
    }
    return place_of(p, is_y, *at) < 1 + 1e-9;
}

/* Lines across the frame, those without a name finer, and names. */
static void draw_ticks(const picture *p, int is_y)
{
    enum { FINE, COARSE, NAMES };
    static const char *const begin[] = {"<path class=\"grid fine\" d=\"", "<path class=\"grid\" d=\"",
                                        "<text class=\"tick quiet\" text-anchor=\"middle\">"};
    const double bottom = p->top + p->height + p->band;
    double at;
    int is_named;
    for (int pass = FINE; pass <= NAMES; pass++) {
        fputs(is_y && pass == NAMES ? "<text class=\"tick quiet\" text-anchor=\"end\">" : begin[pass], p->file);
        for (int i = 0; tick_at(p, is_y, i, &at, &is_named); i++) {
            const double v = pixel(p, is_y, at);
            if (is_named != (pass != FINE))
                continue;
            if (pass == NAMES)
                fprintf(p->file, "<tspan x=\"%.1f\" y=\"%.1f\">%.6g</tspan>", is_y ? p->left - 6 : v,
                        is_y ? v + 4 : bottom + 16, at);
            else if (is_y)
                fprintf(p->file, "M%.1f %.1fh%.1f", p->left, v, p->width);
            else
                fprintf(p->file, "M%.1f %.1fv%.1f", v, p->top, p->height + p->band);
        }
        fputs(pass == NAMES ? "</text>\n" : "\"/>\n", p->file);
    }
}

static void draw_frame(const picture *p)
{
    static const char rectangle[] =
        "<rect class=\"axis\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n";
    const double bottom = p->top + p->height + p->band;
    draw_ticks(p, 0);
    draw_ticks(p, 1);
    svg_text(p->file, "ink", SVG_MIDDLE, p->left + p->width / 2, bottom + 38, p->c->x.label);
    fprintf(p->file, "<g transform=\"translate(15 %.1f) rotate(-90)\">", p->top + p->height / 2);
    svg_text(p->file, "ink", SVG_MIDDLE, 0, 0, p->c->y.label);
    fputs("</g>\n", p->file);
    fprintf(p->file, rectangle, p->left, p->top, p->width, p->height);
    if (p->band > 0) {
        fprintf(p->file, rectangle, p->left, p->top + p->height, p->width, p->band);
        svg_text(p->file, "tick quiet", SVG_END, p->left - 6, bottom - p->band / 2 + 4, p->c->zero);
    }
    svg_text(p->file, "title ink", SVG_START, p->left, 18, p->c->title);
}

static void take(picture *p, double x, double y, double around)
{
    if (p->count < BOXES_MAX)
        p->taken[p->count++] = (box){x - around, y - around, x + around, y + around};
}

static int is_inside(const picture *p, const chart_point *at)
{
    const double across = place_of(p, 0, at->x), up = place_of(p, 1, at->y);
    return fabs(across - 0.5) < 0.5 + 1e-6 && (fabs(up - 0.5) < 0.5 + 1e-6 || (p->band > 0 && at->y == 0));
}

static const char *const dashes[] = {"", "", " stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 3\""};
static const char *const outlines[] = {"", "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0",
                                       "m-8 0a8 8 0 1 0 16 0a8 8 0 1 0-16 0", "m-3.6-3.6h7.2v7.2h-7.2z",
                                       "m0-5l4.7 8.4h-9.4z"};

static void draw_line(picture *p, const chart_series *s)
{
    double last_x = NAN, last_y = NAN;
    fprintf(p->file, "<path class=\"line l%u\"%s d=\"", s->colour, dashes[s->line]);
    for (const chart_point *at = s->point; at < s->point + s->count; at++) {
        double x = pixel(p, 0, at->x), y = pixel(p, 1, at->y);
        if (is_inside(p, at)) {
            fprintf(p->file, "%c%.1f %.1f", isnan(last_x) ? 'M' : 'L', x, y);
            double steps = s->mark && !isnan(last_x) ? ceil(hypot(x - last_x, y - last_y) / 6) : 0;
            for (double k = 0; k < steps; k++) /* labels keep off the line */
                take(p, last_x + (x - last_x) * k / steps, last_y + (y - last_y) * k / steps, 3);
        }
        last_x = is_inside(p, at) ? x : (double)NAN;
        last_y = y;
    }
    fputs("\"/>\n", p->file);
}

static void begin_marks(const picture *p, const chart_series *s)
{
    fprintf(p->file, "<path class=\"%s%u\" d=\"", s->mark == CHART_RING ? "mark hollow l" : "f", s->colour);
}

static void draw_marks(picture *p, const chart_series *s)
{
    begin_marks(p, s);
    for (const chart_point *at = s->point; at < s->point + s->count; at++)
        if (is_inside(p, at)) {
            const double x = pixel(p, 0, at->x), y = pixel(p, 1, at->y);
            fprintf(p->file, "M%.1f %.1f%s", x, y, outlines[s->mark]);
            take(p, x, y, s->mark == CHART_RING ? 10 : 6);
        }
    fputs("\"/>\n", p->file);
}

/* The names one after the other, from the left of the frame. */
static void draw_key(const picture *p)
{
    double x = p->left, y = p->top - 14;
    for (const chart_series *s = p->c->series; s < p->c->series + p->c->count; s++) {
        if (!s->name)
            continue;
        if (s->mark) {
            begin_marks(p, s);
            fprintf(p->file, "M%.1f %.1f%s\"/>\n", x + 6, y, outlines[s->mark]);
        } else
            fprintf(p->file, "<path class=\"line%s l%u\"%s d=\"M%.1f %.1fh18\"/>\n", s->line ? "" : " swatch",
                    s->colour, dashes[s->line], x - 2, y);
        svg_text(p->file, "tick quiet", SVG_START, x + 20, y + 4, s->name);
        x += 36 + glyph_width * (double)text_glyphs(s->name);
    }
}

/* Tries places around the point, near ones first, and takes the first where the text covers nothing; where there is
 * none it is left out. */
static void label_point(picture *p, double x, double y, unsigned colour, const char *text)
{
    static const double distances[] = {7, 12, 20, 30, 42, 56};
    const double width = glyph_width * (double)text_glyphs(text), right = p->left + p->width,
                 bottom = p->top + p->height + p->band;
    char kind[16];
    for (int i = 0; i < 6 * 12; i++) {
        const double far = distances[i / 12], turn = i % 12 * acos(-1.0) / 6;
        const double cx = x + cos(turn) * (far + width / 2), cy = y + sin(turn) * (far + text_height / 2);
        const box at = {cx - width / 2, cy - text_height / 2, cx + width / 2, cy + text_height / 2};
        int is_free = at.left > p->left && at.right < right && at.top > p->top && at.bottom < bottom;
        for (const box *b = p->taken; b < p->taken + p->count; b++)
            is_free &= b->right < at.left || b->left > at.right || b->bottom < at.top || b->top > at.bottom;
        if (!is_free || p->count == BOXES_MAX)
            continue;
        if (far > 14)
            fprintf(p->file, "<path class=\"lead\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", x, y,
                    fmin(fmax(x, at.left), at.right), fmin(fmax(y, at.top), at.bottom));
        p->taken[p->count++] = at;
        snprintf(kind, sizeof kind, "name t%u", colour);
        svg_text(p->file, kind, SVG_START, at.left, at.bottom - 2.5, text);
        return;
    }
}

void chart_draw(FILE *file, const chart *c, int is_alone)
{
    const double left = 66, right = 20, top = 50, below = 50, band = c->zero ? 90 : 0;
    picture p = {.file = file, .c = c, .left = left, .top = top, .band = band};
    p.width = c->box.width - left - right;
    p.height = c->box.height - top - below - band;
    fit(&p, 0);
    fit(&p, 1);
    svg_begin(file, c->box, c->title, is_alone);
    draw_frame(&p);
    draw_key(&p);
    for (double x = 0; band > 0 && x < p.width; x += 6)
        take(&p, p.left + x, p.top + p.height, 3);
    for (const chart_series *s = c->series; s < c->series + c->count; s++) {
        if (s->line && s->count)
            draw_line(&p, s);
        if (s->mark && s->count)
            draw_marks(&p, s);
    }
    for (const chart_series *s = c->series; s < c->series + c->count; s++)
        for (const chart_point *at = s->point; at < s->point + s->count; at++)
            if (at->label[0] && is_inside(&p, at))
                label_point(&p, pixel(&p, 0, at->x), pixel(&p, 1, at->y), s->colour, at->label);
    fputs("</svg>\n", file);
}
