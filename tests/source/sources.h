/* What the tests of sources share: a source that was made, and one that was refused. */
#pragma once

#include "harness/test.h"
#include "source/source.h"

static inline vndf_source *made(vndf_source *source, const vndf_error *error, const char *text)
{
    if (!TEST(source != NULL))
        fprintf(stderr, "  %s: %s\n", text, error->message);
    return source;
}

static inline void refused(vndf_source *source, const vndf_error *error, vndf_status status, const char *message)
{
    if (!(TEST(source == NULL) & TEST(error->status == status) & TEST_HAS(error->message, message)))
        fprintf(stderr, "  %s\n", error->message);
    vndf_source_free(source);
}

static inline vndf_source *slope_of(const char *text)
{
    vndf_error error = {VNDF_OK, ""};
    return made(vndf_source_slope_expression(text, NULL, 0, &error), &error, text);
}

static inline vndf_source *family_of(const char *text)
{
    vndf_error error = {VNDF_OK, ""};
    return made(vndf_source_family(text, &error), &error, text);
}
