/* The tables that the user names for a kernel: `vndf export` and `vndf explore`. */
#ifndef TOOLS_COMMANDS_PARTS_NAMED_TABLES_H
#define TOOLS_COMMANDS_PARTS_NAMED_TABLES_H

#include "cli/arguments.h"
#include "cli/subject.h"
#include "export/document.h"

typedef struct named_tables {
    chosen_distribution chosen[EXPORT_TABLES_MAX];
    size_t count;
} named_tables;

/* Opens the files and enters them in the document, whose prefix is set; 0 after a complaint. Close in any case. */
int named_tables_open(named_tables *tables, const char *command, const words *files, export_document *document);

/* Fills in the document's numbers; 0 after a complaint. */
int named_tables_numbers(const char *command, export_document *document);

/* Frees the tables, and the numbers of the document. */
void named_tables_close(named_tables *tables, export_document *document);

#endif
