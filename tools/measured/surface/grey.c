#include "measured/surface/grey.h"

#include "measured/surface/heights.h"

typedef struct cursor {
    const unsigned char *bytes;
    size_t size, at;
} cursor;

static int is_blank(unsigned char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static void skip_blanks(cursor *c)
{
    while (c->at < c->size && (is_blank(c->bytes[c->at]) || c->bytes[c->at] == '#')) {
        int comment = c->bytes[c->at] == '#';
        while (comment && c->at < c->size && c->bytes[c->at] != '\n')
            c->at++;
        c->at += c->at < c->size;
    }
}

/* A whole number from 1 to `most`; 0 where there is none. */
static int read_whole(cursor *c, int most)
{
    int value = 0, digits = 0;
    skip_blanks(c);
    for (; c->at < c->size && c->bytes[c->at] >= '0' && c->bytes[c->at] <= '9' && digits < 7; c->at++, digits++)
        value = 10 * value + (c->bytes[c->at] - '0');
    return digits > 0 && value <= most ? value : 0;
}

static size_t bytes_a_number(const grey_map *map)
{
    return map->most > 255 ? 2 : 1;
}

int grey_read(grey_map *made, const char *name, const unsigned char *bytes, size_t size, refusal *why)
{
    cursor c = {bytes, size, 2};
    if (size < 2 || bytes[0] != 'P' || (bytes[1] != '5' && bytes[1] != '6'))
        return refuse_data(why, name, "of PGM and PPM the binary ones are read, which begin with P5 or P6");
    *made = (grey_map){bytes[1] == '6' ? 3 : 1, 0, 0, 0, NULL};
    made->width = read_whole(&c, HEIGHTS_SIDE_MAX);
    made->height = read_whole(&c, HEIGHTS_SIDE_MAX);
    made->most = read_whole(&c, 65535);
    if (made->width == 0 || made->height == 0 || made->most == 0 || c.at == c.size || !is_blank(c.bytes[c.at]))
        return refuse_data(why, name,
                           "the head of the image is not whole: width and height up to %d, the largest "
                           "value up to 65535, and a blank",
                           HEIGHTS_SIDE_MAX);
    if ((size_t)made->width * (size_t)made->height > HEIGHTS_MAX)
        return refuse_data(why, name, "%d x %d pixels are more than %d", made->width, made->height, HEIGHTS_MAX);
    made->pixel = bytes + c.at + 1;
    size_t want = (size_t)made->width * (size_t)made->height * (size_t)made->channels * bytes_a_number(made);
    size_t have = size - c.at - 1;
    if (have != want)
        return refuse_data(why, name, "%d x %d pixels take %zu bytes after the head, and there are %zu",
                           made->width, made->height, want, have);
    return 1;
}

double grey_at(const grey_map *map, size_t i)
{
    const unsigned char *b = map->pixel + i * bytes_a_number(map);
    int value = map->most > 255 ? b[0] << 8 | b[1] : b[0];
    return (double)value / map->most;
}
