/* Error against the angle of incidence: total variation for a few sizes, a chart for each distribution. */
#include <math.h>

#include "draw/chart.h"
#include "report/report.h"

enum { SHOWN_MAX = 4 };

/* The smallest, the chosen one, the largest, and the one between the last two, as far as they differ. */
static size_t shown_tables(const report_subject *s, size_t shown[SHOWN_MAX])
{
    const size_t wanted[SHOWN_MAX] = {0, s->chosen, (s->chosen + s->count) / 2, s->count - 1};
    size_t count = 0;
    for (int i = 0; i < SHOWN_MAX; i++)
        if (count == 0 || wanted[i] > shown[count - 1])
            shown[count++] = wanted[i];
    return count;
}

typedef struct theta_curves {
    double x[REPORT_ANGLES], y[SHOWN_MAX][REPORT_ANGLES];
    char label[SHOWN_MAX][16];
    size_t count;
} theta_curves;

static void fill_curves(const report_subject *s, theta_curves *curves)
{
    size_t shown[SHOWN_MAX];
    curves->count = shown_tables(s, shown);
    for (size_t k = 0; k < curves->count; k++) {
        const report_table *t = &s->table[shown[k]];
        table_bytes_text(curves->label[k], (double)t->info.bytes);
        for (size_t a = 0; a < REPORT_ANGLES; a++) {
            curves->x[a] = report_theta(a);
            curves->y[k][a] = t->error[a].tv;
        }
    }
}

static void draw_subject(FILE *file, const report_subject *s)
{
    static const unsigned colours[SHOWN_MAX] = {1, 0, 2, 6};
    static const chart_line lines[SHOWN_MAX] = {CHART_SOLID, CHART_SOLID, CHART_DASHED, CHART_DOTTED};
    theta_curves curves;
    chart_series series[SHOWN_MAX + 1];
    fill_curves(s, &curves);
    chart c = {.title = s->name,
               .width = CHART_WIDTH,
               .height = CHART_HEIGHT,
               .right = 84,
               .x = {CHART_LINEAR, 0, 180, 30, "angle of incidence (degrees; beyond 90: below the horizon)"},
               .y = {CHART_LOG, 0, 0, 0, "total variation"},
               .series = series,
               .count = curves.count};
    for (size_t k = 0; k < curves.count; k++)
        series[k] = (chart_series){curves.label[k], curves.x,      curves.y[k], REPORT_ANGLES,
                                   colours[k],      CHART_NO_MARK, lines[k],    NULL};
    chart_fit_series(&c, 1e-8);
    const double horizon_x[2] = {90, 90}, horizon_y[2] = {c.y.low, c.y.high};
    series[c.count++] = (chart_series){NULL, horizon_x, horizon_y, 2, 7, CHART_NO_MARK, CHART_DASHED, NULL};
    fputs("<figure>\n", file);
    chart_draw(file, &c);
    fputs("</figure>\n", file);
}

static void add_row(text_table *t, const report_subject *s, const report_table *of, size_t angle)
{
    const report_error *e = &of->error[angle];
    table_row(t);
    table_text(t, "distribution", s->name);
    table_number(t, "bytes", "%.0f", (double)of->info.bytes);
    table_value(t, "theta_deg", report_theta(angle));
    table_value(t, "tv", e->tv);
    table_value(t, "weight_variance", e->variance);
    table_value(t, "max_weight", e->max_weight);
}

static int write_data(html_page *page, const report *r)
{
    text_table data = {.rows = 0};
    for (size_t k = 0; k < r->count; k++)
        for (size_t i = 0; i < r->subject[k].count; i++)
            for (size_t a = 0; a < REPORT_ANGLES; a++)
                if (!isnan(r->subject[k].table[i].error[a].tv))
                    add_row(&data, &r->subject[k], &r->subject[k].table[i], a);
    return page_data(page, "theta.csv", "error of every table at every angle", data);
}

int report_write_theta(html_page *page, const report *r)
{
    page_section(
        page, "theta", "Error against the angle of incidence",
        "Total variation between drawn and true visible normals, from straight above to straight below. A curve "
        "ends where less than 1e-10 of what is visible at grazing incidence is left.");
    fputs("<div class=\"pair\">\n", page->html);
    for (size_t i = 0; i < r->count; i++)
        draw_subject(page->html, &r->subject[i]);
    fputs("</div>\n", page->html);
    int good = write_data(page, r);
    page_section_end(page);
    return good;
}
