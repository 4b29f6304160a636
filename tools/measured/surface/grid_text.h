/* Words of a text that is not trusted, and where they stand. */
#ifndef TOOLS_MEASURED_SURFACE_GRID_TEXT_H
#define TOOLS_MEASURED_SURFACE_GRID_TEXT_H

#include <stddef.h>

enum { WORD_MAX = 64 };

typedef struct grid_text {
    const char *bytes;
    size_t size, at;
    size_t line; /* of the next byte, from 1 */
} grid_text;

/* At the beginning of a text, past the mark of UTF-8 that spreadsheets write. */
grid_text text_from(const char *bytes, size_t size);

/* The next word of the same line; 0 at its end or the end of the text. A word is cut after WORD_MAX - 1 characters. A
 * character that is none of ASCII stands as '?'. */
int text_word(grid_text *from, char word[WORD_MAX]);

/* Goes to the next line; 0 at the end of the text. */
int text_line(grid_text *from);

/* The next word in this line or later ones. */
int text_word_anywhere(grid_text *from, char word[WORD_MAX]);

/* Whether the whole word is a number, which may be "nan". Infinities are none. */
int word_number(const char *word, double *value);

#endif
