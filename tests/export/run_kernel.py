#!/usr/bin/env python3
"""Runs a kernel that `vndf export` wrote (prefix vndf) on whatever runs its language here.

    run_kernel.py LANGUAGE KERNEL ASK QUESTIONS ANSWERS [--buffer RAW]

LANGUAGE is opencl, glsl, hlsl, wgsl or cuda. ASK is tests/export/ask.h in that language; QUESTIONS and ANSWERS are
records of sixteen floats. --buffer says that the kernel fetches its numbers, from RAW.

Needs numpy, and pyopencl for OpenCL, moderngl with EGL for GLSL, wgpu for WGSL and, with glslangValidator, for HLSL,
nvcc and a GPU for CUDA. Exit status 77, and a line "SKIPPED: why" on stderr, where something is absent."""
import argparse
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


def output_of(command):
    made = subprocess.run(command, capture_output=True, text=True)
    if made.returncode == 77:
        skip("nvcc compiles the kernel, but no GPU of its is here")
    if made.returncode:
        sys.exit(made.stdout + made.stderr)
    return made.stdout.strip()


# ---- what runs on each item -------------------------------------------------------------------------

# Of OpenCL and CUDA, which share what stands in C.
C_RUN = """
ENTRY void run(GLOBAL const float *numbers, GLOBAL const vndf_question *asked, GLOBAL vndf_answer *result, int count)
{
    int i = ITEM;
    if (i < count)
        result[i] = vndf_ask(NUMBERS asked[i]);
}
"""
CUDA_MAIN = """
#include <cstdio>
#define ENTRY __global__
#define GLOBAL
#define ITEM (int)(blockIdx.x * blockDim.x + threadIdx.x)
""" + C_RUN + """
static float *all_of(const char *path, size_t *bytes)
{
    FILE *file = fopen(path, "rb");
    float *to = 0;
    fseek(file, 0, SEEK_END);
    *bytes = ftell(file);
    rewind(file);
    cudaMallocManaged(&to, *bytes);
    return fread(to, 1, *bytes, file) == *bytes ? to : 0;
}
int main(int, char **path)
{
    cudaDeviceProp device;
    size_t bytes;
    float *result;
    if (cudaGetDeviceProperties(&device, 0) != cudaSuccess)
        return 77;
    float *numbers = all_of(path[1], &bytes), *asked = all_of(path[2], &bytes);
    int count = (int)(bytes / sizeof(vndf_question));
    cudaMallocManaged(&result, bytes);
    run<<<(count + 127) / 128, 128>>>(numbers, (vndf_question *)asked, (vndf_answer *)result, count);
    puts(device.name);
    return cudaDeviceSynchronize() != cudaSuccess || fwrite(result, 1, bytes, fopen(path[3], "wb")) != bytes;
}
"""
SHADERS = {
    "glsl": """
layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer questions { vndf_question asked[]; };
layout(std430, binding = 2) buffer answers { vndf_answer result[]; };
void main() { result[gl_GlobalInvocationID.x] = vndf_ask(asked[gl_GlobalInvocationID.x]); }
""",
    "hlsl": """
StructuredBuffer<vndf_question> asked : register(t1);
RWStructuredBuffer<vndf_answer> result : register(u2);
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) { result[id.x] = vndf_ask(asked[id.x]); }
""",
    "wgsl": """
@group(0) @binding(1) var<storage, read> asked: array<vndf_question>;
@group(0) @binding(2) var<storage, read_write> result: array<vndf_answer>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) { result[id.x] = vndf_ask(asked[id.x]); }
""",
}

# ---- devices: each writes answers, and returns its name ---------------------------------------------


def text_of(*paths):
    return "".join(open(path).read() for path in paths)


