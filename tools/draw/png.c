/* PNG (ISO/IEC 15948): signature, then chunks of length, name, data, CRC. The pixels are rows, each with a byte
 * for its filter before it (none), in a zlib stream (RFC 1950) of blocks that are stored as they are (RFC 1951,
 * 3.2.4). Discs of densities and renderings are noise in their last bits: deflate with the codes that the standard
 * fixes saved nothing of the former and a quarter of the latter. */
#include "draw/png.h"

#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"

enum { BLOCK_MAX = 65535 };

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

static unsigned char *put(unsigned char *to, const void *data, size_t size)
{
    memcpy(to, data, size);
    return to + size;
}

static unsigned char *put_big_endian(unsigned char *to, size_t value)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        *to++ = (unsigned char)(value >> shift & 255u);
    return to;
}

/* The length before the name of a chunk and the CRC behind its data, which ends at `to`. */
static unsigned char *end_chunk(unsigned char *name, unsigned char *to)
{
    put_big_endian(name - 4, (size_t)(to - name) - 4);
    return put_big_endian(to, vndf_crc32(0, name, (size_t)(to - name)));
}

static unsigned char *put_chunk(unsigned char *to, const char name[4], const void *data, size_t size)
{
    return end_chunk(to + 4, put(put(to + 4, name, 4), data, size));
}

/* Pixels in rows of `row` bytes, with the filters, as a zlib stream. */
static unsigned char *put_zlib(unsigned char *to, const unsigned char *pixels, size_t row, size_t height)
{
    const size_t size = (row + 1) * height;
    uint32_t a = 1, b = 0;       /* Adler's sums */
    to = put(to, "\x78\x01", 2); /* deflate, a window of 32 KiB, no dictionary */
    for (size_t at = 0; at < size; at++) {
        if (at % BLOCK_MAX == 0) {
            const size_t left = size - at, count = left < BLOCK_MAX ? left : BLOCK_MAX;
            const unsigned char low = (unsigned char)(count & 255u), high = (unsigned char)(count >> 8);
            const unsigned char head[5] = {left <= BLOCK_MAX, low, high, (unsigned char)(low ^ 255u),
                                           (unsigned char)(high ^ 255u)};
            to = put(to, head, 5);
        }
        *to = at % (row + 1) == 0 ? 0 : *pixels++;
        a = (a + *to++) % 65521;
        b = (b + a) % 65521;
    }
    return put_big_endian(to, b << 16 | a);
}

int png_write(FILE *file, const unsigned char *pixels, size_t width, size_t height, const png_colour *palette)
{
    const size_t row = palette ? width : 3 * width, size = (row + 1) * height;
    unsigned char head[13], *image = malloc(size + size / 8192 + 2048), *to = image;
    if (!image)
        return 0;
    /* 8 bits; a palette, or red, green and blue; the one method of each kind, no interlace */
    put(put_big_endian(put_big_endian(head, width), height), palette ? "\x08\x03\0\0\0" : "\x08\x02\0\0\0", 5);
    to = put_chunk(put(to, "\x89PNG\r\n\x1a\n", 8), "IHDR", head, sizeof head);
    if (palette) {
        to = put_chunk(to, "PLTE", palette, 256 * sizeof palette[0]);
        to = put_chunk(to, "tRNS", "", 1); /* the first colour; the rest is opaque */
    }
    unsigned char *data = put(to + 4, "IDAT", 4);
    to = end_chunk(to + 4, put_zlib(data, pixels, row, height));
    to = put_chunk(to, "IEND", "", 0);
    if (palette)
        base64_write(file, image, (size_t)(to - image));
    else
        fwrite(image, 1, (size_t)(to - image), file);
    free(image);
    return palette || !ferror(file);
}
