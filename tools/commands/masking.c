/* vndf masking: which masking functions are exact for a distribution (masking.h). A report: the integral of visible
 * normals for each function over incident angles, and a verdict. */
#include <math.h>
#include <stdio.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/subject.h"
#include "measure/masking.h"
#include "cli/output.h"
#include "cli/source_words.h"
#include "draw/table.h"

static const char name[] = "vndf masking";

static const char help[] =
    "usage: vndf masking [FILE|ggx|beckmann ...] [--csv FILE | --family NAME[:PARAM,...] | --ndf EXPR |\n"
    "                    --slope EXPR] [--alpha AX[,AY]] [--phi DEG] [-o OUT.csv]\n"
    "\n"
    "Prints for each distribution (default: ggx and beckmann) the integral over all normals wm of\n"
    "\n"
    "  G1(wi, wm) max(0, wi.wm) D(wm) / cos_i\n"
    "\n"
    "at incident angles from 0 to 89 degrees. It is 1 where G1 is the masking of a microsurface: visible normals\n"
    "are then a density, and no energy is made or lost. Masking functions:\n"
    "\n"
    "  smith          the distribution's own Smith function, vndf_g1\n"
    "  v-cavities     min(1, 2 cos(theta_m) cos_i/(wi.wm)), Cook & Torrance\n"
    "  implicit       cos_i, the part of one direction in G2 = cos_i cos_o\n"
    "  kelemen        cos_i/(wi.wm), the part of one direction in Kelemen's G2 = cos_i cos_o/(wi.wm)^2\n"
    "  schlick-smith  cos_i/(cos_i (1 - k) + k), k = alpha sqrt(2/pi) for beckmann (Schlick 1994); for all others\n"
    "                 k = alpha/2 of the GGX with the same median slope (Karis 2013); at most 1\n"
    "\n"
    "and the verdict: exact, if it is 1 within 1e-4 at all angles.\n"
    "\n"
    "  --alpha AX[,AY]  roughness along x and y (default 0.5; at 1 the Schlick-Smith of ggx is Smith's)\n"
    "  --phi DEG        azimuth of the incident directions from the x axis, -360 to 360 (default 0)\n"
    "  --csv FILE, --family NAME, --ndf EXPR, --slope EXPR, --set NAME=X\n"
    "                   your own D, as `vndf build --help` describes them, by a table of 8 KiB; it comes last\n"
    "  -o OUT.csv       the integrals as CSV as well; - for stdout, in place of the text\n"
    "\n"
    "exit status: 0 whatever the verdicts are, 2 wrong use\n"
    "\n"
    "example: vndf masking ggx tables/hazy.vndf --alpha 0.5\n"
    "         vndf masking --csv tables/example.csv -o masking.csv\n";

enum { ANGLES = 8 };
static const double angle[ANGLES] = {0, 15, 30, 45, 60, 75, 85, 89};
static const double exact_within = 1e-4;

static const char *const function_name[MASKING_COUNT] = {"smith", "v-cavities", "implicit", "kelemen",
                                                         "schlick-smith"};

typedef struct masking_words {
    source_words source;
    words subjects, alpha, phi, output;
} masking_words;

/* One distribution at all angles. */
typedef struct masking_rows {
    const char *subject; /* its name */
    vndf_surface surface;
    double phi;
    masking_integrals at[ANGLES];
} masking_rows;

static void measure(masking_rows *rows)
{
    for (int i = 0; i < ANGLES; i++)
        rows->at[i] = masking_integrate(&rows->surface, direction_from(angle[i], rows->phi));
}

/* ---- text ---------------------------------------------------------------------------------------- */

static void print_verdict(const masking_rows *rows, int function)
{
    double least = rows->at[0].of[function], most = least;
    for (int i = 1; i < ANGLES; i++) {
        least = fmin(least, rows->at[i].of[function]);
        most = fmax(most, rows->at[i].of[function]);
    }
    if (least > 1 - exact_within && most < 1 + exact_within)
        printf("%-14s exact: 1 within 1e-4 everywhere\n", function_name[function]);
    else
        printf("%-14s not exact: %.4g to %.4g\n", function_name[function], least, most);
}

static void print_rows(const masking_rows *rows)
{
    printf("%s, alpha %.6g %.6g, phi %.6g: integral of D cos(theta_m) is %.6f\n\n%5s", rows->subject,
           (double)rows->surface.alpha_x, (double)rows->surface.alpha_y, rows->phi, rows->at[0].normals, "theta");
    for (int j = 0; j < MASKING_COUNT; j++)
        printf(" %13s", function_name[j]);
    for (int i = 0; i < ANGLES; i++) {
        printf("\n%5g", angle[i]);
        for (int j = 0; j < MASKING_COUNT; j++)
            printf(" %13.6g", rows->at[i].of[j]);
    }
    printf("\n\n");
    for (int j = 0; j < MASKING_COUNT; j++)
        print_verdict(rows, j);
    printf("\n");
}

/* ---- CSV ----------------------------------------------------------------------------------------- */

static void write_rows(FILE *file, const masking_rows *rows)
{
    for (int i = 0; i < ANGLES; i++) {
        table_quote(file, rows->subject);
        fprintf(file, ",%.9g,%.9g,%.9g,%g", (double)rows->surface.alpha_x, (double)rows->surface.alpha_y,
                rows->phi, angle[i]);
        for (int j = 0; j < MASKING_COUNT; j++)
            fprintf(file, ",%.9g", rows->at[i].of[j]);
        putc('\n', file);
    }
}

