/* The tables and families that the user names for a kernel: `vndf export` and `vndf explore`. */
#pragma once

#include "cli/arguments.h"
#include "export/export.h"

/* Opens the files and enters them in the document, whose prefix is set; ggx and beckmann, which every kernel has, add
 * nothing. 0 after a complaint. Close in any case. */
int named_tables_open(const char *command, const words *files, int families, export_document *document);

/* Frees the tables, and the numbers of the document. */
void named_tables_close(export_document *document);
