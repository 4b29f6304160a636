/* The kernel's text as words and declarations. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "export/translate.h"

static size_t gap_length(const char *from)
{
    const char *at = from;
    for (;;) {
        if (*at == ' ' || *at == '\n')
            at++;
        else if (strncmp(at, "/*", 2) == 0)
            at = strstr(at, "*/") + 2;
        else if (*at == '#')
            do /* with its continuations */
                at += 1 + strcspn(at + 1, "\n");
            while (at[-1] == '\\');
        else
            return (size_t)(at - from);
    }
}

/* What the C compiler took for a number is one: digits, letters, points, signs of exponents. */
static word word_at(const char *from)
{
    static const char pairs[] = "&& || == != <= >= << >> ++";
    const size_t gap = gap_length(from);
    const char *at = from + gap, *exponent = at[0] == '0' && at[1] == 'x' ? "p" : "e";
    int n = *at != '\0';
    word w = {n ? WORD_SIGN : WORD_END, at, 0, (int)gap, 0};
    if (isdigit((unsigned char)*at)) {
        w.kind = WORD_NUMBER;
        while (isalnum((unsigned char)at[n]) || at[n] == '.' ||
               (strchr("+-", at[n]) && strchr(exponent, at[n - 1])))
            n++;
    } else if (isalpha((unsigned char)*at) || *at == '_') {
        w.kind = WORD_NAME;
        while (isalnum((unsigned char)at[n]) || at[n] == '_')
            n++;
    } else {
        for (const char *pair = pairs; n == 1 && pair < pairs + sizeof pairs - 1; pair += 3)
            n += strncmp(at, pair, 2) == 0;
    }
    w.length = n;
    return w;
}

int word_is(const word *w, const char *name)
{
    return strlen(name) == (size_t)w->length && memcmp(w->text, name, strlen(name)) == 0;
}

int word_find(const translation *t, int at, int end, const char *sign)
{
    while (at < end && !word_is(&t->word[at], sign))
        at = t->word[at].other > at ? t->word[at].other + 1 : at + 1;
    return at < end ? at : end;
}

/* Adds the declaration that begins there; of an enum each name is one. Returns what follows. */
static int read_declaration(translation *t, int at)
{
    const word *w = &t->word[at];
    const int inner = at + (word_is(w, "enum") ? 1 : word_is(w, "static") ? 8 : 3), close = t->word[inner].other;
    declaration d = {.kind = FUNCTION, .name = at + 2, .type = at + 1, .begin = at, .inner = inner};
    d.end = t->word[close + 1].other + 1;
    for (int name = at + 2; word_is(w, "enum") && name < close; name = d.end + 1) {
        d = (declaration){.kind = CONSTANT, .name = name, .begin = at, .inner = name + 2};
        d.end = word_find(t, name, close, ",");
        t->at[t->count++] = d;
    }
    if (word_is(w, "enum"))
        return close + 2;
    if (word_is(w, "typedef")) {
        d.kind = STRUCT;
        d.end = close + 3;
    } else if (word_is(w, "static")) {
        d.kind = ARRAY;
        d.name = at + 3;
        d.end = close + 2;
    }
    t->at[t->count++] = d;
    return d.end;
}

int translation_read(translation *t, const char *source)
{
    int open[32], depth = 0, room = 0, at = 0;
    t->words = t->count = 0;
    t->apart = (t->to->is & LANGUAGE_APART) != 0;
    t->indents = (t->to->is & LANGUAGE_INDENTS) != 0;
    do {
        if (t->words == room) {
            word *more = realloc(t->word, (size_t)(room = 2 * room + 4096) * sizeof *more);
            if (!more)
                return 0;
            t->word = more;
        }
        word *w = &t->word[t->words];
        *w = word_at(source);
        source = w->text + w->length;
        if (w->kind == WORD_SIGN && strchr("([{", *w->text)) {
            open[depth++] = t->words;
        } else if (w->kind == WORD_SIGN && strchr(")]}", *w->text)) {
            w->other = open[--depth];
            t->word[w->other].other = t->words;
        }
    } while (t->word[t->words++].kind != WORD_END);
    while (t->word[at].kind != WORD_END && t->count < DECLARATIONS_MAX - 64)
        at = read_declaration(t, at);
    return t->word[at].kind == WORD_END;
}
