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
    "       vndf bench effects --run SET [--passes N] [--distribution FILE|ggx|beckmann] [--alpha AX[,AY]]\n"
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
    "  --seconds S       for taking turns, 0.01 to 3600 (default 15); less means more noise\n"
    "  --instructions    counts the instructions of hit and sample, by valgrind (some 0.5 s for each set)\n"
    "  --csv FILE        all numbers as CSV (empty: does not apply); - for stdout\n"
    "  --markdown FILE   the tables in Markdown; - for stdout\n"
    "  --run SET         no table: draws 1024 samples of the one set, N times (default 1), for a profiler\n"
    "  --passes N\n"
    "\n"
    "exit status 1: what a set of ours returned was wrong, so it was not timed\n"
    "\n"
    "example: vndf bench effects --distribution ggx --only masking\n"
    "         vndf bench effects --instructions --csv effects.csv\n"
    "         valgrind --tool=callgrind vndf bench effects --run 'both lobes' --distribution ggx\n";

typedef struct effects_words {
    words distribution, alpha, theta, only, seconds, instructions, csv, markdown, run, passes;
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
    char why[256] = "";
    effects_block *block = malloc(sizeof *block);
    vndf_status status = block ? measure(list, plan, block) : VNDF_ERROR_MEMORY;
    free(block);
    if (status == VNDF_OK && given->instructions.count)
        status = effects_count(list, plan, why, sizeof why);
    progress_end(plan->progress);
    if (status != VNDF_OK)
        return complain(name, status == VNDF_ERROR_MEMORY ? "no memory" : "interrupted");
    int printed =
        outputs_print(name, only_word(&given->csv), only_word(&given->markdown), &effects_printers, list);
    int judged = judge(list);
    if (why[0])
        fprintf(stderr, "%s: instructions are not counted: %s\n", name, why);
    return printed == STATUS_GOOD ? judged : printed;
}

static int run_plan(effects_plan *plan, const effects_words *given)
{
    effects_list list;
    effects_opened o = {.count = 0, .built = NULL, .path = ""};
    vndf_error error = {VNDF_OK, ""};
    int status = STATUS_USE;
    if (effects_open(&o, plan, name, &given->distribution, given->instructions.count != 0)) {
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

/* No more than the samples of one set: what a profiler is to see. */
static int run_passes(const effects_plan *plan, const effects_set *set, unsigned long long passes)
{
    const vndf_surface surface = {plan->of[0].distribution, plan->alpha_x, plan->alpha_y};
    effects_subject subject;
    vndf_error error = {VNDF_OK, ""};
    if (set->kind == EFFECTS_BY_CAPS && surface.distribution != vndf_ggx())
        return complain(name, "--run '%s' is of ggx alone", set->name);
    if (effects_subject_make(&subject, set, &surface, &error) != VNDF_OK)
        return complain(name, "%s", error.message);
    effects_block *block = malloc(sizeof *block);
    if (!block)
        return complain(name, "no memory");
    effects_fill(block, &subject, NAN, 1);
    effects_job job = effects_job_of(block, &subject);
    for (unsigned long long i = 0; i < passes; i++)
        subject.loops->each(&job);
    free(block);
    return STATUS_GOOD;
}

static int run_set(effects_plan *plan, const effects_words *given)
{
    unsigned long long passes = 1;
    effects_opened o = {.count = 0, .built = NULL, .path = ""};
    const effects_set *set = effects_find(only_word(&given->run));
    if (!set)
        return complain(name, "--run '%s' is no set of effects; the first column of the table names them",
                        only_word(&given->run));
    if (given->distribution.count > 1)
        return complain(name, "--run takes one --distribution, not %zu", given->distribution.count);
    if (!option_count(name, "--passes", &given->passes, 0, 1e9, &passes))
        return STATUS_USE;
    const char *which = given->distribution.count ? given->distribution.item[0] : "ggx";
    int status = effects_open_one(&o, plan, name, which) ? run_passes(plan, set, passes) : STATUS_USE;
    effects_close(&o);
    return status;
}

static int outputs_usable(const effects_words *given)
{
    const char *csv = only_word(&given->csv);
    return outputs_distinct(name, csv, only_word(&given->markdown)) &&
           (!csv || output_is_earlier(name, csv, "set,distribution,", "tables are named by --distribution"));
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
    if (given->run.count)
        return run_set(&plan, given);
    if (given->passes.count)
        return complain(name, "--passes is for --run");
    if (!outputs_usable(given))
        return STATUS_USE;
    progress p = progress_begin("bench effects", output_hold_signals());
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
        {"--csv", 1, 1, &given.csv},
        {"--markdown", 1, 1, &given.markdown},
        {"--run", 1, 1, &given.run},
        {"--passes", 1, 1, &given.passes},
        {"--instructions", 0, 1, &given.instructions},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "", 0, 0};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    return parsed == PARSE_GO_ON ? run_words(&given) : parsed;
}
