/* Error against time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/chart.h"
#include "evidence/page/report.h"

/* One by one and in batches: published methods, closed forms, tables of 2, 3 and 4 moments; and what is advised. */
enum {
    PUBLISHED,
    CLOSED,
    TABLES,
    WAYS = TABLES + 3,
    ADVISED = 2 * WAYS,
    SERIES_COUNT,
    POINTS_MAX = 16,
    LABEL = 80
};

typedef struct plot {
    double x[SERIES_COUNT][POINTS_MAX], y[SERIES_COUNT][POINTS_MAX];
    char label[SERIES_COUNT][POINTS_MAX][LABEL];
    const char *text[SERIES_COUNT][POINTS_MAX];
    chart_series series[SERIES_COUNT];
} plot;

static void add_point(plot *p, int k, double x, double y, const char *label)
{
    size_t i = p->series[k].count;
    if (i == POINTS_MAX || !(x > 0) || !(y >= 0))
        return;
    p->x[k][i] = x;
    p->y[k][i] = y;
    snprintf(p->label[k][i], LABEL, "%s", label);
    p->text[k][i] = p->label[k][i];
    p->series[k].count++;
}

/* A row of D at hand, or of a closed form what is exact for it. A label leaves out what colour and shape say: of
 * tables it is the size alone, and only where there are 4 moments. */
static void add_row(plot *p, const report *r, const evidence_row *of)
{
    const int is_batch = strcmp(of->instructions, r->batch) == 0, moments = (int)fmax(of->number[COL_MOMENTS], 2);
    const int is_exact =
        of->kind == ROW_CLOSED || (of->kind == ROW_PUBLISHED && !strstr(of->method, "all normals"));
    const double tv = of->number[COL_TV];
    char label[LABEL] = "";
    if (of->kind > ROW_TABLE || (!is_batch && strcmp(of->instructions, "scalar") != 0) ||
        (!is_exact && strcmp(of->distribution, r->subject[0].of.name) != 0))
        return;
    if (of->kind == ROW_TABLE && moments == 4)
        table_bytes_text(label, of->number[COL_FILE]);
    else if (of->kind == ROW_CLOSED)
        snprintf(label, sizeof label, "vndf_%.40s()", of->distribution);
    else if (of->kind == ROW_PUBLISHED)
        snprintf(label, sizeof label, "%.*s", (int)strcspn(of->method, ","), of->method);
    /* a comparison with a density cannot tell an exact method's error from the rounding of floats */
    add_point(p, is_batch * WAYS + (of->kind == ROW_TABLE ? TABLES + moments - 2 : (int)of->kind),
              of->number[COL_NS], of->kind != ROW_TABLE && tv < 3e-6 ? 0 : tv, label);
}

static void fill(plot *p, const report *r)
{
    static const chart_mark marks[WAYS] = {CHART_TRIANGLE, CHART_SQUARE, CHART_DOT, CHART_DOT, CHART_DOT};
    static const chart_line lines[WAYS] = {CHART_NO_LINE, CHART_NO_LINE, CHART_DOTTED, CHART_DASHED, CHART_SOLID};
    const report_subject *s = &r->subject[0];
    const double tv = (double)vndf_distribution_info(s->of.table[s->chosen]).certificate.tv_above;
    for (int k = 0; k < ADVISED; k++)
        p->series[k] = (chart_series){p->x[k],         p->y[k],         0,         (unsigned)(k / WAYS),
                                      marks[k % WAYS], lines[k % WAYS], p->text[k]};
    p->series[ADVISED] =
        (chart_series){p->x[ADVISED], p->y[ADVISED], 0, 3, CHART_RING, CHART_NO_LINE, p->text[ADVISED]};
    for (size_t i = 0; i < r->rows.count; i++)
        add_row(p, r, &r->rows.row[i]);
    add_point(p, ADVISED, s->ns[s->chosen], tv, "advised");
    add_point(p, ADVISED, s->batch[s->chosen], tv, "advised");
}

int report_frontier(html_page *page, const report *r)
{
    char title[160], batch[40];
    FILE *alone = page_file(page, "frontier.svg");
    plot p = {.x = {{0}}};
    if (!alone)
        return 0;
    fill(&p, r);
    snprintf(title, sizeof title, "Tables of %s beside other methods", r->subject[0].of.name);
    snprintf(batch, sizeof batch, "in a batch, %s", r->batch);
    const chart_key key[] = {{.text = "tables of vndf", .colour = 4, .mark = CHART_DOT},
                             {.text = "its closed forms", .colour = 4, .mark = CHART_SQUARE},
                             {.text = "published methods", .colour = 4, .mark = CHART_TRIANGLE},
                             {.text = "advised", .colour = 3, .mark = CHART_RING},
                             {.text = "one by one", .colour = 0},
                             {.text = batch, .colour = 1}};
    chart c = {.title = title,
               .width = 1080,
               .height = 640,
               .x = {CHART_LOG, 0, 0, 0, "nanoseconds per sample (view, sample and density; one thread)"},
               .y = {CHART_LOG, 0, 0, 0, "total variation, worst angle above the horizon"},
               .zero = "exact",
               .band = 90,
               .series = p.series,
               .count = SERIES_COUNT,
               .key = key,
               .key_count = sizeof key / sizeof *key};
    chart_fit(&c, 7);
    page_section(
        page, "frontier", "Error against time",
        "Further left is faster, further down nearer to the true visible normals. Curves join tables from 2 to "
        "32 KiB: solid ones have 4 moments, dashed ones 3, dotted ones 2. The weight mends the error of tables. "
        "Methods in the band at the bottom are exact but for the rounding of floats.");
    fputs("<figure class=\"scroll wide\" title=\"error against time\">\n", page->html);
    chart_draw(page->html, &c);
    fputs("</figure>\n<p class=\"note\"><a href=\"frontier.svg\">frontier.svg</a></p>\n", page->html);
    chart_draw_alone(alone, &c);
    return 1;
}
