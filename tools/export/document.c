#define _POSIX_C_SOURCE 200809L
#include "export/document.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* ---- tables -------------------------------------------------------------------------------------- */

/* After the file, without two underscores in a row, which GLSL and C++ reserve. */
static void name_table(exported_table *table)
{
    const char *slash = strrchr(table->file, '/'), *from = slash ? slash + 1 : table->file;
    const char *end = strrchr(from, '.');
    size_t length = end && end > from ? (size_t)(end - from) : strlen(from), n = 0;
    int gap = 0;
    for (size_t i = 0; i < length && n + 2 < sizeof table->name; i++) {
        int good = (unsigned char)from[i] < 128 && isalnum((unsigned char)from[i]);
        if (good && gap && n > 0)
            table->name[n++] = '_';
        if (good)
            table->name[n++] = (char)toupper((unsigned char)from[i]);
        gap = !good;
    }
    table->name[n] = '\0';
}

/* Whether the kernel or a table before has a constant of that name. */
static int is_taken(const export_document *document, const char *name)
{
    char constant[80];
    for (size_t i = 0; i < document->tables; i++)
        if (strcmp(document->table[i].name, name) == 0)
            return 1;
    snprintf(constant, sizeof constant, "VNDF_%s", name);
    for (const embedded_text *file = kernel_text; file->name; file++)
        for (const char *const *line = file->lines; *line; line++) {
            const char *at = strstr(*line, constant);
            if (at && !isalnum((unsigned char)at[strlen(constant)]) && at[strlen(constant)] != '_')
                return 1;
        }
    return strcmp(name, "NUMBERS") == 0 || strcmp(name, "KERNEL") == 0;
}

int document_add(export_document *document, const char *file, vndf_distribution *distribution, vndf_family *family)
{
    exported_table *table = &document->table[document->tables];
    size_t count = vndf_family_info(family).count;
    *table =
        (exported_table){distribution, family, file, "", document->count, vndf_numbers(distribution, NULL, 0)};
    table->size += family ? 2 + 2 * count : 0;
    for (size_t i = 0; i < count; i++)
        table->size += vndf_numbers(vndf_family_distribution(family, i), NULL, 0);
    name_table(table);
    int good = *table->name && !is_taken(document, table->name);
    document->tables++;
    document->count += table->size;
    return good;
}

static void fill_family(const exported_table *t, float *numbers)
{
    const vndf_family_facts facts = vndf_family_info(t->family);
    size_t at = t->base + 2 + 2 * facts.count;
    float *head = numbers + t->base;
    head[0] = (float)facts.count;
    head[1] = (float)facts.reciprocal;
    for (size_t i = 0; i < facts.count; i++) {
        const vndf_distribution *d = vndf_family_distribution(t->family, i);
        size_t size = vndf_numbers(d, NULL, 0);
        head[2 + 2 * i] = vndf_family_parameter(t->family, i);
        head[3 + 2 * i] = (float)at;
        vndf_numbers(d, numbers + at, size);
        at += size;
    }
}

int document_fill(export_document *document)
{
    document->numbers = malloc((document->count + 1) * sizeof *document->numbers);
    for (size_t i = 0; document->numbers && i < document->tables; i++) {
        const exported_table *t = &document->table[i];
        if (t->family)
            fill_family(t, document->numbers);
        else
            vndf_numbers(t->distribution, document->numbers + t->base, t->size);
    }
    return document->numbers != NULL;
}

/* ---- comments ------------------------------------------------------------------------------------ */

/* Text of a table file, which may hold anything: a line break would end the comment. */
static void put_printable(FILE *to, const char *text)
{
    for (; *text; text++)
        fputc(*text >= ' ' && *text < 127 && *text != '\\' ? *text : '?', to);
}

static void put_table(FILE *to, const export_document *document, const exported_table *t)
{
    const vndf_info info = vndf_distribution_info(t->distribution);
    const vndf_family_facts facts = vndf_family_info(t->family);
    const vndf_certificate *c = &info.certificate;
    fprintf(to, "// %s%s, %zu numbers: ", document->as.upper, t->name, t->size);
    put_printable(to, t->family ? facts.source : info.source);
    fprintf(to, "\n//   made by %s; ", t->family ? facts.tool : info.tool);
    if (t->family)
        fprintf(to, "%zu tables for parameters from %g to %g, total variation between them at most %.2g\n",
                facts.count, (double)facts.low, (double)facts.high, (double)facts.distance);
    else
        fprintf(to,
                "total variation from the true visible normals at most %.2g above the horizon, %.2g\n"
                "//   below it; largest true density over the drawn one %.4g; area within %.1g\n",
                (double)c->tv_above, (double)c->tv, (double)c->max_weight, (double)c->area_error);
}

