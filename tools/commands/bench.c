/* vndf bench: what a normal and, with --effects, what each effect of a BSDF costs and is worth, beside everything else
 * that a user could pick. */

#include "cli/subject.h"
#include "cli/output.h"
#include "command.h"
#include "evidence/evidence.h"

static const char name[] = "vndf bench";

static const char *const help[] = {
    "usage: vndf bench [--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]] [options]\n"
    "\n"
    "Times view, sample and density of every method, one by one and in batches, and measures their error, largest\n"
    "weight and efficiency: closed forms of GGX and Beckmann beside what is published; for the distribution that is\n"
    "named, the default table, tables of 2, 4 and 8 KiB with 2, 3 and 4 moments, one of 32 KiB, and the published\n"
    "ways for any D. Of GGX, Beckmann and the 8 KiB table also 16 samples of each view, a sheared surface, mixtures\n"
    "of two and of eight lobes. All take turns in one process, with random directions over the hemisphere and random\n"
    "roughness, data in cache; results are verified before they count.\n"
    "\n"
    "  --family NAME    what the tables are of, as `vndf build` takes it (default student-t:2.5); so are\n"
    "  --ndf EXPR, --slope EXPR, --set NAME=X ...\n"
    "  --csv FILE       rows of D or P22, as `vndf build` reads them\n"
    "  --effects        instead, hit and sample, value and density of each set of effects that vndf_bsdf.h has, from\n"
    "                   bare reflection upward (of GGX by hand, too: a loop that knows its area), with GGX,\n"
    "                   Beckmann and the 8 KiB table; and mean, lost samples, largest weight, variance and\n"
    "                   efficiency of weights\n"
    "    --alpha AX[,AY]  roughness of the material (default 0.5)\n"
    "    --theta DEG    incident angle of its weights, 0 to 89.9 (default 60)\n"
    "  --only WORD      only rows with WORD in the method, set of effects or distribution\n"
    "  --seconds S      to spend in all, 0.01 to 3600 (default 40; effects: 15); less means more noise; building the\n"
    "                   tables may take longer\n"
    "  -o FILE          all numbers as FILE.csv or FILE.json, or the table as FILE.md; - for stdout, as CSV\n"
    "\n"
    "exit status 1: what a method of ours returned was wrong, so it was not timed\n"
    "\n"
    "example: vndf bench --only ggx\n"
    "         vndf bench --slope 'exp(-3*r)' -o bench.csv\n"
    "         vndf bench --effects --only masking --theta 80\n",
    NULL};

static int judge(const evidence *found)
{
    int status = STATUS_GOOD;
    for (const evidence_row *r = found->row; r < found->row + found->count; r++)
        if (r->is_shown && r->number[COL_WRONG] > 0) {
            complain(name, "%s of %s: wrong results, not timed", r->m.name, r->of->name);
            status = r->m.kind == ROW_PUBLISHED ? status : STATUS_NO;
        }
    return status;
}

/* For people on stdout unless the file is there, and into the file. */
static int print(const arguments *given, output_file *output, figures_form ending, const evidence *found)
{
    figures_form form = figures_begin(given).form;
    if (!output->path && option_value(given, "-o") && form == FIGURES_TEXT)
        form = FIGURES_CSV;
    if ((form != FIGURES_NONE && !evidence_print(stdout, found, form)) ||
        (output->path && !evidence_print(output->file, found, ending)))
        return output_give_up(output, "no memory for the table");
    const int shown = output_finish_stdout(name), saved = output->path ? output_commit(output) : shown;
    return shown == STATUS_GOOD ? saved : shown;
}

static int run_plan(evidence_plan *plan, const arguments *given)
{
    static const char *const endings[] = {"csv", "md", "json", NULL}; /* in the order of forms, after text */
    const char *path = option_value(given, "-o");
    const int ending = path ? output_form(name, path, endings) : 0;
    vndf_error error = {VNDF_OK, ""};
    output_file output;
    if (ending < 0 || !output_open(&output, name, path ? path : "-"))
        return STATUS_USE;
    output_hold_signals();
    progress p = progress_begin(name, option_value(given, "-q") != NULL);
    plan->progress = &p;
    plan->start = clock_seconds();
    evidence *found = evidence_run(plan, &error);
    progress_end(&p);
    int status = found ? print(given, &output, (figures_form)(FIGURES_CSV + ending), found)
                       : output_give_up(&output, error.message);
    if (found && status == STATUS_GOOD)
        status = judge(found);
    evidence_free(found);
    output_release_signals();
    return status;
}

static int run(const arguments *given)
{
    const char *alpha = option_value(given, "--alpha");
    const int is_of_materials = option_value(given, "--effects") != NULL;
    vndf_surface surface;
    subject s;
    evidence_plan plan = {.at_hand = &s, .is_of_materials = is_of_materials, .theta = 60};
    plan.seconds = is_of_materials ? 15 : 40;
    plan.only = option_value(given, "--only");
    if (!roughness_from(name, alpha ? alpha : "0.5", &surface) ||
        !option_number(given, "--seconds", 0.01, 3600, &plan.seconds) ||
        !option_number(given, "--theta", 0, 89.9, &plan.theta))
        return STATUS_USE;
    plan.alpha_x = surface.xx;
    plan.alpha_y = surface.yy;
    vndf_source *source = source_from_words(given, "student-t:2.5");
    if (!source)
        return STATUS_USE;
    subject_begin(&s, source, source_name(source));
    int status = run_plan(&plan, given);
    subject_free(&s);
    return status;
}

const subcommand command_bench = {
    name, "time, error and efficiency of all methods, or of effects, side by side", "", 0, 0, run, help};
