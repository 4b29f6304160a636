/* Blanks, tabs and ends of lines separate the words of a scene file; # outside quotes begins a comment; "quotes"
 * hold blanks. A word in the first column of a line begins a statement; a line that begins with a blank continues
 * it. */
#include "render/words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int refuse_word(scene_words *w, const word *at, const char *format, ...)
{
    int head = snprintf(w->message, w->size, "%s:%u:%u: ", w->name, at->line, at->column);
    va_list list;
    va_start(list, format);
    if (head >= 0 && (size_t)head < w->size)
        vsnprintf(w->message + head, w->size - (size_t)head, format, list);
    va_end(list);
    return 0;
}

int read_choice(scene_words *w, const word *at, const char *what, const char *const *names, size_t count,
                size_t *chosen)
{
    char all[512] = "";
    size_t used = 0;
    for (*chosen = 0; *chosen < count; ++*chosen)
        if (strcmp(at->text, names[*chosen]) == 0)
            return 1;
    const char *near = nearest_word(at->text, names, count);
    if (near)
        return refuse_word(w, at, "'%.64s' is no %s; did you mean '%s'?", at->text, what, near);
    for (size_t i = 0; i < count && used < sizeof all; i++)
        used += (size_t)snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", names[i]);
    return refuse_word(w, at, "'%.64s' is no %s; it must be one of: %s", at->text, what,
                       count ? all : "(none yet)");
}

/* ---- words ---- */

/* Takes the word at *at, which moves behind it. */
static int take_word(scene_words *w, char **at, const char *line_start, unsigned line)
{
    const word taken = {*at + (**at == '"'), line, (unsigned)(*at - line_start) + 1, **at == '"',
                        *at == line_start};
    char *end = taken.text;
    if (taken.is_quoted)
        end += strcspn(end, "\"\n");
    else
        while ((unsigned char)*end > ' ' && *end != '"' && *end != '#' && *end != 127)
            end++;
    if (taken.is_quoted && *end != '"')
        return refuse_word(w, &taken, "the quote that begins here does not end on its line");
    if (end == taken.text && !taken.is_quoted)
        return refuse_word(w, &taken, "a byte %u, which is no text", (unsigned)(unsigned char)*end);
    char *behind = end + taken.is_quoted;
    if (*behind && !strchr(" \t\r\n#", *behind)) {
        const word here = {NULL, line, (unsigned)(behind - line_start) + 1, 0, 0};
        return refuse_word(w, &here, "a blank is missing before this");
    }
    if (w->count == w->room) {
        const size_t room = 256 + 2 * w->room;
        word *larger = realloc(w->list, room * sizeof *larger);
        if (!larger)
            return refuse_word(w, &taken, "there is no memory for the words of this file");
        w->list = larger;
        w->room = room;
    }
    w->list[w->count++] = taken;
    *at = behind;
    return 1;
}

/* Words end with a 0 only when the character behind them has been read. */
int split_words(scene_words *w, char *text, size_t length)
{
    char *at = text, *line_start = text, *unended = NULL;
    unsigned line = 1;
    while (at < text + length) {
        char c = *at;
        if (unended)
            *unended = '\0';
        unended = NULL;
        if (c == '#') {
            at++; /* it may just have become the end of a word */
            at += strcspn(at, "\n");
        } else if (c == '\n') {
            line_start = ++at;
            line++;
        } else if (c == ' ' || c == '\t' || c == '\r') {
            at++;
        } else {
            if (!take_word(w, &at, line_start, line))
                return 0;
            unended = at - w->list[w->count - 1].is_quoted;
            if (!w->list[0].begins)
                return refuse_word(w, &w->list[0],
                                   "a statement begins in the first column; lines that begin with a "
                                   "blank go on with the one before");
        }
    }
    if (unended)
        *unended = '\0';
    return 1;
}

/* ---- clauses ---- */

const clause *clause_of(const statement *s, const char *name)
{
    static const clause none = {.at = NULL};
    for (size_t i = 0; i < s->clauses; i++)
        if (strcmp(s->clause[i].is->name, name) == 0)
            return &s->clause[i];
    return &none;
}

static int is_keyword(const statement *s, const word *at)
{
    return !at->is_quoted && clause_of(s, at->text)->is;
}

/* strtod alone would also accept nan, inf, hexadecimal numbers and leading blanks. */
static int read_number(scene_words *w, const key *k, const word *at, double *number)
{
    char *end = at->text;
    if (strspn(at->text, "+-.0123456789eE") == strlen(at->text))
        *number = strtod(at->text, &end);
    if (end == at->text || *end)
        return refuse_word(w, at, "'%.64s' is no number; it must be '%s %s'", at->text, k->name, k->takes);
    if (!(*number >= k->low && *number <= k->high))
        return refuse_word(w, at, "%s is %.9g, it must be from %.9g to %.9g", k->name, *number, k->low, k->high);
    return k->kind != WHOLE || *number == floor(*number) ||
           refuse_word(w, at, "%s is %.9g, it must be a whole number", k->name, *number);
}

/* The clause whose keyword is word *at, which moves behind its values. */
static int read_clause(scene_words *w, statement *s, size_t *at)
{
    const char *names[CLAUSES_MAX];
    size_t chosen;
    for (size_t i = 0; i < s->clauses; i++)
        names[i] = s->clause[i].is->name;
    if (s->list[*at].is_quoted)
        return refuse_word(w, &s->list[*at], "'%.64s' is no clause here, since it has quotes", s->list[*at].text);
    if (!read_choice(w, &s->list[*at], "clause here", names, s->clauses, &chosen))
        return 0;
    clause *c = &s->clause[chosen];
    if (c->at)
        return refuse_word(w, &s->list[*at], "'%s' stands in this statement twice", c->is->name);
    c->at = &s->list[(*at)++];
    c->value = s->list + *at;
    /* required values are taken as they are, since a name may look like a keyword */
    for (; *at < s->count && c->count < c->is->most; ++*at, c->count++) {
        const word *value = &s->list[*at];
        if (c->count >= c->is->least && is_keyword(s, value))
            break;
        if (c->is->kind != WORDS && !read_number(w, c->is, value, &c->number[c->count]))
            return 0;
    }
    return c->count >= c->is->least ||
           refuse_word(w, c->at, "the statement ends before all of '%s %s' was there", c->is->name, c->is->takes);
}

int read_clauses(scene_words *w, statement *s, size_t from, const key *keys, const char *of, const char *also)
{
    for (s->clauses = 0; keys->name; keys++)
        if (strcmp(keys->of, of) == 0 || strcmp(keys->of, also) == 0)
            s->clause[s->clauses++] = (clause){.is = keys};
    for (size_t at = from; at < s->count;)
        if (!read_clause(w, s, &at))
            return 0;
    for (size_t i = 0; i < s->clauses; i++) {
        const key *k = s->clause[i].is;
        const word *at = s->clause[i].at;
        const clause *other = k->other ? clause_of(s, k->other) : NULL;
        if (k->rule == NEEDED && !at)
            return refuse_word(w, &s->list[from - 1], "'%s' needs '%s %s'", of, k->name, k->takes);
        if (k->rule == OR && !at == !other->at)
            return refuse_word(w, &s->list[from - 1], "'%s' needs one of '%s %s' and '%s %s'", of, k->name,
                               k->takes, k->other, other->is->takes);
        if (k->rule == BESIDE && at && !other->at)
            return refuse_word(w, at, "'%s' stands beside '%s' only", k->name, k->other);
    }
    return 1;
}
