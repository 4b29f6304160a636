# The run time gives the same bits whatever compiled it and wherever it runs: gcc and clang, from no optimisation
# to everything that this machine's processor has, 32-bit x86 with SSE2, and the machines of `machines` below
# through qemu, all compared with tests/corpus/same_bits.txt, so that machines that never met are compared too.
# Only the rooms of the run time are compiled here, so they do not need the offline ones.
#
# LONG=ON (more_same_bits) does all of this: the optimised builds for this machine take 1e6 samples of every
# distribution, the slow ones - not optimised, emulated, or 32-bit - the first 2e4 of the same. Without it three of
# them take 2e4: the library as it was built here, a compiler that did not build it with all that the processor
# has, and one machine through qemu, big-endian if it can be. What cannot be built or
# run here is named on a line "not here: ...".
#
# After a change of arithmetic or of tables on purpose:  cmake --build build --target same_bits
# runs this with -DRENEW=ON and writes the file anew, if all builds agree.
cmake_minimum_required(VERSION 3.16)

set(expected_file ${SOURCE}/tests/corpus/same_bits.txt)
set(machines aarch64-linux-gnu arm-linux-gnueabihf riscv64-linux-gnu s390x-linux-gnu) # the last is big-endian
set(prefix 20000)
set(whole 1000000)
if(RENEW)
    set(LONG ON)
endif()
if(NOT LONG OR NOT "$ENV{VNDF_TEST_QUICK}" STREQUAL "")
    set(whole ${prefix})
endif()

