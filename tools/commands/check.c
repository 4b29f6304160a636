/* vndf check: is a distribution what it claims to be? Four lists of findings:
 *   certificate  measured again against the source, compared with what the table says;
 *   consistency  sample, pdf and invert agree with each other (stress.h);
 *   chi-square   samples follow the density that they claim (chi_square.h), over a grid of views;
 *   hard         the calls keep their promises for the hardest input that is valid (stress.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/figures.h"
#include "cli/progress.h"
#include "cli/source_words.h"
#include "cli/subject.h"
#include "command.h"
#include "evidence/measure/chi_square.h"
#include "evidence/measure/statistics.h"
#include "evidence/measure/stress.h"
#include "vndf_build.h"

static const char name[] = "vndf check";

static const char *const help[] = {
    "usage: vndf check FILE|ggx|beckmann [--hard] [--samples N] [--csv FILE] [--seed S]\n"
    "\n"
    "Measures a distribution again and prints what it finds; exit status 1 if a claim fails.\n"
    "\n"
    "  certificate  the numbers stored in the table against a new measurement from its source; more than\n"
    "               20% (and 1e-7) worse fails. Closed forms have none.\n"
    "  consistency  at 200000 random views (0 to 180 degrees, roughness 0.02 to 1) where the projected area exceeds\n"
    "               1e-12: pdf gives the density that sample returned within 1e-5 for 99.9% and 1e-4 for 99.99%\n"
    "               of the samples above the horizon, 1e-4 and 1e-3 below it (left out where D is steeper than\n"
    "               in a lobe of a tenth of its slope); and invert, then sample, gives the normal within 1e-5\n"
    "               for 99.9% and 1e-4 for 99.99%, slopes over roughness, or its numbers come back within 8\n"
    "               steps of 2^-24.\n"
    "  chi-square   N samples per view against the density integrated over 130 x 65 bins, at 0, 30, 60, 80, 89\n"
    "               and 130 degrees, roughness 1 and 0.05 x 0.4 (azimuth 25 degrees). The bins divide the\n"
    "               hemisphere stretched to the lobe, half of their borders evenly, half at quantiles; bins\n"
    "               of expected count < 5 are pooled. Significance 0.01 for all tests together (Sidak); and\n"
    "               the density has to integrate to 1 within 1e-5 and what one rounding of normals, 2^-23 of\n"
    "               their slope, may add: 1e-3 for a ring of width 1e-4.\n"
    "  hard         normals are unit, above the surface and face the incident direction, densities are positive,\n"
    "               masking is what it has to be. Directions at, beside and below the normal, the horizon and\n"
    "               straight down; roughness 1e-8 to 1e4, ratios up to 1e8; uniform numbers 0, the least float,\n"
    "               1/2 and its neighbours, 1 - 2^-24, 1. Then surfaces with a random matrix (condition up to\n"
    "               1e4, either sign) and a mean slope up to 2. For each property the worst value, its limit,\n"
    "               and the input that gave it.\n"
    "\n"
    "  --hard       2.5 million samples of hard cases in the place of 150000\n"
    "  --samples N  samples per chi-square test (default 1000000)\n"
    "  --csv FILE   the CSV that the table was built from; without it the certificate is not measured again\n"
    "  --seed S     the stream of random numbers, a whole number (default 1)\n"
    "\n"
    "example: vndf check wavy.vndf --hard --samples 4000000\n",
    NULL};

/* What is being checked, where findings go, and whether all were good. */
typedef struct checking {
    const vndf_distribution *distribution;
    figures to;
    progress bar;
    unsigned long long samples, seed;
    int good;
} checking;

/* The next part of the work, up to `until` of all of it. */
static void part(checking *c, const char *what, double until)
{
    progress_step(&c->bar, until);
    progress_show(0, what, &c->bar);
}

/* Ends a finding. */
static void judge(checking *c, int is_good)
{
    figures_truth(&c->to, "good", is_good);
    c->good &= is_good;
}

/* A number of a finding; nine digits bring back every float. */
static void tell(checking *c, const char *key, double x)
{
    figures_number(&c->to, key, 9, x, "");
}

static void begin(checking *c, const char *what)
{
    figures_record(&c->to);
    figures_text(&c->to, "of", what);
}

/* ---- certificate --------------------------------------------------------------------------------- */

/* A number may be a fifth worse than stored, above what it is when nothing is wrong: 0 for an error, 1 for a
 * ratio. */
static void compare(checking *c, const char *what, float stored, float measured, double floor)
{
    begin(c, what);
    figures_number(&c->to, "stored", 5, (double)stored, "");
    figures_number(&c->to, "measured", 5, (double)measured, "");
    judge(c, (double)measured <= floor + 1.2 * ((double)stored - floor) + 1e-7);
}

