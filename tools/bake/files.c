/* What `vndf bake` writes for each table: numbers for numpy (.npy), textures of half floats for engines (.dds), arrays
 * for C, GLSL and JavaScript, and a picture (.png); and a page that shows them all. */
#include "bake/bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "draw/png.h"
#include "draw/draw.h"

/* Format 1.0 of numpy's files: a dictionary in text, filled up to 64 bytes. */
static void write_npy(FILE *file, const baked *b)
{
    char head[256], shape[96] = "";
    size_t length = 0;
    for (int i = 0; i < b->axes; i++)
        length += (size_t)snprintf(shape + length, sizeof shape - length, "%zu, ", b->count[i]);
    if (b->channels > 1)
        snprintf(shape + length, sizeof shape - length, "%d", b->channels);
    int used = snprintf(head, sizeof head, "{'descr': '<f4', 'fortran_order': False, 'shape': (%s), }", shape);
    int all = (10 + used + 1 + 63) / 64 * 64 - 10;
    fwrite("\x93NUMPY\x01\x00", 1, 8, file);
    put_little(file, (uint32_t)all, 2);
    fprintf(file, "%-*s\n", all - 1, head);
    put_floats(file, b->value, baked_size(b));
}

unsigned bake_half(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const unsigned sign = bits >> 16 & 0x8000;
    const float size = fabsf(x);
    if (!(size <= 3.4e38f))
        return size > 0 ? sign | 0x7c00 : 0x7e00;
    if (size < 0x1p-14f) /* denormal: whole steps of 2^-24 */
        return sign | (unsigned)lrintf(size * 0x1p24f);
    bits &= 0x7fffffff;
    bits += 0xfff + (bits >> 13 & 1); /* to the nearest of 10 bits */
    unsigned half = (bits >> 13) - (112u << 10);
    return sign | (half < 0x7c00 ? half : 0x7c00);
}

/* A texture of half floats with the header DX10: one, two or four channels, the fourth is 1 where there are three. The
 * last axis runs along a row; one axis is a row, three are a volume. */
static void write_dds(FILE *file, const baked *b)
{
    enum { R16 = 54, RG16 = 34, RGBA16 = 10 };
    const size_t width = b->count[b->axes - 1], height = b->axes > 1 ? b->count[b->axes - 2] : 1,
                 depth = b->axes > 2 ? b->count[0] : 1;
    const int channels = b->channels < 3 ? b->channels : 4;
    const int format = channels == 1 ? R16 : channels == 2 ? RG16 : RGBA16;
    const uint32_t volume = depth > 1, flags = 0x100f | volume << 23;
    const uint32_t across = (uint32_t)width, down = (uint32_t)height, row = across * 2 * (uint32_t)channels;
    uint32_t head[36] = {124, flags, down, across, row, (uint32_t)depth, 1};
    head[18] = 32, head[19] = 4, head[20] = 0x30315844; /* the form of pixels: "DX10", */
    head[31] = (uint32_t)format, head[32] = volume ? 4 : 3, head[34] = 1;
    head[26] = volume ? 0x401008 : 0x1000, head[27] = volume << 21;
    fputs("DDS ", file);
    for (size_t i = 0; i < sizeof head / sizeof *head; i++)
        put_little(file, head[i], 4);
    for (size_t i = 0; i < width * height * depth; i++)
        for (int k = 0; k < channels; k++)
            put_little(file, bake_half(k < b->channels ? b->value[i * (size_t)b->channels + (size_t)k] : 1), 2);
}

static void write_about(FILE *file, const baked *b, const char *made_by)
{
    fprintf(file, "// %s: %s.\n", b->name, b->holds);
    for (int i = 0; i < b->axes; i++)
        fprintf(file, "// axis %d, %zu: %s%s\n", i, b->count[i], b->axis[i],
                i + 1 < b->axes || b->channels > 1 ? "" : "; it runs fastest");
    if (b->channels > 1)
        fprintf(file, "// %d channels, which run fastest\n", b->channels);
    if (b->error)
        fprintf(file, "// error: %.2g the largest, %.2g in the mean: %s\n", b->worst, b->mean, b->error);
    fprintf(file, "// made by: %s\n", made_by);
}

