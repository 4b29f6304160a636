/* Texts that the build embeds: the kernel's, in the order in which they are read. */
#ifndef TOOLS_EXPORT_KERNEL_TEXT_H
#define TOOLS_EXPORT_KERNEL_TEXT_H

#include <stddef.h>

typedef struct embedded_text {
    const char *name;         /* of the file */
    const char *const *lines; /* ended by NULL, without line breaks */
} embedded_text;

/* Ended by a name NULL. */
extern const embedded_text kernel_text[];

#endif
