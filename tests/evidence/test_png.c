/* A PNG is what its standard says, and holds the picture: it is read back here by an inflater of the test's own.
 * Smooth pictures and noise come out again. */
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

/* ---- an inflater, bit by bit (RFC 1951) ---- */

typedef struct reader {
    const unsigned char *at, *end;
    unsigned bit;
    int bad;
} reader;

static unsigned take(reader *r, unsigned count)
{
    unsigned value = 0;
    for (unsigned i = 0; i < count; i++) {
        if (r->at >= r->end) {
            r->bad = 1;
            return 0;
        }
        value |= (*r->at >> r->bit & 1u) << i;
        r->bit = (r->bit + 1) % 8;
        r->at += r->bit == 0;
    }
    return value;
}

/* The symbol whose canonical code comes next: codes of a length follow on those that are shorter. */
static int symbol(reader *r, const unsigned *length, int symbols)
{
    unsigned code = 0, first = 0;
    for (unsigned bits = 1; bits < 16; bits++) {
        unsigned seen = 0;
        code = code << 1 | take(r, 1);
        first <<= 1;
        for (int i = 0; i < symbols; i++)
            if (length[i] == bits && first + seen++ == code)
                return i;
        first += seen;
    }
    r->bad = 1;
    return 0;
}

/* Of the fixed codes: literals and lengths, then distances. */
static void set_lengths(unsigned lengths[288 + 30])
{
    for (int i = 0; i < 288 + 30; i++)
        lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : i < 288 ? 8 : 5;
}

static size_t take_block(reader *r, unsigned char *out, size_t size)
{
    static const unsigned length_base[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                             31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const unsigned distance_base[30] = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                               33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                               1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    unsigned lengths[288 + 30];
    set_lengths(lengths);
    while (!r->bad && size + 258 < ROOM) {
        int s = symbol(r, lengths, 288);
        if (s == 256)
            return size;
        if (s < 256) {
            out[size++] = (unsigned char)s;
            continue;
        }
        unsigned extra = s < 265 || s == 285 ? 0 : (unsigned)(s - 261) / 4;
        unsigned length = length_base[s - 257] + take(r, extra);
        int d = symbol(r, lengths + 288, 30);
        unsigned distance = distance_base[d] + take(r, d < 4 ? 0 : (unsigned)d / 2 - 1);
        r->bad |= distance > size;
        for (unsigned i = 0; i < length && !r->bad; i++, size++)
            out[size] = out[size - distance];
    }
    r->bad = 1;
    return size;
}

/* The bytes of a zlib stream; 0 if it is wrong. */
static size_t inflate(const unsigned char *data, size_t size, unsigned char *out)
{
    int bad = size < 6 || (data[0] * 256 + data[1]) % 31 != 0 || data[0] != 0x78;
    reader r = {data + 2, data + size, 0, bad};
    size_t count = 0;
    for (unsigned last = 0; !last && !r.bad;) {
        last = take(&r, 1);
        r.bad |= take(&r, 2) != 1;
        count = r.bad ? 0 : take_block(&r, out, count);
    }
    r.at += r.bit > 0;
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < count; i++) {
        a = (a + out[i]) % 65521;
        b = (b + a) % 65521;
    }
    if (r.bad || r.end - r.at != 4)
        return 0;
    uint32_t sum = (uint32_t)r.at[0] << 24 | (uint32_t)r.at[1] << 16 | (uint32_t)r.at[2] << 8 | r.at[3];
    return sum == (b << 16 | a) ? count : 0;
}

/* ---- PNG ---- */

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

/* Undoes the filters of rows, in place, by the table of the standard (9.2). */
static void unfilter(unsigned char *rows, size_t row, size_t height)
{
    for (size_t y = 0; y < height; y++) {
        unsigned char *line = rows + y * (row + 1);
        TEST(line[0] <= 4);
        for (size_t i = 1; i <= row; i++) {
            int a = i > 3 ? line[i - 3] : 0, b = y ? line[i - (row + 1)] : 0;
            int c = i > 3 && y ? line[i - row - 4] : 0;
            int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
            int nearest = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
            const int add[5] = {0, a, b, (a + b) / 2, nearest};
            line[i] = (unsigned char)(line[i] + add[line[0]]);
        }
    }
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

/* A pattern of the renderer, or noise with a tail of rare levels. */
static int make(image *made, const char *pattern, int width, int height, image_error *error)
{
    unsigned long long seed = 11;
    if (strcmp(pattern, "noise") != 0)
        return image_make_pattern(made, pattern, width, height, error);
    if (!image_make(made, width, height))
        return 0;
    for (int i = 0; i < 3 * width * height; i++)
        made->rgb[i] = (float)pow(test_uniform_double(&seed), i < width ? 1 : 8);
    return 1;
}

static void test_png(const char *pattern, int width, int height, float exposure, unsigned char *bytes,
                     unsigned char *out)
{
    image made;
    image_error error;
    size_t length = 0;
    FILE *file = tmpfile();
    if (!TEST(file && make(&made, pattern, width, height, &error)))
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
    if (TEST(data && inflate(data, length, out) == whole)) {
        unfilter(out, row, (size_t)height);
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
    test_png("studio", 200, 100, 0.5f, bytes, out);
    test_png("noise", 300, 200, 1.0f, bytes, out);
    test_png("grid", 131, 77, 1.0f, bytes, out);
    test_png("tiles", 1, 1, 1.0f, bytes, out);
    test_full_disk();
    free(bytes);
    free(out);
    return test_done();
}
