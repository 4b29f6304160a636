#include "vndf.h"

const char *vndf_version(void)
{
    return VNDF_VERSION;
}
