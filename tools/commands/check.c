/* vndf check: is a distribution what it claims to be? Four lists of findings:
 *   certificate  what the table says, measured again beside its source, not by the library (laws.c);
 *   consistency  sample, pdf and invert agree with each other;
 *   chi-square   samples follow the density that they claim, over bins (bins.c), at some views;
 *   hard         the calls keep their promises for the hardest input that is valid (stress.c). */
#include <math.h>
#include <string.h>

#include "cli/progress.h"
#include "cli/random.h"
#include "cli/sort.h"
#include "command.h"
#include "commands/parts/describe.h"
#include "evidence/measure/measure.h"

static const char name[] = "vndf check";

static const char *const help[] = {
    "usage: vndf check FILE|ggx|beckmann [--hard] [--samples N] [--csv FILE] [--seed S]\n"
    "\n"
    "Measures a distribution again and prints what it finds; exit status 1 if a claim fails.\n"
    "\n"
    "  certificate  the numbers stored in the table against quadrature of their own: pdf, D and areas of the table\n"
    "               beside its source, from some hundred directions on both sides of the horizon where more than\n"
    "               1e-10 of the area is left; more than a tenth, or 2e-5, worse fails. Slopes within 1e-6 of a\n"
    "               jump are left out. Closed forms have no certificate.\n"
    "  consistency  at 200000 random views (0 to 180 degrees, roughness 0.02 to 1) where the projected area exceeds\n"
    "               1e-12: pdf gives the density that sample returned within 1e-5 for 99.9% and 1e-4 for 99.99%\n"
    "               of the samples above the horizon, 1e-4 and 1e-3 below it (left out where D is steeper than\n"
    "               in a lobe of a tenth of its slope); and invert, then sample, gives the normal within 1e-5\n"
    "               for 99.9% and 1e-4 for 99.99%, slopes over roughness, or its numbers come back within 8\n"
    "               steps of 2^-24.\n"
    "  chi-square   N samples per view against the density integrated over 65 x 48 bins, at 0, 30, 60, 80, 89\n"
    "               and 130 degrees, roughness 1 and 0.05 x 0.4 (azimuth 25 degrees). The bins divide the\n"
    "               slopes over roughness, a fifth of their borders evenly, the others at quantiles, and at each\n"
    "               the azimuths that are seen, evenly; bins of expected count < 5 are pooled. Significance 0.01\n"
    "               for all tests together (Sidak); and the density has to integrate to 1 within 1e-4, what the\n"
    "               quadrature may err, some 2e-6, and what one rounding of normals, 2^-23 of their slope, may\n"
    "               add: 1e-3 for a ring of width 1e-4.\n"
    "  hard         normals are unit, above the surface and face the incident direction, densities are positive,\n"
    "               masking is what it has to be. Directions at, beside and below the normal, the horizon and\n"
    "               straight down; roughness 1e-8 to 1e4, ratios up to 1e8; uniform numbers 0, the least float,\n"
    "               1/2 and its neighbours, 1 - 2^-24, 1. For each property the worst value, its limit, and\n"
    "               the input that gave it.\n"
    "\n"
    "  --hard       1.9 million samples of hard cases in the place of 100000\n"
    "  --samples N  samples per chi-square test (default 1000000)\n"
    "  --csv FILE   the CSV that the table was built from; without it the certificate is not measured again\n"
    "  --seed S     the stream of random numbers, a whole number (default 1)\n"
    "\n"
    "example: vndf check wavy.vndf --hard --samples 4000000\n",
    NULL};

typedef struct checking {
    const vndf_distribution *distribution;
    figures to;
    progress bar;
    unsigned long long samples, seed;
    int good;
} checking;

static void part(checking *c, const char *what, double until)
{
    progress_step(&c->bar, until);
    progress_show(0, what, &c->bar);
}

static void judge(checking *c, int is_good)
{
    figures_truth(&c->to, "good", is_good);
    c->good &= is_good;
}

