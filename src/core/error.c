#include "core/error.h"

#include <stdarg.h>
#include <stdio.h>

vndf_status vndf_fail(vndf_error *error, vndf_status status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
        error->status = status;
    }
    return status;
}

const char *vndf_version(void)
{
    return VNDF_VERSION;
}
