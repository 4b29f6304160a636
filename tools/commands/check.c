/* vndf check: is a distribution what it claims to be? Three parts, and a fourth with --hard, print lines that
 * end with good or FAILED:
 *   certificate  measured again against the source, compared with what the table says;
 *   consistency  sample, pdf and invert agree with each other (consistency.h);
 *   chi-square   samples follow the density that they claim (chi_square.h), over a grid of views;
 *   hard         the calls keep their promises for the hardest input that is valid (stress.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "evidence/measure/chi_square.h"
#include "command.h"
#include "evidence/measure/consistency.h"
#include "cli/figures.h"
#include "cli/progress.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "evidence/measure/statistics.h"
#include "evidence/measure/stress.h"
#include "vndf_build.h"

static const char name[] = "vndf check";

static const char help[] =
    "usage: vndf check FILE|ggx|beckmann [--hard] [--samples N] [--csv FILE] [--seed S] [--json] [-q]\n"
    "\n"
    "Measures a distribution again and prints a table; exit status 1 if a claim fails.\n"
    "\n"
    "  certificate  the numbers stored in the table against a new measurement from its source; more than\n"
    "               20% (and 1e-7) worse fails. Closed forms have none.\n"
    "  consistency  at 200000 random views (0 to 180 degrees, roughness 0.02 to 1): normals are unit, above the\n"
    "               surface and face the incident direction; where the projected area exceeds 1e-12, pdf gives\n"
    "               the density that sample returned within 1e-5 for 99.9% and 1e-4 for 99.99% of the samples\n"
    "               above the horizon, 1e-4 and 1e-3 below it (left out where D is steeper than in a lobe of a\n"
    "               tenth of its slope); and invert, then sample, gives the normal within 1e-5 for 99.9% and\n"
    "               1e-4 for 99.99%, slopes over roughness, or its numbers come back within 8 steps of 2^-24.\n"
    "  chi-square   N samples per view against the density integrated over 130 x 65 bins, at 0, 30, 60, 80, 89\n"
    "               and 130 degrees, roughness 1 and 0.05 x 0.4 (azimuth 25 degrees). The bins divide the\n"
    "               hemisphere stretched to the lobe, half of their borders evenly, half at quantiles; bins\n"
    "               of expected count < 5 are pooled. Significance 0.01 for all tests together (Sidak); and\n"
    "               the density has to integrate to 1 within 1e-5.\n"
    "  hard         (with --hard) some 1.9 million samples: directions at, beside and below the normal, the\n"
    "               horizon and straight down; roughness 1e-8 to 1e4, ratios up to 1e8; uniform numbers 0, the\n"
    "               least float, 1/2 and its neighbours, 1 - 2^-24, 1. Then 640000 samples of surfaces with a\n"
    "               random matrix (condition up to 1e4, either sign) and a mean slope up to 2. For each property\n"
    "               the worst value, its limit, and the input that gave it.\n"
    "\n"
    "  --hard       adds the hard cases\n"
    "  --samples N  samples per chi-square test (default 1000000)\n"
    "  --csv FILE   the CSV that the table was built from; without it the certificate is not measured again\n"
    "  --seed S     the stream of random numbers, a whole number (default 1)\n" FIGURES_HELP "\n"
    "example: vndf check wavy.vndf --hard --samples 4000000\n";

typedef struct check_words {
    words samples, csv, seed, hard;
    figure_words figures;
} check_words;

static const char *verdict(int good)
{
    return good ? "good" : "FAILED";
}

/* ---- certificate --------------------------------------------------------------------------------- */

/* floor: what the number is when nothing is wrong, 0 for an error, 1 for a ratio; factor: how much worse it may
 * be. */
static int compare(figures *f, const char *what, float stored, float measured, double floor, double factor)
{
    double allowed = floor + factor * ((double)stored - floor) + 1e-7;
    int good = (double)measured <= allowed;
    if (f->form == FIGURES_TEXT)
        printf("certificate  %-14s stored %-12.5g measured %-12.5g %s\n", what, (double)stored, (double)measured,
               verdict(good));
    else {
        figures_record(f);
        figures_text(f, "figure", what);
        figures_number(f, "stored", 5, (double)stored, "as vndf info says");
        figures_number(f, "measured", 5, (double)measured, "as vndf info says");
        figures_truth(f, "good", good);
    }
    return good;
}

