#!/usr/bin/env python3
"""Runs a kernel that `vndf export` wrote (prefix vndf) on whatever runs its language here.

    run_kernel.py LANGUAGE KERNEL ASK QUESTIONS ANSWERS [--buffer RAW]       for the tests of tests/export
    run_kernel.py opencl|cuda bench VNDF TABLE... [--rounds N] [--samples N] samples per second beside GGX caps

LANGUAGE is opencl, glsl, hlsl, wgsl or cuda. ASK is tests/export/ask.h in that language; QUESTIONS and ANSWERS are
records of sixteen floats. --buffer says that the kernel fetches its numbers, from RAW.

In a bench every sample has a direction above the horizon, a roughness from 0.05 to 0.95 and numbers of its own, from a
hash; the row `numbers alone` is what these cost. All rows take turns; what counts is the median.

Needs numpy, and pyopencl for OpenCL, moderngl with EGL for GLSL, glslangValidator and wgpu for HLSL, wgpu for WGSL,
nvcc and a GPU for CUDA. Exit status 77, and a line "SKIPPED: why" on stderr, where something is absent."""
import argparse
import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

NUMBERS = 16  # of a question, of an answer


def skip(why):
    print("SKIPPED: " + why, file=sys.stderr)
    sys.exit(77)


def module(name):
    try:
        return __import__(name)
    except Exception as error:  # a package without its driver raises what it likes
        skip(f"no {name} for Python ({error})")


def compiled(command):
    made = subprocess.run(command, capture_output=True, text=True)
    if made.returncode:
        sys.exit(made.stdout + made.stderr)


# ---- devices: each runs entry `index` of a source on arrays of floats, and returns seconds ---------

# Of OpenCL and CUDA, which share what stands in C.
MACROS = {
    "opencl": "#define FUNCTION static inline\n#define ENTRY __kernel void\n#define GLOBAL __global\n"
              "#define ITEM (int)get_global_id(0)\n#define MAX fmax\n#define VEC3 (float3)\n",
    "cuda": "#define FUNCTION static __device__ inline\n#define ENTRY __global__ void\n#define GLOBAL\n"
            "#define ITEM (int)(blockIdx.x * blockDim.x + threadIdx.x)\n#define MAX fmaxf\n#define VEC3 make_float3\n",
}
PARAMETERS = "(GLOBAL const float *numbers, GLOBAL const float *asked, GLOBAL float *result, int count)"


