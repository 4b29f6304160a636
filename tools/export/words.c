#include "export/words.h"

#include <string.h>

static int is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Digits, a point, and an exponent with its sign. */
static size_t number_length(const char *text)
{
    size_t n = 0;
    while (is_digit(text[n]) || text[n] == '.')
        n++;
    if (text[n] == 'e') {
        n += text[n + 1] == '-' ? 2 : 1;
        while (is_digit(text[n]))
            n++;
    }
    return n;
}

static size_t name_length(const char *text)
{
    size_t n = 0;
    while (is_letter(text[n]) || is_digit(text[n]))
        n++;
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
    if (text[0] == '/' && text[1] == '/')
        return (word){WORD_COMMENT, text, strcspn(text, "\n")};
    if (is_letter(*text))
        return (word){WORD_NAME, text, name_length(text)};
    if (is_digit(*text))
        return (word){WORD_NUMBER, text, number_length(text)};
    return (word){WORD_SIGN, text, 1};
}

int word_is(const word *w, const char *text)
{
    return strlen(text) == w->length && memcmp(w->text, text, w->length) == 0;
}

int words_equal(const word *a, const word *b)
{
    return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}
