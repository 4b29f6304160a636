// A CUDA kernel that draws many reflected directions from one wi and adds up their weights: the directional albedo of a
// white metal. After
//     vndf export tables/hazy.vndf --language cuda --buffer hazy.f32 -o normals.cuh
// The host copies hazy.f32 (or what vndf_numbers writes) to the device: `numbers`.
#include "normals.cuh"

static __device__ float uniform_of(unsigned *state)
{
    *state = *state * 747796405u + 2891336453u;
    unsigned word = ((*state >> ((*state >> 28) + 4u)) ^ *state) * 277803737u;
    return ((word >> 22 ^ word) >> 8) * 0x1p-24f;
}

__global__ void add_weights(const float *numbers, float cosine, float alpha, int samples, float *sum)
{
    unsigned state = blockIdx.x * blockDim.x + threadIdx.x;
    const float3 wi = make_float3(sqrtf(1.0f - cosine * cosine), 0.0f, cosine);
    const vndf_surface surface = vndf_surface_of(VNDF_HAZY, alpha, alpha);
    const vndf_view view = vndf_view_of(numbers, surface, wi);
    float weights = 0.0f;
    for (int i = 0; i < samples; i++) {
        float u1 = uniform_of(&state), u2 = uniform_of(&state);
        vndf_sampled drawn = vndf_sample(numbers, view, u1, u2);
        float facing = wi.x * drawn.wm.x + wi.y * drawn.wm.y + wi.z * drawn.wm.z;
        float3 wo = make_float3(2.0f * facing * drawn.wm.x - wi.x, 2.0f * facing * drawn.wm.y - wi.y,
                                2.0f * facing * drawn.wm.z - wi.z);
        if (wo.z > 0.0f) // G2/G1, times the true density over the drawn one
            weights += vndf_g2(numbers, surface, wi, wo) / vndf_g1(numbers, surface, wi) * drawn.weight;
    }
    atomicAdd(sum, weights);
}
