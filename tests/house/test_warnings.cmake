# Clang, or where it is not here the compiler of the build, warns of nothing in the library, the program and the tests
# where it does not optimise: it then has macros in place of functions, of which it says other things than of those
# that everyone compiles. It reads all sources, without making code. Each public header compiles alone, and twice in a
# row, as C99, C11 and C++11.
cmake_minimum_required(VERSION 3.16)

if(NOT WARNINGS)
    message("SKIPPED: ${C_COMPILER} has warnings of its own")
    return()
endif()
separate_arguments(warnings UNIX_COMMAND "${WARNINGS}")
separate_arguments(arithmetic UNIX_COMMAND "${ARITHMETIC}")
find_program(CLANG clang)
if(CLANG)
    set(C_COMPILER ${CLANG})
endif()

# warn_not(WHAT SOURCES [FLAG...])
function(warn_not what sources)
    execute_process(COMMAND ${C_COMPILER} -std=c11 -O0 -fsyntax-only -Werror ${warnings} ${ARGN} -I${SOURCE}/include
            -I${SOURCE}/src -I${SOURCE}/tools -I${SOURCE}/tests -I${BUILD}/exported ${sources}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT status EQUAL 0 OR NOT sources)
        message(SEND_ERROR "${what}, by ${C_COMPILER}:\n${output}")
    endif()
endfunction()

file(GLOB_RECURSE library ${SOURCE}/src/*.c)
file(GLOB_RECURSE program ${SOURCE}/tools/*.c)
file(GLOB_RECURSE tests ${SOURCE}/tests/*.c)
list(FILTER program EXCLUDE REGEX "/caps_avx[0-9]+\\.c$") # not without their instructions
list(FILTER tests EXCLUDE REGEX "/export/answer\\.c$") # not without a kernel
warn_not("the library" "${library}" ${arithmetic})
warn_not("the program" "${program}")
warn_not("the tests" "${tests}" -I${BUILD}/tests/scratch/examples -DVNDF_SOURCE_DIR="" -DVNDF_PROGRAM=""
    -DVNDF_JUDGED="" -DVNDF_FAILING_MALLOC="" -DTABLES="")

file(GLOB headers ${SOURCE}/include/*.h)
set(languages c99 c11)
if(CLANG OR CXX_COMPILER)
    list(APPEND languages c++11)
endif()
file(WRITE ${OUT}/empty "")
foreach(standard IN LISTS languages)
    string(REGEX REPLACE "[0-9]" "" language ${standard})
    foreach(header IN LISTS headers)
        execute_process(COMMAND ${C_COMPILER} -x ${language} -std=${standard} -fsyntax-only -Wall -Wextra -Wpedantic
                -Wshadow -Wconversion -Werror -I${SOURCE}/include -include ${header} -include ${header} ${OUT}/empty
            RESULT_VARIABLE status ERROR_VARIABLE output)
        if(NOT status EQUAL 0)
            message(SEND_ERROR "${header} does not compile alone as ${standard}:\n${output}")
        endif()
    endforeach()
endforeach()
