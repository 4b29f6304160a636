/* Asks two exported kernels every question of their files: `normals`, which embeds its numbers and whose file is
 * included twice, and `bsdf`, which reads those in numbers.f32. It is compiled as C99, C++11 and CUDA. */
#include <stdio.h>
#include <stdlib.h>

#include "normals.kernel"
#include "bsdf.kernel"
#include "normals.kernel"

#ifdef __CUDACC__
#  define ON(kernel, count) kernel<<<(count + 127) / 128, 128>>>
#  define FIRST (int)(blockIdx.x * blockDim.x + threadIdx.x)
#  define STEP (int)(gridDim.x * blockDim.x)
#else
#  define __global__ static
#  define ON(kernel, count) kernel
#  define FIRST 0
#  define STEP 1
#endif

__global__ void ask_normals(const normals_question *asked, normals_answer *said, int count)
{
    for (int i = FIRST; i < count; i += STEP)
        said[i] = normals_ask(asked[i]);
}

__global__ void ask_bsdf(const float *numbers, const bsdf_question *asked, bsdf_answer *said, int count)
{
    for (int i = FIRST; i < count; i += STEP)
        said[i] = bsdf_ask(numbers, asked[i]);
}

static void *room_for(size_t bytes)
{
#ifdef __CUDACC__
    void *room = NULL;
    return cudaMallocManaged(&room, bytes) == cudaSuccess ? room : NULL;
#else
    return malloc(bytes);
#endif
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
    if (cudaGetDeviceProperties(&device, 0) != cudaSuccess) {
        puts("SKIPPED: nvcc compiles the kernels, but no GPU of its is here");
        return 77;
    }
    puts(device.name);
#endif
    const float *numbers = (const float *)all_of("numbers.f32", &n);
    const bsdf_question *hit = (const bsdf_question *)all_of("bsdf.asked", &n);
    bsdf_answer *scattered = (bsdf_answer *)room_for((size_t)n * sizeof *scattered);
    const normals_question *asked = (const normals_question *)all_of("normals.asked", &n);
    normals_answer *said = (normals_answer *)room_for((size_t)n * sizeof *said);
    ON(ask_bsdf, n)(numbers, hit, scattered, n);
    ON(ask_normals, n)(asked, said, n);
#ifdef __CUDACC__
    if (cudaDeviceSynchronize() != cudaSuccess)
        return 2;
#endif
    write_all("bsdf.said", scattered, n);
    write_all("normals.said", said, n);
    return 0;
}
