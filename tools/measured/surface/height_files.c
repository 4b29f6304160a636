/* The files that heights come in; heights.h says which. */
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "measured/surface/grey.h"
#include "measured/surface/grid_text.h"
#include "measured/surface/heights.h"
#include "render/image.h"

/* ---- numbers between blanks ---------------------------------------------------------------------- */

typedef struct text_rows {
    float *z;
    size_t count, room;
    int width, height;
} text_rows;

static int add_number(text_rows *rows, double z)
{
    if (rows->count == rows->room) {
        size_t room = 2 * rows->room + 4096;
        float *larger = realloc(rows->z, room * sizeof *larger);
        if (!larger)
            return 0;
        rows->z = larger;
        rows->room = room;
    }
    rows->z[rows->count++] = (float)z;
    return 1;
}

/* The numbers of one line; -1 and the reason where one is none. */
static int read_row(text_rows *rows, grid_text *text, const char *name, refusal *why)
{
    char word[WORD_MAX];
    int width = 0;
    while (text_word(text, word)) {
        double z;
        if (word[0] == '#')
            break;
        if (!word_number(word, &z) || fabs(z) > 1e30)
            return refuse_data(why, name,
                               "line %zu: '%.40s' is no height; numbers between blanks are needed, nan where "
                               "there is none",
                               text->line, word) -
                   1;
        if (rows->count == HEIGHTS_MAX)
            return refuse_data(why, name, "line %zu: more than %d heights", text->line, HEIGHTS_MAX) - 1;
        if (!add_number(rows, z))
            return refuse_data(why, name, "there is no memory for %zu heights", rows->count) - 1;
        width++;
    }
    return width;
}

static int read_rows(text_rows *rows, grid_text *text, const char *name, refusal *why)
{
    do {
        int width = read_row(rows, text, name, why);
        if (width < 0)
            return 0;
        if (width > 0 && rows->height > 0 && width != rows->width)
            return refuse_data(why, name,
                               "line %zu: %d numbers, and %d in the lines before; every row needs as many",
                               text->line, width, rows->width);
        if (width > 0 && rows->height == HEIGHTS_SIDE_MAX)
            return refuse_data(why, name, "line %zu: more than %d rows", text->line, HEIGHTS_SIDE_MAX);
        rows->width = width > 0 ? width : rows->width;
        rows->height += width > 0;
    } while (text_line(text));
    return 1;
}

int heights_read_text(height_field *made, const char *name, const char *bytes, size_t size, refusal *why)
{
    grid_text text = text_from(bytes, size);
    text_rows rows = {NULL, 0, 0, 0, 0};
    *made = (height_field){0, 0, 1, 1, 0, NULL};
    int good = read_rows(&rows, &text, name, why) && heights_make(made, rows.width, rows.height, name, why);
    if (good)
        memcpy(made->z, rows.z, rows.count * sizeof *rows.z);
    free(rows.z);
    return good;
}

/* ---- ISO 25178-71 -------------------------------------------------------------------------------- */

typedef struct sdf_head {
    double points, profiles, step_x, step_y, scale, compression; /* 0 where a line is missing */
} sdf_head;

static void keep(sdf_head *head, const char *key, double value)
{
    const struct {
        const char *key;
        double *value;
    } known[] = {{"NumPoints", &head->points}, {"NumProfiles", &head->profiles},
                 {"Xscale", &head->step_x},    {"Yscale", &head->step_y},
                 {"Zscale", &head->scale},     {"Compression", &head->compression}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(key, known[i].key) == 0)
            *known[i].value = value;
}

/* "Key = value" with blanks or without. */
static void read_setting(sdf_head *head, grid_text *text, char word[WORD_MAX])
{
    char key[WORD_MAX], *equals = strchr(word, '=');
    double value;
    if (equals)
        *equals = '\0';
    memcpy(key, word, WORD_MAX);
    if (equals && equals[1])
        memmove(word, equals + 1, strlen(equals + 1) + 1);
    else {
        int more = text_word(text, word);
        if (more && !equals && word[0] == '=') {
            if (word[1])
                memmove(word, word + 1, strlen(word));
            else
                more = text_word(text, word);
        }
        if (!more)
            return;
    }
    if (word_number(word, &value))
        keep(head, key, value);
}

static int is_side(double value)
{
    return value >= 1 && value <= HEIGHTS_SIDE_MAX && value == floor(value);
}

static int read_head(sdf_head *head, grid_text *text, const char *name, refusal *why)
{
    char word[WORD_MAX];
    int ended = 0;
    while (!ended && text_line(text))
        if (text_word(text, word)) {
            ended = strcmp(word, "*") == 0;
            if (!ended)
                read_setting(head, text, word);
        }
    if (!ended)
        return refuse_data(why, name, "line %zu: the head of the .sdf does not end; a line * is missing",
                           text->line);
    if (!is_side(head->points) || !is_side(head->profiles))
        return refuse_data(why, name, "NumPoints %.10g and NumProfiles %.10g: both must be whole numbers up to %d",
                           head->points, head->profiles, HEIGHTS_SIDE_MAX);
    if (!(head->step_x > 0) || !(head->step_y > 0) || !(head->scale > 0))
        return refuse_data(why, name, "Xscale %.10g, Yscale %.10g, Zscale %.10g: all must be positive",
                           head->step_x, head->step_y, head->scale);
    if (head->compression != 0)
        return refuse_data(why, name, "Compression %.10g: only 0 is read", head->compression);
    return 1;
}

