#include "draw/panels.h"

#include <math.h>

#include "cli/subject.h"
#include "draw/svg.h"

enum { POINTS = 361, CURVES_MAX = 3 };

static const double pi = 3.14159265358979323846;

typedef struct ndf_curve {
    vndf_surface surface;
    double azimuth; /* degrees */
    const char *label, *stroke, *dashes;
} ndf_curve;

/* The pixels of the plot and the values at its borders. */
typedef struct log_axes {
    double left, top, width, height;
    double degrees; /* at the right */
    double decade_low, decade_high;
} log_axes;

static double ndf_at(const ndf_curve *curve, double degrees)
{
    return (double)vndf_ndf(&curve->surface, direction_from(degrees, curve->azimuth));
}

/* GGX at alpha = 1 has the median slope 1, so alpha times the scale is the GGX of the same median. */
static size_t curves_of(const vndf_surface *surface, ndf_curve curves[CURVES_MAX])
{
    size_t count = 0;
    int isotropic = surface->alpha_x == surface->alpha_y;
    double scale = vndf_distribution_info(surface->distribution).scale;
    curves[count++] = (ndf_curve){*surface, 0, isotropic ? "D" : "D along x", "#1a4f8e", "none"};
    if (!isotropic)
        curves[count++] = (ndf_curve){*surface, 90, "D along y", "#0b8457", "none"};
    if (isotropic && scale > 0 && surface->distribution != vndf_ggx()) {
        float alpha = (float)((double)surface->alpha_x * scale);
        vndf_surface ggx = {vndf_ggx(), alpha, alpha};
        curves[count++] = (ndf_curve){ggx, 0, "GGX of the same median slope", "#868e96", "6 4"};
    }
    return count;
}

/* The reference curve does not count: it may fall much further than D. */
static void fit_decades(log_axes *axes, const ndf_curve *curves)
{
    double high = 0, low = INFINITY;
    for (int i = 0; i < POINTS; i++) {
        double ndf = ndf_at(&curves[0], axes->degrees * i / (POINTS - 1));
        if (!(ndf > 0) || !(ndf < 1e37)) /* an unbounded pole is drawn to the border */
            continue;
        high = fmax(high, ndf);
        low = fmin(low, ndf);
    }
    if (!(high > 0))
        high = low = 1;
    axes->decade_high = floor(log10(high) + 0.05) + 1;
    axes->decade_low = fmax(ceil(log10(low) - 0.05) - 1, axes->decade_high - 7);
    axes->decade_low = fmin(axes->decade_low, axes->decade_high - 2);
}

/* Cuts the curve where it leaves the plot, so that the end of a compact support shows. */
static void draw_curve(FILE *file, const log_axes *axes, const ndf_curve *curve)
{
    int inside = 0;
    double span = axes->decade_high - axes->decade_low;
    fprintf(file, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"%s\" d=\"",
            curve->stroke, curve->dashes);
    for (int i = 0; i < POINTS; i++) {
        double fraction = (double)i / (POINTS - 1), ndf = ndf_at(curve, axes->degrees * fraction);
        double height = ndf > 0 ? (log10(ndf) - axes->decade_low) / span : -1;
        if (height < 0) {
            inside = 0;
            continue;
        }
        fprintf(file, "%c%.1f %.1f", inside ? 'L' : 'M', axes->left + axes->width * fraction,
                axes->top + axes->height * (1 - fmin(height, 1)));
        inside = 1;
    }
    fputs("\"/>\n", file);
}

static void draw_angle_axis(FILE *file, const log_axes *axes)
{
    double bottom = axes->top + axes->height;
    for (int third = 0; third <= 3; third++) {
        char label[32];
        double x = axes->left + axes->width * third / 3;
        svg_line(file, x, axes->top, x, bottom, "#e9ecef", 1, "none");
        snprintf(label, sizeof label, "%.4g°", axes->degrees * third / 3);
        svg_text(file, x, bottom + 16, 11, SVG_MIDDLE, label);
    }
    svg_text(file, axes->left + axes->width / 2, bottom + 34, 12, SVG_MIDDLE, "angle of the normal θm (degrees)");
}

static void draw_decade_axis(FILE *file, const log_axes *axes)
{
    double span = axes->decade_high - axes->decade_low;
    for (double decade = axes->decade_low; decade <= axes->decade_high; decade++) {
        char label[32];
        double y = axes->top + axes->height * (axes->decade_high - decade) / span;
        svg_line(file, axes->left, y, axes->left + axes->width, y, "#e9ecef", 1, "none");
        snprintf(label, sizeof label, fabs(decade) < 4 ? "%g" : "%.0e", pow(10, decade));
        svg_text(file, axes->left - 6, y + 4, 11, SVG_END, label);
    }
    svg_text_upwards(file, axes->left - 52, axes->top + axes->height / 2, 12, "D(θm) (per steradian)");
}

static void draw_legend(FILE *file, double x, double y, const ndf_curve *curves, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double at = y + 18 * (double)i;
        svg_line(file, x, at - 4, x + 26, at - 4, curves[i].stroke, 2, curves[i].dashes);
        svg_text(file, x + 34, at, 12, SVG_START, curves[i].label);
    }
}

void panel_ndf(FILE *file, panel_box box, const vndf_surface *surface)
{
    ndf_curve curves[CURVES_MAX];
    size_t count = curves_of(surface, curves);
    double widest = fmax((double)surface->alpha_x, (double)surface->alpha_y);
    double scale = vndf_distribution_info(surface->distribution).scale;
    log_axes axes = {box.x + 70, box.y + 28, box.width - 80, box.height - 120, 90, 0, 0};
    if (scale > 0)
        axes.degrees = round_angle(atan(8 * scale * widest) * 180 / pi);
    fit_decades(&axes, curves);
    svg_text(file, axes.left + axes.width / 2, box.y + 16, 14, SVG_MIDDLE, "distribution of normals");
    draw_angle_axis(file, &axes);
    draw_decade_axis(file, &axes);
    svg_frame(file, axes.left, axes.top, axes.width, axes.height);
    for (size_t i = count; i-- > 0;)
        draw_curve(file, &axes, &curves[i]);
    draw_legend(file, axes.left, axes.top + axes.height + 58, curves, count);
}
