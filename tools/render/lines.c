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
    static const char blanks[] = " \"\t\r\v\f";
    for (in->count = 0; *in->at && !in->count;) {
        char *at = in->at;
        in->at += strcspn(at, "\n");
        if (*in->at)
            *in->at++ = '\0';
        snprintf(in->place, sizeof in->place, "vndf render: %.3000s:%llu", in->name, ++in->line);
        for (char *c = at; *c; c++) /* words may be printed */
            *c = ((unsigned char)*c < ' ' && !strchr(blanks, *c)) || *c == 127 ? '?' : *c;
        at[strcspn(at, "#")] = '\0';
        for (char *word = strtok(at, blanks); word; word = strtok(NULL, blanks)) {
            if (in->count == LINE_WORDS_MAX)
                return wrong(in, "there are more than %d words in this line", LINE_WORDS_MAX) - 1;
            in->word[in->count++] = word;
        }
    }
    return in->count > 0;
}
