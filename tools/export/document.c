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
        "//   below it; largest true density over the drawn one %.4g; area within %.1g\n",
        info.tool, (double)c->tv_above, (double)c->tv, (double)c->max_weight, (double)c->area_error);
}

static const char head[] =
    "//\n// vndf_surface_of or a vndf_surface, then vndf_view_of(surface, wi), then vndf_sample(view, u1, u2): "
    "a normal wm\n"
    "// that faces wi, and its density per steradian. vndf_pdf, vndf_visible and vndf_ndf answer for a given normal,\n"
    "// vndf_lambda, vndf_g1, vndf_g2 and vndf_projected_area for directions; "
    "vndf_mixture is up to VNDF_LOBES surfaces.\n"
    "// Directions are unit and may be below the surface; roughness is alpha. "
    "All of it is float: the density of a sample\n"
    "// is, to 1e-5, that of a normal within one rounding of it; "
    "beside vndf_pdf of that normal it is 1e-4 for 99.99% of\n"
    "// the samples above the horizon and 1e-3 below it, where alpha is at least 0.02.\n//\n";

static const char bsdf_head[] =
    "// vndf_bsdf_of(material, wi), a vndf_material being a surface and its optics, is a hit; vndf_bsdf_sample draws\n"
    "// wo with three uniform numbers, f |cosine|/density of three wavelengths and the density per steradian;\n"
    "// vndf_bsdf_eval is f without the cosine, which is vndf_bsdf_cosine; vndf_bsdf_pdf is the density of a given\n"
    "// wo. Directions with z < 0 are on the other side of the surface.\n";

static void put_head(FILE *to, const export_document *document)
{
    fprintf(to, "// Visible normals of any isotropic distribution, in %s: written by vndf %s.\n",
            document->as.to->title, VNDF_VERSION);
    translate_pattern(&document->as, to, head, "", 0);
    for (size_t i = 0; i < document->tables; i++)
        put_certificate(to, document, &document->table[i]);
    if (document->effects.wanted) {
        char effects[200];
        effects_name(&document->effects, effects, sizeof effects);
        fprintf(to, "//\n// BSDF: %s.\n", effects);
        translate_pattern(&document->as, to, bsdf_head, "", 0);
    }
    if (document->notice) {
        fputs("//\n", to);
        put_comment(to, document->notice);
    }
    fputs("\n", to);
}

/* ---- constants and numbers ----------------------------------------------------------------------- */

