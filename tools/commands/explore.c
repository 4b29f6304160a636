/* vndf explore: a page on which tables, GGX and Beckmann are seen side by side, drawn by the exported kernel: one HTML
 * file that draws in WebGL2. tools/export/page/explorer.html is the frame. A line of it that is {{file}} stands for
 * that file, and {{choices}}, {{numbers}}, {{kernel}} and {{shaders}} for what differs from page to page. A letter
 * after a file's name is its $. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "commands/parts/named_tables.h"
#include "draw/png.h"
#include "draw/svg.h"
#include "export/document.h"

/* Numbers that the smallest float texture of WebGL2 holds: 1024 columns, 2048 rows. */
enum { NUMBERS_MAX = 1024 * 2048 };

static const char name[] = "vndf explore";

static const char *const help[] = {
    "usage: vndf explore FILE... -o PAGE.html\n"
    "\n"
    "Writes one page that needs nothing else, not even a network: in a browser with WebGL2 it draws two spheres, each\n"
    "shaded by sampling the visible normals of a table, of GGX or of Beckmann; beside each the density of these\n"
    "normals with samples on top, what the samples measure, and D of all of them as curves. Roughness, its axes,\n"
    "the angle of incidence, material and light can be changed. The shader is what `vndf export --language glsl`\n"
    "writes, and the page shows it.\n"
    "\n"
    "  -o PAGE.html     the page; - for stdout\n"
    "\n"
    "Settings stand in the page's address, so that a link keeps them: PAGE.html#alpha=0.2,0.05&theta=70&light=lamp;\n"
    "#frames=64 draws that many samples per pixel before the page is shown, for pictures.\n"
    "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf explore tables/student-t-2.5.vndf tables/hazy.vndf -o normals.html\n",
    NULL};

/* ---- the page ------------------------------------------------------------------------------------ */

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
        const vndf_info info = vndf_distribution_info(t->distribution);
        fprintf(to, "<option value=\"%zu\" data-median=\"%.6g\" data-tv=\"%.2g\">", t->base, info.scale,
                (double)info.certificate.tv_above);
        put_name(to, t);
        fputs("</option>\n", to);
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
    int good = memory && document_write(document, memory, NULL);
    if (memory && fclose(memory) == 0 && good)
        svg_escape(to, text);
    free(text);
    return good;
}

static int put_file(FILE *to, const export_document *document, const char *file, const char *letter);

static void put_shaders(FILE *to, const export_document *document)
{
    for (const embedded_text *text = page_texts; text->name; text++)
        if (strstr(text->name, ".glsl")) {
            fprintf(to, "<script type=\"text/plain\" id=\"%s\">\n", text->name);
            put_file(to, document, text->name, "");
            fputs("</script>\n", to);
        }
}

/* What stands for {{name letter}}. */
static int put_part(FILE *to, const export_document *document, const char *part, const char *letter)
{
    if (strcmp(part, "kernel") == 0)
        return put_kernel(to, document);
    if (strcmp(part, "choices") == 0)
        put_choices(to, document);
    else if (strcmp(part, "numbers") == 0)
        put_numbers(to, document);
    else if (strcmp(part, "shaders") == 0)
        put_shaders(to, document);
    else
        return put_file(to, document, part, letter);
    return 1;
}

static int put_file(FILE *to, const export_document *document, const char *file, const char *letter)
{
    const embedded_text *text = page_texts;
    while (text->name && strcmp(text->name, file) != 0)
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

/* ---- the command --------------------------------------------------------------------------------- */

static int write_page(const arguments *given, export_document *document)
{
    output_file page;
    translation_prefix(&document->as, "vndf");
    if (!named_tables_open(name, &given->positional, 0, document))
        return STATUS_USE;
    if (document->count > NUMBERS_MAX)
        return complain(name, "the tables have %zu numbers, and a texture of WebGL2 holds %d", document->count,
                        NUMBERS_MAX);
    if (!output_open(&page, name, option_value(given, "-o")))
        return STATUS_USE;
    return put_file(page.file, document, "explorer.html", "") ? output_commit(&page)
                                                              : output_give_up(&page, "no memory");
}

static int run(const arguments *given)
{
    export_document document = {.as = {.to = language_named("glsl")}, .lobes = 1, .kinds = EXPORT_ALL};
    if (!option_value(given, "-o"))
        return complain(name, "-o PAGE.html is missing");
    int status = write_page(given, &document);
    named_tables_close(&document);
    return status;
}

const subcommand command_explore = {name,
                                    "a page that draws tables, GGX and Beckmann side by side in a browser",
                                    "FILE",
                                    1,
                                    EXPORT_TABLES_MAX,
                                    run,
                                    help};
