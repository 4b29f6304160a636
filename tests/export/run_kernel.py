#!/usr/bin/env python3
"""Runs a kernel that `vndf export` wrote (prefix vndf) on whatever runs its language here.

    run_kernel.py LANGUAGE KERNEL ASK QUESTIONS ANSWERS [--buffer RAW]

LANGUAGE is opencl, glsl, hlsl, wgsl or cuda. ASK is tests/export/ask.h in that language; QUESTIONS and ANSWERS are
records of sixteen floats. --buffer says that the kernel fetches its numbers, from RAW.

Needs numpy, and pyopencl for OpenCL, moderngl with EGL for GLSL, glslangValidator and wgpu for HLSL, wgpu for WGSL,
nvcc and a GPU for CUDA. Exit status 77, and a line "SKIPPED: why" on stderr, where something is absent."""
import argparse
import ctypes
import os
import shutil
import subprocess
import sys
import tempfile

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


# ---- devices: each runs a source on arrays of floats ------------------------------------------------

# Of OpenCL and CUDA, which share what stands in C.
MACROS = {
    "opencl": "#define ENTRY __kernel void\n#define GLOBAL __global\n#define ITEM (int)get_global_id(0)\n",
    "cuda": "#define ENTRY __global__ void\n#define GLOBAL\n"
            "#define ITEM (int)(blockIdx.x * blockDim.x + threadIdx.x)\n",
}
PARAMETERS = "(GLOBAL const float *numbers, GLOBAL const float *asked, GLOBAL float *result, int count)"


