#include "measured/data.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"

enum { REACH_MOST = 256 }; /* values on each side that smoothing looks at */

int refuse(data_file *file, const char *format, ...)
{
    int length = snprintf(file->refused, sizeof file->refused, "%.300s: ", file->name);
    va_list list;
    va_start(list, format);
    vsnprintf(file->refused + length, sizeof file->refused - (size_t)length, format, list);
    va_end(list);
    return 0;
}

void note(data_file *file, const char *format, ...)
{
    size_t used = strlen(file->notes), room = sizeof file->notes - used;
    va_list list;
    va_start(list, format);
    int length = vsnprintf(file->notes + used, room, format, list);
    va_end(list);
    int fits = length >= 0 && (size_t)length + 1 < room;
    memcpy(file->notes + used + (fits ? (size_t)length : 0), fits ? "\n" : "", fits ? 2 : 1);
}

/* ---- numbers and words --------------------------------------------------------------------------- */

uint64_t little_whole(const unsigned char *at, size_t bytes)
{
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; i++)
        value |= (uint64_t)at[i] << 8 * i;
    return value;
}

double little_float(const unsigned char *at)
{
    uint32_t bits = (uint32_t)little_whole(at, 4);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

double little_double(const unsigned char *at)
{
    uint64_t bits = little_whole(at, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

void put_little(FILE *file, uint64_t value, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        fputc((int)(value >> 8 * i & 255), file);
}

scan scan_from(const data_file *file)
{
    int is_marked = file->size >= 3 && memcmp(file->bytes, "\xEF\xBB\xBF", 3) == 0;
    return (scan){file->bytes, file->size, is_marked ? 3 : 0, 1};
}

static int is_blank(const scan *from)
{
    unsigned char c = from->bytes[from->at];
    return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n');
}

int scan_word(scan *from, char word[WORD_MAX])
{
    size_t length = 0;
    while (from->at < from->size && is_blank(from))
        from->at++;
    if (from->at < from->size && from->bytes[from->at] == '#')
        return 0;
    for (; from->at < from->size && !is_blank(from) && from->bytes[from->at] != '\n'; from->at++)
        if (length < WORD_MAX - 1) {
            unsigned char c = from->bytes[from->at];
            word[length++] = c > ' ' && c <= '~' ? (char)c : '?';
        }
    word[length] = '\0';
    return length > 0;
}

int scan_line(scan *from)
{
    while (from->at < from->size && from->bytes[from->at] != '\n')
        from->at++;
    if (from->at == from->size)
        return 0;
    from->at++;
    from->line++;
    return from->at < from->size;
}

int scan_word_anywhere(scan *from, char word[WORD_MAX])
{
    while (!scan_word(from, word))
        if (!scan_line(from))
            return 0;
    return 1;
}

int word_number(const char *word, double *value)
{
    char *end;
    *value = strtod(word, &end);
    return end != word && *end == '\0' && !isinf(*value);
}

/* ---- rows ---------------------------------------------------------------------------------------- */

int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count, data_file *file)
{
    *made = (profile){over, of, count, calloc(count, sizeof(double)), calloc(count, sizeof(double))};
    if (made->x && made->value)
        return 1;
    profile_free(made);
    return refuse(file, "there is no memory for %zu rows", count);
}

void profile_free(profile *freed)
{
    free(freed->x);
    free(freed->value);
    *freed = (profile){freed->over, freed->of, 0, NULL, NULL};
}

vndf_source *profile_source(const profile *from, data_file *file)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_rows(from->over, from->of, from->x, from->value, from->count, NULL, &error);
    if (!source)
        refuse(file, "what was found is no curve: %s", error.message);
    return source;
}

int profile_write(FILE *file, const profile *from, const char *title)
{
    fprintf(file, "# %s\n", title);
    fprintf(file, "%s,%s\n", from->over == VNDF_ROWS_OVER_SLOPE ? "slope" : "theta",
            from->of == VNDF_ROWS_OF_P22 ? "p22" : "ndf");
    for (size_t i = 0; i < from->count; i++)
        fprintf(file, "%.17g,%.17g\n", from->x[i], from->value[i]);
    return fflush(file) == 0 && !ferror(file);
}

/* ---- noise --------------------------------------------------------------------------------------- */

/* Of logarithms, from their fourth differences, which a curve that is smooth at these steps hardly has: noise of one
 * deviation gives them sqrt(70). The median does not see jumps. */
static double noise_of(const double *value, size_t count, double *room)
{
    size_t n = 0;
    for (size_t i = 2; i + 2 < count; i++)
        room[n++] = fabs(value[i - 2] - 4 * value[i - 1] + 6 * value[i] - 4 * value[i + 1] + value[i + 2]);
    if (n == 0)
        return 0;
    sort_numbers(room, n);
    return room[n / 2] / (0.6745 * sqrt(70));
}

/* Means over `reach` values on both sides, fewer at the ends, which keep straight lines; returns the root of the mean
 * square by which values moved. */
static double smoothed(const double *value, size_t count, size_t reach, double *to)
{
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        size_t near = i < count - 1 - i ? i : count - 1 - i, wide = near < reach ? near : reach;
        double sum = 0, whole = 0;
        for (size_t k = i - wide; k <= i + wide; k++) {
            double away = ((double)k - (double)i) / (double)(wide + 1), weight = 1 - away * away;
            sum += weight * value[k];
            whole += weight;
        }
        to[i] = sum / whole;
        square += (to[i] - value[i]) * (to[i] - value[i]) / (double)count;
    }
    return sqrt(square);
}

/* `value` are logarithms; the widest smoothing that moves them by no more than the noise. */
static double smooth(double *value, size_t count, double *room, double *best)
{
    double noise = noise_of(value, count, room);
    memcpy(best, value, count * sizeof *best);
    for (size_t reach = 1; reach < REACH_MOST && reach < count / 4 && smoothed(value, count, reach, room) <= noise;
         reach += 1 + reach / 4)
        memcpy(best, room, count * sizeof *best);
    memcpy(value, best, count * sizeof *best);
    return noise;
}

int profile_smooth(profile *changed, data_file *file)
{
    size_t count = 0;
    while (count < changed->count && changed->value[count] > 0)
        count++;
    double *value = malloc((count + 1) * 3 * sizeof *value);
    if (!value)
        return refuse(file, "there is no memory for %zu rows", changed->count);
    for (size_t i = 0; i < count; i++)
        value[i] = log(changed->value[i]);
    note(file, "noise %.2g", smooth(value, count, value + count, value + 2 * count));
    for (size_t i = 0; i < count; i++)
        changed->value[i] = exp(value[i]);
    free(value);
    return 1;
}
