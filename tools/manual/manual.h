/* The manual page vndf(1) and the completion of bash, from the forms of all commands: the tables of options that they
 * parse with, and the texts that they print for --help. These have a form: lines "usage: ..." and "example: ...",
 * which go on in deeper lines; paragraphs in the first column; items "  TERM  what it is" that go on in deeper lines,
 * and items of an item in column 6. */
#ifndef TOOLS_MANUAL_MANUAL_H
#define TOOLS_MANUAL_MANUAL_H

#include <stdio.h>

/* `head` is the text of `vndf --help`. */
void manual_write_man(FILE *to, const char *head);

/* For bash 4 and later. */
void manual_write_bash(FILE *to);

#endif
