/* Error against time; what a caller pays, with the file that `vndf bench` would write; and density and samples: D
 * itself, and the visible normals from three directions, for each distribution. */
#include <math.h>
#include <string.h>

#include "draw/chart.h"
#include "draw/panels.h"
#include "evidence/page/report.h"

/* ---- error against time -------------------------------------------------------------------------- */

/* One by one and in batches: published methods, closed forms, tables of 2, 3 and 4 moments; and what is advised; and
 * what the key says of marks and colours. */
enum {
    PUBLISHED,
    CLOSED,
    TABLES,
    WAYS = TABLES + 3,
    ADVISED = 2 * WAYS,
    KEY,
    SERIES_COUNT = KEY + 6,
    POINTS_MAX = 16
};

typedef struct frontier {
    chart_point point[KEY][POINTS_MAX];
    chart_series series[SERIES_COUNT];
} frontier;

static void add_point(frontier *f, int k, double x, double y, const char *label)
{
    if (f->series[k].count == POINTS_MAX || !(x > 0) || !(y >= 0))
        return;
    chart_point *to = &f->point[k][f->series[k].count++];
    *to = (chart_point){.x = x, .y = y};
    snprintf(to->label, sizeof to->label, "%s", label);
}

/* A row of D at hand, or of a closed form what is exact for it. A label leaves out what colour and shape say: of
 * tables it is the size alone, and only where there are 4 moments. */
static void add_row(frontier *f, const report *r, const evidence_row *of)
{
    const row_kind kind = of->m.kind;
    const int moments = (int)fmax(of->number[COL_MOMENTS], 2),
              way = kind == ROW_TABLE ? TABLES + moments - 2 : (int)kind;
    const int is_exact = kind == ROW_CLOSED || (kind == ROW_PUBLISHED && !strstr(of->m.name, "all normals"));
    char label[48] = "";
    if (kind > ROW_TABLE || (!is_exact && strcmp(of->of->name, r->subject[0].name) != 0))
        return;
    if (kind == ROW_TABLE && moments == 4)
        report_bytes(label, of->number[COL_FILE]);
    else if (kind == ROW_CLOSED)
        snprintf(label, sizeof label, "vndf_%.40s()", of->of->name);
    else if (kind == ROW_PUBLISHED)
        snprintf(label, sizeof label, "%.*s", (int)strcspn(of->m.name, ","), of->m.name);
    /* a comparison with a density cannot tell an exact method's error from the rounding of floats */
    const double tv = kind != ROW_TABLE && of->number[COL_TV] < 3e-6 ? 0 : of->number[COL_TV];
    add_point(f, way, of->number[COL_NS], tv, label);
    add_point(f, WAYS + way, of->number[r->batch], tv, label);
}

static void fill(frontier *f, const report *r, const char *batch)
{
    static const chart_mark marks[WAYS] = {CHART_TRIANGLE, CHART_SQUARE, CHART_DOT, CHART_DOT, CHART_DOT};
    static const chart_line lines[WAYS] = {CHART_NO_LINE, CHART_NO_LINE, CHART_DOTTED, CHART_DASHED, CHART_SOLID};
    const chart_series key[] = {{.name = "tables of vndf", .colour = 4, .mark = CHART_DOT},
                                {.name = "its closed forms", .colour = 4, .mark = CHART_SQUARE},
                                {.name = "published methods", .colour = 4, .mark = CHART_TRIANGLE},
                                {.name = "advised", .colour = 3, .mark = CHART_RING},
                                {.name = "one by one", .colour = 0},
                                {.name = batch, .colour = 1}};
    const vndf_distribution *table = r->subject[0].table[r->chosen[0]];
    const double tv = (double)vndf_distribution_info(table).certificate.tv_above;
    for (int k = 0; k < ADVISED; k++)
        f->series[k] =
            (chart_series){NULL, (unsigned)(k / WAYS), marks[k % WAYS], lines[k % WAYS], f->point[k], 0};
    f->series[ADVISED] = (chart_series){NULL, 3, CHART_RING, CHART_NO_LINE, f->point[ADVISED], 0};
    memcpy(f->series + KEY, key, sizeof key);
    for (const evidence_row *of = r->found->row; of < r->found->row + r->found->count; of++)
        add_row(f, r, of);
    add_point(f, ADVISED, report_number(r, table, COL_NS), tv, "advised");
    add_point(f, ADVISED, report_number(r, table, r->batch), tv, "advised");
}

int report_frontier(html_page *page, const report *r)
{
    char title[160], batch[40];
    FILE *alone = page_file(page, "frontier.svg");
    frontier f = {.point = {{{0}}}};
    if (!alone)
        return 0;
    snprintf(title, sizeof title, "Tables of %s beside other methods", r->subject[0].name);
    snprintf(batch, sizeof batch, "in a batch, %s", r->instructions);
    fill(&f, r, batch);
    chart c = {.title = title,
               .box = {0, 0, 1080, 640},
               .x = {CHART_LOG, 0, 0, 0, "nanoseconds per sample (view, sample and density; one thread)"},
               .y = {CHART_LOG, 0, 0, 0, "total variation, worst angle above the horizon"},
               .zero = "exact",
               .band = 90,
               .series = f.series,
               .count = SERIES_COUNT};
    chart_fit(&c, 7);
    fputs("<figure class=\"scroll wide\" title=\"error against time\">\n", page->html);
    chart_draw(page->html, &c, 0);
    fputs("</figure>\n<p class=\"note\"><a href=\"frontier.svg\">frontier.svg</a></p>\n", page->html);
    chart_draw(alone, &c, 1);
    return 1;
}

/* ---- what a caller pays -------------------------------------------------------------------------- */

int report_times(html_page *page, const report *r)
{
    figures t = {.rows = 0};
    for (const evidence_row *of = r->found->row; of < r->found->row + r->found->count; of++) {
        figures_record(&t);
        figures_text(&t, "distribution", of->of->name);
        figures_text(&t, "method", of->m.name);
        figures_time(&t, "one by one", of->number[COL_NS]);
        figures_time(&t, "of one direction", of->number[COL_SHARED]);
        figures_time(&t, "in a batch", of->number[r->batch]);
        figures_number(&t, "efficiency, 60", "%.3g", of->number[COL_EFF_60], "");
        figures_number(&t, "85", "%.3g", of->number[COL_EFF_85], "");
    }
    int good = page_table(page, &t);
    figures_free(&t);
    FILE *data = good ? page_file(page, "methods.csv") : NULL;
    if (!data || !evidence_print(data, r->found, FIGURES_CSV))
        return 0;
    page_link(page, "all methods, as vndf bench -o FILE.csv has them");
    return 1;
}

/* ---- density and samples ------------------------------------------------------------------------- */

int report_normals(html_page *page, const report *r)
{
    static const double thetas[] = {0, 60, 100};
    for (size_t i = 0; i < r->count; i++) {
        const vndf_surface advised = {r->subject[i].table[r->chosen[i]], 1, 1},
                           finest = {r->subject[i].table[SIZE_FINE], 1, 1};
        fputs("<h3>", page->html);
        svg_escape(page->html, r->subject[i].name);
        fputs("</h3>\n<figure class=\"panels\">\n", page->html);
        panel_ndf(page->html, (svg_box){0, 0, 340, 282}, &finest);
        for (unsigned v = 0; v < 3; v++)
            if (!panel_disc(page->html, (svg_box){0, 0, 250, 282}, &advised, thetas[v], v + 1))
                return complain(page->command, "no memory"), 0;
        fputs("</figure>\n", page->html);
    }
    return 1;
}
