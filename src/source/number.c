/* Numbers as text. The C library rounds correctly but follows the locale: this file puts the locale's decimal
 * point in before strtod and takes it out after snprintf. It checks the grammar itself, since strtod accepts
 * more. */
#include "source/number.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t digits(const char *text, size_t size, size_t at)
{
    size_t count = 0;
    while (at + count < size && text[at + count] >= '0' && text[at + count] <= '9')
        count++;
    return count;
}

/* An e without digits behind it belongs to the text after the number. */
static size_t exponent(const char *text, size_t size, size_t at)
{
    size_t start = at + 1;
    if (at >= size || (text[at] != 'e' && text[at] != 'E'))
        return 0;
    if (start < size && (text[start] == '+' || text[start] == '-'))
        start++;
    size_t count = digits(text, size, start);
    return count ? start + count - at : 0;
}

/* Length of the number at the start of text, and where its point is (or its end). */
static size_t number_length(const char *text, size_t size, size_t *point)
{
    size_t at = size > 0 && (text[0] == '+' || text[0] == '-');
    size_t whole = digits(text, size, at), part = 0;
    at += whole;
    *point = at;
    if (at < size && text[at] == '.') {
        part = digits(text, size, at + 1);
        at += 1 + part;
    }
    return whole + part == 0 ? 0 : at + exponent(text, size, at);
}

size_t vndf_number_read(const char *text, size_t size, double *value)
{
    char copy[VNDF_NUMBER_LENGTH + 32];
    const char *mark = localeconv()->decimal_point;
    size_t point, length = number_length(text, size, &point), mark_length = strlen(mark);
    if (length == 0 || length > VNDF_NUMBER_LENGTH || mark_length > 16)
        return 0;
    memcpy(copy, text, point);
    if (point == length || text[point] != '.')
        mark_length = 0;
    memcpy(copy + point, mark, mark_length);
    size_t rest = point + (mark_length > 0);
    memcpy(copy + point + mark_length, text + rest, length - rest);
    copy[length - rest + point + mark_length] = '\0';
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
