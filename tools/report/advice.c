/* Which table to ship.
 *
 * Any table is right with its weight; what it costs is noise, rare bright samples, and, for those who leave the
 * weight out, bias. So the advice is the smallest table that keeps four limits, over all directions from 0 to 180
 * degrees:
 *     the largest weight of the samples tried is at most 2: none is brighter by more than it would be by chance
 *         (the certificate's is larger: it looks where 1e-10 of the area is left);
 *     the weights add at most 1% to the variance: nobody can see that;
 *     total variation is at most 1e-3: without the weight, what is off stays below half a step of 8 bits;
 *     areas, hence Lambda and G1, are within 1e-4: below 8 bits as well, and the weight does not mend them.
 * What the largest breaks none can keep; there a table counts as good if it is within a quarter of the largest. */
#include <string.h>

#include "draw/chart.h"
#include "report/report.h"

static const double most_weight = 2, most_variance = 0.01, most_tv = 1e-3, most_area = 1e-4;

enum { LIMITS = 4 };

typedef struct verdict {
    double value[LIMITS];
    int kept[LIMITS];
} verdict;

static verdict judge(const report_table *t)
{
    const vndf_certificate *c = &t->info.certificate;
    verdict v = {{t->worst.max_weight, t->worst.variance, t->tv, (double)c->area_error}, {0, 0, 0, 0}};
    const double limit[LIMITS] = {most_weight, most_variance, most_tv, most_area};
    for (int i = 0; i < LIMITS; i++)
        v.kept[i] = v.value[i] <= limit[i];
    return v;
}

static int keeps_all(const report_table *t)
{
    verdict v = judge(t);
    return v.kept[0] && v.kept[1] && v.kept[2] && v.kept[3];
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
                                                "a total variation of %.2g", "areas off by %.2g"};
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
    report_bytes_text(size, (double)t->info.bytes);
    fputs("<p><strong>", html);
    chart_escape(html, s->name);
    fprintf(html, ": ship the table of %s.</strong> ", size);
    verdict v = judge(t);
    if (keeps_all(t))
        fprintf(html,
                "It is the smallest that keeps all four limits: weights up to %.3g, %.2g%% of added variance, "
                "a total variation of %.2g, G1 within %.1g. ",
                v.value[0], 100 * v.value[1], v.value[2], v.value[3]);
    else {
        fputs("None of those measured keeps all four limits; this is the smallest that comes near the largest, "
              "with ",
              html);
        write_broken(html, &v);
        fputs(". ", html);
    }
    fprintf(html, "A sample takes %.0f ns, in a batch %.0f ns.", t->time.view + t->time.sample, t->time.batch);
}

/* Those who never look from below the horizon need less where the error is worst there. */
static void write_reflection(FILE *html, const report_subject *s)
{
    char size[16];
    for (size_t i = 0; i < s->chosen; i++) {
        const report_table *t = &s->table[i];
        verdict v = judge(t);
        if (!v.kept[0] || !v.kept[1] || !v.kept[3] || t->tv_above > most_tv)
            continue;
        report_bytes_text(size, (double)t->info.bytes);
        fprintf(html, " For reflection alone %s will do: from above the horizon its total variation is %.2g.",
                size, t->tv_above);
        return;
    }
}

/* What the next smaller one lacks, and the command. */
static void write_advice(FILE *html, const report_subject *s)
{
    write_choice(html, s);
    if (s->chosen > 0 && keeps_all(&s->table[s->chosen])) {
        char size[16];
        verdict v = judge(&s->table[s->chosen - 1]);
        report_bytes_text(size, (double)s->table[s->chosen - 1].info.bytes);
        fprintf(html, " The next smaller one, %s, has ", size);
        write_broken(html, &v);
        fputs("; with the weight it is unbiased all the same.", html);
    }
    write_reflection(html, s);
    if (s->left_out)
        fputs(" Larger sizes were left out to keep to the time that this page may take (--seconds).", html);
    fputs("<br><code>vndf build ", html);
    chart_escape(html, s->arguments);
    fprintf(html, " --max-bytes %zu -o table.vndf</code></p>\n", s->table[s->chosen].asked);
}

/* ---- the table ----------------------------------------------------------------------------------- */

