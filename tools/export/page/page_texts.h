/* The texts of the page beside this file, which the build embeds. */
#ifndef TOOLS_EXPORT_PAGE_PAGE_TEXTS_H
#define TOOLS_EXPORT_PAGE_PAGE_TEXTS_H

#include "export/kernel_text.h"

/* Ended by a name NULL. */
extern const embedded_text page_texts[];

#endif
