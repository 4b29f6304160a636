/* The frontier: error against time. Every row of tools/bench/bench.h is a point; a curve for each instruction set and
 * number of moments joins the tables of this library over their sizes. Exact methods stand in a band of their own: a
 * logarithm has no 0. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/chart.h"
#include "report/report.h"

enum { ROWS_MAX = 96, LABEL = 160, SERIES_MAX = 24 };

static const char *const sets[] = {"scalar", "portable", "avx2", "avx512"};
static const char *const set_names[] = {"one by one", "batch, portable", "batch, AVX2", "batch, AVX-512"};
static const unsigned set_colours[] = {0, 3, 2, 1};

enum { SETS = sizeof sets / sizeof sets[0] };

static const double rounding = 3e-6;

typedef struct frontier {
    double x[SERIES_MAX][ROWS_MAX], y[SERIES_MAX][ROWS_MAX];
    char label[SERIES_MAX][ROWS_MAX][LABEL];
    const char *text[SERIES_MAX][ROWS_MAX];
    chart_series series[SERIES_MAX];
    size_t count;
    chart_range x_range, y_range;
    char title[160];
    chart_key key[3 + SETS];
    size_t key_count;
} frontier;

static int is_shown(const bench_row *row)
{
    return row->kind <= BENCH_TABLE && !row->wrong && row->ns > 0 && row->tv >= 0 && row->tv <= 1;
}

/* 1 if the method's name says what it samples, in any case of letters. */
static int names_distribution(const bench_row *row)
{
    size_t length = strlen(row->distribution);
    for (const char *at = row->method; *at; at++) {
        size_t same = 0;
        while (same < length && at[same] &&
               tolower((unsigned char)at[same]) == tolower((unsigned char)row->distribution[same]))
            same++;
        if (same == length)
            return 1;
    }
    return 0;
}

/* A table's label is its size alone: shape and line tell the rest, and colours tell batches. */
static void label_row(const bench_row *row, char label[LABEL])
{
    const char *batch = strstr(row->method, ", batch");
    int length = batch ? (int)(batch - row->method) : (int)strlen(row->method);
    if (row->kind == BENCH_TABLE)
        table_bytes_text(label, (double)row->file_bytes);
    else if (names_distribution(row) || row->memory > 0)
        snprintf(label, LABEL, "%.*s", length, row->method);
    else
        snprintf(label, LABEL, "%.*s, %s", length, row->method, row->distribution);
}

/* The error of an exact method is the rounding of floats; a comparison with a density cannot tell it from another error
 * of that size. */
static double error_of(const bench_row *row)
{
    return row->kind != BENCH_TABLE && row->tv < rounding ? 0 : row->tv;
}

static void add_row(frontier *f, const bench_row *row)
{
    chart_series *s = &f->series[f->count];
    size_t at = s->count;
    if (at == ROWS_MAX)
        return;
    f->x[f->count][at] = row->ns;
    f->y[f->count][at] = error_of(row);
    label_row(row, f->label[f->count][at]);
    f->text[f->count][at] = f->label[f->count][at];
    s->count++;
    chart_widen(&f->x_range, row->ns);
    chart_widen(&f->y_range, f->y[f->count][at]);
}

/* Makes a series of the rows of one kind, instruction set and number of moments (0: no table), if there are any. */
static void add_series(frontier *f, const bench_rows *rows, bench_kind kind, size_t set, int moments)
{
    static const chart_mark marks[] = {CHART_TRIANGLE, CHART_SQUARE, CHART_DOT};
    static const chart_line lines[] = {CHART_NO_LINE, CHART_NO_LINE, CHART_DOTTED, CHART_DASHED, CHART_SOLID};
    chart_series *s = &f->series[f->count];
    *s = (chart_series){NULL,        f->x[f->count], f->y[f->count],   0, set_colours[set],
                        marks[kind], lines[moments], f->text[f->count]};
    for (size_t i = 0; i < rows->count; i++)
        if (rows->row[i].kind == kind && rows->row[i].moments == moments && is_shown(&rows->row[i]) &&
            strcmp(rows->row[i].instructions, sets[set]) == 0)
            add_row(f, &rows->row[i]);
    f->count += s->count > 0;
}

