/* A PNG is what its standard says, and holds the picture: it is read back here, by code of the test's own. */
#include "harness/test.h"

#include <stdint.h>

#include "render/image.h"

enum { ROOM = 1 << 20, BLOCK = 65535 };

static uint32_t big_endian(const unsigned char *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* The data of the chunk at *at, which has this name and is not damaged; *at goes on behind it. */
static const unsigned char *chunk(const unsigned char **at, const char *name, size_t *length)
{
    const unsigned char *begin = *at + 4;
    uint32_t crc = ~0u;
    *length = big_endian(*at);
    TEST(memcmp(begin, name, 4) == 0 && *length < ROOM);
    for (size_t i = 0; i < 8 * (*length % ROOM + 4); i++) {
        uint32_t bit = ((uint32_t)begin[i / 8] >> i % 8 & 1u) ^ (crc & 1u);
        crc = crc >> 1 ^ (bit ? 0xEDB88320u : 0u);
    }
    TEST(big_endian(begin + 4 + *length % ROOM) == ~crc);
    *at = begin + 4 + *length % ROOM + 4;
    return begin + 4;
}

/* A zlib stream of stored blocks (RFC 1950, 1951) that holds `size` bytes. */
static void unpack(const unsigned char *at, size_t length, size_t size, unsigned char *out)
{
    uint32_t a = 1, b = 0;
    if (!TEST(length == 2 + 5 * ((size + BLOCK - 1) / BLOCK) + size + 4 && at[0] == 0x78 && at[1] == 1))
        return;
    at += 2;
    for (size_t done = 0, count; done < size; done += count, at += 5 + count) {
        count = size - done < BLOCK ? size - done : BLOCK;
        TEST(at[0] == (done + count == size) && at[1] + 256u * at[2] == count);
        TEST((at[1] ^ at[3]) == 255 && (at[2] ^ at[4]) == 255);
        memcpy(out + done, at + 5, count);
    }
    for (size_t i = 0; i < size; i++) {
        a = (a + out[i]) % 65521;
        b = (b + a) % 65521;
    }
    TEST(big_endian(at) == (b << 16 | a));
}

static double level(float x)
{
    double c = fmin(fmax((double)x, 0.0), 1.0);
    return floor(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055) + 0.5);
}

static void test_png(const char *pattern, int width, int height)
{
    static unsigned char bytes[ROOM], out[ROOM];
    const unsigned char *at = bytes + 8;
    const size_t row = 3 * (size_t)width + 1;
    size_t length, size;
    image made;
    vndf_error error;
    FILE *file = tmpfile();
    if (!TEST(file && image_make_pattern(&made, pattern, width, height, &error)))
        return;
    made.rgb[0] = NAN;
    made.rgb[1] = -INFINITY;
    made.rgb[2] = INFINITY;
    TEST(image_write_png(file, &made));
    rewind(file);
    size = fread(bytes, 1, ROOM, file);
    TEST(memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0);
    const unsigned char *head = chunk(&at, "IHDR", &length);
    TEST(length == 13 && memcmp(head + 8, "\x08\x02\0\0\0", 5) == 0);
    TEST(big_endian(head) == (uint32_t)width && big_endian(head + 4) == (uint32_t)height);
    const unsigned char *data = chunk(&at, "IDAT", &length);
    unpack(data, length, row * (size_t)height, out);
    chunk(&at, "IEND", &length);
    TEST(length == 0 && at == bytes + size);
    double worst = 0; /* 1: roundings of powf */
    made.rgb[0] = 0.0f;
    for (size_t i = 0; i < row * (size_t)height; i++) /* a filter, which is none, before each row */
        worst = fmax(worst, fabs(out[i] - (i % row ? level(made.rgb[i - i / row - 1]) : 0)));
    TEST(worst <= 1);
    for (size_t y = 0; y < (size_t)height; y++)
        TEST(out[y * row] == 0);
    fclose(file);
    image_free(&made);
}

static void test_full_disk(void)
{
    image made;
    FILE *full = fopen("/dev/full", "wb");
    if (full && TEST(image_make(&made, 300, 300))) {
        TEST(!image_write_pfm(full, &made));
        clearerr(full);
        TEST(!image_write_png(full, &made));
        image_free(&made);
    }
    if (full)
        fclose(full);
}

int main(void)
{
    test_png("studio", 300, 200); /* three blocks */
    test_png("grid", 131, 77);
    test_png("tiles", 1, 1);
    test_full_disk();
    return test_done();
}
