/* Pictures of a comparison, files beside the page: after equal time, with equal samples, crops, error maps, and
 * the changes by tables. */
#include "compare/comparison.h"

#include <math.h>
#include <string.h>

#include "draw/chart.h"
#include "draw/svg.h"

/* Errors from black to white: of an image, and of its changes by tables. */
typedef struct map_range {
    double low, high;
} map_range;

static const map_range of_noise = {0.01, 1}, of_tables = {1e-5, 0.1};

enum { SHOWN_WIDTH = 640 };

/* ---- pictures ---- */

static int add_film(html_page *page, const comparison *r, const char *name, const film *f)
{
    FILE *file = page_file_begin(page, name);
    int good = file && picture_of_film(file, f, r->exposure);
    return page_file_end(page) && good;
}

static int add_map(html_page *page, const char *name, const film *f, const film *beside, const map_range *range)
{
    FILE *file = page_file_begin(page, name);
    int good = file && picture_of_error(file, f, beside, range->low, range->high);
    return page_file_end(page) && good;
}

static int add_crops(html_page *page, const comparison *r)
{
    FILE *file = page_file_begin(page, "crops.png");
    int good = file && picture_of_crops(file, r->contest, r->crops, r->exposure);
    return page_file_end(page) && good;
}

/* Enlarges small films by whole factors, so that their pixels are seen. */
static void show(FILE *html, const char *name, const char *caption, const film *size)
{
    int factor = SHOWN_WIDTH / size->width > 1 ? SHOWN_WIDTH / size->width : 1;
    fprintf(html,
            "<figure><a href=\"%s\"><img class=\"pixels\" src=\"%s\" width=\"%d\" height=\"%d\" "
            "alt=\"\"></a><figcaption>",
            name, name, factor * size->width, factor * size->height);
    svg_escape(html, caption);
    fputs("</figcaption></figure>\n", html);
}

static int show_film(html_page *page, const comparison *r, const char *way_name, const char *what, const film *f,
                     const contest_point *p)
{
    char name[PAGE_NAME_MAX], caption[160];
    page_name(name, way_name, what);
    if (p)
        snprintf(caption, sizeof caption, "%s: %llu samples in %.1f s, error %.2f%%, without fireflies %.2f%%",
                 way_name, (unsigned long long)p->samples, p->seconds, 100 * p->error.relative,
                 100 * p->error.trimmed);
    else
        snprintf(caption, sizeof caption, "%s: %s", way_name, r->reference_is);
    show(page->html, name, caption, f);
    return add_film(page, r, name, f);
}

/* ---- sections ---- */

static int write_pictures(html_page *page, const comparison *r)
{
    const contest *c = r->contest;
    page_section(page, "pictures", "Equal time", "The reference, then what each way has after the same time.");
    fputs("<div class=\"pair\">\n", page->html);
    int good = show_film(page, r, "reference", "film.png", c->reference, NULL);
    for (size_t i = 0; i < c->count && good; i++)
        good = show_film(page, r, c->way[i].name, "time.png", &c->way[i].at_time, &c->way[i].by_time);
    fputs("</div>\n<h3>Crops</h3>\n<figure class=\"wide\"><a href=\"crops.png\">"
          "<img src=\"crops.png\" alt=\"\"></a><figcaption>From left to right: reference",
          page->html);
    for (size_t i = 0; i < c->count; i++)
        fprintf(page->html, ", %s", c->way[i].name);
    fprintf(page->html,
            ". Above (%d, %d), where all err most; below (%d, %d), where the others err most beside "
            "%s.</figcaption></figure>\n",
            r->crops[0].x, r->crops[0].y, r->crops[1].x, r->crops[1].y, c->way[0].name);
    page_section_end(page);
    return good && add_crops(page, r);
}

static int write_equal_samples(html_page *page, const comparison *r)
{
    const contest *c = r->contest;
    int good = 1;
    page_section(page, "samples", "Equal samples", "What each way has with the same number of samples a pixel.");
    fputs("<div class=\"pair\">\n", page->html);
    for (size_t i = 0; i < c->count && good; i++)
        good = show_film(page, r, c->way[i].name, "samples.png", &c->way[i].at_samples, &c->way[i].by_samples);
    fputs("</div>\n", page->html);
    page_section_end(page);
    return good;
}

static void write_legend(FILE *html, const map_range *range)
{
    fputs("<p class=\"note\">", html);
    for (int i = 0; i <= 8; i++) {
        unsigned char rgb[3];
        error_colour(i / 8.0, rgb);
        fprintf(html,
                "<span style=\"display:inline-block;width:2em;height:1em;background:#%02x%02x%02x;"
                "border:1px solid #868e96\"></span> %.3g%% ",
                rgb[0], rgb[1], rgb[2], 100 * range->low * pow(range->high / range->low, i / 8.0));
    }
    fputs("</p>\n", html);
}

static int write_maps(html_page *page, const comparison *r)
{
    const contest *c = r->contest;
    int good = 1;
    page_section(page, "maps", "Error maps", "The error of each pixel after equal time, beside its light.");
    write_legend(page->html, &of_noise);
    fputs("<div class=\"pair\">\n", page->html);
    for (size_t i = 0; i < c->count && good; i++) {
        char name[PAGE_NAME_MAX];
        page_name(name, c->way[i].name, "error.png");
        show(page->html, name, c->way[i].name, c->reference);
        good = add_map(page, name, &c->way[i].at_time, c->reference, &of_noise);
    }
    fputs("</div>\n", page->html);
    page_section_end(page);
    return good;
}

int comparison_pictures(html_page *page, const comparison *r)
{
    return write_pictures(page, r) && write_equal_samples(page, r) && write_maps(page, r);
}

/* ---- changes by tables ---- */

int comparison_changes(html_page *page, const comparison *r)
{
    const contest *c = r->contest;
    char lead[256];
    snprintf(lead, sizeof lead,
             "What more samples do not lessen: with the same random numbers for all, beside "
             "%s.",
             c->way[0].name);
    page_section(page, "tables", "What tables change", lead);
    int good = page_table(page, comparison_common(r));
    fputs(
        "<p class=\"note\">The root of the mean product of two independent differences; below: twice what chance "
        "leaves of it.</p>\n",
        page->html);
    write_legend(page->html, &of_tables);
    fputs("<div class=\"pair\">\n", page->html);
    for (size_t i = 1; i < c->count && good; i++) {
        char name[PAGE_NAME_MAX];
        page_name(name, c->way[i].name, "changes.png");
        show(page->html, name, c->way[i].name, c->reference);
        good = add_map(page, name, &c->way[i].at_samples, &c->way[0].at_samples, &of_tables);
    }
    fputs("</div>\n", page->html);
    page_section_end(page);
    return good;
}
