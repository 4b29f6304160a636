/* Which word a misspelt one may be: for error messages. */
#ifndef VNDF_CORE_NEAREST_H
#define VNDF_CORE_NEAREST_H

#include <stddef.h>

/* How many letters (of at most 64) are to be inserted, dropped, replaced or exchanged with the next for the text to
 * become the word, small or capital. */
size_t vndf_word_distance(const char *text, size_t size, const char *word);

/* Whether the word is nearer than *least, which becomes its distance: only where most letters are the text's own.
 * *least begins with the number of letters that are no slip but another word, vndf_word_slip. */
size_t vndf_word_slip(size_t size);
int vndf_word_is_nearer(const char *text, size_t size, const char *word, size_t *least);

#endif