def padded(path):
    """The questions, and more of them until all groups of 64 are full."""
    asked = module("numpy").fromfile(path, "<f4")
    return module("numpy").resize(asked, -(-asked.size // (64 * NUMBERS)) * 64 * NUMBERS), asked.size


def numbers_of(given):
    numpy = module("numpy")
    return numpy.fromfile(given.buffer, "<f4") if given.buffer else numpy.zeros(4, "<f4")


def opencl(given):
    cl, numpy = module("pyopencl"), module("numpy")
    try:
        devices = [d for p in cl.get_platforms() for d in p.get_devices()]
    except Exception as error:
        skip(f"no OpenCL platform ({error})")
    if not devices:
        skip("no OpenCL device")
    device = min(devices, key=lambda d: d.type != cl.device_type.GPU)
    context = cl.Context([device])
    queue = cl.CommandQueue(context)
    source = (text_of(given.kernel, given.ask) + "#define ENTRY __kernel\n#define GLOBAL __global\n"
              "#define ITEM (int)get_global_id(0)\n" + C_RUN.replace("NUMBERS", "numbers," if given.buffer else ""))
    kernel = cl.Kernel(cl.Program(context, source).build(["-cl-std=CL1.2"]), "run")
    asked, size = padded(given.questions)
    flags = cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR
    buffers = [cl.Buffer(context, flags, hostbuf=array) for array in (numbers_of(given), asked, asked)]
    kernel(queue, (asked.size // NUMBERS,), (64,), *buffers, numpy.int32(asked.size // NUMBERS))
    cl.enqueue_copy(queue, asked, buffers[2])
    asked[:size].tofile(given.answers)
    return f"{device.name} ({device.platform.name}, {device.version.strip()})"


def cuda(given):
    if not shutil.which("nvcc"):
        skip("no nvcc")
    with tempfile.TemporaryDirectory() as folder:
        text, program = os.path.join(folder, "kernel.cu"), os.path.join(folder, "kernel")
        with open(text, "w") as file:
            passed = "numbers," if given.buffer else ""
            file.write(text_of(given.kernel, given.ask) + CUDA_MAIN.replace("NUMBERS", passed))
        native = ["-arch=native"] if os.path.exists("/dev/nvidia0") else []
        output_of(["nvcc", "-O3", *native, text, "-o", program])
        return output_of([program, given.buffer or given.questions, given.questions, given.answers])


def opengl(given):
    moderngl, numpy = module("moderngl"), module("numpy")
    try:
        context = moderngl.create_standalone_context(backend="egl", require=430)
    except Exception as error:
        skip(f"no OpenGL 4.3 by EGL ({error})")
    shader = context.compute_shader("#version 430\n" + text_of(given.kernel, given.ask) + SHADERS["glsl"])
    asked, size = padded(given.questions)
    buffers = [context.buffer(array.tobytes()) for array in (numbers_of(given), asked, asked)]
    for i, buffer in enumerate(buffers):
        buffer.bind_to_storage_buffer(i)
    shader.run(asked.size // NUMBERS // 64)
    numpy.frombuffer(buffers[2].read(), "<f4")[:size].tofile(given.answers)
    return f"{context.info['GL_RENDERER']} ({context.info['GL_VERSION']})"


def webgpu(given):
    """WGSL, or SPIR-V that glslang makes of HLSL, with the registers as bindings."""
    wgpu, numpy = module("wgpu"), module("numpy")
    source = text_of(given.kernel, given.ask) + SHADERS[given.language]
    if given.language == "hlsl":
        if not shutil.which("glslangValidator"):
            skip("no glslangValidator")
        with tempfile.TemporaryDirectory() as folder:
            text, binary = os.path.join(folder, "kernel"), os.path.join(folder, "kernel.spv")
            with open(text, "w") as file:
                file.write(source)
            output_of(["glslangValidator", "-D", "-e", "main", "-S", "comp", "-V", text, "-o", binary])
            with open(binary, "rb") as file:
                source = file.read()
    try:
        adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance")
        device = adapter.request_device_sync()
    except Exception as error:
        skip(f"no WebGPU adapter ({error})")
    pipeline = device.create_compute_pipeline(
        layout="auto", compute={"module": device.create_shader_module(code=source), "entry_point": "main"})
    asked, size = padded(given.questions)
    usage = wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC
    buffers = [device.create_buffer_with_data(data=a, usage=usage) for a in (numbers_of(given), asked, asked)]
    entries = [{"binding": i, "resource": {"buffer": b, "offset": 0, "size": b.size}}
               for i, b in enumerate(buffers) if i or given.buffer]
    group = device.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=entries)
    encoder = device.create_command_encoder()
    step = encoder.begin_compute_pass()
    step.set_pipeline(pipeline)
    step.set_bind_group(0, group)
    step.dispatch_workgroups(asked.size // NUMBERS // 64)
    step.end()
    device.queue.submit([encoder.finish()])
    numpy.frombuffer(device.queue.read_buffer(buffers[2]), "<f4")[:size].tofile(given.answers)
    return f"{adapter.info['device']} ({adapter.info['backend_type']}, {adapter.info['description']})"


DEVICES = {"opencl": opencl, "glsl": opengl, "hlsl": webgpu, "wgsl": webgpu, "cuda": cuda}
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("language", choices=sorted(DEVICES))
for name in ("kernel", "ask", "questions", "answers"):
    parser.add_argument(name)
parser.add_argument("--buffer")
arguments = parser.parse_args()
print(f"{arguments.language} on {DEVICES[arguments.language](arguments)}", file=sys.stderr)
