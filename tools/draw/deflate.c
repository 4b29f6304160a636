/* Finds matches greedily by chains of equal hashes, gathers symbols in blocks, and gives each block Huffman codes
 * for its counts. If a code is too long, the counts are flattened, which costs little. The lengths of codes go
 * into the head of a block one by one, without runs: some 200 bytes for a block of 32768 symbols.
 *
 * Map: bits, codes, symbols of a match, blocks, matches, checksum. */
#include "draw/deflate.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    LITERALS = 286,
    DISTANCES = 30,
    ORDERS = 19, /* sizes of the alphabets */
    BLOCK = 32768,
    WINDOW = 32768,
    HASHES = 1 << 15,
    CHAIN = 48,
    MATCH_MIN = 3,
    MATCH_MAX = 258
};

/* ---- bits ---- */

typedef struct bits {
    unsigned char *data;
    size_t size, room;
    uint32_t hold; /* the lowest come first */
    unsigned count;
} bits;

/* Makes room for `more` bytes; on failure data becomes NULL and stays so. */
static void reserve(bits *b, size_t more)
{
    if (!b->data || b->room - b->size >= more)
        return;
    b->room = 2 * b->room + more;
    unsigned char *larger = realloc(b->data, b->room);
    if (!larger)
        free(b->data);
    b->data = larger;
}

/* Writes up to 16 bits; room for them is reserved. */
static void put_bits(bits *b, unsigned value, unsigned count)
{
    b->hold |= (uint32_t)value << b->count;
    for (b->count += count; b->count >= 8; b->count -= 8, b->hold >>= 8)
        b->data[b->size++] = (unsigned char)(b->hold & 255u);
}

/* ---- codes ---- */

typedef struct code {
    unsigned length[LITERALS], bits[LITERALS];
} code;

/* Takes the lightest node without a parent. */
static int take_least(uint32_t *weight, int nodes)
{
    int least = -1;
    for (int i = 0; i < nodes; i++)
        if (weight[i] && (least < 0 || weight[i] < weight[least]))
            least = i;
    return least;
}

/* The lengths of Huffman codes; returns the longest. */
static unsigned tree_lengths(const uint32_t *count, int symbols, unsigned *length)
{
    uint32_t weight[2 * LITERALS];
    int parent[2 * LITERALS], nodes = symbols, left = 0;
    unsigned depth[2 * LITERALS], longest = 0;
    for (int i = 0; i < symbols; i++) {
        weight[i] = count[i];
        left += count[i] > 0;
        parent[i] = -1;
    }
    for (; left > 1; left--, nodes++) {
        int a = take_least(weight, nodes);
        uint32_t sum = weight[a];
        weight[a] = 0;
        int b = take_least(weight, nodes);
        sum += weight[b];
        weight[b] = 0;
        parent[a] = parent[b] = nodes;
        parent[nodes] = -1;
        weight[nodes] = sum;
    }
    for (int i = nodes - 1; i >= 0; i--) {
        depth[i] = parent[i] < 0 ? 0 : depth[parent[i]] + 1;
        if (i < symbols) {
            length[i] = count[i] ? depth[i] : 0;
            longest = length[i] > longest ? length[i] : longest;
        }
    }
    return longest;
}

static unsigned reversed(unsigned value, unsigned count)
{
    unsigned result = 0;
    for (unsigned i = 0; i < count; i++)
        result |= (value >> i & 1u) << (count - 1 - i);
    return result;
}

/* The canonical code (RFC 1951, 3.2.2) for the counts, with at most `most` bits a symbol. Readers expect at least
 * two symbols. */
static void make_code(uint32_t *count, int symbols, unsigned most, code *made)
{
    unsigned next = 0;
    int used = 0;
    for (int i = 0; i < symbols; i++)
        used += count[i] > 0;
    for (int i = 0; used < 2; i++)
        if (!count[i]) {
            count[i] = 1;
            used++;
        }
    while (tree_lengths(count, symbols, made->length) > most)
        for (int i = 0; i < symbols; i++)
            count[i] = (count[i] + 1) / 2;
    for (unsigned length = 1; length <= most; length++, next <<= 1)
        for (int i = 0; i < symbols; i++)
            if (made->length[i] == length)
                made->bits[i] = reversed(next++, length);
}

/* ---- matches as symbols ---- */

typedef struct span {
    unsigned symbol, extra, rest; /* the symbol, the number of extra bits behind it, and their value */
} span;

/* Groups of two or four symbols, each group with twice the range of the one before (RFC 1951, 3.2.5). */
static span span_of(unsigned value, unsigned first, unsigned group)
{
    span s = {0, 0, value};
    for (;; s.symbol++) {
        s.extra = s.symbol < 2 * group ? 0 : s.symbol / group - 1;
        if (s.rest < first + (1u << s.extra))
            break;
        s.rest -= 1u << s.extra;
    }
    s.rest -= first;
    return s;
}

static span length_span(unsigned length)
{
    span s = {28, 0, 0}; /* 258 has a symbol of its own */
    if (length < MATCH_MAX)
        s = span_of(length, 3, 4);
    s.symbol += 257;
    return s;
}

static span distance_span(unsigned distance)
{
    return span_of(distance, 1, 2);
}

/* ---- blocks ---- */

/* A literal if length is 0, else a match. */
typedef struct token {
    uint16_t length, value; /* value: the byte, or the distance less 1 */
} token;