static void collect(frontier *f, const bench_rows *rows)
{
    *f = (frontier){.x_range = {HUGE_VAL, 0}, .y_range = {HUGE_VAL, 0}};
    for (size_t set = 0; set < SETS; set++) {
        add_series(f, rows, BENCH_PUBLISHED, set, 0);
        add_series(f, rows, BENCH_CLOSED, set, 0);
        for (int moments = 2; moments <= 4; moments++)
            add_series(f, rows, BENCH_TABLE, set, moments);
    }
}

/* Shapes name the method, colours the number of samples at once. The key names the colours that occur. */
static void fill_key(frontier *f)
{
    static const chart_key shapes[] = {{"tables of this library", 7, CHART_DOT},
                                       {"its closed forms", 7, CHART_SQUARE},
                                       {"others' methods, from the publications", 7, CHART_TRIANGLE}};
    f->key_count = 0;
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        f->key[f->key_count++] = shapes[i];
    for (size_t set = 0; set < SETS; set++) {
        int seen = 0;
        for (size_t k = 0; k < f->count; k++)
            seen = seen || f->series[k].colour == set_colours[set];
        if (seen)
            f->key[f->key_count++] = (chart_key){set_names[set], set_colours[set], CHART_NO_MARK};
    }
}

static chart chart_of(frontier *f, const char *name)
{
    snprintf(f->title, sizeof f->title, "Error against time: tables of %s beside other methods", name);
    fill_key(f);
    chart c = {.title = f->title,
               .width = 1080,
               .height = 710,
               .right = 20,
               .x = {CHART_LOG, 0, 0, 0, "nanoseconds per sample (view, sample and density; one thread)"},
               .y = {CHART_LOG, 0, 0, 0, "total variation to the reference, worst angle above the horizon"},
               .zero = "exact",
               .band = 100,
               .series = f->series,
               .count = f->count,
               .key = f->key,
               .key_count = f->key_count};
    chart_fit(&c.x, f->x_range.low, f->x_range.high);
    chart_fit(&c.y, fmax(f->y_range.low, 1e-7), f->y_range.high);
    c.x.low = fmax(c.x.low, f->x_range.low / 1.6);
    c.x.high = fmin(c.x.high, f->x_range.high * 2.5);
    return c;
}

static int write_data(html_page *page, const bench_rows *rows)
{
    FILE *data = page_file_begin(page, "frontier.csv");
    return data && bench_print(data, rows, FIGURES_CSV) &&
           page_data_end(page, "all methods, as `vndf bench -o FILE.csv` has them");
}

static int write_alone(html_page *page, const chart *c)
{
    FILE *file = page_file_begin(page, "frontier.svg");
    if (!file)
        return 0;
    chart_draw_alone(file, c);
    return page_file_end(page);
}

int report_write_frontier(html_page *page, const report *r)
{
    frontier *f = malloc(sizeof *f);
    if (!f)
        return 0;
    collect(f, &r->rows);
    chart c = chart_of(f, r->subject[0].name);
    page_section(
        page, "frontier", "Error against time",
        "Every way of sampling visible normals that was measured here: further left is faster, further down "
        "nearer to the reference. Curves join tables of 2, 4 and 8 KiB: solid ones 4 moments, dashed ones 3, dotted "
        "ones 2. Tables are exact with their weight; the weight mends the error shown. The band at the bottom "
        "holds methods that are exact but for the rounding of floats.");
    fputs("<figure class=\"scroll wide\">\n", page->html);
    chart_draw(page->html, &c);
    fputs("<p class=\"note\"><a href=\"frontier.svg\">frontier.svg</a></p></figure>\n", page->html);
    int good = write_data(page, &r->rows) && write_alone(page, &c);
    free(f);
    page_section_end(page);
    return good;
}
