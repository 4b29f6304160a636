/* What the fuzz targets share: the entry point that libFuzzer (or fuzz_replay.c) calls, a check that
 * stops the program, and input as text. */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void fuzz_require(int good, const char *claim)
{
    if (good)
        return;
    fprintf(stderr, "does not hold: %s\n", claim);
    abort();
}

/* Keeps a value that only a fault on the way to it is interesting of. */
static inline void fuzz_use(double value)
{
    static volatile double sink;
    sink = value;
    (void)sink;
}

/* The bytes with a 0 behind them, in a block of exactly that size; the caller frees it. */
static inline char *fuzz_text(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (text == NULL)
        abort();
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

#endif
