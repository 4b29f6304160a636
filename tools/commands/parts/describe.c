#include "commands/parts/describe.h"

#include <stdio.h>
#include <string.h>

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
    figures_number(f, "tables_tv", "%.4g", verdict_largest_tv(family), mass);
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

/* A file may say anything: a note with the name of a figure would pass for it. */
static int is_taken(const figures *f, const char *key)
{
    int taken = strcmp(key, "verdict") == 0;
    for (size_t i = 0; i < f->count; i++)
        taken |= strcmp(key, f->at[i].name) == 0;
    return taken;
}

void describe_notes(figures *f, const char *notes)
{
    char key[VNDF_LIMIT_NOTE_KEY + 1], value[VNDF_LIMIT_NOTES + 1];
    for (int length = 0; sscanf(notes, "%32s %4096[^\n]%n", key, value, &length) == 2; notes += length)
        if (!is_taken(f, key))
            figures_text(f, key, value);
}

void describe(figures *f, const chosen_distribution *of)
{
    const vndf_info info = vndf_distribution_info(of->distribution);
    const table_verdict is = verdict_of(of);
    if (of->family)
        put_family(f, of->family);
    else
        put_table(f, &info);
    describe_notes(f, info.notes);
    if (of->family || info.bytes)
        verdict_tell(&is, f->command, f);
}
