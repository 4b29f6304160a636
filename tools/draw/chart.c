#include "draw/chart.h"

#include <math.h>
#include <stdlib.h>

#include "draw/svg.h"

static const double radius = 4, text_height = 12, glyph_width = 6.5;

/* ---- colours ------------------------------------------------------------------------------------- */

/* For curves and marks; for texts, which need more contrast. */
typedef struct ink {
    const char *mark, *text;
} ink;

static const ink light[CHART_COLOURS] = {{"#0072b2", "#005f96"},
                                         {"#d55e00", "#a94a00"},
                                         {"#009e73", "#007354"},
                                         {"#6f42c1", "#5a34a0"},
                                         {"#6c757d", "#545b62"}};
static const ink dark[CHART_COLOURS] = {{"#4da3e0", "#7fbfec"},
                                        {"#f0803c", "#f4a06d"},
                                        {"#2fc59a", "#5ad6b2"},
                                        {"#b395f0", "#c5aef4"},
                                        {"#9aa3ab", "#b3bac1"}};

static void write_rules(FILE *file, const ink *inks)
{
    for (int i = 0; i < CHART_COLOURS; i++)
        fprintf(file, ".l%d{stroke:%s}.f%d{fill:%s}.t%d{fill:%s}\n", i, inks[i].mark, i, inks[i].mark, i,
                inks[i].text);
}

void chart_style(FILE *file)
{
    fputs(
        ".chart{font:12px 'Helvetica Neue',Arial,'DejaVu Sans',sans-serif}\n"
        ".chart .line{fill:none;stroke-width:2;stroke-linejoin:round}\n"
        ".chart .mark{stroke-width:2}.chart .hollow{fill:none}\n"
        ".chart .tick,.chart .name{font-size:11px}.chart .title{font-size:14px;font-weight:600}\n"
        ".chart .swatch{stroke-width:6}.chart .lead{fill:none;stroke-width:.7}.chart .fine{stroke-width:.4}\n"
        ".paper{fill:#fff}.ink{fill:#212529}.quiet{fill:#495057}.pen{stroke:#212529;stroke-width:1.6;fill:none}\n"
        ".grid{stroke:#dee2e6}.axis{fill:none;stroke:#868e96}.lead{stroke:#868e96}.edge{stroke:#fff;fill:none}\n",
        file);
    write_rules(file, light);
    fputs("@media screen and (prefers-color-scheme:dark){\n"
          ".paper{fill:#16191d}.ink{fill:#e9ecef}.quiet{fill:#b6bec6}.pen{stroke:#e9ecef}.edge{stroke:#16191d}\n"
          ".grid{stroke:#343a40}.axis{stroke:#868e96}.lead{stroke:#868e96}\n",
          file);
    write_rules(file, dark);
    fputs("}\n", file);
}

/* ---- axes ---------------------------------------------------------------------------------------- */

/* From 0 at the low end to 1 at the high end, beyond for what lies outside; NaN where a logarithm has none. */
static double place_of(const chart_axis *axis, double value)
{
    if (axis->scale == CHART_LINEAR)
        return (value - axis->low) / (axis->high - axis->low);
    return value > 0 ? log(value / axis->low) / log(axis->high / axis->low) : (double)NAN;
}

void chart_fit(chart *c, double decades)
{
    for (int is_y = 0; is_y < 2; is_y++) {
        chart_axis *axis = is_y ? &c->y : &c->x;
        double low = HUGE_VAL, high = 0;
        for (const chart_series *s = c->series; s < c->series + c->count; s++)
            for (size_t i = 0; i < s->count; i++) {
                const double at = is_y ? s->y[i] : s->x[i];
                if (at > 0 && at < 1e37) {
                    low = fmin(low, at);
                    high = fmax(high, at);
                }
            }
        if (axis->scale != CHART_LOG)
            continue;
        if (is_y)
            low = fmax(low, high / pow(10, decades));
        double first = floor(log10(low) + 1e-3), last = ceil(log10(high) - 1e-3);
        if (!(low <= high)) /* nothing is known */
            first = -1, last = 0;
        axis->low = pow(10, first);
        axis->high = pow(10, last > first ? last : first + 1);
    }
}