static int compare_certificates(figures *f, const vndf_certificate *stored, const vndf_certificate *measured)
{
    const double factor = 1.2;
    figures_list(f, "certificate");
    int good = compare(f, "tv", stored->tv, measured->tv, 0, factor);
    good &= compare(f, "tv_above", stored->tv_above, measured->tv_above, 0, factor);
    good &= compare(f, "max_weight", stored->max_weight, measured->max_weight, 1, factor);
    good &= compare(f, "area_error", stored->area_error, measured->area_error, 0, factor);
    good &= compare(f, "consistency", stored->consistency, measured->consistency, 0, factor);
    good &= compare(f, "ndf_error", stored->ndf_error, measured->ndf_error, 0, factor);
    good &= compare(f, "weight_unbound", 1 - stored->weight_bounded, 1 - measured->weight_bounded, 0, factor);
    good &= compare(f, "hidden", stored->hidden, measured->hidden, 0, factor);
    good &= compare(f, "finest", stored->finest, measured->finest, 0, factor);
    figures_list_end(f);
    return good;
}

/* What the table was built from; NULL with the reason printed if that cannot be had. */
static vndf_source *original_source(figures *f, const vndf_distribution *table, const char *csv, int *failed)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = csv ? source_from_csv(name, csv) : vndf_source_of(table, &error);
    *failed = !source && (csv || error.status != VNDF_ERROR_ARGUMENT);
    if (*failed && !csv)
        complain(name, "%s", error.message);
    else if (!source && f->form == FIGURES_TEXT)
        printf("certificate  not measured again: %s\n", error.message);
    else if (!source)
        figures_text(f, "not_measured_again", error.message);
    return source;
}

static int check_certificate(figures *f, const vndf_distribution *table, const char *csv)
{
    vndf_certificate measured;
    vndf_error error = {VNDF_OK, ""};
    int failed;
    vndf_info info = vndf_distribution_info(table);
    vndf_source *source = original_source(f, table, csv, &failed);
    if (!source)
        return failed ? STATUS_USE : STATUS_GOOD;
    if (csv && f->form == FIGURES_TEXT && strcmp(vndf_source_description(source), info.source) != 0)
        printf("certificate  note: the table says %s\n             and the source is %s\n", info.source,
               vndf_source_description(source));
    vndf_status status = vndf_certify(table, source, &measured, &error);
    vndf_source_free(source);
    if (status != VNDF_OK)
        return complain(name, "%s", error.message);
    return compare_certificates(f, &info.certificate, &measured) ? STATUS_GOOD : STATUS_NO;
}

/* ---- consistency --------------------------------------------------------------------------------- */

static int check_quantiles(figures *f, const char *what, const consistency_quantiles *found, double usual,
                           double rare)
{
    int good = found->usual <= usual && found->rare <= rare;
    if (f->form == FIGURES_TEXT)
        printf("consistency  %-30s 99.9%%: %.2g of %g, 99.99%%: %.2g of %g %s\n", what, found->usual, usual,
               found->rare, rare, verdict(good));
    else {
        figures_record(f);
        figures_text(f, "of", what);
        figures_number(f, "samples", 9, (double)found->measured, "normals");
        figures_number(f, "error_999", 3, found->usual, "relative, of 99.9%");
        figures_number(f, "limit_999", 3, usual, "relative, of 99.9%");
        figures_number(f, "error_9999", 3, found->rare, "relative, of 99.99%");
        figures_number(f, "limit_9999", 3, rare, "relative, of 99.99%");
        figures_truth(f, "good", good);
    }
    return good;
}

static int check_consistency(figures *f, const vndf_distribution *distribution, unsigned long long seed)
{
    consistency found;
    if (!consistency_measure(distribution, 200000, seed, &found))
        return complain(name, "no memory");
    const consistency_point *at = &found.invalid_at;
    int good = found.invalid == 0;
    if (f->form == FIGURES_TEXT) {
        printf("consistency  %zu points (%zu see nothing), %zu invalid results %s\n", found.points, found.blind,
               found.invalid, verdict(good));
        if (!good) /* the numbers are exact enough to come to the same floats */
            printf("             at theta %.17g phi %.17g alpha %.9g,%.9g u1 %.9g u2 %.9g\n", at->theta, at->phi,
                   (double)at->alpha_x, (double)at->alpha_y, (double)at->u1, (double)at->u2);
    } else {
        figures_number(f, "points", 9, (double)found.points, "views");
        figures_number(f, "see_nothing", 9, (double)found.blind, "views");
        figures_number(f, "invalid", 9, (double)found.invalid, "views");
    }
    figures_list(f, "consistency");
    good &= check_quantiles(f, "pdf of samples, above horizon", &found.above, 1e-5, 1e-4);
    good &= check_quantiles(f, "pdf of samples, below horizon", &found.below, 1e-4, 1e-3);
    good &= check_quantiles(f, "invert, then sample", &found.inverted, 1e-5, 1e-4);
    figures_list_end(f);
    return good ? STATUS_GOOD : STATUS_NO;
}