/* What the table was built from; NULL with the reason said if that cannot be had. */
static vndf_source *original_source(checking *c, const char *csv, int *failed)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = csv ? source_from_csv(name, csv) : vndf_source_of(c->distribution, &error);
    *failed = !source && (csv || error.status != VNDF_ERROR_ARGUMENT);
    if (*failed && !csv)
        complain(name, "%s", error.message);
    else if (!source && !csv)
        figures_text(&c->to, "certificate_not_measured", error.message);
    return source;
}

static int check_certificate(checking *c, const char *csv)
{
    vndf_certificate m, s = vndf_distribution_info(c->distribution).certificate;
    vndf_error error = {VNDF_OK, ""};
    int failed;
    vndf_source *source = original_source(c, csv, &failed);
    if (!source)
        return failed ? STATUS_USE : STATUS_GOOD;
    part(c, "certificate", 0.2);
    vndf_status status = vndf_certify(c->distribution, source, &m, &error);
    if (status == VNDF_OK &&
        strcmp(vndf_source_description(source), vndf_distribution_info(c->distribution).source) != 0)
        figures_text(&c->to, "certificate_measured_of", vndf_source_description(source));
    vndf_source_free(source);
    if (status != VNDF_OK)
        return complain(name, "%s", error.message);
    figures_list(&c->to, "certificate");
    compare(c, "tv", s.tv, m.tv, 0);
    compare(c, "tv_above", s.tv_above, m.tv_above, 0);
    compare(c, "max_weight", s.max_weight, m.max_weight, 1);
    compare(c, "area_error", s.area_error, m.area_error, 0);
    compare(c, "consistency", s.consistency, m.consistency, 0);
    compare(c, "ndf_error", s.ndf_error, m.ndf_error, 0);
    compare(c, "weight_unbound", 1 - s.weight_bounded, 1 - m.weight_bounded, 0);
    compare(c, "hidden", s.hidden, m.hidden, 0);
    compare(c, "finest", s.finest, m.finest, 0);
    figures_list_end(&c->to);
    return STATUS_GOOD;
}

/* ---- consistency --------------------------------------------------------------------------------- */

static int check_consistency(checking *c)
{
    static const struct {
        const char *name;
        double usual, rare;
    } limits[STRESS_AGREEMENTS] = {[STRESS_ABOVE_HORIZON] = {"pdf against sample, above the horizon", 1e-5, 1e-4},
                                   [STRESS_BELOW_HORIZON] = {"pdf against sample, below the horizon", 1e-4, 1e-3},
                                   [STRESS_INVERTED] = {"invert, then sample", 1e-5, 1e-4}};
    stress_agreement found[STRESS_AGREEMENTS];
    part(c, "consistency", 0.3);
    if (!stress_agree(c->distribution, 200000, c->seed, found))
        return complain(name, "no memory");
    figures_list(&c->to, "consistency");
    for (int i = 0; i < STRESS_AGREEMENTS; i++) {
        begin(c, limits[i].name);
        figures_number(&c->to, "samples", 9, (double)found[i].measured, "");
        figures_number(&c->to, "most_999", 2, found[i].usual, "");
        figures_number(&c->to, "limit_999", 2, limits[i].usual, "");
        figures_number(&c->to, "most_9999", 2, found[i].rare, "");
        figures_number(&c->to, "limit_9999", 2, limits[i].rare, "");
        judge(c, found[i].usual <= limits[i].usual && found[i].rare <= limits[i].rare);
    }
    figures_list_end(&c->to);
    return STATUS_GOOD;
}

/* ---- chi-square ---------------------------------------------------------------------------------- */

static const double angles[] = {0, 30, 60, 80, 89, 130};
static const float roughness[][2] = {{1, 1}, {0.05f, 0.4f}};

enum { ANGLES = sizeof angles / sizeof angles[0], TESTS = 2 * ANGLES };

static double mass_limit(const chi_square *found)
{
    return 1e-5 + found->mass_rounding;
}

/* Below the horizon a narrow lobe may hold less than a float can tell from nothing. */
static int is_good(const chi_square *found, const vndf_surface *surface, vndf_vec3 wi)
{
    if (found->blind)
        return sees_nothing(surface, wi);
    return found->p >= statistics_sidak(0.01, TESTS) && fabs(found->mass - 1) <= mass_limit(found) &&
           found->unclaimed == 0;
}

