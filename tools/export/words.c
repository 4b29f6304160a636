#include "export/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- words --------------------------------------------------------------------------------------- */

static int is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

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
static word word_at(const char *at)
{
    static const char pairs[] = "&& || == != <= >= << >> ++";
    word w = {WORD_SIGN, at, 1, 0, 0};
    size_t n = 1;
    if (is_digit(*at) || (*at == '.' && is_digit(at[1]))) {
        int hex = at[0] == '0' && at[1] == 'x';
        while (is_digit(at[n]) || is_letter(at[n]) || at[n] == '.' ||
               ((at[n] == '-' || at[n] == '+') && strchr(hex ? "p" : "e", at[n - 1])))
            n++;
        w.kind = WORD_NUMBER;
    } else if (is_letter(*at)) {
        while (is_letter(at[n]) || is_digit(at[n]))
            n++;
        w.kind = WORD_NAME;
    } else if (*at == '\0') {
        w.kind = WORD_END;
    } else {
        for (const char *pair = pairs; n == 1 && pair < pairs + sizeof pairs - 1; pair += 3)
            n += strncmp(at, pair, 2) == 0;
    }
    w.length = (int)n;
    return w;
}

/* All words to `to`, unless that is NULL; their count. */
static int split(const char *source, word *to)
{
    int count = 0, open[32], depth = 0;
    for (const char *at = source;; count++) {
        size_t gap = gap_length(at);
        word w = word_at(at + gap);
        w.gap = (int)gap;
        at = w.text + w.length;
        if (w.kind == WORD_END)
            w.length = 0;
        if (w.kind == WORD_SIGN && strchr("([{", *w.text))
            open[depth++] = count;
        if (w.kind == WORD_SIGN && strchr(")]}", *w.text) && to) {
            w.other = open[--depth];
            to[w.other].other = count;
        } else if (w.kind == WORD_SIGN && strchr(")]}", *w.text)) {
            depth--;
        }
        if (to)
            to[count] = w;
        if (w.kind == WORD_END)
            return count;
    }
}

int word_is(const word *w, const char *name)
{
    return strlen(name) == (size_t)w->length && memcmp(w->text, name, strlen(name)) == 0;
}

int word_is_in(const word *w, const char *list)
{
    for (const char *at = list; (at = strchr(at, ' ')) && at[1]; at++)
        if (strncmp(at + 1, w->text, (size_t)w->length) == 0 && at[1 + w->length] == ' ')
            return 1;
    return 0;
}

int word_equals(const word *a, const word *b)
{
    return a->length == b->length && memcmp(a->text, b->text, (size_t)a->length) == 0;
}

int word_is_public(const word *w)
{
    return w->length > 5 && (memcmp(w->text, "vndf_", 5) == 0 || memcmp(w->text, "VNDF_", 5) == 0);
}

int kernel_find(const kernel *t, int at, int end, const char *sign)
{
    while (at < end && !word_is(&t->word[at], sign))
        at = t->word[at].other > at ? t->word[at].other + 1 : at + 1;
    return at < end ? at : end;
}

void kernel_expect(int good, const word *at, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "vndf export: the kernel's text has to have %s here: %.*s\n", what,
            (int)strcspn(at->text, "\n"), at->text);
    abort();
}

/* ---- declarations -------------------------------------------------------------------------------- */

/* enum { A = 1, B = -2 }; each name is a declaration. */
static int read_enum(kernel *t, int at)
{
    int close = t->word[at + 1].other;
    for (int name = at + 2; name < close; name = kernel_find(t, name, close, ",") + 1) {
        kernel_expect(t->count < DECLARATIONS_MAX && word_is(&t->word[name + 1], "="), &t->word[name],
                      "NAME = number");
        t->at[t->count++] = (declaration){.kind = CONSTANT,
                                          .name = name,
                                          .begin = at,
                                          .end = name + 1,
                                          .value = strtol(t->word[name + 2].text, NULL, 0)};
    }
    return close + 2;
}

static int read_declaration(kernel *t, int at)
{
    const word *w = &t->word[at];
    declaration d = {.begin = at};
    if (word_is(w, "enum"))
        return read_enum(t, at);
    if (word_is(w, "typedef")) { /* typedef struct name {...} name; */
        d.kind = STRUCT;
        d.name = at + 2;
        d.inner = at + 3;
        d.end = t->word[d.inner].other + 3;
    } else if (word_is(w, "static")) { /* static const float name[...] = {...}; */
        d.kind = ARRAY;
        d.type = at + 2;
        d.name = at + 3;
        d.inner = kernel_find(t, at, t->words, "=") + 1;
        d.end = t->word[d.inner].other + 2;
    } else { /* HERE type name(...) {...} */
        kernel_expect(word_is(w, "HERE"), w, "HERE");
        d.kind = FUNCTION;
        d.type = at + 1;
        d.name = at + 2;
        d.inner = at + 3;
        d.end = t->word[t->word[d.inner].other + 1].other + 1;
    }
    kernel_expect(t->count < DECLARATIONS_MAX, w, "fewer declarations");
    t->at[t->count++] = d;
    return d.end;
}

int kernel_read(kernel *t, const char *source)
{
    t->words = split(source, NULL);
    t->count = 0;
    t->word = malloc(((size_t)t->words + 1) * sizeof *t->word);
    if (!t->word)
        return 0;
    split(source, t->word);
    for (int at = 0; at < t->words;)
        at = read_declaration(t, at);
    return 1;
}

void kernel_free(kernel *t)
{
    free(t->word);
}

declaration *kernel_named(kernel *t, const word *name)
{
    for (int i = 0; i < t->count; i++)
        if (word_equals(&t->word[t->at[i].name], name))
            return &t->at[i];
    return NULL;
}
