/* Uniform numbers of a walk by counter: number i is a hash of the seed and i, so that a walk keeps no more than
 * two words and the same seed gives the same walk everywhere. The hash is the finaliser of SplitMix64 (Steele,
 * Lea & Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014). */
#ifndef VNDF_BSDF_WALK_RANDOM_H
#define VNDF_BSDF_WALK_RANDOM_H

#include <stdint.h>
#include <string.h>

#include "math/exp_log.h"

typedef struct vndf_walk_random {
    uint64_t state;
} vndf_walk_random;

VNDF_INLINE uint64_t vndf_walk_hash(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/* The seed is hashed, so that successive seeds give unrelated numbers. */
VNDF_INLINE vndf_walk_random vndf_walk_random_from(uint64_t seed)
{
    vndf_walk_random random = {vndf_walk_hash(seed + 0x9E3779B97F4A7C15u)};
    return random;
}

/* A seed from three uniform numbers, by all their bits. */
VNDF_INLINE uint64_t vndf_walk_seed_of(const float u[3])
{
    uint64_t seed = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &u[i], sizeof bits);
        seed = vndf_walk_hash(seed + bits + 0x9E3779B97F4A7C15u);
    }
    return seed;
}

VNDF_INLINE uint64_t vndf_walk_bits(vndf_walk_random *random)
{
    random->state += 0x9E3779B97F4A7C15u;
    return vndf_walk_hash(random->state);
}

/* In (0, 1), 52 bits. */
VNDF_INLINE double vndf_walk_uniform(vndf_walk_random *random)
{
    return ((double)(vndf_walk_bits(random) >> 12) + 0.5) * 0x1p-52;
}

/* Two in [0, 1), 24 bits each, as a renderer gives them. */
VNDF_INLINE void vndf_walk_pair(vndf_walk_random *random, float u[2])
{
    uint64_t bits = vndf_walk_bits(random);
    u[0] = (float)(bits >> 40) * 0x1p-24f;
    u[1] = (float)((bits >> 16) & 0xFFFFFFu) * 0x1p-24f;
}

/* With density exp(-x). */
VNDF_INLINE double vndf_walk_exponential(vndf_walk_random *random)
{
    return -vndf_log(vndf_walk_uniform(random));
}

#endif
