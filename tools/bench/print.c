/* The rows of the benchmark as a list of columns: for people, as text or Markdown, and with every number as CSV. */
#include <math.h>

#include "bench/parts.h"
#include "draw/table.h"

static const char legend[] =
    "memory: bytes of its tables when loaded; file: of a table of ours on disk.\n"
    "ns: view, sample and density, a direction each (median of turns; spread: half of what lies between "
    "quartiles);\n"
    "shared: many samples for one direction; latency: each waits for the last; ratio: to spherical caps, scalar.\n"
    "TV above, below: largest total variation to the true visible normals from above the horizon and from all\n"
    "directions; weight: largest true over drawn density. Sobol': RMSE of 64 scrambled Sobol' points over that of\n"
    "spherical caps. eff: 1/(variance time) over that of all normals, for the albedo of gold at 60 and 85 degrees and\n"
    "under a small light; bias: of that albedo, where it is beyond its noise.\n";

enum { CELL = 40 };

/* The two albedos in one cell. */
static void biases(char cell[CELL], const double bias[2])
{
    char part[2][16];
    for (int k = 0; k < 2; k++)
        snprintf(part[k], sizeof part[k], bias[k] == 0 ? "%.0f" : "%+.2g%%", 100 * bias[k]);
    cell[0] = '\0';
    if (!isnan(bias[0]))
        snprintf(cell, CELL, "%s, %s", part[0], part[1]);
}

static void put_bytes(text_table *t, const char *heading, size_t bytes)
{
    int large = bytes >= 10240;
    table_number(t, heading, large ? "%.0f KiB" : "%.0f", (double)bytes / (large ? 1024 : 1));
}

/* For people. */
static void shown_columns(text_table *t, const bench_row *r)
{
    char bias[CELL];
    biases(bias, r->bias);
    table_text(t, "distribution", r->kind == BENCH_MOVE ? "yardstick" : r->distribution);
    table_text(t, "method", r->method);
    table_word(t, "instructions", r->instructions);
    put_bytes(t, "memory", r->memory);
    if (r->file_bytes)
        put_bytes(t, "file", r->file_bytes);
    else
        table_number(t, "file", "", NAN);
    if (r->wrong)
        table_figure(t, "ns", "wrong");
    else
        table_time(t, "ns", r->ns);
    table_number(t, "spread", "%.1f%%", 50 * (r->ns_high - r->ns_low) / r->ns);
    table_time(t, "shared", r->shared_ns);
    table_time(t, "latency", r->latency_ns);
    table_number(t, "ratio", "%.3g", r->ratio);
    table_number(t, "TV above", r->tv < 1e-9 ? "%.0f" : "%.1e", r->tv);
    table_number(t, "below", "%.1e", r->tv_below);
    table_number(t, "weight", "%.4g", r->max_weight);
    table_number(t, "Sobol'", "%.2f", r->stratified);
    table_number(t, "eff 60", "%.3g", r->efficiency[0]);
    table_number(t, "eff 85", "%.3g", r->efficiency[1]);
    table_number(t, "eff light", "%.3g", r->efficiency_light);
    table_figure(t, "bias 60, 85", bias);
}

static const char *kind_name(bench_kind kind)
{
    static const char *const names[] = {"published", "closed", "table", "exported", "call", "move"};
    return names[kind];
}

/* Every number. */
static void all_columns(text_table *t, const bench_row *r)
{
    table_text(t, "method", r->method);
    table_text(t, "distribution", r->distribution);
    table_word(t, "instructions", r->instructions);
    table_word(t, "kind", kind_name(r->kind));
    table_number(t, "memory", "%.0f", (double)r->memory);
    table_number(t, "file_bytes", "%.0f", (double)r->file_bytes);
    table_value(t, "moments", r->moments);
    table_value(t, "wrong", r->wrong);
    table_value(t, "ns", r->ns);
    table_value(t, "ns_low", r->ns_low);
    table_value(t, "ns_high", r->ns_high);
    table_value(t, "shared_ns", r->shared_ns);
    table_value(t, "latency_ns", r->latency_ns);
    table_value(t, "ratio", r->ratio);
    table_value(t, "tv", r->tv);
    table_value(t, "tv_theta", r->tv_theta);
    table_value(t, "tv_below", r->tv_below);
    table_value(t, "max_weight", r->max_weight);
    table_value(t, "stratified", r->stratified);
    table_value(t, "efficiency_60", r->efficiency[0]);
    table_value(t, "efficiency_85", r->efficiency[1]);
    table_value(t, "efficiency_light", r->efficiency_light);
    table_value(t, "bias_60", r->bias[0]);
    table_value(t, "bias_85", r->bias[1]);
}

static int print(FILE *file, const bench_rows *rows, void (*columns)(text_table *, const bench_row *),
                 int (*form)(FILE *, const text_table *))
{
    text_table t = {.rows = 0};
    for (size_t i = 0; i < rows->count; i++) {
        table_row(&t);
        columns(&t, &rows->row[i]);
    }
    int good = form(file, &t);
    table_free(&t);
    return good;
}

int bench_print(FILE *file, const void *rows, figures_form form)
{
    if (form == FIGURES_CSV || form == FIGURES_JSON)
        return print(file, rows, all_columns, form == FIGURES_CSV ? table_print_csv : table_print_json);
    int good = print(file, rows, shown_columns, form == FIGURES_TEXT ? table_print_text : table_print_markdown);
    fprintf(file, "\n%s", legend);
    return good;
}
