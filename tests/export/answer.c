/* Asks two exported kernels every question of their files: `normals`, which embeds its numbers and whose file is
 * included twice, and `bsdf`, which reads those in numbers.f32. It is compiled as C99, C++11 and CUDA. */
#include <stdio.h>
#include <stdlib.h>

#include "normals.kernel"
#include "bsdf.kernel"
#include "normals.kernel"

#ifndef __CUDACC__
#  define __host__
#  define __device__
#endif

__host__ __device__ static void answer(const float *numbers, const normals_question *asked, normals_answer *said,
                                       const bsdf_question *hit, bsdf_answer *scattered, int i)
{
    said[i] = normals_ask(asked[i]);
    scattered[i] = bsdf_ask(numbers, hit[i]);
}

static int on_device;

#ifdef __CUDACC__
__global__ void answer_all(const float *numbers, const normals_question *asked, normals_answer *said,
                           const bsdf_question *hit, bsdf_answer *scattered, int count)
{
    const int i = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count)
        answer(numbers, asked, said, hit, scattered, i);
}
#endif

static void *room_for(size_t bytes)
{
#ifdef __CUDACC__
    void *room = NULL;
    if (on_device)
        return cudaMallocManaged(&room, bytes) == cudaSuccess ? room : NULL;
#endif
    return malloc(bytes);
}

/* The whole file, and how many questions it has. */
static void *all_of(const char *path, int *count)
{
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0)
        exit(2);
    const size_t bytes = (size_t)ftell(file);
    void *all = room_for(bytes);
    rewind(file);
    if (!all || fread(all, 1, bytes, file) != bytes || fclose(file) != 0)
        exit(2);
    *count = (int)(bytes / sizeof(normals_question));
    return all;
}

static void write_all(const char *path, const void *said, int count)
{
    FILE *file = fopen(path, "wb");
    if (!file || !fwrite(said, (size_t)count * sizeof(normals_answer), 1, file) || fclose(file) != 0)
        exit(2);
}

int main(void)
{
    int n;
#ifdef __CUDACC__
    cudaDeviceProp device;
    on_device = cudaGetDeviceProperties(&device, 0) == cudaSuccess;
    puts(on_device ? device.name : "no GPU: the functions of the host");
#endif
    const float *numbers = (const float *)all_of("numbers.f32", &n);
    const bsdf_question *hit = (const bsdf_question *)all_of("bsdf.asked", &n);
    bsdf_answer *scattered = (bsdf_answer *)room_for((size_t)n * sizeof *scattered);
    const normals_question *asked = (const normals_question *)all_of("normals.asked", &n);
    normals_answer *said = (normals_answer *)room_for((size_t)n * sizeof *said);
#ifdef __CUDACC__
    if (on_device) {
        answer_all<<<(n + 127) / 128, 128>>>(numbers, asked, said, hit, scattered, n);
        if (cudaDeviceSynchronize() != cudaSuccess)
            return 2;
    }
#endif
    for (int i = 0; i < n && !on_device; i++)
        answer(numbers, asked, said, hit, scattered, i);
    write_all("bsdf.said", scattered, n);
    write_all("normals.said", said, n);
    return 0;
}
