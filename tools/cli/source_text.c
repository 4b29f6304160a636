#include "cli/source_text.h"

#include <string.h>

typedef struct text_end {
    char *at, *end; /* end: of the buffer, where the zero may stand at last */
} text_end;

static void put(text_end *t, char letter)
{
    if (t->at < t->end)
        *t->at++ = letter;
}

static void put_text(text_end *t, const char *text)
{
    while (*text)
        put(t, *text++);
}

/* Between quotes where a shell would make something else of it. */
static void put_word(text_end *t, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+.,:/=_";
    if (*word && strspn(word, plain) == strlen(word)) {
        put_text(t, word);
        return;
    }
    put(t, '\'');
    for (; *word; word++)
        if (*word == '\'')
            put_text(t, "'\\''");
        else
            put(t, *word);
    put(t, '\'');
}

static void put_option(text_end *t, const char *option, const words *values)
{
    for (size_t i = 0; i < values->count; i++) {
        put_text(t, option);
        put_word(t, values->item[i]);
    }
}

void source_text(const source_words *given, char *text, size_t size)
{
    text_end t = {text, text + size - 1};
    put_option(&t, "--ndf ", &given->ndf);
    put_option(&t, "--slope ", &given->slope);
    put_option(&t, "--csv ", &given->csv);
    put_option(&t, "--family ", &given->family);
    put_option(&t, " --set ", &given->set);
    *t.at = '\0';
}

void source_text_name(const source_words *given, char *text, size_t size)
{
    const words *all[] = {&given->ndf, &given->slope, &given->csv, &given->family};
    text_end t = {text, text + size - 1};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i]->count)
            put_text(&t, only_word(all[i]));
    for (size_t i = 0; i < given->set.count; i++) {
        put_text(&t, ", ");
        put_text(&t, given->set.item[i]);
    }
    *t.at = '\0';
}
