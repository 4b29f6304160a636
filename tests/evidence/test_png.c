/* A PNG is what its standard says, and holds the picture: it is read back here, by code of the test's own. Where each
 * part begins follows from the size of the picture, since blocks are stored and chunks are three. */
#include "harness/test.h"

#include <stdint.h>
#include <stdlib.h>

#include "render/image.h"

enum { ROOM = 1 << 20, BLOCK = 65535, CHUNK = 12 };

static uint32_t big_endian(const unsigned char *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static uint32_t crc_of(const unsigned char *data, size_t size)
{
    uint32_t crc = ~0u;
    for (size_t i = 0; i < 8 * size; i++) {
        uint32_t bit = ((uint32_t)data[i / 8] >> i % 8 & 1u) ^ (crc & 1u);
        crc = crc >> 1 ^ (bit ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/* The data of a chunk, which has this name and length and is not damaged. */
static const unsigned char *chunk(const unsigned char *at, const char *name, size_t length)
{
    TEST(big_endian(at) == length && memcmp(at + 4, name, 4) == 0);
    TEST(big_endian(at + 8 + length) == crc_of(at + 4, length + 4));
    return at + 8;
}

/* A zlib stream of `size` bytes in stored blocks (RFC 1950, 1951). */
static void unpack(const unsigned char *at, size_t size, unsigned char *out)
{
    uint32_t a = 1, b = 0;
    TEST(at[0] == 0x78 && (at[0] * 256 + at[1]) % 31 == 0);
    at += 2;
    for (size_t done = 0, length; done < size; done += length, at += 5 + length) {
        length = size - done < BLOCK ? size - done : BLOCK;
        TEST(at[0] == (done + length == size) && at[1] + 256u * at[2] == length);
        TEST((at[1] ^ at[3]) == 255 && (at[2] ^ at[4]) == 255);
        memcpy(out + done, at + 5, length);
    }
    for (size_t i = 0; i < size; i++) {
        a = (a + out[i]) % 65521;
        b = (b + a) % 65521;
    }
    TEST(big_endian(at) == (b << 16 | a));
}

static unsigned char level(float x)
{
    double c = fmin(fmax((double)x, 0.0), 1.0);
    return (unsigned char)floor(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055) + 0.5);
}

static void check_pixels(const image *of, const unsigned char *rows, float exposure)
{
    int worst = 0;
    for (int y = 0; y < of->height; y++)
        for (int i = 0; i < 3 * of->width; i++) {
            int got = rows[(size_t)y * (3 * (size_t)of->width + 1) + 1 + (size_t)i];
            int off = abs(got - level(exposure * of->rgb[3 * y * of->width + i]));
            worst = off > worst ? off : worst;
        }
    TEST(worst <= 1); /* roundings of powf */
}

static void test_png(const char *pattern, int width, int height, float exposure)
{
    static unsigned char bytes[ROOM], out[ROOM];
    const size_t row = 3 * (size_t)width, whole = (row + 1) * (size_t)height,
                 packed = 2 + 5 * ((whole + BLOCK - 1) / BLOCK) + whole + 4;
    image made;
    vndf_error error;
    FILE *file = tmpfile();
    if (!TEST(file && image_make_pattern(&made, pattern, width, height, &error)))
        return;
    made.rgb[0] = NAN;
    made.rgb[1] = -INFINITY;
    made.rgb[2] = INFINITY;
    TEST(image_write_png(file, &made, exposure));
    made.rgb[0] = 0.0f;
    rewind(file);
    if (TEST(fread(bytes, 1, ROOM, file) == 8 + 3 * CHUNK + 13 + packed)) {
        TEST(memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0);
        const unsigned char *head = chunk(bytes + 8, "IHDR", 13);
        TEST(big_endian(head) == (uint32_t)width && big_endian(head + 4) == (uint32_t)height);
        TEST(memcmp(head + 8, "\x08\x02\0\0\0", 5) == 0);
        const unsigned char *data = chunk(head + 13 + 4, "IDAT", packed);
        unpack(data, whole, out);
        chunk(data + packed + 4, "IEND", 0);
        for (size_t y = 0; y < (size_t)height; y++)
            TEST(out[y * (row + 1)] == 0); /* no filter */
        check_pixels(&made, out, exposure);
    }
    fclose(file);
    image_free(&made);
}

static void test_full_disk(void)
{
    image made;
    FILE *full = fopen("/dev/full", "wb");
    if (!full)
        return;
    if (TEST(image_make(&made, 300, 300))) {
        TEST(!image_write_pfm(full, &made));
        clearerr(full);
        TEST(!image_write_png(full, &made, 1.0f));
        image_free(&made);
    }
    fclose(full);
}

int main(void)
{
    test_png("studio", 300, 200, 0.5f); /* three blocks */
    test_png("grid", 131, 77, 1.0f);
    test_png("tiles", 1, 1, 1.0f);
    test_full_disk();
    return test_done();
}
