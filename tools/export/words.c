#include "export/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Digits, letters, points, and signs of exponents: what the C compiler took for a number is one. */
static size_t number_length(const char *text)
{
    size_t n = 0;
    int hex = text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
    while (is_digit(text[n]) || is_letter(text[n]) || text[n] == '.' ||
           ((text[n] == '-' || text[n] == '+') && memchr(hex ? "pP" : "eE", text[n - 1], 2)))
        n++;
    return n;
}

static size_t name_length(const char *text)
{
    size_t n = 0;
    while (is_letter(text[n]) || is_digit(text[n]))
        n++;
    return n;
}

static size_t comment_length(const char *text)
{
    const char *end = strstr(text + 2, "*/");
    return end ? (size_t)(end - text) + 2 : strlen(text);
}

static size_t directive_length(const char *text)
{
    size_t n = strcspn(text, "\n");
    while (text[n] && text[n - 1] == '\\')
        n += 1 + strcspn(text + n + 1, "\n");
    return n;
}

word word_at(const char *text)
{
    if (*text == '\0')
        return (word){WORD_END, text, 0};
    if (*text == ' ')
        return (word){WORD_SPACE, text, strspn(text, " ")};
    if (*text == '\n')
        return (word){WORD_LINE, text, 1};
    if (text[0] == '/' && text[1] == '*')
        return (word){WORD_COMMENT, text, comment_length(text)};
    if (*text == '#')
        return (word){WORD_DIRECTIVE, text, directive_length(text)};
    if (is_letter(*text))
        return (word){WORD_NAME, text, name_length(text)};
    if (is_digit(*text) || (*text == '.' && is_digit(text[1])))
        return (word){WORD_NUMBER, text, number_length(text)};
    return (word){WORD_SIGN, text, 1};
}

word word_solid(const char *text)
{
    word next = word_at(text);
    while (next.kind <= WORD_DIRECTIVE)
        next = word_at(next.text + next.length);
    return next;
}

int word_is(const word *w, const char *text)
{
    return strlen(text) == w->length && memcmp(w->text, text, w->length) == 0;
}

int words_equal(const word *a, const word *b)
{
    return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

const char *words_end(const char *from, const char *stops)
{
    int depth = 0;
    for (word next = word_solid(from); next.kind != WORD_END; next = word_solid(next.text + next.length)) {
        if (next.kind != WORD_SIGN)
            continue;
        if (depth == 0 && (strchr(stops, *next.text) || strchr(")]}", *next.text)))
            return next.text;
        depth += strchr("([{", *next.text) ? 1 : strchr(")]}", *next.text) ? -1 : 0;
    }
    return from + strlen(from);
}

void words_expect(int good, const char *at, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "vndf export: the kernel's text has to have %s here: %.*s\n", what, (int)strcspn(at, "\n"),
            at);
    abort();
}