static void tell(checking *c, const char *key, const char *format, double x)
{
    figures_number(&c->to, key, format, x, "");
}

static void begin(checking *c, const char *what)
{
    figures_record(&c->to);
    figures_text(&c->to, "of", what);
}

static int check_certificate(checking *c, const char *csv)
{
    const vndf_info info = vndf_distribution_info(c->distribution);
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = csv ? source_from_csv(name, csv) : vndf_source_of(c->distribution, &error);
    laws_figure found[LAWS_FIGURES];
    if (!source && csv)
        return STATUS_USE;
    if (!source && error.status == VNDF_ERROR_ARGUMENT) {
        figures_text(&c->to, "certificate_not_measured", error.message);
        return STATUS_GOOD;
    }
    part(c, "certificate", 0.5);
    if (source && strcmp(vndf_source_description(source), info.source) != 0)
        figures_text(&c->to, "certificate_measured_of", vndf_source_description(source));
    const int done = source && laws_measure(c->distribution, source, 4, progress_show, &c->bar, found);
    vndf_source_free(source);
    if (!done)
        return complain(name, "%s", source ? "no memory" : error.message);
    figures_list(&c->to, "certificate");
    for (int i = 0; i < LAWS_FIGURES; i++) {
        begin(c, found[i].name);
        tell(c, "stored", "%.5g", found[i].stored);
        tell(c, "measured", "%.5g", found[i].measured);
        if (i != LAWS_NDF_ERROR)
            figures_number(&c->to, "theta", "%.9g", found[i].theta, "degrees");
        judge(c, found[i].good);
    }
    figures_list_end(&c->to);
    return STATUS_GOOD;
}

/* The density of the normal whose slopes are those of wm by a factor. */
static double pdf_beside(const vndf_view *view, vndf_vec3 wm, float factor)
{
    const float x = factor * wm.x, y = factor * wm.y, per = 1 / sqrtf(x * x + y * y + wm.z * wm.z);
    return (double)vndf_pdf(view, (vndf_vec3){x * per, y * per, wm.z * per});
}

/* One rounding of a normal changes the density by as much as it varies there: a lobe a tenth of its slope wide has
 * some 20 for d log pdf / d log r. It is asked closely, since there may be waves, and not so closely. */
static int is_steep(const vndf_view *view, vndf_vec3 wm)
{
    static const float near[2] = {0x1p-12f, 0x1p-7f};
    for (int i = 0; i < 2; i++) {
        const double high = pdf_beside(view, wm, 1 + near[i]), low = pdf_beside(view, wm, 1 - near[i]);
        if (!(high > 0 && low > 0 && fabs(log(high / low)) < 20 * 2 * (double)near[i]))
            return 1;
    }
    return 0;
}

/* 0 if the numbers come back within 8 steps of 2^-24: near the ends of heavy tails one such step moves the normal
 * farther. */
static double inverts(const vndf_view *view, const bins_frame *f, float u1, float u2, vndf_vec3 wm)
{
    float v1, v2;
    vndf_invert(view, wm, &v1, &v2);
    if (!(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1))
        return HUGE_VAL;
    if (fmaxf(fabsf(v1 - u1), fabsf(v2 - u2)) <= 8 * 0x1p-24f)
        return 0;
    const double apart = bins_apart(f, wm, vndf_sample(view, v1, v2, NULL));
    return isnan(apart) ? HUGE_VAL : apart; /* NaN has no order */
}

/* Do sample, pdf and invert agree? What 99.9% and 99.99% of the differences do not exceed. Angles are uniform, not the
 * sphere: grazing and steep directions are where things break. */
