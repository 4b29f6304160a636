/* Runs a fuzz target where there is no libFuzzer: the files that are its arguments (the corpus), then
 * mutations of each - bytes changed, removed, repeated, copied from elsewhere - the same on every run.
 * VNDF_TEST_QUICK in the environment makes it five times fewer. */
#include <stdint.h>

#include "harness/test.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { CAPACITY = 1 << 16, PIECE = 16 };

static size_t below(unsigned long long *state, size_t bound)
{
    return (size_t)(test_random_bits(state) >> 11) % bound;
}

/* Changes a byte, removes up to 8, or inserts a copy of up to PIECE from anywhere. Returns the new size. */
static size_t mutate(uint8_t *bytes, size_t size, unsigned long long *state)
{
    static const uint8_t notable[] = {0,   1,   0x7f, 0x80, 0xff, '\n', ',', '.',
                                      '-', 'e', '9',  '(',  ')',  '^',  '#', '"'};
    uint8_t piece[PIECE];
    size_t at = below(state, size), from = below(state, size), left = size - at;
    size_t removed = 1 + below(state, left < 8 ? left : 8);
    size_t copied = 1 + below(state, size - from < PIECE ? size - from : PIECE);
    switch (below(state, 6)) {
    case 0: bytes[at] ^= (uint8_t)(1u << below(state, 8)); return size;
    case 1: bytes[at] = (uint8_t)below(state, 256); return size;
    case 2: bytes[at] = notable[below(state, sizeof notable)]; return size;
    case 3: bytes[at] = bytes[from]; return size;
    case 4: memmove(bytes + at, bytes + at + removed, left - removed); return size - removed;
    default: break;
    }
    if (size + copied > CAPACITY)
        return size;
    memcpy(piece, bytes + from, copied);
    memmove(bytes + at + copied, bytes + at, left);
    memcpy(bytes + at, piece, copied);
    return size + copied;
}

/* In a block of its exact size, so that memory checkers see a read beyond it. */
static void run(const uint8_t *bytes, size_t size)
{
    uint8_t *exact = malloc(size ? size : 1);
    memcpy(exact, bytes, size);
    TEST(LLVMFuzzerTestOneInput(exact, size) == 0);
    free(exact);
}

int main(int count, char **paths)
{
    static uint8_t seed[CAPACITY], work[CAPACITY];
    TEST(count > 1);
    for (int i = 1; i < count; i++) {
        unsigned long long state = 0x9E3779B97F4A7C15ULL;
        FILE *file = fopen(paths[i], "rb");
        if (!TEST(file != NULL))
            continue;
        size_t size = fread(seed, 1, CAPACITY, file);
        fclose(file);
        run(seed, size);
        for (size_t k = test_amount(200, 1000, 1000); size > 0 && k > 0; k--) {
            size_t now = size;
            memcpy(work, seed, size);
            for (size_t changes = 1 + below(&state, 4); changes > 0 && now > 0; changes--)
                now = mutate(work, now, &state);
            run(work, now);
        }
    }
    return test_done();
}
