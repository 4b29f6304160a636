/* A table, or a family of tables, and what it is worth: the same wherever it is printed. */
#ifndef TOOLS_COMMANDS_PARTS_DESCRIBE_H
#define TOOLS_COMMANDS_PARTS_DESCRIBE_H

#include "cli/figures.h"
#include "cli/verdict.h"

/* As figures: what it is, its certificate, its notes, and the verdict, which is told (cli/verdict.h); a closed form has
 * neither certificate nor verdict. */
void describe(figures *f, const chosen_distribution *of);

/* Notes (vndf_source_note) as figures. */
void describe_notes(figures *f, const char *notes);

#endif
