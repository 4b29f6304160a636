/* PNG (ISO/IEC 15948): signature, then chunks of length, name, data, CRC. The pixels are rows, each with a byte
 * for its filter before it - none for a palette, for colours Paeth's (12.8) - in a zlib stream (RFC 1950) of one
 * deflate block with the codes that the standard fixes (RFC 1951, 3.2.6): codes of its own would save an eighth
 * of a noisy picture, and take 200 lines. Repeats are found greedily, by the last place where the same three
 * bytes began. */
#include "draw/png.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct bytes {
    unsigned char *data; /* owned by the caller of put_*; large enough for all */
    size_t size;
} bytes;

static void put(bytes *out, const void *data, size_t size)
{
    memcpy(out->data + out->size, data, size);
    out->size += size;
}

static void put_big_endian(bytes *out, uint32_t value)
{
    const unsigned char data[4] = {(unsigned char)(value >> 24), (unsigned char)(value >> 16 & 255u),
                                   (unsigned char)(value >> 8 & 255u), (unsigned char)(value & 255u)};
    put(out, data, 4);
}

static uint32_t crc_of(const unsigned char *data, size_t size)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1u ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    }
    return ~crc;
}

static void put_chunk(bytes *out, const char name[4], const unsigned char *data, size_t size)
{
    put_big_endian(out, (uint32_t)size);
    size_t start = out->size;
    put(out, name, 4);
    if (size)
        put(out, data, size);
    put_big_endian(out, crc_of(out->data + start, size + 4));
}

void base64_write(FILE *file, const unsigned char *data, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        uint32_t word = (uint32_t)data[i] << 16;
        word |= left > 1 ? (uint32_t)data[i + 1] << 8 : 0;
        word |= left > 2 ? data[i + 2] : 0;
        const char text[4] = {digit[word >> 18], digit[word >> 12 & 63u], left > 1 ? digit[word >> 6 & 63u] : '=',
                              left > 2 ? digit[word & 63u] : '='};
        fwrite(text, 1, 4, file);
    }
}

/* ---- rows ---- */

/* Left, up, or upper left, whichever is nearest to left + up - upper left. */
static int paeth(int left, int up, int corner)
{
    int a = abs(up - corner), b = abs(left - corner), c = abs(left + up - 2 * corner);
    return a <= b && a <= c ? left : b <= c ? up : corner;
}

/* Filters all rows of three bytes a pixel; each row takes one byte more in `to`. */
static void filter_rows(const unsigned char *rgb, size_t size, size_t height, unsigned char *to)
{
    for (size_t y = 0; y < height; y++) {
        const unsigned char *row = rgb + y * size, *above = y ? row - size : row;
        *to++ = 4;
        for (size_t i = 0; i < size; i++) {
            int left = i >= 3 ? row[i - 3] : 0, up = y ? above[i] : 0, corner = i >= 3 && y ? above[i - 3] : 0;
            *to++ = (unsigned char)((row[i] - paeth(left, up, corner)) & 255);
        }
    }
}

/* ---- deflate ---- */

enum { WINDOW = 32768, HASH_BITS = 15, MATCH_MIN = 3, MATCH_MAX = 258, END = 256 };

typedef struct bits {
    unsigned char *data; /* with room for all */
    size_t size;
    uint32_t hold; /* the lowest come first */
    unsigned count;
} bits;

static void put_bits(bits *b, unsigned value, unsigned count)
{
    b->hold |= (uint32_t)value << b->count;
    for (b->count += count; b->count >= 8; b->count -= 8, b->hold >>= 8)
        b->data[b->size++] = (unsigned char)(b->hold & 255u);
}

/* Codes have their highest bit first. */
static void put_code(bits *b, unsigned code, unsigned count)
{
    for (unsigned i = count; i-- > 0;)
        put_bits(b, code >> i & 1u, 1);
}

static void put_symbol(bits *b, unsigned symbol)
{
    if (symbol < 144)
        put_code(b, 48 + symbol, 8);
    else if (symbol < 256)
        put_code(b, 400 + symbol - 144, 9);
    else if (symbol < 280)
        put_code(b, symbol - 256, 7);
    else
        put_code(b, 192 + symbol - 280, 8);
}

/* A length or a distance: groups of two or four symbols, each with twice the range of the one before (3.2.5). */
typedef struct span {
    unsigned symbol, extra, rest; /* the symbol, the number of extra bits behind it, and their value */
} span;

static span span_of(unsigned value, unsigned group)
{
    span s = {0, 0, value};
    for (;; s.symbol++) {
        s.extra = s.symbol < 2 * group ? 0 : s.symbol / group - 1;
        if (s.rest < 1u << s.extra)
            return s;
        s.rest -= 1u << s.extra;
    }
}

static void put_match(bits *b, unsigned length, unsigned distance)
{
    const span last = {28, 0, 0}; /* the longest has a symbol of its own */
    span l = length < MATCH_MAX ? span_of(length - MATCH_MIN, 4) : last, d = span_of(distance - 1, 2);
    put_symbol(b, 257 + l.symbol);
    put_bits(b, l.rest, l.extra);
    put_code(b, d.symbol, 5);
    put_bits(b, d.rest, d.extra);
}

