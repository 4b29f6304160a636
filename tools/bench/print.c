/* The rows of the benchmark as text for a terminal, as CSV with every number, and as a table in Markdown. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/parts.h"
#include "bench/cells.h"

enum { COLUMNS = 13 };

typedef struct cells {
    char of[COLUMNS][CELL];
} cells;

static const char *const headings[COLUMNS] = {"memory",  "file",      "ns",         "spread", "shared",
                                              "latency", "ratio",     "TV",         "weight", "eff 60",
                                              "eff 85",  "eff light", "bias 60, 85"};

static const char legend[] =
    "memory: bytes of its tables when loaded; file: of a table of ours on disk.\n"
    "ns: view, sample and density, a direction each (median of turns; spread: half of what lies between "
    "quartiles);\n"
    "shared: many samples for one direction; latency: each waits for the last; ratio: to spherical caps, scalar.\n"
    "TV: largest total variation to the true visible normals; weight: largest true over drawn density. eff:\n"
    "1/(variance time) over that of all normals, for the albedo of gold at 60 and 85 degrees and under a small\n"
    "light; bias: of that albedo, where it is beyond its noise.\n";

static void size(char cell[CELL], size_t bytes)
{
    int large = bytes >= 10240;
    cell_number(cell, large ? "%.0f KiB" : "%.0f", (double)bytes / (large ? 1024 : 1));
}

/* The two albedos in one cell. */
static void biases(char cell[CELL], const double bias[2])
{
    char part[2][CELL];
    for (int k = 0; k < 2; k++)
        cell_number(part[k], bias[k] == 0 ? "%.0f" : "%+.2g%%", 100 * bias[k]);
    snprintf(cell, CELL, isnan(bias[0]) ? "-" : "%.10s, %.10s", part[0], part[1]);
}

static void fill(cells *c, const bench_row *row)
{
    size(c->of[0], row->memory);
    if (row->file_bytes)
        size(c->of[1], row->file_bytes);
    else
        snprintf(c->of[1], CELL, "-");
    cell_time(c->of[2], row->ns);
    cell_number(c->of[3], "%.1f%%", 50 * (row->ns_high - row->ns_low) / row->ns);
    cell_time(c->of[4], row->shared_ns);
    cell_time(c->of[5], row->latency_ns);
    cell_number(c->of[6], "%.3g", row->ratio);
    cell_number(c->of[7], row->tv < 1e-9 ? "%.0f" : "%.1e", row->tv);
    cell_number(c->of[8], "%.4g", row->max_weight);
    cell_number(c->of[9], "%.3g", row->efficiency[0]);
    cell_number(c->of[10], "%.3g", row->efficiency[1]);
    cell_number(c->of[11], "%.3g", row->efficiency_light);
    biases(c->of[12], row->bias);
    if (row->wrong)
        snprintf(c->of[2], CELL, "wrong");
}

/* ---- text -------------------------------------------------------------------------------------- */

typedef struct widths {
    int method, set, of[COLUMNS];
} widths;

static widths widths_of(const bench_rows *rows)
{
    widths w = {6, 5, {0}};
    for (int k = 0; k < COLUMNS; k++)
        w.of[k] = cell_wider(0, headings[k]);
    for (size_t i = 0; i < rows->count; i++) {
        cells c;
        fill(&c, &rows->row[i]);
        w.method = cell_wider(w.method, rows->row[i].method);
        w.set = cell_wider(w.set, rows->row[i].instructions);
        for (int k = 0; k < COLUMNS; k++)
            w.of[k] = cell_wider(w.of[k], c.of[k]);
    }
    return w;
}

static void text_heading(FILE *file, const widths *w, const char *distribution)
{
    fprintf(file, "%s\n  %-*s %-*s", distribution, w->method, "method", w->set, "");
    for (int k = 0; k < COLUMNS; k++)
        fprintf(file, "  %*s", w->of[k], headings[k]);
    fputs("\n", file);
}

void bench_print_text(FILE *file, const bench_rows *rows)
{
    widths w = widths_of(rows);
    for (size_t i = 0; i < rows->count; i++) {
        const bench_row *row = &rows->row[i];
        cells c;
        fill(&c, row);
        if (i == 0 || strcmp(row->distribution, row[-1].distribution) != 0) {
            fputs(i ? "\n" : "", file);
            text_heading(file, &w, row->kind == BENCH_MOVE ? "yardstick" : row->distribution);
        }
        fprintf(file, "  %-*s %-*s", w.method, row->method, w.set, row->instructions);
        for (int k = 0; k < COLUMNS; k++)
            fprintf(file, "  %*s", w.of[k], c.of[k]);
        fputs("\n", file);
    }
    fprintf(file, "\n%s", legend);
}

/* ---- CSV --------------------------------------------------------------------------------------- */

static const char *kind_name(bench_kind kind)
{
    switch (kind) {
    case BENCH_PUBLISHED: return "published";
    case BENCH_CLOSED: return "closed";
    case BENCH_TABLE: return "table";
    case BENCH_CALL: return "call";
    default: return "move";
    }
}

void bench_print_csv(FILE *file, const bench_rows *rows)
{
    fputs(
        "method,distribution,instructions,kind,memory,file_bytes,wrong,ns,ns_low,ns_high,shared_ns,latency_ns,ratio,tv,"
        "tv_theta,max_weight,efficiency_60,efficiency_85,efficiency_light,bias_60,bias_85\n",
        file);
    for (size_t i = 0; i < rows->count; i++) {
        const bench_row *r = &rows->row[i];
        const double numbers[] = {
            r->ns,      r->ns_low,   r->ns_high,    r->shared_ns,     r->latency_ns,    r->ratio,
            r->tv,      r->tv_theta, r->max_weight, r->efficiency[0], r->efficiency[1], r->efficiency_light,
            r->bias[0], r->bias[1]};
        csv_text(file, r->method);
        fputc(',', file);
        csv_text(file, r->distribution);
        fprintf(file, ",%s,%s,%zu,%zu,%d", r->instructions, kind_name(r->kind), r->memory, r->file_bytes,
                r->wrong);
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
            csv_number(file, numbers[k]);
        fputs("\n", file);
    }
}

/* ---- Markdown ---------------------------------------------------------------------------------- */

void bench_print_markdown(FILE *file, const bench_rows *rows)
{
    fputs("| distribution | method | instructions |", file);
    for (int k = 0; k < COLUMNS; k++)
        fprintf(file, " %s |", headings[k]);
    fputs("\n|---|---|---|", file);
    for (int k = 0; k < COLUMNS; k++)
        fputs("--:|", file);
    fputs("\n", file);
    for (size_t i = 0; i < rows->count; i++) {
        cells c;
        fill(&c, &rows->row[i]);
        fputs("| ", file);
        markdown_text(file, rows->row[i].distribution);
        fputs(" | ", file);
        markdown_text(file, rows->row[i].method);
        fprintf(file, " | %s |", rows->row[i].instructions);
        for (int k = 0; k < COLUMNS; k++)
            fprintf(file, " %s |", c.of[k]);
        fputs("\n", file);
    }
    fprintf(file, "\n%s", legend);
}
