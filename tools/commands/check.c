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
#include "cli/progress.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "evidence/measure/statistics.h"
#include "evidence/measure/stress.h"
#include "vndf_build.h"

static const char name[] = "vndf check";

static const char help[] =
    "usage: vndf check FILE|ggx|beckmann [--hard] [--samples N] [--csv FILE] [--seed S]\n"
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
    "  --seed S     the stream of random numbers, a whole number (default 1)\n"
    "\n"
    "example: vndf check wavy.vndf --hard --samples 4000000\n";

typedef struct check_words {
    words samples, csv, seed, hard;
} check_words;

static const char *verdict(int good)
{
    return good ? "good" : "FAILED";
}

/* ---- certificate --------------------------------------------------------------------------------- */

/* floor: what the number is when nothing is wrong, 0 for an error, 1 for a ratio; factor: how much worse it may
 * be. */
static int compare(const char *what, float stored, float measured, double floor, double factor)
{
    double allowed = floor + factor * ((double)stored - floor) + 1e-7;
    int good = (double)measured <= allowed;
    printf("certificate  %-14s stored %-12.5g measured %-12.5g %s\n", what, (double)stored, (double)measured,
           verdict(good));
    return good;
}

static int compare_certificates(const vndf_certificate *stored, const vndf_certificate *measured)
{
    const double factor = 1.2;
    int good = compare("tv", stored->tv, measured->tv, 0, factor);
    good &= compare("tv_above", stored->tv_above, measured->tv_above, 0, factor);
    good &= compare("max_weight", stored->max_weight, measured->max_weight, 1, factor);
    good &= compare("area_error", stored->area_error, measured->area_error, 0, factor);
    good &= compare("consistency", stored->consistency, measured->consistency, 0, factor);
    good &= compare("ndf_error", stored->ndf_error, measured->ndf_error, 0, factor);
    good &= compare("weight_unbound", 1 - stored->weight_bounded, 1 - measured->weight_bounded, 0, factor);
    good &= compare("hidden", stored->hidden, measured->hidden, 0, factor);
    good &= compare("finest", stored->finest, measured->finest, 0, factor);
    return good;
}

/* What the table was built from; NULL with the reason printed if that cannot be had. */
static vndf_source *original_source(const vndf_distribution *table, const char *csv, int *failed)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = csv ? source_from_csv(name, csv) : vndf_source_of(table, &error);
    *failed = !source && (csv || error.status != VNDF_ERROR_ARGUMENT);
    if (*failed && !csv)
        complain(name, "%s", error.message);
    else if (!source && !csv)
        printf("certificate  not measured again: %s\n", error.message);
    return source;
}

static int check_certificate(const vndf_distribution *table, const char *csv)
{
    vndf_certificate measured;
    vndf_error error = {VNDF_OK, ""};
    int failed;
    vndf_info info = vndf_distribution_info(table);
    vndf_source *source = original_source(table, csv, &failed);
    if (!source)
        return failed ? STATUS_USE : STATUS_GOOD;
    if (csv && strcmp(vndf_source_description(source), info.source) != 0)
        printf("certificate  note: the table says %s\n             and the source is %s\n", info.source,
               vndf_source_description(source));
    vndf_status status = vndf_certify(table, source, &measured, &error);
    vndf_source_free(source);
    if (status != VNDF_OK)
        return complain(name, "%s", error.message);
    return compare_certificates(&info.certificate, &measured) ? STATUS_GOOD : STATUS_NO;
}

/* ---- consistency --------------------------------------------------------------------------------- */

/* Where to look; the numbers are exact enough to come to the same floats. */
static int finish_line(int good, const consistency_point *at)
{
    puts(verdict(good));
    if (!good)
        printf("             at theta %.17g phi %.17g alpha %.9g,%.9g u1 %.9g u2 %.9g\n", at->theta, at->phi,
               (double)at->alpha_x, (double)at->alpha_y, (double)at->u1, (double)at->u2);
    return good;
}

static int check_quantiles(const char *what, const consistency_quantiles *found, double usual, double rare)
{
    int good = found->usual <= usual && found->rare <= rare;
    printf("consistency  %s: 99.9%% within %.2g of %g, 99.99%% within %.2g of %g, %zu samples %s\n", what,
           found->usual, usual, found->rare, rare, found->measured, verdict(good));
    return good;
}

