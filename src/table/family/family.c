#include "table/family/family.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"

vndf_family *vndf_family_allocate(size_t count)
{
    vndf_family *family = count ? calloc(1, sizeof *family) : NULL;
    if (!family)
        return NULL;
    family->count = count;
    family->parameter = calloc(count, sizeof *family->parameter);
    family->distance = calloc(count, sizeof *family->distance);
    family->distribution = calloc(count, sizeof *family->distribution);
    if (family->parameter && family->distance && family->distribution)
        return family;
    vndf_family_free(family);
    return NULL;
}

void vndf_family_free(vndf_family *family)
{
    if (!family)
        return;
    for (size_t i = 0; family->owns && family->distribution && i < family->count; i++)
        vndf_free((vndf_distribution *)family->distribution[i]);
    free(family->parameter);
    free(family->distance);
    free((void *)family->distribution);
    free(family->source);
    free(family->tool);
    free(family);
}

static int is_share(float x)
{
    return x >= 0.0f && x <= 1.0f;
}

const char *vndf_family_invalid(const vndf_family *family)
{
    const float *p = family->parameter;
    if (family->reciprocal && !(p[0] > 0.0f))
        return "parameters that are mixed by 1/p must be positive";
    for (size_t i = 0; i < family->count; i++)
        if (!(fabsf(p[i]) < HUGE_VALF))
            return "a parameter is infinite or not a number";
    for (size_t i = 0; i + 1 < family->count; i++)
        if (!(p[i] < p[i + 1]))
            return "parameters must ascend";
    for (size_t i = 0; i + 1 < family->count; i++)
        if (!is_share(family->distance[i]))
            return "a distance is no part of 1";
    return is_share(family->grazing) ? NULL : "a distance is no part of 1";
}

/* ---- the calls ---- */

static int is_complete(const vndf_distribution *const *distributions, const float *parameters, size_t count)
{
    int complete = distributions && parameters && count >= 1 && count <= VNDF_LIMIT_FAMILY_KNOTS;
    for (size_t i = 0; complete && i < count; i++)
        complete = distributions[i] != NULL;
    return complete;
}

vndf_family *vndf_family_of(const vndf_distribution *const *distributions, const float *parameters, size_t count,
                            vndf_error *error)
{
    if (!is_complete(distributions, parameters, count)) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "a family needs 1 to %d distributions, each with a parameter",
                  VNDF_LIMIT_FAMILY_KNOTS);
        return NULL;
    }
    vndf_family *family = vndf_family_allocate(count);
    if (!family) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a family of %lu", (unsigned long)count);
        return NULL;
    }
    memcpy(family->parameter, parameters, count * sizeof *parameters);
    for (size_t i = 0; i < count; i++)
        family->distribution[i] = distributions[i];
    const char *why = vndf_family_invalid(family);
    if (!why)
        return family;
    vndf_fail(error, VNDF_ERROR_ARGUMENT, "not a family: %s", why);
    vndf_family_free(family);
    return NULL;
}

vndf_family_facts vndf_family_info(const vndf_family *family)
{
    vndf_family_facts facts = {"", "", 0, 0, 0, 0.0f, 0.0f, 0, 0.0f, 0.0f};
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
