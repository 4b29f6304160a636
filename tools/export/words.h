/* The words of the kernel's text, which is a part of C (translate.h says which). */
#ifndef TOOLS_EXPORT_WORDS_H
#define TOOLS_EXPORT_WORDS_H

#include <stddef.h>

typedef enum word_kind {
    WORD_SPACE,     /* spaces, no line break */
    WORD_LINE,      /* one line break */
    WORD_COMMENT,   /* with what opens and closes it */
    WORD_DIRECTIVE, /* a line of the preprocessor, with its continuations, without the last line break */
    WORD_NAME,
    WORD_NUMBER,
    WORD_SIGN, /* one character of punctuation */
    WORD_END
} word_kind;

typedef struct word {
    word_kind kind;
    const char *text; /* not terminated */
    size_t length;
} word;

/* The word that begins at `text`. */
word word_at(const char *text);

/* The next one from `text` on that is no space, line, comment or directive. */
word word_solid(const char *text);

/* Whether the word is this text. */
int word_is(const word *w, const char *text);

/* Whether both have the same text. */
int words_equal(const word *a, const word *b);

/* The first place from `from` on, outside of brackets, of a sign among `stops`, or of a bracket that closes none. */
const char *words_end(const char *from, const char *stops);

/* Complains of the line and ends the program: the build translates the one text there is, so that what is wrong with it is
 * a fault of this program. */
void words_expect(int good, const char *at, const char *what);

#endif