static const char head[] =
    "//\n// vndf_surface_of or a vndf_surface, then vndf_view_of(surface, wi), then vndf_sample(view, u1, u2): a\n"
    "// normal wm that faces wi, its density per steradian, and the true density over that. vndf_pdf, vndf_visible\n"
    "// and vndf_ndf answer for a given normal, vndf_lambda, vndf_g1, vndf_g2 and vndf_projected_area for directions.\n"
    "// A vndf_mixture is up to VNDF_LOBES surfaces; vndf_family_at makes one of a family at a parameter. Directions\n"
    "// are unit and may be below the surface; roughness is alpha. All of it is float: the density of a sample is,\n"
    "// to 1e-5, that of a normal within one rounding of it; beside vndf_pdf of that normal it is 1e-4 for 99.99% of\n"
    "// the samples above the horizon and 1e-3 below it, where alpha is at least 0.02.\n//\n";

static const char bsdf_head[] =
    "// vndf_bsdf_of(material, wi), a vndf_material being a surface and its optics, is a hit; vndf_bsdf_sample draws\n"
    "// wo with three uniform numbers, f |cosine|/density of three wavelengths and the density per steradian;\n"
    "// vndf_bsdf_eval is f without the cosine, which is vndf_bsdf_cosine; vndf_bsdf_pdf is the density of a given\n"
    "// wo. Directions with z < 0 are on the other side of the surface.\n";

static void put_all(const translation *t, const char *text)
{
    put_prefixed(t, text, strlen(text));
}

static void put_head(const translation *t, const export_document *document)
{
    FILE *to = t->file;
    fprintf(to, "// Visible normals of any isotropic distribution, in %s: written by vndf %s.\n",
            document->as.to->title, VNDF_VERSION);
    put_all(t, head);
    for (size_t i = 0; i < document->tables; i++)
        put_table(to, document, &document->table[i]);
    if (document->effects.wanted) {
        char effects[200];
        effects_name(&document->effects, effects, sizeof effects);
        fprintf(to, "//\n// BSDF: %s.\n", effects);
        put_all(t, bsdf_head);
    }
    fputs("\n", to);
}

/* ---- the kernel ---------------------------------------------------------------------------------- */

/* Whether the file has all that a mark names: kinds of distributions, normals or a BSDF, effects. */
static int has_parts(const export_document *document, const char *mark)
{
    static const char *const names[] = {"table ", "ggx ", "beckmann ", "normals ", "bsdf "};
    const unsigned is = document->kinds | (document->effects.wanted ? 16u : 8u);
    int has = 1;
    for (unsigned i = 0; *mark != '*'; mark += strcspn(mark, " ") + 1) {
        for (i = 0; i < 5 && strncmp(mark, names[i], strlen(names[i])) != 0; i++)
            ;
        has &= i < 5 ? (int)(is >> i & 1u) : effects_have(&document->effects, mark, strcspn(mark, " "));
    }
    return has;
}

/* A line that ends in a mark is left out where the file has not what that names; so are the lines between a mark that
 * stands alone and the next one, "end". *in: whether lines are written. */
static void put_line(FILE *to, const export_document *document, const char *line, int *in)
{
    static const char only[] = "/* only ";
    int length = (int)strcspn(line, "\n");
    const char *mark = strstr(line, only), *end = strstr(line, "/* end */");
    int has = mark && mark < line + length ? has_parts(document, mark + sizeof only - 1) : -1;
    if (end && end < line + length)
        *in = 1;
    else if (has >= 0 && (int)strspn(line, " ") == (int)(mark - line))
        *in = has;
    else if (*in && has != 0) {
        for (length = has > 0 ? (int)(mark - line) : length; length > 0 && line[length - 1] == ' '; length--)
            ;
        fprintf(to, "%.*s\n", length, line);
    }
}

