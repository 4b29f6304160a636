/* Density and samples: D itself, and the visible normals from three directions, for each distribution. */
#include "draw/panels.h"
#include "draw/svg.h"
#include "evidence/page/report.h"

int report_normals(html_page *page, const report *r)
{
    static const double thetas[] = {0, 60, 100};
    const panel_box left = {0, 0, 340, 282}, disc = {0, 0, 260, 282};
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
