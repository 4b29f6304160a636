/* Status and error text: how every room reports that something went wrong. */
#ifndef VNDF_CORE_ERROR_H
#define VNDF_CORE_ERROR_H

#include "vndf.h"

#if defined(__GNUC__)
#  define VNDF_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#  define VNDF_PRINTF(text, first)
#endif

/* Fills *error (which may be NULL) with a printf-style message and returns status, so that a failing
 * function can end with `return vndf_fail(error, ...)`. Long messages are cut. */
vndf_status vndf_fail(vndf_error *error, vndf_status status, const char *format, ...) VNDF_PRINTF(3, 4);

#endif
