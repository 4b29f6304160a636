/* vndf report: one page about what accuracy costs, with the user's own D if there is one. This file reads the
 * words, measures one thing after the other, and has the page written; report.h maps the rest. */
#include "report/report.h"

#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "draw/chart.h"
#include "command.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "draw/folder.h"
#include "draw/svg.h"
#include "cli/source_words.h"

static const char name[] = "vndf report";

static const char help[] =
    "usage: vndf report [--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]] DIR\n"
    "\n"
    "Writes DIR/index.html, one page that needs nothing else: which table to ship, error against time, bytes and\n"
    "angle, density and samples, variance against samples, and where the time goes; beside it the data behind\n"
    "each plot as CSV, and DIR/frontier.svg. Takes about a minute.\n"
    "\n"
    "  --ndf EXPR, --slope EXPR, --csv FILE, --family NAME\n"
    "                  your own D, as `vndf build --help` describes them; it comes first in the page. Without\n"
    "                  one, the page is about student-t:2.5, an exponential and a ring\n"
    "  --set NAME=X    a parameter of the expression; may be repeated\n"
    "  --seconds S     to spend in all, roughly, 1 to 3600 (default 45); fewer mean fewer sizes and more noise\n"
    "\n"
    "DIR is made if it is not there. If it is, it has to be empty or to hold a report, which is replaced; other\n"
    "files in it are left alone. Interrupted, the command leaves DIR as it was.\n"
    "\n"
    "example: vndf report --slope 'exp(-k*r)*(1+0.8*cos(6*r))' --set k=3 wavy-report\n";

/* ---- progress ------------------------------------------------------------------------------------ */

typedef struct report_plan {
    source_words source;
    words seconds_words;
    double seconds;
} report_plan;

/* ---- what is measured ---------------------------------------------------------------------------- */

/* Shapes that differ: a heavy tail, a peak, a ring. */
typedef struct example {
    const char *family, *slope, *name, *arguments;
} example;

static const example examples[] = {
    {"student-t:2.5", NULL, "student-t:2.5", "--family student-t:2.5"},
    {NULL, "exp(-r)", "exponential: exp(-r)", "--slope 'exp(-r)'"},
    {NULL, "exp(-((r-1)/0.1)^2)", "ring: exp(-((r-1)/0.1)^2)", "--slope 'exp(-((r-1)/0.1)^2)'"},
};

enum { EXAMPLES = sizeof examples / sizeof examples[0] };

/* Of the seconds: the tables of the first distribution, of each other one, and the benchmark, which also takes
 * some to prepare. */
static const double first_part = 0.4, other_part = 0.2, bench_part = 0.36;

static void begin_step(progress *p, const char *step, double to)
{
    p->name = step;
    progress_step(p, to);
    progress_show(0, NULL, p);
}

/* Takes the source; the status of what failed, told. */
static int add_subject(report *r, vndf_source *source, const char *title, const char *arguments)
{
    vndf_error error = {VNDF_OK, ""};
    report_subject *subject = &r->subject[r->count++];
    if (report_subject_begin(subject, source, title, arguments, &error) != VNDF_OK)
        return complain(name, "%s", error.message);
    return STATUS_GOOD;
}

static int add_users(report *r, const source_words *given)
{
    char title[256];
    vndf_source *source = source_from_words(name, given);
    if (!source)
        return STATUS_USE;
    source_text_name(given, title, sizeof title);
    int status = add_subject(r, source, title, vndf_source_description(source));
    r->subject[0].brought = 1;
    return status;
}

static int add_example(report *r, const example *e)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = e->family ? vndf_source_family(e->family, &error)
                                    : vndf_source_slope_expression(e->slope, NULL, 0, &error);
    return source ? add_subject(r, source, e->name, e->arguments) : complain(name, "%s", error.message);
}

static int add_subjects(report *r, const source_words *given)
{
    int status = source_words_count(given) ? add_users(r, given) : STATUS_GOOD;
    for (size_t i = 0; i < EXAMPLES && r->count < EXAMPLES && status == STATUS_GOOD; i++)
        status = add_example(r, &examples[i]);
    return status;
}

static int build_subjects(report *r, double seconds, progress *p)
{
    const report_watch watch = {progress_show, p};
    for (size_t i = 0; i < r->count; i++) {
        vndf_error error = {VNDF_OK, ""};
        begin_step(p, r->subject[i].name, 0.3 + 0.1 * (double)i);
        vndf_status status =
            report_subject_build(&r->subject[i], seconds * (i == 0 ? first_part : other_part), &watch, &error);
        if (status != VNDF_OK)
            return complain(name, "%s: %s", r->subject[i].name, error.message);
    }
    r->ggx = report_time_of(vndf_ggx());
    r->beckmann = report_time_of(vndf_beckmann());
    return STATUS_GOOD;
}

