/* vndf report: one page about what accuracy costs for the user's own D. This file reads the words, measures one
 * thing after the other, and has the page written (evidence/report.c). */

#include "cli/subject.h"
#include "command.h"
#include "evidence/evidence.h"

static const char name[] = "vndf report";

static const char *const help[] = {
    "usage: vndf report [--ndf EXPR | --slope EXPR | --csv FILE | --family NAME[:PARAM,...]] [options] DIR\n"
    "\n"
    "Writes DIR/index.html, one page that needs nothing else: which table to ship and with how many moments, error\n"
    "against time, what a sample costs beside other methods and distributions, density and samples; beside it the\n"
    "data as CSV, and DIR/frontier.svg. Takes about a minute.\n"
    "\n"
    "  --ndf EXPR, --slope EXPR, --csv FILE, --family NAME\n"
    "                  your own D, as `vndf build --help` describes them (default --family student-t:2.5)\n"
    "  --set NAME=X ...  a parameter of the expression\n"
    "  --with NAME ...  another family, as --family takes it, to be shown beside it; up to 3 times\n"
    "  --seconds S     to spend in all, roughly, 1 to 3600 (default 45); fewer mean more noise\n"
    "\n"
    "DIR is made if it is not there. If it is, it has to be empty or to hold a report, which is replaced; other\n"
    "files in it are left alone. Interrupted, the command leaves DIR as it was.\n"
    "\n"
    "example: vndf report --slope 'exp(-k*r)*(1+0.8*cos(6*r))' --set k=3 wavy-report\n",
    NULL};

/* ---- what is measured ---------------------------------------------------------------------------- */

static int add_subjects(report *r, const arguments *given)
{
    const words with = option_values(given, "--with");
    vndf_error error = {VNDF_OK, ""};
    if (with.count >= REPORT_SUBJECTS)
        return complain(name, "--with is given more than %d times", REPORT_SUBJECTS - 1);
    vndf_source *source = source_from_words(given, "student-t:2.5");
    for (size_t i = 0; source; i++) {
        subject_begin(&r->subject[r->count++], source, source_name(source));
        if (i == with.count)
            return STATUS_GOOD;
        source = vndf_source_family(with.item[i], &error);
    }
    return r->count ? complain(name, "--with: %s", error.message) : STATUS_USE;
}

static int measure(report *r, const arguments *given, evidence_plan *plan)
{
    vndf_error error = {VNDF_OK, ""};
    int status = add_subjects(r, given);
    for (size_t i = 0; i < r->count && status == STATUS_GOOD; i++)
        for (size_t k = 0; k < SIZES && status == STATUS_GOOD; k++)
            if (!subject_table(&r->subject[i], k, plan, &error))
                status = complain(name, "%s: %s", r->subject[i].name, error.message);
    if (status != STATUS_GOOD)
        return status;
    const vndf_instructions best = vndf_instructions_used(VNDF_INSTRUCTIONS_BEST);
    r->batch = (evidence_column)(COL_NS + (int)best);
    r->instructions = best == VNDF_INSTRUCTIONS_AVX512 ? "avx512"
                      : best == VNDF_INSTRUCTIONS_AVX2 ? "avx2"
                                                       : "what every machine has";
    plan->at_hand = &r->subject[0];
    r->found = evidence_run(plan, &error);
    return r->found ? STATUS_GOOD : complain(name, "%s", error.message);
}

/* ---- the command --------------------------------------------------------------------------------- */

static int run(const arguments *given)
{
    const char *path = given->positional.item[0];
    const int is_quiet = option_value(given, "-q") != NULL;
    double seconds = 45;
    html_page page;
    if (!option_number(given, "--seconds", 1, 3600, &seconds) || !page_open(&page, name, path))
        return STATUS_USE;
    progress p = progress_begin(name, is_quiet);
    evidence_plan plan = {.seconds = seconds, .progress = &p, .start = clock_seconds()};
    static report r;
    int status = measure(&r, given, &plan);
    progress_end(&p);
    if (status == STATUS_GOOD && !report_write(&page, &r))
        status = STATUS_USE;
    status = page_close(&page, status);
    if (status == STATUS_GOOD && !is_quiet && page.is_replaced)
        printf("replaced the report in %s\n", path);
    for (size_t i = 0; i < page.count && status == STATUS_GOOD && !is_quiet; i++)
        printf("%s/%s\n", path, page.name[i]);
    for (size_t i = 0; i < r.count; i++)
        subject_free(&r.subject[i]);
    evidence_free(r.found);
    return status;
}

const subcommand command_report = {
    name, "a page of plots: what accuracy costs, and which table to ship", "DIR", 1, 1, run, help};
