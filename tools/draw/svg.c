#include "draw/svg.h"

#include "draw/png.h"

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

void svg_text(FILE *file, const char *kind, svg_anchor anchor, double x, double y, const char *text)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    if (!*text)
        return;
    fprintf(file, "<text class=\"%s\"%s x=\"%.1f\" y=\"%.1f\">", kind, anchors[anchor], x, y);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

void svg_circle(FILE *file, const char *kind, double x, double y, double radius, double width)
{
    fprintf(file, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" style=\"stroke-width:%.1f\"/>\n", kind,
            x, y, radius, width);
}

/* From nearly white to dark blue through green: lightness falls steadily, so it also reads in grey. */
static png_colour ramp_colour(double place)
{
    static const double stops[][3] = {{250, 251, 247}, {205, 232, 206}, {120, 198, 186},
                                      {44, 140, 180},  {26, 79, 142},   {10, 26, 74}};
    double at = place * 5, rounding = 0.5, rgb[3];
    int low = at < 4 ? (int)at : 4;
    for (int i = 0; i < 3; i++)
        rgb[i] = stops[low][i] + (at - low) * (stops[low + 1][i] - stops[low][i]) + rounding;
    return (png_colour){(unsigned char)rgb[0], (unsigned char)rgb[1], (unsigned char)rgb[2]};
}

unsigned char svg_shade(double density)
{
    double clipped = density > 0 ? (density < 1 ? density : 1) : 0;
    return (unsigned char)(1 + (int)(254 * clipped + 0.5));
}

int svg_raster(FILE *file, double x, double y, double width, double height, const unsigned char *index,
               size_t columns, size_t rows)
{
    png_colour palette[256] = {{255, 255, 255}};
    for (int i = 1; i < 256; i++)
        palette[i] = ramp_colour((i - 1) / 254.0);
    fprintf(file,
            "<image x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" preserveAspectRatio=\"none\" "
            "xlink:href=\"data:image/png;base64,",
            x, y, width, height);
    int good = png_write_base64(file, index, columns, rows, palette);
    fputs("\"/>\n", file);
    return good;
}
