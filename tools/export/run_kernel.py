#!/usr/bin/env python3
"""Runs a kernel that `vndf export` wrote (prefix vndf) on whatever runs its language here: for the tests of tests/export.

    run_kernel.py LANGUAGE KERNEL QUESTIONS ANSWERS [--buffer RAW] [--bsdf EFFECTS]

LANGUAGE is opencl, glsl, hlsl, wgsl or cuda. QUESTIONS are records of twelve floats, of a BSDF sixteen, ANSWERS of
sixteen: tests/export/exported.h says which. --buffer says that the kernel fetches its numbers, from RAW; --bsdf that it
is a BSDF, exported with these effects.

Needs numpy, and pyopencl for OpenCL, moderngl with EGL for GLSL, glslangValidator and wgpu for HLSL, wgpu for WGSL,
nvcc and a GPU for CUDA. Exit status 77, and a line "SKIPPED: why" on stderr, where something is absent."""
import argparse
import ctypes
import os
import shutil
import subprocess
import sys
import tempfile

ANSWER = 16


def skip(why):
    print("SKIPPED: " + why, file=sys.stderr)
    sys.exit(77)


def module(name):
    try:
        return __import__(name)
    except Exception as error:  # a package without its driver raises what it likes
        skip(f"no {name} for Python ({error})")


# ---- what is asked, in each language ---------------------------------------------------------------

# A line is "type name = value", "name = value" or a call of put(index, value). WORD(...) of these fetch numbers.
SURFACE = """
    vndf_surface surface
    surface.distribution = int(ask(0))
    surface.xx = ask(1)
    surface.xy = ask(2)
    surface.yx = ask(3)
    surface.yy = ask(4)
    surface.mean_x = ask(5)
    surface.mean_y = ask(6)
    vec3 wi = vec3(ask(7), ask(8), ask(9))
"""
NORMALS = SURFACE + """
    vndf_view view = vndf_view_of(surface, wi)
    vndf_sampled drawn = vndf_sample(view, ask(10), ask(11))
    put(0, drawn.wm.x)
    put(1, drawn.wm.y)
    put(2, drawn.wm.z)
    put(3, drawn.pdf)
    put(4, vndf_pdf(view, drawn.wm))
    put(5, vndf_visible(view, drawn.wm))
    put(6, vndf_ndf(surface, drawn.wm))
    put(7, vndf_lambda(surface, wi))
    put(8, vndf_g1(surface, wi))
    put(9, vndf_g2(surface, wi, drawn.wm))
    put(10, vndf_projected_area(view))
    vndf_mixture mixture
    mixture.count = 2
    mixture.lobe[0] = surface
    mixture.lobe[1] = vndf_surface_of(VNDF_GGX, 0.3, 0.3)
    mixture.lobe[2] = surface
    mixture.lobe[3] = surface
    mixture.weight[0] = 0.6
    mixture.weight[1] = 0.4
    mixture.weight[2] = 0.0
    mixture.weight[3] = 0.0
    vndf_mixture_view lobes = vndf_mixture_view_of(mixture, wi)
    vndf_sampled mixed = vndf_mixture_sample(lobes, ask(10), ask(11))
    put(11, mixed.wm.x)
    put(12, mixed.wm.y)
    put(13, mixed.wm.z)
    put(14, mixed.pdf)
    put(15, vndf_mixture_pdf(lobes, mixed.wm))
"""
# Optics that the effects have, and a line for each.
OPTICS = {
    "indexed": "material.eta = 1.5",
    "schlick": "material.f0 = vec3(0.0, 0.04, 0.9)",
    "conductor": "material.conductor_eta = vec3(0.2, 0.9, 1.5)\n material.conductor_k = vec3(3.9, 2.4, 1.9)",
}
BSDF = SURFACE + """
    vndf_material material
    material.surface = surface
OPTICS
    vndf_bsdf bsdf = vndf_bsdf_of(material, wi)
    vndf_scattered s = vndf_bsdf_sample(bsdf, vec3(ask(10), ask(11), ask(12)))
    put(0, s.wo.x)
    put(1, s.wo.y)
    put(2, s.wo.z)
    put(3, s.weight.x)
    put(4, s.weight.y)
    put(5, s.weight.z)
    put(6, s.pdf)
    put(7, float(s.lobe))
    vec3 wo = vec3(ask(13), ask(14), ask(15))
    vec3 f = vndf_bsdf_eval(bsdf, wo)
    put(8, f.x)
    put(9, f.y)
    put(10, f.z)
    put(11, vndf_bsdf_pdf(bsdf, wo))
    vec3 own = vndf_bsdf_eval(bsdf, s.wo)
    put(12, own.x)
    put(13, own.y)
    put(14, own.z)
    put(15, vndf_bsdf_pdf(bsdf, s.wo))
"""


