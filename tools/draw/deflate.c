/* Finds repeats greedily, by the last place where the same three bytes began, and writes one block in the codes
 * that the standard fixes (RFC 1951, 3.2.6): codes of its own would save an eighth of a noisy picture, and take
 * 200 lines. */
#include "draw/deflate.h"

#include <stdint.h>
#include <stdlib.h>

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

unsigned char *deflate_bytes(const unsigned char *data, size_t size, size_t *packed)
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