/* Numbers have a point or an exponent each, which GLSL needs for a float. */
static void write_array(FILE *file, const baked *b, bake_form form, const char *made_by)
{
    write_about(file, b, made_by);
    if (form == BAKE_C)
        fprintf(file, "static const float %s[%zu] = {\n", b->name, baked_size(b));
    else if (form == BAKE_GLSL)
        fprintf(file, "const float %s[%zu] = float[%zu](\n", b->name, baked_size(b), baked_size(b));
    else {
        fprintf(file, "export const %s = {size: [", b->name);
        for (int i = 0; i < b->axes; i++)
            fprintf(file, "%s%zu", i ? ", " : "", b->count[i]);
        fprintf(file, "], channels: %d, data: new Float32Array([\n", b->channels);
    }
    for (size_t i = 0; i < baked_size(b); i++) {
        char text[32];
        snprintf(text, sizeof text, "%.9g", (double)b->value[i]);
        fprintf(file, "%s%s%s", i == 0 ? "" : i % 8 ? ", " : ",\n", text, strpbrk(text, ".e") ? "" : ".0");
    }
    fputs(form == BAKE_C ? "};\n" : form == BAKE_GLSL ? ");\n" : "])};\n", file);
}

/* Up to three channels as red, green and blue, each between its least and its largest number; layers of a volume side
 * by side, and the last axis to the right. */
static int write_png(FILE *file, const baked *b)
{
    const size_t across = b->count[b->axes - 1], down = b->axes > 1 ? b->count[b->axes - 2] : 1,
                 layers = b->axes > 2 ? b->count[0] : 1, shown = b->channels < 3 ? 1 : 3,
                 zoom = across * layers > 128 ? 2 : 4, width = across * layers * zoom, height = down * zoom;
    float low[3], high[3];
    unsigned char *rgb = malloc(width * height * 3);
    if (!rgb)
        return 0;
    for (size_t k = 0; k < shown; k++) {
        low[k] = high[k] = b->value[k];
        for (size_t i = k; i < baked_size(b); i += (size_t)b->channels) {
            low[k] = fminf(low[k], b->value[i]);
            high[k] = fmaxf(high[k], b->value[i]);
        }
        if (low[k] >= 0 && high[k] <= 1)
            low[k] = 0, high[k] = 1;
    }
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++)
            for (size_t k = 0; k < 3; k++) {
                const size_t c = k < shown ? k : 0, layer = x / zoom / across,
                             at = (layer * down + y / zoom) * across + x / zoom % across;
                float v = (b->value[at * (size_t)b->channels + c] - low[c]) / fmaxf(high[c] - low[c], 1e-30f);
                rgb[(y * width + x) * 3 + k] = (unsigned char)lrintf(255 * fminf(fmaxf(v, 0), 1));
            }
    int good = png_write(file, rgb, width, height, NULL);
    free(rgb);
    return good;
}

static int write_table(html_page *page, const baked *b, bake_form form, const char *made_by)
{
    static const char *const ends[] = {"npy", "dds", "h", "glsl", "js", "png"};
    char name[PAGE_NAME_MAX];
    snprintf(name, sizeof name, "%s.%s", b->name, ends[form]);
    FILE *file = page_file(page, name);
    if (!file)
        return 0;
    if (form == BAKE_NPY)
        write_npy(file, b);
    else if (form == BAKE_DDS)
        write_dds(file, b);
    else if (form < BAKE_PICTURE)
        write_array(file, b, form, made_by);
    else if (!write_png(file, b))
        return denied(page->command, "no memory");
    return 1;
}

_Static_assert(BAKE_TABLES *(BAKE_PICTURE + 1) < PAGE_FILES_MAX, "a page has all files of all tables");

int bake_page(html_page *page, const baked_list *list, unsigned forms, const char *made_by, const char *subject)
{
    char title[512];
    snprintf(title, sizeof title, "Tables of %s", subject);
    if (!page_begin(page, title))
        return 0;
    fputs("<p class=\"lead\">Made by <code>", page->html);
    svg_escape(page->html, made_by);
    fputs("</code></p>\n", page->html);
    for (const baked *b = list->table; b < list->table + list->count; b++) {
        page_section(page, b->name, b->name, b->holds);
        fputs("<ul>\n", page->html);
        for (int i = 0; i < b->axes; i++) {
            fprintf(page->html, "<li>axis %d, %zu places: ", i, b->count[i]);
            svg_escape(page->html, b->axis[i]);
            fputs("</li>\n", page->html);
        }
        if (b->error)
            fprintf(page->html, "<li>error: %.2g the largest, %.2g in the mean: %s</li>\n", b->worst, b->mean,
                    b->error);
        fprintf(page->html,
                "</ul>\n<figure><img src=\"%s.png\" alt=\"%s as a picture\" style=\"image-rendering:pixelated;"
                "max-width:100%%\">\n<figcaption>Columns: the last axis. Rows: the axis before it. Channels are "
                "red, green and blue.</figcaption></figure>\n",
                b->name, b->name);
        for (bake_form f = BAKE_NPY; f <= BAKE_PICTURE; f++)
            if ((forms >> f & 1 || f == BAKE_PICTURE) && !write_table(page, b, f, made_by))
                return 0;
    }
    page_end(page);
    return 1;
}