static void put_constant(FILE *to, const translation *t, const char *name, long value)
{
    char whole[80];
    snprintf(whole, sizeof whole, "VNDF_%s", name);
    translate_pattern(t, to, t->to->constant, whole, value);
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

static void put_number(FILE *to, float x)
{
    char text[40];
    snprintf(text, sizeof text, "%.9g", (double)x);
    int whole = !strpbrk(text, ".e");
    fprintf(to, "%s%s", text, whole ? ".0f" : "f");
}

static void put_numbers(FILE *to, const export_document *document)
{
    const language *as = document->as.to;
    translate_pattern(&document->as, to, as->numbers ? as->numbers : as->array, "VNDF_NUMBERS",
                      (long)document->count);
    for (size_t i = 0; i < document->count; i++) {
        fputs(i % 8 ? ", " : i ? ",\n    " : "\n    ", to);
        put_number(to, document->numbers[i]);
    }
    fprintf(to, "\n%s\n\n", as->array_close);
}

/* ---- the kernel ---------------------------------------------------------------------------------- */

static const char vec3_struct[] = "typedef struct vndf_vec3 {\n    float x, y, z;\n} vndf_vec3;\n\n";
static const char vec3_plain[] = "struct vndf_vec3 {\n    float x, y, z;\n};\n\n";
static const char vec3_made[] = "vndf_vec3 vndf_vec3_of(float x, float y, float z) {\n"
                                "    vndf_vec3 v = {x, y, z};\n    return v;\n}\n\n";

static void put_vec3(FILE *to, const translation *t)
{
    translate_pattern(t, to, t->to->structs == STRUCT_TYPEDEF ? vec3_struct : vec3_plain, "", 0);
    fputs(t->to->function, to);
    translate_pattern(t, to, vec3_made, "", 0);
}

/* Whether the file has a kind of distribution or an effect. */
static int has_part(const export_document *document, const char *name, size_t length)
{
    static const char *const kinds[] = {"table", "ggx", "beckmann"};
    for (unsigned i = 0; i < 3; i++)
        if (strlen(kinds[i]) == length && memcmp(name, kinds[i], length) == 0)
            return (document->kinds >> i & 1u) != 0;
    return effects_have(&document->effects, name, length);
}

/* Whether a line begins or ends a part that not all files have, and whether this one has it: all words of its mark. */
static int is_mark(const export_document *document, const char *line, int *in)
{
    static const char only[] = "/* only ";
    const char *text = line + strspn(line, " ");
    if (strcmp(text, "/* C only */") == 0)
        return *in = 0, 1;
    if (strcmp(text, "/* end */") == 0)
        return *in = 1;
    if (strncmp(text, only, sizeof only - 1) != 0)
        return 0;
    *in = 1;
    for (text += sizeof only - 1; *text != '*'; text += strcspn(text, " ") + 1)
        *in &= has_part(document, text, strcspn(text, " "));
    return 1;
}

/* NULL if there is no memory. */
static char *whole_text(const export_document *document)
{
    size_t size = 1;
    for (const embedded_text *file = kernel_text; file->name; file++)
        for (size_t i = 0; file->lines[i]; i++)
            size += strlen(file->lines[i]) + 1;
    char *text = malloc(size), *end = text;
    int in = 1;
    for (const embedded_text *file = kernel_text; text && file->name; file++)
        for (size_t i = 0; file->lines[i]; i++)
            if (!is_mark(document, file->lines[i], &in) && in)
                end += sprintf(end, "%s\n", file->lines[i]);
    if (text)
        *end = '\0';
    return text;
}

const char *const *document_calls(void)
{
    static const char *const calls[EXPORT_CALLS] = {
        "view", "sample", "sample_weight",  "pdf",     "visible",     "ndf",       "lambda",
        "g1",   "g2",     "projected_area", "mixture", "bsdf_sample", "bsdf_eval", "bsdf_pdf"};
    return calls;
}

int document_is_of_bsdf(const char *call)
{
    return strncmp(call, "bsdf_", 5) == 0;
}

static void want(const translation *t, part_list *parts, const char *call)
{
    static const char *const mixtures[] = {"view_of", "pdf", "visible", "sample", "ndf"};
    char name[40];
    for (size_t i = 0; i < sizeof mixtures / sizeof mixtures[0] && strcmp(call, "mixture") == 0; i++) {
        snprintf(name, sizeof name, "vndf_mixture_%s", mixtures[i]);
        translation_want(t, parts, name);
    }
    for (size_t i = 0; i < 2 && document_is_of_bsdf(call); i++)
        translation_want(t, parts, i ? "vndf_bsdf_cosine" : "vndf_bsdf_of");
    snprintf(name, sizeof name, strcmp(call, "view") == 0 ? "vndf_%s_of" : "vndf_%s", call);
    translation_want(t, parts, name);
}

/* Python, whose arrays stand for many hits, has the kernel's functions without the face. */
static int put_kernel(FILE *to, const export_document *document, const translation *t)
{
    static const char *const outer[] = {"vndf_surface_of", NULL};
    static const char *const inner[] = {"frame_of",         "frame_sampled",
                                        "frame_normal",     "frame_density",
                                        "frame_reach",      "ggx_see",
                                        "ggx_draw",         "ggx_density",
                                        "ggx_area",         "ggx_p22",
                                        "beckmann_see",     "beckmann_draw",
                                        "beckmann_density", "beckmann_area",
                                        "beckmann_p22",     "table_view_of",
                                        "table_draw",       "table_pdf",
                                        "table_given",      "table_p22",
                                        "law_area",         NULL};
    char *text = whole_text(document);
    part_list *parts = malloc(sizeof *parts);
    if (text && parts) {
        parts_read(parts, text);
        for (const char *const *name = t->to->indents ? inner : outer; *name; name++)
            translation_want(t, parts, *name);
        for (const char *const *call = document->only[0] ? document->only : document_calls();
             !t->to->indents && *call; call++)
            if (document->only[0] || document_is_of_bsdf(*call) == document->effects.wanted)
                want(t, parts, *call);
        translate(t, to, parts);
    }
    int good = text && parts;
    free(parts);
    free(text);
    return good;
}

int document_write(const export_document *document, FILE *to)
{
    translation as = document->as;
    as.fetched = document->embeds ? "VNDF_NUMBERS[$1]" : as.to->fetched;
    if (as.to->indents) {
        fprintf(to, "# The kernel for Dr.Jit, written by vndf %s.\n%s\n\n", VNDF_VERSION, as.to->begin);
        return put_kernel(to, document, &as);
    }
    put_head(to, document);
    if (as.to->guarded)
        translate_pattern(&as, to, "#ifndef VNDF_KERNEL\n#define VNDF_KERNEL\n\n", "", 0);
    translate_pattern(&as, to, as.to->begin, "", 0);
    fputs(*as.to->begin ? "\n" : "", to);
    put_constants(to, document);
    if (as.to->vec3_is_ours)
        put_vec3(to, &as);
    if (document->embeds && document->count)
        put_numbers(to, document);
    else if (as.to->buffer == BUFFER_BOUND && document->count) {
        translate_pattern(&as, to, as.to->bound, "", 0);
        fputs("\n", to);
    }
    int good = put_kernel(to, document, &as);
    if (as.to->guarded)
        fputs("#endif\n", to);
    return good;
}
