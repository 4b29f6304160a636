/* Which table to ship, and how many moments: sentences, and the tables that were measured. */
#include <math.h>
#include <stdio.h>

#include "draw/svg.h"
#include "evidence/page/report.h"

/* The limits that a table keeps (or breaks), with its numbers. */
static void write_limits(FILE *html, const report_table *t, int is_kept)
{
    const char *between = "";
    for (report_limit i = 0; i < REPORT_LIMITS; i++)
        if (report_keeps(t, i) == is_kept) {
            fputs(between, html);
            fprintf(html, report_limits[i].sentence, t->worst[i]);
            between = ", ";
        }
}

/* Where the next cheaper choices fall short: a smaller file with as many moments, fewer moments in the same
 * file. */
static void write_cheaper(FILE *html, const report_table *t, const char *what)
{
    if (report_keeps_all(t))
        return;
    fprintf(html, " %s would mean ", what);
    write_limits(html, t, 0);
    fputs("; with the weight it is unbiased all the same.", html);
}

static void write_advice(FILE *html, const report_subject *s)
{
    const report_table *t = &s->table[s->chosen];
    const table_size *size = &table_sizes[s->chosen];
    int is_good = report_keeps_all(t);
    char bytes[TABLE_BYTES];
    table_bytes_text(bytes, (double)t->info.bytes);
    fputs("<p><strong>", html);
    svg_escape(html, s->of.name);
    fprintf(
        html, ": ship %s with %d moments.</strong> %s", bytes, size->moments,
        is_good
            ? "It is the smallest that keeps all limits: "
            : "None of those measured keeps all limits; this is the smallest that comes near the finest, with ");
    write_limits(html, t, is_good);
    fputs(". ", html);
    if (t->ns > 0)
        fprintf(html, "A sample takes %.0f ns, in a batch %.0f ns.", t->ns, t->batch);
    if (s->chosen >= 3 && is_good)
        write_cheaper(html, t - 3, "The next smaller file");
    if (size->moments > 2 && is_good)
        write_cheaper(html, t - 1, "One moment fewer");
    fputs("<code>vndf build ", html);
    svg_escape(html, vndf_source_description(s->of.source));
    fprintf(html, " --max-bytes %zu --moments %d -o table.vndf</code></p>\n", size->bytes, size->moments);
}

/* ---- the table ----------------------------------------------------------------------------------- */

static void add_rows(text_table *t, const report *r, const report_subject *s)
{
    for (size_t i = 0; i < SIZES; i++) {
        const report_table *of = &s->table[i];
        table_row(t);
        if (r->count > 1)
            table_text(t, "distribution", s->of.name);
        table_number(t, "file (bytes)", "%.0f", (double)of->info.bytes);
        table_number(t, "moments", "%.0f", table_sizes[i].moments);
        table_number(t, "in memory (bytes)", "%.0f", (double)of->info.memory);
        for (report_limit k = 0; k < REPORT_LIMITS; k++) {
            table_number(t, report_limits[k].heading, report_limits[k].format, of->worst[k]);
            table_mark(t, report_keeps(of, k) ? NULL : "no");
        }
        table_number(t, "ns", "%.0f", of->ns);
        table_number(t, "batch ns", "%.1f", of->batch);
        table_row_mark(t, i == s->chosen ? "chosen" : NULL);
    }
}

int report_advice(html_page *page, const report *r)
{
    text_table t = {.rows = 0};
    page_section(
        page, "advice", "Which table, and how many moments",
        "Every table is exact with its weight; a coarse one costs noise. The advice is the smallest with weights up to "
        "2, at most 1% more variance, a total variation (TV) up to 0.001 above the horizon (so that the weight may be "
        "left out where a bias below half a step of 8 bits does not matter) and 0.03 below it, and G1 within 0.0001.");
    fputs("<div class=\"advice\">\n", page->html);
    for (size_t i = 0; i < r->count; i++) {
        write_advice(page->html, &r->subject[i]);
        add_rows(&t, r, &r->subject[i]);
    }
    fputs("</div>\n", page->html);
    int good = table_print_html(page->html, &t) && page_data(page, "tables.csv", "all tables", t);
    return good;
}
