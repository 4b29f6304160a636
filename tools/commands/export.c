/* vndf export: the sampler and tables as one file for another language or processor. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/files.h"
#include "cli/output.h"
#include "command.h"
#include "commands/parts/export_brdf.h"
#include "commands/parts/named_tables.h"
#include "export/document.h"

static const char name[] = "vndf export";

static const char help[] =
    "usage: vndf export FILE... --language c|cpp|cuda|opencl|glsl|hlsl|wgsl|msl -o OUT [options]\n"
    "       vndf export FILE|ggx|beckmann --rgl -o OUT [options]\n"
    "\n"
    "Writes one file that draws visible normals of these tables, of GGX and of Beckmann without this library: view,\n"
    "sample with density, density of a normal, D, Lambda, G1, G2, projected area; alpha, matrices with mean slopes,\n"
    "mixtures, families (FILE.vndfs) at a textured parameter; directions on either side. It computes in float,\n"
    "without recursion and allocation.\n"
    "\n"
    "  --language NAME  the language of OUT\n"
    "  -o OUT           the file; - for stdout\n"
    "  --buffer RAW     OUT reads the numbers of the tables from a buffer that you bind, or through a pointer; RAW\n"
    "                   gets them, as 4 bytes, little-endian (at run time vndf_numbers writes the same). Without\n"
    "                   it they stand in OUT; refused where there are too many for the language: opencl and msl\n"
    "                   16384, glsl and hlsl 4096, wgsl 2047 (2 KiB make some 950)\n"
    "  --prefix NAME    names begin with NAME_ (default vndf), so that several files can live together\n"
    "  --distribution KIND  only table, ggx or beckmann (repeat for two); a kernel has all three by default\n"
    "  --only CALLS     only these calls and what they need: view,sample,pdf,visible,ndf,lambda,g1,g2,\n"
    "                   projected_area,mixture,family\n"
    "  --bsdf EFFECTS   a BSDF with these effects, its sample, value and density, in the place of the calls above:\n"
    "                   'lobes=reflection|transmission|both fresnel=none|schlick|dielectric|conductor\n"
    "                   masking=correlated|separable|v-cavities|none transport=radiance|importance\n"
    "                   reflection=specular|retro'; the first of each is the default. --only has bsdf_sample,\n"
    "                   bsdf_eval and bsdf_pdf too\n"
    "  --lobes N        how many surfaces a mixture holds, 1 to 8 (default 4)\n"
    "\n"
    "The constant of a table is its file's name: NAME_STUDENT_T_2_5 for student-t-2.5.vndf. tools/export/README.md\n"
    "shows what to call from which host.\n"
    "\n"
    "example: vndf export tables/student-t-2.5-small.vndf --language glsl -o normals.glsl\n"
    "         vndf export tables/hazy.vndf tables/example.vndf --language cuda --buffer tables.f32 -o normals.cuh\n"
    "         vndf export tables/hazy.vndf --bsdf 'lobes=both fresnel=dielectric' --language wgsl -o glass.wgsl\n"
    "\n";

static const char help_end[] = "\n"
                               "exit status: 0 good, 2 wrong use\n";

typedef struct export_words {
    words tables, language, output, buffer, prefix, lobes, only, distribution, bsdf;
} export_words;

/* ---- words --------------------------------------------------------------------------------------- */

static int read_language(const export_words *given, export_document *document)
{
    const char *wanted = only_word(&given->language);
    if (!wanted)
        return complain(name, "--language is missing: c, cpp, cuda, opencl, glsl, hlsl, wgsl or msl"), 0;
    document->as.to = language_named(wanted);
    if (document->as.to && !document->as.to->indents)
        return 1;
    const char *hint = nearest_word(wanted, language_names, LANGUAGES);
    if (hint)
        return complain(name, "--language '%s': there is none; did you mean '%s'?", wanted, hint), 0;
    return complain(name, "--language '%s': c, cpp, cuda, opencl, glsl, hlsl, wgsl and msl are known", wanted), 0;
}

/* A list with commas, cut in `text`. */
static int read_only(const export_words *given, export_document *document, char *text, size_t size)
{
    size_t count = 0, n = 0;
    snprintf(text, size, "%s", given->only.count ? only_word(&given->only) : "");
    for (char *call = strtok(text, ","); call; call = strtok(NULL, ",")) {
        for (n = 0; document_calls[n] && strcmp(document_calls[n], call) != 0; n++)
            ;
        if (!document_calls[n] || count + 1 >= EXPORT_CALLS)
            return complain(
                       name,
                       "--only '%s': view, sample, pdf, visible, ndf, lambda, g1, g2, projected_area, mixture, family, "
                       "bsdf_sample, bsdf_eval and bsdf_pdf are known, each once",
                       call),
                   0;
        if (document_is_of_bsdf(call) && !document->effects.wanted)
            return complain(name, "--only '%s' needs --bsdf", call), 0;
        document->only[count++] = call;
    }
    return 1;
}

static int read_kinds(const export_words *given, export_document *document)
{
    static const char *const kinds[] = {"table", "ggx", "beckmann"};
    document->kinds = given->distribution.count ? 0 : EXPORT_ALL;
    for (size_t i = 0; i < given->distribution.count; i++) {
        unsigned kind = 0;
        while (kind < 3 && strcmp(kinds[kind], given->distribution.item[i]) != 0)
            kind++;
        if (kind == 3)
            return complain(name, "--distribution '%s': table, ggx or beckmann", given->distribution.item[i]), 0;
        document->kinds |= 1u << kind;
    }
    if ((document->kinds & EXPORT_TABLE) && !given->tables.count)
        return complain(name, "FILE is missing"), 0;
    if (!(document->kinds & EXPORT_TABLE) && given->tables.count)
        return complain(name, "'%s' is a table, which --distribution leaves out", given->tables.item[0]), 0;
    return 1;
}

