/* The closed forms as distributions, and what any distribution is. */
#include "table/table.h"

/* The median of Beckmann's slopes is sqrt(log 2). */
static const vndf_distribution ggx = {.kind = VNDF_KIND_GGX,
                                      .unit = 1.0f,
                                      .normalization = 1.0,
                                      .scale = 1.0,
                                      .source = "--family ggx",
                                      .tool = "vndf " VNDF_VERSION,
                                      .notes = ""};

static const vndf_distribution beckmann = {.kind = VNDF_KIND_BECKMANN,
                                           .unit = 1.0f,
                                           .normalization = 1.0,
                                           .scale = 0.83255461115769776,
                                           .source = "--family beckmann",
                                           .tool = "vndf " VNDF_VERSION,
                                           .notes = ""};

const vndf_distribution *vndf_ggx(void)
{
    return &ggx;
}

const vndf_distribution *vndf_beckmann(void)
{
    return &beckmann;
}

vndf_info vndf_distribution_info(const vndf_distribution *d)
{
    if (!d) {
        vndf_info nothing = {.source = "", .tool = "", .notes = ""};
        return nothing;
    }
    size_t memory = vndf_is_table(d) ? vndf_table_memory(d) : 0;
    vndf_info info = {d->source,        d->tool,    d->notes,         d->bytes, memory,
                      (size_t)d->cells, d->moments, d->normalization, d->scale, d->certificate};
    return info;
}
