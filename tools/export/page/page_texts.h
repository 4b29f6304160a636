/* The texts of the page beside this file, which the build embeds. */
#ifndef TOOLS_EXPORT_PAGE_PAGE_TEXTS_H
#define TOOLS_EXPORT_PAGE_PAGE_TEXTS_H

#include <stddef.h>

typedef struct embedded_text {
    const char *name;         /* of the file */
    const char *const *lines; /* ended by NULL, without line breaks */
} embedded_text;

/* Ended by a name NULL. */
extern const embedded_text page_texts[];

#endif