static void write_header(FILE *file)
{
    fputs("distribution,alpha_x,alpha_y,phi,theta", file);
    for (int j = 0; j < MASKING_COUNT; j++)
        fprintf(file, ",%s", function_name[j]);
    putc('\n', file);
}

/* ---- command ------------------------------------------------------------------------------------- */

/* What is to be reported on, and where. */
typedef struct masking_plan {
    const masking_words *given;
    const output_file *csv;       /* NULL: there is none */
    const vndf_distribution *own; /* of the source that was given; NULL: there is none */
    const char *own_name;
} masking_plan;

/* Roughness and azimuth. 1, or 0 after a complaint. */
static int read_settings(const masking_words *given, masking_rows *rows)
{
    const vndf_vec3 up = {0, 0, 1};
    const char *alpha = only_word(&given->alpha);
    if (!roughness_from(name, alpha ? alpha : "0.5", &rows->surface) ||
        !option_number(name, "--phi", &given->phi, -360, 360, &rows->phi))
        return 0;
    if (vndf_projected_area(&rows->surface, up) > 0)
        return 1;
    complain(name, "--alpha times the scale of '%s' (vndf info) is not in the range from 1e-18 to 1e18",
             rows->subject);
    return 0;
}

/* To the CSV, if there is one, and to stdout unless that takes it. */
static int report_rows(const masking_plan *plan, const char *subject, const vndf_distribution *distribution)
{
    masking_rows rows = {.subject = subject, .surface.distribution = distribution};
    if (!read_settings(plan->given, &rows))
        return STATUS_USE;
    measure(&rows);
    if (plan->csv)
        write_rows(plan->csv->file, &rows);
    if (!plan->csv || plan->csv->path)
        print_rows(&rows);
    return STATUS_GOOD;
}

static int report_subject(const masking_plan *plan, const char *subject)
{
    chosen_distribution chosen;
    if (!distribution_open(&chosen, name, subject))
        return STATUS_USE;
    int status = report_rows(plan, subject, chosen.distribution);
    distribution_close(&chosen);
    return status;
}

static int report_all(const masking_plan *plan)
{
    const words *subjects = &plan->given->subjects;
    int status = STATUS_GOOD;
    for (size_t i = 0; i < subjects->count && status == STATUS_GOOD; i++) {
        if (plan->csv && output_interrupted(plan->csv))
            return status;
        status = report_subject(plan, subjects->item[i]);
    }
    return status == STATUS_GOOD && plan->own ? report_rows(plan, plan->own_name, plan->own) : status;
}

static int report_with_csv(masking_plan *plan)
{
    output_file output;
    if (!output_open(&output, name, only_word(&plan->given->output)))
        return STATUS_USE;
    plan->csv = &output;
    write_header(output.file);
    int status = report_all(plan);
    if (status != STATUS_GOOD)
        output_discard(&output);
    else
        status = output_interrupted(&output) ? output_give_up(&output, "interrupted") : output_commit(&output);
    return status;
}

static int report(masking_plan *plan)
{
    return plan->given->output.count ? report_with_csv(plan) : report_all(plan);
}

/* A table of the source that was given stands for it. */
static int report_with_own(masking_plan *plan)
{
    char title[256];
    vndf_distribution *table = table_from_words(name, &plan->given->source, title, sizeof title);
    if (!table)
        return STATUS_USE;
    plan->own = table;
    plan->own_name = title;
    int status = report(plan);
    vndf_free(table);
    return status;
}

static int check_words(masking_words *given)
{
    static const char *const forms[2] = {"csv", NULL};
    const char *path = only_word(&given->output);
    size_t sources = source_words_count(&given->source);
    if (sources > 1)
        return complain(name, "more than one of --ndf, --slope, --csv and --family; one at most is needed");
    if (path && output_form(name, path, NULL, forms) < 0)
        return STATUS_USE;
    if (!given->subjects.count && !sources) {
        given->subjects.item[given->subjects.count++] = "ggx";
        given->subjects.item[given->subjects.count++] = "beckmann";
    }
    return source_words_check_set(name, &given->source);
}

int command_masking(int argc, char **argv)
{
    masking_words given = {0};
    masking_plan plan = {.given = &given};
    const option_form options[] = {
        {"--ndf", 1, 1, &given.source.ndf},
        {"--slope", 1, 1, &given.source.slope},
        {"--csv", 1, 1, &given.source.csv},
        {"--family", 1, 1, &given.source.family},
        {"--set", 1, WORDS_MAX, &given.source.set},
        {"--alpha", 1, 1, &given.alpha},
        {"--phi", 1, 1, &given.phi},
        {"-o", 1, 1, &given.output},
    };
    const command_form form = {name, help,     options, sizeof options / sizeof options[0], "FILE|ggx|beckmann",
                               0,    WORDS_MAX};
    int parsed = parse_arguments(&form, argc, argv, &given.subjects);
    if (parsed == PARSE_GO_ON)
        parsed = check_words(&given);
    if (parsed != PARSE_GO_ON)
        return parsed;
    return source_words_count(&given.source) ? report_with_own(&plan) : report(&plan);
}
