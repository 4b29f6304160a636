/* Density and samples: D itself, and the visible normals from three directions, for each distribution. */
#include <math.h>

#include "draw/chart.h"
#include "cli/subject.h"
#include "draw/panels.h"
#include "draw/svg.h"
#include "cli/random.h"
#include "report/report.h"

enum { VIEWS = 3, NDF_STEPS = 90, DENSITY_STEPS = 18, TURN_STEP = 15 };

static const double thetas[VIEWS] = {0, 60, 100};

static vndf_surface surface_of(const report_subject *s)
{
    vndf_surface surface = {s->table[s->chosen].table, 1, 1};
    return surface;
}

static vndf_surface finest_of(const report_subject *s)
{
    vndf_surface surface = {s->table[s->count - 1].table, 1, 1};
    return surface;
}

/* The largest angle of the normal that panel_ndf draws; narrow lobes need fine steps. */
static double widest_angle(const report_subject *s)
{
    return round_angle(atan(8 * s->table[0].info.scale) * 180 / acos(-1.0));
}

static void begin_panel(FILE *file, double width, double height)
{
    fprintf(file,
            "<svg xmlns:xlink=\"http://www.w3.org/1999/xlink\" class=\"chart panel\" width=\"%.0f\" "
            "height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\">\n",
            width, height, width, height);
}

static int draw_subject(FILE *file, const report_subject *s)
{
    const panel_box left = {0, 0, 320, 320}, disc = {0, 0, 260, 282};
    vndf_surface surface = surface_of(s), finest = finest_of(s);
    int good = 1;
    fputs("<h3>", file);
    svg_escape(file, s->name);
    fputs("</h3>\n<figure class=\"panels\">\n", file);
    begin_panel(file, left.width, left.height);
    panel_ndf(file, left, &finest);
    fputs("</svg>\n", file);
    for (unsigned v = 0; v < VIEWS && good; v++) {
        begin_panel(file, disc.width, disc.height);
        good = panel_disc(file, disc, &surface, thetas[v], v + 1);
        fputs("</svg>\n", file);
    }
    fputs("</figure>\n", file);
    return good;
}

/* ---- data ---------------------------------------------------------------------------------------- */

static int write_ndf(html_page *page, const report *r)
{
    text_table data = {.rows = 0};
    for (size_t k = 0; k < r->count; k++) {
        vndf_surface surface = finest_of(&r->subject[k]);
        for (int i = 0; i <= NDF_STEPS; i++) {
            double theta = widest_angle(&r->subject[k]) * i / NDF_STEPS;
            table_row(&data);
            table_text(&data, "distribution", r->subject[k].name);
            table_value(&data, "theta_m_deg", theta);
            table_value(&data, "ndf", (double)vndf_ndf(&surface, direction_from(theta, 0)));
        }
    }
    return page_data(page, "ndf.csv", "D against the angle of the normal", data);
}

/* Adds the dots of panel_disc, from the same uniform numbers. */
static void add_samples(text_table *t, const report_subject *s, unsigned v)
{
    vndf_surface surface = surface_of(s);
    vndf_view view = vndf_view_from(&surface, direction_from(thetas[v], 0));
    random_stream stream = random_from(v + 1);
    for (int i = 0; i < PANEL_DOTS; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        table_row(t);
        table_text(t, "distribution", s->name);
        table_value(t, "theta_deg", thetas[v]);
        table_value(t, "wm.x", (double)wm.x);
        table_value(t, "wm.y", (double)wm.y);
        table_value(t, "wm.z", (double)wm.z);
        table_value(t, "pdf", (double)pdf);
    }
}

static void add_grid(text_table *t, const report_subject *s, unsigned v)
{
    vndf_surface surface = surface_of(s);
    vndf_view view = vndf_view_from(&surface, direction_from(thetas[v], 0));
    for (int i = 0; i <= DENSITY_STEPS; i++)
        for (int turn = 0; turn <= (i > 0 ? 180 : 0); turn += TURN_STEP) {
            double theta_m = widest_angle(s) * i / DENSITY_STEPS;
            table_row(t);
            table_text(t, "distribution", s->name);
            table_value(t, "theta_deg", thetas[v]);
            table_value(t, "theta_m_deg", theta_m);
            table_value(t, "phi_m_deg", turn);
            table_value(t, "pdf", (double)vndf_pdf(&view, direction_from(theta_m, turn)));
        }
}

static int write_views(html_page *page, const report *r)
{
    text_table samples = {.rows = 0}, density = {.rows = 0};
    for (size_t k = 0; k < r->count; k++)
        for (unsigned v = 0; v < VIEWS; v++) {
            add_samples(&samples, &r->subject[k], v);
            add_grid(&density, &r->subject[k], v);
        }
    int good = page_data(page, "samples.csv", "the samples that are drawn as dots", samples);
    return page_data(page, "density.csv", "density of visible normals on a grid", density) && good;
}

int report_write_normals(html_page *page, const report *r)
{
    page_section(
        page, "normals", "Density and samples",
        "D against the angle of the normal, and the normals visible from three directions, the last below the "
        "horizon: density as colour (darker is denser, square root, each disc by itself), 350 samples as dots, "
        "seen from above in an equal-area projection. A ring or an arrow marks the incident direction.");
    int good = 1;
    for (size_t i = 0; i < r->count && good; i++)
        good = draw_subject(page->html, &r->subject[i]);
    good = good && write_ndf(page, r) && write_views(page, r);
    page_section_end(page);
    return good;
}