static void write_cell(FILE *html, const char *format, double value, int kept)
{
    fprintf(html, "<td%s>", kept ? "" : " class=\"no\"");
    fprintf(html, format, value);
    fputs(kept ? "</td>" : " ✗</td>", html);
}

static void write_row(FILE *html, const report_table *t, int chosen)
{
    char size[16];
    verdict v = judge(t);
    report_bytes_text(size, (double)t->info.bytes);
    fprintf(html, "<tr%s><td>%s%s</td>", chosen ? " class=\"chosen\"" : "", size, chosen ? " ✓" : "");
    fprintf(html, "<td>%zu</td><td>%zu</td>", t->info.bytes, t->info.memory);
    write_cell(html, "%.2e", v.value[2], v.kept[2]);
    fprintf(html, "<td>%.2e</td>", t->tv_above);
    write_cell(html, "%.3g", v.value[0], v.kept[0]);
    write_cell(html, "%.2g%%", 100 * v.value[1], v.kept[1]);
    write_cell(html, "%.1e", v.value[3], v.kept[3]);
    fprintf(html, "<td>%.0f</td><td>%.1f</td><td>%.1f</td></tr>\n", t->time.view + t->time.sample, t->time.batch,
            t->time.batch_shared);
}

static void write_table(FILE *html, const report_subject *s)
{
    fputs("<h3>", html);
    chart_escape(html, s->name);
    fputs(
        "</h3>\n<div class=\"scroll\"><table><thead><tr><th>size</th><th>bytes of the file</th><th>in memory</th>"
        "<th>total variation</th><th>above the horizon</th><th>largest weight</th>"
        "<th>added variance</th><th>area, G1 error</th><th>ns, one by one</th><th>ns, batch</th>"
        "<th>ns, batch, one direction</th></tr></thead>\n<tbody>\n",
        html);
    for (size_t i = 0; i < s->count; i++)
        write_row(html, &s->table[i], i == s->chosen);
    fputs("</tbody></table></div>\n", html);
}

static int write_data(html_page *page, const report *r)
{
    FILE *data = page_file_begin(page, "tables.csv");
    if (!data)
        return 0;
    fputs(
        "distribution,bytes,memory,tv,tv_theta_deg,max_weight,weight_bounded,added_variance,area_error,consistency,"
        "ndf_error,tv_here,tv_above,ns,batch_ns,batch_shared_ns,chosen\n",
        data);
    for (size_t k = 0; k < r->count; k++)
        for (size_t i = 0; i < r->subject[k].count; i++) {
            const report_table *t = &r->subject[k].table[i];
            const vndf_certificate *c = &t->info.certificate;
            page_field(data, r->subject[k].name);
            fprintf(data, ",%zu,%zu,%.5g,%.4g,%.5g,%.0f,%.5g,%.4g,%.4g,%.4g,%.5g,%.5g,%.4g,%.4g,%.4g,%d\n",
                    t->info.bytes, t->info.memory, (double)c->tv, (double)c->tv_theta, (double)c->max_weight,
                    (double)c->weight_bounded, t->worst.variance, (double)c->area_error, (double)c->consistency,
                    (double)c->ndf_error, t->worst.tv, t->tv_above, t->time.view + t->time.sample, t->time.batch,
                    t->time.batch_shared, i == r->subject[k].chosen);
        }
    return page_data_end(page, "certificates and times of all tables");
}

int report_write_advice(html_page *page, const report *r)
{
    page_section(
        page, "advice", "Which table to ship",
        "Every table is exact with its weight; a small one costs noise. The advice is the smallest table with "
        "weights up to 2, at most 1% more variance, a total variation up to 0.001 (so that the weight may "
        "be left out where a bias below half a step of 8 bits does not matter) and G1 within 0.0001, for every "
        "direction from 0 to 180 degrees.");
    fputs("<div class=\"advice\">\n", page->html);
    for (size_t i = 0; i < r->count; i++)
        write_advice(page->html, &r->subject[i]);
    fputs("</div>\n", page->html);
    for (size_t i = 0; i < r->count; i++)
        write_table(page->html, &r->subject[i]);
    int good = write_data(page, r);
    page_section_end(page);
    return good;
}
