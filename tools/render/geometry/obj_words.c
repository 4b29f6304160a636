/* Blanks separate words; CR counts as a blank. A backslash before the end of a line joins it to the next. # begins
 * a comment. */
#include "render/geometry/obj_words.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

int obj_complain(obj_text *t, const char *format, ...)
{
    const int head = snprintf(t->message, t->size, "%s:%llu: ", t->name, t->line);
    if (head < 0 || (size_t)head >= t->size)
        return 0;
    va_list values;
    va_start(values, format);
    vsnprintf(t->message + head, t->size - (size_t)head, format, values);
    va_end(values);
    return 0;
}

/* The next character, or EOF; it stays in the text. */
static int look(obj_text *t)
{
    if (t->at == t->end) {
        t->at = 0;
        t->end = t->bytes > OBJ_BYTES_MAX ? 0 : fread(t->block, 1, sizeof t->block, t->file);
        t->bytes += t->end;
    }
    return t->at < t->end ? t->block[t->at] : EOF;
}

static int is_blank(int c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static int skip_blanks(obj_text *t)
{
    int c = look(t);
    for (; is_blank(c); c = look(t))
        t->at++;
    return c;
}

/* Goes to the first character of the next word; returns 1, 0 or -1 as obj_word does. */
static int skip_to_word(obj_text *t)
{
    int c = skip_blanks(t);
    for (; c == '\\'; c = skip_blanks(t)) {
        t->at++;
        c = look(t);
        if (c == '\r') {
            t->at++;
            c = look(t);
        }
        if (c != '\n')
            return obj_complain(t, "a backslash stands only at the end of a line, which it joins to the next") - 1;
        t->at++;
        t->line++;
    }
    return c != '\n' && c != EOF && c != '#';
}

/* Reads the letters of a word, unprintable ones as '?' so that messages can quote them; returns their number. */
static size_t read_letters(obj_text *t)
{
    size_t length = 0, kept = 0;
    for (int c = look(t); c != '\n' && c != EOF && c != '\\' && !is_blank(c); c = look(t)) {
        if (kept < OBJ_WORD_MAX)
            t->word[kept++] = (char)(c > ' ' && c < 127 ? c : '?');
        length++;
        t->at++;
    }
    t->word[kept] = '\0';
    return length;
}

int obj_keyword(obj_text *t)
{
    const int is_there = skip_to_word(t);
    if (is_there == 1)
        read_letters(t);
    return is_there;
}

int obj_word(obj_text *t)
{
    const int is_there = skip_to_word(t);
    if (is_there == 1 && read_letters(t) > OBJ_WORD_MAX)
        return obj_complain(t, "'%.20s...' is longer than %d letters", t->word, OBJ_WORD_MAX) - 1;
    return is_there;
}

int obj_number(obj_text *t, double *value)
{
    const int is_there = obj_word(t);
    if (is_there != 1)
        return is_there;
    char *end = t->word;
    const int is_decimal = strspn(t->word, "0123456789+-.eE") == strlen(t->word); /* strtod takes nan too */
    *value = is_decimal ? strtod(t->word, &end) : 0.0;
    if (end == t->word || *end != '\0')
        return obj_complain(t, "'%s' should be a number", t->word) - 1;
    if (!(fabs(*value) < HUGE_VAL))
        return obj_complain(t, "'%s' is too large a number", t->word) - 1;
    return 1;
}

int obj_next_line(obj_text *t)
{
    for (int c = look(t); c != EOF; c = look(t)) {
        t->at++;
        if (c == '\n') {
            t->line++;
            return look(t) != EOF;
        }
    }
    return 0;
}