static int check_consistency(checking *c)
{
    enum { ABOVE, BELOW, INVERTED, AGREEMENTS, POINTS = 200000 };
    static const struct {
        const char *name;
        double most[2];
    } limits[AGREEMENTS] = {[ABOVE] = {"pdf against sample, above the horizon", {1e-5, 1e-4}},
                            [BELOW] = {"pdf against sample, below the horizon", {1e-4, 1e-3}},
                            [INVERTED] = {"invert, then sample", {1e-5, 1e-4}}};
    const double scale = vndf_distribution_info(c->distribution).scale, per = scale > 0 ? 1 / scale : 1;
    double(*differs)[POINTS] = malloc(AGREEMENTS * sizeof *differs);
    size_t count[AGREEMENTS] = {0};
    random_stream stream = random_from(c->seed);
    if (!differs)
        return complain(name, "no memory");
    part(c, "consistency", 0.6);
    for (int i = 0; i < POINTS; i++) {
        const double theta = 180 * random_double(&stream), phi = 360 * random_double(&stream);
        const double x = pow(0.02, random_double(&stream)), y = pow(0.02, random_double(&stream));
        const float u1 = random_float(&stream), u2 = random_float(&stream);
        const vndf_surface surface = vndf_rough(c->distribution, (float)(x * per), (float)(y * per));
        const vndf_vec3 wi = direction_from(theta, phi);
        const int side = wi.z >= 0 ? ABOVE : BELOW;
        if (vndf_projected_area(&surface, wi) < 1e-12f)
            continue; /* certificates do not measure there either: the whole lobe is the far end of a tail */
        float pdf;
        const bins_frame f = bins_frame_of(&surface, wi);
        const vndf_view view = vndf_view_from(&surface, wi);
        const vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        differs[INVERTED][count[INVERTED]++] = inverts(&view, &f, u1, u2, wm);
        if (!is_steep(&view, wm))
            differs[side][count[side]++] = fabs((double)vndf_pdf(&view, wm) / (double)pdf - 1);
    }
    figures_list(&c->to, "consistency");
    for (int i = 0; i < AGREEMENTS; i++) {
        static const char *const keys[2][2] = {{"most_999", "limit_999"}, {"most_9999", "limit_9999"}};
        int good = 1;
        sort_numbers(differs[i], count[i]);
        begin(c, limits[i].name);
        tell(c, "samples", "%.9g", (double)count[i]);
        for (int k = 0; k < 2; k++) {
            const double last = fmax((double)count[i] - 1, 0), part_of = k ? 0.9999 : 0.999;
            const double most = count[i] ? differs[i][(size_t)(part_of * last)] : 0;
            tell(c, keys[k][0], "%.2g", most);
            tell(c, keys[k][1], "%.2g", limits[i].most[k]);
            good &= most <= limits[i].most[k];
        }
        judge(c, good);
    }
    figures_list_end(&c->to);
    free(differs);
    return STATUS_GOOD;
}

/* Samples of some views against the density over bins: the library against itself, without another reference. */
static void check_chi_square(checking *c)
{
    enum { ANGLES = 6, TESTS = 2 * ANGLES };
    static const double angles[ANGLES] = {0, 30, 60, 80, 89, 130};
    const double level = statistics_sidak(0.01, TESTS);
    part(c, "chi-square", 0.8);
    tell(c, "chi_square_samples", "%.9g", (double)c->samples);
    tell(c, "chi_square_level", "%.3g", level);
    figures_list(&c->to, "chi_square");
    for (size_t i = 0; i < TESTS; i++) {
        const int is_flat = i >= ANGLES; /* narrow, and turned to */
        const vndf_surface surface = vndf_rough(c->distribution, is_flat ? 0.05f : 1, is_flat ? 0.4f : 1);
        const double theta = angles[i % ANGLES];
        const vndf_vec3 wi = direction_from(theta, is_flat ? 25 : 0);
        const vndf_view view = vndf_view_from(&surface, wi);
        const bins_sampler judged = bins_of_view(&view, &surface, wi);
        progress_show((double)i / TESTS, "chi-square", &c->bar);
        const bins_result of = bins_chi_square(&judged, (size_t)c->samples, c->seed + 1000 * (i + 1));
        if (of.error < 0) {
            c->to.failed = 1; /* there was no memory; figures_end says so */
            break;
        }
        const double mass_limit = 1e-4 + of.error;
        const int is_blind = of.mass == 0 && of.unseen == c->samples; /* every density is 0 */
        figures_record(&c->to);
        tell(c, "alpha_x", "%.3g", (double)surface.xx);
        tell(c, "alpha_y", "%.3g", (double)surface.yy);
        figures_number(&c->to, "theta", "%.3g", theta, "degrees");
        if (is_blind)
            figures_truth(&c->to, "blind", 1);
        tell(c, "bins", "%.9g", (double)of.found.classes);
        tell(c, "p", "%.4g", is_blind ? 1 : of.found.p);
        tell(c, "mass_error", "%.2g", is_blind ? 0 : of.mass - 1);
        tell(c, "mass_limit", "%.2g", mass_limit);
        if (of.unseen)
            tell(c, "unclaimed", "%.9g", (double)of.unseen);
        /* below the horizon a narrow lobe may hold less than a float can tell from nothing: density 0 is no fault */
        judge(c, is_blind ? wi.z < 0 && vndf_projected_area(&surface, wi) < 1e-25f
                          : of.found.p >= level && fabs(of.mass - 1) <= mass_limit && of.unseen == 0);
    }
    figures_list_end(&c->to);
}