typedef struct packer {
    bits out;
    token tokens[BLOCK];
    size_t count;
    uint32_t head[HASHES],
        before[WINDOW]; /* place + 1 of the last with each hash, and of the one before each place */
} packer;

static void put_head(bits *out, const code *literal, const code *distance)
{
    static const unsigned char order[ORDERS] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    uint32_t count[ORDERS] = {0};
    code lengths;
    for (int i = 0; i < LITERALS + DISTANCES; i++)
        count[i < LITERALS ? literal->length[i] : distance->length[i - LITERALS]]++;
    make_code(count, ORDERS, 7, &lengths);
    put_bits(out, LITERALS - 257, 5);
    put_bits(out, DISTANCES - 1, 5);
    put_bits(out, ORDERS - 4, 4);
    for (int i = 0; i < ORDERS; i++)
        put_bits(out, lengths.length[order[i]], 3);
    for (int i = 0; i < LITERALS + DISTANCES; i++) {
        unsigned length = i < LITERALS ? literal->length[i] : distance->length[i - LITERALS];
        put_bits(out, lengths.bits[length], lengths.length[length]);
    }
}

static void put_span(bits *out, const code *c, span s)
{
    put_bits(out, c->bits[s.symbol], c->length[s.symbol]);
    put_bits(out, s.rest, s.extra);
}

static void put_tokens(packer *p, const code *literal, const code *distance)
{
    for (size_t i = 0; i < p->count; i++) {
        const token t = p->tokens[i];
        if (!t.length) {
            put_bits(&p->out, literal->bits[t.value], literal->length[t.value]);
            continue;
        }
        put_span(&p->out, literal, length_span(t.length));
        put_span(&p->out, distance, distance_span(t.value + 1u));
    }
    put_bits(&p->out, literal->bits[256], literal->length[256]);
}

static void put_block(packer *p, int last)
{
    uint32_t literals[LITERALS] = {[256] = 1}, distances[DISTANCES] = {0};
    code literal, distance;
    for (size_t i = 0; i < p->count; i++) {
        const token t = p->tokens[i];
        literals[t.length ? length_span(t.length).symbol : t.value]++;
        if (t.length)
            distances[distance_span(t.value + 1u).symbol]++;
    }
    make_code(literals, LITERALS, 15, &literal);
    make_code(distances, DISTANCES, 15, &distance);
    reserve(&p->out, 6 * p->count + 1024); /* 48 bits a token at most */
    if (!p->out.data)
        return;
    put_bits(&p->out, last ? 5 : 4, 3); /* the block's kind: codes of its own */
    put_head(&p->out, &literal, &distance);
    put_tokens(p, &literal, &distance);
    p->count = 0;
}

/* ---- matches ---- */

static unsigned hash_of(const unsigned char *at)
{
    uint32_t three = (uint32_t)at[0] << 16 | (uint32_t)at[1] << 8 | at[2];
    return three * 2654435761u >> 17;
}

static void enter(packer *p, const unsigned char *data, size_t size, size_t at)
{
    if (size - at < MATCH_MIN)
        return;
    uint32_t *head = &p->head[hash_of(data + at)];
    p->before[at % WINDOW] = *head;
    *head = (uint32_t)at + 1;
}

static token find_match(const packer *p, const unsigned char *data, size_t size, size_t at)
{
    token best = {0, data[at]};
    size_t most = size - at < MATCH_MAX ? size - at : MATCH_MAX, longest = MATCH_MIN - 1;
    uint32_t next = most >= MATCH_MIN ? p->head[hash_of(data + at)] : 0;
    for (int tries = 0; next && at - (next - 1) < WINDOW && tries < CHAIN && longest < most; tries++) {
        const unsigned char *other = data + next - 1;
        size_t length = 0;
        while (length < most && other[length] == data[at + length])
            length++;
        if (length > longest) {
            longest = length;
            best.length = (uint16_t)length;
            best.value = (uint16_t)(at - next);
        }
        next = p->before[(next - 1) % WINDOW];
    }
    return best;
}

static void pack(packer *p, const unsigned char *data, size_t size)
{
    for (size_t at = 0; at < size && p->out.data;) {
        const token t = find_match(p, data, size, at);
        size_t step = t.length ? t.length : 1;
        if (p->count == BLOCK)
            put_block(p, 0);
        p->tokens[p->count++] = t;
        for (size_t i = 0; i < step; i++)
            enter(p, data, size, at + i);
        at += step;
    }
    if (p->out.data)
        put_block(p, 1);
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
    packer *p = size < UINT32_MAX ? calloc(1, sizeof *p) : NULL;
    if (!p)
        return NULL;
    p->out.room = size / 2 + 64;
    p->out.data = malloc(p->out.room);
    if (p->out.data) {
        put_bits(&p->out, 0x0178, 16); /* deflate, a window of 32 KiB, no dictionary */
        pack(p, data, size);
    }
    reserve(&p->out, 8);
    unsigned char *result = p->out.data;
    if (result) {
        uint32_t adler = adler_of(data, size);
        put_bits(&p->out, 0, (8 - p->out.count) % 8);
        for (int i = 3; i >= 0; i--)
            put_bits(&p->out, adler >> 8 * i & 255u, 8);
        *packed = p->out.size;
    }
    free(p);
    return result;
}
