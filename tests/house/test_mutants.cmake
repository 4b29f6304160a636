# A test of the tests: each defect of tests/house/mutants.txt, planted in a copy of the sources, makes the test fail
# that is named for it; without a defect that test passes. A defect that survives is a gap in the suite. A text
# that is no longer found exactly once is an error too: the list has to follow the sources.
#
# The copy is configured once with -O1; a defect costs what depends on its file, and one test. Planted are those
# that are marked `always`; with ALL, all of them.
cmake_minimum_required(VERSION 3.16)

file(READ ${SOURCE}/tests/house/mutants.txt text)
# What separates and groups items of CMake's lists, out of the way.
string(REPLACE ";" "<semicolon>" text "${text}")
string(REPLACE "[" "<open>" text "${text}")
string(REPLACE "]" "<close>" text "${text}")
string(REPLACE "\n\n" ";" blocks "${text}")
list(POP_FRONT blocks preface)

function(unescape text result)
    string(REPLACE "<semicolon>" ";" text "${text}")
    string(REPLACE "<open>" "[" text "${text}")
    string(REPLACE "<close>" "]" text "${text}")
    set(${result} "${text}" PARENT_SCOPE)
endfunction()

# member(BLOCK NAME RESULT): what stands on the line "NAME: ...".
function(member block name result)
    if(NOT "\n${block}\n" MATCHES "\n${name}: ([^\n]+)\n")
        message(FATAL_ERROR "tests/house/mutants.txt: no '${name}:' in\n${block}")
    endif()
    set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

set(chosen "")
set(checks "")
foreach(block IN LISTS blocks)
    member("${block}" fails check)
    if(ALL OR "\n${block}\n" MATCHES "\nalways\n")
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

# "walk_eval 0" is the program test_walk_eval with the argument 0.
function(build_checks)
    list(TRANSFORM ARGN REPLACE "^([^ ]+).*$" "test_\\1" OUTPUT_VARIABLE targets)
    list(REMOVE_DUPLICATES targets)
    execute_process(COMMAND ${CMAKE_COMMAND} --build ${copy}/build --target ${targets} --parallel 2
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    set(status "${status}" PARENT_SCOPE)
    set(output "${output}" PARENT_SCOPE)
endfunction()

function(run_check check result)
    separate_arguments(words UNIX_COMMAND "${check}")
    list(POP_FRONT words name)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env VNDF_TEST_QUICK=1 ${copy}/build/tests/test_${name} ${words}
        WORKING_DIRECTORY ${OUT} TIMEOUT 120
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    set(${result} "${status}" PARENT_SCOPE)
    set(output "${output}" PARENT_SCOPE)
endfunction()

# A test that cannot run on this machine says so, and its defects are not planted.
set(skipped "")
build_checks(${checks})
if(NOT status EQUAL 0)
    message(FATAL_ERROR "the copy cannot be built:\n${output}")
endif()
foreach(check IN LISTS checks)
    run_check("${check}" status)
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
    member("${block}" defect defect)
    member("${block}" file file)
    member("${block}" old old)
    member("${block}" new new)
    member("${block}" fails check)
    unescape("${old}" old)
    unescape("${new}" new)
    file(READ ${SOURCE}/${file} sound)
    string(FIND "${sound}" "${old}" first)
    string(FIND "${sound}" "${old}" last REVERSE)
    if(first EQUAL -1 OR NOT first EQUAL last)
        message(SEND_ERROR "tests/house/mutants.txt: '${defect}' does not find exactly once in ${file}:\n  ${old}")
        continue()
    endif()
    if("${check}" IN_LIST skipped)
        continue()
    endif()
    string(REPLACE "${old}" "${new}" unsound "${sound}")
    file(WRITE ${copy}/${file} "${unsound}")
    build_checks("${check}")
    file(WRITE ${copy}/${file} "${sound}")
    if(NOT status EQUAL 0)
        message(SEND_ERROR "with '${defect}' the copy cannot be built:\n${output}")
        continue()
    endif()
    string(TIMESTAMP begin "%s")
    run_check("${check}" status)
    string(TIMESTAMP end "%s")
    math(EXPR seconds "${end} - ${begin}")
    if(status EQUAL 0)
        message(SEND_ERROR "survives: ${defect}; '${check}' passes, where it has to fail")
    else()
        message("noticed by ${check} (${seconds} s): ${defect}")
    endif()
endforeach()
