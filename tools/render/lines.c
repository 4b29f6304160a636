#include "render/lines.h"

#include <stdio.h>
#include <string.h>

int lines_begin(lines *in, const char *name, char *text, size_t length)
{
    *in = (lines){.name = name, .at = text};
    snprintf(in->place, sizeof in->place, "vndf render: %.3000s", name);
    return strlen(text) == length || wrong(in, "the file has a byte 0: it is no text");
}

int lines_next(lines *in)
{
    static const char blanks[] = " \t\r\v\f";
    for (in->count = 0; *in->at && !in->count;) {
        char *at = in->at;
        in->at += strcspn(at, "\n");
        if (*in->at)
            *in->at++ = '\0';
        snprintf(in->place, sizeof in->place, "vndf render: %.3000s:%llu", in->name, ++in->line);
        for (char *c = at; *c; c++) /* words may be printed */
            *c = ((unsigned char)*c < ' ' && !strchr(blanks, *c)) || *c == 127 ? '?' : *c;
        for (at += strspn(at, blanks); *at && *at != '#'; at += strspn(at, blanks)) {
            const int is_quoted = *at == '"' && strchr(at + 1, '"');
            if (in->count == LINE_WORDS_MAX)
                return wrong(in, "there are more than %d words in this line", LINE_WORDS_MAX) - 1;
            in->word[in->count++] = at += is_quoted;
            at += strcspn(at, is_quoted ? "\"" : " \t\r\v\f#");
            if (*at == '#') /* the comment goes */
                at[1] = '\0';
            if (*at)
                *at++ = '\0';
        }
    }
    return in->count > 0;
}
