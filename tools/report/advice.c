/* Which table to ship.
 *
 * Any table is right with its weight; a small one costs noise and rare bright samples, and bias without the weight. So
 * the advice is the smallest table that keeps five limits:
 *     the largest weight of the samples tried is at most 2: no sample is brighter than chance would make it
 *         (the certificate's weight is larger: it looks where 1e-10 of the area is left);
 *     the weights add at most 1% to the variance: nobody can see that;
 *     total variation is at most 1e-3 from above the horizon: without the weight the error stays below half a step
 *         of 8 bits; and 3e-2 from below it, where light has met the surface before;
 *     areas above the horizon, hence Lambda and G1, are within 1e-4: below 8 bits as well, and the weight does not
 *         mend them.
 * No table keeps a limit that the largest breaks; there a table is good if it is within a quarter of the largest. */
#include <string.h>

#include "draw/chart.h"
#include "draw/svg.h"
#include "report/report.h"

static const double most_weight = 2, most_variance = 0.01, most_above = 1e-3, most_below = 3e-2, most_area = 1e-4;

enum { LIMITS = 5 };

typedef struct verdict {
    double value[LIMITS];
    int kept[LIMITS];
} verdict;

static verdict judge(const report_table *t)
{
    verdict v = {{t->worst.max_weight, t->worst.variance, t->tv_above, t->tv_below, t->area}, {0}};
    const double limit[LIMITS] = {most_weight, most_variance, most_above, most_below, most_area};
    for (int i = 0; i < LIMITS; i++)
        v.kept[i] = v.value[i] <= limit[i];
    return v;
}

static int keeps_all(const report_table *t)
{
    verdict v = judge(t);
    return v.kept[0] && v.kept[1] && v.kept[2] && v.kept[3] && v.kept[4];
}

static int keeps_what_it_can(const report_table *t, const report_table *largest)
{
    verdict v = judge(t), best = judge(largest);
    int good = 1;
    for (int i = 0; i < LIMITS; i++)
        good = good && (best.kept[i] ? v.kept[i] : v.value[i] <= 1.25 * best.value[i]);
    return good;
}

void report_choose(report_subject *subject)
{
    const report_table *largest = &subject->table[subject->count - 1];
    subject->chosen = subject->count - 1;
    for (size_t i = subject->count; i-- > 0;)
        if (keeps_what_it_can(&subject->table[i], largest))
            subject->chosen = i;
}

/* ---- sentences ----------------------------------------------------------------------------------- */

static void write_broken(FILE *html, const verdict *v)
{
    static const char *const formats[LIMITS] = {"weights up to %.3g", "%.2g of added variance",
                                                "a total variation of %.2g above the horizon",
                                                "a total variation of %.2g below it", "areas off by %.2g"};
    const char *between = "";
    for (int i = 0; i < LIMITS; i++)
        if (!v->kept[i]) {
            fputs(between, html);
            fprintf(html, formats[i], v->value[i]);
            between = ", ";
        }
}

static void write_choice(FILE *html, const report_subject *s)
{
    const report_table *t = &s->table[s->chosen];
    char size[16];
    table_bytes_text(size, (double)t->info.bytes);
    fputs("<p><strong>", html);
    svg_escape(html, s->name);
    fprintf(html, ": ship the table of %s.</strong> ", size);
    verdict v = judge(t);
    if (keeps_all(t))
        fprintf(html,
                "It is the smallest that keeps all limits: weights up to %.3g, %.2g%% of added variance, "
                "a total variation of %.2g above the horizon and %.2g below it, G1 within %.1g. ",
                v.value[0], 100 * v.value[1], v.value[2], v.value[3], v.value[4]);
    else {
        fputs("None of those measured keeps all limits; this is the smallest that comes near the largest, "
              "with ",
              html);
        write_broken(html, &v);
        fputs(". ", html);
    }
    fprintf(html, "A sample takes %.0f ns, in a batch %.0f ns.", t->time.view + t->time.sample, t->time.batch);
}

/* Says which limits the next smaller table breaks, and gives the command. */
static void write_advice(FILE *html, const report_subject *s)
{
    write_choice(html, s);
    if (s->chosen > 0 && keeps_all(&s->table[s->chosen])) {
        char size[16];
        verdict v = judge(&s->table[s->chosen - 1]);
        table_bytes_text(size, (double)s->table[s->chosen - 1].info.bytes);
        fprintf(html, " The next smaller one, %s, has ", size);
        write_broken(html, &v);
        fputs("; with the weight it is unbiased all the same.", html);
    }
    if (s->left_out)
        fputs(" Larger sizes were left out to keep to the time that this page may take (--seconds).", html);
    fputs("<br><code>vndf build ", html);
    svg_escape(html, s->arguments);
    fprintf(html, " --max-bytes %zu -o table.vndf</code></p>\n", s->table[s->chosen].asked);
}

