#include "draw/draw.h"

#include <math.h>

#include "cli/random.h"
#include "cli/sort.h"
#include "cli/subject.h"

static const double pi = 3.14159265358979323846;

enum { POINTS = 361, SIDE = 180, FINE = 2, PILOTS = 1000 };

/* The smallest of 90, 60, 30, 15, 6, 3, 1.5, 0.6 ... degrees that is not below `degrees`; each can be cut into
 * three readable parts. */
static double round_angle(double degrees)
{
    static const double steps[] = {90, 60, 30, 15}, decade[] = {6, 3, 1.5};
    double best = 90;
    for (int i = 0; i < 32; i++) {
        double step = i < 4 ? steps[i] : decade[(i - 4) % 3] * pow(10, -((i - 4) / 3));
        if (step < degrees)
            break;
        best = step;
    }
    return best;
}

void panel_ndf(FILE *file, svg_box box, const vndf_surface *surface)
{
    static chart_point point[2][POINTS];
    const double roughest = fmax((double)surface->xx, (double)surface->yy),
                 scale = vndf_distribution_info(surface->distribution).scale;
    const double widest = scale > 0 ? round_angle(atan(8 * scale * roughest) * 180 / pi) : 90;
    const int is_round = surface->xx == surface->yy,
              has_ggx = is_round && scale > 0 && surface->distribution != vndf_ggx();
    /* GGX at alpha = 1 has the median slope 1, so alpha times the scale is the GGX of the same median. */
    const float alpha = (float)((double)surface->xx * scale);
    const vndf_surface ggx = vndf_rough(vndf_ggx(), alpha, alpha);
    for (int i = 0; i < POINTS; i++) {
        const double x = widest * fmax(i, 0.3) / (POINTS - 1); /* at the pole itself D may be unbounded */
        point[0][i] = (chart_point){.x = x, .y = (double)vndf_ndf(surface, direction_from(x, 0))};
        point[1][i] = (chart_point){
            .x = x, .y = (double)vndf_ndf(has_ggx ? &ggx : surface, direction_from(x, is_round ? 0 : 90))};
    }
    const chart_series series[2] = {
        {is_round ? "D" : "D along x", 0, CHART_NO_MARK, CHART_SOLID, point[0], POINTS},
        {is_round ? "GGX of the same median slope" : "D along y", is_round ? 4 : 2, CHART_NO_MARK,
         is_round ? CHART_DASHED : CHART_SOLID, point[1], POINTS}};
    const chart c = {.title = "distribution of normals",
                     .box = box,
                     .x = {"angle of the normal θm (degrees)", widest / 3, widest},
                     .y = {.label = "D(θm) (per steradian)"},
                     .series = series,
                     .count = is_round && !has_ggx ? 1 : 2};
    chart_draw(file, &c, 0);
}

/* A disc in the making: its centre and radius, what is seen, and the rim, sin(theta/2) of its angle. */
typedef struct disc {
    FILE *file;
    double x, y, radius, rim_degrees, rim, maximum;
    vndf_vec3 wi;
    vndf_view view;
} disc;

/* The place of a normal on a disc of radius 1. */
static void place_of(const disc *d, vndf_vec3 wm, double *x, double *y)
{
    double scale = 1 / (d->rim * sqrt(2 * (1 + (double)wm.z)));
    *x = (double)wm.x * scale;
    *y = (double)wm.y * scale;
}

static vndf_vec3 draw_normal(const disc *d, random_stream *stream, float *pdf)
{
    float u1 = random_float(stream), u2 = random_float(stream);
    return vndf_sample(&d->view, u1, u2, pdf);
}

static double rim_angle(const disc *d, unsigned seed)
{
    double angle[PILOTS];
    random_stream stream = random_from(seed + 1u);
    for (size_t i = 0; i < PILOTS; i++) {
        vndf_vec3 wm = draw_normal(d, &stream, NULL);
        angle[i] = atan2(hypot((double)wm.x, (double)wm.y), (double)wm.z) * 180 / pi;
    }
    sort_numbers(angle, PILOTS);
    return round_angle(angle[PILOTS * 95 / 100]);
}

/* The mean over FINE x FINE points of a pixel, or -1 well outside the disc (the grid covers the steps at the rim). */
static double pixel_density(const disc *d, size_t column, size_t row)
{
    double sum = 0;
    for (size_t k = 0; k < FINE * FINE; k++) {
        double x = 2 * ((double)(column * FINE + k % FINE) + 0.5) / (SIDE * FINE) - 1;
        double y = 1 - 2 * ((double)(row * FINE + k / FINE) + 0.5) / (SIDE * FINE);
        double s2 = (x * x + y * y) * d->rim * d->rim, scale = 2 * d->rim * sqrt(fmax(0, 1 - s2));
        if (x * x + y * y > 1.06)
            return -1;
        /* a pixel across the rim of the hemisphere shows the rim */
        vndf_vec3 wm = {(float)(x * scale), (float)(y * scale), (float)fmax(1 - 2 * s2, 0)};
        sum += (double)vndf_pdf(&d->view, wm);
    }
    return sum / (FINE * FINE);
}