file(GLOB tables ${SOURCE}/tables/*.vndf)
if(NOT tables)
    message(FATAL_ERROR "no tables in ${SOURCE}/tables")
endif()
set(program ${SOURCE}/tests/sampler/same_bits.c)
set(sources ${program})
foreach(room core math table sampler bsdf)
    file(GLOB_RECURSE room_sources ${SOURCE}/src/${room}/*.c)
    list(APPEND sources ${room_sources})
endforeach()
separate_arguments(arithmetic UNIX_COMMAND "${ARITHMETIC}")
set(flags -std=c11 ${arithmetic} -I${SOURCE}/src -I${SOURCE}/include -I${SOURCE}/tests)
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})

# ---- expected hashes ----------------------------------------------------------------------------

# Every line "HASH COUNT NAME" has to be the first one of its count and name: the file's, or without one (RENEW)
# the first build's.
function(compare_hashes who lines)
    string(REGEX REPLACE "\n" ";" lines "${lines}")
    foreach(line IN LISTS lines)
        if(line MATCHES "^([0-9a-f]+) ([0-9]+) (.+)$")
            get_property(known GLOBAL PROPERTY "hash of ${CMAKE_MATCH_2} ${CMAKE_MATCH_3}")
            if(NOT known AND NOT from_file)
                set_property(GLOBAL PROPERTY "hash of ${CMAKE_MATCH_2} ${CMAKE_MATCH_3}" ${CMAKE_MATCH_1})
                set_property(GLOBAL APPEND PROPERTY hash_lines "${line}")
            elseif(NOT known STREQUAL CMAKE_MATCH_1)
                message(SEND_ERROR "${who} gives ${CMAKE_MATCH_1} for ${CMAKE_MATCH_2} samples of "
                    "${CMAKE_MATCH_3}, expected '${known}'. If arithmetic or tables were changed on purpose: "
                    "cmake --build build --target same_bits")
            endif()
        endif()
    endforeach()
endfunction()

set(from_file OFF)
if(NOT RENEW)
    if(NOT EXISTS ${expected_file})
        message(FATAL_ERROR "${expected_file} is missing; cmake --build build --target same_bits writes it")
    endif()
    file(READ ${expected_file} expected)
    compare_hashes("${expected_file}" "${expected}")
    set(from_file ON)
endif()

# ---- one build ----------------------------------------------------------------------------------

# run_build(NAME COUNT EMULATOR COMPILER FLAG...): EMULATOR may be empty.
function(run_build who count emulator)
    run_sources("${who}" ${count} "${emulator}" "${sources}" ${ARGN})
endfunction()

# The same of SOURCES, which may end in a library.
function(run_sources who count emulator parts)
    string(TIMESTAMP begin "%s")
    execute_process(COMMAND ${ARGN} ${flags} ${parts} -o ${OUT}/same_bits -lm
        RESULT_VARIABLE status ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${who} cannot build the run time:\n${errors}")
    endif()
    execute_process(COMMAND ${emulator} ${OUT}/same_bits ${count} ${tables}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "built by ${who}, the program failed:\n${output}${errors}")
    endif()
    compare_hashes("${who}" "${output}")
    string(REGEX MATCHALL "[^\n]+" lines "${output}")
    list(LENGTH lines found)
    list(LENGTH tables least)
    if(found LESS_EQUAL least)
        message(SEND_ERROR "built by ${who}, the program printed too little:\n${output}")
    endif()
    string(TIMESTAMP end "%s")
    math(EXPR seconds "${end} - ${begin}")
    message("same bits: ${who}, ${count} samples of each distribution (${seconds} s)")
endfunction()

# Whether a program with the headers of the run time can be built and run; nothing here is ours, so nothing is
# judged.
function(can_run result emulator)
    file(WRITE ${OUT}/probe.c "#include <errno.h>\n#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n"
        "int main(int n, char **a) { return a[0] && errno == 0 && sqrt((double)n) == 1.0 ? 0 : 1; }\n")
    execute_process(COMMAND ${ARGN} ${OUT}/probe.c -o ${OUT}/probe -lm
        RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    if(status EQUAL 0)
        execute_process(COMMAND ${emulator} ${OUT}/probe RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    endif()
    set(${result} OFF PARENT_SCOPE)
    if(status EQUAL 0)
        set(${result} ON PARENT_SCOPE)
    endif()
endfunction()

# ---- this machine -------------------------------------------------------------------------------

get_filename_component(compilers ${C_COMPILER} REALPATH) # cc and gcc may be one
if(SANITIZE STREQUAL "")
    run_sources("the library of this build" ${prefix} "" "${program};${STATIC_LIBRARY}" ${C_COMPILER} -O2)
endif()
foreach(name gcc clang)
    find_program(found_${name} ${name})
    if(found_${name})
        get_filename_component(compiler ${found_${name}} REALPATH)
        list(APPEND compilers ${compiler})
    else()
        message("not here: ${name}")
    endif()
endforeach()
list(REMOVE_DUPLICATES compilers)
if(NOT LONG)
    list(POP_BACK compilers others) # another than the one of this build, if there is one
    set(compilers ${others})
endif()
foreach(compiler IN LISTS compilers)
    if(LONG)
        run_build("${compiler} -O2" ${whole} "" ${compiler} -O2)
        run_build("${compiler} -O0" ${prefix} "" ${compiler} -O0)
    endif()
    can_run(native "" ${compiler} -march=native)
    if(native)
        run_build("${compiler} -O3 -march=native" ${whole} "" ${compiler} -O3 -march=native)
    else()
        message("not here: ${compiler} -march=native")
    endif()
endforeach()

# ---- 32-bit x86, and the x87 --------------------------------------------------------------------

# Distributions that have compilers for other machines too keep the kernel's headers apart.
set(small gcc -m32 -msse2 -mfpmath=sse -idirafter /usr/include/x86_64-linux-gnu)
can_run(found "" ${small})
if(found AND LONG)
    run_build("gcc -m32 -msse2 -mfpmath=sse -O2" ${prefix} "" ${small} -O2)
elseif(NOT found)
    message("not here: gcc -m32 (Debian: gcc-multilib)")
endif()

can_run(found "" gcc -mfpmath=387)
if(found)
    execute_process(COMMAND gcc -mfpmath=387 ${flags} -fsyntax-only ${SOURCE}/src/sampler/analytic/ggx.c
        RESULT_VARIABLE status ERROR_VARIABLE errors)
    if(status EQUAL 0 OR NOT errors MATCHES "FLT_EVAL_METHOD 0")
        message(SEND_ERROR "floats with more digits than they have are to be refused; gcc -mfpmath=387 says:\n"
            "${errors}")
    endif()
    message("refused, as it must be: gcc -mfpmath=387")
else()
    message("not here: gcc -mfpmath=387")
endif()

# ---- other machines -----------------------------------------------------------------------------

if(NOT LONG)
    list(REVERSE machines)
endif()
foreach(machine IN LISTS machines)
    string(REGEX MATCH "^[^-]+" processor ${machine})
    find_program(emulator_${processor} NAMES qemu-${processor} qemu-${processor}-static)
    can_run(found "${emulator_${processor}}" ${machine}-gcc -static)
    if(found AND emulator_${processor})
        # In ISO mode gcc for s390x keeps floats as doubles, which the sources refuse, unless it is told not to.
        run_build("${machine}-gcc -O2" ${prefix} ${emulator_${processor}} ${machine}-gcc -static -O2
            -fexcess-precision=fast)
        if(NOT LONG)
            break()
        endif()
    else()
        message("not here: ${machine}-gcc with qemu-${processor}")
    endif()
endforeach()

# ---- renewal ------------------------------------------------------------------------------------

if(RENEW)
    get_property(lines GLOBAL PROPERTY hash_lines)
    list(JOIN lines "\n" text)
    file(WRITE ${expected_file} "${text}\n")
    message("${expected_file} is written")
endif()
