/* PNG (ISO/IEC 15948): signature, then chunks of length, name, data, CRC. The pixels are rows, each with a byte
 * for its filter before it (none), in a zlib stream (RFC 1950) of blocks that are stored as they are (RFC 1951,
 * 3.2.4). Discs of densities and renderings are noise in their last bits: deflate with the codes that the standard
 * fixes saved nothing of the former and a quarter of the latter. */
#include "draw/png.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"

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
    for (int shift = 24; shift >= 0; shift -= 8)
        out->data[out->size++] = (unsigned char)(value >> shift & 255u);
}

static void put_chunk(bytes *out, const char name[4], const unsigned char *data, size_t size)
{
    put_big_endian(out, (uint32_t)size);
    size_t start = out->size;
    put(out, name, 4);
    if (size)
        put(out, data, size);
    put_big_endian(out, vndf_crc32(0, out->data + start, size + 4));
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

static void put_zlib(bytes *out, const unsigned char *data, size_t size)
{
    enum { BLOCK_MAX = 65535 };
    put(out, "\x78\x01", 2); /* deflate, a window of 32 KiB, no dictionary */
    for (size_t at = 0, count; at < size; at += count) {
        count = size - at < BLOCK_MAX ? size - at : BLOCK_MAX;
        const unsigned char low = (unsigned char)(count & 255u), high = (unsigned char)(count >> 8);
        const unsigned char head[5] = {at + count == size, low, high, (unsigned char)(low ^ 255u),
                                       (unsigned char)(high ^ 255u)};
        put(out, head, 5);
        put(out, data + at, count);
    }
    put_big_endian(out, adler_of(data, size));
}

/* The file of rows of `row` bytes; the caller frees image->data. 0 if there is no memory. */
static int make_file(bytes *image, const unsigned char *pixels, size_t row, size_t width, size_t height,
                     const png_colour *palette)
{
    const size_t size = (row + 1) * height, room = size + size / 8192 + 2048;
    bytes rows = {calloc(size ? size : 1, 1), 0}, head = {(unsigned char[13]){0}, 0}, stream = {malloc(room), 0};
    *image = (bytes){malloc(room), 0};
    int good = rows.data && stream.data && image->data;
    if (good) {
        for (size_t y = 0; y < height; y++)
            memcpy(rows.data + y * (row + 1) + 1, pixels + y * row, row);
        put_zlib(&stream, rows.data, size);
        put_big_endian(&head, (uint32_t)width);
        put_big_endian(&head, (uint32_t)height);
        /* 8 bits; a palette, or red, green and blue; the one method of each kind, no interlace */
        put(&head, palette ? "\x08\x03\0\0\0" : "\x08\x02\0\0\0", 5);
        put(image, "\x89PNG\r\n\x1a\n", 8);
        put_chunk(image, "IHDR", head.data, head.size);
        if (palette) {
            put_chunk(image, "PLTE", &palette[0].red, 256 * sizeof palette[0]);
            put_chunk(image, "tRNS", (const unsigned char[1]){0}, 1); /* the first colour; the rest is opaque */
        }
        put_chunk(image, "IDAT", stream.data, stream.size);
        put_chunk(image, "IEND", NULL, 0);
    }
    free(rows.data);
    free(stream.data);
    return good;
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

int png_write_base64(FILE *file, const unsigned char *index, size_t width, size_t height,
                     const png_colour palette[256])
{
    bytes image;
    int good = make_file(&image, index, width, width, height, palette);
    if (good)
        base64_write(file, image.data, image.size);
    free(image.data);
    return good;
}

int png_write_rgb(FILE *file, const unsigned char *rgb, size_t width, size_t height)
{
    bytes image;
    int good = make_file(&image, rgb, 3 * width, width, height, NULL) &&
               fwrite(image.data, 1, image.size, file) == image.size;
    free(image.data);
    return good;
}