static int check_consistency(const vndf_distribution *distribution, unsigned long long seed)
{
    consistency found;
    if (!consistency_measure(distribution, 200000, seed, &found))
        return complain(name, "no memory");
    printf("consistency  %zu points (%zu see nothing), %zu invalid results ", found.points, found.blind,
           found.invalid);
    int good = finish_line(found.invalid == 0, &found.invalid_at);
    good &= check_quantiles("pdf against sample, above the horizon", &found.above, 1e-5, 1e-4);
    good &= check_quantiles("pdf against sample, below the horizon", &found.below, 1e-4, 1e-3);
    good &= check_quantiles("invert, then sample", &found.inverted, 1e-5, 1e-4);
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

static void print_chi_square(const chi_square *found, const vndf_surface *surface, double theta, double phi,
                             int good)
{
    char alpha[32];
    snprintf(alpha, sizeof alpha, "%gx%g", (double)surface->alpha_x, (double)surface->alpha_y);
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

static int check_view(const vndf_surface *surface, double theta, double phi, size_t samples,
                      unsigned long long seed)
{
    chi_square found;
    vndf_vec3 wi = direction_from(theta, phi);
    if (!chi_square_test(surface, wi, samples, seed, &found))
        return complain(name, "no memory");
    int good = is_good(&found, surface, wi);
    print_chi_square(&found, surface, theta, phi, good);
    return good ? STATUS_GOOD : STATUS_NO;
}

static int check_chi_square(const vndf_distribution *distribution, size_t samples, unsigned long long seed)
{
    int worst = STATUS_GOOD;
    progress p = progress_begin("chi-square", 0);
    printf("chi-square   %zu samples per test, significance %.3g each\n", samples, statistics_sidak(0.01, TESTS));
    printf("             alpha     theta  phi   bins pooled    statistic         p     mass-1\n");
    for (size_t r = 0; r < ROUGHNESSES; r++) {
        vndf_surface surface = {distribution, roughness[r][0], roughness[r][1]};
        double phi = surface.alpha_x == surface.alpha_y ? 0 : 25;
        for (size_t a = 0; a < ANGLES; a++) {
            progress_show((double)(r * ANGLES + a) / TESTS, NULL, &p);
            int status = check_view(&surface, angles[a], phi, samples, seed + 1000 * (r * ANGLES + a + 1));
            if (status == STATUS_USE)
                return status;
            if (status == STATUS_NO)
                worst = status;
        }
    }
    progress_end(&p);
    return worst;
}

/* ---- hard ---------------------------------------------------------------------------------------- */

static int check_property(stress_id id, const stress_finding *found)
{
    const stress_property *property = stress_property_of(id);
    const stress_point *at = &found->at;
    const vndf_affine *m = &at->surface;
    int good = found->failed == 0;
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

static int check_hard(const vndf_distribution *distribution, unsigned long long seed)
{
    stress_result result = stress_run(distribution, 1, 40000, seed);
    int good = 1;
    printf("hard         %zu samples of %zu views", result.samples, result.views);
    if (result.outside)
        printf("; %zu roughnesses left out: alpha times the scale must be within 1e-18 and 1e18", result.outside);
    putchar('\n');
    for (int id = 0; id < STRESS_COUNT; id++)
        good &= check_property((stress_id)id, &result.found[id]);
    return good ? STATUS_GOOD : STATUS_NO;
}

/* ---- the command --------------------------------------------------------------------------------- */

static int check_all(const chosen_distribution *chosen, const check_words *given)
{
    unsigned long long samples = 1000000, seed = 1;
    if (!option_count(name, "--samples", &given->samples, 1000, 1e10, &samples) ||
        !option_count(name, "--seed", &given->seed, 0, 0x1p53, &seed))
        return STATUS_USE;
    int certificate = STATUS_GOOD;
    if (chosen->owned)
        certificate = check_certificate(chosen->owned, only_word(&given->csv));
    else if (given->csv.count)
        return complain(name, "--csv is for tables; a closed form was not made of a CSV");
    if (certificate == STATUS_USE)
        return STATUS_USE;
    int consistent = check_consistency(chosen->distribution, seed);
    int follows = check_chi_square(chosen->distribution, (size_t)samples, seed);
    if (consistent == STATUS_USE || follows == STATUS_USE)
        return STATUS_USE;
    int hard = given->hard.count ? check_hard(chosen->distribution, seed) : STATUS_GOOD;
    int good =
        certificate == STATUS_GOOD && consistent == STATUS_GOOD && follows == STATUS_GOOD && hard == STATUS_GOOD;
    printf("result %s\n", verdict(good));
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
                                   {"--hard", 0, 1, &given.hard}};
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