/* Powers of ten, with the digits above the line, on an axis that needs them; plain numbers on one that does
 * not. */
static void name_number(const chart_axis *axis, char name[16], double value)
{
    static const char *const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const int is_wide = axis->scale == CHART_LOG && (axis->low < 9e-4 || axis->high > 2e5);
    const int power = is_wide ? (int)floor(log10(value) + 1e-9) : 0, size = abs(power);
    if (is_wide && fabs(value / pow(10, power) - 1) < 1e-9 && power != 0)
        snprintf(name, 16, "10%s%s%s", power < 0 ? "⁻" : "", size > 9 ? digits[size / 10 % 10] : "",
                 digits[size % 10]);
    else
        snprintf(name, 16, "%.6g", value);
}

/* ---- the picture --------------------------------------------------------------------------------- */

typedef struct box {
    double left, top, right, bottom;
} box;

enum { BOXES_MAX = 1024 };

/* The inside of the frame, with the height of the band of zeros below; and what may not be written over. */
typedef struct picture {
    FILE *file;
    const chart *c;
    double left, top, width, height, band;
    box taken[BOXES_MAX];
    size_t count, marks; /* what comes after the marks and lines is labels */
} picture;

/* A zero lies in the band, if the chart has one. */
static double pixel(const picture *p, int is_y, double value)
{
    if (!is_y)
        return p->left + p->width * place_of(&p->c->x, value);
    if (p->band > 0 && value == 0)
        return p->top + p->height + p->band / 2;
    return p->top + p->height * (1 - place_of(&p->c->y, value));
}

static void write_line(FILE *file, const char *kind, double x1, double y1, double x2, double y2)
{
    fprintf(file, "<path class=\"%s\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", kind, x1, y1, x2, y2);
}

static void draw_tick(picture *p, int is_y, double value, int is_named)
{
    const chart_axis *axis = is_y ? &p->c->y : &p->c->x;
    const double place = place_of(axis, value), bottom = p->top + p->height + p->band, at = pixel(p, is_y, value);
    const char *kind = is_named ? "grid" : "grid fine";
    char name[16] = "";
    if (!(place > -1e-9 && place < 1 + 1e-9))
        return;
    if (is_named)
        name_number(axis, name, value);
    write_line(p->file, kind, is_y ? p->left : at, is_y ? at : p->top, is_y ? p->left + p->width : at,
               is_y ? at : bottom);
    svg_text(p->file, "tick quiet", is_y ? SVG_END : SVG_MIDDLE, is_y ? p->left - 6 : at,
             is_y ? at + 4 : bottom + 16, name);
}

/* Linear axes have a tick every step. Logarithmic ones have decades, where there are many every second of them with
 * a name, and small ticks at 2 to 9 between; where fewer than three decades are shown, 2 and 5 have names too. */
static void draw_ticks(picture *p, int is_y)
{
    const chart_axis *axis = is_y ? &p->c->y : &p->c->x;
    if (axis->scale == CHART_LINEAR) {
        for (double i = ceil(axis->low / axis->step); i * axis->step <= axis->high * (1 + 1e-9); i++)
            draw_tick(p, is_y, i * axis->step, 1);
        return;
    }
    double many = log10(axis->high / axis->low);
    int first = (int)floor(log10(axis->low)), last = (int)ceil(log10(axis->high));
    for (int power = first; power <= last; power++) {
        draw_tick(p, is_y, pow(10, power), power % (many > 9 ? 2 : 1) == 0);
        for (int digit = 2; digit < 10; digit++)
            draw_tick(p, is_y, digit * pow(10, power), many < 2.5 && (digit == 2 || digit == 5));
    }
}

static void draw_frame(picture *p)
{
    FILE *file = p->file;
    double bottom = p->top + p->height + p->band;
    draw_ticks(p, 0);
    draw_ticks(p, 1);
    svg_text(file, "ink", SVG_MIDDLE, p->left + p->width / 2, bottom + 38, p->c->x.label);
    fprintf(file, "<g transform=\"translate(15 %.1f) rotate(-90)\">", p->top + p->height / 2);
    svg_text(file, "ink", SVG_MIDDLE, 0, 0, p->c->y.label);
    fprintf(file, "</g>\n<rect class=\"axis\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", p->left,
            p->top, p->width, p->height + p->band);
    if (p->band > 0) {
        write_line(file, "axis", p->left, p->top + p->height, p->left + p->width, p->top + p->height);
        svg_text(file, "tick quiet", SVG_END, p->left - 6, bottom - p->band / 2 + 4, p->c->zero);
    }
    if (p->c->title)
        svg_text(file, "title ink", SVG_START, p->left, 18, p->c->title);
}