class OpenCL:
    def __init__(self, source, numbers):
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
        self.queue = cl.CommandQueue(self.context)
        program = cl.Program(self.context, source).build(["-cl-std=CL1.2"])
        self.kernel = cl.Kernel(program, "run")
        self.numbers = self.filled(numbers)

    def filled(self, array):
        flags = self.cl.mem_flags
        return self.cl.Buffer(self.context, flags.READ_ONLY | flags.COPY_HOST_PTR, hostbuf=array)

    def run(self, asked, result, count):
        to = self.cl.Buffer(self.context, self.cl.mem_flags.WRITE_ONLY, result.nbytes)
        self.kernel(self.queue, (-(-count // 64) * 64,), (64,), self.numbers, self.filled(asked), to,
                    module("numpy").int32(count))
        self.cl.enqueue_copy(self.queue, result, to)


CUDA_HOST = """
extern "C" int run_here(const float *numbers, int size, const float *asked, int asked_size, float *result,
                        int result_size, int count)
{
    float *at[3];
    int sizes[3] = {size, asked_size, result_size};
    const float *from[3] = {numbers, asked, result};
    for (int i = 0; i < 3; i++) {
        cudaMalloc(&at[i], 4 * (size_t)sizes[i]);
        cudaMemcpy(at[i], from[i], 4 * (size_t)sizes[i], cudaMemcpyHostToDevice);
    }
    run<<<(count + 127) / 128, 128>>>(at[0], at[1], at[2], count);
    cudaMemcpy(result, at[2], 4 * (size_t)result_size, cudaMemcpyDeviceToHost);
    for (int i = 0; i < 3; i++)
        cudaFree(at[i]);
    return cudaGetLastError() == cudaSuccess;
}
extern "C" const char *device()
{
    static cudaDeviceProp properties;
    return cudaGetDeviceProperties(&properties, 0) == cudaSuccess ? properties.name : 0;
}
"""


class CUDA:
    def __init__(self, source, numbers):
        if not shutil.which("nvcc"):
            skip("no nvcc")
        self.folder, self.numbers = tempfile.TemporaryDirectory(), numbers
        text, library = os.path.join(self.folder.name, "kernel.cu"), os.path.join(self.folder.name, "kernel.so")
        with open(text, "w") as file:
            file.write(source + CUDA_HOST)
        has_gpu = os.path.exists("/dev/nvidia0")
        compiled(["nvcc", "-O3", *(["-arch=native"] if has_gpu else []), "-shared", "-Xcompiler", "-fPIC", text, "-o",
                  library])
        self.library = ctypes.CDLL(library)
        self.library.device.restype = ctypes.c_char_p
        name = self.library.device()
        if name is None:
            skip("nvcc compiles the kernel, but no GPU of its is here")
        self.name = name.decode()

    def run(self, asked, result, count):
        arrays = [x for a in (self.numbers, asked, result) for x in (a.ctypes.data_as(ctypes.c_void_p), a.size)]
        if not self.library.run_here(*arrays, count):
            sys.exit("the kernel failed")


class GL:
    def __init__(self, source, numbers):
        moderngl = module("moderngl")
        try:
            self.context = moderngl.create_standalone_context(backend="egl", require=430)
        except Exception as error:
            skip(f"no OpenGL 4.3 by EGL ({error})")
        self.name = f"{self.context.info['GL_RENDERER']} ({self.context.info['GL_VERSION']})"
        self.shader = self.context.compute_shader("#version 430\n" + source)
        self.numbers = numbers

    def run(self, asked, result, count):
        buffers = [self.context.buffer(a.tobytes()) for a in (self.numbers, asked, result)]
        for i, buffer in enumerate(buffers):
            buffer.bind_to_storage_buffer(i)
        self.shader.run(-(-count // 64))
        result.view("uint8")[:] = module("numpy").frombuffer(buffers[2].read(), "uint8")


class WebGPU:
    """WGSL, or SPIR-V in bytes."""

    def __init__(self, source, numbers):
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

    def run(self, asked, result, count):
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


def hlsl(source, numbers):
    """SPIR-V by glslang, with the registers as bindings."""
    if not shutil.which("glslangValidator"):
        skip("no glslangValidator")
    with tempfile.TemporaryDirectory() as folder:
        text, binary = os.path.join(folder, "kernel.hlsl"), os.path.join(folder, "kernel.spv")
        with open(text, "w") as file:
            file.write(source)
        compiled(["glslangValidator", "-D", "-e", "main", "-S", "comp", "-V", text, "-o", binary])
        with open(binary, "rb") as file:
            return WebGPU(file.read(), numbers)


DEVICES = {"opencl": OpenCL, "glsl": GL, "hlsl": hlsl, "wgsl": WebGPU, "cuda": CUDA}

# ---- questions and answers -------------------------------------------------------------------------

BODY = """
    vndf_question q;
    for (int k = 0; k < 16; k++) { q.n[k] = asked[16 * i + k]; }
    vndf_answer a = vndf_ask(NUMBERSq);
    for (int k = 0; k < 16; k++) { result[16 * i + k] = a.n[k]; }
}
"""
C_MAIN = "ENTRY run" + PARAMETERS + "\n{\n    int i = ITEM;\n    if (i >= count)\n        return;" + BODY
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("language", choices=sorted(DEVICES))
    for name in ("kernel", "ask", "questions", "answers"):
        parser.add_argument(name)
    parser.add_argument("--buffer")
    given, numpy = parser.parse_args(), module("numpy")
    numbers = numpy.fromfile(given.buffer, "<f4") if given.buffer else numpy.zeros(4, "<f4")
    passed = "numbers, " if given.buffer and given.language in MACROS else ""
    source = text_of(given.kernel) + text_of(given.ask) + MACROS.get(given.language, "")
    device = DEVICES[given.language](source + MAIN[given.language].replace("NUMBERS", passed), numbers)
    print(f"{given.language} on {device.name}", file=sys.stderr)
    asked = numpy.fromfile(given.questions, "<f4")
    count = asked.size // NUMBERS
    padded = numpy.resize(asked, -(-count // 64) * 64 * NUMBERS)
    result = numpy.zeros_like(padded)
    device.run(padded, result, padded.size // NUMBERS)
    result[:asked.size].tofile(given.answers)


main()
