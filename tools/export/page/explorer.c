/* explorer.html is the frame. A line of it that is {{file}} stands for that file, and {{choices}}, {{certificates}},
 * {{numbers}} and {{kernel}} for what differs from page to page. Words after a file's name are its $1 and $2. */
#define _POSIX_C_SOURCE 200809L
#include "export/page/explorer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/png.h"
#include "draw/svg.h"

/* ---- names and certificates ---------------------------------------------------------------------- */

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

static int put_choices(const export_document *document, FILE *to)
{
    for (size_t i = 0; i < document->tables; i++) {
        const exported_table *table = &document->table[i];
        fprintf(to, "<option value=\"%zu\" data-median=\"%.6g\">", table->base,
                vndf_distribution_info(table->distribution).scale);
        put_name(to, table);
        fputs("</option>\n", to);
    }
    return 1;
}

static void put_measured(FILE *to, const vndf_certificate *c)
{
    fprintf(
        to,
        "<li>Its samples differ from the true visible normals by a total variation of at most <b>%.2g</b> above "
        "the horizon,\n%.2g below it: of a million samples at most %.0f would have to move.</li>\n",
        (double)c->tv_above, (double)c->tv, ceil(1e6 * (double)c->tv));
    fprintf(to,
            "<li>But for a millionth of the samples, the true density is at most <b>%.4g</b> times the drawn one; "
            "it is %sbounded\non the whole hemisphere.</li>\n",
            (double)c->max_weight, c->weight_bounded > 0 ? "" : "not ");
    fprintf(
        to,
        "<li>Projected area, Lambda and G1 are right within <b>%.1g</b>, D within %.1g; the density integrates to "
        "1 within %.1g.</li>\n",
        (double)c->area_error, (double)c->ndf_error, (double)c->consistency);
    if (c->hidden > 0)
        fprintf(to, "<li>What the builder may have missed holds at most %.2g of the mass.</li>\n",
                (double)c->hidden);
    if (c->horizon_power < 0)
        fprintf(to,
                "<li>D grows towards the horizon as cos<sup>%.3g</sup>: no grid of angles resolves it "
                "there.</li>\n",
                (double)c->horizon_power);
}

static int put_certificates(const export_document *document, FILE *to)
{
    for (size_t i = 0; i < document->tables; i++) {
        const exported_table *table = &document->table[i];
        const vndf_info info = vndf_distribution_info(table->distribution);
        fprintf(to, "<article data-table=\"%zu\" data-tv=\"%.2g\">\n<h3>", table->base,
                (double)info.certificate.tv_above);
        put_name(to, table);
        fprintf(to, "</h3>\n<p>A file of %zu bytes, in a shader %zu numbers; made by %s: <code>", info.bytes,
                table->size, info.tool);
        put_text(to, info.source, strlen(info.source));
        fputs("</code></p>\n<ul>\n", to);
        put_measured(to, &info.certificate);
        fputs("</ul>\n</article>\n", to);
    }
    return 1;
}

/* ---- numbers and kernel -------------------------------------------------------------------------- */

enum { LINE_BYTES = 84, FLOATS = LINE_BYTES / 4 };

/* Little-endian, in lines of base64. */
static int put_numbers(const export_document *document, FILE *to)
{
    for (size_t i = 0; i < document->count; i += FLOATS) {
        unsigned char line[LINE_BYTES];
        size_t n = document->count - i < FLOATS ? document->count - i : FLOATS;
        for (size_t k = 0; k < 4 * n; k++) {
            unsigned bits;
            memcpy(&bits, &document->numbers[i + k / 4], sizeof bits);
            line[k] = (unsigned char)(bits >> 8 * (k % 4) & 255u);
        }
        base64_write(to, line, 4 * n);
        fputs("\n", to);
    }
    return 1;
}

/* Escaped, since comments quote the tables' sources. */
static int put_kernel(const export_document *document, FILE *to)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    int good = memory && document_write(document, memory);
    if (memory && fclose(memory) != 0)
        good = 0;
    if (good)
        svg_escape(to, text);
    free(text);
    return good;
}

/* ---- the page ------------------------------------------------------------------------------------ */

typedef struct page_part {
    const char *name;
    int (*put)(const export_document *document, FILE *to);
} page_part;

static const page_part parts[] = {{"choices", put_choices},
                                  {"certificates", put_certificates},
                                  {"numbers", put_numbers},
                                  {"kernel", put_kernel}};

static const char *const *text_named(const char *name)
{
    for (const embedded_text *text = page_texts; text->name; text++)
        if (strcmp(text->name, name) == 0)
            return text->lines;
    return NULL;
}

/* What stands between the braces: a name, and words that go into its text. */
typedef struct page_call {
    char name[32], word[2][16];
    int words;
} page_call;

static page_call call_from(const char *text, size_t length)
{
    page_call call = {"", {"", ""}, 0};
    char line[80];
    snprintf(line, sizeof line, "%.*s", (int)length, text);
    call.words = sscanf(line, "%31s %15s %15s", call.name, call.word[0], call.word[1]) - 1;
    return call;
}

static void put_line(FILE *to, const char *line, const page_call *call)
{
    for (; *line; line++) {
        int which = *line == '$' ? line[1] - '1' : -1;
        if (which >= 0 && which < call->words) {
            fputs(call->word[which], to);
            line++;
        } else {
            fputc(*line, to);
        }
    }
    fputs("\n", to);
}

static int put_lines(const export_document *document, FILE *to, const char *const *lines, const page_call *call);

static int put_part(const export_document *document, FILE *to, const page_call *call)
{
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if (strcmp(parts[i].name, call->name) == 0)
            return parts[i].put(document, to);
    const char *const *lines = text_named(call->name);
    return lines && put_lines(document, to, lines, call);
}

static int put_lines(const export_document *document, FILE *to, const char *const *lines, const page_call *call)
{
    for (; *lines; lines++) {
        size_t length = strlen(*lines);
        if (length > 4 && strncmp(*lines, "{{", 2) == 0) {
            const page_call inner = call_from(*lines + 2, length - 4);
            if (!put_part(document, to, &inner))
                return 0;
        } else {
            put_line(to, *lines, call);
        }
    }
    return 1;
}

int explorer_write(const export_document *document, FILE *to)
{
    static const page_call frame = {"explorer.html", {"", ""}, 0};
    return put_part(document, to, &frame);
}
