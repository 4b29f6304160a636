/* vndf plot: one figure that shows a distribution and its visible normals. This file reads the options and lays
 * out the page; draw/panels.c draws. */
#include <string.h>

#include "command.h"
#include "cli/subject.h"
#include "cli/output.h"
#include "draw/draw.h"

static const char name[] = "vndf plot";

static const char *const help[] = {
    "usage: vndf plot FILE|ggx|beckmann [--theta A,B,...] [--alpha AX[,AY]] -o OUT.svg\n"
    "\n"
    "Draws D against the angle of the normal, and for each incident direction the visible normals: their\n"
    "density as colour and 350 samples as dots, on the hemisphere seen from above (equal-area projection).\n"
    "\n"
    "  --theta A,B,...  incident angles from the normal in degrees, 0 to 180, at most 8 (default 0,45,80,100)\n"
    "  --alpha AX[,AY]  roughness along x and y (default 1)\n"
    "  -o OUT.svg       the figure; - for stdout\n"
    "\n"
    "example: vndf plot wavy.vndf --theta 0,60 -o wavy.svg\n",
    NULL};

enum { DISCS_MAX = 8 };

/* The title, D on the left, above what colours and marks mean, and discs in one row or two. 0: no memory. */
static int draw_figure(FILE *file, const vndf_surface *surface, const double *theta, size_t count)
{
    const double margin = 20, header = 64, left_width = 420, disc_width = 290, disc_height = 300;
    const size_t columns = count <= 3 ? count : (count + 1) / 2, rows = (count + columns - 1) / columns;
    const double width = 2 * margin + left_width + disc_width * (double)columns;
    const double height = header + disc_height * (double)rows + (rows > 1 ? margin : 120);
    const char *source = vndf_distribution_info(surface->distribution).source;
    const size_t fits = (size_t)(width - 2 * margin) / 9 - 20, shown = fits < 100 ? fits : 100;
    char text[128];
    svg_begin(file, (svg_box){0, 0, width, height},
              "a distribution of normals, and the normals visible from some directions", 1);
    snprintf(text, sizeof text, "Visible normals of %.*s%s", (int)shown, source,
             strlen(source) > shown ? "..." : "");
    svg_text(file, "large ink", SVG_START, margin, 30, text);
    snprintf(text, sizeof text, "αx = %.4g, αy = %.4g", (double)surface->xx, (double)surface->yy);
    svg_text(file, "quiet", SVG_START, margin, 50, text);
    panel_ndf(file, (svg_box){margin, header, left_width, height - header - 80}, surface);
    int good = panel_key(file, margin + 20, height - 72);
    for (size_t i = 0; i < count && good; i++) {
        const svg_box box = {margin + left_width + disc_width * (double)(i % columns),
                             header + disc_height * (double)(i / columns), disc_width, disc_height};
        good = panel_disc(file, box, surface, theta[i], (unsigned)(i + 1));
    }
    fputs("</svg>\n", file);
    return good;
}

static int run(const arguments *given)
{
    static const char *const forms[] = {"svg", NULL};
    const char *angles = option_value(given, "--theta"), *path = option_value(given, "-o");
    double theta[DISCS_MAX] = {0, 45, 80, 100};
    size_t count = 4;
    chosen_distribution chosen;
    vndf_surface surface;
    output_file output;
    if (!path)
        return complain(name, "-o OUT.svg is missing");
    if (angles)
        count = parse_numbers(name, "--theta", angles, 0, 180, 1, DISCS_MAX, theta);
    if (count == 0 || !roughness_from(name, option_value(given, "--alpha"), &surface) ||
        !distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    surface.distribution = chosen.distribution;
    int status = STATUS_USE;
    if (output_form(name, path, forms) == 0 && output_open(&output, name, path)) {
        const int good = draw_figure(output.file, &surface, theta, count), stops = output_stopping();
        status =
            good && !stops ? output_commit(&output) : output_give_up(&output, stops ? "interrupted" : "no memory");
    }
    distribution_close(&chosen);
    return status;
}

const subcommand command_plot = {name, "draw density and samples as an SVG", "FILE|ggx|beckmann", 1, 1, run, help};
