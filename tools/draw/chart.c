#include "draw/chart.h"
#include "draw/svg.h"

#include <math.h>

static const double mark_radius = 4;

/* ---- colours ------------------------------------------------------------------------------------- */

typedef struct ink {
    const char *mark, *text; /* for curves and marks; for texts, which need more contrast */
} ink;

static const ink light[CHART_COLOURS] = {{"#0072b2", "#005f96"}, {"#d55e00", "#a94a00"}, {"#009e73", "#007354"},
                                         {"#cc79a7", "#9c3f74"}, {"#e69f00", "#8a5f00"}, {"#56b4e9", "#1f719f"},
                                         {"#6f42c1", "#5a34a0"}, {"#6c757d", "#545b62"}};
static const ink dark[CHART_COLOURS] = {{"#4da3e0", "#7fbfec"}, {"#f0803c", "#f4a06d"}, {"#2fc59a", "#5ad6b2"},
                                        {"#e39ac3", "#ecb5d3"}, {"#f2b632", "#f5c862"}, {"#8fd0f5", "#aadcf8"},
                                        {"#b395f0", "#c5aef4"}, {"#9aa3ab", "#b3bac1"}};

static void write_rules(FILE *file, const ink *inks)
{
    for (int i = 0; i < CHART_COLOURS; i++)
        fprintf(file, ".l%d{stroke:%s}.f%d{fill:%s}.t%d{fill:%s}\n", i, inks[i].mark, i, inks[i].mark, i,
                inks[i].text);
}

void chart_style(FILE *file)
{
    fputs(".chart{font:12px 'Helvetica Neue',Arial,'DejaVu Sans',sans-serif}\n"
          ".chart .line{fill:none;stroke-width:2;stroke-linejoin:round}\n"
          ".chart .mark{stroke-width:2}.chart .hollow{fill:none}\n"
          ".chart .tick,.chart .name{font-size:11px}.chart .title{font-size:14px;font-weight:600}\n"
          ".chart .swatch{stroke-width:6}.chart .lead{fill:none;stroke-width:.7}.chart .fine{stroke-width:.4}\n"
          ".paper{fill:#fff}.ink{fill:#212529}.quiet{fill:#495057}\n"
          ".grid{stroke:#dee2e6}.axis{fill:none;stroke:#868e96}.lead{stroke:#868e96}\n",
          file);
    write_rules(file, light);
    fputs("@media screen and (prefers-color-scheme:dark){\n"
          ".paper{fill:#16191d}.ink{fill:#e9ecef}.quiet{fill:#b6bec6}\n"
          ".grid{stroke:#343a40}.axis{stroke:#868e96}.lead{stroke:#868e96}\n",
          file);
    write_rules(file, dark);
    fputs("}\n", file);
}

/* ---- frame --------------------------------------------------------------------------------------- */

static chart_frame frame_of(const chart *c)
{
    double band = c->zero ? c->band : 0, top = c->title ? 30 : 10;
    top += c->key_count ? 20 : 0;
    chart_frame frame = {66, top, c->width - 66 - c->right, c->height - top - 50 - band, band};
    return frame;
}

static double pixel_x(const chart *c, const chart_frame *f, double x)
{
    return f->left + f->width * chart_place(&c->x, x);
}

/* A zero lies in the band, if the chart has one. */
static double pixel_y(const chart *c, const chart_frame *f, double y)
{
    if (f->band > 0 && y == 0)
        return f->top + f->height + f->band / 2;
    return f->top + f->height * (1 - chart_place(&c->y, y));
}

