/* Inputs: every set of a turn has the same random numbers, so that only the sets make a difference of times. */
#include <math.h>

#include "cli/subject.h"
#include "bench/effects/effects.h"
#include "cli/random.h"

static vndf_vec3 hemisphere(random_stream *stream)
{
    float z = 1.0f - random_float(stream), s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    float phi = 6.2831853f * random_float(stream);
    vndf_vec3 w = {s * cosf(phi), s * sinf(phi), z};
    return w;
}

/* wo is on the side that the set scatters to; with both lobes a coin chooses it. */
static float side_of_wo(const effects_set *set, uint64_t coin)
{
    vndf_lobes lobes = set->effects.lobes;
    int through = lobes == VNDF_LOBES_TRANSMISSION || (lobes == VNDF_LOBES_BOTH && (coin & 1));
    return through == set->inside ? 1.0f : -1.0f;
}

static void fill_one(effects_input *in, const effects_set *set, double theta, random_stream *stream)
{
    in->wi = hemisphere(stream);
    if (!isnan(theta))
        in->wi = direction_from(theta, 360 * random_double(stream));
    in->wo = hemisphere(stream);
    in->wo.z *= side_of_wo(set, random_bits(stream));
    if (set->inside)
        in->wi.z = -in->wi.z;
    for (int k = 0; k < 3; k++)
        in->u[k] = random_float(stream);
}

static void pack(effects_block *block)
{
    const effects_job job = {.in = block->in, .count = EFFECTS_BLOCK, .arrays = &block->arrays};
    effects_pack(&job);
}

void effects_fill(effects_block *block, effects_subject *subject, double theta, uint64_t seed)
{
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < EFFECTS_BLOCK; i++) {
        fill_one(&block->in[i], subject->set, theta, &stream);
        float factor = 0.5f + random_float(&stream);
        vndf_roughness r = {factor * subject->surface.alpha_x, factor * subject->surface.alpha_y, 1.0f, 0.0f};
        block->roughness[i] = r;
    }
    subject->roughness = block->roughness;
    pack(block);
}

void effects_aim(effects_block *block, const effects_set *set, double theta)
{
    vndf_vec3 wi = direction_from(theta, 25);
    if (set->inside)
        wi.z = -wi.z;
    for (size_t i = 0; i < EFFECTS_BLOCK; i++)
        block->in[i].wi = wi;
    pack(block);
}

effects_job effects_job_of(effects_block *block, const effects_subject *subject)
{
    effects_job job = {subject, block->in, block->out, EFFECTS_BLOCK, &block->arrays, 0};
    return job;
}
