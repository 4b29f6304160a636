/* Which table to ship, and how many moments: sentences, and the tables that were built.
 *
 * Any table is right with its weight; a small one costs noise and rare bright samples, and bias without the weight. So
 * the advice is the smallest table whose certificate keeps the limits below, which are those that `vndf build` aims at.
 * No table keeps a limit that the finest breaks; there a table is good if it is within a quarter of the finest. */
#include <math.h>
#include <stdio.h>

#include "cli/subject.h"
#include "draw/svg.h"
#include "evidence/page/report.h"

/* No sample is brighter than chance would make it, and what tables are aimed at. */
enum { WEIGHT, TV_ABOVE, TV_BELOW, LIMITS };

static const double weight_most = 2;

static const struct {
    const double *most;
    const char *heading, *format, *sentence; /* of its column, of a number in it, and of one in a sentence */
} limits[LIMITS] = {
    [WEIGHT] = {&weight_most, "weight", "%.3g", "weights up to %.3g"},
    [TV_ABOVE] = {&table_aim_above, "TV above", "%.1e", "a total variation of %.2g above the horizon"},
    [TV_BELOW] = {&table_aim_below, "TV below", "%.1e", "a total variation of %.2g below it"}};

static double number_of(const vndf_distribution *table, int limit)
{
    const vndf_certificate c = vndf_distribution_info(table).certificate;
    return (double)(limit == WEIGHT ? c.max_weight : limit == TV_ABOVE ? c.tv_above : c.tv);
}

static int keeps(const vndf_distribution *table, int limit)
{
    return number_of(table, limit) <= *limits[limit].most;
}

int report_keeps(const vndf_distribution *table)
{
    return keeps(table, WEIGHT) && keeps(table, TV_ABOVE) && keeps(table, TV_BELOW);
}

static int keeps_what_it_can(const vndf_distribution *table, const vndf_distribution *finest)
{
    int good = 1;
    for (int i = 0; i < LIMITS; i++)
        good &= keeps(finest, i) ? keeps(table, i) : number_of(table, i) <= 1.25 * number_of(finest, i);
    return good;
}

vndf_status report_choose(subject *s, size_t *chosen, const evidence_plan *plan, vndf_error *error)
{
    for (size_t i = 0; i < SIZES; i++)
        if (!subject_table(s, i, plan, error))
            return error->status;
    for (*chosen = 0; !keeps_what_it_can(s->table[*chosen], s->table[SIZE_FINE]);)
        ++*chosen;
    return VNDF_OK;
}

double report_number(const report *r, const vndf_distribution *table, evidence_column c)
{
    for (const evidence_row *of = r->found->row; of < r->found->row + r->found->count; of++)
        if (of->m.kind == ROW_TABLE && of->m.d == table)
            return of->number[c];
    return NAN;
}

void report_bytes(char text[REPORT_BYTES], double bytes)
{
    double power = exp2(round(log2(bytes)));
    double size = fabs(bytes / power - 1) < 0.03 ? power : bytes;
    int is_large = size >= 1048576;
    snprintf(text, REPORT_BYTES, "%.3g %s", size / (is_large ? 1048576 : 1024), is_large ? "MiB" : "KiB");
}

/* ---- sentences ----------------------------------------------------------------------------------- */

/* The limits that a table keeps (or breaks), with its numbers. */
static void write_limits(FILE *html, const vndf_distribution *table, int is_kept)
{
    const char *between = "";
    for (int i = 0; i < LIMITS; i++)
        if (keeps(table, i) == is_kept) {
            fputs(between, html);
            fprintf(html, limits[i].sentence, number_of(table, i));
            between = ", ";
        }
}

static void write_advice(FILE *html, const report *r, const subject *s, size_t chosen)
{
    const vndf_distribution *table = s->table[chosen];
    const table_size *size = &table_sizes[chosen];
    const double ns = report_number(r, table, COL_NS), batch = report_number(r, table, r->batch);
    const int is_good = report_keeps(table);
    char bytes[REPORT_BYTES];
    report_bytes(bytes, (double)vndf_distribution_info(table).bytes);
    fputs("<p><strong>", html);
    svg_escape(html, s->name);
    fprintf(html, ": ship %s with %d moments.</strong> %s", bytes, size->moments,
            is_good
                ? "It is the smallest that keeps all limits: "
                : "None of those built keeps all limits; this is the smallest that comes near the finest, with ");
    write_limits(html, table, is_good);
    fputs(". ", html);
    if (ns > 0)
        fprintf(html, "A sample takes %.0f ns, in a batch %.0f ns.", ns, batch);
    fputs("<code>vndf build ", html);
    svg_escape(html, vndf_source_description(s->source));
    fprintf(html, " --max-bytes %zu --moments %d -o table.vndf</code></p>\n", size->bytes, size->moments);
}

/* ---- the table ----------------------------------------------------------------------------------- */

static void add_rows(figures *t, const report *r, const subject *s, size_t chosen)
{
    for (size_t i = 0; i < SIZES; i++) {
        const vndf_distribution *table = s->table[i];
        const vndf_info info = vndf_distribution_info(table);
        figures_record(t);
        figures_text(t, "distribution", s->name);
        figures_mark(t, i == chosen ? "chosen" : NULL);
        figures_number(t, "file (bytes)", "%.0f", (double)info.bytes, "");
        figures_number(t, "moments", "%.0f", info.moments, "");
        figures_number(t, "in memory (bytes)", "%.0f", (double)info.memory, "");
        for (int k = 0; k < LIMITS; k++) {
            figures_number(t, limits[k].heading, limits[k].format, number_of(table, k), "");
            figures_mark(t, keeps(table, k) ? NULL : "no");
        }
        figures_number(t, "G1 error", "%.1e", (double)info.certificate.area_error, "");
        figures_number(t, "ns", "%.0f", report_number(r, table, COL_NS), "");
        figures_number(t, "batch ns", "%.1f", report_number(r, table, r->batch), "");
    }
}

int report_advice(html_page *page, const report *r)
{
    figures t = {.rows = 0};
    fputs("<div class=\"advice\">\n", page->html);
    for (size_t i = 0; i < r->count; i++) {
        write_advice(page->html, r, &r->subject[i], r->chosen[i]);
        add_rows(&t, r, &r->subject[i], r->chosen[i]);
    }
    fputs("</div>\n", page->html);
    FILE *data = page_table(page, &t) ? page_file(page, "tables.csv") : NULL;
    const int good = data && figures_print(data, &t, FIGURES_CSV);
    figures_free(&t);
    if (good)
        page_link(page, "all tables");
    return good;
}
