# The exported C is C99 and the exported C++ is C++11, for every compiler of both that is here: no warning with
# -Wall -Wextra -Wpedantic -Wshadow -Wconversion; answers are the library's, bit for bit, and near them with
# -ffast-math, as renderers compile. Each program has two kernels, with prefixes of their own: normals, whose numbers
# it embeds and whose file it includes twice, and a BSDF, which reads its numbers and scatters as the library does.
cmake_minimum_required(VERSION 3.16)

if(SANITIZE)
    message("SKIPPED: the programs would be compiled without sanitizers (${SANITIZE})")
    return()
endif()
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
set(flags -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -ffp-contract=off -I${OUT})
set(tables ${SOURCE}/tables/student-t-2.5-small.vndf ${SOURCE}/tables/hazy.vndf tails.vndfs)
set(standard_c -x c -std=c99)
set(standard_cpp -x c++ -std=c++11)

function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors
        WORKING_DIRECTORY ${OUT})
    if(NOT status EQUAL 0)
        message(SEND_ERROR "${what} failed (${status}):\n${output}${errors}")
    endif()
endfunction()

# kernel(LANGUAGE PREFIX WHAT [--buffer FILE]): the file PREFIX.h with what it is asked, PREFIX_ask.h and questions.
function(kernel language prefix what)
    set(form embedded)
    if(ARGN)
        set(form fetching)
    endif()
    if(NOT what STREQUAL normals)
        list(APPEND ARGN --bsdf "${what}")
    endif()
    run("export of ${what}" ${VNDF} export ${tables} --language ${language} --prefix ${prefix} ${ARGN} -o ${prefix}.h)
    execute_process(COMMAND ${AGREEMENT} ask "${what}" ${language} ${prefix} ${form}
        INPUT_FILE ${SOURCE}/tests/export/ask.h OUTPUT_FILE ${OUT}/${prefix}_ask.h)
    run("questions of ${what}" ${AGREEMENT} make "${what}" 8000 ${prefix}.asked ${tables})
endfunction()

# try(COMPILER LANGUAGE HOW BSDF FLAG...): HOW and BSDF are vndf_agreement's.
function(try compiler language how bsdf)
    unset(found CACHE)
    find_program(found ${compiler})
    if(NOT found)
        return()
    endif()
    kernel(${language} normals normals)
    kernel(${language} bsdf "${bsdf}" --buffer numbers.f32)
    run("${compiler} of ${language}" ${found} ${ARGN} ${standard_${language}} ${flags}
        ${SOURCE}/tests/export/answer.c -lm -o answer)
    run("the program of ${compiler}" ${OUT}/answer)
    run("normals by ${compiler}" ${AGREEMENT} check normals ${how} normals.asked normals.said ${tables})
    run("${bsdf} by ${compiler}" ${AGREEMENT} check "${bsdf}" ROUNDED bsdf.asked bsdf.said ${tables})
    string(REPLACE ";" " " how "${compiler} ${ARGN}")
    set_property(GLOBAL APPEND_STRING PROPERTY tried " ${how},")
endfunction()

run("a family" ${VNDF} build --family student-t --parameter 1.6..6 --knots 3 --max-bytes 2048 -q -o tails.vndfs)

# Optimised once in each language, since a compiler does not know by which of its names it is called.
try(gcc c BITS "lobes=both fresnel=dielectric" -O1)
try(clang c BITS "lobes=transmission masking=none" -O0)
try(g++ cpp BITS "lobes=both fresnel=schlick masking=v-cavities transport=importance" -O0)
try(clang++ cpp BITS "fresnel=conductor masking=separable reflection=retro" -O1)
try(gcc c FAST "lobes=reflection" -O3 -ffast-math)
get_property(tried GLOBAL PROPERTY tried)
if(NOT tried)
    message("SKIPPED: neither gcc nor clang is here")
endif()
message("compiled by${tried}")
