/* Which table to ship, and how many moments: sentences, and the tables that were measured. */
#include <math.h>
#include <stdio.h>

#include "draw/svg.h"
#include "evidence/page/report.h"

static void write_broken(FILE *html, const report_verdict *v)
{
    static const char *const formats[REPORT_LIMITS] = {"weights up to %.3g", "%.2g%% of added variance",
                                                       "a total variation of %.2g above the horizon",
                                                       "a total variation of %.2g below it", "areas off by %.2g"};
    const char *between = "";
    for (int i = 0; i < REPORT_LIMITS; i++)
        if (!v->kept[i]) {
            fputs(between, html);
            fprintf(html, formats[i], v->value[i]);
            between = ", ";
        }
}

/* Where the next cheaper choices fall short: a smaller file with as many moments, fewer moments in the same
 * file. */
static void write_cheaper(FILE *html, const report_subject *s, size_t i, const char *what)
{
    report_verdict v = report_judge(&s->table[i]);
    if (v.all)
        return;
    fprintf(html, " %s would mean ", what);
    write_broken(html, &v);
    fputs("; with the weight it is unbiased all the same.", html);
}

static void write_advice(FILE *html, const report_subject *s)
{
    const report_table *t = &s->table[s->chosen];
    const table_size *size = &table_sizes[s->chosen];
    report_verdict v = report_judge(t);
    char bytes[TABLE_BYTES];
    table_bytes_text(bytes, (double)t->info.bytes);
    fputs("<p><strong>", html);
    svg_escape(html, s->of.name);
    fprintf(html, ": ship %s with %d moments.</strong> ", bytes, size->moments);
    if (v.all)
        fprintf(html,
                "It is the smallest that keeps all limits: weights up to %.3g, %.2g%% of added variance, "
                "a total variation of %.2g above the horizon and %.2g below it, G1 within %.1g. ",
                v.value[0], v.value[1], v.value[2], v.value[3], v.value[4]);
    else {
        fputs("None of those measured keeps all limits; this is the smallest that comes near the finest, with ",
              html);
        write_broken(html, &v);
        fputs(". ", html);
    }
    if (t->ns > 0)
        fprintf(html, "A sample takes %.0f ns, in a batch %.0f ns.", t->ns, t->batch);
    if (s->chosen >= 3 && v.all)
        write_cheaper(html, s, s->chosen - 3, "The next smaller file");
    if (size->moments > 2 && v.all)
        write_cheaper(html, s, s->chosen - 1, "One moment fewer");
    fputs("<code>vndf build ", html);
    svg_escape(html, vndf_source_description(s->of.source));
    fprintf(html, " --max-bytes %zu --moments %d -o table.vndf</code></p>\n", size->bytes, size->moments);
}

/* ---- the table ----------------------------------------------------------------------------------- */

static void put_limited(text_table *t, const char *heading, const char *format, double value, int kept)
{
    table_number(t, heading, format, value);
    table_mark(t, kept ? NULL : "no");
}

static void add_rows(text_table *t, const report *r, const report_subject *s)
{
    for (size_t i = 0; i < SIZES; i++) {
        const report_table *of = &s->table[i];
        report_verdict v = report_judge(of);
        table_row(t);
        if (r->count > 1)
            table_text(t, "distribution", s->of.name);
        table_number(t, "file (bytes)", "%.0f", (double)of->info.bytes);
        table_number(t, "moments", "%.0f", table_sizes[i].moments);
        table_number(t, "in memory (bytes)", "%.0f", (double)of->info.memory);
        put_limited(t, "TV above", "%.1e", v.value[2], v.kept[2]);
        put_limited(t, "TV below", "%.1e", v.value[3], v.kept[3]);
        put_limited(t, "weight", "%.3g", v.value[0], v.kept[0]);
        put_limited(t, "added variance (%)", "%.2g", v.value[1], v.kept[1]);
        put_limited(t, "G1 error", "%.1e", v.value[4], v.kept[4]);
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
