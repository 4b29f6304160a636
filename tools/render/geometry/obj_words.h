/* The text of an OBJ file as lines of words, one character at a time: lines and words of any length take no
 * memory. */
#ifndef TOOLS_RENDER_GEOMETRY_OBJ_WORDS_H
#define TOOLS_RENDER_GEOMETRY_OBJ_WORDS_H

#include <stddef.h>
#include <stdio.h>

enum { OBJ_WORD_MAX = 63, OBJ_BYTES_MAX = 1 << 30 };

typedef struct obj_text {
    FILE *file;
    const char *name;
    unsigned long long line; /* from 1 */
    char *message;           /* of the error, `size` bytes */
    size_t size;
    size_t at, end, bytes; /* in the block; bytes: read so far, the file ends after OBJ_BYTES_MAX */
    char word[OBJ_WORD_MAX + 1];
    unsigned char block[1 << 15];
} obj_text;

/* Writes "name:line: " and the message; returns 0. */
int obj_complain(obj_text *t, const char *format, ...);

/* Reads the next word of the line. Returns 1; 0 at the end of the line or a comment; -1 after a complaint about a
 * word that is too long, or a backslash that does not continue the line. */
int obj_word(obj_text *t);

/* The same, but cuts a word that is too long: for words that may be ignored. */
int obj_keyword(obj_text *t);

/* Reads a finite number; returns as obj_word does. */
int obj_number(obj_text *t, double *value);

/* Goes to the start of the next line; 0 at the end of the file. */
int obj_next_line(obj_text *t);

#endif
