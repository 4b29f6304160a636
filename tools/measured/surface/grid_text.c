#include "measured/surface/grid_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

grid_text text_from(const char *bytes, size_t size)
{
    grid_text text = {bytes, size, 0, 1};
    if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0)
        text.at = 3;
    return text;
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

int text_word(grid_text *from, char word[WORD_MAX])
{
    size_t length = 0;
    while (from->at < from->size && is_blank(from->bytes[from->at]))
        from->at++;
    for (; from->at < from->size && !is_blank(from->bytes[from->at]) && from->bytes[from->at] != '\n'; from->at++)
        if (length < WORD_MAX - 1) {
            char c = from->bytes[from->at];
            word[length++] = c > ' ' && c <= '~' ? c : '?';
        }
    word[length] = '\0';
    return length > 0;
}

int text_line(grid_text *from)
{
    while (from->at < from->size && from->bytes[from->at] != '\n')
        from->at++;
    if (from->at == from->size)
        return 0;
    from->at++;
    from->line++;
    return from->at < from->size;
}

int text_word_anywhere(grid_text *from, char word[WORD_MAX])
{
    while (!text_word(from, word))
        if (!text_line(from))
            return 0;
    return 1;
}

int word_number(const char *word, double *value)
{
    char *end;
    *value = strtod(word, &end);
    return end != word && *end == '\0' && !isinf(*value);
}