def asked_of(effects):
    """The lines, and how many numbers a question has."""
    if effects is None:
        return NORMALS, 12
    has = [word for word in ("schlick", "conductor") if "fresnel=" + word in effects]
    if "dielectric" in effects or "lobes=both" in effects or "lobes=transmission" in effects:
        has.append("indexed")
    return BSDF.replace("OPTICS", "\n".join(OPTICS[word] for word in has)), 16


FETCHING = ("bsdf_of", "bsdf_sample", "bsdf_eval", "bsdf_pdf", "view_of", "sample", "pdf", "visible", "ndf", "lambda", "g1", "g2", "mixture_view_of", "mixture_sample",
            "mixture_pdf")
C_NAMES = {"vec3(": "(float3)(", "int(": "(int)(", "float(": "(float)("}
NAMES = {
    "opencl": C_NAMES,
    "cuda": {"vec3(": "make_float3(", "vec3 ": "float3 "},
    "glsl": {},
    "hlsl": {"vec3(": "float3(", "vec3 ": "float3 "},
    "wgsl": {"vec3(": "vec3<f32>(", "int(": "i32(", "float(": "f32("},
}
NAMES["opencl"]["vec3 "] = "float3 "


def body(language, by_pointer, effects):
    """The statements."""
    lines = []
    text, size = asked_of(effects)
    for line in text.split("\n"):
        line = line.strip()
        if not line:
            continue
        if line.startswith("put("):
            index, value = line[4:-1].split(", ", 1)
            line = f"result[{ANSWER} * i + {index}] = {value}"
        elif language == "wgsl" and not line.split(" ")[0].startswith(("surface.", "mixture.", "material.")):
            kind, rest = line.split(" ", 1)
            name = rest.split(" ", 1)[0]
            line = f"var {name}: {kind.replace('vec3', 'vec3<f32>')}" + rest[len(name):]
        for index in range(size):
            line = line.replace(f"ask({index})", f"asked[{size} * i + {index}]")
        for old, new in NAMES[language].items():
            line = line.replace(old, new)
        if by_pointer:
            for name in FETCHING:
                line = line.replace(f" vndf_{name}(", f" vndf_{name}(numbers, ")
        lines.append("    " + line + ";")
    return "\n".join(lines)


