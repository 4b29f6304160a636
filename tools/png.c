/* PNG (ISO/IEC 15948): signature, then chunks of length, name, data, CRC. The pixels are a zlib stream
 * (RFC 1950) of stored deflate blocks (RFC 1951, 3.2.4): not compressed, but nothing else is needed. */
#include "png.h"

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

static uint32_t adler_of(const unsigned char *data, size_t size)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
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

static void put_stored(bytes *out, const unsigned char *data, size_t size)
{
    const size_t most = 65535;
    put(out, "\x78\x01", 2);
    for (size_t at = 0; at < size; at += most) {
        size_t part = size - at < most ? size - at : most;
        const unsigned char head[5] = {at + part == size, (unsigned char)(part & 255u), (unsigned char)(part >> 8),
                                       (unsigned char)(~part & 255u), (unsigned char)(~part >> 8 & 255u)};
        put(out, head, 5);
        put(out, data + at, part);
    }
    put_big_endian(out, adler_of(data, size));
}

static void write_base64(FILE *file, const unsigned char *data, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        uint32_t word = (uint32_t)data[i] << 16;
        word |= left > 1 ? (uint32_t)data[i + 1] << 8 : 0;
        word |= left > 2 ? data[i + 2] : 0;
        const char text[4] = {digit[word >> 18], digit[word >> 12 & 63u],
                              left > 1 ? digit[word >> 6 & 63u] : '=', left > 2 ? digit[word & 63u] : '='};
        fwrite(text, 1, 4, file);
    }
}

static void put_head(bytes *image, size_t width, size_t height, const colour palette[256])
{
    bytes head = {(unsigned char[13]){0}, 0};
    put_big_endian(&head, (uint32_t)width);
    put_big_endian(&head, (uint32_t)height);
    put(&head, "\x08\x03\x00\x00\x00", 5); /* 8 bits, palette, the one method of each kind, no interlace */
    put(image, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(image, "IHDR", head.data, head.size);
    put_chunk(image, "PLTE", &palette[0].red, 256 * sizeof palette[0]);
    put_chunk(image, "tRNS", (const unsigned char[1]){0}, 1); /* opacity of the first colour; the rest is opaque */
}

int png_write_base64(FILE *file, const unsigned char *index, size_t width, size_t height,
                     const colour palette[256])
{
    size_t raw = (width + 1) * height, room = raw + raw / 1000 + 2048;
    unsigned char *memory = calloc(3, room);
    if (!memory)
        return 0;
    bytes rows = {memory, 0}, stream = {memory + room, 0}, image = {memory + 2 * room, 0};
    for (size_t y = 0; y < height; y++) {
        put(&rows, "\0", 1); /* no filter */
        put(&rows, index + y * width, width);
    }
    put_stored(&stream, rows.data, rows.size);
    put_head(&image, width, height, palette);
    put_chunk(&image, "IDAT", stream.data, stream.size);
    put_chunk(&image, "IEND", NULL, 0);
    write_base64(file, image.data, image.size);
    free(memory);
    return 1;
}
