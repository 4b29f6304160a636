/* Words of a command line: vndf_text_add_word writes what vndf_words_split reads. */
#include "source/words.h"

#include <stdlib.h>
#include <string.h>

#include "core/error.h"

static void add_bytes(vndf_text *text, const char *bytes, size_t size)
{
    if (text->failed || size >= (size_t)-1 / 4 - text->length)
        text->failed = 1;
    if (text->failed)
        return;
    if (text->length + size + 1 > text->capacity) {
        size_t capacity = 2 * (text->length + size + 32);
        char *grown = realloc(text->bytes, capacity);
        text->failed = grown == NULL;
        if (text->failed)
            return;
        text->bytes = grown;
        text->capacity = capacity;
    }
    memcpy(text->bytes + text->length, bytes, size);
    text->length += size;
    text->bytes[text->length] = '\0';
}

void vndf_text_add(vndf_text *text, const char *string)
{
    add_bytes(text, string, strlen(string));
}

static void add_char(vndf_text *text, char c)
{
    unsigned char byte = (unsigned char)c;
    if (c == '\'')
        vndf_text_add(text, "'\\''");
    else
        add_bytes(text, byte < 32 || byte == 127 ? " " : &c, 1);
}

void vndf_text_add_word(vndf_text *text, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
    int quote = word[0] == '\0' || word[strspn(word, plain)] != '\0';
    if (text->length > 0)
        vndf_text_add(text, " ");
    if (quote)
        vndf_text_add(text, "'");
    for (const char *c = word; *c; c++)
        add_char(text, *c);
    if (quote)
        vndf_text_add(text, "'");
}

char *vndf_text_finish(vndf_text *text, vndf_error *error)
{
    add_bytes(text, "", 0); /* so that an empty text is "" and not NULL */
    if (!text->failed)
        return text->bytes;
    free(text->bytes);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a text of %zu bytes", text->length);
    return NULL;
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* Copies one word from *from to *to, without its quotes; 0 if a quote is not closed. */
static int copy_word(const char **from, char **to)
{
    const char *in = *from;
    char *out = *to;
    int quoted = 0;
    for (; *in && (quoted || !is_blank(*in)); in++) {
        if (*in == '\'')
            quoted = !quoted;
        else if (*in == '\\' && !quoted && in[1])
            *out++ = *++in;
        else
            *out++ = *in;
    }
    *out++ = '\0';
    *from = in;
    *to = out;
    return !quoted;
}

vndf_status vndf_words_split(const char *line, vndf_words *words, vndf_error *error)
{
    size_t length = strlen(line);
    const char *in = line;
    *words = (vndf_words){malloc(length + 2), malloc((length / 2 + 1) * sizeof *words->word), 0};
    char *out = words->bytes;
    if (!words->bytes || !words->word) {
        vndf_words_free(words);
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a line of %zu characters", length);
    }
    for (;;) {
        while (is_blank(*in))
            in++;
        if (!*in)
            return VNDF_OK;
        size_t start = (size_t)(in - line);
        words->word[words->count++] = out;
        if (!copy_word(&in, &out)) {
            vndf_words_free(words);
            return vndf_fail(error, VNDF_ERROR_SYNTAX, "column %zu: a quote in this word is not closed",
                             start + 1);
        }
    }
}

void vndf_words_free(vndf_words *words)
{
    free(words->bytes);
    free(words->word);
    *words = (vndf_words){NULL, NULL, 0};
}

const char *vndf_excerpt(char out[VNDF_EXCERPT], const char *text, size_t size)
{
    size_t most = VNDF_EXCERPT - 4, length = size < most ? size : most;
    for (size_t i = 0; i < length; i++)
        out[i] = text[i] >= 32 && text[i] < 127 ? text[i] : '?';
    strcpy(out + length, size > most ? "..." : "");
    return out;
}
