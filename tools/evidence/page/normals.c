/* Density and samples: D itself, and the visible normals from three directions, for each distribution. */
#include "cli/subject.h"
#include "draw/panels.h"
#include "draw/svg.h"
#include "evidence/page/report.h"

enum { VIEWS = 3, NDF_STEPS = 90 };

static const double thetas[VIEWS] = {0, 60, 100};

static int draw_subject(FILE *file, const report_subject *s)
{
    const panel_box left = {0, 0, 340, 282}, disc = {0, 0, 260, 282};
    const vndf_surface advised = {s->table[s->chosen].table, 1, 1}, finest = {s->table[SIZES - 1].table, 1, 1};
    int good = 1;
    fputs("<h3>", file);
    svg_escape(file, s->of.name);
    fputs("</h3>\n<figure class=\"panels\">\n", file);
    panel_ndf(file, left, &finest);
    for (unsigned v = 0; v < VIEWS && good; v++) {
        fprintf(file, "<svg class=\"chart\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\">\n",
                disc.width, disc.height, disc.width, disc.height);
        good = panel_disc(file, disc, &advised, thetas[v], v + 1);
        fputs("</svg>\n", file);
    }
    fputs("</figure>\n", file);
    return good;
}

static void add_ndf(text_table *t, const report_subject *s)
{
    const vndf_surface finest = {s->table[SIZES - 1].table, 1, 1};
    double widest = panel_widest(&finest);
    for (int i = 0; i <= NDF_STEPS; i++) {
        table_row(t);
        table_text(t, "distribution", s->of.name);
        table_value(t, "theta_m_deg", widest * i / NDF_STEPS);
        table_value(t, "ndf", (double)vndf_ndf(&finest, direction_from(widest * i / NDF_STEPS, 0)));
    }
}

int report_normals(html_page *page, const report *r)
{
    text_table ndf = {.rows = 0};
    page_section(
        page, "normals", "Density and samples",
        "D against the angle of the normal, and the normals visible from three directions, the last below the "
        "horizon: density as colour (darker is denser, square root, each disc by itself), 350 samples as dots, "
        "seen from above in an equal-area projection. A ring or an arrow marks the incident direction.");
    int good = 1;
    for (size_t i = 0; i < r->count; i++) {
        good = good && draw_subject(page->html, &r->subject[i]);
        add_ndf(&ndf, &r->subject[i]);
    }
    good &= page_data(page, "ndf.csv", "D against the angle of the normal", ndf);
    return good;
}
