/* Checks everything that the sampler relies on, once, when a table is read. */
#ifndef VNDF_TABLE_VALIDATE_H
#define VNDF_TABLE_VALIDATE_H

#include "table/table.h"

/* Why the arrays of the file are not a table, or NULL if they are. */
const char *vndf_table_invalid(const vndf_distribution *table);

/* The same for the numbers derived from them. */
const char *vndf_table_invalid_derived(const vndf_distribution *table);

#endif
