# What scripts that run the program share: has, expect, answers, split; `failures` counts, OUT is a fresh folder.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
set(failures 0)

# has(VARIABLE text): the text that a run printed contains this.
macro(has variable text)
    string(FIND "${${variable}}" "${text}" place)
    if(place EQUAL -1)
        math(EXPR failures "${failures} + 1")
        message("FAILED: ${variable} has no '${text}':\n${${variable}}")
    endif()
endmacro()

macro(expect what)
    if(NOT (${ARGN}))
        math(EXPR failures "${failures} + 1")
        message("FAILED: ${what}")
    endif()
endmacro()

# answers(STATUS TEXT WORDS...): the program, run in OUT, ends with this status and prints this text somewhere.
function(answers status text)
    execute_process(COMMAND ${VNDF} ${ARGN} RESULT_VARIABLE got OUTPUT_VARIABLE out ERROR_VARIABLE err
        WORKING_DIRECTORY ${OUT})
    string(FIND "${out}${err}" "${text}" at)
    if(NOT got EQUAL ${status} OR at EQUAL -1)
        message(SEND_ERROR "vndf ${ARGN}: status ${got}, expected ${status} and '${text}' in:\n${out}${err}")
    endif()
endfunction()

# Lines of a text, with what would change how CMake splits it replaced.
macro(split text lines)
    string(REGEX REPLACE "[][;\\]" " " clean "${text}")
    string(REGEX REPLACE "\n$" "" clean "${clean}")
    string(REPLACE "\n" ";" ${lines} "${clean}")
endmacro()