/* ---- series -------------------------------------------------------------------------------------- */

static void take(picture *p, double x, double y, double around)
{
    if (p->count < BOXES_MAX)
        p->taken[p->count++] = (box){x - around, y - around, x + around, y + around};
}

static int is_inside(const picture *p, double x, double y)
{
    double across = place_of(&p->c->x, x), up = place_of(&p->c->y, y);
    return across > -1e-6 && across < 1 + 1e-6 && ((up > -1e-6 && up < 1 + 1e-6) || (p->band > 0 && y == 0));
}

static const char *const dashes[] = {"", "", " stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 3\""};

static void draw_line(picture *p, const chart_series *s)
{
    double last_x = NAN, last_y = NAN;
    fprintf(p->file, "<path class=\"line l%u\"%s d=\"", s->colour, dashes[s->line]);
    for (size_t i = 0; i < s->count; i++) {
        double x = pixel(p, 0, s->x[i]), y = pixel(p, 1, s->y[i]);
        if (is_inside(p, s->x[i], s->y[i])) {
            fprintf(p->file, "%c%.1f %.1f", isnan(last_x) ? 'M' : 'L', x, y);
            double steps = s->texts && !isnan(last_x) ? ceil(hypot(x - last_x, y - last_y) / 6) : 0;
            for (double k = 0; k < steps; k++) /* labels keep off the line */
                take(p, last_x + (x - last_x) * k / steps, last_y + (y - last_y) * k / steps, 3);
        }
        last_x = is_inside(p, s->x[i], s->y[i]) ? x : (double)NAN;
        last_y = y;
    }
    fputs("\"/>\n", p->file);
}

static void draw_mark(FILE *file, chart_mark mark, unsigned colour, double x, double y)
{
    static const char *const outlines[] = {"", "", "", "M-3.6-3.6h7.2v7.2h-7.2z", "M0-5L4.7 3.4H-4.7z"};
    if (mark == CHART_DOT)
        fprintf(file, "<circle class=\"f%u\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", colour, x, y, radius);
    else if (mark == CHART_RING)
        fprintf(file, "<circle class=\"mark hollow l%u\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", colour, x, y,
                radius + 4);
    else
        fprintf(file, "<path class=\"f%u\" transform=\"translate(%.1f %.1f)\" d=\"%s\"/>\n", colour, x, y,
                outlines[mark]);
}

static double text_width(const char *text)
{
    double glyphs = 0;
    for (; *text; text++)
        glyphs += ((unsigned char)*text & 0xc0) != 0x80; /* the first byte of each character of UTF-8 */
    return glyphs * glyph_width;
}

/* The entries one after the other, from the left of the frame. */
static void draw_key(const picture *p)
{
    double x = p->left, y = p->top - 14;
    for (size_t i = 0; i < p->c->key_count; i++) {
        const chart_key *key = &p->c->key[i];
        if (key->mark != CHART_NO_MARK)
            draw_mark(p->file, key->mark, key->colour, x + 6, y);
        else
            fprintf(p->file, "<path class=\"line%s l%u\"%s d=\"M%.1f %.1fh18\"/>\n",
                    key->line == CHART_NO_LINE ? " swatch" : "", key->colour, dashes[key->line], x - 2, y);
        svg_text(p->file, "tick quiet", SVG_START, x + 20, y + 4, key->text);
        x += 36 + text_width(key->text);
    }
}

/* ---- labels -------------------------------------------------------------------------------------- */

static double overlap(const box *a, const box *b)
{
    double width = fmin(a->right, b->right) - fmax(a->left, b->left);
    double height = fmin(a->bottom, b->bottom) - fmax(a->top, b->top);
    return width > 0 && height > 0 ? width * height : 0;
}

