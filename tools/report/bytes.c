/* Error against bytes in memory: each distribution has a curve over its tables, and other methods with tables are
 * points. */
#include <stdio.h>
#include <string.h>

#include "draw/chart.h"
#include "report/report.h"

enum { ROWS_MAX = 64, LABEL = 80 };

typedef struct byte_points {
    double x[ROWS_MAX], y[ROWS_MAX];
    char label[ROWS_MAX][LABEL];
    const char *text[ROWS_MAX];
    size_t count;
} byte_points;

static void collect_others(const bench_rows *rows, byte_points *points)
{
    points->count = 0;
    for (size_t i = 0; i < rows->count && points->count < ROWS_MAX; i++) {
        const bench_row *row = &rows->row[i];
        if (row->kind != BENCH_PUBLISHED || row->memory == 0 || !(row->tv > 0))
            continue;
        size_t at = points->count++;
        points->x[at] = (double)row->memory;
        points->y[at] = row->tv;
        snprintf(points->label[at], LABEL, "%s", row->method);
        points->text[at] = points->label[at];
    }
}

static void add_row(text_table *t, const char *method, const char *distribution, double memory, double file_bytes,
                    double tv)
{
    table_row(t);
    table_text(t, "method", method);
    table_text(t, "distribution", distribution);
    table_number(t, "memory", "%.0f", memory);
    table_number(t, "file_bytes", "%.0f", file_bytes);
    table_value(t, "tv", tv);
}

static int write_data(html_page *page, const report *r, const byte_points *others)
{
    text_table data = {.rows = 0};
    for (size_t k = 0; k < r->count; k++)
        for (size_t i = 0; i < r->subject[k].count; i++) {
            const report_table *of = &r->subject[k].table[i];
            add_row(&data, "table", r->subject[k].name, (double)of->info.memory, (double)of->info.bytes,
                    of->tv_above);
        }
    for (size_t i = 0; i < others->count; i++)
        add_row(&data, others->label[i], r->subject[0].name, others->x[i], 0, others->y[i]);
    return page_data(page, "bytes.csv", "total variation of each size", data);
}

enum { LABEL_MOST = 36 };

/* A formula may be longer than there is room beside a curve. */
static void shorten(const char *text, char label[LABEL_MOST])
{
    snprintf(label, LABEL_MOST, "%s", text);
    if (strlen(text) >= LABEL_MOST)
        memcpy(label + LABEL_MOST - 4, "...", 4);
}

int report_write_bytes(html_page *page, const report *r)
{
    static const unsigned colours[REPORT_SUBJECTS] = {0, 1, 2, 3};
    static const chart_mark marks[REPORT_SUBJECTS] = {CHART_DOT, CHART_SQUARE, CHART_TRIANGLE, CHART_DIAMOND};
    double x[REPORT_SUBJECTS][REPORT_SIZES], y[REPORT_SUBJECTS][REPORT_SIZES];
    char label[REPORT_SUBJECTS][LABEL_MOST];
    chart_series series[REPORT_SUBJECTS + 1];
    byte_points others;
    for (size_t k = 0; k < r->count; k++) {
        for (size_t i = 0; i < r->subject[k].count; i++) {
            x[k][i] = (double)r->subject[k].table[i].info.memory;
            y[k][i] = r->subject[k].table[i].tv_above;
        }
        shorten(r->subject[k].name, label[k]);
        series[k] =
            (chart_series){label[k], x[k], y[k], r->subject[k].count, colours[k], marks[k], CHART_SOLID, NULL};
    }
    collect_others(&r->rows, &others);
    series[r->count] =
        (chart_series){NULL, others.x, others.y, others.count, 7, CHART_CROSS, CHART_NO_LINE, others.text};
    chart c = {.about = "error against bytes",
               .width = 1080,
               .height = 460,
               .right = 270,
               .x = {CHART_BYTES, 0, 0, 0, "memory that the table takes"},
               .y = {CHART_LOG, 0, 0, 0, "total variation, worst angle above the horizon"},
               .series = series,
               .count = r->count + 1};
    chart_fit_series(&c, 0);
    page_section(
        page, "bytes", "Error against bytes",
        "The largest total variation from above the horizon, by the memory that a loaded table takes. Curves: "
        "tables of this library. Crosses: other methods that keep tables, for the first distribution.");
    fputs("<figure class=\"scroll wide\">\n", page->html);
    chart_draw(page->html, &c);
    fputs("</figure>\n", page->html);
    int good = write_data(page, r, &others);
    page_section_end(page);
    return good;
}
