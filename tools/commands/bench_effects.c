/* vndf bench effects: what each effect of a BSDF costs, from bare reflection upward, and what it is worth. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "bench/effects/open.h"
#include "cli/output.h"

static const char name[] = "vndf bench effects";

static const char help[] =
    "usage: vndf bench effects [--distribution FILE|ggx|beckmann] ... [options]\n"
    "\n"
    "Times hit and sample, value and density of each set of effects that vndf_bsdf.h has, from bare reflection\n"
    "upward, beside bare reflection written by hand; and measures mean, lost samples, largest weight, variance\n"
    "and efficiency. A second table compares visible with bounded normals by roughness and angle. All take turns\n"
    "in one process, with the same random directions over the hemisphere; results are verified before they\n"
    "count.\n"
    "\n"
    "  --distribution D  a table file, ggx or beckmann, up to 8 times (default: ggx, beckmann and\n"
    "                    student-t:2.5, which is built)\n"
    "  --alpha AX[,AY]   roughness of the first table (default 0.5)\n"
    "  --theta DEG       incident angle of its weights, 0 to 89.9 (default 60)\n"
    "  --only WORD       only sets of effects or distributions with WORD in their name; `variance`: the second\n"
    "                    table\n"
    "  --seconds S       for taking turns, 0.01 to 3600 (default 15); less means more noise\n" ROWS_HELP "\n"
    "exit status 1: what a set of ours returned was wrong, so it was not timed\n"
    "\n"
    "example: vndf bench effects --distribution ggx --only masking\n"
    "         vndf bench effects -o effects.csv\n";

typedef struct effects_words {
    words distribution, alpha, theta, only, seconds;
    figure_words figures;
} effects_words;

/* ---- output ------------------------------------------------------------------------------------ */

static int judge(const effects_list *list)
{
    int status = STATUS_GOOD;
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        if (e->needed && e->row.wrong)
            status = complain(name, "%s of %s: wrong results, not timed", e->subject.set->name, e->distribution);
    }
    return status == STATUS_GOOD ? status : STATUS_NO;
}

/* ---- running ----------------------------------------------------------------------------------- */

static vndf_status measure(effects_list *list, const effects_plan *plan, effects_block *block)
{
    size_t blocks = plan->seconds < 5 ? 8 : 64;
    for (size_t i = 0; i < list->count; i++) {
        effects_entry *e = &list->entry[i];
        if (!e->needed)
            continue;
        if (progress_show((double)i / (double)list->count, "verifying", plan->progress))
            return VNDF_ERROR_ARGUMENT;
        effects_verify(e, block);
        effects_weigh(e, block, blocks);
    }
    return effects_time(list, plan, block);
}

static int run_list(effects_list *list, const effects_plan *plan, const effects_words *given)
{
    effects_block *block = malloc(sizeof *block);
    vndf_status status = block ? measure(list, plan, block) : VNDF_ERROR_MEMORY;
    free(block);
    progress_end(plan->progress);
    if (status != VNDF_OK)
        return complain(name, status == VNDF_ERROR_MEMORY ? "no memory" : "interrupted");
    int printed = rows_print(name, &given->figures, effects_print, list);
    int judged = judge(list);
    return printed == STATUS_GOOD ? judged : printed;
}

static int run_plan(effects_plan *plan, const effects_words *given)
{
    effects_list list;
    effects_opened o = {.count = 0, .built = NULL};
    vndf_error error = {VNDF_OK, ""};
    int status = STATUS_USE;
    if (effects_open(&o, plan, name, &given->distribution)) {
        if (effects_list_make(&list, plan, &error) == VNDF_OK) {
            status = run_list(&list, plan, given);
            effects_list_free(&list);
        } else {
            complain(name, "%s", error.message);
        }
    }
    effects_close(&o);
    return status;
}

static int run_words(const effects_words *given)
{
    vndf_surface alpha;
    effects_plan plan = {.theta = 60, .only = only_word(&given->only), .seconds = 15};
    const char *text = only_word(&given->alpha);
    if (!roughness_from(name, text ? text : "0.5", &alpha) ||
        !option_number(name, "--seconds", &given->seconds, 0.01, 3600, &plan.seconds) ||
        !option_number(name, "--theta", &given->theta, 0, 89.9, &plan.theta))
        return STATUS_USE;
    plan.alpha_x = alpha.alpha_x;
    plan.alpha_y = alpha.alpha_y;
    if (!rows_check(name, &given->figures))
        return STATUS_USE;
    progress p = progress_begin("bench effects", output_hold_signals());
    p.is_seen &= !given->figures.quiet.count;
    plan.progress = &p;
    int status = run_plan(&plan, given);
    output_release_signals(p.held);
    return status;
}

int command_bench_effects(int argc, char **argv)
{
    effects_words given = {0};
    words positional = {{NULL}, 0};
    const option_form options[] = {
        {"--distribution", 1, EFFECTS_DISTRIBUTIONS_MAX, &given.distribution},
        {"--alpha", 1, 1, &given.alpha},
        {"--theta", 1, 1, &given.theta},
        {"--only", 1, 1, &given.only},
        {"--seconds", 1, 1, &given.seconds},
        ROWS_OPTIONS(given.figures),
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "", 0, 0};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    return parsed == PARSE_GO_ON ? run_words(&given) : parsed;
}
