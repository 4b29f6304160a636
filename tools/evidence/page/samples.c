/* What a caller pays, each method one by one and in a batch, with the file that `vndf bench` would write; and density
 * and samples: D itself, and the visible normals from three directions, for each distribution. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/panels.h"
#include "draw/svg.h"
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

int report_normals(html_page *page, const report *r)
{
    static const double thetas[] = {0, 60, 100};
    const panel_box left = {0, 0, 340, 282}, disc = {0, 0, 250, 282};
    FILE *file = page->html;
    page_section(
        page, "normals", "Density and samples",
        "D against the angle of the normal, and the normals visible from three directions, the last below the "
        "horizon: density as colour (darker is denser, square root, each disc by itself), 350 samples as dots, "
        "seen from above in an equal-area projection. A ring or an arrow marks the incident direction.");
    for (const report_subject *s = r->subject; s < r->subject + r->count; s++) {
        const vndf_surface advised = {s->of.table[s->chosen], 1, 1}, finest = {s->of.table[SIZES - 1], 1, 1};
        fputs("<h3>", file);
        svg_escape(file, s->of.name);
        fputs("</h3>\n<figure class=\"panels\">\n", file);
        panel_ndf(file, left, &finest);
        for (unsigned v = 0; v < 3; v++) {
            fprintf(file, "<svg class=\"chart\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\">\n",
                    disc.width, disc.height, disc.width, disc.height);
            if (!panel_disc(file, disc, &advised, thetas[v], v + 1))
                return complain(page->command, "no memory"), 0;
            fputs("</svg>\n", file);
        }
        fputs("</figure>\n", file);
    }
    return 1;
}
