# For a GPU of NVIDIA a view and a sample of a table take at most 64 registers, and neither they nor a mixture of two
# tables nor a BSDF have local memory, which an index by a variable makes: the commands at the head of
# tools/export/examples/gpu.cu compile it. Where a GPU is, it runs, and no sample is bad.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)
find_program(nvcc NAMES nvcc PATHS /usr/local/cuda/bin)
if(NOT nvcc)
    message("SKIPPED: no nvcc")
    return()
endif()

set(folder ${SOURCE}/tools/export/examples)
set(architecture -arch=sm_80)
if(EXISTS /dev/nvidia0)
    set(architecture -arch=native)
endif()
file(READ ${folder}/gpu.cu text)
string(REGEX MATCHALL "\n \\*     [^\n]*" commands "${text}")
string(REPLACE ";" "" commands "${commands}")
string(REPLACE "\n *     " "\n" commands "${commands}")
string(REPLACE "nvcc -O3 -arch=native -I. gpu.cu" "${nvcc} -O3 ${architecture} -Xptxas -v -I. ${folder}/gpu.cu" commands
    "${commands}")
string(REPLACE "./gpu " "[ ! -e /dev/nvidia0 ] || ./gpu " commands "${commands}")
execute_process(COMMAND sh -ec "vndf() { ${VNDF} \"$@\"; }; TABLES=${SOURCE}/tables; ${commands}"
    WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
expect("the commands of gpu.cu fail:\n${output}${errors}" status EQUAL 0)
string(REGEX REPLACE "\nGGX, caps by hand[^\n]*" "" output "${output}")
expect("a sample was bad:\n${output}" NOT output MATCHES " [1-9][0-9]*\n")

string(REGEX MATCHALL "run[^\n]*\n *[0-9]+ bytes stack[^\n]*\n[^\n]*Used [0-9]+" kernels "${errors}")
list(LENGTH kernels count)
expect("${count} kernels:\n${errors}" count EQUAL 9)
foreach(kernel IN LISTS kernels)
    string(REGEX MATCH "^run[0-9I]*([a-z_]*).* ([0-9]+) bytes stack frame, ([0-9]+) bytes spill.*Used ([0-9]+)" all
        "${kernel}")
    set(name ${CMAKE_MATCH_1})
    set(used ${CMAKE_MATCH_4})
    math(EXPR memory "${CMAKE_MATCH_2} + ${CMAKE_MATCH_3}")
    set(most 255)
    if(name MATCHES "normals|embedded")
        set(most 64)
    endif()
    message("${name}: ${used} registers")
    expect("${name} has local memory:\n${kernel}" memory EQUAL 0)
    expect("${name} takes ${used} registers, more than ${most}" used LESS_EQUAL most)
endforeach()
