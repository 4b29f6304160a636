#include "export/document.h"

#include <stdlib.h>
#include <string.h>

#include "export/kernel_text.h"
#include "export/words.h"

/* ---- names --------------------------------------------------------------------------------------- */

static const char *file_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* No two underscores in a row, which GLSL and C++ reserve. */
int document_name_table(exported_table *table)
{
    const char *from = file_part(table->file), *end = strrchr(from, '.');
    size_t length = end && end > from ? (size_t)(end - from) : strlen(from), n = 0;
    int gap = 0;
    for (size_t i = 0; i < length && n + 2 < sizeof table->name; i++) {
        char c = from[i];
        int small = c >= 'a' && c <= 'z', good = small || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (good && gap && n > 0)
            table->name[n++] = '_';
        if (good)
            table->name[n++] = small ? (char)(c - 'a' + 'A') : c;
        gap = !good;
    }
    table->name[n] = '\0';
    return n > 0;
}

/* ---- patterns ------------------------------------------------------------------------------------ */

/* A text with the kernel's names, which get their prefix; $NAME and $N are the parameters, $TITLE is the language. */
static void put_pattern(FILE *to, const translation *t, const char *pattern, const char *name, long n)
{
    size_t length;
    for (const char *at = pattern; *at; at += length) {
        word next = word_at(at);
        int marked = at > pattern && at[-1] == '$';
        length = next.kind == WORD_COMMENT ? strlen("//") : next.length;
        if (marked && word_is(&next, "NAME"))
            fputs(name, to);
        else if (marked && word_is(&next, "N"))
            fprintf(to, "%ld", n);
        else if (marked && word_is(&next, "TITLE"))
            fputs(t->to->title, to);
        else if (next.kind == WORD_NAME)
            translate_name(t, to, at, length);
        else if (*at != '$')
            fprintf(to, "%.*s", (int)length, at);
    }
}

/* ---- comments ------------------------------------------------------------------------------------ */

