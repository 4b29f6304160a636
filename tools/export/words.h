/* The words of the kernel's text: a small part of GLSL, whose shape is stated in kernel.glsl. */
#ifndef TOOLS_EXPORT_WORDS_H
#define TOOLS_EXPORT_WORDS_H

#include <stddef.h>

typedef enum word_kind {
    WORD_SPACE,   /* spaces, no line break */
    WORD_LINE,    /* one line break */
    WORD_COMMENT, /* from // on, without the line break */
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

/* Whether the word is this text. */
int word_is(const word *w, const char *text);

/* Whether both have the same text. */
int words_equal(const word *a, const word *b);

#endif