/* Tries places around the point, near ones first, and takes the one where the text covers least of the drawing;
 * where a third of it would cover something, or any of it a label, it is left out. */
static void label_point(picture *p, double x, double y, unsigned colour, const char *text)
{
    static const double distances[] = {7, 12, 20, 30, 42, 56};
    const box bounds = {p->left + 2, p->top + 2, p->left + p->width - 2, p->top + p->height + p->band - 2};
    double width = text_width(text), area = width * text_height, least = HUGE_VAL, least_covered = 0, chosen = 0;
    box best = {0, 0, 0, 0};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 12; k++) {
            double turn = k * acos(-1.0) / 6, cx = x + cos(turn) * (distances[i] + width / 2);
            double cy = y + sin(turn) * (distances[i] + text_height / 2), sum = 0;
            box at = {cx - width / 2, cy - text_height / 2, cx + width / 2, cy + text_height / 2};
            for (size_t n = 0; n < p->count; n++)
                sum += (n < p->marks ? 1 : 20) * overlap(&at, &p->taken[n]);
            sum += 20 * (area - overlap(&at, &bounds));
            double cost = sum + 1.5 * distances[i] + (k % 6 == 0 ? 0 : 2);
            if (cost < least) {
                least = cost;
                least_covered = sum;
                best = at;
                chosen = distances[i];
            }
        }
    if (least_covered > area / 3 || p->count == BOXES_MAX)
        return;
    if (chosen > 14)
        write_line(p->file, "lead", x, y, fmin(fmax(x, best.left), best.right),
                   fmin(fmax(y, best.top), best.bottom));
    p->taken[p->count++] = best;
    char kind[16];
    snprintf(kind, sizeof kind, "name t%u", colour);
    svg_text(p->file, kind, SVG_START, best.left, best.bottom - 2.5, text);
}

/* ---- the whole ----------------------------------------------------------------------------------- */

static void draw_inside(FILE *file, const chart *c)
{
    const double band = c->zero ? c->band : 0, top = (c->title ? 30 : 10) + (c->key_count ? 20 : 0);
    picture p = {file, c, 66, top, c->width - 66 - 20, c->height - top - 50 - band, band, {{0, 0, 0, 0}}, 0, 0};
    draw_frame(&p);
    draw_key(&p);
    for (double x = 0; band > 0 && x < p.width; x += 6)
        take(&p, p.left + x, p.top + p.height, 3);
    for (const chart_series *s = c->series; s < c->series + c->count; s++) {
        if (s->line != CHART_NO_LINE)
            draw_line(&p, s);
        for (size_t i = 0; i < s->count && s->mark != CHART_NO_MARK; i++)
            if (is_inside(&p, s->x[i], s->y[i])) {
                const double x = pixel(&p, 0, s->x[i]), y = pixel(&p, 1, s->y[i]);
                draw_mark(file, s->mark, s->colour, x, y);
                take(&p, x, y, radius + (s->mark == CHART_RING ? 6 : 2));
            }
    }
    p.marks = p.count;
    for (const chart_series *s = c->series; s < c->series + c->count; s++)
        for (size_t i = 0; s->texts && i < s->count; i++)
            if (s->texts[i][0] && is_inside(&p, s->x[i], s->y[i]))
                label_point(&p, pixel(&p, 0, s->x[i]), pixel(&p, 1, s->y[i]), s->colour, s->texts[i]);
    fputs("</svg>\n", file);
}

static void open_element(FILE *file, double left, double top, double width, double height, const char *about)
{
    fprintf(
        file,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" class=\"chart\" "
        "x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" role=\"img\" "
        "aria-label=\"",
        left, top, width, height, width, height);
    svg_escape(file, about);
    fputs("\">\n", file);
}

void chart_draw(FILE *file, const chart *c)
{
    open_element(file, c->left, c->top, c->width, c->height, c->title);
    draw_inside(file, c);
}

void chart_begin_alone(FILE *file, double width, double height, const char *about)
{
    open_element(file, 0, 0, width, height, about);
    fputs("<style>\n", file);
    chart_style(file);
    fputs("</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n", file);
}

void chart_draw_alone(FILE *file, const chart *c)
{
    chart_begin_alone(file, c->width, c->height, c->title);
    draw_inside(file, c);
}
