/* The page of a comparison: results, pictures (comparison_pictures.c), curves, agreement. */
#include "compare/comparison.h"

#include <math.h>

#include "draw/chart.h"
#include "draw/svg.h"

/* ---- sections ---- */

static int write_result(html_page *page, const comparison *r)
{
    char lead[256];
    snprintf(lead, sizeof lead, "Equal time is the %.1f s of processors that %s took for %llu samples a pixel.",
             r->contest->way[0].by_time.seconds, r->contest->way[0].name, (unsigned long long)r->contest->samples);
    page_section(page, "result", "What came out", lead);
    int good = page_table(page, comparison_figures(r));
    fprintf(page->html,
            "<p class=\"note\">The error of a pixel is that of its luminance, beside its luminance in "
            "the reference and %.0f%% of the mean one; the figure is the root of the mean square of "
            "all pixels, %s. In brackets: without fireflies, the worst thousandth of the pixels. "
            "Efficiency: one over error squared and time, that of %s is 1; its standard deviation is "
            "from the spread of the pixels' errors, and rather too large. In equal time the others "
            "stop at the first sample of all pixels that ends beyond it.</p>\n",
            100 * ERROR_FLOOR,
            r->reference_read ? "with the noise of the reference, which was read and whose noise nobody knows"
                              : "less the noise of the reference",
            r->contest->way[0].name);
    if (r->remarks[0]) {
        fputs("<p class=\"note\">", page->html);
        svg_escape(page->html, r->remarks);
        fputs("</p>\n", page->html);
    }
    page_section_end(page);
    return good;
}

/* ---- curves ---- */

static const chart_mark marks[WAYS_MAX] = {CHART_DOT,  CHART_CROSS,    CHART_SQUARE, CHART_DIAMOND,
                                           CHART_RING, CHART_TRIANGLE, CHART_DOT,    CHART_SQUARE};

static void draw_curves(FILE *html, const comparison *r, int by_time)
{
    double x[WAYS_MAX][POINTS_MAX], y[WAYS_MAX][POINTS_MAX];
    chart_series series[WAYS_MAX];
    const contest *c = r->contest;
    for (size_t i = 0; i < c->count; i++) {
        const way *w = &c->way[i];
        for (size_t k = 0; k < w->points; k++) {
            x[i][k] = by_time ? w->point[k].seconds : (double)w->point[k].samples;
            y[i][k] = w->point[k].error.trimmed;
        }
        series[i] = (chart_series){w->name, x[i], y[i], w->points, (unsigned)i, marks[i], CHART_SOLID, NULL};
    }
    chart drawn = {.title = by_time ? "Error against time" : "Error against samples",
                   .width = CHART_WIDTH,
                   .height = CHART_HEIGHT,
                   .right = 120,
                   .x = {CHART_LOG, 0, 0, 0, by_time ? "seconds of processors" : "samples a pixel"},
                   .y = {CHART_LOG, 0, 0, 0, "relative error, without fireflies"},
                   .series = series,
                   .count = c->count};
    chart_fit_series(&drawn, 0);
    fputs("<figure>\n", html);
    chart_draw(html, &drawn);
    fputs("</figure>\n", html);
}

static void add_point(text_table *t, const way *w, const contest_point *p, int is_equal_time)
{
    table_row(t);
    table_text(t, "way", w->name);
    table_number(t, "samples", "%.0f", (double)p->samples);
    table_value(t, "seconds", p->seconds);
    table_value(t, "error", p->error.relative);
    table_value(t, "error_without_fireflies", p->error.trimmed);
    table_value(t, "is_equal_time", is_equal_time);
}

static int write_points(html_page *page, const contest *c)
{
    text_table data = {.rows = 0};
    for (size_t i = 0; i < c->count; i++) {
        for (size_t k = 0; k < c->way[i].points; k++)
            add_point(&data, &c->way[i], &c->way[i].point[k], 0);
        add_point(&data, &c->way[i], &c->way[i].by_time, 1);
    }
    return page_data(page, "points.csv", "error against samples and time", data);
}

static int write_curves(html_page *page, const comparison *r)
{
    page_section(page, "curves", "Error against samples and time",
                 "Both fall as one over the root where nothing but noise is left; a curve that bends to the right "
                 "has reached an error that is not noise.");
    fputs("<div class=\"pair\">\n", page->html);
    draw_curves(page->html, r, 0);
    draw_curves(page->html, r, 1);
    fputs("</div>\n", page->html);
    int good = write_points(page, r->contest);
    page_section_end(page);
    return good;
}

/* ---- agreement ---- */

static int write_agreement(html_page *page, const comparison *r)
{
    page_section(page, "agreement", "Do they show the same?",
                 "Against the reference, which has numbers of its own: differences of blocks of 16 x 16 pixels, "
                 "in standard deviations. Noise with fireflies is underestimated, and its blocks stray more.");
    int good = page_table(page, comparison_agreement(r));
    if (r->reference_read)
        fputs("<p class=\"note\">The noise of the reference, which was read, counts as that of the ways.</p>\n",
              page->html);
    page_section_end(page);
    return good;
}

/* ---- all ---- */

/* Full images, for other computations: the reference, and the ways after equal time. */
static int add_image(html_page *page, const char *name, const film *f)
{
    image made;
    FILE *file = page_file_begin(page, name);
    int good = file && film_image(f, &made);
    if (good) {
        good = image_write_pfm(file, &made);
        image_free(&made);
    }
    return page_file_end(page) && good;
}

static void write_head(FILE *html, const comparison *r)
{
    fputs("<p class=\"lead\"><code>vndf compare ", html);
    svg_escape(html, r->arguments);
    fputs("</code></p>\n<nav><a href=\"#result\">What came out</a> <a href=\"#pictures\">Equal time</a> "
          "<a href=\"#samples\">Equal samples</a> <a href=\"#maps\">Error maps</a> <a href=\"#curves\">Curves</a> "
          "<a href=\"#agreement\">Agreement</a>",
          html);
    fputs(r->has_common ? " <a href=\"#tables\">What tables change</a></nav>\n" : "</nav>\n", html);
}

int comparison_page(html_page *page, const comparison *r)
{
    if (!page_begin(page, "vndf compare", r->title))
        return 0;
    write_head(page->html, r);
    if (!write_result(page, r) || !comparison_pictures(page, r) || !write_curves(page, r) ||
        !write_agreement(page, r) || (r->has_common && !comparison_changes(page, r)))
        return 0;
    int good = add_image(page, "reference.pfm", r->contest->reference);
    for (size_t i = 0; i < r->contest->count && good; i++) {
        char name[PAGE_NAME_MAX];
        page_name(name, r->contest->way[i].name, "time.pfm");
        good = add_image(page, name, &r->contest->way[i].at_time);
    }
    return good && page_end(page);
}
