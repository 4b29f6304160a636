#include "draw/draw.h"

#include "draw/png.h"

void svg_style(FILE *file)
{
    fputs(
        ".chart{font:12px 'Helvetica Neue',Arial,'DejaVu Sans',sans-serif}\n"
        ".chart .line{fill:none;stroke-width:2;stroke-linejoin:round}\n"
        ".chart .mark{stroke-width:2}.chart .hollow{fill:none}\n"
        ".chart .tick,.chart .name{font-size:11px}.chart .title{font-size:14px;font-weight:600}"
        ".chart .large{font-size:18px}\n"
        ".chart .swatch{stroke-width:6}.chart .lead{fill:none;stroke-width:.7}.chart .fine{stroke-width:.4}\n"
        ".paper{fill:#fff}.ink{fill:#212529}.quiet{fill:#495057}.pen{stroke:#212529;stroke-width:1.6;fill:none}\n"
        ".grid{stroke:#dee2e6}.axis{fill:none;stroke:#868e96}.lead{stroke:#868e96}.edge{stroke:#fff;fill:none}\n"
        ".halo{stroke:#fff;stroke-width:3;paint-order:stroke;fill:#212529}\n"
        ".l0{stroke:#0072b2}.f0{fill:#0072b2}.t0{fill:#005f96}.l1{stroke:#d55e00}.f1{fill:#d55e00}.t1{fill:#a94a00}\n"
        ".l2{stroke:#009e73}.f2{fill:#009e73}.t2{fill:#007354}.l3{stroke:#6f42c1}.f3{fill:#6f42c1}.t3{fill:#5a34a0}\n"
        ".l4{stroke:#6c757d}.f4{fill:#6c757d}.t4{fill:#545b62}\n"
        "@media screen and (prefers-color-scheme:dark){\n"
        ".paper{fill:#16191d}.ink{fill:#e9ecef}.quiet{fill:#b6bec6}.pen{stroke:#e9ecef}.edge{stroke:#16191d}\n"
        ".grid{stroke:#343a40}\n"
        ".l0{stroke:#4da3e0}.f0{fill:#4da3e0}.t0{fill:#7fbfec}.l1{stroke:#f0803c}.f1{fill:#f0803c}.t1{fill:#f4a06d}\n"
        ".l2{stroke:#2fc59a}.f2{fill:#2fc59a}.t2{fill:#5ad6b2}.l3{stroke:#b395f0}.f3{fill:#b395f0}.t3{fill:#c5aef4}\n"
        ".l4{stroke:#9aa3ab}.f4{fill:#9aa3ab}.t4{fill:#b3bac1}}\n",
        file);
}

void svg_begin(FILE *file, svg_box box, const char *about, int is_alone)
{
    fprintf(
        file,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" class=\"chart\" "
        "x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" role=\"img\" "
        "aria-label=\"",
        box.x, box.y, box.width, box.height, box.width, box.height);
    svg_escape(file, about);
    fputs(is_alone ? "\">\n<style>\n" : "\">\n", file);
    if (!is_alone)
        return;
    svg_style(file);
    fputs("</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n", file);
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

/* The palette goes from nearly white to dark blue through green: lightness falls steadily, so it also reads in grey. */
int svg_raster(FILE *file, svg_box box, const unsigned char *index, size_t columns, size_t rows)
{
    static const double stops[][3] = {{250, 251, 247}, {205, 232, 206}, {120, 198, 186},
                                      {44, 140, 180},  {26, 79, 142},   {10, 26, 74}};
    png_colour palette[256] = {{255, 255, 255}};
    for (int i = 1; i < 256; i++) {
        const int low = i < 205 ? (i - 1) * 5 / 254 : 4;
        const double part = (i - 1) / 254.0 * 5 - low, *a = stops[low], *b = stops[low + 1];
        palette[i] = (png_colour){(unsigned char)(a[0] + part * (b[0] - a[0]) + 0.5),
                                  (unsigned char)(a[1] + part * (b[1] - a[1]) + 0.5),
                                  (unsigned char)(a[2] + part * (b[2] - a[2]) + 0.5)};
    }
    fprintf(file,
            "<image x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" preserveAspectRatio=\"none\" "
            "xlink:href=\"data:image/png;base64,",
            box.x, box.y, box.width, box.height);
    int good = png_write(file, index, columns, rows, palette);
    fputs("\"/>\n", file);
    return good;
}
