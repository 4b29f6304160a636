/* The text of --help read part by part. Its form: lines "usage: ..." and "example: ..."; paragraphs that begin in the
 * first column; items "  TERM  what it is" that go on in deeper lines, and items of an item in column 6. */
#ifndef TOOLS_MANUAL_HELP_TEXT_H
#define TOOLS_MANUAL_HELP_TEXT_H

#include <stddef.h>

typedef enum help_kind { HELP_TEXT, HELP_USAGE, HELP_ITEM, HELP_SUBITEM, HELP_EXAMPLE } help_kind;

typedef struct help_part {
    help_kind kind;
    char term[256];  /* of an item; else empty */
    char text[4096]; /* its lines in one; of an example its blanks are kept */
} help_part;

/* Reads the next part from *at, which moves on. 0 at the end. *part is the part before, zeroed at the beginning. */
int help_part_next(const char **at, help_part *part);

/* What follows an option in the usage or in the term of its item, "FILE" or "quick|full"; empty where nothing does.
 * 0 if there is no item for it. */
enum { HELP_VALUE_SIZE = 64 };

int help_option_find(const char *help, const char *name, char value[HELP_VALUE_SIZE]);

#endif
