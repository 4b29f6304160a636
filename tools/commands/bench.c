/* vndf bench, vndf bench effects: what a normal and what each effect of a BSDF costs and is worth, beside
 * everything else a user could pick. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/progress.h"
#include "cli/figures.h"
#include "cli/output.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "command.h"
#include "evidence/evidence.h"

static const char normals_name[] = "vndf bench", effects_name[] = "vndf bench effects",
                  student[] = "student-t:2.5";

#define ROWS \
  "  -o FILE          all numbers as FILE.csv or FILE.json, or the table as FILE.md; - for stdout, as CSV\n"

static const char *const normals_help[] = {
    "usage: vndf bench [--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]] [options]\n"
    "       vndf bench effects ...   what each effect of a BSDF costs; `vndf bench effects --help` says more\n"
    "\n"
    "Times view, sample and density of every method, scalar and batch, and measures their error, largest weight\n"
    "and efficiency: closed forms of GGX and Beckmann beside what is published; for the distribution that is named,\n"
    "tables of 2, 4 and 8 KiB with 2, 3 and 4 moments, one of 32 KiB, and the published ways for any D; and a table\n"
    "of student-t:2.5 beside it. All take turns in one process, with random directions over the hemisphere and\n"
    "random roughness, data in cache; results are verified before they count.\n"
    "\n"
    "  --family NAME    what the tables are of, as `vndf build` takes it (default student-t:2.5); so are\n"
    "  --ndf EXPR, --slope EXPR, --set NAME=X ...\n"
    "  --csv FILE       rows of D or P22, as `vndf build` reads them\n"
    "  --seconds S      to spend in all, 0.1 to 3600 (default 40); less means more noise; building the tables\n"
    "                   may take longer\n"
    "  --only WORD      only rows with WORD in the method, distribution or instruction set\n" ROWS "\n"
    "exit status 1: what a method of ours returned was wrong, so it was not timed\n"
    "\n"
    "example: vndf bench --only avx512\n"
    "         vndf bench --slope 'exp(-3*r)' -o bench.csv\n",
    NULL};

static const char *const effects_help[] = {
    "usage: vndf bench effects [--distribution FILE|ggx|beckmann] ... [options]\n"
    "\n"
    "Times hit and sample, value and density of each set of effects that vndf_bsdf.h has, from bare reflection\n"
    "upward; and measures mean, lost samples, largest weight, variance and efficiency. All take turns in one\n"
    "process, with the same random directions over the hemisphere; results are verified before they count.\n"
    "\n"
    "  --distribution D ...  a table file, ggx or beckmann, up to 8 times (default: ggx, beckmann and\n"
    "                    student-t:2.5, which is built)\n"
    "  --alpha AX[,AY]   roughness (default 0.5)\n"
    "  --theta DEG       incident angle of its weights, 0 to 89.9 (default 60)\n"
    "  --only WORD       only sets of effects or distributions with WORD in their name\n"
    "  --seconds S       to spend in all, 0.01 to 3600 (default 15); less means more noise\n" ROWS "\n"
    "exit status 1: what a set of ours returned was wrong, so it was not timed\n"
    "\n"
    "example: vndf bench effects --distribution ggx --only masking\n"
    "         vndf bench effects -o effects.csv\n",
    NULL};

/* ---- output -------------------------------------------------------------------------------------- */

static int judge(const char *command, const evidence_rows *found)
{
    int status = STATUS_GOOD;
    for (size_t i = 0; i < found->count; i++) {
        const evidence_row *r = &found->row[i];
        if (!(r->number[COL_WRONG] > 0))
            continue;
        complain(command, "%s of %s, %s: wrong results, not timed", r->method, r->distribution, r->instructions);
        if (r->kind != ROW_PUBLISHED)
            status = STATUS_NO;
    }
    return status;
}

/* For people on stdout unless the file is there, and into the file. */
static int print(const arguments *given, output_file *output, figures_form ending, const evidence_rows *found)
{
    figures_form form = figures_begin(given).form;
    if (!output->path && option_value(given, "-o") && form == FIGURES_TEXT)
        form = FIGURES_CSV;
    if ((form != FIGURES_NONE && !evidence_print(stdout, found, form)) ||
        (output->path && !evidence_print(output->file, found, ending)))
        return output_give_up(output, "no memory for the table");
    const int shown = output_finish_stdout(given->command), saved = output->path ? output_commit(output) : shown;
    return shown == STATUS_GOOD ? saved : shown;
}

