#include "draw/panels.h"

#include <math.h>
#include <stdlib.h>

#include "cli/subject.h"
#include "cli/random.h"
#include "cli/sort.h"
#include "draw/svg.h"

static const double pi = 3.14159265358979323846;
static const char dot_colour[] = "#f76707";

enum { SIDE = 180, FINE = 2, PILOTS = 1000 };

double round_angle(double degrees)
{
    static const double steps[] = {90, 60, 30, 15};
    double best = 90, decade = 1;
    for (int i = 0; i < 32; i++) {
        double step = i < 4 ? steps[i] : (i % 3 == 1 ? 6 : i % 3 == 2 ? 3 : 1.5) * decade;
        if (step < degrees)
            break;
        best = step;
        if (i >= 4 && i % 3 == 0)
            decade /= 10;
    }
    return best;
}

/* The place of a normal on a disc of radius 1 whose rim is at `rim` = sin(theta/2), and back. */
static void disc_from_normal(vndf_vec3 wm, double rim, double *x, double *y)
{
    double scale = 1 / (rim * sqrt(2 * (1 + (double)wm.z)));
    *x = (double)wm.x * scale;
    *y = (double)wm.y * scale;
}

static vndf_vec3 normal_from_disc(double x, double y, double rim)
{
    double s2 = (x * x + y * y) * rim * rim, scale = 2 * rim * sqrt(fmax(0, 1 - s2));
    vndf_vec3 wm = {(float)(x * scale), (float)(y * scale), (float)(1 - 2 * s2)};
    return wm;
}

static vndf_vec3 draw_normal(const vndf_view *view, random_stream *stream, float *pdf)
{
    float u1 = random_float(stream), u2 = random_float(stream);
    return vndf_sample(view, u1, u2, pdf);
}

static double rim_angle(const vndf_view *view, unsigned seed)
{
    double angle[PILOTS];
    random_stream stream = random_from(seed + 1u);
    for (size_t i = 0; i < PILOTS; i++) {
        vndf_vec3 wm = draw_normal(view, &stream, NULL);
        angle[i] = atan2(hypot((double)wm.x, (double)wm.y), (double)wm.z) * 180 / pi;
    }
    sort_numbers(angle, PILOTS);
    return round_angle(angle[PILOTS * 95 / 100]);
}

/* ---- density ------------------------------------------------------------------------------------- */

/* The mean over FINE x FINE points of a pixel, or -1 well outside the disc (the grid covers the steps at the
 * rim). */
static double pixel_density(const vndf_view *view, double rim, size_t column, size_t row)
{
    double sum = 0;
    for (size_t k = 0; k < FINE * FINE; k++) {
        double x = 2 * ((double)(column * FINE + k % FINE) + 0.5) / (SIDE * FINE) - 1;
        double y = 1 - 2 * ((double)(row * FINE + k / FINE) + 0.5) / (SIDE * FINE);
        if (x * x + y * y > 1.06)
            return -1;
        vndf_vec3 wm = normal_from_disc(x, y, rim);
        wm.z = wm.z > 0 ? wm.z : 0; /* a pixel across the rim shows the rim */
        sum += (double)vndf_pdf(view, wm);
    }
    return sum / (FINE * FINE);
}

/* The value that only one in 500 pixels exceeds: one bright pixel must not darken the rest. */
static double near_maximum(const double *density, double *scratch)
{
    size_t inside = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++)
        if (density[i] >= 0)
            scratch[inside++] = density[i];
    sort_numbers(scratch, inside);
    double high = scratch[inside - 1 - inside / 500];
    return high > 0 ? high : scratch[inside - 1];
}

static int draw_density(FILE *file, const vndf_view *view, double rim, double x, double y, double radius,
                        double *maximum)
{
    unsigned char index[SIDE * SIDE];
    double *density = malloc(2 * SIDE * SIDE * sizeof *density);
    if (!density)
        return 0;
    for (size_t i = 0; i < SIDE * SIDE; i++)
        density[i] = pixel_density(view, rim, i % SIDE, i / SIDE);
    *maximum = near_maximum(density, density + SIDE * SIDE);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        index[i] = density[i] < 0 ? 0 : svg_shade(*maximum > 0 ? sqrt(density[i] / *maximum) : 0);
    free(density);
    return svg_raster(file, x - radius, y - radius, 2 * radius, index, SIDE);
}

