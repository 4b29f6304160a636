/* The words of a command line as one text: text that grows, quoting as a shell wants it, and splitting into words
 * again. Short printable excerpts of input, for error messages. Numbers as text. */
#ifndef VNDF_SOURCE_WORDS_H
#define VNDF_SOURCE_WORDS_H

#include "core/cursor.h"
#include "vndf_build.h"

/* Texts are bytes that grow, with their end once they are finished. */
void vndf_text_add(vndf_writer *text, const char *string);
void vndf_text_add_number(vndf_writer *text, double value); /* vndf_number_print */

/* Adds a space unless the text is empty, then the word: as it is if a shell leaves it alone, otherwise
 * in single quotes. Control characters become spaces, so that the text stays one line. */
void vndf_text_add_word(vndf_writer *text, const char *word);

/* The text, which the caller frees; NULL and VNDF_ERROR_MEMORY if it could not grow. */
char *vndf_text_finish(vndf_writer *text, vndf_error *error);

/* Two words, "OPTION WORD", then the tail as it is; "unnamed" for NULL. Of at most VNDF_LIMIT_NAME_LENGTH characters,
 * else VNDF_ERROR_ARGUMENT. The caller frees it. */
char *vndf_text_pair(const char *option, const char *word, const char *tail, vndf_error *error);

/* A line split into words. */
typedef struct vndf_words {
    char *bytes; /* owned: the words, each ended by NUL */
    char **word; /* owned */
    size_t count;
} vndf_words;

/* Splits at blanks; '...' and backslash quote. On failure `words` is empty and needs no freeing. */
vndf_status vndf_words_split(const char *line, vndf_words *words, vndf_error *error);
void vndf_words_free(vndf_words *words);

/* A part of a text; the column of its first character, from 1. vndf_cut takes what is before the first separator off
 * the rest, or all if there is none. */
typedef struct vndf_span {
    const char *text;
    size_t size, column;
} vndf_span;
vndf_span vndf_cut(vndf_span *rest, char separator);

/* The bytes of the first character of text, which is UTF-8; 1 where it is not. */
size_t vndf_character(const char *text, size_t size);

/* The first characters of text, for a message: '?' for an unprintable one, "..." where it is cut. */
enum { VNDF_EXCERPT = 48 };
const char *vndf_excerpt(char out[VNDF_EXCERPT], const char *text, size_t size);

/* Whether the text is the word. */
int vndf_is_word(const char *text, size_t size, const char *word);

/* ---- numbers, the same in every locale: a decimal point is '.', whatever setlocale() was told --------------- */

/* Longest number that is read, and space for one that is printed. */
enum { VNDF_NUMBER_LENGTH = 4096, VNDF_NUMBER_TEXT = 32 };

/* Reads [+-] digits [. digits] [e [+-] digits] from the start of text, correctly rounded, into *value
 * (infinite if it is too large). Returns how many characters belong to the number; 0 if there is none. No
 * hexadecimal, no "inf" or "nan". */
size_t vndf_number_read(const char *text, size_t size, double *value);

/* The same for text that must be one number from its first to its last character: 1 if it is. */
int vndf_number_is_all(const char *text, size_t size, double *value);

/* Prints the shortest of %.15g, %.16g, %.17g that reads back as the same double; returns out. */
const char *vndf_number_print(char out[VNDF_NUMBER_TEXT], double value);

#endif
