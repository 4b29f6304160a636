/* A PNG is what its standard says, and holds the picture: it is read back here, by code of the test's own. */
#include "harness/test.h"

#include <stdint.h>
#include <stdlib.h>

#include "render/image.h"

enum { ROOM = 1 << 20 };

/* What was written to a temporary file; `bytes` has ROOM. */
static size_t take_back(FILE *file, unsigned char *bytes)
{
    rewind(file);
    size_t size = fread(bytes, 1, ROOM, file);
    fclose(file);
    return size;
}

static uint32_t big_endian(const unsigned char *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* The bytes of a zlib stream of stored blocks (RFC 1950, 1951); 0 if it is wrong. */
static size_t unpack(const unsigned char *data, size_t size, unsigned char *out)
{
    size_t at = 2, count = 0;
    if (size < 6 || (data[0] * 256 + data[1]) % 31 != 0 || data[0] != 0x78)
        return 0;
    for (int is_last = 0; !is_last;) {
        if (size - at < 9 || data[at] > 1)
            return 0;
        is_last = data[at];
        size_t length = data[at + 1] + 256u * data[at + 2], inverted = data[at + 3] + 256u * data[at + 4];
        at += 5;
        if ((length ^ inverted) != 0xffff || length > size - at || count + length > ROOM)
            return 0;
        memcpy(out + count, data + at, length);
        count += length;
        at += length;
    }
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < count; i++) {
        a = (a + out[i]) % 65521;
        b = (b + a) % 65521;
    }
    return size - at == 4 && big_endian(data + at) == (b << 16 | a) ? count : 0;
}

/* ---- PNG ---- */

static uint32_t crc_of(const unsigned char *data, size_t size)
{
    uint32_t crc = ~0u;
    for (size_t i = 0; i < 8 * size; i++) {
        uint32_t bit = ((uint32_t)data[i / 8] >> i % 8 & 1u) ^ (crc & 1u);
        crc = crc >> 1 ^ (bit ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/* The chunk of a name; NULL if it is not there or a chunk is damaged. */
static const unsigned char *chunk(const unsigned char *png, size_t size, const char *name, size_t *length)
{
    for (size_t at = 8; at + 12 <= size;) {
        *length = big_endian(png + at);
        if (*length > size - at - 12 || crc_of(png + at + 4, *length + 4) != big_endian(png + at + 8 + *length))
            return NULL;
        if (memcmp(png + at + 4, name, 4) == 0)
            return png + at + 8;
        at += 12 + *length;
    }
    return NULL;
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

static void test_png(const char *pattern, int width, int height, float exposure, unsigned char *bytes,
                     unsigned char *out)
{
    image made;
    vndf_error error;
    size_t length = 0;
    FILE *file = tmpfile();
    if (!TEST(file && image_make_pattern(&made, pattern, width, height, &error)))
        return;
    made.rgb[0] = NAN;
    made.rgb[1] = -INFINITY;
    made.rgb[2] = INFINITY;
    TEST(image_write_png(file, &made, exposure));
    made.rgb[0] = 0.0f;
    size_t size = take_back(file, bytes);
    TEST(memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0);
    const unsigned char *head = chunk(bytes, size, "IHDR", &length);
    TEST(head && length == 13 && big_endian(head) == (uint32_t)width && big_endian(head + 4) == (uint32_t)height);
    TEST(head && memcmp(head + 8, "\x08\x02\0\0\0", 5) == 0);
    const unsigned char *data = chunk(bytes, size, "IDAT", &length);
    size_t row = 3 * (size_t)width, whole = (row + 1) * (size_t)height;
    if (TEST(data && unpack(data, length, out) == whole)) {
        for (size_t y = 0; y < (size_t)height; y++)
            TEST(out[y * (row + 1)] == 0); /* no filter */
        check_pixels(&made, out, exposure);
    }
    TEST(chunk(bytes, size, "IEND", &length) == bytes + size - 4 && length == 0);
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
    unsigned char *bytes = malloc(ROOM), *out = malloc(ROOM);
    if (!TEST(bytes && out))
        return test_done();
    test_png("studio", 300, 200, 0.5f, bytes, out); /* three blocks */
    test_png("grid", 131, 77, 1.0f, bytes, out);
    test_png("tiles", 1, 1, 1.0f, bytes, out);
    test_full_disk();
    free(bytes);
    free(out);
    return test_done();
}