/* ---- the table ----------------------------------------------------------------------------------- */

/* A figure; a mark in a colour ends it where it breaks a limit. */
static void put_limited(text_table *t, const char *heading, const char *format, double value, int kept)
{
    char figure[32], marked[40];
    snprintf(figure, sizeof figure, format, value);
    snprintf(marked, sizeof marked, "%s%s", figure, kept ? "" : " ✗");
    table_figure(t, heading, marked);
    table_mark(t, kept ? NULL : "no");
}

static void shown_columns(text_table *t, const report_table *of, int chosen)
{
    char size[TABLE_BYTES], name[TABLE_BYTES + 8];
    verdict v = judge(of);
    table_bytes_text(size, (double)of->info.bytes);
    snprintf(name, sizeof name, "%s%s", size, chosen ? " ✓" : "");
    table_word(t, "size", name);
    table_mark(t, chosen ? "chosen" : NULL);
    table_number(t, "bytes of the file", "%.0f", (double)of->info.bytes);
    table_number(t, "in memory", "%.0f", (double)of->info.memory);
    put_limited(t, "total variation above", "%.2e", v.value[2], v.kept[2]);
    put_limited(t, "below", "%.2e", v.value[3], v.kept[3]);
    put_limited(t, "largest weight", "%.3g", v.value[0], v.kept[0]);
    put_limited(t, "added variance", "%.2g%%", 100 * v.value[1], v.kept[1]);
    put_limited(t, "area, G1 error", "%.1e", v.value[4], v.kept[4]);
    table_number(t, "ns, one by one", "%.0f", of->time.view + of->time.sample);
    table_number(t, "ns, batch", "%.1f", of->time.batch);
    table_number(t, "ns, batch, one direction", "%.1f", of->time.batch_shared);
}

static int write_table(html_page *page, const report_subject *s)
{
    text_table t = {.rows = 0};
    fputs("<h3>", page->html);
    svg_escape(page->html, s->name);
    fputs("</h3>\n", page->html);
    for (size_t i = 0; i < s->count; i++) {
        table_row(&t);
        shown_columns(&t, &s->table[i], i == s->chosen);
    }
    return page_table(page, t);
}

static void all_columns(text_table *t, const report_subject *s, size_t i)
{
    const report_table *of = &s->table[i];
    const vndf_certificate *c = &of->info.certificate;
    table_text(t, "distribution", s->name);
    table_number(t, "bytes", "%.0f", (double)of->info.bytes);
    table_number(t, "memory", "%.0f", (double)of->info.memory);
    table_value(t, "tv", (double)c->tv);
    table_value(t, "tv_theta_deg", (double)c->tv_theta);
    table_value(t, "max_weight", (double)c->max_weight);
    table_value(t, "weight_bounded", (double)c->weight_bounded);
    table_value(t, "added_variance", of->worst.variance);
    table_value(t, "area_error", (double)c->area_error);
    table_value(t, "consistency", (double)c->consistency);
    table_value(t, "ndf_error", (double)c->ndf_error);
    table_value(t, "tv_here", of->worst.tv);
    table_value(t, "tv_above", of->tv_above);
    table_value(t, "ns", of->time.view + of->time.sample);
    table_value(t, "batch_ns", of->time.batch);
    table_value(t, "batch_shared_ns", of->time.batch_shared);
    table_value(t, "chosen", i == s->chosen);
}

static int write_data(html_page *page, const report *r)
{
    text_table data = {.rows = 0};
    for (size_t k = 0; k < r->count; k++)
        for (size_t i = 0; i < r->subject[k].count; i++) {
            table_row(&data);
            all_columns(&data, &r->subject[k], i);
        }
    return page_data(page, "tables.csv", "certificates and times of all tables", data);
}

int report_write_advice(html_page *page, const report *r)
{
    page_section(
        page, "advice", "Which table to ship",
        "Every table is exact with its weight; a small one costs noise. The advice is the smallest table with "
        "weights up to 2, at most 1% more variance, a total variation up to 0.001 above the horizon (so that the "
        "weight may be left out where a bias below half a step of 8 bits does not matter) and 0.03 below it, and G1 "
        "within 0.0001.");
    fputs("<div class=\"advice\">\n", page->html);
    for (size_t i = 0; i < r->count; i++)
        write_advice(page->html, &r->subject[i]);
    fputs("</div>\n", page->html);
    int good = 1;
    for (size_t i = 0; i < r->count && good; i++)
        good = write_table(page, &r->subject[i]);
    good = good && write_data(page, r);
    page_section_end(page);
    return good;
}
