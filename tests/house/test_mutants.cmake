# A test of the tests: each defect of tests/house/mutants.txt, planted in a copy of the sources, makes the test fail
# that is named for it; without a defect that test passes. A defect that survives is a gap in the suite. A text
# that is no longer found exactly once is an error too: the list has to follow the sources.
#
# The copy is configured once with -O1; a defect costs what depends on its file, and one test. Planted are those
# that are marked `(always)`; with ALL, all of them.
cmake_minimum_required(VERSION 3.16)

file(READ ${SOURCE}/tests/house/mutants.txt text)
# What separates and groups items of CMake's lists, out of the way.
string(REPLACE ";" "<semicolon>" text "${text}")
string(REPLACE "[" "<open>" text "${text}")
string(REPLACE "]" "<close>" text "${text}")
string(REGEX REPLACE "\n$" "" text "${text}")
string(REPLACE "\n\n" ";" blocks "${text}")
list(POP_FRONT blocks preface)

function(unescape text result)
    string(REPLACE "<semicolon>" ";" text "${text}")
    string(REPLACE "<open>" "[" text "${text}")
    string(REPLACE "<close>" "]" text "${text}")
    set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Sets check, always, defect, file, old and new of ${block}.
macro(read_block)
    if(NOT "${block}" MATCHES "^([^\n:(]+)( \\(always\\))?: ([^\n]+)\n([^\n]+)\n- ([^\n]+)\n\\+ ([^\n]+)$")
        message(FATAL_ERROR "tests/house/mutants.txt: this is no defect:\n${block}")
    endif()
    set(check "${CMAKE_MATCH_1}")
    set(always "${CMAKE_MATCH_2}")
    set(defect "${CMAKE_MATCH_3}")
    set(file "${CMAKE_MATCH_4}")
    set(old_text "${CMAKE_MATCH_5}")
    set(new_text "${CMAKE_MATCH_6}")
    unescape("${old_text}" old)
    unescape("${new_text}" new)
endmacro()

set(chosen "")
set(checks "")
foreach(block IN LISTS blocks)
    read_block()
    file(READ ${SOURCE}/${file} sound)
    string(FIND "${sound}" "${old}" first)
    string(FIND "${sound}" "${old}" last REVERSE)
    if(first EQUAL -1 OR NOT first EQUAL last)
        message(SEND_ERROR "tests/house/mutants.txt: '${defect}' does not find exactly once in ${file}:\n  ${old}")
    elseif(ALL OR always)
        list(APPEND chosen "${block}")
        list(APPEND checks "${check}")
    endif()
endforeach()
list(REMOVE_DUPLICATES checks)
list(LENGTH chosen count)
if(count LESS 5)
    message(FATAL_ERROR "tests/house/mutants.txt: ${count} defects are read")
endif()

# ---- the copy -----------------------------------------------------------------------------------

set(copy ${OUT}/copy)
file(REMOVE_RECURSE ${copy})
foreach(part CMakeLists.txt src include tools tests tables)
    file(COPY ${SOURCE}/${part} DESTINATION ${copy})
endforeach()
execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${copy} -B ${copy}/build -G ${GENERATOR} -DCMAKE_C_COMPILER=${C_COMPILER}
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O1
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "the copy cannot be configured:\n${output}")
endif()

# "walk 0" is the program test_walk with the argument 0.
macro(build_checks)
    list(TRANSFORM ${ARGV0} REPLACE "^([^ ]+).*$" "test_\\1" OUTPUT_VARIABLE targets)
    list(REMOVE_DUPLICATES targets)
    execute_process(COMMAND ${CMAKE_COMMAND} --build ${copy}/build --target ${targets} --parallel 2
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
endmacro()

macro(run_check)
    separate_arguments(words UNIX_COMMAND "${check}")
    list(POP_FRONT words name)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env VNDF_TEST_QUICK=1 ${copy}/build/tests/test_${name} ${words}
        WORKING_DIRECTORY ${OUT} TIMEOUT 120
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
endmacro()

# A test that cannot run on this machine says so, and its defects are not planted.
set(skipped "")
build_checks(checks)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "the copy cannot be built:\n${output}")
endif()
foreach(check IN LISTS checks)
    run_check()
    if(NOT status EQUAL 0)
        message(SEND_ERROR "without a defect '${check}' fails:\n${output}")
        list(APPEND skipped "${check}")
    elseif(output MATCHES "SKIPPED: [^\n]*")
        message("not planted are the defects for ${check}: ${CMAKE_MATCH_0}")
        list(APPEND skipped "${check}")
    endif()
endforeach()

# ---- one defect at a time -----------------------------------------------------------------------

foreach(block IN LISTS chosen)
    read_block()
    if("${check}" IN_LIST skipped)
        continue()
    endif()
    file(READ ${SOURCE}/${file} sound)
    string(REPLACE "${old}" "${new}" unsound "${sound}")
    file(WRITE ${copy}/${file} "${unsound}")
    build_checks(check)
    file(WRITE ${copy}/${file} "${sound}")
    if(NOT status EQUAL 0)
        message(SEND_ERROR "with '${defect}' the copy cannot be built:\n${output}")
        continue()
    endif()
    string(TIMESTAMP begin "%s")
    run_check()
    string(TIMESTAMP end "%s")
    math(EXPR seconds "${end} - ${begin}")
    if(status EQUAL 0)
        message(SEND_ERROR "survives: ${defect}; '${check}' passes, where it has to fail")
    else()
        message("noticed by ${check} (${seconds} s): ${defect}")
    endif()
endforeach()
