/* vndf explore: a page on which tables, GGX and Beckmann are seen side by side, drawn by the exported kernel: one HTML
 * file that draws in WebGL2. Its frame is tools/export/page/explorer.html. */
#include <stdlib.h>
#include <string.h>

#include "bake/bake.h"
#include "cli/files.h"
#include "command.h"
#include "commands/parts/named_tables.h"
#include "draw/png.h"
#include "draw/draw.h"

typedef struct contents {
    export_document document;
    size_t size;  /* of the tables of `vndf bake` for each table, GGX and Beckmann; 0: none are wanted */
    float *baked; /* their numbers, one table after the other; owned */
    size_t baked_count;
} contents;

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
    "  --engines N      also what engines that look light up make of them in one pass, beside samples, with tables\n"
    "                   of `vndf bake` of N x N, 4 to 64; 32 takes some 5 s for each FILE, GGX and Beckmann\n"
    "  -q               no progress\n"
    "\n"
    "Settings stand in the page's address, so that a link keeps them: PAGE.html#alpha=0.2,0.05&theta=70&light=lamp;\n"
    "#frames=64 draws that many samples per pixel before the page is shown and no more, for pictures.\n"
    "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf explore tables/student-t-2.5.vndf tables/hazy.vndf -o normals.html\n",
    NULL};

static void put_choices(FILE *to, const export_document *document)
{
    for (const exported_table *t = document->table; t < document->table + document->tables; t++) {
        const vndf_info info = vndf_distribution_info(t->distribution);
        const char *slash = strrchr(t->file, '/'), *from = slash ? slash + 1 : t->file, *end = strrchr(from, '.');
        char shown[256]; /* without its ending; the name of a file may hold anything */
        snprintf(shown, sizeof shown, "%.*s", end && end > from ? (int)(end - from) : (int)strlen(from), from);
        for (char *at = shown; *at; at++)
            *at = *at >= ' ' && *at < 127 ? *at : '?';
        fprintf(to, "<option value=\"%zu\" data-median=\"%.6g\" data-tv=\"%.2g\">", t->base, info.scale,
                (double)info.certificate.tv_above);
        svg_escape(to, shown);
        fputs("</option>\n", to);
    }
}

/* Little-endian, in lines of base64. */
static void put_numbers(FILE *to, const float *numbers, size_t count)
{
    enum { LINE = 21 };
    unsigned char line[4 * LINE];
    for (size_t i = 0; i < count; i += LINE) {
        const size_t n = count - i < LINE ? count - i : LINE;
        floats_to_bytes(line, numbers + i, n);
        base64_write(to, line, 4 * n);
        fputs("\n", to);
    }
}

/* Escaped, since comments quote the tables' sources. */
static int put_kernel(FILE *to, const export_document *document)
{
    FILE *kernel = tmpfile();
    char line[512];
    int good = kernel && document_write(document, kernel, NULL) && fseek(kernel, 0, SEEK_SET) == 0;
    while (good && fgets(line, sizeof line, kernel))
        svg_escape(to, line);
    good = good && !ferror(kernel);
    if (kernel)
        fclose(kernel);
    return good;
}

/* A file of the page, where `letter` stands for $, and {{part letter}} on a line for another file or for what differs
 * from page to page. 0 if there is no memory. */
static int put_file(FILE *to, const contents *of, const char *file, const char *letter)
{
    const embedded_text *text = page_texts;
    int good = 1;
    if (strcmp(file, "kernel") == 0)
        return put_kernel(to, &of->document);
    if (strcmp(file, "choices") == 0)
        return put_choices(to, &of->document), 1;
    if (strcmp(file, "numbers") == 0)
        return put_numbers(to, of->document.numbers, of->document.count), 1;
    if (strcmp(file, "baked") == 0)
        return put_numbers(to, of->baked, of->baked_count), 1;
    if (strcmp(file, "engines.html") == 0 && !of->size)
        return 1;
    for (; strcmp(file, "shaders") == 0 && text->name; text++)
        if (strstr(text->name, ".glsl")) {
            fprintf(to, "<script type=\"text/plain\" id=\"%s\">\n", text->name);
            put_file(to, of, text->name, "");
            fputs("</script>\n", to);
        }
    while (text->name && strcmp(text->name, file) != 0)
        text++;
    for (const char *const *line = text->name ? text->lines : NULL; line && *line && good; line++) {
        char part[32], its_letter[16] = "";
        if (sscanf(*line, "{{%31[^ }] %15[^}]", part, its_letter) > 0) {
            good = put_file(to, of, part, *its_letter == '$' ? letter : its_letter);
            continue;
        }
        for (const char *at = *line; *at; at++)
            if (*at == '$' && *letter)
                fputs(letter, to);
            else
                fputc(*at, to);
        fputs("\n", to);
    }
    return good;
}

/* Bakes tables of each table, GGX and Beckmann; 0 if there is no memory or a signal waits. */
static int bake_all(const arguments *given, contents *of)
{
    const size_t tables = of->document.tables;
    progress p = progress_begin(name, option_value(given, "-q") != NULL);
    int good = 1;
    for (size_t i = 0; i < tables + 2 && good; i++) {
        const bake_settings s = {.distribution = i < tables    ? of->document.table[i].distribution
                                                 : i == tables ? vndf_ggx()
                                                               : vndf_beckmann(),
                                 .size = of->size,
                                 .progress = &p};
        baked_list list = {.count = 0};
        progress_step(&p, (double)(i + 1) / (double)(tables + 2));
        good = bake_ltc(&s, &list) && bake_dfg(&s, &list) && bake_prefilter(&s, &list);
        for (size_t k = 0; good && k < list.count; k++) {
            const size_t n = baked_size(&list.table[k]);
            float *all = realloc(of->baked, (of->baked_count + n) * sizeof *all);
            good = all != NULL;
            if (good) {
                memcpy(all + of->baked_count, list.table[k].value, n * sizeof *all);
                of->baked = all;
                of->baked_count += n;
            }
        }
        baked_free(&list);
    }
    progress_end(&p);
    return good;
}

/* 0 after a complaint. */
static int open_tables(const arguments *given, contents *of)
{
    unsigned long long size = 0;
    if (!option_value(given, "-o"))
        return denied(name, "-o PAGE.html is missing");
    if (!option_count(given, "--engines", 4, 64, &size) ||
        !named_tables_open(name, &given->positional, 0, &of->document))
        return 0;
    of->size = (size_t)size;
    return of->document.count <= NUMBERS_MAX ||
           denied(name, "the tables have %zu numbers, and a texture of WebGL2 holds %d", of->document.count,
                  NUMBERS_MAX);
}

static int run(const arguments *given)
{
    contents of = {.document = {.to = language_named("glsl"), .lobes = 1}};
    char digits[24];
    output_file page;
    int status = STATUS_USE;
    document_prefix(&of.document, "vndf");
    if (open_tables(given, &of) && output_open(&page, name, option_value(given, "-o"))) {
        snprintf(digits, sizeof digits, "%zu", of.size);
        const int good = (!of.size || bake_all(given, &of)) && put_file(page.file, &of, "explorer.html", digits);
        status =
            good ? output_commit(&page)
                 : output_give_up(&page, output_stopping() ? "interrupted" : "no memory, or no temporary file");
    }
    named_tables_close(&of.document);
    free(of.baked);
    return status;
}

const subcommand command_explore = {
    name, "a page that draws tables, GGX and Beckmann side by side", "FILE", 1, EXPORT_TABLES_MAX, run, help};
