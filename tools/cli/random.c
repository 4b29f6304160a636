#include "cli/random.h"

/* SplitMix64's step, 2^64 divided by the golden ratio. */
static const uint64_t step = 0x9E3779B97F4A7C15u;

static uint64_t mix(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/* The seed is hashed twice with an odd multiplier between, so that seeds 1, 2, 3 do not start on
 * neighbouring places of one sequence. */
random_stream random_from(uint64_t seed)
{
    random_stream stream = {mix(mix(seed + step) * 0xD1342543DE82EF95u + 1), 0};
    return stream;
}

uint64_t random_bits(random_stream *stream)
{
    stream->index++;
    return mix(stream->start + stream->index * step);
}

float random_float(random_stream *stream)
{
    return (float)(random_bits(stream) >> 40) * 0x1p-24f;
}

double random_double(random_stream *stream)
{
    return (double)(random_bits(stream) >> 11) * 0x1p-53;
}