static uint32_t hash_of(const unsigned char *at)
{
    uint32_t three = (uint32_t)at[0] << 16 | (uint32_t)at[1] << 8 | at[2];
    return three * 2654435761u >> (32 - HASH_BITS);
}

/* head: 1 + the last place of each hash. */
static void pack(bits *b, uint32_t *head, const unsigned char *data, size_t size)
{
    for (size_t at = 0, length; at < size; at += length) {
        size_t most = size - at < MATCH_MAX ? size - at : MATCH_MAX, distance = WINDOW;
        length = 0;
        if (most >= MATCH_MIN) {
            uint32_t *last = &head[hash_of(data + at)];
            distance = *last ? at + 1 - *last : WINDOW;
            while (distance < WINDOW && length < most && data[at + length - distance] == data[at + length])
                length++;
            *last = (uint32_t)at + 1;
        }
        if (length < MATCH_MIN) {
            put_symbol(b, data[at]);
            length = 1;
            continue;
        }
        put_match(b, (unsigned)length, (unsigned)distance);
        for (size_t i = 1; i < length && size - at - i >= MATCH_MIN; i++)
            head[hash_of(data + at + i)] = (uint32_t)(at + i) + 1;
    }
}

static uint32_t adler_of(const unsigned char *data, size_t size)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

/* The stream of `size` bytes; the caller frees it. NULL if there is no memory. */
static unsigned char *deflate_bytes(const unsigned char *data, size_t size, size_t *packed)
{
    uint32_t *head = size < UINT32_MAX ? calloc((size_t)1 << HASH_BITS, sizeof *head) : NULL;
    bits b = {head ? malloc(size + size / 8 + 64) : NULL, 0, 0, 0}; /* nine bits a byte, at most */
    if (b.data) {
        uint32_t adler = adler_of(data, size);
        put_bits(&b, 0x0178, 16); /* deflate, a window of 32 KiB, no dictionary */
        put_bits(&b, 3, 3);       /* the last block, fixed codes */
        pack(&b, head, data, size);
        put_symbol(&b, END);
        put_bits(&b, 0, (8 - b.count) % 8);
        for (int i = 3; i >= 0; i--)
            put_bits(&b, adler >> 8 * i & 255u, 8);
        *packed = b.size;
    }
    free(head);
    return b.data;
}

/* ---- files ---- */

/* Colour type 3 has a palette, 2 red, green and blue. */
static void put_header(bytes *image, size_t width, size_t height, unsigned char colour_type)
{
    /* 8 bits, the one method of each kind, no interlace. */
    const unsigned char rest[5] = {8, colour_type, 0, 0, 0};
    bytes head = {(unsigned char[13]){0}, 0};
    put_big_endian(&head, (uint32_t)width);
    put_big_endian(&head, (uint32_t)height);
    put(&head, rest, 5);
    put(image, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(image, "IHDR", head.data, head.size);
}

static void put_palette(bytes *image, const png_colour palette[256])
{
    put_chunk(image, "PLTE", &palette[0].red, 256 * sizeof palette[0]);
    put_chunk(image, "tRNS", (const unsigned char[1]){0}, 1); /* opacity of the first colour; the rest is opaque */
}

/* The file of rows with their filters; the caller frees image->data. 0 if there is no memory. */
static int make_file(bytes *image, const unsigned char *rows, size_t row_size, size_t width, size_t height,
                     const png_colour *palette)
{
    size_t packed = 0;
    unsigned char *stream = deflate_bytes(rows, row_size * height, &packed);
    *image = (bytes){stream ? malloc(packed + 2048) : NULL, 0};
    if (image->data) {
        put_header(image, width, height, palette ? 3 : 2);
        if (palette)
            put_palette(image, palette);
        put_chunk(image, "IDAT", stream, packed);
        put_chunk(image, "IEND", NULL, 0);
    }
    free(stream);
    return image->data != NULL;
}

int png_write_base64(FILE *file, const unsigned char *index, size_t width, size_t height,
                     const png_colour palette[256])
{
    bytes image;
    unsigned char *rows = calloc(height, width + 1); /* the first byte of each: no filter */
    if (!rows)
        return 0;
    for (size_t y = 0; y < height; y++)
        memcpy(rows + y * (width + 1) + 1, index + y * width, width);
    int good = make_file(&image, rows, width + 1, width, height, palette);
    if (good)
        base64_write(file, image.data, image.size);
    free(image.data);
    free(rows);
    return good;
}

int png_write_rgb(FILE *file, const unsigned char *rgb, size_t width, size_t height)
{
    bytes image;
    unsigned char *rows = malloc((3 * width + 1) * height);
    if (!rows)
        return 0;
    filter_rows(rgb, 3 * width, height, rows);
    int good = make_file(&image, rows, 3 * width + 1, width, height, NULL);
    good = good && fwrite(image.data, 1, image.size, file) == image.size;
    free(image.data);
    free(rows);
    return good;
}
