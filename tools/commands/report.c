/* vndf report: one page about what accuracy costs for the user's own D. Which table to ship is what `vndf build` makes
 * by default: every table is exact with its weight, and a coarse one costs noise. */
#include <math.h>
#include <string.h>

#include "cli/subject.h"
#include "command.h"
#include "commands/parts/describe.h"
#include "draw/draw.h"
#include "draw/page.h"
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

enum { SUBJECTS_MAX = 4 };

typedef struct report {
    subject subject[SUBJECTS_MAX]; /* the first is the one at hand */
    size_t count;
    evidence *found;       /* for the one at hand */
    evidence_column batch; /* by the best instructions of this machine, and their name */
    const char *instructions;
} report;

static int add_subjects(report *r, const arguments *given)
{
    const words with = option_values(given, "--with");
    vndf_error error = {VNDF_OK, ""};
    if (with.count >= SUBJECTS_MAX)
        return complain(name, "--with is given more than %d times", SUBJECTS_MAX - 1);
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

/* ---- which table --------------------------------------------------------------------------------- */

/* What was measured of a table, or NaN. */
static double measured(const report *r, const vndf_distribution *table, evidence_column c)
{
    for (const evidence_row *of = r->found->row; of < r->found->row + r->found->count; of++)
        if (of->m.kind == ROW_TABLE && of->m.d == table)
            return of->number[c];
    return NAN;
}

/* What `vndf build` says of the table that it makes, and what samples of it take. */
static void write_advice(FILE *html, const report *r, const subject *s)
{
    const chosen_distribution advised = {.distribution = s->table[SIZE_PLAIN]};
    const vndf_info info = vndf_distribution_info(advised.distribution);
    const double ns = measured(r, advised.distribution, COL_NS);
    char verdict[DESCRIBE_VERDICT];
    describe_verdict(&advised, verdict);
    fputs("<p><strong>", html);
    svg_escape(html, s->name);
    fprintf(html, ": ship %.2g KiB with %d moments.</strong> It is ", (double)info.bytes / 1024, info.moments);
    svg_escape(html, verdict);
    if (ns > 0)
        fprintf(html, ". A sample takes %.0f ns, in a batch %.0f ns", ns,
                measured(r, advised.distribution, r->batch));
    fputs(".<code>vndf build ", html);
    svg_escape(html, vndf_source_description(s->source));
    fputs(" -o table.vndf</code></p>\n", html);
}

static void add_limited(figures *t, const char *heading, const char *format, float is, double most)
{
    figures_number(t, heading, format, (double)is, "");
    figures_mark(t, (double)is <= most ? NULL : "no");
}

static void add_table(figures *t, const report *r, const char *of, const vndf_distribution *table,
                      const char *mark)
{
    const vndf_info info = vndf_distribution_info(table);
    figures_record(t);
    figures_text(t, "distribution", of);
    figures_mark(t, mark);
    figures_number(t, "file (bytes)", "%.0f", (double)info.bytes, "");
    figures_number(t, "moments", "%.0f", info.moments, "");
    figures_number(t, "in memory (bytes)", "%.0f", (double)info.memory, "");
    add_limited(t, "weight", "%.3g", info.certificate.max_weight, 2);
    add_limited(t, "TV above", "%.1e", info.certificate.tv_above, 1e-3);
    add_limited(t, "TV below", "%.1e", info.certificate.tv, 3e-2);
    figures_number(t, "G1 error", "%.1e", (double)info.certificate.area_error, "");
    figures_number(t, "ns", "%.0f", measured(r, table, COL_NS), "");
    figures_number(t, "batch ns", "%.1f", measured(r, table, r->batch), "");
}

static int write_tables(html_page *page, const report *r)
{
    figures t = {.rows = 0};
    fputs("<div class=\"advice\">\n", page->html);
    for (size_t i = 0; i < r->count; i++) {
        const subject *s = &r->subject[i];
        write_advice(page->html, r, s);
        for (size_t k = 0; k < SIZES; k++)
            add_table(&t, r, s->name, s->table[k], k == SIZE_PLAIN ? "chosen" : NULL);
    }
    fputs("</div>\n", page->html);
    FILE *data = page_table(page, &t) ? page_file(page, "tables.csv") : NULL;
    const int good = data && figures_print(data, &t, FIGURES_CSV);
    figures_free(&t);
    if (good)
        page_link(page, "all tables");
    return good;
}

/* ---- error against time -------------------------------------------------------------------------- */

enum { SERIES_MAX = 24, POINTS_MAX = 16 };

typedef struct frontier {
    chart_series series[SERIES_MAX];
    chart_point point[SERIES_MAX][POINTS_MAX];
    size_t count;
} frontier;

/* Adds a point to the series of that look, unless it has no time or error. */
static void add_point(frontier *f, chart_series look, double x, double y, const char *label)
{
    size_t i = 0;
    while (i < f->count && (f->series[i].name || f->series[i].colour != look.colour ||
                            f->series[i].mark != look.mark || f->series[i].line != look.line))
        i++;
    if (!(x > 0) || !(y >= 0) || i == SERIES_MAX)
        return;
    if (i == f->count) {
        f->series[f->count++] = look;
        f->series[i].point = f->point[i];
    }
    if (f->series[i].count == POINTS_MAX)
        return;
    chart_point *to = &f->point[i][f->series[i].count++];
    *to = (chart_point){.x = x, .y = y};
    snprintf(to->label, sizeof to->label, "%s", label);
}

/* A row of D at hand, or of a closed form what is exact for it, one by one and in a batch. A label leaves out what
 * colour and shape say: of tables it is the size alone, and only where there are 4 moments. */
static void add_row(frontier *f, const report *r, const evidence_row *of)
{
    static const chart_line lines[] = {CHART_DOTTED, CHART_DASHED, CHART_SOLID}; /* of 2, 3, 4 moments */
    const row_kind kind = of->m.kind;
    const int is_exact = kind == ROW_CLOSED || (kind == ROW_PUBLISHED && !strstr(of->m.name, "all normals"));
    chart_series look = {.mark = kind == ROW_PUBLISHED ? CHART_TRIANGLE : CHART_SQUARE};
    char label[48] = "";
    if (kind > ROW_TABLE || (!is_exact && strcmp(of->of->name, r->subject[0].name) != 0))
        return;
    if (kind == ROW_TABLE) {
        const int moments = (int)of->number[COL_MOMENTS];
        look = (chart_series){.mark = CHART_DOT, .line = lines[moments - 2]};
        if (moments == 4)
            snprintf(label, sizeof label, "%.2g KiB", of->number[COL_FILE] / 1024); /* files stay a little below */
    } else if (kind == ROW_CLOSED)
        snprintf(label, sizeof label, "vndf_%.40s()", of->of->name);
    else
        snprintf(label, sizeof label, "%.*s", (int)strcspn(of->m.name, ","), of->m.name);
    /* a comparison with a density cannot tell an exact method's error from the rounding of floats */
    const double tv = kind != ROW_TABLE && of->number[COL_TV] < 3e-6 ? 0 : of->number[COL_TV];
    add_point(f, look, of->number[COL_NS], tv, label);
    look.colour = 1;
    add_point(f, look, of->number[r->batch], tv, label);
}

static int write_frontier(html_page *page, const report *r)
{
    char title[160], batch[40];
    snprintf(title, sizeof title, "Tables of %s beside other methods", r->subject[0].name);
    snprintf(batch, sizeof batch, "in a batch, %s", r->instructions);
    frontier f = {.series = {{.name = "tables of vndf", .colour = 4, .mark = CHART_DOT},
                             {.name = "its closed forms", .colour = 4, .mark = CHART_SQUARE},
                             {.name = "published methods", .colour = 4, .mark = CHART_TRIANGLE},
                             {.name = "advised", .colour = 3, .mark = CHART_RING},
                             {.name = "one by one", .colour = 0},
                             {.name = batch, .colour = 1}},
                  .count = 6};
    const chart_series advised = {.colour = 3, .mark = CHART_RING};
    const vndf_distribution *table = r->subject[0].table[SIZE_PLAIN];
    const double tv = (double)vndf_distribution_info(table).certificate.tv_above;
    for (const evidence_row *of = r->found->row; of < r->found->row + r->found->count; of++)
        add_row(&f, r, of);
    add_point(&f, advised, measured(r, table, COL_NS), tv, "advised");
    add_point(&f, advised, measured(r, table, r->batch), tv, "advised");
    const chart c = {.title = title,
                     .box = {0, 0, 1080, 640},
                     .x = {.label = "nanoseconds per sample (view, sample and density; one thread)"},
                     .y = {.label = "total variation, worst angle above the horizon"},
                     .zero = "exact",
                     .series = f.series,
                     .count = f.count};
    fputs("<figure class=\"scroll wide\" title=\"error against time\">\n", page->html);
    chart_draw(page->html, &c, 0);
    fputs("</figure>\n<p class=\"note\"><a href=\"frontier.svg\">frontier.svg</a></p>\n", page->html);
    FILE *alone = page_file(page, "frontier.svg");
    if (alone)
        chart_draw(alone, &c, 1);
    return alone != NULL;
}

static int write_times(html_page *page, const report *r)
{
    figures t = evidence_table(r->found, FIGURES_MARKDOWN);
    FILE *data = page_table(page, &t) ? page_file(page, "methods.csv") : NULL;
    figures_free(&t);
    if (!data || !evidence_print(data, r->found, FIGURES_CSV))
        return data ? denied(page->command, "no memory") : 0;
    page_link(page, "all methods, as vndf bench -o FILE.csv has them");
    return 1;
}

static int write_normals(html_page *page, const report *r)
{
    static const double thetas[] = {0, 60, 100};
    for (size_t i = 0; i < r->count; i++) {
        const vndf_surface advised = vndf_rough(r->subject[i].table[SIZE_PLAIN], 1, 1),
                           finest = vndf_rough(r->subject[i].table[SIZE_FINE], 1, 1);
        fputs("<h3>", page->html);
        svg_escape(page->html, r->subject[i].name);
        fputs("</h3>\n<figure class=\"panels\">\n", page->html);
        panel_ndf(page->html, (svg_box){0, 0, 340, 282}, &finest);
        for (unsigned v = 0; v < 3; v++)
            if (!panel_disc(page->html, (svg_box){0, 0, 250, 282}, &advised, thetas[v], v + 1))
                return denied(page->command, "no memory");
        fputs("</figure>\n", page->html);
    }
    return 1;
}

static const struct {
    const char *id, *title, *lead;
    int (*write)(html_page *, const report *);
} sections[] = {
    {"advice", "Which table, and how many moments",
     "Every table is exact with its weight; a coarse one costs noise. The advice is what vndf build makes by default. "
     "Its limits are weights up to 2 and a total variation (TV) up to 0.001 above the horizon, so that the weight may "
     "be left out where a bias below half a step of 8 bits does not matter, and 0.03 below it: light from there has "
     "met the surface before. A smaller one that "
     "keeps these limits (--max-tv 0.001) is not faster, and its D errs some ten times as much. All are of the "
     "certificates of the tables.",
     write_tables},
    {"frontier", "Error against time",
     "Further left is faster, further down nearer to the true visible normals. Curves join tables from 2 to "
     "32 KiB: solid ones have 4 moments, dashed ones 3, dotted ones 2. The weight mends the error of tables. "
     "Methods in the band at the bottom are exact but for the rounding of floats.",
     write_frontier},
    {"time", "What a sample costs", evidence_legend, write_times},
    {"normals", "Density and samples",
     "D against the angle of the normal, and the normals visible from three directions, the last below the "
     "horizon: density as colour (darker is denser, square root, each disc by itself), 350 samples as dots, "
     "seen from above in an equal-area projection. A ring or an arrow marks the incident direction.",
     write_normals}};

/* The page with its data; 0 after a complaint. */
static int write_page(html_page *page, const report *r)
{
    const size_t count = sizeof sections / sizeof *sections;
    if (!page_begin(page, "What accuracy costs"))
        return 0;
    fputs(
        "<p class=\"lead\">Visible normals sampled from tables: what accuracy costs in time and memory, for <code>",
        page->html);
    svg_escape(page->html, vndf_source_description(r->subject[0].source));
    fprintf(page->html, "</code>. Batches ran on %s.</p>\n<nav>", r->instructions);
    for (size_t i = 0; i < count; i++)
        fprintf(page->html, "<a href=\"#%s\">%s</a> ", sections[i].id, sections[i].title);
    fputs("</nav>\n", page->html);
    int good = 1;
    for (size_t i = 0; i < count && good; i++) {
        page_section(page, sections[i].id, sections[i].title, sections[i].lead);
        good = sections[i].write(page, r);
    }
    page_end(page);
    return good;
}

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
    if (status == STATUS_GOOD && !write_page(&page, &r))
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
