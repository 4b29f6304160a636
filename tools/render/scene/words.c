/* A scene file as words. Blanks, tabs and ends of lines separate them; # outside quotes begins a comment; "quotes"
 * hold blanks. A word in the first column of a line begins a statement; a line that begins with a blank continues
 * it. */
#include "render/scene/reader.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int reader_refuse(scene_reader *r, const word *at, const char *format, ...)
{
    static const word start = {NULL, 1, 1, 1, 0, 0};
    const word *place = at ? at : &start;
    int length = snprintf(r->message, r->size, "%s:%u:%u: ", r->name, place->line, place->column);
    va_list list;
    if (length < 0 || (size_t)length >= r->size)
        return 0;
    va_start(list, format);
    vsnprintf(r->message + length, r->size - (size_t)length, format, list);
    va_end(list);
    return 0;
}

int reader_unknown(scene_reader *r, const word *at, const char *what, const char *const *names, size_t count)
{
    const char *near = nearest_word(at->text, names, count);
    char all[512] = "";
    size_t length = 0;
    if (near)
        return reader_refuse(r, at, "'%.64s' is no %s; did you mean '%s'?", at->text, what, near);
    for (size_t i = 0; i < count && length < sizeof all; i++)
        length += (size_t)snprintf(all + length, sizeof all - length, "%s%s", i ? ", " : "", names[i]);
    return reader_refuse(r, at, "'%.64s' is no %s; it must be one of: %s", at->text, what, all);
}

/* ---- splitting ---- */

typedef struct place {
    char *at, *end;
    char *line_start;
    unsigned line;
} place;

static unsigned column_of(const place *p, const char *at)
{
    return (unsigned)(at - p->line_start) + 1;
}

static void next_line(place *p)
{
    p->line++;
    p->line_start = p->at;
}

/* Skips blanks, comments and ends of lines. */
static void skip(place *p)
{
    while (p->at < p->end) {
        if (*p->at == '#') {
            while (p->at < p->end && *p->at != '\n')
                p->at++;
        } else if (*p->at == '\n') {
            p->at++;
            next_line(p);
        } else if (strchr(" \t\r", *p->at)) {
            p->at++;
        } else
            return;
    }
}

static int is_plain(char letter)
{
    return (unsigned char)letter > ' ' && letter != '"' && letter != '#' && letter != 127;
}

static word *add_word(scene_reader *r)
{
    if (r->count == r->room) {
        size_t room = r->room ? 2 * r->room : 256;
        word *larger = realloc(r->words, room * sizeof *larger);
        if (!larger)
            return NULL;
        r->words = larger;
        r->room = room;
    }
    return &r->words[r->count++];
}

/* Takes the letters of a word without its quotes; moves p->at behind it. */
static int take_letters(scene_reader *r, place *p, word *w)
{
    if (w->quoted)
        w->text = ++p->at;
    while (p->at < p->end && (w->quoted ? *p->at != '"' && *p->at != '\n' : is_plain(*p->at))) {
        if ((unsigned char)*p->at < ' ' && *p->at != '\t' && *p->at != '\r')
            break;
        p->at++;
    }
    if (!w->quoted)
        return 1;
    if (p->at >= p->end || *p->at != '"')
        return reader_refuse(r, w, "the quote that begins here does not end on its line");
    *p->at++ = '\0';
    return 1;
}

/* A blank, a comment or the end must follow a word. Once read, that character becomes the 0 that ends the word. */
static int take_word(scene_reader *r, place *p)
{
    word *w = add_word(r);
    if (!w)
        return reader_refuse(r, NULL, "there is no memory for the words of this file");
    *w = (word){p->at, p->line, column_of(p, p->at), 0, *p->at == '"', p->at == p->line_start};
    if (!w->quoted && !is_plain(*p->at))
        return reader_refuse(r, w, "a byte %u, which is no text", (unsigned)(unsigned char)*p->at);
    if (!take_letters(r, p, w))
        return 0;
    w->end = column_of(p, p->at);
    if (p->at < p->end && !strchr(" \t\r\n#", *p->at)) {
        const word here = {p->at, p->line, w->end, w->end, 0, 0};
        return reader_refuse(
            r, &here, *p->at == '"' || w->quoted ? "a blank is missing before this" : "a byte that is no text");
    }
    return 1;
}

/* A byte 0 is refused here, since strchr finds the 0 at the end of its list and take_word would see a blank. */
static int check_bytes(scene_reader *r, const char *text, size_t size)
{
    const char *zero = memchr(text, '\0', size);
    if (!zero)
        return 1;
    unsigned line = 1, column = 1;
    for (const char *at = text; at < zero; at++) {
        column = *at == '\n' ? 1 : column + 1;
        line += *at == '\n';
    }
    const word here = {NULL, line, column, column, 0, 0};
    return reader_refuse(r, &here, "a byte 0: this is no text");
}

/* Writes a 0 over the character behind a word; if that began a comment, skips the comment. */
static void end_word(place *p)
{
    if (p->at >= p->end)
        return;
    char ended_by = *p->at;
    *p->at++ = '\0';
    if (ended_by == '#')
        while (p->at < p->end && *p->at != '\n')
            p->at++;
    else if (ended_by == '\n')
        next_line(p);
}

int reader_split(scene_reader *r, char *text, size_t size)
{
    place p = {text, text + size, text, 1};
    if (!check_bytes(r, text, size))
        return 0;
    for (;;) {
        skip(&p);
        if (p.at >= p.end)
            return 1;
        if (!take_word(r, &p))
            return 0;
        end_word(&p);
        if (!r->words[0].begins)
            return reader_refuse(r, &r->words[0],
                                 "a statement begins in the first column; lines that begin with "
                                 "a blank go on with the one before");
    }
}
