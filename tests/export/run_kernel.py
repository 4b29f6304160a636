#!/usr/bin/env python3
"""Runs the kernels normals.kernel and bsdf.kernel of the current folder, which end in tests/export/ask.h, on whatever
runs LANGUAGE here: opencl, glsl, hlsl or wgsl. It asks NAME.asked and writes NAME.said, records of sixteen floats; a kernel
without numbers in it fetches them from numbers.f32.

Needs numpy, and pyopencl for OpenCL, moderngl with EGL for GLSL, wgpu for WGSL and, with glslangValidator, for HLSL.
Exit status 77, and a line "SKIPPED: why", where something is absent."""
import shutil
import subprocess
import sys

NUMBERS = 16  # of a question, of an answer


def skip(why):
    print("SKIPPED: " + why)
    sys.exit(77)


def module(name):
    try:
        return __import__(name)
    except Exception as error:  # a package without its driver raises what it likes
        skip(f"no {name} for Python ({error})")


# What asks question i, behind a kernel whose names begin with NAME; GIVEN is what its calls take before others.
OF_EACH = {
    "opencl": """
__kernel void run(__global const float *numbers, __global const NAME_question *asked, __global NAME_answer *said)
{
    const int i = (int)get_global_id(0);
    said[i] = NAME_ask(GIVEN asked[i]);
}
""",
    "glsl": """
layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer questions { NAME_question asked[]; };
layout(std430, binding = 2) buffer answers { NAME_answer said[]; };
void main() { said[gl_GlobalInvocationID.x] = NAME_ask(asked[gl_GlobalInvocationID.x]); }
""",
    "hlsl": """
StructuredBuffer<NAME_question> asked : register(t1);
RWStructuredBuffer<NAME_answer> said : register(u2);
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) { said[id.x] = NAME_ask(asked[id.x]); }
""",
    "wgsl": """
@group(0) @binding(1) var<storage, read> asked: array<NAME_question>;
@group(0) @binding(2) var<storage, read_write> said: array<NAME_answer>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) { said[id.x] = NAME_ask(asked[id.x]); }
""",
}

# ---- devices: each returns what runs a text over buffers of numbers, of questions, of answers, and its name ----------


def opencl():
    cl = module("pyopencl")
    try:
        devices = [d for p in cl.get_platforms() for d in p.get_devices()]
    except Exception as error:
        skip(f"no OpenCL platform ({error})")
    if not devices:
        skip("no OpenCL device")
    device = min(devices, key=lambda d: d.type != cl.device_type.GPU)
    context = cl.Context([device])
    queue = cl.CommandQueue(context)

    def run(text, arrays, fetches):
        kernel = cl.Kernel(cl.Program(context, text).build(["-cl-std=CL1.2"]), "run")
        flags = cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR
        buffers = [cl.Buffer(context, flags, hostbuf=array) for array in arrays]
        kernel(queue, (arrays[1].size // NUMBERS,), (64,), *buffers)
        said = numpy.empty_like(arrays[1])
        cl.enqueue_copy(queue, said, buffers[2])
        return said

    return run, f"{device.name} ({device.platform.name}, {device.version.strip()})"


def opengl():
    moderngl = module("moderngl")
    try:
        context = moderngl.create_standalone_context(backend="egl", require=430)
    except Exception as error:
        skip(f"no OpenGL 4.3 by EGL ({error})")

    def run(text, arrays, fetches):
        shader = context.compute_shader("#version 430\n" + text)
        buffers = [context.buffer(array.tobytes()) for array in arrays]
        for i, buffer in enumerate(buffers):
            buffer.bind_to_storage_buffer(i)
        shader.run(arrays[1].size // NUMBERS // 64)
        return numpy.frombuffer(buffers[2].read(), "<f4")

    return run, f"{context.info['GL_RENDERER']} ({context.info['GL_VERSION']})"


def spirv_of(hlsl):
    """By glslang, with the registers as bindings."""
    if not shutil.which("glslangValidator"):
        skip("no glslangValidator")
    with open("kernel.hlsl", "w") as file:
        file.write(hlsl)
    command = "glslangValidator -D -e main -S comp -V kernel.hlsl -o kernel.spv"
    made = subprocess.run(command.split(), capture_output=True, text=True)
    if made.returncode:
        sys.exit(made.stdout + made.stderr)
    with open("kernel.spv", "rb") as file:
        return file.read()


def webgpu():
    wgpu = module("wgpu")
    try:
        adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance")
        device = adapter.request_device_sync()
    except Exception as error:
        skip(f"no WebGPU adapter ({error})")

    def run(text, arrays, fetches):
        code = device.create_shader_module(code=spirv_of(text) if language == "hlsl" else text)
        pipeline = device.create_compute_pipeline(layout="auto", compute={"module": code, "entry_point": "main"})
        usage = wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC
        buffers = [device.create_buffer_with_data(data=a, usage=usage) for a in arrays]
        entries = [{"binding": i, "resource": {"buffer": b, "offset": 0, "size": b.size}}
                   for i, b in enumerate(buffers) if i or fetches]
        group = device.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=entries)
        encoder = device.create_command_encoder()
        step = encoder.begin_compute_pass()
        step.set_pipeline(pipeline)
        step.set_bind_group(0, group)
        step.dispatch_workgroups(arrays[1].size // NUMBERS // 64)
        step.end()
        device.queue.submit([encoder.finish()])
        return numpy.frombuffer(device.queue.read_buffer(buffers[2]), "<f4")

    return run, f"{adapter.info['device']} ({adapter.info['backend_type']}, {adapter.info['description']})"


language = sys.argv[1]
numpy = module("numpy")
run_on_device, device_name = {"opencl": opencl, "glsl": opengl, "hlsl": webgpu, "wgsl": webgpu}[language]()
numbers = numpy.fromfile("numbers.f32", "<f4")
for name in ("normals", "bsdf"):
    with open(name + ".kernel") as file:
        kernel = file.read()
    fetches = name.upper() + "_NUMBERS" not in kernel
    asked = numpy.fromfile(name + ".asked", "<f4")
    padded = numpy.resize(asked, -(-asked.size // (64 * NUMBERS)) * 64 * NUMBERS)  # until all groups of 64 are full
    each = OF_EACH[language].replace("NAME", name).replace("GIVEN", "numbers," if fetches else "")
    said = run_on_device(kernel + each, (numbers, padded, padded), fetches)
    said[:asked.size].tofile(name + ".said")
print(f"{language} on {device_name}")
