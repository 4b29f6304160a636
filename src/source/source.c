/* The public calls that all kinds of source have in common. */
#include "source/source.h"

double vndf_source_p22(const vndf_source *source, double r)
{
    return source ? source->p22(source, r) : 0.0;
}

const char *vndf_source_description(const vndf_source *source)
{
    return source ? source->description : "";
}

void vndf_source_free(vndf_source *source)
{
    if (source)
        source->destroy(source);
}
