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

int refuse_unknown(scene_words *w, const word *at, const char *what, const char *const *names, size_t count)
{
    const char *near = nearest_word(at->text, names, count);
    char all[512] = "";
    size_t used = 0;
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

static size_t find_form(const word *at, const clause_form *forms, size_t n)
{
    size_t i = 0;
    while (i < n && (at->is_quoted || strcmp(at->text, forms[i].keyword) != 0))
        i++;
    return i;
}

/* strtod alone would also accept nan, inf, hexadecimal numbers and leading blanks. */
static int read_number(scene_words *w, const clause_form *f, const word *at, double *number)
{
    char *end = at->text;
    if (strspn(at->text, "+-.0123456789eE") == strlen(at->text))
        *number = strtod(at->text, &end);
    if (end == at->text || *end)
        return refuse_word(w, at, "'%.64s' is no number; it must be '%s %s'", at->text, f->keyword, f->takes);
    if (!(*number >= f->low && *number <= f->high))
        return refuse_word(w, at, "%s is %.9g, it must be from %.9g to %.9g", f->keyword, *number, f->low,
                           f->high);
    if (f->kind == CLAUSE_WHOLE && *number != floor(*number))
        return refuse_word(w, at, "%s is %.9g, it must be a whole number", f->keyword, *number);
    return 1;
}

int read_clauses(scene_words *w, const word *list, size_t count, size_t from, const clause_form *forms, size_t n,
                 clause found[CLAUSES_MAX])
{
    const char *names[CLAUSES_MAX];
    for (size_t i = 0; i < n; i++) {
        names[i] = forms[i].keyword;
        found[i] = (clause){NULL, NULL, 0, {0, 0, 0}};
    }
    for (size_t at = from; at < count;) {
        size_t i = find_form(&list[at], forms, n);
        if (i == n)
            return refuse_unknown(w, &list[at], "clause here", names, n);
        const clause_form *f = &forms[i];
        clause *c = &found[i];
        if (c->at)
            return refuse_word(w, &list[at], "'%s' stands in this statement twice", f->keyword);
        c->at = &list[at++];
        c->value = list + at;
        /* required values are taken as they are, since a name may look like a keyword */
        for (; at < count && c->count < f->most; at++, c->count++) {
            if (c->count >= f->least && find_form(&list[at], forms, n) < n)
                break;
            if (f->kind != CLAUSE_WORDS && !read_number(w, f, &list[at], &c->number[c->count]))
                return 0;
        }
        if (c->count < f->least)
            return refuse_word(w, c->at, "the statement ends before all of '%s %s' was there", f->keyword,
                               f->takes);
    }
    for (size_t i = 0; i < n; i++)
        if (forms[i].is_needed && !found[i].at)
            return refuse_word(w, &list[from - 1], "'%s' needs '%s %s'", list[from - 1].text, forms[i].keyword,
                               forms[i].takes);
    return 1;
}

int read_choice(scene_words *w, const clause *c, const char *what, const char *const *names, size_t count,
                size_t *chosen)
{
    for (*chosen = 0; *chosen < count; ++*chosen)
        if (strcmp(c->value[0].text, names[*chosen]) == 0)
            return 1;
    return refuse_unknown(w, &c->value[0], what, names, count);
}
