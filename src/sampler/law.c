/* The closed forms as distributions, and the information about any distribution. */
#include "sampler/law.h"

#include "table/layout.h"

static const vndf_distribution ggx = {.kind = VNDF_KIND_GGX,
                                      .normalization = 1.0,
                                      .scale = 1.0,
                                      .source = "--family ggx",
                                      .tool = "vndf " VNDF_VERSION};

static const vndf_distribution beckmann = {.kind = VNDF_KIND_BECKMANN,
                                           .normalization = 1.0,
                                           .scale = 0.83255461115769776,
                                           .source = "--family beckmann",
                                           .tool = "vndf " VNDF_VERSION};

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
        vndf_info nothing = {.source = "", .tool = ""};
        return nothing;
    }
    size_t rows = (size_t)d->above.row_count + d->below.row_count;
    size_t memory = d->kind == VNDF_KIND_TABLE ? vndf_table_memory(d) : 0;
    vndf_info info = {d->source,           d->tool,          d->bytes, memory,        d->radial_count, rows,
                      d->above.cell_count, d->normalization, d->scale, d->certificate};
    return info;
}
