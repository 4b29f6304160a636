/* vndf plot: one figure that shows a distribution and its visible normals. This file reads the options and lays
 * out the page; draw/panels.c draws. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/subject.h"
#include "cli/output.h"
#include "draw/panels.h"

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

typedef struct figure_plan {
    vndf_surface surface;
    double theta[DISCS_MAX];
    size_t count;
} figure_plan;

/* ---- the page ------------------------------------------------------------------------------------ */

static const double margin = 20, header = 64, left_width = 420, disc_width = 290, disc_height = 300;

static size_t columns_of(const figure_plan *figure)
{
    return figure->count <= 3 ? figure->count : (figure->count + 1) / 2;
}

static void draw_header(FILE *file, const figure_plan *figure, double width)
{
    char title[128], roughness[64];
    const char *source = vndf_distribution_info(figure->surface.distribution).source;
    size_t fits = (size_t)(width - 2 * margin) / 9 - 20;
    int shown = (int)(fits < 100 ? fits : 100);
    const char *cut = strlen(source) > (size_t)shown ? "..." : "";
    snprintf(title, sizeof title, "Visible normals of %.*s%s", shown, source, cut);
    snprintf(roughness, sizeof roughness, "αx = %.4g, αy = %.4g", (double)figure->surface.alpha_x,
             (double)figure->surface.alpha_y);
    fputs("<g style=\"font-size:18px\">", file);
    svg_text(file, "ink", SVG_START, margin, 30, title);
    fputs("</g>\n", file);
    svg_text(file, "quiet", SVG_START, margin, 50, roughness);
}

static int draw_figure(FILE *file, const figure_plan *figure)
{
    size_t columns = columns_of(figure), rows = (figure->count + columns - 1) / columns;
    double width = 2 * margin + left_width + disc_width * (double)columns;
    double height = header + disc_height * (double)(rows > 1 ? rows : 1) + (rows > 1 ? margin : 120);
    svg_box left = {margin, header, left_width, height - header - 80};
    svg_begin(file, (svg_box){0, 0, width, height},
              "a distribution of normals, and the normals visible from some directions", 1);
    draw_header(file, figure, width);
    panel_ndf(file, left, &figure->surface);
    int good = panel_key(file, margin + 20, height - 72);
    for (size_t i = 0; i < figure->count && good; i++) {
        svg_box box = {margin + left_width + disc_width * (double)(i % columns),
                       header + disc_height * (double)(i / columns), disc_width, disc_height};
        good = panel_disc(file, box, &figure->surface, figure->theta[i], (unsigned)(i + 1));
    }
    fputs("</svg>\n", file);
    return good;
}

/* ---- the command --------------------------------------------------------------------------------- */

static int plot_to_file(const figure_plan *figure, const char *path)
{
    output_file output;
    static const char *const forms[] = {"svg", NULL};
    if (output_form(name, path, forms) < 0 || !output_open(&output, name, path))
        return STATUS_USE;
    if (draw_figure(output.file, figure) && !output_stopping())
        return output_commit(&output);
    return output_give_up(&output, output_stopping() ? "interrupted" : "no memory");
}

static int run(const arguments *given)
{
    const char *theta = option_value(given, "--theta"), *path = option_value(given, "-o");
    chosen_distribution chosen;
    figure_plan figure = {{NULL, 1, 1}, {0, 45, 80, 100}, 4};
    if (!path)
        return complain(name, "-o OUT.svg is missing");
    if (theta)
        figure.count = parse_numbers(name, "--theta", theta, 0, 180, 1, DISCS_MAX, figure.theta);
    if (figure.count == 0 || !roughness_from(name, option_value(given, "--alpha"), &figure.surface) ||
        !distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    figure.surface.distribution = chosen.distribution;
    int status = plot_to_file(&figure, path);
    distribution_close(&chosen);
    return status;
}

const subcommand command_plot = {name, "draw density and samples as an SVG", "FILE|ggx|beckmann", 1, 1, run, help};
