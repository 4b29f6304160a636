#include "commands/parts/describe.h"

#include <math.h>

/* The units of figures, as text and JSON name them. */
static const char bytes[] = "B", mass[] = "of the mass", degrees[] = "degrees", relative[] = "relative";

/* A closed form has no certificate. */
static void put_table(figures *f, const vndf_info *info)
{
    const vndf_certificate *c = &info->certificate;
    figures_text(f, "source", info->source);
    figures_text(f, "tool", info->tool);
    figures_number(f, "bytes", "%.9g", (double)info->bytes, bytes);
    figures_number(f, "memory", "%.9g", (double)info->memory, bytes);
    figures_number(f, "cells", "%.9g", (double)info->cells, "intervals");
    figures_number(f, "moments", "%.9g", info->moments, "terms");
    figures_number(f, "normalization", "%.17g", info->normalization, "factor");
    figures_number(f, "scale", "%.9g", info->scale, "slope");
    if (!info->bytes)
        return;
    figures_number(f, "tv", "%.4g", (double)c->tv, mass);
    figures_number(f, "tv_theta", "%.6g", (double)c->tv_theta, degrees);
    figures_number(f, "tv_above", "%.4g", (double)c->tv_above, mass);
    figures_number(f, "tv_above_theta", "%.6g", (double)c->tv_above_theta, degrees);
    figures_number(f, "max_weight", "%.6g", (double)c->max_weight, "ratio");
    figures_truth(f, "weight_bounded", c->weight_bounded > 0);
    figures_number(f, "area_error", "%.4g", (double)c->area_error, relative);
    figures_number(f, "consistency", "%.4g", (double)c->consistency, mass);
    figures_number(f, "ndf_error", "%.4g", (double)c->ndf_error, relative);
    figures_number(f, "hidden", "%.4g", (double)c->hidden, mass);
    figures_number(f, "finest", "%.4g", (double)c->finest, "of the slope");
    figures_number(f, "horizon_power", "%.4g", (double)c->horizon_power, "power of cos(theta_m)");
    figures_number(f, "floor_above", "%.4g", (double)c->floor_above, mass);
    figures_number(f, "floor", "%.4g", (double)c->floor, mass);
}

/* The largest total variation of the tables of a family. */
static double largest_tv(const vndf_family *family)
{
    double most = 0;
    for (size_t i = 0; i < vndf_family_info(family).count; i++)
        most = fmax(most, (double)vndf_distribution_info(vndf_family_distribution(family, i)).certificate.tv);
    return most;
}

static void put_family(figures *f, const vndf_family *family)
{
    vndf_family_facts facts = vndf_family_info(family);
    figures_text(f, "source", facts.source);
    figures_text(f, "tool", facts.tool);
    figures_number(f, "bytes", "%.9g", (double)facts.bytes, bytes);
    figures_number(f, "memory", "%.9g", (double)facts.memory, bytes);
    figures_number(f, "knots", "%.9g", (double)facts.count, "tables");
    figures_number(f, "low", "%.7g", (double)facts.low, "parameter");
    figures_number(f, "high", "%.7g", (double)facts.high, "parameter");
    figures_text(f, "linear_in", facts.reciprocal ? "1/p" : "p");
    figures_number(f, "distance", "%.4g", (double)facts.distance, mass);
    figures_number(f, "grazing", "%.4g", (double)facts.grazing, mass);
    figures_number(f, "tables_tv", "%.4g", largest_tv(family), mass);
    figures_list(f, "knot");
    for (size_t i = 0; i < facts.count; i++) {
        vndf_info info = vndf_distribution_info(vndf_family_distribution(family, i));
        figures_record(f);
        figures_number(f, "at", "%.7g", (double)vndf_family_parameter(family, i), "parameter");
        figures_number(f, "bytes", "%.9g", (double)info.bytes, bytes);
        figures_number(f, "tv", "%.4g", (double)info.certificate.tv, mass);
        if (i + 1 < facts.count)
            figures_number(f, "distance", "%.4g", (double)vndf_family_distance(family, i), mass);
    }
    figures_list_end(f);
}

/* ---- what is public ------------------------------------------------------------------------------ */

int describe_verdict(const chosen_distribution *of, int by_default, char verdict[DESCRIBE_VERDICT])
{
    const double poor = 5e-2; /* a total variation at which samples stop being worth their name */
    char more[160] = "good to ship";
    int good = 1;
    if (of->family) {
        const vndf_family_facts facts = vndf_family_info(of->family);
        const double distance = (double)facts.distance, tables = largest_tv(of->family);
        good = distance <= poor && tables <= poor;
        if (!good)
            snprintf(more, sizeof more, "%s",
                     tables <= poor ? "mixtures are worth little: try more --knots"
                                    : "tables are worth little: try a larger --max-bytes");
        snprintf(verdict, DESCRIBE_VERDICT,
                 "within %.2g%% of the family, %.2g%% at grazing; tables within %.2g%%; %.1f KiB; %s",
                 100 * distance, 100 * (double)facts.grazing, 100 * tables, (double)facts.bytes / 1024, more);
        return good;
    }
    const vndf_info info = vndf_distribution_info(of->distribution);
    const vndf_certificate *c = &info.certificate;
    const double above = (double)c->tv_above, below = (double)c->tv;
    if (!(above <= poor && below <= poor)) {
        good = 0;
        snprintf(more, sizeof more, "worth little at %.0f degrees: try a larger --max-bytes%s",
                 (double)(above <= poor ? c->tv_theta : c->tv_above_theta),
                 !(above <= poor) && info.moments < 4 ? " or --moments 4" : "");
    } else if (by_default && !(above <= table_aim_above && below <= table_aim_below)) {
        good = 0;
        snprintf(more, sizeof more, "%g%% and %g%% were aimed at: --max-bytes 16384 may come closer",
                 100 * table_aim_above, 100 * table_aim_below);
    } else if (c->finest > 0)
        snprintf(more, sizeof more, "good to ship if no feature is narrower than %.2g of its slope",
                 (double)c->finest);
    snprintf(verdict, DESCRIBE_VERDICT, "within %.2g%% of exact above the horizon, %.2g%% below; %.1f KiB; %s",
             100 * above, 100 * below, (double)info.bytes / 1024, more);
    return good;
}

void describe(figures *f, const chosen_distribution *of, const char *found, const char *verdict)
{
    const vndf_info info = of->family ? (vndf_info){.bytes = 1} : vndf_distribution_info(of->distribution);
    int length = 0;
    if (of->family)
        put_family(f, of->family);
    else
        put_table(f, &info);
    for (char key[64], value[512]; sscanf(found, "%63s %511[^\n]%n", key, value, &length) == 2; found += length)
        figures_text(f, key, value);
    if (info.bytes)
        figures_text(f, "verdict", verdict);
}
