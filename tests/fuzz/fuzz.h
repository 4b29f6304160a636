/* What the fuzz targets share: the entry point that libFuzzer (or fuzz_replay.c) calls, which hands each input to the
 * target's fuzz_one, and checks that stop the program. */
#pragma once

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vndf.h"

/* The bytes in a block of exactly their size, so that memory checkers see a read beyond it; and a copy, to change or
 * to read as text, with a 0 behind. */
static void fuzz_one(const uint8_t *data, size_t size, char *text);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (text == NULL)
        abort();
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    fuzz_one(data, size, text);
    free(text);
    return 0;
}

static inline void fuzz_require(int good, const char *claim)
{
    if (good)
        return;
    fprintf(stderr, "does not hold: %s\n", claim);
    abort();
}

/* What a loader that gave NULL or not left in its error. Returns whether it loaded. */
static inline int fuzz_loaded(const void *loaded, const vndf_error *error)
{
    fuzz_require((loaded != NULL) == (error->status == VNDF_OK), "NULL and an error come together");
    fuzz_require(loaded != NULL || error->message[0] != '\0', "an error has a message");
    return loaded != NULL;
}
