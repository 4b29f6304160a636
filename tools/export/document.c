#include "export/export.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"

int document_prefix(export_document *document, const char *name)
{
    const size_t n = strlen(name);
    if (n == 0 || n > PREFIX_MAX || strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_") < n || name[0] == '_' ||
        isdigit((unsigned char)name[0]) || name[n - 1] == '_' || strstr(name, "__"))
        return 0;
    snprintf(document->lower, sizeof document->lower, "%s_", name);
    for (size_t i = 0; i <= n + 1; i++)
        document->upper[i] = (char)toupper((unsigned char)document->lower[i]);
    return strncmp(document->lower, "gl_", 3) != 0;
}

/* ---- tables -------------------------------------------------------------------------------------- */

/* After the file, without two underscores in a row, which GLSL and C++ reserve. */
static void name_table(exported_table *table)
{
    const char *slash = strrchr(table->file, '/'), *from = slash ? slash + 1 : table->file;
    const char *end = strrchr(from, '.');
    size_t length = end && end > from ? (size_t)(end - from) : strlen(from), n = 0;
    for (size_t i = 0; i < length && n + 2 < sizeof table->name; i++) {
        if ((unsigned char)from[i] < 128 && isalnum((unsigned char)from[i]))
            table->name[n++] = (char)toupper((unsigned char)from[i]);
        else if (n > 0 && table->name[n - 1] != '_')
            table->name[n++] = '_';
    }
    table->name[n - (n > 0 && table->name[n - 1] == '_')] = '\0';
}

/* Whether the kernel, or a table before, has a constant of that name. */
static int is_taken(const export_document *document, const char *name)
{
    static const char taken[] =
        " GGX BECKMANN LOBES NUMBERS KERNEL FETCH FUNCTION ARRAY HEAD KNOT LAW SHARES TAIL AREA GROUPS STRIDE "
        "RHO_PARTS RHO_FIRST ";
    char spaced[80];
    for (size_t i = 0; i < document->tables; i++)
        if (strcmp(document->table[i].name, name) == 0)
            return 1;
    snprintf(spaced, sizeof spaced, " %s ", name);
    return strstr(taken, spaced) != NULL;
}

/* Room for more numbers, which begin at the old count; 0 if there is no memory. */
static int add_numbers(export_document *document, size_t more)
{
    float *numbers = realloc(document->numbers, (document->count + more + 4) * sizeof *numbers);
    if (!numbers)
        return 0;
    document->numbers = numbers;
    for (size_t end = document->count + more; document->count < end || document->count % 4;)
        numbers[document->count++] = 0; /* rows of four are read at once */
    return 1;
}

static int add_distribution(export_document *document, const vndf_distribution *d)
{
    const size_t at = document->count, size = vndf_numbers(d, NULL, 0);
    return add_numbers(document, size) && vndf_numbers(d, document->numbers + at, size) == size;
}

static int add_family(export_document *document, const vndf_family *family)
{
    const vndf_family_facts facts = vndf_family_info(family);
    const size_t base = document->count;
    int good = add_numbers(document, 2 + 2 * facts.count);
    for (size_t i = 0; i < facts.count && good; i++) {
        float *own = document->numbers + base;
        own[0] = (float)facts.count;
        own[1] = (float)facts.reciprocal;
        own[2 + 2 * i] = vndf_family_parameter(family, i);
        own[3 + 2 * i] = (float)document->count;
        good = add_distribution(document, vndf_family_distribution(family, i));
    }
    return good;
}

int document_add(export_document *document, const char *file, vndf_distribution *distribution, vndf_family *family)
{
    exported_table *table = &document->table[document->tables];
    *table = (exported_table){distribution, family, file, "", document->count, 0};
    name_table(table);
    const int named = *table->name && !is_taken(document, table->name);
    document->tables++;
    if (!(family ? add_family(document, family) : add_distribution(document, distribution)))
        return -1;
    table->size = document->count - table->base;
    return named;
}

/* ---- effects ------------------------------------------------------------------------------------- */

