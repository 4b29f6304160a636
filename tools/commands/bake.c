/* vndf bake: tables that engines look up in the place of samples. */
#include <string.h>

#include "bake/bake.h"
#include "cli/files.h"
#include "command.h"
#include "commands/parts/describe.h"

static const char name[] = "vndf bake";

static const char *const help[] = {
    "usage: vndf bake FILE|ggx|beckmann [options] -o DIR\n"
    "\n"
    "Tables for renderers that look up what others sample, of this distribution, in DIR: for each a picture, numbers\n"
    "for numpy (.npy), a texture of half floats (.dds) and arrays for C (.h), GLSL and JavaScript; and index.html,\n"
    "which shows them all with their errors. The same words give the same bytes.\n"
    "\n"
    "  -o DIR           the folder, made if it is not there; else empty, or with tables of this command: files of the\n"
    "                   same names are replaced, others stay. Interrupted, the command leaves it as it was\n"
    "  --what dfg,energy,ltc,prefilter,anisotropic  only these (default the first four). dfg: scale and bias of\n"
    "                   the split sum, and E_avg; energy: E and E_avg of a mirror and of glass; ltc: linearly\n"
    "                   transformed cosines for area lights; prefilter: taps for environments; anisotropic: such\n"
    "                   cosines where alpha_x and alpha_y differ, which take 40 s\n"
    "  --mapping square|linear|sqrt  what alpha is of the roughness in a texture (default square)\n"
    "  --masking correlated|separable  Smith's masking and shadowing together (default correlated)\n"
    "  --size N         of dfg and ltc: N x N, 4 to 256 (default 64); of anisotropic N^4, at most 8^4\n"
    "  --shape grid|cycles|ospray  order, places and masking of energy, as a path tracer has them (default grid)\n"
    "  --format npy,dds,c,glsl,js  only files of these forms\n"
    "\n"
    "example: vndf bake tables/hazy.vndf --what dfg,ltc -o haze\n"
    "         vndf bake ggx --what energy --shape cycles --format npy -o energy\n",
    NULL};

/* Which words of a list were given, a bit each; without the option those of `otherwise`. */
static unsigned listed(const arguments *given, const char *option, unsigned otherwise)
{
    int which[WORDS_MAX];
    unsigned bits = 0;
    for (size_t i = option_choices(given, option, which); i-- > 0;)
        bits |= 1u << which[i];
    return bits ? bits : otherwise;
}

/* By transformed cosines the light of a square is within a tenth where the mean is that of Beckmann (0.13) or of a haze
 * (0.15), and 26% off for a ring (0.30); GGX, which they were made for, has 0.42 at grazing incidence. */
static const double mean_most = 0.2, worst_most = 0.6;

/* Ends with the verdict: that of D, unless a table is the doubt. */
static figures tell(const arguments *given, const baked_list *list, const char *folder, const vndf_info *of)
{
    char verdict[DESCRIBE_WORTH];
    int good = describe_worth(of, verdict);
    figures f = figures_begin(given);
    figures_text(&f, "folder", folder);
    figures_list(&f, "table");
    for (size_t i = 0; i < list->count; i++) {
        const baked *b = &list->table[i];
        figures_record(&f);
        figures_text(&f, "name", b->name);
        figures_number(&f, "numbers", "%.6g", (double)baked_size(b), "");
        if (b->error) {
            figures_number(&f, "largest error", "%.3g", b->worst, "");
            figures_number(&f, "mean error", "%.3g", b->mean, "");
        }
        if (good && !(b->mean <= mean_most && b->worst <= worst_most))
            good = snprintf(verdict, sizeof verdict,
                            "doubtful: %s is %.2g off in the mean, %.2g at most: draw samples", b->name, b->mean,
                            b->worst) < 0;
    }
    figures_list_end(&f);
    figures_text(&f, "verdict", verdict);
    if (!good)
        complain(name, "%s", verdict);
    return f;
}

static int bake(const arguments *given, bake_settings *s, unsigned what)
{
    static const char *const options[] = {"--what", "--mapping", "--masking", "--size", "--shape", NULL};
    static int (*const parts[])(const bake_settings *, baked_list *) = {bake_dfg, bake_energy, bake_ltc,
                                                                        bake_prefilter, bake_anisotropic};
    const char *folder = option_value(given, "-o");
    char made_by[1024];
    baked_list list = {.count = 0};
    html_page page;
    if (!page_open(&page, name, folder))
        return STATUS_USE;
    progress p = progress_begin(name, option_value(given, "-q") != NULL);
    s->progress = &p;
    snprintf(made_by, sizeof made_by, "%s %s", name, given->positional.item[0]);
    options_text(given, options, made_by, sizeof made_by);
    const char *const alphas[] = {"alpha = roughness^2", "alpha = roughness", "alpha = sqrt(roughness)"};
    const vndf_info info = vndf_distribution_info(s->distribution);
    const size_t length = strlen(made_by);
    snprintf(made_by + length, sizeof made_by - length, "; %s; Smith's masking, %s%s%s", alphas[s->mapping],
             s->masking == VNDF_MASKING_SEPARABLE ? "separable" : "correlated", *info.source ? "; D: " : "",
             info.source);
    int good = 1;
    for (int k = 0; k < 5 && good; k++) {
        progress_step(&p, (k + 1) / 5.0);
        good = !(what >> k & 1) || parts[k](s, &list);
    }
    int status = good                ? STATUS_GOOD
                 : output_stopping() ? complain(name, "interrupted; '%s' was not touched", folder)
                                     : complain(name, "no memory, or nothing is reflected");
    progress_end(&p);
    if (status == STATUS_GOOD &&
        !bake_page(&page, &list, listed(given, "--format", ~0u), made_by, input_name(given->positional.item[0])))
        status = STATUS_USE;
    figures f = tell(given, &list, folder, &info);
    if (status == STATUS_GOOD && f.failed)
        status = complain(name, "no memory for figures");
    status = page_close(&page, status);
    if (status == STATUS_GOOD)
        figures_end(&f);
    figures_free(&f);
    baked_free(&list);
    return status;
}

static int run(const arguments *given)
{
    unsigned long long size = 64;
    chosen_distribution chosen;
    if (!option_value(given, "-o"))
        return complain(name, "-o DIR is missing");
    if (!option_count(given, "--size", 4, 256, &size) ||
        !distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    bake_settings s = {.distribution = chosen.distribution,
                       .mapping = (bake_mapping)option_choice(given, "--mapping", 0),
                       .masking = option_choice(given, "--masking", 0) ? VNDF_MASKING_SEPARABLE
                                                                       : VNDF_MASKING_HEIGHT_CORRELATED,
                       .shape = (bake_shape)option_choice(given, "--shape", BAKE_GRID),
                       .size = (size_t)size};
    int status = bake(given, &s, listed(given, "--what", 15));
    distribution_close(&chosen);
    return status;
}

const subcommand command_bake = {
    name, "tables for engines: DFG, energy, area lights (LTC), prefilter", "FILE|ggx|beckmann", 1, 1, run, help};
