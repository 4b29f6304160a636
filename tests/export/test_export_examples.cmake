# The examples of tools/export compile with the files that `vndf export` writes: GLSL by glslang, CUDA by nvcc, where
# they are. For a GPU a view and a sample of a table take at most 64 registers, and neither they nor a mixture of two
# tables have local memory, which an index by a variable makes.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)
find_program(glslang NAMES glslangValidator)
find_program(nvcc NAMES nvcc PATHS /usr/local/cuda/bin)
set(examples ${SOURCE}/tools/export/examples)
set(absent "")

answers(0 "" export ${SOURCE}/tables/student-t-2.5-small.vndf --language glsl -o normals.glsl)
answers(0 "" export ${SOURCE}/tables/hazy.vndf --language cuda --buffer hazy.f32 -o normals.cuh)

if(glslang)
    file(READ ${OUT}/normals.glsl kernel)
    file(READ ${examples}/bounce.glsl example)
    file(WRITE ${OUT}/bounce.comp "#version 430\n${kernel}\n${example}
layout(local_size_x = 1) in;
layout(std430, binding = 1) buffer results { vec4 result[]; };
void main() {
    bounce b = bounce_at_metal(vec3(0, 0, 1), 0.5, vec3(0.9), vec2(0.2, 0.3));
    result[0] = vec4(b.wo, b.pdf) + vec4(b.weight, 0);
    result[1] = metal_towards(vec3(0, 0, 1), b.wo, 0.5, vec3(0.9));
}
")
    execute_process(COMMAND ${glslang} ${OUT}/bounce.comp RESULT_VARIABLE status OUTPUT_VARIABLE output)
    expect("bounce.glsl does not compile:\n${output}" status EQUAL 0)
else()
    string(APPEND absent " glslang")
endif()
if(nvcc)
    configure_file(${examples}/average.cu ${OUT}/average.cu COPYONLY)
    execute_process(COMMAND ${nvcc} -c average.cu -o average.o WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status
        OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    expect("average.cu does not compile:\n${output}${errors}" status EQUAL 0)
    # registers(NAME MOST ONLY STATEMENTS): a kernel of these calls.
    function(registers name most only statements)
        answers(0 "" export ${SOURCE}/tables/hazy.vndf --language cuda --buffer hazy.f32 --distribution table --lobes 2
            --only ${only} -o ${name}.cuh)
        file(WRITE ${OUT}/${name}.cu "#include \"${name}.cuh\"
__global__ void draw(const float *numbers, const float *in, float *out)
{
    int i = 16 * (int)(blockIdx.x * blockDim.x + threadIdx.x);
    float3 wi = make_float3(in[i], in[i + 1], in[i + 2]);
    vndf_surface surface = vndf_surface_of(VNDF_HAZY, in[i + 3], in[i + 4]);
    ${statements}
    out[i] = s.wm.x;
    out[i + 1] = s.wm.y;
    out[i + 2] = s.wm.z;
    out[i + 3] = s.pdf;
}
")
        execute_process(COMMAND ${nvcc} -O3 -arch=sm_80 -Xptxas -v -c ${name}.cu -o ${name}.o WORKING_DIRECTORY ${OUT}
            RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
        expect("${name}.cu does not compile:\n${output}${errors}" status EQUAL 0)
        expect("${name} has local memory:\n${errors}" errors MATCHES "\n *0 bytes stack frame, 0 bytes spill stores")
        string(REGEX REPLACE ".*Used ([0-9]+) registers.*" "\\1" used "${errors}")
        expect("${name} takes ${used} registers, not at most ${most}" used LESS_EQUAL most)
        message("${name}: ${used} registers")
        set(failures ${failures} PARENT_SCOPE)
    endfunction()
    registers(one 64 view,sample "vndf_view view = vndf_view_of(numbers, surface, wi);
    vndf_sampled s = vndf_sample(numbers, view, in[i + 5], in[i + 6]);")
    registers(two 255 mixture "vndf_mixture m = {2, {surface, vndf_surface_of(VNDF_HAZY, in[i + 7], in[i + 8])},
        {in[i + 9], in[i + 10]}};
    vndf_mixture_view view = vndf_mixture_view_of(numbers, m, wi);
    vndf_mixed s = vndf_mixture_sample(numbers, view, in[i + 5], in[i + 6]);")
else()
    string(APPEND absent " nvcc")
endif()

if(failures)
    message(FATAL_ERROR "${failures} failures")
endif()
if(absent)
    message("SKIPPED: not here:${absent}")
endif()
