/* Error against time. */
#include <stdio.h>
#include <string.h>

#include "draw/chart.h"
#include "evidence/page/report.h"

enum { POINTS_MAX = 16, LABEL = 80, SERIES_MAX = 12 };

/* Series and their points, in the making. */
typedef struct plot {
    double x[SERIES_MAX][POINTS_MAX], y[SERIES_MAX][POINTS_MAX];
    char label[SERIES_MAX][POINTS_MAX][LABEL];
    const char *text[SERIES_MAX][POINTS_MAX];
    chart_series series[SERIES_MAX];
    size_t count;
} plot;

static void begin_series(plot *p, unsigned colour, chart_mark mark, chart_line line)
{
    size_t k = p->count++;
    p->series[k] = (chart_series){p->x[k], p->y[k], 0, colour, mark, line, p->text[k]};
}

static void add_point(plot *p, double x, double y, const char *label)
{
    size_t k = p->count - 1, i = p->series[k].count;
    if (i == POINTS_MAX || !(x > 0) || !(y >= 0))
        return;
    p->x[k][i] = x;
    p->y[k][i] = y;
    snprintf(p->label[k][i], LABEL, "%s", label);
    p->text[k][i] = p->label[k][i];
    p->series[k].count++;
}

/* Of D at hand, and of closed forms what is exact for them. */
static int is_wanted(const report *r, const evidence_row *of, row_kind kind, int moments, int is_batch)
{
    int is_exact = kind == ROW_CLOSED || (kind == ROW_PUBLISHED && !strstr(of->method, "all normals"));
    int is_at_hand = is_exact || strcmp(of->distribution, r->subject[0].of.name) == 0;
    return of->kind == kind && is_at_hand && of->number[COL_TV] <= 1 &&
           (kind != ROW_TABLE || of->number[COL_MOMENTS] == moments) &&
           strcmp(of->instructions, is_batch ? r->batch : "scalar") == 0;
}

/* A label leaves out what colour and shape say: of tables it is the size alone, and only where there are 4
 * moments. */
static void add_rows(plot *p, const report *r, row_kind kind, int moments, int is_batch)
{
    static const chart_mark marks[] = {CHART_TRIANGLE, CHART_SQUARE, CHART_DOT};
    static const chart_line lines[] = {CHART_NO_LINE, CHART_NO_LINE, CHART_DOTTED, CHART_DASHED, CHART_SOLID};
    begin_series(p, is_batch ? 1 : 0, marks[kind], lines[moments]);
    for (const evidence_row *of = r->rows.row; of < r->rows.row + r->rows.count; of++) {
        double tv = of->number[COL_TV];
        char label[LABEL] = "";
        if (!is_wanted(r, of, kind, moments, is_batch))
            continue;
        if (kind == ROW_TABLE && moments == 4)
            table_bytes_text(label, of->number[COL_FILE]);
        else if (kind == ROW_CLOSED)
            snprintf(label, sizeof label, "vndf_%.40s()", of->distribution);
        else if (kind == ROW_PUBLISHED)
            snprintf(label, sizeof label, "%.*s", (int)strcspn(of->method, ","), of->method);
        /* a comparison with a density cannot tell an exact method's error from the rounding of floats */
        add_point(p, of->number[COL_NS], kind != ROW_TABLE && tv < 3e-6 ? 0 : tv, label);
    }
    p->count -= p->series[p->count - 1].count == 0;
}

static void fill(plot *p, const report *r)
{
    const report_subject *s = &r->subject[0];
    const double tv = (double)vndf_distribution_info(s->of.table[s->chosen]).certificate.tv_above;
    for (int is_batch = 0; is_batch < 2; is_batch++) {
        add_rows(p, r, ROW_PUBLISHED, 0, is_batch);
        add_rows(p, r, ROW_CLOSED, 0, is_batch);
        for (int moments = 2; moments <= 4; moments++)
            add_rows(p, r, ROW_TABLE, moments, is_batch);
    }
    begin_series(p, 3, CHART_RING, CHART_NO_LINE);
    add_point(p, s->ns[s->chosen], tv, "advised");
    add_point(p, s->batch[s->chosen], tv, "advised");
}

int report_frontier(html_page *page, const report *r)
{
    char title[160], batch[40];
    FILE *alone = page_file(page, "frontier.svg");
    plot p = {.count = 0};
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
               .count = p.count,
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
