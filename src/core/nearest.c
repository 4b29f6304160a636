#include "core/nearest.h"

#include <string.h>

static int small(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

/* Row by row; row[0] is the current one, row[1] and row[2] are those before. */
size_t vndf_word_distance(const char *text, size_t size, const char *word)
{
    enum { LONGEST = 64 };
    size_t row[3][LONGEST + 1] = {{0}}, length = size < LONGEST ? size : LONGEST;
    for (size_t i = 0; i <= length; i++)
        row[0][i] = i;
    for (size_t w = 0; word[w]; w++) {
        memmove(row[1], row[0], 2 * sizeof row[0]);
        row[0][0]++;
        for (size_t i = 1; i <= length; i++) {
            size_t best = row[1][i - 1] + (small(text[i - 1]) != small(word[w]));
            if (row[0][i - 1] + 1 < best)
                best = row[0][i - 1] + 1;
            if (row[1][i] + 1 < best)
                best = row[1][i] + 1;
            const int turned =
                i > 1 && w > 0 && small(text[i - 1]) == small(word[w - 1]) && small(text[i - 2]) == small(word[w]);
            if (turned && row[2][i - 2] + 1 < best)
                best = row[2][i - 2] + 1;
            row[0][i] = best;
        }
    }
    return row[0][length];
}

size_t vndf_word_slip(size_t size)
{
    return size < 5 ? 2 : 3;
}

int vndf_word_is_nearer(const char *text, size_t size, const char *word, size_t *least)
{
    size_t distance = vndf_word_distance(text, size, word);
    if (distance >= *least || distance >= strlen(word) || distance >= size)
        return 0;
    *least = distance;
    return 1;
}