/* The darkest colour is the value that only one in 500 pixels exceeds: one bright pixel must not pale the rest. */
static int draw_density(disc *d)
{
    unsigned char index[SIDE * SIDE];
    double *density = malloc(2 * SIDE * SIDE * sizeof *density), *sorted = density + SIDE * SIDE;
    size_t inside = 0;
    if (!density)
        return 0;
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        density[i] = pixel_density(d, i % SIDE, i / SIDE);
        if (density[i] >= 0)
            sorted[inside++] = density[i];
    }
    sort_numbers(sorted, inside);
    d->maximum = sorted[inside - 1 - inside / 500];
    d->maximum = d->maximum > 0 ? d->maximum : sorted[inside - 1];
    for (size_t i = 0; i < SIDE * SIDE; i++)
        index[i] =
            density[i] < 0 ? 0 : (unsigned char)(1.5 + 254 * sqrt(fmin(density[i] / fmax(d->maximum, 1e-300), 1)));
    free(density);
    const svg_box box = {d->x - d->radius, d->y - d->radius, 2 * d->radius, 2 * d->radius};
    return svg_raster(d->file, box, index, SIDE, SIDE);
}

/* One path of zero-length strokes with round ends: 12 bytes a dot instead of 60. */
static void draw_dots(const disc *d, unsigned seed)
{
    random_stream stream = random_from(seed);
    fputs("<path style=\"stroke:#f76707;stroke-width:2.6;stroke-linecap:round;stroke-opacity:.8\" d=\"", d->file);
    for (size_t i = 0; i < PANEL_DOTS; i++) {
        double x, y;
        float pdf;
        place_of(d, draw_normal(d, &stream, &pdf), &x, &y);
        if (pdf > 0 && x * x + y * y <= 1)
            fprintf(d->file, "M%.1f %.1fh0", d->x + d->radius * x, d->y - d->radius * y);
    }
    fputs("\"/>\n", d->file);
}

/* Circles at thirds of the angle of the rim, and what they are. */
static void draw_grid(const disc *d)
{
    const double per_sine = d->radius / d->rim, half = d->rim_degrees * pi / 360; /* of the rim's angle */
    svg_circle(d->file, "edge", d->x, d->y, d->radius + 4, 8);
    fputs("<path class=\"axis\" d=\"", d->file);
    for (int third = 1; third <= 3; third++) {
        const double r = per_sine * sin(half * third / 3);
        fprintf(d->file, "M%.1f %.1fa%.1f %.1f 0 1 0 %.1f 0a%.1f %.1f 0 1 0 %.1f 0", d->x - r, d->y, r, r, 2 * r,
                r, r, -2 * r);
    }
    fputs("\"/>\n<text class=\"tick halo\">", d->file);
    for (int third = 1; third <= 3; third++) {
        const double r = 0.707 * per_sine * sin(half * third / 3);
        fprintf(d->file, "<tspan x=\"%.1f\" y=\"%.1f\">%.4g°</tspan>", d->x + r + 3, d->y + r + 11,
                d->rim_degrees * third / 3);
    }
    fputs("</text>\n", d->file);
}

/* Shows wi itself: a ring on the disc, or an arrow beyond the rim that points to it. */
static void draw_direction(const disc *d)
{
    double px = 2, py = 0;
    if (d->wi.z > -0.99f)
        place_of(d, d->wi, &px, &py);
    if (px > 1) {
        fprintf(d->file, "<path class=\"pen\" d=\"M%.1f %.1fh12m-5-4l5 4l-5 4\"/>\n", d->x + d->radius + 4, d->y);
        return;
    }
    fprintf(d->file,
            "<g style=\"fill:none\"><circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" style=\"stroke:#fff;stroke-width:4\"/>"
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" style=\"stroke:#212529;stroke-width:1.6\"/></g>\n",
            d->x + d->radius * px, d->y, d->x + d->radius * px, d->y);
}

int panel_disc(FILE *file, svg_box box, const vndf_surface *surface, double theta, unsigned seed)
{
    char title[64], note[64] = "no normal is visible";
    disc d = {.file = file, .radius = fmin(box.width - 60, box.height - 70) / 2, .wi = direction_from(theta, 0)};
    d.x = box.width / 2;
    d.y = 28 + d.radius;
    d.view = vndf_view_from(surface, d.wi);
    d.rim_degrees = rim_angle(&d, seed);
    d.rim = sin(d.rim_degrees * pi / 360);
    snprintf(title, sizeof title, "incident at θ = %.4g°", theta);
    svg_begin(file, box, title, 0);
    if (!draw_density(&d))
        return 0;
    draw_grid(&d);
    draw_dots(&d, seed);
    draw_direction(&d);
    if (d.maximum > 0)
        snprintf(note, sizeof note, "darkest: %.3g per steradian", d.maximum);
    svg_text(file, "title ink", SVG_MIDDLE, d.x, 16, title);
    svg_text(file, "tick quiet", SVG_MIDDLE, d.x, d.y + d.radius + 22, note);
    fputs("</svg>\n", file);
    return 1;
}

int panel_key(FILE *file, double x, double y)
{
    static const char *const names[] = {"0", "1/16", "1/4", "1"};
    static const double places[] = {0, 75, 150, 300};
    unsigned char index[255];
    for (int i = 0; i < 255; i++)
        index[i] = (unsigned char)(i + 1);
    svg_text(file, "ink", SVG_START, x, y, "density of visible normals, relative to the darkest of each disc");
    int good = svg_raster(file, (svg_box){x, y + 8, 300, 12}, index, 255, 1);
    for (int i = 0; i < 4; i++)
        svg_text(file, "tick quiet",
                 i == 3 ? SVG_END
                 : i    ? SVG_MIDDLE
                        : SVG_START,
                 x + places[i], y + 34, names[i]);
    fprintf(file, "<circle fill=\"#f76707\" cx=\"%.1f\" cy=\"%.1f\" r=\"1.8\"/>\n", x + 5, y + 50);
    svg_text(file, "ink", SVG_START, x + 16, y + 54, "sample");
    svg_circle(file, "pen", x + 87, y + 50, 5, 1.6);
    svg_text(file, "ink", SVG_START, x + 99, y + 54, "incident direction (arrow: beyond the rim)");
    return good;
}
