#include "render/lines.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int refuse_at(vndf_error *error, const char *name, unsigned long long line, const char *format, ...)
{
    char *text = error->message;
    const size_t size = sizeof error->message,
                 used = (size_t)snprintf(text, size, "%.360s:%.0llu%s ", name, line, line ? ":" : "");
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, size - used, format, list);
    va_end(list);
    for (; *text; text++)
        *text = (unsigned char)*text < ' ' || *text == 127 ? '?' : *text;
    error->status = VNDF_ERROR_SYNTAX;
    return 0;
}

int lines_begin(lines *in, const char *name, char *text, size_t length, vndf_error *error)
{
    *in = (lines){.name = name, .error = error, .at = text};
    return strlen(text) == length || refuse_line(in, "the file has a byte 0: it is no text");
}

static const char blanks[] = " \t\r\v\f";

int lines_next(lines *in)
{
    const size_t most = sizeof in->word / sizeof *in->word;
    for (in->count = 0; *in->at && !in->count;) {
        char *at = in->at, *end = at + strcspn(at, "\n");
        in->line++;
        in->at = *end ? end + 1 : end;
        *end = '\0';
        for (char *c = at; *c; c++) /* words may be printed */
            *c = ((unsigned char)*c < ' ' && !strchr(blanks, *c)) || *c == 127 ? '?' : *c;
        for (at += strspn(at, blanks); *at && *at != '#'; at += strspn(at, blanks)) {
            const int is_quoted = *at == '"' && strchr(at + 1, '"');
            in->word[in->count++] = at += is_quoted;
            end = at + strcspn(at, is_quoted ? "\"" : " \t\r\v\f#");
            if (in->count == most)
                return refuse_line(in, "there are %zu words or more in this line", most) - 1;
            if (*end == '#') /* the comment goes */
                end[1] = '\0';
            at = *end ? end + 1 : end;
            *end = '\0';
        }
    }
    return in->count > 0;
}

/* strtod alone would also accept nan, inf, hexadecimal numbers and leading blanks. */
int read_number(const lines *in, const char *word, double *number)
{
    char *end;
    *number = strtod(word, &end);
    return (*word && !*end && strspn(word, "+-.0123456789eE") == strlen(word)) ||
           refuse_line(in, "'%.64s' should be a number", word);
}
