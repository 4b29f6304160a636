/* The page of `vndf explore`: one HTML file that draws in WebGL2 with the exported kernel. */
#ifndef TOOLS_EXPORT_PAGE_EXPLORER_H
#define TOOLS_EXPORT_PAGE_EXPLORER_H

#include <stdio.h>

#include "export/document.h"

/* Numbers that the smallest float texture of WebGL2 holds: 1024 columns, 2048 rows. */
enum { EXPLORER_NUMBERS_MAX = 1024 * 2048 };

/* The document is in GLSL with the prefix vndf and its numbers in a buffer. 0 if there is no memory. */
int explorer_write(const export_document *document, FILE *to);

#endif