static int run_plan(evidence_plan *plan, const arguments *given)
{
    static const char *const endings[] = {"csv", "md", "json", NULL}; /* in the order of forms, after text */
    const char *path = option_value(given, "-o");
    const int ending = path ? output_form(given->command, path, endings) : 0;
    vndf_error error = {VNDF_OK, ""};
    evidence_rows found;
    output_file output;
    if (ending < 0 || !output_open(&output, given->command, path ? path : "-"))
        return STATUS_USE;
    output_hold_signals();
    progress p = progress_begin(given->command, option_value(given, "-q") != NULL);
    plan->progress = &p;
    plan->only = option_value(given, "--only");
    plan->start = clock_seconds();
    vndf_status status = evidence_run(plan, &found, &error);
    progress_end(&p);
    int printed = status != VNDF_OK ? output_give_up(&output, error.message)
                                    : print(given, &output, (figures_form)(FIGURES_CSV + ending), &found);
    int judged = judge(given->command, &found);
    rows_free(&found);
    output_release_signals();
    return printed == STATUS_GOOD ? judged : printed;
}

/* ---- vndf bench effects -------------------------------------------------------------------------- */

/* The named distributions, or both closed forms and a table that is built. Close all of them in any case. */
static int open_all(chosen_distribution *of, evidence_plan *plan, const words *names)
{
    static const words closed_forms = {{"ggx", "beckmann"}, 2};
    const words *all = names->count ? names : &closed_forms;
    vndf_error error = {VNDF_OK, ""};
    for (; plan->count < all->count; plan->count++, of++) {
        if (!distribution_open(of, effects_name, all->item[plan->count], 0))
            return 0;
        plan->of[plan->count].name = all->item[plan->count];
        plan->of[plan->count].distribution = of->distribution;
    }
    if (names->count)
        return 1;
    vndf_source *source = vndf_source_family(student, &error);
    of->owned = source ? vndf_build(source, NULL, NULL, &error) : NULL;
    vndf_source_free(source);
    plan->of[plan->count].name = student;
    plan->of[plan->count++].distribution = of->owned;
    return of->owned || (complain(effects_name, "%s", error.message), 0);
}

static int run_effects(const arguments *given)
{
    const char *alpha = option_value(given, "--alpha");
    const words names = option_values(given, "--distribution");
    vndf_surface surface;
    evidence_plan plan = {.theta = 60, .seconds = 15};
    chosen_distribution of[MATERIALS_MAX] = {{NULL, NULL, NULL}};
    if (names.count > MATERIALS_MAX)
        return complain(effects_name, "--distribution is given more than %d times", MATERIALS_MAX);
    if (!roughness_from(effects_name, alpha ? alpha : "0.5", &surface) ||
        !option_number(given, "--seconds", 0.01, 3600, &plan.seconds) ||
        !option_number(given, "--theta", 0, 89.9, &plan.theta))
        return STATUS_USE;
    plan.alpha_x = surface.alpha_x;
    plan.alpha_y = surface.alpha_y;
    int status = open_all(of, &plan, &names) ? run_plan(&plan, given) : STATUS_USE;
    for (size_t i = 0; i < MATERIALS_MAX; i++)
        distribution_close(&of[i]);
    return status;
}

const subcommand command_bench_effects = {effects_name, "what each effect of a BSDF costs", "", 0, 0, run_effects,
                                          effects_help};

/* ---- vndf bench ---------------------------------------------------------------------------------- */

static int run_normals(const arguments *given)
{
    subject s;
    evidence_plan plan = {.at_hand = &s, .seconds = 40};
    if (!option_number(given, "--seconds", 0.1, 3600, &plan.seconds))
        return STATUS_USE;
    vndf_source *source = source_from_words(given, student);
    if (!source)
        return STATUS_USE;
    subject_begin(&s, source, source_name(source));
    int status = run_plan(&plan, given);
    subject_free(&s);
    return status;
}

const subcommand command_bench = {
    normals_name, "time, error and efficiency of all methods side by side", "", 0, 0, run_normals, normals_help};