/* The tables of the first distribution among all other methods, as `vndf bench` has them. */
static int compare_methods(report *r, double seconds, progress *p)
{
    const report_subject *s = &r->subject[0];
    vndf_error error = {VNDF_OK, ""};
    const bench_plan plan = {.source = s->source,
                             .name = s->name,
                             .seconds = seconds * bench_part,
                             .progress = progress_show,
                             .progress_user = p};
    begin_step(p, "all methods side by side", 1);
    return bench_run(&plan, &r->rows, &error) == VNDF_OK ? STATUS_GOOD : complain(name, "%s", error.message);
}

static int measure(report *r, const report_plan *plan, progress *p)
{
    int status = add_subjects(r, &plan->source);
    if (status == STATUS_GOOD)
        status = build_subjects(r, plan->seconds, p);
    if (status != STATUS_GOOD)
        return status;
    begin_step(p, "variance", 0.65);
    report_variance_measure(&r->subject[0], r->integral);
    return compare_methods(r, plan->seconds, p);
}

/* ---- the page ------------------------------------------------------------------------------------ */

static void write_contents(FILE *html, const report *r)
{
    static const char *const sets[] = {"", "the portable path", "AVX2", "AVX-512"};
    fputs("<p class=\"lead\">Visible normals sampled from tables: what accuracy costs in time and memory. ", html);
    fprintf(html, "Batches ran on %s. ", sets[vndf_instructions_used(VNDF_INSTRUCTIONS_BEST)]);
    fputs(r->subject[0].brought ? "The first distribution is yours: <code>" : "The first distribution is <code>",
          html);
    svg_escape(html, r->subject[0].arguments);
    fputs("</code>.</p>\n<nav><a href=\"#advice\">Which table</a> <a href=\"#frontier\">Error and time</a> "
          "<a href=\"#bytes\">Error and bytes</a> <a href=\"#theta\">Error and angle</a> "
          "<a href=\"#normals\">Density and samples</a> <a href=\"#variance\">Variance</a> "
          "<a href=\"#time\">Where the time goes</a></nav>\n",
          html);
}

static int write_page(html_page *page, const report *r)
{
    if (!page_begin(page, name, "What accuracy costs"))
        return 0;
    write_contents(page->html, r);
    return report_write_advice(page, r) && report_write_frontier(page, r) && report_write_bytes(page, r) &&
           report_write_theta(page, r) && report_write_normals(page, r) && report_write_variance(page, r) &&
           report_write_time(page, r) && page_end(page);
}

static int write_report(const report *r, const char *path, folder_state state, unsigned held)
{
    html_page page;
    int status = write_page(&page, r) ? folder_write(name, path, page.file, page.count, held)
                                      : complain(name, "no memory for the page");
    if (status == STATUS_GOOD) {
        if (state == FOLDER_OURS)
            printf("replaced the report in %s\n", path);
        for (size_t i = 0; i < page.count; i++)
            printf("%s/%s\n", path, page.file[i].name);
    }
    page_free(&page);
    return status;
}

/* ---- the command --------------------------------------------------------------------------------- */

static int run(const report_plan *plan, const char *path, folder_state state, unsigned held)
{
    progress p = progress_begin(name, held);
    report *r = calloc(1, sizeof *r);
    if (!r)
        return complain(name, "no memory");
    int status = measure(r, plan, &p);
    progress_end(&p);
    if (status == STATUS_GOOD)
        status = write_report(r, path, state, held);
    for (size_t i = 0; i < r->count; i++)
        report_subject_free(&r->subject[i]);
    bench_rows_free(&r->rows);
    free(r);
    return status;
}

static int check_words(report_plan *plan)
{
    if (source_words_count(&plan->source) > 1)
        return complain(name, "more than one of --ndf, --slope, --csv and --family; one at most is needed");
    if (!option_number(name, "--seconds", &plan->seconds_words, 1, 3600, &plan->seconds))
        return STATUS_USE;
    return source_words_check_set(name, &plan->source);
}

int command_report(int argc, char **argv)
{
    report_plan plan = {.seconds = 45};
    words positional = {{NULL}, 0};
    const option_form options[] = {
        {"--ndf", 1, 1, &plan.source.ndf},         {"--slope", 1, 1, &plan.source.slope},
        {"--csv", 1, 1, &plan.source.csv},         {"--family", 1, 1, &plan.source.family},
        {"--set", 1, WORDS_MAX, &plan.source.set}, {"--seconds", 1, 1, &plan.seconds_words},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "DIR", 1, 1};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed == PARSE_GO_ON)
        parsed = check_words(&plan);
    if (parsed != PARSE_GO_ON)
        return parsed;
    folder_state state = folder_examine(name, only_word(&positional));
    if (state == FOLDER_REFUSED)
        return STATUS_USE;
    unsigned held = output_hold_signals();
    int status = run(&plan, only_word(&positional), state, held);
    output_release_signals(held);
    return status;
}