static int read_heights(height_field *to, const sdf_head *head, grid_text *text, const char *name, refusal *why)
{
    char word[WORD_MAX];
    size_t count = (size_t)to->width * (size_t)to->height;
    for (size_t i = 0; i < count; i++) {
        double z = NAN;
        if (!text_word_anywhere(text, word) || strcmp(word, "*") == 0)
            return refuse_data(why, name, "line %zu: the heights end after %zu of %d x %d", text->line, i,
                               to->width, to->height);
        if (strcmp(word, "BAD") != 0 && (!word_number(word, &z) || fabs(z * head->scale) > 1e30))
            return refuse_data(why, name, "line %zu: '%.40s' is no height", text->line, word);
        to->z[i] = (float)(z * head->scale);
    }
    if (text_word_anywhere(text, word) && strcmp(word, "*") != 0)
        return refuse_data(why, name, "line %zu: more than %d x %d heights", text->line, to->width, to->height);
    return 1;
}

int heights_read_sdf(height_field *made, const char *name, const char *bytes, size_t size, refusal *why)
{
    grid_text text = {bytes, size, 0, 1};
    sdf_head head = {0, 0, 0, 0, 0, 0};
    *made = (height_field){0, 0, 1, 1, 0, NULL};
    if (size < 1 || bytes[0] == 'b')
        return refuse_data(why, name, "this is a binary .sdf; the ASCII one, which begins with a, is read");
    if (!read_head(&head, &text, name, why) ||
        !heights_make(made, (int)head.points, (int)head.profiles, name, why))
        return 0;
    made->step_x = head.step_x;
    made->step_y = head.step_y;
    if (read_heights(made, &head, &text, name, why))
        return 1;
    heights_free(made);
    return 0;
}

/* ---- floats and pixels --------------------------------------------------------------------------- */

static float float_from(const unsigned char *b)
{
    uint32_t bits = (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
    float value;
    memcpy(&value, &bits, sizeof value);
    return fabs((double)value) <= 1e30 ? value : NAN;
}

static int read_raw(height_field *made, const char *name, const unsigned char *bytes, size_t size,
                    const height_form *form, refusal *why)
{
    if (!heights_make(made, form->width, form->height, name, why))
        return 0;
    size_t count = (size_t)made->width * (size_t)made->height;
    for (size_t i = 0; i < count && size == 4 * count; i++)
        made->z[i] = float_from(bytes + 4 * i);
    if (size == 4 * count)
        return 1;
    heights_free(made);
    return refuse_data(why, name, "%d x %d floats take %zu bytes, and there are %zu", form->width, form->height,
                       4 * count, size);
}

static int read_pfm(height_field *made, const char *name, const void *bytes, size_t size, refusal *why)
{
    image picture;
    image_error error = {""};
    if (!image_read_pfm_bytes(&picture, name, bytes, size, &error)) {
        memcpy(why->message, error.message, sizeof why->message);
        return 0;
    }
    int good = heights_make(made, picture.width, picture.height, name, why);
    for (size_t i = 0; good && i < (size_t)made->width * (size_t)made->height; i++)
        made->z[i] = picture.rgb[3 * i];
    image_free(&picture);
    return good;
}

static int read_grey(height_field *made, const char *name, const unsigned char *bytes, size_t size, refusal *why)
{
    grey_map map;
    if (!grey_read(&map, name, bytes, size, why))
        return 0;
    if (map.channels != 1)
        return refuse_data(why, name, "a PPM has colours; heights are a PGM, P5");
    if (!heights_make(made, map.width, map.height, name, why))
        return 0;
    for (size_t i = 0; i < (size_t)made->width * (size_t)made->height; i++)
        made->z[i] = (float)grey_at(&map, i);
    made->quantum = 1.0 / map.most;
    return 1;
}

static int begins(const char *bytes, size_t size, const char *with)
{
    return size >= strlen(with) && memcmp(bytes, with, strlen(with)) == 0;
}

static int read_any(height_field *made, const char *name, const char *bytes, size_t size, const height_form *form,
                    refusal *why)
{
    const unsigned char *raw = (const unsigned char *)bytes;
    if (form->width > 0)
        return read_raw(made, name, raw, size, form, why);
    if (begins(bytes, size, "PF") || begins(bytes, size, "Pf"))
        return read_pfm(made, name, bytes, size, why);
    if (size >= 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7')
        return read_grey(made, name, raw, size, why);
    if (size >= 5 && (memcmp(bytes + 1, "BCR-", 4) == 0 || memcmp(bytes + 1, "ISO-", 4) == 0))
        return heights_read_sdf(made, name, bytes, size, why);
    return heights_read_text(made, name, bytes, size, why);
}

int heights_read(height_field *made, const char *name, const void *bytes, size_t size, const height_form *form,
                 refusal *why)
{
    *made = (height_field){0, 0, 1, 1, 0, NULL};
    if (!read_any(made, name, bytes, size, form, why)) {
        heights_free(made);
        return 0;
    }
    made->step_x = form->step_x > 0 ? form->step_x : made->step_x;
    made->step_y = form->step_y > 0 ? form->step_y : made->step_y;
    return 1;
}
