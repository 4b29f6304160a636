#include "table/family/family.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"

vndf_family *vndf_family_allocate(size_t count)
{
    vndf_family *family = count ? calloc(1, sizeof *family) : NULL;
    if (family)
        family->count = count;
    return family;
}

void vndf_family_free(vndf_family *family)
{
    if (!family)
        return;
    for (size_t i = 0; family->owns && i < family->count; i++)
        vndf_free((vndf_distribution *)family->distribution[i]);
    free(family->source);
    free(family->tool);
    free(family);
}

const char *vndf_family_invalid(const vndf_family *family)
{
    const float *p = family->parameter, *distance = family->distance;
    if (family->reciprocal && !(p[0] > 0.0f))
        return "parameters that are mixed by 1/p must be positive";
    for (size_t i = 0; i < family->count; i++)
        if (!isfinite(p[i]))
            return "a parameter is infinite or not a number";
    for (size_t i = 0; i + 1 < family->count; i++)
        if (!(p[i] < p[i + 1]))
            return "parameters must ascend";
    for (size_t i = 0; i < family->count; i++) {
        float x = i + 1 < family->count ? distance[i] : family->grazing;
        if (!(x >= 0.0f && x <= 1.0f))
            return "a distance is no part of 1";
    }
    return NULL;
}

/* ---- the calls ---- */

vndf_family *vndf_family_of(const vndf_distribution *const *distributions, const float *parameters, size_t count,
                            vndf_error *error)
{
    int complete = distributions && parameters && count >= 1 && count <= VNDF_LIMIT_FAMILY_KNOTS;
    for (size_t i = 0; complete && i < count; i++)
        complete = distributions[i] != NULL;
    vndf_family *family = complete ? vndf_family_allocate(count) : NULL;
    if (!family) {
        vndf_fail(error, complete ? VNDF_ERROR_MEMORY : VNDF_ERROR_ARGUMENT,
                  complete ? "no memory for a family"
                           : "a family needs 1 to %d distributions, each with a parameter",
                  VNDF_LIMIT_FAMILY_KNOTS);
        return NULL;
    }
    memcpy(family->parameter, parameters, count * sizeof *parameters);
    memcpy((void *)family->distribution, (const void *)distributions, count * sizeof *distributions);
    const char *why = vndf_family_invalid(family);
    if (!why)
        return family;
    vndf_fail(error, VNDF_ERROR_ARGUMENT, "not a family: %s", why);
    vndf_family_free(family);
    return NULL;
}

vndf_family_facts vndf_family_info(const vndf_family *family)
{
    vndf_family_facts facts = {.source = "", .tool = ""};
    if (!family)
        return facts;
    facts.source = family->source ? family->source : "";
    facts.tool = family->tool ? family->tool : "";
    facts.bytes = family->bytes;
    facts.count = family->count;
    facts.low = family->parameter[0];
    facts.high = family->parameter[family->count - 1];
    facts.reciprocal = family->reciprocal;
    facts.grazing = family->grazing;
    for (size_t i = 0; i < family->count; i++) {
        facts.memory += vndf_distribution_info(family->distribution[i]).memory;
        facts.distance = fmaxf(facts.distance, family->distance[i]);
    }
    return facts;
}

float vndf_family_parameter(const vndf_family *family, size_t index)
{
    return family && index < family->count ? family->parameter[index] : 0.0f;
}

const vndf_distribution *vndf_family_distribution(const vndf_family *family, size_t index)
{
    return family && index < family->count ? family->distribution[index] : NULL;
}

float vndf_family_distance(const vndf_family *family, size_t index)
{
    return family && index < family->count ? family->distance[index] : 0.0f;
}
