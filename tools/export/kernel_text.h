/* The text of kernel.glsl, line by line; the build makes it. */
#ifndef TOOLS_EXPORT_KERNEL_TEXT_H
#define TOOLS_EXPORT_KERNEL_TEXT_H

#include <stddef.h>

/* Ended by NULL, without line breaks. */
extern const char *const kernel_text[];

#endif
