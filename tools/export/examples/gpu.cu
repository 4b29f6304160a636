/* What exported normals cost on an NVIDIA GPU, and whether all of them are good there:
 *
 *     two="$TABLES/student-t-2.5-small.vndf $TABLES/student-t-2.5.vndf"
 *     vndf export $two --language cuda --lobes 2 --prefix normals --buffer normals.f32 -o normals.cuh
 *     vndf export $two --language cuda --prefix embedded -o embedded.cuh
 *     vndf export $two --language cuda --bsdf both --fresnel dielectric --prefix glass --buffer glass.f32 -o glass.cuh
 *     nvcc -O3 -arch=native -I. gpu.cu -o gpu
 *     ./gpu normals.f32
 *
 * Every thread draws its own directions, of the upper hemisphere, its own roughness, 0.05 to 1 on both axes, and its
 * own uniform numbers, so that neighbours share nothing: the hard case of a path tracer after its first bounce. A row is a
 * view and a sample with its density. Methods take turns; printed are the median of their times, the least and the
 * largest, and how many samples were bad: not unit, turned away, below the surface, of no finite density above 0. The
 * exit status is 1 if one of an exported kernel was. */
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "embedded.cuh"
#include "glass.cuh"
#include "normals.cuh"

enum { THREADS = 1 << 20, EACH = 64, ROUNDS = 15 };

struct asked {
    float3 wi, u;
    float alpha_x, alpha_y;
};

/* A good sample is a unit direction that faces wi and has a density; BSDFs may also absorb. */
struct answer {
    float3 w;
    float pdf;
    bool is_bad;
};

__device__ answer judged(float3 wi, float3 w, float pdf)
{
    const float square = w.x * w.x + w.y * w.y + w.z * w.z, facing = w.x * wi.x + w.y * wi.y + w.z * wi.z;
    return {w, pdf, !(fabsf(square - 1) < 1e-6f && w.z >= 0 && facing > -1.5e-7f && pdf > 0 && pdf < 3e38f)};
}

struct nothing { /* the loop with its random numbers */
    static __device__ answer draw(const float *, asked q)
    {
        return judged(q.wi, q.wi, q.alpha_x + q.u.x + q.u.y + q.alpha_y);
    }
};

struct caps { /* by hand: GGX's spherical caps (Dupuy and Benyoub 2023) */
    static __device__ answer draw(const float *, asked q)
    {
        const float x = q.alpha_x * q.wi.x, y = q.alpha_y * q.wi.y, z = q.wi.z, n = rsqrtf(x * x + y * y + z * z);
        const float3 s = make_float3(x * n, y * n, z * n);
        const float c = (1 - q.u.y) * (1 + s.z) - s.z, r = sqrtf(fmaxf(1 - c * c, 0.0f));
        float sine, cosine;
        sincospif(2 * q.u.x, &sine, &cosine);
        const float hx = q.alpha_x * (r * cosine + s.x), hy = q.alpha_y * (r * sine + s.y),
                    hz = fmaxf(c + s.z, 0.0f);
        const float m = rsqrtf(hx * hx + hy * hy + hz * hz);
        const float3 wm = make_float3(hx * m, hy * m, hz * m);
        const float a = wm.x / q.alpha_x, b = wm.y / q.alpha_y, k = a * a + b * b + wm.z * wm.z;
        const float ndf = 1 / (3.14159265f * q.alpha_x * q.alpha_y * k * k),
                    facing = wm.x * q.wi.x + wm.y * q.wi.y + wm.z * q.wi.z;
        return judged(q.wi, wm, 2 * ndf * fmaxf(facing, 0.0f) / (z + 1 / n));
    }
};

/* A distribution that the compiler knows, so that the others leave no code. */
template <int DISTRIBUTION> struct normals {
    static __device__ answer draw(const float *numbers, asked q)
    {
        const normals_view v =
            normals_view_from(numbers, normals_rough(DISTRIBUTION, q.alpha_x, q.alpha_y), q.wi);
        const normals_sampled s = normals_sample(numbers, v, q.u.x, q.u.y);
        return judged(q.wi, s.wm, s.pdf);
    }
};

struct embedded {
    static __device__ answer draw(const float *, asked q)
    {
        const embedded_view v =
            embedded_view_from(embedded_rough(EMBEDDED_STUDENT_T_2_5_SMALL, q.alpha_x, q.alpha_y), q.wi);
        const embedded_sampled s = embedded_sample(v, q.u.x, q.u.y);
        return judged(q.wi, s.wm, s.pdf);
    }
};

struct two_tables {
    static __device__ answer draw(const float *numbers, asked q)
    {
        normals_mixture m = {2};
        m.lobe[0] = {normals_rough(NORMALS_STUDENT_T_2_5, q.alpha_x, q.alpha_y), 0.6f};
        m.lobe[1] = {normals_rough(NORMALS_STUDENT_T_2_5, 0.3f * q.alpha_x, 0.3f * q.alpha_y), 0.4f};
        const normals_mixed s = normals_mixture_sample(numbers, normals_mixture_view_from(numbers, m, q.wi), q.u.x, q.u.y);
        return judged(q.wi, s.wm, s.pdf);
    }
};

