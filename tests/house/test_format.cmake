# The code is as .clang-format has it. Versions of clang-format differ, so the one that the code was formatted with
# is asked for.
cmake_minimum_required(VERSION 3.16)

set(version 14)
find_program(CLANG_FORMAT NAMES clang-format-${version} clang-format)
set(found "")
if(CLANG_FORMAT)
    execute_process(COMMAND ${CLANG_FORMAT} --version OUTPUT_VARIABLE found)
endif()
if(NOT found MATCHES "version ${version}\\.")
    message("SKIPPED: no clang-format ${version} here")
    return()
endif()

file(GLOB_RECURSE files ${SOURCE}/include/*.h ${SOURCE}/src/*.[ch] ${SOURCE}/tools/*.[ch] ${SOURCE}/tests/*.[ch]
    ${SOURCE}/include/*.hpp ${SOURCE}/tools/*.hpp ${SOURCE}/tests/*.cpp)
if(NOT files)
    message(FATAL_ERROR "no sources under ${SOURCE}")
endif()
execute_process(COMMAND ${CLANG_FORMAT} --dry-run --Werror ${files} RESULT_VARIABLE status ERROR_VARIABLE output)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "not as .clang-format has it; clang-format -i FILE mends it:\n${output}")
endif()
