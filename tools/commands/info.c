/* vndf info: what a file of this program says of itself; nothing is measured (`vndf check` does). */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "commands/describe.h"
#include "cli/output.h"
#include "cli/subject.h"

static const char help[] =
    "usage: vndf info FILE|ggx|beckmann|FILE.vndfs\n"
    "\n"
    "Prints `key value` lines:\n"
    "  source         how the table was made, as arguments of `vndf build`\n"
    "  tool           the version that made it\n"
    "  bytes          size of the table's file; 0 for the closed forms\n"
    "  memory         bytes that it takes when loaded\n"
    "  cells          intervals of the slope length before the tail; 0 for closed forms\n"
    "  moments        2, 3 or 4, as in vndf build --moments\n"
    "  normalization  the factor by which the given D or P22 was multiplied\n"
    "  scale          median slope length at alpha = 1\n"
    "and the certificate, as measured when the table was made, incident directions from 0 to 180 degrees:\n"
    "  tv             largest total variation distance between sampled and true visible normals\n"
    "  tv_theta       incident angle where it was found, degrees\n"
    "  tv_above, tv_above_theta    the same for directions from 0 to 90 degrees\n"
    "  max_weight     largest true/sampled density over all but 1e-6 of the mass\n"
    "  weight_bounded 1 if true/sampled is bounded everywhere\n"
    "  area_error     largest relative error of the projected area, Lambda and G1\n"
    "  consistency    largest |integral of pdf - 1|\n"
    "  ndf_error      largest relative error of ndf over all but 1e-6 of the mass\n"
    "  hidden         part of the mass, or of the area at grazing incidence, that the builder may have missed\n"
    "  finest         0 if that is proven; else the relative width of slope down to which D was sampled\n"
    "  horizon_power  p < 0 where D grows as cos(theta_m)^p towards the horizon: no angular grid resolves it\n"
    "and the sum of it:\n"
    "  verdict        how far samples are from exact on both sides of the horizon, and whether that is good to ship\n"
    "\n"
    "Of a family of tables (vndf build --parameter), which is used between its knots as a mixture of neighbours:\n"
    "  source, tool, bytes, memory    as above, memory of all tables together\n"
    "  knots          the number of tables, from the parameter `low` to `high`\n"
    "  linear_in      p or 1/p: what the weights of neighbours are linear in\n"
    "  distance       largest total variation distance of slopes between family and mixture, without tables\n"
    "  grazing        the same of the normals that are visible at grazing incidence\n"
    "  tables_tv      the largest tv of the tables\n"
    "  knot P bytes B tv T distance D    a line for each table, D up to the next knot\n"
    "\n"
    "example: vndf info wavy.vndf\n";

void describe_certificate(const vndf_certificate *certificate)
{
    printf("tv %.4g\n", (double)certificate->tv);
    printf("tv_theta %.6g\n", (double)certificate->tv_theta);
    printf("tv_above %.4g\n", (double)certificate->tv_above);
    printf("tv_above_theta %.6g\n", (double)certificate->tv_above_theta);
    printf("max_weight %.6g\n", (double)certificate->max_weight);
    printf("weight_bounded %d\n", certificate->weight_bounded > 0);
    printf("area_error %.4g\n", (double)certificate->area_error);
    printf("consistency %.4g\n", (double)certificate->consistency);
    printf("ndf_error %.4g\n", (double)certificate->ndf_error);
    printf("hidden %.4g\n", (double)certificate->hidden);
    printf("finest %.4g\n", (double)certificate->finest);
    printf("horizon_power %.4g\n", (double)certificate->horizon_power);
}

void describe_info(const vndf_info *info)
{
    printf("source %s\n", info->source);
    printf("tool %s\n", info->tool);
    printf("bytes %zu\n", info->bytes);
    printf("memory %zu\n", info->memory);
    printf("cells %zu\n", info->cells);
    printf("moments %d\n", info->moments);
    printf("normalization %.17g\n", info->normalization);
    printf("scale %.9g\n", info->scale);
}