/* ---- chi-square ---------------------------------------------------------------------------------- */

static const double angles[] = {0, 30, 60, 80, 89, 130};
static const float roughness[][2] = {{1, 1}, {0.05f, 0.4f}};

enum {
    ANGLES = sizeof angles / sizeof angles[0],
    ROUGHNESSES = sizeof roughness / sizeof roughness[0],
    TESTS = ANGLES * ROUGHNESSES
};

static void print_chi_square(figures *f, const chi_square *found, const vndf_surface *surface, double theta,
                             double phi, int good)
{
    char alpha[32];
    snprintf(alpha, sizeof alpha, "%gx%g", (double)surface->alpha_x, (double)surface->alpha_y);
    if (f->form != FIGURES_TEXT) {
        figures_record(f);
        figures_text(f, "alpha", alpha);
        figures_number(f, "theta", 9, theta, "degrees");
        figures_number(f, "phi", 9, phi, "degrees");
        figures_truth(f, "sees_nothing", found->blind);
        figures_number(f, "bins", 9, (double)found->bins, "bins");
        figures_number(f, "pooled", 9, (double)found->pooled, "bins");
        figures_number(f, "statistic", 6, found->blind ? NAN : found->statistic, "chi-square");
        figures_number(f, "p", 4, found->blind ? NAN : found->p, "probability");
        figures_number(f, "mass_error", 2, found->blind ? NAN : found->mass - 1, "of the mass");
        figures_number(f, "without_density", 9, (double)found->unclaimed, "samples");
        figures_truth(f, "good", good);
        return;
    }
    printf("chi-square   %-9s %5g %4g ", alpha, theta, phi);
    if (found->blind)
        printf("  sees nothing");
    else
        printf("%6zu %6zu %12.1f %9.4f %10.1e", found->bins, found->pooled, found->statistic, found->p,
               found->mass - 1);
    if (found->unclaimed && !found->blind)
        printf(" %zu samples have no density", found->unclaimed);
    printf(" %s\n", verdict(good));
}

/* Below the horizon a narrow lobe may hold less than a float can tell from nothing. */
static int is_good(const chi_square *found, const vndf_surface *surface, vndf_vec3 wi)
{
    if (found->blind)
        return sees_nothing(surface, wi);
    return found->p >= statistics_sidak(0.01, TESTS) && fabs(found->mass - 1) <= 1e-5 && found->unclaimed == 0;
}

static int check_view(figures *f, const vndf_surface *surface, double theta, double phi, size_t samples,
                      unsigned long long seed)
{
    chi_square found;
    vndf_vec3 wi = direction_from(theta, phi);
    if (!chi_square_test(surface, wi, samples, seed, &found))
        return complain(name, "no memory");
    int good = is_good(&found, surface, wi);
    print_chi_square(f, &found, surface, theta, phi, good);
    return good ? STATUS_GOOD : STATUS_NO;
}

static int check_chi_square(figures *f, progress *p, const vndf_distribution *distribution, size_t samples,
                            unsigned long long seed)
{
    int worst = STATUS_GOOD;
    if (f->form == FIGURES_TEXT) {
        printf("chi-square   %zu samples per test, significance %.3g each; degrees\n", samples,
               statistics_sidak(0.01, TESTS));
        printf("             alpha     theta  phi   bins pooled    statistic         p     mass-1\n");
    }
    figures_list(f, "chi_square");
    for (size_t r = 0; r < ROUGHNESSES && worst != STATUS_USE; r++) {
        vndf_surface surface = {distribution, roughness[r][0], roughness[r][1]};
        double phi = surface.alpha_x == surface.alpha_y ? 0 : 25;
        for (size_t a = 0; a < ANGLES && worst != STATUS_USE; a++) {
            progress_show((double)(r * ANGLES + a) / TESTS, "chi-square", p);
            int status = check_view(f, &surface, angles[a], phi, samples, seed + 1000 * (r * ANGLES + a + 1));
            worst = status == STATUS_GOOD ? worst : status;
        }
    }
    figures_list_end(f);
    return worst;
}

/* ---- hard ---------------------------------------------------------------------------------------- */