class OpenCL:
    def __init__(self, source, numbers, entries):
        cl = self.cl = module("pyopencl")
        try:
            devices = [d for p in cl.get_platforms() for d in p.get_devices()]
        except Exception as error:
            skip(f"no OpenCL platform ({error})")
        if not devices:
            skip("no OpenCL device")
        devices.sort(key=lambda d: d.type != cl.device_type.GPU)
        self.name = f"{devices[0].name} ({devices[0].platform.name}, {devices[0].version.strip()})"
        self.context = cl.Context(devices[:1])
        self.queue = cl.CommandQueue(self.context, properties=cl.command_queue_properties.PROFILING_ENABLE)
        program = cl.Program(self.context, source).build(["-cl-std=CL1.2"])
        self.kernels = [cl.Kernel(program, f"run_{i}") for i in range(entries)]
        self.numbers = self.filled(numbers)

    def filled(self, array):
        flags = self.cl.mem_flags
        return self.cl.Buffer(self.context, flags.READ_ONLY | flags.COPY_HOST_PTR, hostbuf=array)

    def run(self, index, asked, result, count):
        to = self.cl.Buffer(self.context, self.cl.mem_flags.WRITE_ONLY, result.nbytes)
        event = self.kernels[index](self.queue, (-(-count // 64) * 64,), (64,), self.numbers, self.filled(asked), to,
                                    module("numpy").int32(count))
        self.cl.enqueue_copy(self.queue, result, to)
        return 1e-9 * (event.profile.end - event.profile.start)


CUDA_HOST = """
extern "C" double run(int index, const float *numbers, int size, const float *asked, int asked_size, float *result,
                      int result_size, int count)
{
    float *at[3], ms = -1.0f;
    int sizes[3] = {size, asked_size, result_size};
    const float *from[3] = {numbers, asked, result};
    cudaEvent_t before, after;
    for (int i = 0; i < 3; i++) {
        cudaMalloc(&at[i], 4 * (size_t)sizes[i]);
        cudaMemcpy(at[i], from[i], 4 * (size_t)sizes[i], cudaMemcpyHostToDevice);
    }
    cudaEventCreate(&before);
    cudaEventCreate(&after);
    cudaEventRecord(before);
    switch (index) {
CASES    }
    cudaEventRecord(after);
    cudaEventSynchronize(after);
    cudaEventElapsedTime(&ms, before, after);
    cudaMemcpy(result, at[2], 4 * (size_t)result_size, cudaMemcpyDeviceToHost);
    for (int i = 0; i < 3; i++)
        cudaFree(at[i]);
    return cudaGetLastError() == cudaSuccess ? 1e-3 * ms : -1.0;
}
extern "C" const char *device()
{
    static cudaDeviceProp properties;
    return cudaGetDeviceProperties(&properties, 0) == cudaSuccess ? properties.name : 0;
}
"""


class CUDA:
    def __init__(self, source, numbers, entries):
        if not shutil.which("nvcc"):
            skip("no nvcc")
        self.folder, self.numbers = tempfile.TemporaryDirectory(), numbers
        text, library = os.path.join(self.folder.name, "kernel.cu"), os.path.join(self.folder.name, "kernel.so")
        cases = "".join(f"    case {i}: run_{i}<<<(count + 127) / 128, 128>>>(at[0], at[1], at[2], count); break;\n"
                        for i in range(entries))
        with open(text, "w") as file:
            file.write(source + CUDA_HOST.replace("CASES", cases))
        has_gpu = os.path.exists("/dev/nvidia0")
        compiled(["nvcc", "-O3", *(["-arch=native"] if has_gpu else []), "-shared", "-Xcompiler", "-fPIC", text, "-o",
                  library])
        self.library = ctypes.CDLL(library)
        self.library.device.restype, self.library.run.restype = ctypes.c_char_p, ctypes.c_double
        name = self.library.device()
        if name is None:
            skip("nvcc compiles the kernel, but no GPU of its is here")
        self.name = name.decode()

    def run(self, index, asked, result, count):
        arrays = [x for a in (self.numbers, asked, result) for x in (a.ctypes.data_as(ctypes.c_void_p), a.size)]
        seconds = self.library.run(index, *arrays, count)
        if seconds < 0:
            sys.exit("the kernel failed")
        return seconds


class GL:
    def __init__(self, source, numbers, entries):
        moderngl = module("moderngl")
        try:
            self.context = moderngl.create_standalone_context(backend="egl", require=430)
        except Exception as error:
            skip(f"no OpenGL 4.3 by EGL ({error})")
        self.name = f"{self.context.info['GL_RENDERER']} ({self.context.info['GL_VERSION']})"
        self.shader = self.context.compute_shader("#version 430\n" + source)
        self.numbers = numbers

    def run(self, index, asked, result, count):
        buffers = [self.context.buffer(a.tobytes()) for a in (self.numbers, asked, result)]
        for i, buffer in enumerate(buffers):
            buffer.bind_to_storage_buffer(i)
        self.shader.run(-(-count // 64))
        result.view("uint8")[:] = module("numpy").frombuffer(buffers[2].read(), "uint8")


class WebGPU:
    """WGSL, or SPIR-V in bytes."""

    def __init__(self, source, numbers, entries):
        wgpu = self.wgpu = module("wgpu")
        try:
            adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance")
            self.device = adapter.request_device_sync()
        except Exception as error:
            skip(f"no WebGPU adapter ({error})")
        self.name = f"{adapter.info['device']} ({adapter.info['backend_type']}, {adapter.info['description']})"
        self.fetches = isinstance(source, bytes) or "vndf_numbers" in source
        self.pipeline = self.device.create_compute_pipeline(
            layout="auto", compute={"module": self.device.create_shader_module(code=source), "entry_point": "main"})
        self.numbers = numbers

    def run(self, index, asked, result, count):
        usage = self.wgpu.BufferUsage
        buffers = [self.device.create_buffer_with_data(data=a, usage=usage.STORAGE | usage.COPY_SRC)
                   for a in (self.numbers, asked, result)]
        entries = [{"binding": i, "resource": {"buffer": b, "offset": 0, "size": b.size}}
                   for i, b in enumerate(buffers) if i or self.fetches]
        group = self.device.create_bind_group(layout=self.pipeline.get_bind_group_layout(0), entries=entries)
        encoder = self.device.create_command_encoder()
        step = encoder.begin_compute_pass()
        step.set_pipeline(self.pipeline)
        step.set_bind_group(0, group)
        step.dispatch_workgroups(-(-count // 64))
        step.end()
        self.device.queue.submit([encoder.finish()])
        result.view("uint8")[:] = module("numpy").frombuffer(self.device.queue.read_buffer(buffers[2]), "uint8")


def hlsl(source, numbers, entries):
    """SPIR-V by glslang, with the registers as bindings."""
    if not shutil.which("glslangValidator"):
        skip("no glslangValidator")
    with tempfile.TemporaryDirectory() as folder:
        text, binary = os.path.join(folder, "kernel.hlsl"), os.path.join(folder, "kernel.spv")
        with open(text, "w") as file:
            file.write(source)
        compiled(["glslangValidator", "-D", "-e", "main", "-S", "comp", "-V", text, "-o", binary])
        with open(binary, "rb") as file:
            return WebGPU(file.read(), numbers, entries)


DEVICES = {"opencl": OpenCL, "glsl": GL, "hlsl": hlsl, "wgsl": WebGPU, "cuda": CUDA}

# ---- questions and answers -------------------------------------------------------------------------

BODY = """
    vndf_question q;
    for (int k = 0; k < 16; k++) { q.n[k] = asked[16 * i + k]; }
    vndf_answer a = vndf_ask(NUMBERSq);
    for (int k = 0; k < 16; k++) { result[16 * i + k] = a.n[k]; }
}
"""
C_MAIN = "ENTRY run_0" + PARAMETERS + "\n{\n    int i = ITEM;\n    if (i >= count)\n        return;" + BODY
MAIN = {
    "opencl": C_MAIN,
    "cuda": C_MAIN,
    "glsl": """
layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer questions { float asked[]; };
layout(std430, binding = 2) writeonly buffer answers { float result[]; };
void main()
{
    int i = int(gl_GlobalInvocationID.x);""" + BODY,
    "hlsl": """
StructuredBuffer<float> asked : register(t1);
RWStructuredBuffer<float> result : register(u2);
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    int i = int(id.x);""" + BODY,
    "wgsl": """
@group(0) @binding(1) var<storage, read> asked: array<f32>;
@group(0) @binding(2) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>)
{
    let i = i32(id.x);""" + BODY.replace("vndf_question q", "var q: vndf_question").replace("int k", "var k")
    .replace("vndf_answer a", "var a"),
}


def text_of(path):
    with open(path) as file:
        return file.read()


def answer(given):
    numpy = module("numpy")
    fetches = given.buffer is not None
    numbers = numpy.fromfile(given.buffer, "<f4") if fetches else numpy.zeros(4, "<f4")
    source = text_of(given.words[0]) + text_of(given.words[1]) + MACROS.get(given.language, "") + MAIN[
        given.language].replace("NUMBERS", "numbers, " if fetches and given.language in MACROS else "")
    device = DEVICES[given.language](source, numbers, 1)
    print(f"{given.language} on {device.name}", file=sys.stderr)
    asked = numpy.fromfile(given.words[2], "<f4")
    count = asked.size // NUMBERS
    padded = numpy.resize(asked, -(-count // 64) * 64 * NUMBERS)
    result = numpy.zeros_like(padded)
    device.run(0, padded, result, padded.size // NUMBERS)
    result[:asked.size].tofile(given.words[3])


# ---- bench -----------------------------------------------------------------------------------------

EACH = 64  # samples of one work item
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
ROW = """
ENTRY run_INDEX""" + PARAMETERS + """
{
    int item = ITEM;
    unsigned int state = (unsigned int)item * 747796405u;
    float sum = 0.0f;
    for (int i = 0; i < EACH; i += 1) {
        float z = 0.001f + 0.999f * uniform(&state), t = 2.0f * uniform(&state) - 1.0f;
        float across = sqrt(1.0f - z * z) / (1.0f + t * t), x = across * (1.0f - t * t), y = across * 2.0f * t;
        float alpha = 0.05f + 0.9f * uniform(&state), u1 = uniform(&state), u2 = uniform(&state);
        DRAW
    }
    result[item] = sum;
}
"""
CAPS = "caps_sampled s = caps_sample(x, y, z, alpha, u1, u2); sum += s.x + s.y + s.z + s.pdf;"
EXPORTED = """vndf_view view = vndf_view_of(numbers, vndf_surface_of(CONSTANT, alpha, alpha), VEC3(x, y, z));
        vndf_sampled s = vndf_sample(numbers, view, u1, u2);
        sum += s.wm.x + s.wm.y + s.wm.z + s.pdf;"""


def bench(given):
    numpy = module("numpy")
    program, tables = given.words[1], given.words[2:]
    with tempfile.TemporaryDirectory() as folder:
        kernel, raw = os.path.join(folder, "kernel"), os.path.join(folder, "numbers")
        subprocess.run([program, "export", *tables, "--language", given.language, "--buffer", raw, "-o", kernel],
                       check=True)
        text, numbers = text_of(kernel), numpy.fromfile(raw, "<f4")
    rows = [("numbers alone", "sum += x + y + alpha + u1 + u2;"), ("GGX caps as published", CAPS),
            ("GGX, exported", EXPORTED.replace("CONSTANT", "VNDF_GGX"))]
    rows += [(f"{os.path.basename(t)}, {4 * int(n) / 1024:.1f} KiB", EXPORTED.replace("CONSTANT", "VNDF_" + c))
             for t, (c, n) in zip(tables, re.findall(r"// VNDF_(\w+), (\d+) numbers", text))]
    entries = [ROW.replace("INDEX", str(i)).replace("DRAW", draw) for i, (_, draw) in enumerate(rows)]
    device = DEVICES[given.language](text + MACROS[given.language] + f"#define EACH {EACH}\n" + SHARED +
                                     "".join(entries), numbers, len(rows))
    items = max(128, given.samples // EACH // 128 * 128)
    asked, result = numpy.zeros(4, "f4"), numpy.zeros(items, "f4")
    # The first round warms up.
    rounds = [[device.run(i, asked, result, items) for i in range(len(rows))] for _ in range(given.rounds + 1)][1:]
    print(f"{given.language} on {device.name}, {time.strftime('%Y-%m-%d')}, {items * EACH} samples a row in each of "
          f"{given.rounds} rounds")
    print(f"{'':44} {'million/s':>10} {'25%':>10} {'75%':>10} {'time of caps':>13}")
    for (name, _), took in zip(rows, numpy.array(rounds).T):
        rate = [items * EACH / t / 1e6 for t in numpy.quantile(took, [0.5, 0.75, 0.25])]
        ratio = numpy.median(took / numpy.array(rounds)[:, 1])
        print(f"{name:44} {rate[0]:10.1f} {rate[1]:10.1f} {rate[2]:10.1f} {ratio:13.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("language", choices=sorted(DEVICES))
    parser.add_argument("words", nargs="+")
    parser.add_argument("--buffer")
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--samples", type=int, default=1 << 22, help="of a row in a round")
    given = parser.parse_args()
    (bench if given.words[0] == "bench" else answer)(given)


main()