/* The effects as constants, for the ifs of kernel/event.h and hits.h; and what a material has for them. */
static void put_effects(FILE *to, const vndf_effects *is)
{
    const int transmits = is->lobes != VNDF_LOBES_REFLECTION, reflects = is->lobes != VNDF_LOBES_TRANSMISSION;
    const int is_indexed = transmits || is->fresnel == VNDF_FRESNEL_DIELECTRIC;
    fprintf(to, "enum { reflects_of = %d, transmits_of = %d, fresnel_of = %d, masking_of = %d, ", reflects,
            transmits, (int)is->fresnel, (int)is->masking);
    fprintf(to, "carries_radiance = %d, is_retro = %d, is_indexed = %d, is_alike = %d, ",
            transmits && is->transport == VNDF_TRANSPORT_RADIANCE, is->reflection == VNDF_REFLECTION_RETRO,
            is_indexed, is->fresnel == VNDF_FRESNEL_NONE || is->fresnel == VNDF_FRESNEL_DIELECTRIC);
    fprintf(to, "VNDF_FRESNEL_SCHLICK = %d, VNDF_FRESNEL_DIELECTRIC = %d, VNDF_FRESNEL_CONDUCTOR = %d, ",
            VNDF_FRESNEL_SCHLICK, VNDF_FRESNEL_DIELECTRIC, VNDF_FRESNEL_CONDUCTOR);
    fprintf(to, "VNDF_MASKING_SEPARABLE = %d, VNDF_MASKING_V_CAVITIES = %d, VNDF_MASKING_NONE = %d };\n",
            VNDF_MASKING_SEPARABLE, VNDF_MASKING_V_CAVITIES, VNDF_MASKING_NONE);
}

static void put_material(FILE *to, const vndf_effects *is)
{
    fputs("\n/* A surface and its optics; indices are those beyond over that on the side of z. */\n"
          "typedef struct vndf_material {\n    vndf_surface surface;\n",
          to);
    if (is->lobes != VNDF_LOBES_REFLECTION || is->fresnel == VNDF_FRESNEL_DIELECTRIC)
        fputs("    float eta;\n", to);
    if (is->fresnel == VNDF_FRESNEL_SCHLICK)
        fputs("    vec3 f0; /* reflectance at normal incidence */\n", to);
    if (is->fresnel == VNDF_FRESNEL_CONDUCTOR)
        fputs("    vec3 conductor_eta, conductor_k; /* real and imaginary part */\n", to);
    fputs("} vndf_material;\n", to);
}

/* ---- comments ------------------------------------------------------------------------------------ */

static void put_table(FILE *to, const export_document *document, const exported_table *t)
{
    const vndf_info info = vndf_distribution_info(t->distribution);
    const vndf_family_facts facts = vndf_family_info(t->family);
    fprintf(to, "// %s%s, %zu numbers, ", document->upper, t->name, t->size);
    if (t->family)
        fprintf(to, "for parameters from %g to %g", (double)facts.low, (double)facts.high);
    else
        fprintf(to, "total variation above the horizon %.2g", (double)info.certificate.tv_above);
    fprintf(to, ", made by %s: ", t->family ? facts.tool : info.tool);
    /* text of a file, which may hold anything: a line break would end the comment */
    for (const char *text = t->family ? facts.source : info.source; *text; text++)
        fputc(*text >= ' ' && *text < 127 && *text != '\\' ? *text : '?', to);
    fputs("\n", to);
}

static const char head[] =
    "//\n// vndf_rough or a vndf_surface, then vndf_view_from(surface, wi), then vndf_sample(view, u1, u2): a\n"
    "// normal wm that faces wi, its density per steradian, and the true density over that. vndf_pdf, vndf_visible\n"
    "// and vndf_ndf are of a given normal, vndf_lambda, vndf_g1, vndf_g2 and vndf_projected_area of directions.\n"
    "// vndf_bounded_sample draws visible normals that reflect wi to above the horizon, vndf_bounded_pdf has their\n"
    "// density. A vndf_mixture is up to VNDF_LOBES surfaces; vndf_family_at makes one of a family at a parameter.\n"
    "// Directions are unit and may be below the surface; roughness is alpha. vndf_pdf of a sample is its density\n"
    "// within 1e-4 for 99.99% of samples above the horizon and 1e-3 below it, where alpha is at least 0.02.\n//\n";

static const char bsdf_head[] =
    "// vndf_bsdf_at(material, wi), a vndf_material being a surface and its optics, is a hit; vndf_bsdf_sample draws\n"
    "// wo with three uniform numbers, f |cosine|/density of three wavelengths and the density per steradian;\n"
    "// vndf_bsdf_eval is f without the cosine, which is vndf_bsdf_cosine; vndf_bsdf_pdf is the density of a given\n"
    "// wo. Directions with z < 0 are on the other side of the surface.\n";

static void put_all(const export_document *document, FILE *to, const char *text)
{
    put_prefixed(document, to, text, strlen(text));
}

