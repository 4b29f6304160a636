/* Error against bytes in memory: a curve over its tables for each distribution, and other methods that have tables as
 * points. */
#include <math.h>
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

static void widen(double value, double *low, double *high)
{
    if (!(value > 0))
        return;
    *low = fmin(*low, value);
    *high = fmax(*high, value);
}

static void fit_axes(chart *c)
{
    double low_x = HUGE_VAL, high_x = 0, low_y = HUGE_VAL, high_y = 0;
    for (size_t k = 0; k < c->count; k++)
        for (size_t i = 0; i < c->series[k].count; i++) {
            widen(c->series[k].x[i], &low_x, &high_x);
            widen(c->series[k].y[i], &low_y, &high_y);
        }
    chart_fit(&c->x, low_x, high_x);
    chart_fit(&c->y, low_y, high_y);
}

static int write_data(html_page *page, const report *r, const byte_points *others)
{
    FILE *data = page_file_begin(page, "bytes.csv");
    if (!data)
        return 0;
    fputs("method,distribution,memory,file_bytes,tv\n", data);
    for (size_t k = 0; k < r->count; k++)
        for (size_t i = 0; i < r->subject[k].count; i++) {
            fputs("table,", data);
            page_field(data, r->subject[k].name);
            const report_table *t = &r->subject[k].table[i];
            fprintf(data, ",%zu,%zu,%.5g\n", t->info.memory, t->info.bytes, t->tv);
        }
    for (size_t i = 0; i < others->count; i++) {
        page_field(data, others->label[i]);
        fputc(',', data);
        page_field(data, r->subject[0].name);
        fprintf(data, ",%.0f,0,%.5g\n", others->x[i], others->y[i]);
    }
    return page_data_end(page, "total variation of each size");
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
            y[k][i] = r->subject[k].table[i].tv;
        }
        shorten(r->subject[k].name, label[k]);
        series[k] =
            (chart_series){label[k], x[k], y[k], r->subject[k].count, colours[k], marks[k], CHART_SOLID, NULL};
    }
    collect_others(&r->rows, &others);
    series[r->count] =
        (chart_series){NULL, others.x, others.y, others.count, 7, CHART_CROSS, CHART_NO_LINE, others.text};
    chart c = {NULL,
               "error against bytes",
               1080,
               460,
               270,
               {CHART_BYTES, 0, 0, 0, "memory that the table takes"},
               {CHART_LOG, 0, 0, 0, "total variation, worst angle"},
               NULL,
               0,
               series,
               r->count + 1,
               NULL,
               0};
    fit_axes(&c);
    page_section(
        page, "bytes", "Error against bytes",
        "The largest total variation over all directions, by the memory that a loaded table takes. Curves: "
        "tables of this library. Crosses: other methods that keep tables, for the first distribution.");
    fputs("<figure class=\"scroll wide\">\n", page->html);
    chart_draw(page->html, &c);
    fputs("</figure>\n", page->html);
    int good = write_data(page, r, &others);
    page_section_end(page);
    return good;
}
