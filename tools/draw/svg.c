#include "draw/svg.h"

#include <math.h>

static const char ink[] = "#212529";

void svg_begin(FILE *file, double width, double height)
{
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
            "width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
            "font-family=\"'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
            width, height, width, height);
}

void svg_end(FILE *file)
{
    fputs("</svg>\n", file);
}

void svg_escape(FILE *file, const char *text)
{
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", file);
        else if (*text == '<')
            fputs("&lt;", file);
        else if (*text == '>')
            fputs("&gt;", file);
        else if (*text == '"')
            fputs("&quot;", file);
        else if ((unsigned char)*text >= 32 || *text == '\n') /* XML has no control characters */
            fputc(*text, file);
    }
}

void svg_text(FILE *file, double x, double y, double size, svg_anchor anchor, const char *text)
{
    static const char *const names[] = {"start", "middle", "end"};
    fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">", x, y, size,
            names[anchor], ink);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

void svg_text_on_picture(FILE *file, double x, double y, double size, const char *text)
{
    fprintf(file,
            "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.1f\" fill=\"%s\" stroke=\"#ffffff\" "
            "stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\">",
            x, y, size, ink);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

void svg_text_upwards(FILE *file, double x, double y, double size, const char *text)
{
    fprintf(file,
            "<text transform=\"translate(%.1f %.1f) rotate(-90)\" font-size=\"%.1f\" text-anchor=\"middle\" "
            "fill=\"%s\">",
            x, y, size, ink);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

void svg_line(FILE *file, double x1, double y1, double x2, double y2, const char *stroke, double width,
              const char *dashes)
{
    fprintf(file,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%.1f\" "
            "stroke-dasharray=\"%s\"/>\n",
            x1, y1, x2, y2, stroke, width, dashes);
}

void svg_circle(FILE *file, double x, double y, double radius, const char *fill, const char *stroke, double width)
{
    fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\" stroke=\"%s\" stroke-width=\"%.1f\"/>\n",
            x, y, radius, fill, stroke, width);
}

void svg_frame(FILE *file, double x, double y, double width, double height)
{
    fprintf(file,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#868e96\"/>\n", x,
            y, width, height);
}

/* ---- rasters ------------------------------------------------------------------------------------- */

/* From nearly white to dark blue through green: lightness falls steadily, so it also reads in grey. */
static png_colour ramp_colour(double place)
{
    static const double stops[][3] = {{250, 251, 247}, {205, 232, 206}, {120, 198, 186},
                                      {44, 140, 180},  {26, 79, 142},   {10, 26, 74}};
    double at = place * 5, rounding = 0.5;
    int low = at < 4 ? (int)at : 4;
    double t = at - low, rgb[3];
    for (int i = 0; i < 3; i++)
        rgb[i] = stops[low][i] + t * (stops[low + 1][i] - stops[low][i]) + rounding;
    return (png_colour){(unsigned char)rgb[0], (unsigned char)rgb[1], (unsigned char)rgb[2]};
}

static void fill_palette(png_colour palette[256])
{
    palette[0] = (png_colour){255, 255, 255};
    for (int i = 1; i < 256; i++)
        palette[i] = ramp_colour((i - 1) / 254.0);
}

unsigned char svg_shade(double density)
{
    double clipped = density > 0 ? (density < 1 ? density : 1) : 0;
    return (unsigned char)(1 + (int)(254 * clipped + 0.5));
}

static int write_image(FILE *file, const double box[4], const unsigned char *index, size_t columns, size_t rows)
{
    png_colour palette[256];
    fill_palette(palette);
    fprintf(file,
            "<image x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" preserveAspectRatio=\"none\" "
            "xlink:href=\"data:image/png;base64,",
            box[0], box[1], box[2], box[3]);
    int good = png_write_base64(file, index, columns, rows, palette);
    fputs("\"/>\n", file);
    return good;
}

int svg_raster(FILE *file, double x, double y, double size, const unsigned char *index, size_t side)
{
    const double box[4] = {x, y, size, size};
    return write_image(file, box, index, side, side);
}

int svg_ramp(FILE *file, double x, double y, double width, double height)
{
    const double box[4] = {x, y, width, height};
    unsigned char index[255];
    for (int i = 0; i < 255; i++)
        index[i] = (unsigned char)(i + 1);
    int good = write_image(file, box, index, 255, 1);
    svg_frame(file, x, y, width, height);
    return good;
}
