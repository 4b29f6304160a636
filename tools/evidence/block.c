/* Inputs: the same random numbers for all methods of a turn, so that only the methods make a difference of times. */
#include <math.h>

#include "cli/random.h"
#include "cli/subject.h"
#include "evidence/method.h"

void block_pack(block *b)
{
    b->count = BLOCK;
    for (size_t i = 0; i < BLOCK; i++)
        b->in[i] = (method_input){{b->wi[0][i], b->wi[1][i], b->wi[2][i]},
                                  {b->given[0][i], b->given[1][i], b->given[2][i]},
                                  b->alpha[i],
                                  {b->u[0][i], b->u[1][i], b->u[2][i]}};
}

static void put(float to[3][BLOCK], size_t i, vndf_vec3 w)
{
    to[0][i] = w.x;
    to[1][i] = w.y;
    to[2][i] = w.z;
}

/* A cosine of at least 2^-25: exactly along the surface several published methods divide by zero. */
static vndf_vec3 hemisphere(random_stream *stream)
{
    float z = random_float(stream) + 0x1p-25f, phi = 6.28318531f * random_float(stream);
    float s = sqrtf(1.0f - fminf(z * z, 1.0f));
    return (vndf_vec3){s * cosf(phi), s * sinf(phi), z};
}

void block_fill(block *b, const block_law *law, uint64_t seed)
{
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < BLOCK; i++) {
        vndf_vec3 wi = hemisphere(&stream);
        if (!isnan(law->theta))
            wi = direction_from(law->theta, 360 * random_double(&stream));
        /* wo is on the side that the set scatters to; with both lobes a coin chooses it */
        vndf_vec3 wo = hemisphere(&stream);
        const uint64_t coin = random_bits(&stream) & 1;
        if (law->lobes == VNDF_LOBES_TRANSMISSION || (law->lobes == VNDF_LOBES_BOTH && coin))
            wo.z = -wo.z;
        put(b->wi, i, wi);
        put(b->given, i, wo);
        b->alpha[i] = law->low + (law->high - law->low) * random_float(&stream);
        for (int k = 0; k < 3; k++)
            b->u[k][i] = random_float(&stream);
    }
    if (law->seen) {
        vndf_batch batch = {.surface = {.distribution = law->seen, .xx = b->alpha, .yy = b->alpha},
                            .count = BLOCK};
        batch.wi_x = b->wi[0], batch.wi_y = b->wi[1], batch.wi_z = b->wi[2];
        vndf_sample_n(&batch, b->u[0], b->u[1], (vndf_normals){b->given[0], b->given[1], b->given[2]}, NULL);
    }
    block_pack(b);
}

void block_aim(block *b, vndf_vec3 wi, float alpha)
{
    for (size_t i = 0; i < BLOCK; i++) {
        put(b->wi, i, wi);
        b->alpha[i] = alpha;
    }
    block_pack(b);
}
