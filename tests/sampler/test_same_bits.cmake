# The run time gives the same bits whatever compiled it and wherever it runs: the library of this build, gcc and clang
# at -O0 and -O3 -march=native, 32-bit x86 with SSE2, and the machines below through qemu, where they are here; all are
# compared with tests/corpus/same_bits.txt, so that machines that never met are compared too, and README.md names the
# sum of these hashes. Without LONG
# (more_same_bits) it is the library, -O0 and -O3 of a compiler that did not build it, and one machine through qemu.
#
# After a change of arithmetic or of tables on purpose:  cmake --build build --target same_bits
# runs this with -DRENEW=ON and writes the file and the number of README.md anew, if all builds agree.
cmake_minimum_required(VERSION 3.16)

set(expected_file ${SOURCE}/tests/corpus/same_bits.txt)
set(machines s390x-linux-gnu aarch64-linux-gnu arm-linux-gnueabihf riscv64-linux-gnu) # the first is big-endian
set(few 20000)
set(many ${few})
if(RENEW OR (LONG AND "$ENV{VNDF_TEST_QUICK}" STREQUAL ""))
    set(LONG ON)
    set(many 1000000)
endif()

file(GLOB tables ${SOURCE}/tables/*.vndf)
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

# run(NAME COUNT EMULATOR SOURCES COMPILER FLAG...): EMULATOR may be empty. Says `found`, if programs of this compiler
# run here.
function(run who count emulator parts)
    file(WRITE ${OUT}/probe.c "#include <math.h>\n#include <stdio.h>\nint main(int n, char **a) { return a[0] && "
        "sqrt((double)n) == 1.0 ? 0 : 1; }\n")
    execute_process(COMMAND ${ARGN} ${OUT}/probe.c -o ${OUT}/probe -lm RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    if(status EQUAL 0)
        execute_process(COMMAND ${emulator} ${OUT}/probe RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    endif()
    string(COMPARE EQUAL "${status}" "0" found)
    set(found ${found} PARENT_SCOPE)
    if(NOT found)
        message("not here: ${who}")
        return()
    endif()
    execute_process(COMMAND ${ARGN} ${flags} ${parts} -o ${OUT}/same_bits -lm
        RESULT_VARIABLE status ERROR_VARIABLE output)
    if(status EQUAL 0)
        execute_process(COMMAND ${emulator} ${OUT}/same_bits ${count} ${tables}
            RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    endif()
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${who} cannot build or run the run time:\n${output}${errors}")
    endif()
    string(REGEX MATCHALL "[0-9a-f]+ [0-9]+ [^\n]+" lines "${output}") # HASH COUNT NAME
    list(LENGTH lines found)
    list(LENGTH tables least)
    if(found LESS_EQUAL least)
        message(SEND_ERROR "${who} has too few hashes:\n${output}")
    endif()
    if(NOT expected) # to renew them: of the first build
        set(expected "${lines}" PARENT_SCOPE)
    endif()
    foreach(line IN LISTS lines)
        if(expected AND NOT line IN_LIST expected)
            message(SEND_ERROR "${who} gives another hash: ${line}. If arithmetic or tables were changed on purpose: "
                "cmake --build build --target same_bits")
        endif()
    endforeach()
    message("same bits: ${who}, ${count} samples of each distribution")
endfunction()

set(expected "")
set(first ${many}) # all hashes that there are
if(NOT RENEW)
    file(STRINGS ${expected_file} expected)
    set(first ${few})
endif()

# ---- this machine -------------------------------------------------------------------------------

if(SANITIZE STREQUAL "")
    run("the library of this build" ${first} "" "${program};${STATIC_LIBRARY}" ${C_COMPILER} -O2)
endif()
get_filename_component(compilers ${C_COMPILER} REALPATH) # cc and gcc may be one
foreach(name gcc clang)
    find_program(found_${name} ${name})
    if(found_${name})
        get_filename_component(compiler ${found_${name}} REALPATH)
        list(APPEND compilers ${compiler})
    endif()
endforeach()
list(REMOVE_DUPLICATES compilers)
if(NOT LONG)
    list(POP_BACK compilers compilers) # another than the one of this build, if there is one
endif()
foreach(compiler IN LISTS compilers)
    run("${compiler} -O0" ${few} "" "${sources}" ${compiler} -O0)
    run("${compiler} -O3 -march=native" ${many} "" "${sources}" ${compiler} -O3 -march=native)
endforeach()

# ---- others -------------------------------------------------------------------------------------

if(LONG) # distributions that have compilers for other machines too keep the kernel's headers apart
    run("gcc -m32" ${few} "" "${sources}" gcc -m32 -msse2 -mfpmath=sse -O2 -idirafter /usr/include/x86_64-linux-gnu)
endif()
foreach(machine IN LISTS machines)
    string(REGEX MATCH "^[^-]+" processor ${machine})
    find_program(emulator_${processor} NAMES qemu-${processor} qemu-${processor}-static)
    if(emulator_${processor})
        # In ISO mode gcc for s390x keeps floats as doubles, which the sources refuse, unless it is told not to.
        run("${machine}-gcc -O2" ${few} ${emulator_${processor}} "${sources}" ${machine}-gcc -static -O2
            -fexcess-precision=fast)
        if(found AND NOT LONG)
            break()
        endif()
    endif()
endforeach()

file(READ ${SOURCE}/README.md readme)
string(REGEX MATCH "([0-9a-f]+) ${few} all" sum "${expected}")
if(RENEW)
    list(JOIN expected "\n" text)
    file(WRITE ${expected_file} "${text}\n")
    string(REGEX REPLACE "[0-9a-f]+ ${few} all" "${sum}" readme "${readme}")
    file(WRITE ${SOURCE}/README.md "${readme}")
endif()
string(FIND "${readme}" "`${sum}`" found)
if(sum STREQUAL "" OR found EQUAL -1)
    message(SEND_ERROR "README.md has not the sum of the hashes, ${sum}")
endif()