/* In C, what the translator reads: constants, numbers, kernel, and `more`, which begins at *behind; NULL if there is no
 * memory. */
static char *whole_text(const export_document *document, const char *more, long *behind)
{
    char *whole = NULL;
    size_t size = 0;
    int in = 1;
    FILE *to = open_memstream(&whole, &size);
    if (!to)
        return NULL;
    fprintf(to, "enum { VNDF_GGX = -1, VNDF_BECKMANN = -2, VNDF_LOBES = %ld", document->lobes);
    for (size_t i = 0; i < document->tables; i++)
        fprintf(to, ", VNDF_%s = %zu", document->table[i].name, document->table[i].base);
    fprintf(to, " };\nstatic const float VNDF_NUMBERS[%zu] = {", document->count);
    for (size_t i = 0; document->embeds && i < document->count; i++)
        fprintf(to, "%s%.8e", i % 8 ? ", " : i ? ",\n    " : "", (double)document->numbers[i]);
    fputs("};\n", to);
    for (const embedded_text *file = kernel_text; file->name; file++)
        for (const char *const *line = file->lines; *line; line++)
            put_line(to, document, *line, &in);
    *behind = ftell(to);
    for (const char *line = more; line && *line; line += strcspn(line, "\n") + 1)
        put_line(to, document, line, &in);
    if (fclose(to) == 0)
        return whole;
    free(whole);
    return NULL;
}

const char document_calls[] = "view,sample,pdf,visible,ndf,lambda,g1,g2,projected_area,mixture,family,"
                              "bsdf_sample,bsdf_eval,bsdf_pdf";

/* Marks what is asked for; without --only the calls of normals, or in their place those of a BSDF. */
static void want_all(translation *t, const export_document *document)
{
    const char *calls = document->only ? document->only : document_calls, *before = t->to->indents ? "" : "vndf_";
    char name[80];
    int has_family = 0;
    for (size_t i = 0; i < document->tables; i++)
        has_family |= document->table[i].family != NULL;
    for (int i = 0; i < t->count && t->at[i].begin == 0 && *before; i++)
        t->at[i].wanted = 1; /* constants before the kernel */
    if (document->embeds && document->count)
        translation_want(t, "VNDF_NUMBERS", 12);
    if (*before)
        translation_want(t, "vndf_surface_of", 15);
    for (size_t length; *calls; calls += length + (calls[length] == ',')) {
        length = strcspn(calls, ",");
        const int of_bsdf = strncmp(calls, "bsdf_", 5) == 0, of_family = strncmp(calls, "family", 6) == 0;
        if (!document->only && (of_bsdf != document->effects.wanted || (of_family && !has_family)))
            continue;
        snprintf(name, sizeof name, "%s%.*s", before, (int)length, calls);
        translation_want(t, name, strlen(name));
        if (of_bsdf) {
            translation_want(t, "vndf_bsdf_of", 12);
            translation_want(t, "vndf_bsdf_cosine", 16);
        }
    }
}

int document_write(const export_document *document, FILE *to, const char *more)
{
    translation as = document->as, *t = &as;
    long behind;
    char *whole = whole_text(document, more, &behind);
    const int good = whole && translation_read(t, whole), guarded = t->to->guarded && !more;
    int first = 0;
    t->file = to;
    t->fetched = document->embeds ? "VNDF_NUMBERS[$1]" : t->to->fetched;
    for (int i = t->count - 1; good && more && t->word[t->at[i].begin].text >= whole + behind; i--) {
        translation_want(t, t->word[t->at[i].name].text, (size_t)t->word[t->at[i].name].length);
        first = i;
    }
    if (good && !more) {
        want_all(t, document);
        if (t->to->indents)
            fprintf(to, "# The kernel for Dr.Jit, written by vndf %s.\n", VNDF_VERSION);
        else
            put_head(t, document);
        put_all(t, guarded ? "#ifndef VNDF_KERNEL\n#define VNDF_KERNEL\n\n" : "");
        put_all(t, t->to->begin);
        fputs(*t->to->begin ? "\n" : "", to);
        put_all(t, !document->embeds && t->to->bound && document->count ? t->to->bound : "");
    }
    if (good)
        translate(t, first);
    fputs(good && guarded ? "#endif\n" : "", to);
    free(t->word);
    free(whole);
    return good;
}
