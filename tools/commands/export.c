/* vndf export: the sampler and tables as one file for another language or processor. */
#include <string.h>

#include "cli/output.h"
#include "cli/subject.h"
#include "command.h"
#include "commands/parts/named_tables.h"
#include "measured/measured.h"

static const char name[] = "vndf export";

static const char *const help[] = {
    "usage: vndf export FILE|ggx|beckmann... --language c|cpp|cuda|opencl|glsl|hlsl|wgsl|msl -o OUT [options]\n"
    "       vndf export FILE|ggx|beckmann --rgl -o OUT [options]\n"
    "\n"
    "Writes one file that draws visible normals of these tables, of GGX and of Beckmann without this library: view,\n"
    "sample with density, density of a normal, D, Lambda, G1, G2, projected area; alpha, matrices with mean slopes,\n"
    "mixtures, families (FILE.vndfs) at a textured parameter; directions on either side. It computes in float,\n"
    "without recursion and allocation.\n"
    "\n"
    "  --language c|cpp|cuda|opencl|glsl|hlsl|wgsl|msl  the language of OUT\n"
    "  -o OUT           the file; - for stdout\n"
    "  --buffer RAW     OUT reads the numbers of the tables from a buffer that you bind, or through a pointer; RAW\n"
    "                   gets them, as 4 bytes, little-endian (at run time vndf_numbers writes the same). Without\n"
    "                   it they stand in OUT; refused where there are too many for the language: opencl and msl\n"
    "                   16384, glsl and hlsl 4096, wgsl 2047 (2 KiB make some 950)\n"
    "  --prefix NAME    names begin with NAME_ (default vndf), so that several files can live together\n"
    "  --only view,sample,pdf,visible,ndf,lambda,g1,g2,projected_area,mixture,family,bsdf_sample,bsdf_eval,bsdf_pdf\n"
    "                   only these calls and what they need; the last three are of --bsdf\n"
    "  --lobes N        how many surfaces a mixture holds, 1 to 8 (default 4)\n"
    "  --bsdf reflection|transmission|both  a BSDF that scatters once, to these sides: sample, value and density, in\n"
    "                   the place of the calls above. Of what follows the first is the default\n"
    "    --fresnel none|schlick|dielectric|conductor\n"
    "    --masking correlated|separable|v-cavities|none\n"
    "    --transport radiance|importance\n"
    "    --reflection specular|retro\n"
    "\n"
    "The constant of a table is its file's name: NAME_STUDENT_T_2_5 for student-t-2.5.vndf. tools/export/README.md\n"
    "shows what to call from which host.\n"
    "\n"
    "example: vndf export tables/student-t-2.5-small.vndf --language glsl -o normals.glsl\n"
    "         vndf export tables/hazy.vndf tables/example.vndf --language cuda --buffer tables.f32 -o normals.cuh\n"
    "         vndf export tables/hazy.vndf --bsdf both --fresnel dielectric --language wgsl -o glass.wgsl\n"
    "\n",
    "As reflectances, for hosts that read measured ones: what a surface of this D mirrors once, F by Schlick, masked\n"
    "by Smith with heights correlated. FILE is one table, ggx or beckmann.\n"
    "\n"
    "  --rgl            a .bsdf that Mitsuba 3 (plugin measured) renders as it is; with --wavelengths, its spectral\n"
    "                   variants and pbrt-v4\n"
    "    --alpha A      roughness (default 1, D as the table holds it)\n"
    "    --f0 R[,G,B]   reflectance at normal incidence, 0 to 1 (default 1: all light is reflected)\n"
    "    --wavelengths L,...  nanometres, ascending, up to 16; --f0 then has one number, or one for each\n"
    "\n"
    "example: vndf export tables/student-t-2.5.vndf --rgl --alpha 0.3 --f0 1,0.78,0.34 -o gold.bsdf\n",
    NULL};

/* What makes no sense is what the library says makes none. */
static int read_effects(const arguments *given, export_document *document)
{
    const vndf_effects effects = {.lobes = (vndf_lobes)option_choice(given, "--bsdf", 0),
                                  .fresnel = (vndf_fresnel)option_choice(given, "--fresnel", 0),
                                  .masking = (vndf_masking)option_choice(given, "--masking", 0),
                                  .transport = (vndf_transport)option_choice(given, "--transport", 0),
                                  .reflection = (vndf_reflection)option_choice(given, "--reflection", 0)};
    vndf_description is = {
        .surface = vndf_rough(vndf_ggx(), 1.0f, 1.0f), .effects = effects, .conductor_eta = {1.0f, 1.0f, 1.0f}};
    vndf_material material;
    vndf_error refusal = {VNDF_OK, ""};
    is.eta = 1.5f;
    document->scatters = option_value(given, "--bsdf") != NULL;
    document->effects = effects;
    if (document->scatters && vndf_material_resolve(&is, &material, &refusal) != VNDF_OK)
        return denied(name, "--bsdf: %s", refusal.message);
    return 1;
}

/* What does not fit is refused with the size that does: files have some 2.3 bytes a number. */
static int fits(const export_document *document)
{
    const language *as = document->to;
    for (size_t i = 0; i < document->tables; i++)
        if (document->table[i].family && document->lobes < 2)
            return denied(name, "'%s': a family is a mixture of two tables; --lobes 2", document->table[i].file);
    if (!document->embeds || as->most_embedded == 0 || document->count <= as->most_embedded)
        return 1;
    complain(name,
             "%zu numbers cannot be embedded in %s: %s, %zu; use --buffer FILE, or smaller tables: vndf build "
             "--max-bytes %zu",
             document->count, as->title, as->why, as->most_embedded,
             23 * (as->most_embedded / document->tables) / 10 / 64 * 64);
    return 0;
}