static void check_hard(checking *c, int is_whole)
{
    part(c, "hard cases", 1);
    stress_result result = stress_run(c->distribution, is_whole ? 1 : 19, c->seed);
    tell(c, "hard_samples", "%.9g", (double)result.samples);
    tell(c, "hard_views", "%.9g", (double)result.views);
    tell(c, "hard_views_left_out", "%.9g", (double)result.outside);
    figures_list(&c->to, "hard");
    for (int id = 0; id < STRESS_COUNT; id++) {
        const stress_property *property = &stress_properties[id];
        const stress_finding *found = &result.found[id];
        begin(c, property->name);
        figures_text(&c->to, "is", property->meaning);
        tell(c, "worst", "%.3g", fmax(found->worst, 0));
        tell(c, "limit", "%.3g", property->limit);
        tell(c, "points", "%.9g", (double)found->checked);
        tell(c, "failed", "%.9g", (double)found->failed);
        for (int i = 0; i < STRESS_NUMBERS && found->failed; i++)
            tell(c, stress_numbers[i], "%.9g", (double)found->number[i]);
        judge(c, found->failed == 0);
    }
    figures_list_end(&c->to);
}

static int run(const arguments *given)
{
    checking c = {.samples = 1000000, .seed = 1, .good = 1};
    const char *csv = option_value(given, "--csv");
    chosen_distribution chosen;
    if (!option_count(given, "--samples", 1000, 1e10, &c.samples) ||
        !option_count(given, "--seed", 0, 0x1p53, &c.seed) ||
        !distribution_open(&chosen, name, given->positional.item[0], 0))
        return STATUS_USE;
    if (!chosen.owned && csv)
        return complain(name, "--csv is for tables; a closed form was not made of a CSV");
    c.distribution = chosen.distribution;
    c.to = figures_begin(given);
    c.bar = progress_begin(name, option_value(given, "-q") != NULL);
    int status = chosen.owned ? check_certificate(&c, csv) : STATUS_GOOD;
    if (status == STATUS_GOOD)
        status = check_consistency(&c);
    if (status == STATUS_GOOD) {
        check_chi_square(&c);
        check_hard(&c, option_value(given, "--hard") != NULL);
        if (chosen.owned)
            describe_end(&c.to, &chosen);
        figures_text(&c.to, "result", c.good ? "good" : "FAILED");
    }
    progress_end(&c.bar);
    if (status == STATUS_GOOD && (status = figures_end(&c.to)) == STATUS_GOOD && !c.good)
        status = STATUS_NO;
    figures_free(&c.to);
    distribution_close(&chosen);
    return status;
}

const subcommand command_check = {
    name, "measure a table again; exit 1 if a claim fails", "FILE|ggx|beckmann", 1, 1, run, help};
