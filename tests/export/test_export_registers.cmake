# For a GPU of NVIDIA a view and a sample of a table take at most 64 registers, and neither they nor a mixture of two
# tables nor a BSDF have local memory, which an index by a variable makes. The exported CUDA is compiled by nvcc.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)
find_program(nvcc NAMES nvcc PATHS /usr/local/cuda/bin)
if(NOT nvcc)
    message("SKIPPED: no nvcc")
    return()
endif()

# registers(NAME MOST STATEMENTS OPTION...): a kernel of these calls, exported with these options.
function(registers name most statements)
    answers(0 "" export ${SOURCE}/tables/hazy.vndf --language cuda --buffer hazy.f32 --distribution table --lobes 2
        ${ARGN} -o ${name}.cuh)
    file(WRITE ${OUT}/${name}.cu "#include \"${name}.cuh\"
__global__ void draw(const float *numbers, const float *in, float *out)
{
    int i = 16 * (int)(blockIdx.x * blockDim.x + threadIdx.x);
    float3 wi = make_float3(in[i], in[i + 1], in[i + 2]);
    vndf_surface surface = vndf_surface_of(VNDF_HAZY, in[i + 3], in[i + 4]);
    ${statements}
    out[i] = w.x;
    out[i + 1] = w.y;
    out[i + 2] = w.z;
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

registers(one 64 "vndf_view view = vndf_view_of(numbers, surface, wi);
    vndf_sampled s = vndf_sample(numbers, view, in[i + 5], in[i + 6]);
    float3 w = s.wm;" --only view,sample)
registers(two 255 "vndf_mixture m = {2, {surface, vndf_surface_of(VNDF_HAZY, in[i + 7], in[i + 8])},
        {in[i + 9], in[i + 10]}};
    vndf_mixture_view view = vndf_mixture_view_of(numbers, m, wi);
    vndf_mixed s = vndf_mixture_sample(numbers, view, in[i + 5], in[i + 6]);
    float3 w = s.wm;" --only mixture)
registers(glass 255 "vndf_material glass = {surface, 1.5f};
    vndf_bsdf hit = vndf_bsdf_of(numbers, glass, wi);
    vndf_scattered s = vndf_bsdf_sample(numbers, hit, make_float3(in[i + 5], in[i + 6], in[i + 7]));
    float3 w = s.wo;" --bsdf "lobes=both fresnel=dielectric")

if(failures)
    message(FATAL_ERROR "${failures} failures")
endif()
