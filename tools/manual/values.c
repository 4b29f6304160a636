#include "manual/values.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static int is_file(const char *text, size_t length)
{
    static const char *const places[] = {"FILE", "OUT", "DIR", "SCENE", "PAGE", "RAW"};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (length >= strlen(places[i]) && memcmp(text, places[i], strlen(places[i])) == 0)
            return 1;
    return length == 1 && *text == 'F';
}

/* A word is typed as it stands; other alternatives are names of what is meant. */
static int is_word(const char *text, size_t length)
{
    if (length == 0 || !(islower((unsigned char)*text) || isdigit((unsigned char)*text)))
        return 0;
    for (size_t i = 0; i < length; i++)
        if (!isalnum((unsigned char)text[i]))
            return 0;
    return 1;
}

static void add(values *to, const char *word, size_t length)
{
    size_t at = strlen(to->words);
    snprintf(to->words + at, sizeof to->words - at, "%s%.*s", at ? " " : "", (int)length, word);
}

void values_add(values *to, const char *word)
{
    add(to, word, strlen(word));
}

values values_of(const char *text)
{
    values v = {"", 0};
    while (*text) {
        size_t length = strcspn(text, "|");
        if (is_file(text, length))
            v.files = 1;
        else if (is_word(text, length))
            add(&v, text, length);
        text += length + (text[length] == '|');
    }
    return v;
}