static int write_all(const arguments *given, const export_document *document)
{
    const char *path = option_value(given, "-o"), *raw = option_value(given, "--buffer");
    output_file output[2] = {{.command = NULL}}; /* the text, the numbers */
    if (raw && output_is_stdout(raw))
        return complain(name, "--buffer '-': a file is needed");
    if (raw && !output_is_stdout(path) && files_same(path, raw))
        return complain(name, "--buffer and -o both name '%s'", raw);
    if ((raw && !output_open(&output[1], name, raw)) || !output_open(&output[0], name, path))
        return output_commit_all(output, 2, STATUS_USE);
    const int written = document_write(document, output[0].file, NULL);
    if (raw && written)
        put_floats(output[1].file, document->numbers, document->count);
    return output_commit_all(
        output, 2, written ? STATUS_GOOD : complain(name, "no memory, or no place for a temporary file"));
}

/* Roughness, wavelengths, and F0: one number for all channels, or one for each. */
static int read_form(const arguments *given, rgl_form *form)
{
    const char *wavelengths = option_value(given, "--wavelengths"), *f0 = option_value(given, "--f0");
    double alpha = 1, nanometres[RGL_CHANNELS];
    size_t channels = 3, count = 1;
    if (!option_number(given, "--alpha", 1e-4, 10, &alpha))
        return 0;
    if (wavelengths)
        channels = parse_numbers(name, "--wavelengths", wavelengths, 1, 1e6, 1, RGL_CHANNELS, nanometres);
    for (size_t i = 0; i < channels && wavelengths; i++) {
        form->wavelength[i] = (float)nanometres[i];
        if (i > 0 && !(form->wavelength[i] > form->wavelength[i - 1]))
            return denied(name, "--wavelengths '%s': they must ascend", wavelengths);
    }
    form->alpha = (float)alpha;
    form->channels = (int)channels;
    form->is_spectral = wavelengths != NULL;
    form->f0[0] = 1;
    if (channels > 0 && f0)
        count = parse_numbers(name, "--f0", f0, 0, 1, 1, channels, form->f0);
    if (count > 1 && count < channels)
        return denied(name, "--f0 has %zu numbers; 1 or %zu are needed", count, channels);
    for (size_t i = count; i < channels; i++)
        form->f0[i] = form->f0[0];
    return channels > 0 && count > 0;
}

static int export_rgl(const arguments *given)
{
    rgl_form form = {0};
    chosen_distribution chosen;
    char description[600];
    output_file output;
    if (given->positional.count != 1)
        return complain(name, "%zu distributions are given; --rgl takes one", given->positional.count);
    if (!read_form(given, &form) || !distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    snprintf(description, sizeof description, "vndf %.500s, alpha %g", given->positional.item[0],
             (double)form.alpha);
    form.description = description;
    int status = STATUS_USE;
    if (output_open(&output, name, option_value(given, "-o"))) {
        int written = rgl_write(output.file, chosen.distribution, &form);
        status = written ? output_commit(&output) : output_give_up(&output, "no memory, or no place on the disk");
    }
    distribution_close(&chosen);
    return status;
}

static int export_kernel(const arguments *given, export_document *document)
{
    const char *prefix = option_value(given, "--prefix"), *wanted = option_value(given, "--only");
    char only[2 * LISTED_LENGTH] = "vndf_rough vndf_bsdf_at vndf_bsdf_cosine", *end = only + strlen(only);
    unsigned long long lobes = 4;
    if (!option_value(given, "--language"))
        return complain(name, "--language is missing: c, cpp, cuda, opencl, glsl, hlsl, wgsl or msl");
    document->to = language_named(option_value(given, "--language"));
    if (!given->positional.count)
        return complain(name, "FILE is missing");
    if (!read_effects(given, document) || !option_count(given, "--lobes", 1, 8, &lobes))
        return STATUS_USE;
    if (!document_prefix(document, prefix ? prefix : "vndf"))
        return complain(name,
                        "--prefix '%s': a lower-case letter, then up to %d letters, digits and single '_', none "
                        "last; not gl",
                        prefix, PREFIX_MAX - 1);
    if (wanted && strstr(wanted, "bsdf_") && !document->scatters)
        return complain(name, "--only '%s': a BSDF needs --bsdf", wanted);
    for (const char *call = wanted; call && *call; call += strcspn(call, ","), call += *call == ',')
        end += sprintf(end, " vndf_%.*s", (int)strcspn(call, ","), call);
    document->only = wanted ? only : NULL;
    document->lobes = (long)lobes;
    document->embeds = option_value(given, "--buffer") == NULL;
    if (!named_tables_open(name, &given->positional, 1, document) || !fits(document))
        return STATUS_USE;
    return write_all(given, document);
}

static int run(const arguments *given)
{
    static const char *const of_kernels[] = {"--language", "--buffer", "--prefix", "--lobes",
                                             "--only",     "--bsdf",   NULL};
    const int is_rgl = option_value(given, "--rgl") != NULL;
    const char *wrong = is_rgl ? option_among(given, of_kernels) : NULL;
    export_document document = {0};
    if (wrong)
        return complain(name, "%s is for kernels, not for --rgl", wrong);
    if (!option_value(given, "-o"))
        return complain(name, "-o OUT is missing");
    if (is_rgl)
        return export_rgl(given);
    const int status = export_kernel(given, &document);
    named_tables_close(&document);
    return status;
}

const subcommand command_export = {
    name, "the sampler with your tables in C, CUDA, GLSL and other languages", "FILE", 0, EXPORT_TABLES_MAX, run,
    help};