static int read_settings(const export_words *given, export_document *document)
{
    const char *prefix = only_word(&given->prefix), *effects = only_word(&given->bsdf);
    char why[EFFECTS_ERROR_MAX];
    unsigned long long lobes = 4;
    if (!read_language(given, document) || !read_kinds(given, document))
        return 0;
    if (!translation_prefix(&document->as, prefix ? prefix : "vndf"))
        return complain(
                   name,
                   "--prefix '%s': a lower-case letter, then up to %d letters, digits and single '_', none last; "
                   "not gl",
                   prefix, PREFIX_MAX - 1),
               0;
    if (!option_count(name, "--lobes", &given->lobes, 1, 8, &lobes))
        return 0;
    document->lobes = (long)lobes;
    document->embeds = given->buffer.count == 0;
    document->as.by_pointer = !document->embeds && document->as.to->pointer;
    if (effects && !effects_read(&document->effects, effects, why))
        return complain(name, "--bsdf %s", why), 0;
    if (!given->output.count)
        return complain(name, "-o is missing"), 0;
    return 1;
}

/* ---- work ---------------------------------------------------------------------------------------- */

/* What does not fit is refused with the size that does: files have some 2.3 bytes a number. */
static int fits(const export_document *document)
{
    const language *as = document->as.to;
    for (size_t i = 0; i < document->tables; i++)
        if (document->table[i].family && document->lobes < 2)
            return complain(name, "'%s': a family is a mixture of two tables; --lobes 2", document->table[i].file),
                   0;
    if (!document->embeds || as->most_embedded == 0 || document->count <= as->most_embedded)
        return 1;
    return complain(
               name,
               "%zu numbers cannot be embedded in %s: %s, %zu; use --buffer FILE, or smaller tables: vndf build "
               "--max-bytes %zu",
               document->count, as->title, as->why, as->most_embedded,
               23 * (as->most_embedded / document->tables) / 10 / 64 * 64),
           0;
}

/* Little-endian. */
static int write_raw(const export_document *document, FILE *file)
{
    for (size_t i = 0; i < 4 * document->count; i++) {
        unsigned bits;
        memcpy(&bits, &document->numbers[i / 4], sizeof bits);
        if (fputc((int)(bits >> 8 * (i % 4) & 255u), file) == EOF)
            return 0;
    }
    return 1;
}

static int write_all(const export_words *given, const export_document *document)
{
    const char *path = only_word(&given->output), *raw = only_word(&given->buffer);
    output_file text, numbers;
    if (raw && output_is_stdout(raw))
        return complain(name, "--buffer '-': a file is needed");
    if (raw && !output_is_stdout(path) && files_same(path, raw))
        return complain(name, "--buffer and -o both name '%s'", raw);
    if (raw && !output_open(&numbers, name, raw))
        return STATUS_USE;
    int opened = output_open(&text, name, path);
    int written = opened && document_write(document, text.file) && (!raw || write_raw(document, numbers.file));
    if (raw && !written)
        output_discard(&numbers);
    if (!written)
        return opened ? output_give_up(&text, "no memory, or no place on the disk") : STATUS_USE;
    int of_raw = raw ? output_commit(&numbers) : STATUS_GOOD, of_text = output_commit(&text);
    return of_raw != STATUS_GOOD ? of_raw : of_text;
}

static int run(const export_words *given)
{
    export_document document = {0};
    char only[200];
    int status = STATUS_USE;
    if (read_settings(given, &document) && read_only(given, &document, only, sizeof only) &&
        named_tables_open(name, &given->tables, 1, &document) && fits(&document))
        status = write_all(given, &document);
    named_tables_close(&document);
    return status;
}

int command_export(int argc, char **argv)
{
    export_words given = {0};
    brdf_words brdf = {0};
    enum { OF_KERNELS = 7, OF_FILES = 10 }; /* options before these are for one of the two alone */
    const option_form options[] = {
        {"--language", 1, 1, &given.language},
        {"--buffer", 1, 1, &given.buffer},
        {"--prefix", 1, 1, &given.prefix},
        {"--lobes", 1, 1, &given.lobes},
        {"--only", 1, 1, &given.only},
        {"--distribution", 1, 3, &given.distribution},
        {"--bsdf", 1, 1, &given.bsdf},
        {"--alpha", 1, 1, &brdf.alpha},
        {"--f0", 1, 1, &brdf.f0},
        {"--wavelengths", 1, 1, &brdf.wavelengths},
        {"-o", 1, 1, &given.output},
        {"--rgl", 0, 1, &brdf.rgl},
    };
    static char text[sizeof help + sizeof help_end + BRDF_HELP_MAX]; /* `vndf help` reads it later */
    snprintf(text, sizeof text, "%s%s%s", help, brdf_help, help_end);
    const command_form form = {name,   text, options,          sizeof options / sizeof options[0],
                               "FILE", 0,    EXPORT_TABLES_MAX};
    int parsed = parse_arguments(&form, argc, argv, &given.tables), is_brdf = brdf.rgl.count > 0;
    if (parsed != PARSE_GO_ON)
        return parsed;
    for (int i = is_brdf ? 0 : OF_KERNELS; i < (is_brdf ? OF_KERNELS : OF_FILES); i++)
        if (options[i].values->count)
            return complain(name, is_brdf ? "%s is for kernels, not for --rgl" : "%s is for --rgl",
                            options[i].name);
    if (!is_brdf)
        return run(&given);
    brdf.tables = given.tables;
    brdf.output = given.output;
    return export_brdf(name, &brdf);
}
