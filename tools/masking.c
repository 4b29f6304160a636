/* vndf masking: which masking functions are exact for a distribution (masking.h). A report: the integral of visible
 * normals for each function over incident angles, and a verdict. */
#include <math.h>
#include <stdio.h>

#include "arguments.h"
#include "command.h"
#include "distribution.h"
#include "masking.h"
#include "output.h"

static const char name[] = "vndf masking";

static const char help[] =
    "usage: vndf masking [FILE|ggx|beckmann ...] [--alpha AX[,AY]] [--phi DEG] [--csv FILE]\n"
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
    "  --csv FILE       the integrals as CSV as well; - for stdout, in place of the text\n"
    "\n"
    "exit status: 0 whatever the verdicts are, 2 wrong use\n"
    "\n"
    "example: vndf masking ggx tables/hazy.vndf --alpha 0.5\n";

enum { ANGLES = 8 };
static const double angle[ANGLES] = {0, 15, 30, 45, 60, 75, 85, 89};
static const double exact_within = 1e-4;

static const char *const function_name[MASKING_COUNT] = {"smith", "v-cavities", "implicit", "kelemen",
                                                         "schlick-smith"};

typedef struct masking_words {
    words alpha, phi, csv;
} masking_words;

/* One distribution at all angles. */
typedef struct masking_rows {
    const char *subject;
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

static void write_quoted(FILE *file, const char *text)
{
    putc('"', file);
    for (; *text; text++)
        fprintf(file, *text == '"' ? "\"\"" : "%c", *text);
    putc('"', file);
}

static void write_rows(FILE *file, const masking_rows *rows)
{
    for (int i = 0; i < ANGLES; i++) {
        write_quoted(file, rows->subject);
        fprintf(file, ",%.9g,%.9g,%.9g,%g", (double)rows->surface.alpha_x, (double)rows->surface.alpha_y, rows->phi,
                angle[i]);
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
    complain(name, "--alpha times the scale of '%s' (vndf info) is not in the range from 1e-18 to 1e18", rows->subject);
    return 0;
}

/* To the CSV, if there is one, and to stdout unless that takes it. */
static int report_subject(const masking_words *given, masking_rows *rows, const output_file *csv)
{
    chosen_distribution chosen;
    if (!distribution_open(&chosen, name, rows->subject))
        return STATUS_USE;
    rows->surface.distribution = chosen.distribution;
    int good = read_settings(given, rows);
    if (good)
        measure(rows);
    distribution_close(&chosen);
    if (good && csv)
        write_rows(csv->file, rows);
    if (good && (!csv || csv->path))
        print_rows(rows);
    return good ? STATUS_GOOD : STATUS_USE;
}

static int report_all(const masking_words *given, const words *subjects, const output_file *csv)
{
    int status = STATUS_GOOD;
    for (size_t i = 0; i < subjects->count && status == STATUS_GOOD; i++) {
        masking_rows rows = {.subject = subjects->item[i]};
        if (csv && output_interrupted(csv))
            break;
        status = report_subject(given, &rows, csv);
    }
    return status;
}

static int report_with_csv(const masking_words *given, const words *subjects)
{
    output_file output;
    if (!output_open(&output, name, only_word(&given->csv)))
        return STATUS_USE;
    write_header(output.file);
    int status = report_all(given, subjects, &output);
    if (status != STATUS_GOOD)
        output_discard(&output);
    else
        status = output_interrupted(&output) ? output_give_up(&output, "interrupted") : output_commit(&output);
    return status;
}

int command_masking(int argc, char **argv)
{
    masking_words given = {0};
    words subjects = {{NULL}, 0};
    const option_form options[] = {
        {"--alpha", 1, 1, &given.alpha}, {"--phi", 1, 1, &given.phi}, {"--csv", 1, 1, &given.csv}};
    const command_form form = {
        name, help, options, sizeof options / sizeof options[0], "FILE|ggx|beckmann", 0, WORDS_MAX};
    int parsed = parse_arguments(&form, argc, argv, &subjects);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (!subjects.count) {
        subjects.item[subjects.count++] = "ggx";
        subjects.item[subjects.count++] = "beckmann";
    }
    return given.csv.count ? report_with_csv(&given, &subjects) : report_all(&given, &subjects, NULL);
}
