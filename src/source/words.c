/* Words of a command line: vndf_text_add_word writes what vndf_words_split reads. Numbers: the C library rounds
 * correctly but follows the locale, so the locale's decimal point is put in before strtod and taken out after
 * snprintf; the grammar is checked here, since strtod accepts more. */
#include "source/words.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"

void vndf_text_add(vndf_writer *text, const char *string)
{
    vndf_write_bytes(text, string, strlen(string));
}

void vndf_text_add_number(vndf_writer *text, double value)
{
    char number[VNDF_NUMBER_TEXT];
    vndf_text_add(text, vndf_number_print(number, value));
}

void vndf_text_add_word(vndf_writer *text, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
    int quote = word[0] == '\0' || word[strspn(word, plain)] != '\0';
    if (text->size > 0)
        vndf_text_add(text, " ");
    if (quote)
        vndf_text_add(text, "'");
    for (const char *c = word; *c; c++) {
        unsigned char byte = (unsigned char)*c;
        if (byte == '\'')
            vndf_text_add(text, "'\\''");
        else
            vndf_write_bytes(text, byte < 32 || byte == 127 ? " " : c, 1);
    }
    if (quote)
        vndf_text_add(text, "'");
}

char *vndf_text_finish(vndf_writer *text, vndf_error *error)
{
    vndf_write_bytes(text, "", 1);
    if (!text->failed)
        return (char *)text->bytes;
    free(text->bytes);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a text of %zu bytes", text->size);
    return NULL;
}

char *vndf_text_pair(const char *option, const char *word, const char *tail, vndf_error *error)
{
    vndf_writer text = {NULL, 0, 0, 0};
    if (word && strlen(word) > VNDF_LIMIT_NAME_LENGTH)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a name of %zu characters; at most %d are possible",
                         strlen(word), VNDF_LIMIT_NAME_LENGTH),
               NULL;
    vndf_text_add_word(&text, option);
    vndf_text_add_word(&text, word ? word : "unnamed");
    vndf_text_add(&text, tail);
    return vndf_text_finish(&text, error);
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
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
        int quoted = 0;
        while (is_blank(*in))
            in++;
        if (!*in)
            return VNDF_OK;
        size_t start = (size_t)(in - line);
        words->word[words->count++] = out;
        for (; *in && (quoted || !is_blank(*in)); in++)
            if (*in == '\'')
                quoted = !quoted;
            else
                *out++ = *in == '\\' && !quoted && in[1] ? *++in : *in;
        *out++ = '\0';
        if (quoted) {
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

vndf_span vndf_cut(vndf_span *rest, char separator)
{
    const char *end = rest->size > 0 ? memchr(rest->text, separator, rest->size) : NULL;
    vndf_span head = {rest->text, end ? (size_t)(end - rest->text) : rest->size, rest->column};
    size_t used = head.size + (end != NULL);
    *rest = (vndf_span){rest->text + used, rest->size - used, rest->column + used};
    return head;
}

size_t vndf_character(const char *text, size_t size)
{
    const unsigned char *at = (const unsigned char *)text;
    const size_t length = *at < 0xc2 || *at > 0xf4 ? 1 : *at < 0xe0 ? 2 : *at < 0xf0 ? 3 : 4;
    size_t n = 1;
    while (n < length && n < size && (at[n] & 0xc0) == 0x80)
        n++;
    return n == length ? n : 1;
}

const char *vndf_excerpt(char out[VNDF_EXCERPT], const char *text, size_t size)
{
    size_t i = 0, length = 0;
    for (size_t n; i < size && length + (n = vndf_character(text + i, size - i)) <= VNDF_EXCERPT - 4; i += n)
        for (size_t k = 0; k < n; k++)
            out[length++] = n > 1 || (text[i] >= 32 && text[i] < 127) ? text[i + k] : '?';
    strcpy(out + length, i < size ? "..." : "");
    return out;
}

int vndf_is_word(const char *text, size_t size, const char *word)
{
    return strlen(word) == size && memcmp(text, word, size) == 0;
}

/* ---- numbers ---------------------------------------------------------------------------------- */

/* The place behind the digits at a place. */
static size_t behind_digits(const char *text, size_t size, size_t at)
{
    while (at < size && text[at] >= '0' && text[at] <= '9')
        at++;
    return at;
}

static int is_sign(const char *text, size_t size, size_t at)
{
    return at < size && (text[at] == '+' || text[at] == '-');
}

/* Length of the number at the start of text, and where its point is (or its end). An e without digits behind it
 * belongs to the text after the number. */
static size_t number_length(const char *text, size_t size, size_t *point)
{
    size_t first = (size_t)is_sign(text, size, 0), end = *point = behind_digits(text, size, first);
    if (end < size && text[end] == '.')
        end = behind_digits(text, size, end + 1);
    if (end - first == (size_t)(end > *point)) /* no digit */
        return 0;
    if (end < size && (text[end] == 'e' || text[end] == 'E')) {
        size_t start = end + 1 + (size_t)is_sign(text, size, end + 1), behind = behind_digits(text, size, start);
        end = behind > start ? behind : end;
    }
    return end;
}

size_t vndf_number_read(const char *text, size_t size, double *value)
{
    char copy[VNDF_NUMBER_LENGTH + 32];
    size_t point, length = number_length(text, size, &point);
    if (length == 0 || length > VNDF_NUMBER_LENGTH)
        return 0;
    int has_point = point < length && text[point] == '.';
    snprintf(copy, sizeof copy, "%.*s%s%.*s", (int)point, text, has_point ? localeconv()->decimal_point : "",
             (int)length - (int)point - has_point, text + point + has_point);
    *value = strtod(copy, NULL);
    return length;
}

int vndf_number_is_all(const char *text, size_t size, double *value)
{
    return size > 0 && vndf_number_read(text, size, value) == size;
}

const char *vndf_number_print(char out[VNDF_NUMBER_TEXT], double value)
{
    char text[VNDF_NUMBER_TEXT]; /* gcc's sanitizers would warn that out may be NULL */
    for (int precision = 15; precision <= 17; precision++) {
        snprintf(text, sizeof text, "%.*g", precision, value);
        if (strtod(text, NULL) == value)
            break;
    }
    const char *mark = localeconv()->decimal_point;
    char *found = strcmp(mark, ".") ? strstr(text, mark) : NULL;
    if (found) {
        *found = '.';
        memmove(found + 1, found + strlen(mark), strlen(found + strlen(mark)) + 1);
    }
    return memcpy(out, text, strlen(text) + 1);
}
