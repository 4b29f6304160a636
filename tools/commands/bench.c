/* vndf bench: what a normal costs and what it is worth, beside everything else a user could pick. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "bench/bench.h"
#include "command.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/source_words.h"

static const char name[] = "vndf bench";

static const char help[] =
    "usage: vndf bench [--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]] [options]\n"
    "       vndf bench effects ...   what each effect of a BSDF costs; `vndf bench effects --help` says more\n"
    "\n"
    "Times view, sample and density of every method, scalar and batch, and measures their error, largest weight\n"
    "and efficiency: closed forms for GGX and Beckmann, published and ours; for the distribution that is named,\n"
    "tables of 2, 4 and 8 KiB with 2, 3 and 4 moments, one of 32 KiB, and the published ways for any D. All take\n"
    "turns in one process, with random directions over the hemisphere and random roughness, data in cache; results\n"
    "are verified before they count.\n"
    "\n"
    "  --family NAME    what the tables are of, as `vndf build` takes it (default student-t:2.5); so are\n"
    "  --ndf EXPR, --slope EXPR, --set NAME=X\n"
    "  --csv FILE       rows of D or P22, as `vndf build` reads them\n"
    "  --seconds S      to spend in all, 0.1 to 3600 (default 40); less means more noise; building the tables\n"
    "                   may take longer\n"
    "  --only WORD      only rows with WORD in the method, distribution or instruction set\n" ROWS_HELP "\n"
    "exit status 1: what a method of ours returned was wrong, so it was not timed\n"
    "\n"
    "example: vndf bench --only avx512\n"
    "         vndf bench --slope 'exp(-3*r)' -o bench.csv --format md\n";

typedef struct bench_words {
    source_words source;
    words seconds, only;
    figure_words figures;
} bench_words;

/* ---- output ------------------------------------------------------------------------------------ */

static int judge(const bench_rows *rows)
{
    int status = STATUS_GOOD;
    for (size_t i = 0; i < rows->count; i++) {
        const bench_row *row = &rows->row[i];
        if (row->wrong)
            complain(name, "%s of %s, %s: wrong results, not timed", row->method, row->distribution,
                     row->instructions);
        if (row->wrong && row->kind != BENCH_PUBLISHED)
            status = STATUS_NO;
    }
    return status;
}

/* ---- running ----------------------------------------------------------------------------------- */

static int run_plan(bench_plan *plan, const bench_words *given, unsigned held)
{
    progress p = progress_begin("bench", held);
    p.is_seen &= !given->figures.quiet.count;
    vndf_error error = {VNDF_OK, ""};
    bench_rows rows;
    plan->progress = progress_show;
    plan->progress_user = &p;
    vndf_status status = bench_run(plan, &rows, &error);
    progress_end(&p);
    if (status != VNDF_OK)
        return complain(name, "%s", error.message);
    int printed = rows_print(name, &given->figures, bench_print, &rows);
    int judged = judge(&rows);
    bench_rows_free(&rows);
    return printed == STATUS_GOOD ? judged : printed;
}

static int run_words(const bench_words *given)
{
    bench_plan plan = {.seconds = 40, .only = only_word(&given->only), .name = "student-t:2.5"};
    vndf_error error = {VNDF_OK, ""};
    if (!option_number(name, "--seconds", &given->seconds, 0.1, 3600, &plan.seconds) ||
        !rows_check(name, &given->figures))
        return STATUS_USE;
    int own = source_words_count(&given->source) != 0;
    vndf_source *source = own ? source_from_words(name, &given->source) : vndf_source_family(plan.name, &error);
    if (!source)
        return own ? STATUS_USE : complain(name, "%s", error.message);
    plan.source = source;
    if (given->source.family.count)
        plan.name = only_word(&given->source.family);
    else if (own)
        plan.name = vndf_source_description(source);
    unsigned held = output_hold_signals();
    int status = run_plan(&plan, given, held);
    vndf_source_free(source);
    output_release_signals(held);
    return status;
}

int command_bench(int argc, char **argv)
{
    if (argc > 0 && strcmp(argv[0], "effects") == 0)
        return command_bench_effects(argc - 1, argv + 1);
    bench_words given = {0};
    words positional = {{NULL}, 0};
    const option_form options[] = {
        {"--ndf", 1, 1, &given.source.ndf},
        {"--slope", 1, 1, &given.source.slope},
        {"--csv", 1, 1, &given.source.csv},
        {"--family", 1, 1, &given.source.family},
        {"--set", 1, WORDS_MAX, &given.source.set},
        {"--seconds", 1, 1, &given.seconds},
        {"--only", 1, 1, &given.only},
        ROWS_OPTIONS(given.figures),
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "", 0, 0};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed == PARSE_GO_ON && source_words_count(&given.source) > 1)
        return complain(name, "more than one of --ndf, --slope, --csv and --family; one at most is needed");
    if (parsed == PARSE_GO_ON)
        parsed = source_words_check_set(name, &given.source);
    return parsed == PARSE_GO_ON ? run_words(&given) : parsed;
}