int describe_verdict(const vndf_info *info, int by_default, char verdict[DESCRIBE_VERDICT])
{
    const double poor = 5e-2, aim_above = 1e-3, aim_below = 3e-2;
    const vndf_certificate *c = &info->certificate;
    double above = (double)c->tv_above, below = (double)c->tv;
    char within[128];
    snprintf(within, sizeof within, "within %.2g%% of exact above the horizon, %.2g%% below; %.1f KiB",
             100 * above, 100 * below, (double)info->bytes / 1024);
    if (!(above <= poor && below <= poor)) {
        snprintf(verdict, DESCRIBE_VERDICT, "%s; worth little at %.0f degrees: try a larger --max-bytes%s", within,
                 (double)(above > poor ? c->tv_above_theta : c->tv_theta),
                 above > poor && info->moments < 4 ? " or --moments 4" : "");
        return 0;
    }
    if (by_default && !(above <= aim_above && below <= aim_below)) {
        snprintf(verdict, DESCRIBE_VERDICT, "%s; %g%% and %g%% were aimed at: --max-bytes 16384 may come closer",
                 within, 100 * aim_above, 100 * aim_below);
        return 0;
    }
    snprintf(verdict, DESCRIBE_VERDICT, "%s; good to ship", within);
    return 1;
}

static void describe_knot(const vndf_family *family, size_t i)
{
    vndf_info info = vndf_distribution_info(vndf_family_distribution(family, i));
    printf("knot %.7g bytes %zu tv %.4g", (double)vndf_family_parameter(family, i), info.bytes,
           (double)info.certificate.tv);
    if (i + 1 < vndf_family_info(family).count)
        printf(" distance %.4g", (double)vndf_family_distance(family, i));
    putchar('\n');
}

static double largest_tv(const vndf_family *family, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++) {
        double tv = (double)vndf_distribution_info(vndf_family_distribution(family, i)).certificate.tv;
        most = tv > most ? tv : most;
    }
    return most;
}

void describe_family(const vndf_family *family)
{
    vndf_family_facts facts = vndf_family_info(family);
    printf("source %s\n", facts.source);
    printf("tool %s\n", facts.tool);
    printf("bytes %zu\n", facts.bytes);
    printf("memory %zu\n", facts.memory);
    printf("knots %zu\n", facts.count);
    printf("low %.7g\n", (double)facts.low);
    printf("high %.7g\n", (double)facts.high);
    printf("linear_in %s\n", facts.reciprocal ? "1/p" : "p");
    printf("distance %.4g\n", (double)facts.distance);
    printf("grazing %.4g\n", (double)facts.grazing);
    printf("tables_tv %.4g\n", largest_tv(family, facts.count));
    for (size_t i = 0; i < facts.count; i++)
        describe_knot(family, i);
}

static int info_of_family(const char *command, const char *path)
{
    vndf_family *family = family_open(command, path);
    if (!family)
        return STATUS_USE;
    describe_family(family);
    vndf_family_free(family);
    return STATUS_GOOD;
}

int command_info(int argc, char **argv)
{
    const command_form form = {"vndf info", help, NULL, 0, "FILE|ggx|beckmann|FILE.vndfs", 1, 1};
    words positional = {{NULL}, 0};
    chosen_distribution chosen;
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (is_family_file(only_word(&positional)))
        return info_of_family(form.command, only_word(&positional));
    if (!distribution_open(&chosen, form.command, only_word(&positional)))
        return STATUS_USE;
    vndf_info info = vndf_distribution_info(chosen.distribution);
    describe_info(&info);
    if (chosen.owned) {
        char verdict[DESCRIBE_VERDICT];
        describe_certificate(&info.certificate);
        describe_verdict(&info, 0, verdict);
        printf("verdict %s\n", verdict);
    }
    distribution_close(&chosen);
    return STATUS_GOOD;
}
