#!/usr/bin/env python3
"""Samples per second of the exported OpenCL or CUDA, beside GGX caps as published, in the same run.

    bench_kernel.py opencl|cuda VNDF TABLE... [--rounds N] [--samples N] [--flags FLAGS]

VNDF is the program vndf, TABLE a .vndf file. Every sample has a direction above the horizon, a roughness from 0.05 to
0.95 and numbers of its own, from a hash; the row `numbers alone` is what these cost. All rows take turns; what counts
is the median. OpenCL takes numpy, pyopencl and a device, CUDA nvcc and a GPU; status 77 where they are absent."""
import argparse
import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

EACH = 64  # samples of one work item


def skip(why):
    print("SKIPPED: " + why, file=sys.stderr)
    sys.exit(77)


# ---- source ----------------------------------------------------------------------------------------

SHARED = """
FUNCTION float uniform(unsigned int *state) {
    unsigned int x = *state += 0x9e3779b9u;
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return (float)((x ^ (x >> 16)) >> 8) * 5.96046448e-8f;
}

typedef struct caps_sampled {
    float x, y, z, pdf;
} caps_sampled;

// J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023, and the density.
FUNCTION caps_sampled caps_sample(float wx, float wy, float wz, float alpha, float u1, float u2) {
    float sx = alpha * wx, sy = alpha * wy, size = sqrt(sx * sx + sy * sy + wz * wz);
    float x = sx / size, y = sy / size, z = wz / size;
    float phi = 6.28318531f * u1, h = (1.0f - u2) * (1.0f + z) - z, t = sqrt(MAX(0.0f, 1.0f - h * h));
    float mx = alpha * (t * cos(phi) + x), my = alpha * (t * sin(phi) + y), mz = h + z;
    float per = 1.0f / sqrt(mx * mx + my * my + mz * mz);
    mx *= per;
    my *= per;
    mz *= per;
    float across = (mx * mx + my * my) / (alpha * alpha) + mz * mz;
    float facing = MAX(0.0f, wx * mx + wy * my + wz * mz);
    caps_sampled s = {mx, my, mz,
                      facing * 2.0f / ((wz + size) * 3.14159265f * alpha * alpha * across * across)};
    return s;
}
"""
ONE = """
KERNEL void run_{index}(GLOBAL const float *numbers, GLOBAL float *result)
{{
    unsigned int item = ITEM, state = item * 747796405u;
    float sum = 0.0f;
    for (int i = 0; i < EACH; i += 1) {{
        float z = 0.001f + 0.999f * uniform(&state), t = 2.0f * uniform(&state) - 1.0f;
        float across = sqrt(1.0f - z * z) / (1.0f + t * t), x = across * (1.0f - t * t), y = across * 2.0f * t;
        float alpha = 0.05f + 0.9f * uniform(&state), u1 = uniform(&state), u2 = uniform(&state);
        {draw}
    }}
    result[item] = sum;
}}
"""
NUMBERS = "sum += x + y + alpha + u1 + u2;"
CAPS = """caps_sampled s = caps_sample(x, y, z, alpha, u1, u2);
        sum += s.x + s.y + s.z + s.pdf;"""
EXPORTED = """vndf_view view = vndf_view_of(numbers, vndf_surface_of({constant}, alpha, alpha), VEC3(x, y, z));
        vndf_sampled s = vndf_sample(numbers, view, u1, u2);
        sum += s.wm.x + s.wm.y + s.wm.z + s.pdf;"""
MACROS = {
    "opencl": "#define FUNCTION static inline\n#define KERNEL __kernel\n#define GLOBAL __global\n"
              "#define ITEM get_global_id(0)\n#define MAX fmax\n#define VEC3 (float3)\n",
    "cuda": "#define FUNCTION static __device__ inline\n#define KERNEL extern \"C\" __global__\n#define GLOBAL\n"
            "#define ITEM (blockIdx.x * blockDim.x + threadIdx.x)\n#define MAX fmaxf\n#define VEC3 make_float3\n",
}


def exported(program, language, tables, folder):
    """The text of the kernel, the file of its numbers, and a name and a constant for each row."""
    kernel, raw = os.path.join(folder, "kernel"), os.path.join(folder, "numbers")
    subprocess.run([program, "export", *tables, "--language", language, "--buffer", raw, "-o", kernel], check=True)
    with open(kernel) as file:
        text = file.read()
    found = re.findall(r"// VNDF_(\w+), (\d+) numbers", text)
    return text, raw, [(f"{os.path.basename(t)}, {4 * int(n) / 1024:.1f} KiB", "VNDF_" + c)
                       for t, (c, n) in zip(tables, found)]


def source_of(language, text, rows):
    draws = [NUMBERS, CAPS, EXPORTED.format(constant="VNDF_GGX")]
    draws += [EXPORTED.format(constant=constant) for _, constant in rows]
    kernels = [ONE.format(index=i, draw=draw) for i, draw in enumerate(draws)]
    return text + MACROS[language] + f"#define EACH {EACH}\n" + SHARED + "".join(kernels)


# ---- devices: seconds of run_INDEX -----------------------------------------------------------------