MAIN = {
    "opencl": """
__kernel void run({numbers}__global const float *asked, __global float *result, int count)
{{
    int i = (int)get_global_id(0);
    if (i >= count)
        return;
{body}
}}
""",
    "cuda": """
__global__ void run_all({numbers}const float *asked, float *result, int count)
{{
    int i = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (i >= count)
        return;
{body}
}}

extern "C" const char *run(const float *numbers, int size, const float *asked, int asked_size, float *result,
                           int result_size, int count)
{{
    float *n, *a, *r;
    cudaMalloc(&n, 4 * (size_t)size + 4);
    cudaMalloc(&a, 4 * (size_t)asked_size);
    cudaMalloc(&r, 4 * (size_t)result_size);
    cudaMemcpy(n, numbers, 4 * (size_t)size, cudaMemcpyHostToDevice);
    cudaMemcpy(a, asked, 4 * (size_t)asked_size, cudaMemcpyHostToDevice);
    run_all<<<(count + 63) / 64, 64>>>({given}a, r, count);
    cudaMemcpy(result, r, 4 * (size_t)result_size, cudaMemcpyDeviceToHost);
    cudaFree(n);
    cudaFree(a);
    cudaFree(r);
    cudaError_t error = cudaGetLastError();
    return error == cudaSuccess ? 0 : cudaGetErrorString(error);
}}

extern "C" const char *device()
{{
    static cudaDeviceProp properties;
    return cudaGetDeviceProperties(&properties, 0) == cudaSuccess ? properties.name : 0;
}}
""",
    "glsl": """
layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer questions {{ float asked[]; }};
layout(std430, binding = 2) writeonly buffer answers {{ float result[]; }};
void main()
{{
    int i = int(gl_GlobalInvocationID.x);
{body}
}}
""",
    "hlsl": """
StructuredBuffer<float> asked : register(t1);
RWStructuredBuffer<float> result : register(u2);
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID)
{{
    int i = int(id.x);
{body}
}}
""",
    "wgsl": """
@group(0) @binding(1) var<storage, read> asked: array<f32>;
@group(0) @binding(2) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>)
{{
    let i = i32(id.x);
{body}
}}
""",
}


def source_of(language, kernel, fetches, effects):
    by_pointer = fetches and language in ("opencl", "cuda")
    qualifier = "__global const float *numbers, " if language == "opencl" else "const float *numbers, "
    main = MAIN[language].format(numbers=qualifier if by_pointer else "", given="n, " if by_pointer else "",
                                 body=body(language, by_pointer, effects))
    return ("#version 430\n" if language == "glsl" else "") + kernel + main