struct glass { /* a table's dielectric with both lobes: direction, weight and density */
    static __device__ answer draw(const float *numbers, asked q)
    {
        const glass_material m = {glass_rough(GLASS_STUDENT_T_2_5_SMALL, q.alpha_x, q.alpha_y), 1.5f};
        const glass_scattered s = glass_bsdf_sample(numbers, glass_bsdf_at(numbers, m, q.wi), q.u);
        const float square = s.wo.x * s.wo.x + s.wo.y * s.wo.y + s.wo.z * s.wo.z;
        return {s.wo, s.pdf + s.weight.x,
                !(fabsf(square - 1) < 3e-6f && s.weight.x >= 0 && s.weight.x < 3e38f && s.pdf >= 0 &&
                  s.pdf < 3e38f && (s.lobe > 0) == (s.pdf > 0))};
    }
};

/* The next of a thread's numbers, in [0, 1): PCG's output function (O'Neill 2014) of a counter. */
__device__ float next(unsigned &state)
{
    state = state * 747796405u + 2891336453u;
    const unsigned word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (float)((word >> 22 ^ word) >> 8) * 0x1p-24f;
}

template <class method>
__global__ void run(const float *numbers, unsigned seed, float *sums, unsigned long long *bad)
{
    const unsigned thread = blockIdx.x * blockDim.x + threadIdx.x;
    unsigned state = (thread + seed * THREADS) * 2654435769u, turned = 0;
    float sum = 0;
    for (int i = 0; i < EACH; i++) {
        asked q;
        const float z = next(state), phi = 2 * next(state), r = sqrtf(fmaxf(1 - z * z, 0.0f));
        q.wi = make_float3(r * cospif(phi), r * sinpif(phi), z);
        q.alpha_x = 0.05f + 0.95f * next(state);
        q.alpha_y = 0.05f + 0.95f * next(state);
        q.u = make_float3(next(state), next(state), next(state));
        const answer a = method::draw(numbers, q);
        sum += a.w.x + a.w.y + a.w.z + a.pdf;
        turned += a.is_bad;
    }
    sums[thread] = sum;
    if (turned)
        atomicAdd(bad, (unsigned long long)turned);
}

struct row {
    const char *name;
    void (*kernel)(const float *, unsigned, float *, unsigned long long *);
    std::vector<double> ns;
    unsigned long long bad;
};

static void check(cudaError_t status)
{
    if (status != cudaSuccess) {
        fprintf(stderr, "gpu: %s\n", cudaGetErrorString(status));
        exit(1);
    }
}

int main(int argc, char **argv)
{
    static float host[1 << 16];
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : nullptr;
    if (!file) {
        fprintf(stderr, "usage: gpu NUMBERS, those that `vndf export --buffer` wrote for normals.cuh\n");
        return 2;
    }
    const size_t count = fread(host, sizeof *host, 1 << 16, file);
    fclose(file);
    row rows[] = {{"random numbers", run<nothing>},
                  {"GGX, caps by hand", run<caps>},
                  {"GGX", run<normals<NORMALS_GGX>>},
                  {"Beckmann", run<normals<NORMALS_BECKMANN>>},
                  {"table of 2 KiB", run<normals<NORMALS_STUDENT_T_2_5_SMALL>>},
                  {"table of 3 KiB", run<normals<NORMALS_STUDENT_T_2_5>>},
                  {"2 KiB, embedded", run<embedded>},
                  {"two tables", run<two_tables>},
                  {"glass, 2 KiB", run<glass>}};
    cudaDeviceProp device;
    cudaEvent_t from, to;
    float *numbers, *sums;
    unsigned long long *bad;
    check(cudaGetDeviceProperties(&device, 0));
    check(cudaMalloc(&numbers, sizeof host));
    check(cudaMalloc(&sums, THREADS * sizeof *sums));
    check(cudaMalloc(&bad, sizeof *bad));
    check(cudaMemcpy(numbers, host, count * sizeof *host, cudaMemcpyHostToDevice));
    check(cudaEventCreate(&from));
    check(cudaEventCreate(&to));
    for (int round = 0; round <= ROUNDS; round++)
        for (row &r : rows) {
            float ms;
            unsigned long long here;
            check(cudaMemset(bad, 0, sizeof *bad));
            check(cudaEventRecord(from));
            r.kernel<<<THREADS / 128, 128>>>(numbers, (unsigned)round, sums, bad);
            check(cudaEventRecord(to));
            check(cudaEventSynchronize(to));
            check(cudaEventElapsedTime(&ms, from, to));
            check(cudaMemcpy(&here, bad, sizeof here, cudaMemcpyDeviceToHost));
            r.bad += here;
            if (round > 0) /* the first warms up */
                r.ns.push_back(1e6 * ms / ((double)THREADS * EACH));
        }
    printf("%s, %d samples a row\n%-20s %28s %14s %10s\n", device.name, ROUNDS * THREADS / 1000000 * EACH,
           "method", "ns a sample (least, most)", "samples/us", "bad");
    int any_bad = 0;
    for (row &r : rows) {
        any_bad |= r.bad > 0 && r.kernel != run<caps>;
        std::sort(r.ns.begin(), r.ns.end());
        const double median = r.ns[ROUNDS / 2];
        printf("%-20s %8.4f (%.4f, %.4f) %16.0f %10llu\n", r.name, median, r.ns.front(), r.ns.back(), 1e3 / median,
               r.bad);
    }
    return any_bad;
}
