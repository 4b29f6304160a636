/* vndf compare: one scene by several ways of drawing normals, or with tables of several sizes, in equal time and
 * with equal samples. This file reads the words, prepares the ways, and has them rendered, judged and shown;
 * compare/contest.h maps the rest. */
#include <math.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "compare/run.h"

static const char name[] = "vndf compare";

static const char help[] =
    "usage: vndf compare SCENE DIR [options]\n"
    "\n"
    "Renders a scene in several ways against a long reference and writes DIR/index.html: pictures after equal\n"
    "time and with equal samples, crops, error maps, curves of error, efficiency, and whether all show the same;\n"
    "beside it the pictures, points.csv, and as PFM the reference and what each way has after equal time. Prints\n"
    "the figures as tables in Markdown.\n"
    "\n"
    "  --samplers LIST     how normals are drawn, from visible, all, bounded, perfect (default: all of these\n"
    "                      that the scene can have); the first is the measure of the others\n"
    "  --tables LIST       instead: the distributions of the scene as tables of so many bytes, as in\n"
    "                      2048,4096,8192, against the largest of them or one of 32 KiB, and closed forms\n"
    "                      where the scene has no other\n"
    "  --seconds S         to spend in all, roughly (default 120); --spp decides otherwise\n"
    "  --spp N             samples a pixel of each way\n"
    "  --reference-spp N   of the reference (default 4 times as many); it draws visible normals, with --tables\n"
    "                      as the scene says\n"
    "  --reference FILE    a PFM of the same size instead, as DIR/reference.pfm of another run\n"
    "  --width W           pixels across; the height follows\n"
    "  --threads T         threads, 1 to 256 (default: one for each processor)\n"
    "  --seed N            another choice of random numbers (default 0)\n"
    "\n"
    "DIR is made if it is not there. If it is, it has to be empty or to hold a page of this command, which is\n"
    "replaced; pictures of ways that it no longer has stay. Interrupted, or if a file to be replaced was read, the\n"
    "command leaves DIR as it was; DIR/reference.pfm may be read again.\n"
    "\n"
    "example: vndf compare tools/scenes/metal.scene metal-page --seconds 60 --width 320\n"
    "         vndf compare tools/scenes/rings.scene rings-page --tables 2048,8192\n";

typedef struct compare_words {
    words samplers, tables, seconds, spp, reference_spp, reference, width, threads, seed;
} compare_words;

/* ---- words --------------------------------------------------------------------------------------- */

static int read_sampler(const char *word, size_t length, compare_choice *c)
{
    char copy[32];
    snprintf(copy, sizeof copy, "%.*s", length < sizeof copy ? (int)length : (int)sizeof copy - 1, word);
    for (size_t i = SAMPLER_ALL; i <= SAMPLER_PERFECT; i++) {
        if (strcmp(copy, path_sampler_names[i]) != 0)
            continue;
        for (size_t k = 0; k < c->sampler_count; k++)
            if (c->sampler[k] == (path_sampler)i)
                return complain(name, "--samplers: '%s' stands there twice", copy), 0;
        c->sampler[c->sampler_count++] = (path_sampler)i;
        return 1;
    }
    const char *hint = nearest_word(copy, path_sampler_names + 1, SAMPLER_PERFECT);
    complain(name, "--samplers: '%s' is none of visible, all, bounded and perfect%s%s%s", copy,
             hint ? "; did you mean '" : "", hint ? hint : "", hint ? "'?" : "");
    return 0;
}

static int read_samplers(const words *given, compare_choice *c)
{
    static const path_sampler usual[] = {SAMPLER_VISIBLE, SAMPLER_ALL, SAMPLER_BOUNDED, SAMPLER_PERFECT};
    const char *at = only_word(given);
    c->named = at != NULL;
    for (size_t i = 0; i < sizeof usual / sizeof usual[0] && !c->named; i++)
        c->sampler[c->sampler_count++] = usual[i];
    while (at) {
        size_t length = strcspn(at, ",");
        if (!read_sampler(at, length, c))
            return 0;
        at = at[length] ? at + length + 1 : NULL;
    }
    return 1;
}

static int read_tables(const words *given, compare_choice *c)
{
    if (!given->count)
        return 1;
    c->table_count = parse_numbers(name, "--tables", only_word(given), 2048, COMPARE_LARGEST_TABLE, 1,
                                   COMPARE_TABLES_MAX, c->table);
    for (size_t i = 0; i < c->table_count; i++)
        if (c->table[i] != floor(c->table[i]))
            return complain(name, "--tables: %g is no whole number of bytes", c->table[i]), 0;
    for (size_t i = 1; i < c->table_count; i++)
        for (size_t k = 0; k < i; k++)
            if (c->table[i] == c->table[k])
                return complain(name, "--tables: %g stands there twice", c->table[i]), 0;
    return c->table_count > 0;
}

static int read_choice(const compare_words *given, compare_choice *c)
{
    if (given->samplers.count && given->tables.count)
        return complain(name, "--samplers and --tables are two comparisons; give one of them"), 0;
    if (given->reference.count && given->reference_spp.count)
        return complain(name, "--reference has its samples; leave out --reference-spp"), 0;
    c->reference = only_word(&given->reference);
    return read_samplers(&given->samplers, c) && read_tables(&given->tables, c) &&
           option_number(name, "--seconds", &given->seconds, 1, 1e6, &c->seconds) &&
           option_count(name, "--spp", &given->spp, 2, 1e9, &c->spp) &&
           option_count(name, "--reference-spp", &given->reference_spp, 2, 1e9, &c->reference_spp) &&
           option_count(name, "--width", &given->width, 8, IMAGE_SIDE_MAX, &c->width) &&
           option_count(name, "--threads", &given->threads, 1, 256, &c->threads) &&
           option_count(name, "--seed", &given->seed, 0, 0x1p52, &c->seed);
}

/* ---- the command -------------------------------------------------------------------------------- */

/* Words as they were given, for the page; those that do not fit are left out. */
static void join(char *text, size_t size, int argc, char **argv)
{
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < argc && length + strlen(argv[i]) + 2 < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? " " : "", argv[i]);
}

int command_compare(int argc, char **argv)
{
    char arguments[1024];
    compare_words given = {0};
    compare_choice choice = {
        .command = name, .arguments = arguments, .seconds = 120, .threads = film_processors()};
    words positional = {{NULL}, 0};
    const option_form options[] = {
        {"--samplers", 1, 1, &given.samplers},
        {"--tables", 1, 1, &given.tables},
        {"--seconds", 1, 1, &given.seconds},
        {"--spp", 1, 1, &given.spp},
        {"--reference-spp", 1, 1, &given.reference_spp},
        {"--reference", 1, 1, &given.reference},
        {"--width", 1, 1, &given.width},
        {"--threads", 1, 1, &given.threads},
        {"--seed", 1, 1, &given.seed},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "SCENE DIR", 2, 2};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed != PARSE_GO_ON)
        return parsed;
    choice.scene = positional.item[0];
    join(arguments, sizeof arguments, argc, argv);
    if (!read_choice(&given, &choice))
        return STATUS_USE;
    folder_state state = folder_examine(name, positional.item[1]);
    if (state == FOLDER_REFUSED)
        return STATUS_USE;
    return compare_run(&choice, positional.item[1], state);
}
