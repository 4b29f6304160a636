/* Uniform numbers by counter: number i of stream `seed` is a hash of both, so a sequence can be entered
 * anywhere and two seeds do not meet. The hash is the finaliser of SplitMix64 (Steele, Lea & Flood,
 * "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014). */
#ifndef TOOLS_CLI_RANDOM_H
#define TOOLS_CLI_RANDOM_H

#include <stdint.h>

typedef struct random_stream {
    uint64_t start; /* the hashed seed */
    uint64_t index; /* how many numbers were drawn */
} random_stream;

random_stream random_from(uint64_t seed);

uint64_t random_bits(random_stream *stream);

/* A multiple of 2^-24 in [0, 1): what a renderer passes to vndf_sample. */
float random_float(random_stream *stream);

/* A multiple of 2^-53 in [0, 1). */
double random_double(random_stream *stream);

#endif