static int check_chi_square(checking *c)
{
    part(c, "chi-square", 0.8);
    figures_number(&c->to, "chi_square_samples", 9, (double)c->samples, "");
    figures_number(&c->to, "chi_square_level", 3, statistics_sidak(0.01, TESTS), "");
    figures_list(&c->to, "chi_square");
    for (size_t i = 0; i < TESTS; i++) {
        const vndf_surface surface = {c->distribution, roughness[i / ANGLES][0], roughness[i / ANGLES][1]};
        double theta = angles[i % ANGLES], phi = i < ANGLES ? 0 : 25;
        vndf_vec3 wi = direction_from(theta, phi);
        chi_square found;
        progress_show((double)i / TESTS, "chi-square", &c->bar);
        if (!chi_square_test(&surface, wi, (size_t)c->samples, c->seed + 1000 * (i + 1), &found))
            return complain(name, "no memory");
        figures_record(&c->to);
        figures_number(&c->to, "alpha_x", 3, (double)surface.alpha_x, "");
        figures_number(&c->to, "alpha_y", 3, (double)surface.alpha_y, "");
        figures_number(&c->to, "theta", 3, theta, "degrees");
        if (found.blind)
            figures_truth(&c->to, "blind", 1);
        tell(c, "bins", (double)found.bins);
        figures_number(&c->to, "p", 4, found.p, "");
        figures_number(&c->to, "mass_error", 2, found.blind ? 0 : found.mass - 1, "");
        figures_number(&c->to, "mass_limit", 2, mass_limit(&found), "");
        if (found.unclaimed)
            tell(c, "unclaimed", (double)found.unclaimed);
        judge(c, is_good(&found, &surface, wi));
    }
    figures_list_end(&c->to);
    return STATUS_GOOD;
}

/* ---- hard ---------------------------------------------------------------------------------------- */

static void check_hard(checking *c, int is_whole)
{
    static const char *const keys[] = {"xx",   "xy",   "yx",   "yy",   "mean_x", "mean_y", "wi_x",
                                       "wi_y", "wi_z", "wo_x", "wo_y", "wo_z",   "u1",     "u2"};
    part(c, "hard cases", 1);
    stress_result result = stress_run(c->distribution, is_whole ? 1 : 19, is_whole ? 40000 : 4000, c->seed);
    figures_number(&c->to, "hard_samples", 9, (double)result.samples, "");
    figures_number(&c->to, "hard_views", 9, (double)result.views, "");
    figures_number(&c->to, "hard_views_left_out", 9, (double)result.outside, "");
    figures_list(&c->to, "hard");
    for (int id = 0; id < STRESS_COUNT; id++) {
        const stress_property *property = &stress_properties[id];
        const stress_finding *found = &result.found[id];
        const vndf_affine *m = &found->at.surface;
        const float at[] = {m->xx,          m->xy,          m->yx,          m->yy,          m->mean_x,
                            m->mean_y,      found->at.wi.x, found->at.wi.y, found->at.wi.z, found->at.wo.x,
                            found->at.wo.y, found->at.wo.z, found->at.u1,   found->at.u2};
        begin(c, property->name);
        figures_text(&c->to, "is", property->meaning);
        figures_number(&c->to, "worst", 3, fmax(found->worst, 0), "");
        figures_number(&c->to, "limit", 3, property->limit, "");
        tell(c, "points", (double)found->checked);
        tell(c, "failed", (double)found->failed);
        for (int i = 0; i < 14 && found->failed; i++)
            tell(c, keys[i], (double)at[i]);
        judge(c, found->failed == 0);
    }
    figures_list_end(&c->to);
}

/* ---- the command --------------------------------------------------------------------------------- */

static int check_all(const chosen_distribution *chosen, const arguments *given)
{
    checking c = {.distribution = chosen->distribution, .samples = 1000000, .seed = 1, .good = 1};
    const char *csv = option_value(given, "--csv");
    if (!option_count(given, "--samples", 1000, 1e10, &c.samples) ||
        !option_count(given, "--seed", 0, 0x1p53, &c.seed))
        return STATUS_USE;
    if (!chosen->owned && csv)
        return complain(name, "--csv is for tables; a closed form was not made of a CSV");
    c.to = figures_begin(given);
    c.bar = progress_begin(name, option_value(given, "-q") != NULL);
    int failed = (chosen->owned && check_certificate(&c, csv) != STATUS_GOOD) ||
                 check_consistency(&c) != STATUS_GOOD || check_chi_square(&c) != STATUS_GOOD;
    if (!failed)
        check_hard(&c, option_value(given, "--hard") != NULL);
    progress_end(&c.bar);
    if (failed)
        return STATUS_USE;
    figures_text(&c.to, "result", c.good ? "good" : "FAILED");
    figures_end(&c.to);
    return c.good ? STATUS_GOOD : STATUS_NO;
}

static int run(const arguments *given)
{
    chosen_distribution chosen;
    if (!distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    int status = check_all(&chosen, given);
    distribution_close(&chosen);
    return status;
}

const subcommand command_check = {
    name, "measure a table again; exit 1 if a claim fails", "FILE|ggx|beckmann", 1, 1, run, help};
