#include "manual/help_text.h"

#include <stdio.h>
#include <string.h>

/* ---- lines -------------------------------------------------------------------------------------- */

typedef struct line {
    const char *text; /* behind the indentation */
    size_t indent, length;
} line;

static line line_at(const char *at)
{
    line l = {at, strspn(at, " "), 0};
    l.text += l.indent;
    l.length = strcspn(l.text, "\n");
    return l;
}

static const char *line_end(const line *l)
{
    const char *end = l->text + l->length;
    return *end ? end + 1 : end;
}

static int begins(const line *l, const char *word)
{
    return l->length >= strlen(word) && memcmp(l->text, word, strlen(word)) == 0;
}

/* Whether a line begins a part, behind a part of the kind `before`; `fresh` behind an empty line. */
static int begins_part(const line *l, help_kind before, int fresh, help_kind *kind)
{
    const int goes_on = !fresh && l->indent > 0;
    *kind = HELP_TEXT;
    if (l->indent == 0 && (begins(l, "usage: ") || begins(l, "example: ")))
        *kind = begins(l, "usage: ") ? HELP_USAGE : HELP_EXAMPLE;
    else if (goes_on && before == HELP_USAGE && begins(l, "vndf "))
        *kind = HELP_USAGE;
    else if (goes_on && before == HELP_EXAMPLE)
        *kind = HELP_EXAMPLE;
    else if (l->indent == 2)
        *kind = HELP_ITEM;
    else if (l->indent == 6 && (before == HELP_ITEM || before == HELP_SUBITEM))
        *kind = HELP_SUBITEM;
    else
        return fresh || (l->indent == 0 && before != HELP_TEXT);
    return 1;
}

/* ---- parts -------------------------------------------------------------------------------------- */

static void append(char *to, size_t size, const char *text, size_t length)
{
    size_t at = strlen(to);
    if (length > 0)
        snprintf(to + at, size - at, "%s%.*s", at ? " " : "", (int)length, text);
}

static void begin_part(help_part *part, const line *l)
{
    static const char usage[] = "usage: ", example[] = "example: ";
    const char *blanks = memchr(l->text, ' ', l->length);
    size_t skip = 0;
    part->term[0] = part->text[0] = '\0';
    if (part->kind == HELP_USAGE && begins(l, usage))
        skip = strlen(usage);
    else if (part->kind == HELP_EXAMPLE && begins(l, example))
        skip = strlen(example);
    else if (part->kind == HELP_EXAMPLE && l->indent > strlen(example))
        snprintf(part->text, sizeof part->text, "%*s", (int)(l->indent - strlen(example)) - 1, "");
    else if (part->kind == HELP_ITEM || part->kind == HELP_SUBITEM) {
        while (blanks && (size_t)(blanks - l->text) + 1 < l->length && blanks[1] != ' ')
            blanks = memchr(blanks + 1, ' ', l->length - (size_t)(blanks + 1 - l->text));
        size_t term = blanks ? (size_t)(blanks - l->text) : l->length;
        append(part->term, sizeof part->term, l->text, term);
        skip = term + strspn(l->text + term, " ");
    }
    append(part->text, sizeof part->text, l->text + skip, l->length - skip);
}

int help_part_next(const char **at, help_part *part)
{
    help_kind kind = HELP_TEXT;
    int fresh = 0, started = 0;
    while (**at) {
        line l = line_at(*at);
        if (l.length == 0)
            fresh = 1;
        else if (begins_part(&l, part->kind, fresh || (!started && kind == HELP_TEXT && l.indent == 0), &kind)) {
            if (started)
                return 1;
            part->kind = kind;
            begin_part(part, &l);
            started = 1;
            fresh = 0;
        } else
            append(part->text, sizeof part->text, l.text, l.length);
        if (l.length == 0 && started)
            return 1;
        *at = line_end(&l);
    }
    return started;
}

/* ---- options ------------------------------------------------------------------------------------ */

/* Where `name` stands in the text as a word of its own, or NULL: behind it. */
static const char *behind_name(const char *text, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)) != NULL; at += length)
        if ((at == text || strchr(" [(|", at[-1])) && (at[length] == '\0' || strchr(" ,])", at[length])))
            return at + length;
    return NULL;
}

/* The word behind an option, without the brackets of the usage. */
static void copy_value(const char *behind, char *value, size_t size)
{
    size_t length = *behind == ' ' ? strcspn(behind + 1, " ") : 0;
    int open = 0;
    snprintf(value, size, "%.*s", (int)length, behind + (length > 0));
    for (char *c = value; *c; c++) {
        open += (*c == '[') - (*c == ']');
        if (open < 0 || *c == ')' || (*c == ',' && c[1] == '\0')) {
            *c = '\0';
            return;
        }
    }
}

int help_option_find(const char *help, const char *name, char value[HELP_VALUE_SIZE])
{
    help_part part = {HELP_TEXT, "", ""};
    const char *behind;
    int found = 0;
    value[0] = '\0';
    for (const char *at = help; help_part_next(&at, &part);) {
        const char *said = part.kind == HELP_USAGE && !value[0] ? part.text
                           : part.kind == HELP_ITEM && !found   ? part.term
                                                                : "";
        behind = behind_name(said, name);
        if (behind && !value[0])
            copy_value(behind, value, HELP_VALUE_SIZE);
        found |= behind && part.kind == HELP_ITEM;
    }
    return found;
}