/* ---- dots and grid ------------------------------------------------------------------------------- */

/* One path of zero-length strokes with round ends: 12 bytes a dot instead of 60. */
static void draw_dots(FILE *file, const vndf_view *view, double rim, panel_box centre, unsigned seed)
{
    random_stream stream = random_from(seed);
    fprintf(file, "<path stroke=\"%s\" stroke-width=\"2.6\" stroke-linecap=\"round\" stroke-opacity=\"0.8\" d=\"",
            dot_colour);
    for (size_t i = 0; i < PANEL_DOTS; i++) {
        double x, y;
        float pdf;
        disc_from_normal(draw_normal(view, &stream, &pdf), rim, &x, &y);
        if (pdf > 0 && x * x + y * y <= 1)
            fprintf(file, "M%.1f %.1fh0", centre.x + centre.width * x, centre.y - centre.width * y);
    }
    fputs("\"/>\n", file);
}

static void draw_grid(FILE *file, double rim_degrees, double x, double y, double radius)
{
    double rim = sin(rim_degrees * pi / 360);
    svg_circle(file, x, y, radius + 4, "none", "#ffffff", 8);
    for (int third = 1; third <= 3; third++) {
        char label[32];
        double degrees = rim_degrees * third / 3, r = radius * sin(degrees * pi / 360) / rim;
        svg_circle(file, x, y, r, "none", third == 3 ? "#495057" : "#adb5bd", third == 3 ? 1.2 : 0.7);
        snprintf(label, sizeof label, "%.4g°", degrees);
        svg_text_on_picture(file, x + 0.707 * r + 3, y + 0.707 * r + 11, 10, label);
    }
}

/* Shows wi itself: a ring on the disc, or an arrow beyond the rim that points to it. */
static void draw_direction(FILE *file, vndf_vec3 wi, double rim, double x, double y, double radius)
{
    double px = 2, py = 0;
    if (wi.z > -0.99f)
        disc_from_normal(wi, rim, &px, &py);
    if (px <= 1) {
        svg_circle(file, x + radius * px, y, 5, "none", "#ffffff", 4);
        svg_circle(file, x + radius * px, y, 5, "none", "#212529", 1.6);
        return;
    }
    svg_line(file, x + radius + 4, y, x + radius + 16, y, "#212529", 1.6, "none");
    svg_line(file, x + radius + 11, y - 4, x + radius + 16, y, "#212529", 1.6, "none");
    svg_line(file, x + radius + 11, y + 4, x + radius + 16, y, "#212529", 1.6, "none");
}

int panel_disc(FILE *file, panel_box box, const vndf_surface *surface, double theta, unsigned seed)
{
    char title[64], note[64];
    double maximum = 0, x = box.x + box.width / 2, radius = fmin(box.width - 60, box.height - 70) / 2;
    double y = box.y + 28 + radius;
    vndf_vec3 wi = direction_from(theta, 0);
    vndf_view view = vndf_view_from(surface, wi);
    double rim_degrees = rim_angle(&view, seed), rim = sin(rim_degrees * pi / 360);
    if (!draw_density(file, &view, rim, x, y, radius, &maximum))
        return 0;
    panel_box centre = {x, y, radius, radius};
    draw_grid(file, rim_degrees, x, y, radius);
    draw_dots(file, &view, rim, centre, seed);
    draw_direction(file, wi, rim, x, y, radius);
    snprintf(title, sizeof title, "incident at θ = %.4g°", theta);
    if (maximum > 0)
        snprintf(note, sizeof note, "darkest: %.3g per steradian", maximum);
    else
        snprintf(note, sizeof note, "no normal is visible");
    svg_text(file, x, box.y + 16, 14, SVG_MIDDLE, title);
    svg_text(file, x, y + radius + 22, 11, SVG_MIDDLE, note);
    return 1;
}