/* Lines of a text, each a comment. */
static void put_comment(FILE *to, const char *text)
{
    while (*text) {
        size_t length = strcspn(text, "\n");
        fprintf(to, length ? "// %.*s\n" : "//\n", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

/* Text of a table file, which may hold anything: a line break would end the comment. */
static void put_printable(FILE *to, const char *text)
{
    for (; *text; text++)
        fputc(*text >= ' ' && *text < 127 && *text != '\\' ? *text : '?', to);
}

static void put_certificate(FILE *to, const export_document *document, const exported_table *table)
{
    const vndf_info info = vndf_distribution_info(table->distribution);
    const vndf_certificate *c = &info.certificate;
    fprintf(to, "// %s%s, %zu numbers: ", document->as.upper, table->name, table->size);
    put_printable(to, info.source);
    fprintf(
        to,
        "\n//   made by %s; total variation from the true visible normals at most %.2g above the horizon, %.2g\n"
        "//   below it; largest true density over the drawn one %.4g; area within %.1g%s\n",
        info.tool, (double)c->tv_above, (double)c->tv, (double)c->max_weight, (double)c->area_error,
        c->quick > 0 ? "; measured quickly" : "");
}

static const char head[] =
    "// Visible normals of any isotropic distribution, in $TITLE: written by vndf " VNDF_VERSION ".\n//\n"
    "// vndf_surface_of or a vndf_surface, then vndf_view_of(surface, wi), then vndf_sample(view, u1, u2): "
    "a normal wm\n"
    "// that faces wi, and its density per steradian. vndf_pdf, vndf_visible and vndf_ndf answer for a given normal,\n"
    "// vndf_lambda, vndf_g1, vndf_g2 and vndf_projected_area for directions; "
    "vndf_mixture is up to VNDF_LOBES surfaces.\n"
    "// Directions are unit and may be below the surface; roughness is alpha, 0.02 to 1 and further with more\n"
    "// rounding. All of it is float: the density of a sample is that of its normal within 1e-5 for 99.9% of\n"
    "// the samples above the horizon, and within 1e-3 for all; down to 130 degrees 3e-5 and 1e-4.\n//\n";

static void put_head(FILE *to, const export_document *document)
{
    put_pattern(to, &document->as, head, "", 0);
    for (size_t i = 0; i < document->tables; i++)
        put_certificate(to, document, &document->table[i]);
    if (document->notice) {
        fputs("//\n", to);
        put_comment(to, document->notice);
    }
    fputs("\n", to);
}

/* ---- constants and numbers ----------------------------------------------------------------------- */

static void put_constant(FILE *to, const translation *t, const char *name, long value)
{
    put_pattern(to, t, t->to->constant, name, value);
}

static void put_constants(FILE *to, const export_document *document)
{
    put_constant(to, &document->as, "GGX", -1);
    put_constant(to, &document->as, "BECKMANN", -2);
    for (size_t i = 0; i < document->tables; i++)
        put_constant(to, &document->as, document->table[i].name, (long)document->table[i].base);
    put_constant(to, &document->as, "LOBES", document->lobes);
    fputs("\n", to);
}

static void put_number(FILE *to, const language *as, float x)
{
    char text[40];
    snprintf(text, sizeof text, "%.9g", (double)x);
    int whole = !strpbrk(text, ".e");
    fprintf(to, "%s%s%s", text, whole ? ".0" : "", as->suffix);
}

static void put_numbers(FILE *to, const export_document *document)
{
    const language *as = document->as.to;
    put_pattern(to, &document->as, as->numbers, "", (long)document->count);
    for (size_t i = 0; i < document->count; i++) {
        fputs(i % 8 ? ", " : i ? ",\n    " : "\n    ", to);
        put_number(to, as, document->numbers[i]);
    }
    fprintf(to, "\n%s\n\n", as->numbers_close);
}

static void put_bound(FILE *to, const translation *t)
{
    put_pattern(to, t, t->to->bound, "", 0);
    fputs("\n", to);
}

/* ---- the kernel ---------------------------------------------------------------------------------- */

static const char vec3_text[] = "struct vndf_vec3 {\n    float x, y, z;\n};\n\n"
                                "vndf_vec3 vndf_vec3_of(float x, float y, float z) {\n"
                                "    return vndf_vec3(x, y, z);\n}\n\n";
static const char limits_text[] = "float vndf_min(float a, float b) {\n    return a < b ? a : b;\n}\n\n"
                                  "float vndf_max(float a, float b) {\n    return a > b ? a : b;\n}\n\n";
static const char clamp_text[] = "float vndf_clamp(float x, float low, float high) {\n"
                                 "    return min(max(x, low), high);\n}\n\n";
static const char fetch_begin[] = "float vndf_fetch(int i) {\n    return ";
static const char fetch_end[] = ";\n}\n\n";

/* Whether a function of the language is one of ours. */
static int has_own(const language *as, const char *function)
{
    const char *own = language_word(as, function, strlen(function));
    return own && strncmp(own, "vndf_", 5) == 0;
}

/* What stands before the kernel, and the kernel, as one text to translate; NULL if there is no memory. */
static char *whole_text(const export_document *document)
{
    const language *as = document->as.to;
    const char *fetched = document->embeds          ? "VNDF_NUMBERS[i]"
                          : document->as.by_pointer ? "numbers[i]"
                                                    : as->fetched;
    const char *parts[] = {as->vec3_is_ours ? vec3_text : "",
                           has_own(as, "min") ? limits_text : "",
                           has_own(as, "clamp") ? clamp_text : "",
                           fetch_begin,
                           fetched,
                           fetch_end};
    size_t size = 1;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        size += strlen(parts[i]);
    for (size_t i = 0; kernel_text[i]; i++)
        size += strlen(kernel_text[i]) + 1;
    char *text = malloc(size), *end = text;
    if (!text)
        return NULL;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        end += sprintf(end, "%s", parts[i]);
    for (size_t i = 0; kernel_text[i]; i++)
        end += sprintf(end, "%s\n", kernel_text[i]);
    return text;
}

int document_write(const export_document *document, FILE *to)
{
    const language *as = document->as.to;
    char *text = whole_text(document);
    if (!text)
        return 0;
    put_head(to, document);
    if (as->guarded)
        put_pattern(to, &document->as, "#ifndef VNDF_KERNEL\n#define VNDF_KERNEL\n\n", "", 0);
    if (*as->begin)
        fprintf(to, "%s\n", as->begin);
    put_constants(to, document);
    if (document->embeds)
        put_numbers(to, document);
    else if (as->buffer == BUFFER_BOUND)
        put_bound(to, &document->as);
    translate(&document->as, to, text);
    if (as->guarded)
        fputs("\n#endif\n", to);
    free(text);
    return 1;
}