class OpenCL:
    def __init__(self, source, raw, items, kernels, flags):
        try:
            import numpy
            import pyopencl as cl
            devices = [d for p in cl.get_platforms() for d in p.get_devices()]
            devices.sort(key=lambda d: d.type != cl.device_type.GPU)
            device = devices[0]
        except Exception as error:
            skip(f"no OpenCL ({error})")
        self.name, self.items, self.cl = f"{device.name} ({device.platform.name})", items, cl
        context = cl.Context([device])
        self.queue = cl.CommandQueue(context, properties=cl.command_queue_properties.PROFILING_ENABLE)
        program = cl.Program(context, source).build(["-cl-std=CL1.2", *flags])
        self.kernels = [cl.Kernel(program, f"run_{i}") for i in range(kernels)]
        numbers = numpy.fromfile(raw, "<f4")
        self.numbers = cl.Buffer(context, cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR, hostbuf=numbers)
        self.result = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, 4 * items)

    def seconds(self, index):
        event = self.kernels[index](self.queue, (self.items,), (64,), self.numbers, self.result)
        event.wait()
        return 1e-9 * (event.profile.end - event.profile.start)


CUDA_HOST = """
#include <cstdio>
static float *numbers, *result;
extern "C" const char *begin(const float *from, int size, int items)
{
    static cudaDeviceProp properties;
    if (cudaGetDeviceProperties(&properties, 0) != cudaSuccess)
        return 0;
    cudaMalloc(&numbers, 4 * (size_t)size);
    cudaMalloc(&result, 4 * (size_t)items);
    cudaMemcpy(numbers, from, 4 * (size_t)size, cudaMemcpyHostToDevice);
    return properties.name;
}
extern "C" double seconds(int index, int items)
{
    cudaEvent_t before, after;
    float ms = -1.0f;
    cudaEventCreate(&before);
    cudaEventCreate(&after);
    cudaEventRecord(before);
    switch (index) {
CASES    }
    cudaEventRecord(after);
    cudaEventSynchronize(after);
    cudaEventElapsedTime(&ms, before, after);
    cudaEventDestroy(before);
    cudaEventDestroy(after);
    return cudaGetLastError() == cudaSuccess ? 1e-3 * ms : -1.0;
}
"""


class CUDA:
    def __init__(self, source, raw, items, kernels, flags):
        if not shutil.which("nvcc"):
            skip("no nvcc")
        folder = os.path.dirname(raw)
        text, library = os.path.join(folder, "bench.cu"), os.path.join(folder, "bench.so")
        cases = "".join(f"    case {i}: run_{i}<<<items / 128, 128>>>(numbers, result); break;\n" for i in range(kernels))
        with open(text, "w") as file:
            file.write(source + CUDA_HOST.replace("CASES", cases))
        made = subprocess.run(["nvcc", "-O3", "-arch=native", *flags, "-shared", "-Xcompiler", "-fPIC", text, "-o",
                               library], capture_output=True, text=True)
        if made.returncode:  # without a GPU there is no native one
            made = subprocess.run(["nvcc", "-O3", *flags, "-shared", "-Xcompiler", "-fPIC", text, "-o", library],
                                  capture_output=True, text=True)
        if made.returncode:
            sys.exit(made.stdout + made.stderr)
        with open(raw, "rb") as file:
            numbers = file.read()
        self.library, self.items = ctypes.CDLL(library), items
        self.library.begin.restype, self.library.seconds.restype = ctypes.c_char_p, ctypes.c_double
        name = self.library.begin(numbers, len(numbers) // 4, items)
        if name is None:
            skip("nvcc compiles the kernels, but no GPU of its is here")
        self.name = name.decode()

    def seconds(self, index):
        took = self.library.seconds(index, self.items)
        if took < 0:
            sys.exit("the kernel failed")
        return took


# ---- work ------------------------------------------------------------------------------------------

def quartiles(values):
    values = sorted(values)
    return [values[int(part * (len(values) - 1))] for part in (0.25, 0.5, 0.75)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("language", choices=["opencl", "cuda"])
    parser.add_argument("vndf")
    parser.add_argument("tables", nargs="+")
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--samples", type=int, default=1 << 22, help="of a row in a round")
    parser.add_argument("--flags", default="", help="more for the compiler, such as --use_fast_math")
    given = parser.parse_args()
    items = max(128, given.samples // EACH // 128 * 128)
    with tempfile.TemporaryDirectory() as folder:
        text, raw, rows = exported(given.vndf, given.language, given.tables, folder)
        names = ["numbers alone", "GGX caps as published", "GGX, exported"] + [name for name, _ in rows]
        kind = {"opencl": OpenCL, "cuda": CUDA}[given.language]
        device = kind(source_of(given.language, text, rows), raw, items, len(names), given.flags.split())
        times = [[] for _ in names]
        for turn in range(given.rounds + 1):
            for i in range(len(names)):
                took = device.seconds(i)
                if turn > 0:  # the first warms up
                    times[i].append(took)
    print(f"{given.language} on {device.name}, {time.strftime('%Y-%m-%d')}, {items * EACH} samples a row in each of "
          f"{given.rounds} rounds {given.flags}")
    print(f"{'':44} {'million/s':>10} {'25%':>10} {'75%':>10} {'time of caps':>13}")
    for name, took in zip(names, times):
        low, median, high = quartiles(took)
        ratio = quartiles([t / c for t, c in zip(took, times[1])])[1]
        rate = [items * EACH / t / 1e6 for t in (median, high, low)]
        print(f"{name:44} {rate[0]:10.1f} {rate[1]:10.1f} {rate[2]:10.1f} {ratio:13.2f}")


main()
