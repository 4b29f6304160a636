/* explorer.html is the frame. A line of it that is {{file}} stands for that file, and {{choices}}, {{certificates}},
 * {{numbers}}, {{kernel}} and {{shaders}} for what differs from page to page. A letter after a file's name is its $. */
#define _POSIX_C_SOURCE 200809L
#include "export/page/explorer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/png.h"
#include "draw/svg.h"

/* Text of a table or a path, which may hold anything. */
static void put_text(FILE *to, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        const char one[] = {text[i] >= ' ' && text[i] < 127 ? text[i] : '?', '\0'};
        svg_escape(to, one);
    }
}

/* The file's name without its folder and ending. */
static void put_name(FILE *to, const exported_table *table)
{
    const char *slash = strrchr(table->file, '/'), *from = slash ? slash + 1 : table->file;
    const char *end = strrchr(from, '.');
    put_text(to, from, end && end > from ? (size_t)(end - from) : strlen(from));
}

static void put_choices(FILE *to, const export_document *document)
{
    for (const exported_table *t = document->table; t < document->table + document->tables; t++) {
        fprintf(to, "<option value=\"%zu\" data-median=\"%.6g\">", t->base,
                vndf_distribution_info(t->distribution).scale);
        put_name(to, t);
        fputs("</option>\n", to);
    }
}

static void put_certificates(FILE *to, const export_document *document)
{
    for (const exported_table *t = document->table; t < document->table + document->tables; t++) {
        const vndf_info info = vndf_distribution_info(t->distribution);
        const vndf_certificate *c = &info.certificate;
        fprintf(to, "<article data-table=\"%zu\" data-tv=\"%.2g\">\n<h3>", t->base, (double)c->tv_above);
        put_name(to, t);
        fprintf(to, "</h3>\n<p>A file of %zu bytes, in a shader %zu numbers; made by %s: <code>", info.bytes,
                t->size, info.tool);
        put_text(to, info.source, strlen(info.source));
        fprintf(
            to,
            "</code></p>\n<ul>\n<li>Its samples differ from the true visible normals by a total variation of at "
            "most <b>%.2g</b> above the horizon,\n%.2g below it: of a million samples at most %.0f would have to "
            "move.</li>\n<li>But for a millionth of the samples, the true density is at most <b>%.4g</b> times the "
            "drawn one; it is %sbounded\non the whole hemisphere.</li>\n<li>Projected area, Lambda and G1 are right "
            "within <b>%.1g</b>, D within %.1g; the density integrates to 1 within %.1g.</li>\n",
            (double)c->tv_above, (double)c->tv, ceil(1e6 * (double)c->tv), (double)c->max_weight,
            c->weight_bounded > 0 ? "" : "not ", (double)c->area_error, (double)c->ndf_error,
            (double)c->consistency);
        if (c->hidden > 0)
            fprintf(to, "<li>What the builder may have missed holds at most %.2g of the mass.</li>\n",
                    (double)c->hidden);
        if (c->horizon_power < 0)
            fprintf(to,
                    "<li>D grows towards the horizon as cos<sup>%.3g</sup>: no grid of angles resolves it "
                    "there.</li>\n",
                    (double)c->horizon_power);
        fputs("</ul>\n</article>\n", to);
    }
}

/* Little-endian, in lines of base64. */
static void put_numbers(FILE *to, const export_document *document)
{
    unsigned char line[84];
    size_t n = 0;
    for (size_t i = 0; i < 4 * document->count; i++) {
        unsigned bits;
        memcpy(&bits, &document->numbers[i / 4], sizeof bits);
        line[n++] = (unsigned char)(bits >> 8 * (i % 4) & 255u);
        if (n == sizeof line || i + 1 == 4 * document->count) {
            base64_write(to, line, n);
            fputs("\n", to);
            n = 0;
        }
    }
}

/* Escaped, since comments quote the tables' sources. */
static int put_kernel(FILE *to, const export_document *document)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    int good = memory && document_write(document, memory);
    if (memory && fclose(memory) == 0 && good)
        svg_escape(to, text);
    free(text);
    return good;
}

static int put_file(FILE *to, const export_document *document, const char *name, const char *letter);

static int put_shaders(FILE *to, const export_document *document)
{
    for (const embedded_text *text = page_texts; text->name; text++)
        if (strstr(text->name, ".glsl")) {
            fprintf(to, "<script type=\"text/plain\" id=\"%s\">\n", text->name);
            put_file(to, document, text->name, "");
            fputs("</script>\n", to);
        }
    return 1;
}

/* What stands for {{name letter}}. */
static int put_part(FILE *to, const export_document *document, const char *name, const char *letter)
{
    if (strcmp(name, "kernel") == 0)
        return put_kernel(to, document);
    if (strcmp(name, "shaders") == 0)
        return put_shaders(to, document);
    if (strcmp(name, "choices") == 0)
        put_choices(to, document);
    else if (strcmp(name, "certificates") == 0)
        put_certificates(to, document);
    else if (strcmp(name, "numbers") == 0)
        put_numbers(to, document);
    else
        return put_file(to, document, name, letter);
    return 1;
}

static int put_file(FILE *to, const export_document *document, const char *name, const char *letter)
{
    const embedded_text *text = page_texts;
    while (text->name && strcmp(text->name, name) != 0)
        text++;
    for (const char *const *line = text->name ? text->lines : NULL; line && *line; line++) {
        char inner[32], its_letter[16] = "";
        if (sscanf(*line, "{{%31[^ }] %15[^}]", inner, its_letter) > 0) {
            if (!put_part(to, document, inner, its_letter))
                return 0;
            continue;
        }
        for (const char *at = *line; *at; at++)
            if (*at == '$' && *letter)
                fputs(letter, to);
            else
                fputc(*at, to);
        fputs("\n", to);
    }
    return text->name != NULL;
}

int explorer_write(const export_document *document, FILE *to)
{
    return put_file(to, document, "explorer.html", "");
}