static void write_text(FILE *file, const char *kind, const char *anchor, double x, double y, const char *text)
{
    fprintf(file, "<text class=\"%s\" text-anchor=\"%s\" x=\"%.1f\" y=\"%.1f\">", kind, anchor, x, y);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

static void write_line(FILE *file, const char *kind, double x1, double y1, double x2, double y2)
{
    fprintf(file, "<path class=\"%s\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", kind, x1, y1, x2, y2);
}

static void draw_x_axis(FILE *file, const chart *c, const chart_frame *f)
{
    chart_tick ticks[CHART_TICKS_MAX];
    size_t count = chart_ticks(&c->x, ticks);
    double bottom = f->top + f->height + f->band;
    for (size_t i = 0; i < count; i++) {
        double x = pixel_x(c, f, ticks[i].value);
        write_line(file, ticks[i].name[0] ? "grid" : "grid fine", x, f->top, x, bottom);
        write_text(file, "tick quiet", "middle", x, bottom + 16, ticks[i].name);
    }
    write_text(file, "ink", "middle", f->left + f->width / 2, bottom + 38, c->x.label);
}

static void draw_y_axis(FILE *file, const chart *c, const chart_frame *f)
{
    chart_tick ticks[CHART_TICKS_MAX];
    size_t count = chart_ticks(&c->y, ticks);
    for (size_t i = 0; i < count; i++) {
        double y = pixel_y(c, f, ticks[i].value);
        write_line(file, ticks[i].name[0] ? "grid" : "grid fine", f->left, y, f->left + f->width, y);
        write_text(file, "tick quiet", "end", f->left - 6, y + 4, ticks[i].name);
    }
    if (f->band > 0)
        write_text(file, "tick quiet", "end", f->left - 6, f->top + f->height + f->band / 2 + 4, c->zero);
    fprintf(file, "<text class=\"ink\" text-anchor=\"middle\" transform=\"translate(15 %.1f) rotate(-90)\">",
            f->top + f->height / 2);
    svg_escape(file, c->y.label);
    fputs("</text>\n", file);
}

static void draw_frame(FILE *file, const chart *c, const chart_frame *f)
{
    draw_x_axis(file, c, f);
    draw_y_axis(file, c, f);
    fprintf(file, "<rect class=\"axis\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", f->left, f->top,
            f->width, f->height + f->band);
    if (f->band > 0)
        write_line(file, "axis", f->left, f->top + f->height, f->left + f->width, f->top + f->height);
    if (c->title)
        write_text(file, "title ink", "start", f->left, 18, c->title);
}

/* ---- series -------------------------------------------------------------------------------------- */

static int is_inside(const chart *c, const chart_frame *f, double x, double y)
{
    double across = chart_place(&c->x, x), up = chart_place(&c->y, y);
    return across > -1e-6 && across < 1 + 1e-6 && ((up > -1e-6 && up < 1 + 1e-6) || (f->band > 0 && y == 0));
}

static void draw_line(FILE *file, const chart *c, const chart_frame *f, const chart_series *s)
{
    static const char *const dashes[] = {"", "", "7 4", "2 3"};
    int inside = 0;
    fprintf(file, "<path class=\"line l%u\"%s%s%s d=\"", s->colour,
            s->line > CHART_SOLID ? " stroke-dasharray=\"" : "", dashes[s->line],
            s->line > CHART_SOLID ? "\"" : "");
    for (size_t i = 0; i < s->count; i++) {
        if (!is_inside(c, f, s->x[i], s->y[i])) {
            inside = 0;
            continue;
        }
        fprintf(file, "%c%.1f %.1f", inside ? 'L' : 'M', pixel_x(c, f, s->x[i]), pixel_y(c, f, s->y[i]));
        inside = 1;
    }
    fputs("\"/>\n", file);
}

static void draw_mark(FILE *file, chart_mark mark, unsigned colour, double x, double y)
{
    static const char *const outlines[] = {
        "", "", "", "M-3.6-3.6h7.2v7.2h-7.2z", "M0-5L5 0L0 5L-5 0z", "M0-5L4.7 3.4H-4.7z", "M-4-4L4 4M-4 4L4-4"};
    if (mark == CHART_DOT)
        fprintf(file, "<circle class=\"f%u\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", colour, x, y, mark_radius);
    else if (mark == CHART_RING)
        fprintf(file, "<circle class=\"mark hollow l%u\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", colour, x, y,
                mark_radius);
    else
        fprintf(file, "<path class=\"%s%u\" transform=\"translate(%.1f %.1f)\" d=\"%s\"/>\n",
                mark == CHART_CROSS ? "mark l" : "f", colour, x, y, outlines[mark]);
}

/* Keeps labels off a line. */
static void take_line(chart_taken *taken, double x1, double y1, double x2, double y2)
{
    double steps = ceil(hypot(x2 - x1, y2 - y1) / 6);
    for (double i = 0; i < steps; i++)
        chart_take(taken, x1 + (x2 - x1) * i / steps, y1 + (y2 - y1) * i / steps, 3);
}

static void take_curve(const chart *c, const chart_frame *f, const chart_series *s, chart_taken *taken)
{
    for (size_t i = 0; i + 1 < s->count; i++)
        if (is_inside(c, f, s->x[i], s->y[i]) && is_inside(c, f, s->x[i + 1], s->y[i + 1]))
            take_line(taken, pixel_x(c, f, s->x[i]), pixel_y(c, f, s->y[i]), pixel_x(c, f, s->x[i + 1]),
                      pixel_y(c, f, s->y[i + 1]));
}

static void draw_series(FILE *file, const chart *c, const chart_frame *f, const chart_series *s,
                        chart_taken *taken)
{
    if (s->line != CHART_NO_LINE)
        draw_line(file, c, f, s);
    if (s->line != CHART_NO_LINE && s->texts)
        take_curve(c, f, s, taken);
    for (size_t i = 0; i < s->count && s->mark != CHART_NO_MARK; i++)
        if (is_inside(c, f, s->x[i], s->y[i])) {
            double x = pixel_x(c, f, s->x[i]), y = pixel_y(c, f, s->y[i]);
            draw_mark(file, s->mark, s->colour, x, y);
            chart_take(taken, x, y, mark_radius + 2);
        }
}

/* Draws the entries one after the other, from the left of the frame. */
static void draw_key(FILE *file, const chart *c, const chart_frame *f)
{
    double x = f->left, y = f->top - 14;
    for (size_t i = 0; i < c->key_count; i++) {
        const chart_key *key = &c->key[i];
        if (key->mark != CHART_NO_MARK)
            draw_mark(file, key->mark, key->colour, x + 6, y);
        else
            fprintf(file, "<path class=\"line swatch l%u\" d=\"M%.1f %.1fh14\"/>\n", key->colour, x, y);
        write_text(file, "tick quiet", "start", x + 18, y + 4, key->text);
        x += 32 + chart_text_width(key->text);
    }
}

/* ---- labels -------------------------------------------------------------------------------------- */

enum { ENDS_MAX = 32 };

static void write_ends(FILE *file, const chart *c, const chart_frame *f)
{
    chart_end ends[ENDS_MAX];
    size_t count = 0;
    for (size_t k = 0; k < c->count; k++) {
        const chart_series *s = &c->series[k];
        size_t last = s->count;
        while (last > 0 && !is_inside(c, f, s->x[last - 1], s->y[last - 1]))
            last--;
        if (s->label && last > 0 && count < ENDS_MAX)
            ends[count++] =
                (chart_end){pixel_x(c, f, s->x[last - 1]), pixel_y(c, f, s->y[last - 1]), 0, s->colour, s->label};
    }
    chart_label_ends(file, ends, count, f->left + f->width + 14, f->top + 4, f->top + f->height + f->band - 2);
}

static void write_texts(FILE *file, const chart *c, const chart_frame *f, chart_taken *taken)
{
    chart_box bounds = {f->left + 2, f->top + 2, f->left + f->width - 2, f->top + f->height + f->band - 2};
    for (size_t k = 0; k < c->count; k++) {
        const chart_series *s = &c->series[k];
        for (size_t i = 0; s->texts && i < s->count; i++)
            if (s->texts[i][0] && is_inside(c, f, s->x[i], s->y[i]))
                chart_label_beside(file, taken, &bounds, pixel_x(c, f, s->x[i]), pixel_y(c, f, s->y[i]), s->colour,
                                   s->texts[i]);
    }
}

/* ---- the whole ----------------------------------------------------------------------------------- */

static void draw_inside(FILE *file, const chart *c)
{
    chart_frame f = frame_of(c);
    chart_taken taken = {.count = 0};
    draw_frame(file, c, &f);
    draw_key(file, c, &f);
    if (f.band > 0)
        take_line(&taken, f.left, f.top + f.height, f.left + f.width, f.top + f.height);
    for (size_t k = 0; k < c->count; k++)
        draw_series(file, c, &f, &c->series[k], &taken);
    write_texts(file, c, &f, &taken);
    write_ends(file, c, &f);
}

static void open_element(FILE *file, const chart *c)
{
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" width=\"%.0f\" height=\"%.0f\" "
            "viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"",
            c->width, c->height, c->width, c->height);
    svg_escape(file, c->about ? c->about : c->title);
    fputs("\">\n", file);
}

void chart_draw(FILE *file, const chart *c)
{
    open_element(file, c);
    draw_inside(file, c);
    fputs("</svg>\n", file);
}

void chart_draw_alone(FILE *file, const chart *c)
{
    open_element(file, c);
    fputs("<style>\n", file);
    chart_style(file);
    fputs("</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n", file);
    draw_inside(file, c);
    fputs("</svg>\n", file);
}