static void put_head(const export_document *document, FILE *to)
{
    static const char *const lobes[] = {"reflection", "transmission", "both"},
                             *const fresnel[] = {"none", "schlick", "dielectric", "conductor"},
                             *const masking[] = {"correlated", "separable", "v-cavities", "none"},
                             *const transport[] = {"radiance", "importance"},
                             *const reflection[] = {"specular", "retro"};
    const vndf_effects *is = &document->effects;
    fprintf(to, "// Visible normals of any isotropic distribution, in %s: written by vndf %s.\n",
            document->to->title, VNDF_VERSION);
    put_all(document, to, head);
    for (size_t i = 0; i < document->tables; i++)
        put_table(to, document, &document->table[i]);
    if (document->scatters) {
        fprintf(to, "//\n// BSDF: lobes=%s fresnel=%s masking=%s transport=%s reflection=%s.\n", lobes[is->lobes],
                fresnel[is->fresnel], masking[is->masking], transport[is->transport], reflection[is->reflection]);
        put_all(document, to, bsdf_head);
    }
    fputs("\n", to);
}

/* ---- the kernel ---------------------------------------------------------------------------------- */

/* In C, what the translator reads: constants, numbers, kernel, and `more`; NULL if there is no memory. By a temporary
 * file: open_memstream loses a part of its text without a word where memory ends. */
static char *whole_text(const export_document *document, const char *more)
{
    char *whole = NULL;
    size_t size;
    FILE *to = tmpfile();
    if (!to)
        return NULL;
    fprintf(to, "enum { VNDF_GGX = -1, VNDF_BECKMANN = -2, VNDF_LOBES = %ld", document->lobes);
    for (size_t i = 0; i < document->tables; i++)
        fprintf(to, ", VNDF_%s = %zu", document->table[i].name, document->table[i].base);
    fputs(" };\n", to);
    if (document->embeds)
        fprintf(to, "static const float VNDF_NUMBERS[%zu] = {", document->count);
    for (size_t i = 0; document->embeds && i < document->count; i++)
        fprintf(to, "%.8e%s", (double)document->numbers[i],
                i + 1 == document->count ? "};\n"
                : i % 8 == 7             ? ",\n    "
                                         : ", ");
    fputs("enum { sides_apart = 0 };\n", to);
    if (document->scatters)
        put_effects(to, &document->effects);
    for (const embedded_text *file = kernel_text; file->name; file++) {
        if (strcmp(file->name, "hits.h") == 0 && !document->scatters)
            break; /* it is the first of those of BSDFs */
        if (strcmp(file->name, "hits.h") == 0)
            put_material(to, &document->effects);
        for (const char *const *line = file->lines; *line; line++)
            if (**line != '#') /* directives are left out */
                fprintf(to, "%s\n", *line);
    }
    fputs(more ? more : "", to);
    if (fseek(to, 0, SEEK_SET) == 0 && !ferror(to))
        whole = (char *)vndf_read_all(to, SIZE_MAX / 2, &size);
    fclose(to);
    return whole;
}

int document_write(const export_document *document, FILE *to, const char *more)
{
    const language *in = document->to;
    const int guarded = !(in->is & LANGUAGE_APART);
    const char *calls = document->scatters ? "vndf_rough vndf_bsdf"
                                           : "vndf_rough vndf_view vndf_sample vndf_pdf vndf_visible vndf_ndf "
                                             "vndf_bounded_sample vndf_bounded_pdf vndf_lambda vndf_g1 vndf_g2 "
                                             "vndf_projected_area vndf_area vndf_mixture";
    char *whole = whole_text(document, more), all[300];
    int has_family = 0;
    for (size_t i = 0; i < document->tables; i++)
        has_family |= document->table[i].family != NULL;
    snprintf(all, sizeof all, "%s%s", calls, has_family && !document->scatters ? " vndf_family_at" : "");
    if (in->is & LANGUAGE_INDENTS)
        fprintf(to, "# The kernel for Dr.Jit, written by vndf %s.\n", VNDF_VERSION);
    else
        put_head(document, to);
    put_all(document, to, guarded ? "#ifndef VNDF_KERNEL\n#define VNDF_KERNEL\n\n" : "");
    put_all(document, to, in->begin);
    fputs(*in->begin ? "\n" : "", to);
    put_all(document, to, !document->embeds && in->bound ? in->bound : "");
    const int good = whole && translate(document, whole, document->only ? document->only : all, to);
    fputs(guarded ? "#endif\n" : "", to);
    free(whole);
    return good;
}
