/* Uniform numbers by counter: number i of stream `seed` is a hash of both, so a sequence can be entered
 * anywhere and two seeds do not meet. The hash is the finaliser of SplitMix64 (Steele, Lea & Flood,
 * "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014). */
#pragma once

#include <stdint.h>

typedef struct random_stream {
    uint64_t start; /* the hashed seed */
    uint64_t index; /* how many numbers were drawn */
} random_stream;

static inline uint64_t random_hash(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static const uint64_t random_step = 0x9E3779B97F4A7C15u; /* 2^64 divided by the golden ratio */

/* The seed is hashed twice with an odd multiplier between, so that seeds 1, 2, 3 do not start on
 * neighbouring places of one sequence. */
static inline random_stream random_from(uint64_t seed)
{
    random_stream stream = {random_hash(random_hash(seed + random_step) * 0xD1342543DE82EF95u + 1), 0};
    return stream;
}

static inline uint64_t random_bits(random_stream *stream)
{
    stream->index++;
    return random_hash(stream->start + stream->index * random_step);
}

/* A multiple of 2^-24 in [0, 1): what a renderer passes to vndf_sample. */
static inline float random_float(random_stream *stream)
{
    return (float)(random_bits(stream) >> 40) * 0x1p-24f;
}

/* A multiple of 2^-53 in [0, 1). */
static inline double random_double(random_stream *stream)
{
    return (double)(random_bits(stream) >> 11) * 0x1p-53;
}
