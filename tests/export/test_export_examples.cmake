# The examples of tools/export compile with the files that `vndf export` writes: GLSL by glslang, CUDA by nvcc, where
# they are.
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
else()
    string(APPEND absent " nvcc")
endif()

if(failures)
    message(FATAL_ERROR "${failures} failures")
endif()
if(absent)
    message("SKIPPED: not here:${absent}")
endif()
