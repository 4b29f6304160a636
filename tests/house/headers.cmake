# Each public header compiles alone, and twice in a row, in the language STANDARD without a warning.
cmake_minimum_required(VERSION 3.16)

if(STANDARD MATCHES "^c\\+\\+")
    set(compiler "${CXX_COMPILER}")
    set(extension cpp)
else()
    set(compiler "${C_COMPILER}")
    set(extension c)
endif()
if(NOT compiler)
    message("SKIPPED: no C++ compiler was found")
    return()
endif()

file(GLOB headers RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h)
if(NOT headers)
    message(FATAL_ERROR "no headers in ${SOURCE}/include")
endif()
file(MAKE_DIRECTORY ${OUT})
foreach(header IN LISTS headers)
    set(unit ${OUT}/${header}.${extension})
    file(WRITE ${unit} "#include \"${header}\"\n#include \"${header}\"\n")
    execute_process(
        COMMAND ${compiler} -std=${STANDARD} -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
            -I${SOURCE}/include -c ${unit} -o ${unit}.o
        RESULT_VARIABLE status ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(SEND_ERROR "include/${header} does not compile alone as ${STANDARD}:\n${errors}")
    endif()
    message("${header}: ${STANDARD}")
endforeach()
