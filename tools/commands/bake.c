/* vndf bake: tables that engines look up in the place of samples. */
#include <stdlib.h>
#include <string.h>

#include "bake/files.h"
#include "cli/figures.h"
#include "cli/files.h"
#include "cli/output.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "command.h"
#include "draw/svg.h"

static const char name[] = "vndf bake";

static const char *const help[] = {
    "usage: vndf bake FILE|ggx|beckmann [options] DIR\n"
    "\n"
    "Tables for renderers that look up what others sample, of this distribution, in DIR: for each a picture, numbers\n"
    "for numpy (.npy), a texture of half floats (.dds) and arrays for C (.h), GLSL and JavaScript; and index.html,\n"
    "which shows them all with their errors. The same words give the same bytes.\n"
    "\n"
    "  --what LIST      which, between commas (default dfg,energy,ltc,prefilter):\n"
    "                   dfg: scale and bias of the split sum, and E_avg; energy: E and E_avg of a mirror and of\n"
    "                   glass; ltc: linearly transformed cosines for area lights; prefilter: taps for\n"
    "                   environments; anisotropic: such cosines where alpha_x and alpha_y differ, 40 s\n"
    "  --mapping square|linear|sqrt  what alpha is of the roughness in a texture (default square)\n"
    "  --masking correlated|separable  Smith's masking and shadowing together (default correlated)\n"
    "  --size N         of dfg and ltc: N x N, 4 to 256 (default 64)\n"
    "  --shape grid|cycles|ospray  order and places of energy, as a path tracer keeps them (default grid)\n"
    "  --format LIST    of the files: npy,dds,c,glsl,js (default all)\n"
    "\n"
    "DIR is made if it is not there. If it is, it has to be empty or to hold tables of this command, which are\n"
    "replaced. Interrupted, the command leaves DIR as it was.\n"
    "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf bake tables/hazy.vndf --what dfg,ltc haze\n"
    "         vndf bake ggx --what energy --shape cycles --format npy energy\n",
    NULL};

static const char *const kinds[] = {"dfg", "energy", "ltc", "prefilter", "anisotropic", NULL};

/* Which of the candidates a list names, a bit each, and `otherwise` without a list; 0 after a complaint. */
static unsigned listed(const arguments *given, const char *option, const char *const *candidates,
                       unsigned otherwise)
{
    const char *list = option_value(given, option);
    int which[8];
    unsigned bits = 0;
    if (!list)
        return otherwise;
    for (size_t i = words_among(name, option, list, candidates, which); i-- > 0;)
        bits |= 1u << which[i];
    return bits;
}

/* The command as it was typed, for the files. */
static void describe(const arguments *given, char *text, size_t size)
{
    static const char *const options[] = {"--what", "--mapping", "--masking", "--size", "--shape", NULL};
    snprintf(text, size, "%s %s", name, given->positional.item[0]);
    for (int i = 0; options[i]; i++)
        source_text_add(given, options[i], text, size);
}

static int make(const bake_settings *s, unsigned what, const char *shape, baked_list *list)
{
    static const double seconds[] = {2, 16, 17, 0.1, 50};
    double all = 0, end = 0;
    int good = 1;
    for (int k = 0; k < 5; k++)
        all += what >> k & 1 ? seconds[k] : 0;
    for (int k = 0; k < 5 && good; k++) {
        if (!(what >> k & 1))
            continue;
        end += seconds[k] / all;
        progress_step(s->progress, end);
        good = k == 0   ? bake_dfg(s, list)
               : k == 1 ? bake_energy(s, shape, list)
               : k == 2 ? bake_ltc(s, list)
               : k == 3 ? bake_prefilter(s, list)
                        : bake_anisotropic(s, list);
    }
    return good;
}

static int write_page(html_page *page, const baked_list *list, unsigned forms, const char *made_by,
                      const char *subject)
{
    char title[512];
    snprintf(title, sizeof title, "Tables of %s", subject);
    if (!page_begin(page, name, title))
        return 0;
    fputs("<p class=\"lead\">Made by <code>", page->html);
    svg_escape(page->html, made_by);
    fputs("</code></p>\n", page->html);
    for (size_t i = 0; i < list->count; i++) {
        bake_section(page, &list->table[i]);
        for (size_t f = 0; bake_forms[f]; f++)
            if (forms >> f & 1 && !bake_file(page, &list->table[i], f, made_by))
                return 0;
        if (!bake_file(page, &list->table[i], BAKE_PICTURE, made_by))
            return 0;
    }
    return page_end(page);
}

static void print(const arguments *given, const baked_list *list, const char *folder)
{
    figures f = figures_begin(given);
    figures_text(&f, "folder", folder);
    figures_list(&f, "table");
    for (size_t i = 0; i < list->count; i++) {
        const baked *b = &list->table[i];
        figures_record(&f);
        figures_text(&f, "name", b->name);
        figures_number(&f, "numbers", 6, (double)baked_size(b), "");
        if (b->error) {
            figures_number(&f, "largest error", 3, b->worst, "");
            figures_number(&f, "mean error", 3, b->mean, "");
        }
    }
    figures_list_end(&f);
    figures_end(&f);
}

static int bake(const arguments *given, bake_settings *s, unsigned what, unsigned forms)
{
    const char *folder = given->positional.item[1], *shape = option_value(given, "--shape");
    char made_by[1024];
    baked_list list = {.count = 0};
    html_page page = {.count = 0};
    progress p = progress_begin(name, option_value(given, "-q") != NULL);
    s->progress = &p;
    describe(given, made_by, sizeof made_by);
    int status = make(s, what, shape, &list) ? STATUS_GOOD
                 : output_stopping()         ? complain(name, "interrupted; '%s' was not touched", folder)
                                             : complain(name, "no memory, or nothing is reflected");
    progress_end(&p);
    if (status == STATUS_GOOD)
        status = write_page(&page, &list, forms, made_by, input_name(given->positional.item[0]))
                     ? page_write(&page, folder)
                     : complain(name, "no memory for the files");
    page_free(&page);
    if (status == STATUS_GOOD)
        print(given, &list, folder);
    baked_free(&list);
    return status;
}

static int run(const arguments *given)
{
    unsigned long long size = 64;
    chosen_distribution chosen;
    int mapping = option_choice(given, "--mapping", 0), masking = option_choice(given, "--masking", 0);
    unsigned what = listed(given, "--what", kinds, 15), forms = listed(given, "--format", bake_forms, ~0u);
    if (mapping < 0 || masking < 0 || option_choice(given, "--shape", 0) < 0 || !what || !forms ||
        !option_count(given, "--size", 4, 256, &size) ||
        !distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    bake_settings s = {.distribution = chosen.distribution,
                       .mapping = (bake_mapping)mapping,
                       .masking = masking ? VNDF_MASKING_SEPARABLE : VNDF_MASKING_HEIGHT_CORRELATED,
                       .size = (size_t)size};
    const char *folder = given->positional.item[1];
    output_hold_signals();
    page_place place = page_examine(name, folder);
    int status = place == PAGE_REFUSED ? STATUS_USE : bake(given, &s, what, forms);
    if (status != STATUS_GOOD && place == PAGE_NEW)
        remove(folder);
    output_release_signals();
    distribution_close(&chosen);
    return status;
}

const subcommand command_bake = {
    name, "tables for engines: DFG, energy, area lights (LTC), prefilter", "FILE|ggx|beckmann DIR", 2, 2, run,
    help};