# ---- devices: each runs a source on arrays of floats -----------------------------------------------

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
        self.kernel = cl.Kernel(cl.Program(self.context, source).build(["-cl-std=CL1.2"]), "run")
        self.numbers = [] if numbers is None else [self.filled(numbers)]

    def filled(self, array):
        flags = self.cl.mem_flags
        return self.cl.Buffer(self.context, flags.READ_ONLY | flags.COPY_HOST_PTR, hostbuf=array)

    def run(self, asked, result, count):
        numpy = module("numpy")
        to = self.cl.Buffer(self.context, self.cl.mem_flags.WRITE_ONLY, result.nbytes)
        self.kernel(self.queue, (-(-count // 64) * 64,), (64,), *self.numbers, self.filled(asked), to,
                    numpy.int32(count))
        self.cl.enqueue_copy(self.queue, result, to)


class GL:
    def __init__(self, source, numbers):
        moderngl = module("moderngl")
        try:
            self.context = moderngl.create_standalone_context(backend="egl", require=430)
        except Exception as error:
            skip(f"no OpenGL 4.3 by EGL ({error})")
        self.name = f"{self.context.info['GL_RENDERER']} ({self.context.info['GL_VERSION']})"
        self.shader = self.context.compute_shader(source)
        self.numbers = None if numbers is None else self.context.buffer(numbers.tobytes())

    def run(self, asked, result, count):
        given, to = self.context.buffer(asked.tobytes()), self.context.buffer(reserve=result.nbytes)
        if self.numbers:
            self.numbers.bind_to_storage_buffer(0)
        given.bind_to_storage_buffer(1)
        to.bind_to_storage_buffer(2)
        self.shader.run(count // 64)
        result.view("uint8")[:] = module("numpy").frombuffer(to.read(), "uint8")
        given.release()
        to.release()


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
        shader = self.device.create_shader_module(code=source)
        self.pipeline = self.device.create_compute_pipeline(layout="auto",
                                                            compute={"module": shader, "entry_point": "main"})
        self.numbers = None if numbers is None else self.filled(numbers)

    def filled(self, array):
        return self.device.create_buffer_with_data(data=array, usage=self.wgpu.BufferUsage.STORAGE)

    def run(self, asked, result, count):
        usage = self.wgpu.BufferUsage
        to = self.device.create_buffer(size=result.nbytes, usage=usage.STORAGE | usage.COPY_SRC)
        buffers = {1: self.filled(asked), 2: to}
        if self.numbers:
            buffers[0] = self.numbers
        entries = [{"binding": i, "resource": {"buffer": b, "offset": 0, "size": b.size}} for i, b in buffers.items()]
        group = self.device.create_bind_group(layout=self.pipeline.get_bind_group_layout(0), entries=entries)
        encoder = self.device.create_command_encoder()
        step = encoder.begin_compute_pass()
        step.set_pipeline(self.pipeline)
        step.set_bind_group(0, group)
        step.dispatch_workgroups(count // 64)
        step.end()
        self.device.queue.submit([encoder.finish()])
        result.view("uint8")[:] = module("numpy").frombuffer(self.device.queue.read_buffer(to), "uint8")


def hlsl(source, numbers):
    """SPIR-V by glslang, with the registers as bindings."""
    if not shutil.which("glslangValidator"):
        skip("no glslangValidator")
    with tempfile.TemporaryDirectory() as folder:
        text, binary = os.path.join(folder, "kernel.hlsl"), os.path.join(folder, "kernel.spv")
        with open(text, "w") as file:
            file.write(source)
        made = subprocess.run(["glslangValidator", "-D", "-e", "main", "-S", "comp", "-V", text, "-o", binary],
                              capture_output=True, text=True)
        if made.returncode:
            sys.exit(made.stdout + made.stderr)
        print("compiled by glslangValidator", file=sys.stderr)
        with open(binary, "rb") as file:
            return WebGPU(file.read(), numbers)


class CUDA:
    def __init__(self, source, numbers):
        if not shutil.which("nvcc"):
            skip("no nvcc")
        self.folder = tempfile.TemporaryDirectory()
        text, library = os.path.join(self.folder.name, "kernel.cu"), os.path.join(self.folder.name, "kernel.so")
        with open(text, "w") as file:
            file.write(source)
        made = subprocess.run(["nvcc", "-O2", "-shared", "-Xcompiler", "-fPIC", text, "-o", library],
                              capture_output=True, text=True)
        if made.returncode:
            sys.exit(made.stdout + made.stderr)
        self.library = ctypes.CDLL(library)
        self.library.device.restype = self.library.run.restype = ctypes.c_char_p
        name = self.library.device()
        if name is None:
            skip("nvcc compiles the kernel, but no GPU of its is here")
        self.name = name.decode()
        self.numbers = module("numpy").zeros(1, "f4") if numbers is None else numbers

    def run(self, asked, result, count):
        at = [a.ctypes.data_as(ctypes.c_void_p) for a in (self.numbers, asked, result)]
        error = self.library.run(at[0], self.numbers.size, at[1], asked.size, at[2], result.size, count)
        if error is not None:
            sys.exit(error.decode())


DEVICES = {"opencl": OpenCL, "glsl": GL, "hlsl": hlsl, "wgsl": WebGPU, "cuda": CUDA}


# ---- work ------------------------------------------------------------------------------------------

def answers(device, questions, to, effects):
    numpy, size = module("numpy"), asked_of(effects)[1]
    asked = numpy.fromfile(questions, "<f4")
    count = asked.size // size
    padded = numpy.zeros(-(-count // 64) * 64 * size, "<f4")
    padded[:asked.size] = asked
    padded[asked.size:] = numpy.resize(asked[:size], padded.size - asked.size)
    result = numpy.zeros(padded.size // size * ANSWER, "<f4")
    device.run(padded, result, padded.size // size)
    result[:count * ANSWER].tofile(to)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("language", choices=sorted(DEVICES))
    parser.add_argument("kernel")
    parser.add_argument("questions")
    parser.add_argument("answers")
    parser.add_argument("--buffer")
    parser.add_argument("--bsdf")
    given = parser.parse_args()
    numpy = module("numpy")
    numbers = None if given.buffer is None else numpy.fromfile(given.buffer, "<f4")
    with open(given.kernel) as file:
        kernel = file.read()
    device = DEVICES[given.language](source_of(given.language, kernel, numbers is not None, given.bsdf), numbers)
    print(f"{given.language} on {device.name}", file=sys.stderr)
    answers(device, given.questions, given.answers, given.bsdf)


main()
