/* Runs a fuzz target where there is no libFuzzer: the files that are its arguments (the corpus), then
 * mutations of each - bytes changed, removed, repeated, copied from elsewhere - the same on every run.
 * VNDF_TEST_QUICK in the environment makes it ten times fewer. */
#include <stdint.h>
#include <stdlib.h>

#include "harness/test.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MUTATIONS = 2000, QUICK_MUTATIONS = 200, CAPACITY = 1 << 16 };

typedef struct input {
    uint8_t *bytes; /* CAPACITY of them */
    size_t size;
} input;

static int read_file(const char *path, input *to)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        return 0;
    }
    to->size = fread(to->bytes, 1, CAPACITY, file);
    return fclose(file) == 0;
}

static size_t below(unsigned long long *state, size_t bound)
{
    return (size_t)(test_random_bits(state) >> 11) % bound;
}

/* Removes up to 8 bytes at a place. */
static void remove_bytes(input *in, size_t at, unsigned long long *state)
{
    const size_t left = in->size - at;
    const size_t count = 1 + below(state, left < 8 ? left : 8);
    memmove(in->bytes + at, in->bytes + at + count, left - count);
    in->size -= count;
}

/* Inserts, at a place, a copy of up to 16 bytes from anywhere. */
static void insert_bytes(input *in, size_t at, unsigned long long *state)
{
    uint8_t piece[16];
    const size_t from = below(state, in->size);
    const size_t left = in->size - from;
    const size_t count = 1 + below(state, left < sizeof piece ? left : sizeof piece);
    if (in->size + count > CAPACITY)
        return;
    memcpy(piece, in->bytes + from, count);
    memmove(in->bytes + at + count, in->bytes + at, in->size - at);
    memcpy(in->bytes + at, piece, count);
    in->size += count;
}

static void mutate_once(input *in, unsigned long long *state)
{
    static const uint8_t notable[] = {0,   1,   0x7f, 0x80, 0xff, '\n', ',', '.',
                                      '-', 'e', '9',  '(',  ')',  '^',  '#', '"'};
    const size_t at = below(state, in->size);

    switch (below(state, 6)) {
    case 0: in->bytes[at] ^= (uint8_t)(1u << below(state, 8)); break;
    case 1: in->bytes[at] = (uint8_t)below(state, 256); break;
    case 2: in->bytes[at] = notable[below(state, sizeof notable)]; break;
    case 3: remove_bytes(in, at, state); break;
    case 4: insert_bytes(in, at, state); break;
    default: in->bytes[at] = in->bytes[below(state, in->size)]; break;
    }
}

/* A target sees each input in a block of its exact size, so that memory checkers see a read beyond it. */
static void run_input(const input *in)
{
    uint8_t *exact = malloc(in->size ? in->size : 1);
    TEST(exact != NULL);
    if (exact == NULL)
        return;
    memcpy(exact, in->bytes, in->size);
    TEST(LLVMFuzzerTestOneInput(exact, in->size) == 0);
    free(exact);
}

static void run_mutations(const input *seed, input *work, size_t count)
{
    unsigned long long state = 0x9E3779B97F4A7C15ULL;
    for (size_t i = 0; i < count; i++) {
        memcpy(work->bytes, seed->bytes, seed->size);
        work->size = seed->size;
        for (size_t changes = 1 + below(&state, 4); changes > 0 && work->size > 0; changes--)
            mutate_once(work, &state);
        run_input(work);
    }
}

int main(int count, char **paths)
{
    const size_t mutations = test_quick() ? QUICK_MUTATIONS : MUTATIONS;
    input seed = {malloc(CAPACITY), 0}, work = {malloc(CAPACITY), 0};

    TEST(seed.bytes != NULL && work.bytes != NULL && count > 1);
    for (int i = 1; i < count && seed.bytes && work.bytes; i++) {
        if (!TEST(read_file(paths[i], &seed)))
            continue;
        run_input(&seed);
        run_mutations(&seed, &work, seed.size > 0 ? mutations : 0);
    }
    free(seed.bytes);
    free(work.bytes);
    return test_done();
}
