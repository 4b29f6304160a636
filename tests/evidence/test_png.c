/* A PNG is what its standard says, and holds the picture: it is read back here, by code of the test's own. */

#include "core/checksum.h"
#include "harness/test.h"
#include "render/image.h"

enum { ROOM = 1 << 20, BLOCK = 65535 };

static uint32_t big_endian(const unsigned char *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* The data of the chunk at *at, which has this name and is not damaged; *at goes on behind it. */
static const unsigned char *chunk(const unsigned char **at, const char *name, size_t *length)
{
    const unsigned char *begin = *at + 4, *data = begin + 4;
    *length = big_endian(*at) % ROOM;
    TEST(memcmp(begin, name, 4) == 0 && vndf_crc32(0, begin, *length + 4) == big_endian(data + *length));
    *at = data + *length + 4;
    return data;
}

/* A zlib stream of stored blocks (RFC 1950, 1951) that holds `size` bytes, put where the stream begins. */
static void unpack(unsigned char *at, size_t length, size_t size)
{
    uint32_t a = 1, b = 0;
    unsigned char *out = at, *in = at + 2;
    if (!TEST(length == 2 + 5 * ((size + BLOCK - 1) / BLOCK) + size + 4 && at[0] == 0x78 && at[1] == 1))
        return;
    for (size_t i = 0, left = 0; i < size; i++, left--) {
        if (left == 0) {
            left = size - i < BLOCK ? size - i : BLOCK;
            TEST(in[0] == (i + left == size) && in[1] + 256u * in[2] == left && (in[1] ^ in[3]) == 255 &&
                 (in[2] ^ in[4]) == 255);
            in += 5;
        }
        out[i] = *in++;
        a = (a + out[i]) % 65521;
        b = (b + a) % 65521;
    }
    TEST(big_endian(in) == (b << 16 | a));
}

static double level(float x)
{
    double c = fmin(fmax((double)x, 0.0), 1.0);
    return floor(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055) + 0.5);
}

static void test_png(image_pattern pattern, int width, int height)
{
    static unsigned char bytes[ROOM];
    const unsigned char *at = bytes + 8;
    const size_t row = 3 * (size_t)width + 1, all = row * (size_t)height;
    size_t length;
    image made;
    FILE *file = tmpfile(), *full = fopen("/dev/full", "wb");
    if (!TEST(file && image_make_pattern(&made, pattern, width, height)))
        return;
    made.rgb[0] = NAN, made.rgb[1] = -INFINITY, made.rgb[2] = INFINITY;
    TEST(image_write_png(file, &made));
    rewind(file);
    const size_t size = fread(bytes, 1, ROOM, file);
    TEST(memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0);
    const unsigned char *head = chunk(&at, "IHDR", &length);
    TEST(length == 13 && memcmp(head + 8, "\x08\x02\0\0\0", 5) == 0);
    TEST(big_endian(head) == (uint32_t)width && big_endian(head + 4) == (uint32_t)height);
    const unsigned char *data = chunk(&at, "IDAT", &length);
    const size_t packed = length;
    chunk(&at, "IEND", &length);
    TEST(length == 0 && at == bytes + size);
    unpack(bytes + (data - bytes), packed, all);
    double worst = 0; /* 1: roundings of powf */
    made.rgb[0] = 0.0f;
    for (size_t i = 0; i < all; i++) /* a filter, which is none, before each row */
        worst = fmax(worst, i % row ? fabs(data[i] - level(made.rgb[i - i / row - 1])) : 2 * data[i]);
    TEST(worst <= 1);
    if (full && width * height > 10000) { /* more than a buffer holds */
        TEST(!image_write_pfm(full, &made));
        clearerr(full);
        TEST(!image_write_png(full, &made));
    }
    if (full)
        fclose(full);
    fclose(file);
    image_free(&made);
}

int main(void)
{
    test_png(IMAGE_STUDIO, 300, 200); /* three blocks */
    test_png(IMAGE_GRID, 131, 77);
    test_png(IMAGE_TILES, 1, 1);
    return test_done();
}
