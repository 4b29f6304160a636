/* What a caller pays: each method one by one and in a batch, with the file that `vndf bench` would write. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "evidence/page/report.h"

/* The row of the same method in a batch, by the best instructions of this machine; NULL if there is none. */
static const evidence_row *batch_of(const report *r, const evidence_row *one)
{
    char name[80];
    snprintf(name, sizeof name, "%s, batch", one->method);
    for (const evidence_row *of = r->rows.row; of < r->rows.row + r->rows.count; of++)
        if (strcmp(of->method, name) == 0 && strcmp(of->distribution, one->distribution) == 0 &&
            strcmp(of->instructions, r->batch) == 0)
            return of;
    return NULL;
}

void report_note_times(report *r)
{
    report_subject *s = &r->subject[0];
    for (const evidence_row *of = r->rows.row; of < r->rows.row + r->rows.count; of++)
        for (size_t i = 0; i < SIZES; i++)
            if (strcmp(of->method, table_sizes[i].name) == 0 && strcmp(of->distribution, s->of.name) == 0 &&
                strcmp(of->instructions, "scalar") == 0) {
                const evidence_row *batch = batch_of(r, of);
                s->ns[i] = of->number[COL_NS];
                s->batch[i] = batch ? batch->number[COL_NS] : (double)NAN;
            }
}

int report_times(html_page *page, const report *r)
{
    text_table t = {.rows = 0};
    page_section(
        page, "time", "What a sample costs",
        "Nanoseconds that a caller pays for view, sample and density: medians over turns in which all "
        "methods run one after the other, one thread, data in cache. Time hardly depends on D. Efficiency: "
        "1/(variance x time) over that of all normals, for the albedo of gold at 60 and 85 degrees.");
    for (const evidence_row *of = r->rows.row; of < r->rows.row + r->rows.count; of++) {
        const evidence_row *batch = batch_of(r, of);
        if (strcmp(of->instructions, "scalar") != 0)
            continue;
        table_row(&t);
        table_text(&t, "distribution", of->distribution);
        table_text(&t, "method", of->method);
        table_time(&t, "one by one", of->number[COL_NS]);
        table_time(&t, "of one direction", of->number[COL_SHARED]);
        table_time(&t, "in a batch", batch ? batch->number[COL_NS] : (double)NAN);
        table_number(&t, "efficiency, 60", "%.3g", of->number[COL_EFF_60]);
        table_number(&t, "85", "%.3g", of->number[COL_EFF_85]);
    }
    int good = table_print_html(page->html, &t);
    table_free(&t);
    FILE *data = good ? page_file(page, "methods.csv") : NULL;
    if (!data || !evidence_print(data, &r->rows, FIGURES_CSV))
        return 0;
    page_link(page, "all methods, as vndf bench -o FILE.csv has them");
    return 1;
}