static int check_property(figures *f, stress_id id, const stress_finding *found)
{
    const stress_property *property = stress_property_of(id);
    const stress_point *at = &found->at;
    const vndf_affine *m = &at->surface;
    int good = found->failed == 0;
    if (f->form != FIGURES_TEXT) {
        figures_record(f);
        figures_text(f, "property", property->name);
        figures_text(f, "meaning", property->meaning);
        figures_number(f, "worst", 3, fmax(found->worst, 0), "as meant");
        figures_number(f, "limit", 3, property->limit, "as meant");
        figures_number(f, "points", 9, (double)found->checked, "samples");
        figures_number(f, "failed", 9, (double)found->failed, "samples");
        figures_truth(f, "good", good);
        return good;
    }
    printf("hard         %-9s worst %-9.3g of %-5.3g at %7zu points: %s ", property->name, fmax(found->worst, 0),
           property->limit, found->checked, property->meaning);
    if (!good)
        printf("%zu ", found->failed);
    puts(verdict(good));
    if (found->worst > 0) /* nine digits bring back every float */
        printf("             at matrix %.9g,%.9g,%.9g,%.9g mean %.9g,%.9g wi %.9g,%.9g,%.9g u %.9g,%.9g wo "
               "%.9g,%.9g,%.9g\n",
               (double)m->xx, (double)m->xy, (double)m->yx, (double)m->yy, (double)m->mean_x, (double)m->mean_y,
               (double)at->wi.x, (double)at->wi.y, (double)at->wi.z, (double)at->u1, (double)at->u2,
               (double)at->wo.x, (double)at->wo.y, (double)at->wo.z);
    return good;
}

static int check_hard(figures *f, const vndf_distribution *distribution, unsigned long long seed)
{
    stress_result result = stress_run(distribution, 1, 40000, seed);
    int good = 1;
    if (f->form == FIGURES_TEXT) {
        printf("hard         %zu samples of %zu views", result.samples, result.views);
        if (result.outside)
            printf("; %zu roughnesses left out: alpha times the scale must be within 1e-18 and 1e18",
                   result.outside);
        putchar('\n');
    }
    figures_list(f, "hard");
    for (int id = 0; id < STRESS_COUNT; id++)
        good &= check_property(f, (stress_id)id, &result.found[id]);
    figures_list_end(f);
    return good ? STATUS_GOOD : STATUS_NO;
}

/* ---- the command --------------------------------------------------------------------------------- */

/* Of all the time that a table takes, roughly: the certificate, consistency, chi-square. */
static const double after_certificate = 0.05, after_consistency = 0.2;

static int check_all(const chosen_distribution *chosen, const check_words *given)
{
    unsigned long long samples = 1000000, seed = 1;
    if (!option_count(name, "--samples", &given->samples, 1000, 1e10, &samples) ||
        !option_count(name, "--seed", &given->seed, 0, 0x1p53, &seed))
        return STATUS_USE;
    if (!chosen->owned && given->csv.count)
        return complain(name, "--csv is for tables; a closed form was not made of a CSV");
    figures f = figures_begin(&given->figures);
    progress p = progress_begin("checking", 0);
    p.is_seen &= !given->figures.quiet.count;
    int status[4] = {STATUS_GOOD, STATUS_GOOD, STATUS_GOOD, STATUS_GOOD}, good = 1;
    progress_step(&p, after_certificate);
    progress_show(0, "the certificate", &p);
    if (chosen->owned)
        status[0] = check_certificate(&f, chosen->owned, only_word(&given->csv));
    progress_step(&p, after_consistency);
    progress_show(0, "consistency", &p);
    if (status[0] != STATUS_USE)
        status[1] = check_consistency(&f, chosen->distribution, seed);
    progress_step(&p, 1);
    if (status[0] != STATUS_USE && status[1] != STATUS_USE)
        status[2] = check_chi_square(&f, &p, chosen->distribution, (size_t)samples, seed);
    if (given->hard.count && status[0] != STATUS_USE && status[2] != STATUS_USE)
        status[3] = check_hard(&f, chosen->distribution, seed);
    progress_end(&p);
    for (int i = 0; i < 4; i++) {
        if (status[i] == STATUS_USE)
            return STATUS_USE;
        good &= status[i] == STATUS_GOOD;
    }
    figures_text(&f, "result", verdict(good));
    figures_end(&f);
    return good ? STATUS_GOOD : STATUS_NO;
}

int command_check(int argc, char **argv)
{
    check_words given = {0};
    words positional = {{NULL}, 0};
    chosen_distribution chosen;
    const option_form options[] = {{"--samples", 1, 1, &given.samples},
                                   {"--csv", 1, 1, &given.csv},
                                   {"--seed", 1, 1, &given.seed},
                                   {"--hard", 0, 1, &given.hard},
                                   FIGURES_OPTIONS(given.figures)};
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "FILE|ggx|beckmann", 1, 1};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (!distribution_open(&chosen, name, only_word(&positional)))
        return STATUS_USE;
    int status = check_all(&chosen, &given);
    distribution_close(&chosen);
    return status;
}
