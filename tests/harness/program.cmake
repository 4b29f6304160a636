# What scripts that run the program share: run, has, expect, answers, split; `failures` counts, OUT is a fresh folder.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
set(failures 0)

# run(STATUS WORDS...): the program, run in OUT with the words of `command_words` first and ${input} as stdin, ends with
# this status; what it printed is in `output` and `errors`.
set(command_words "")
set(input "")
macro(run expected)
    file(WRITE ${OUT}/stdin.txt "${input}")
    execute_process(COMMAND ${VNDF} ${command_words} ${ARGN} WORKING_DIRECTORY ${OUT} INPUT_FILE ${OUT}/stdin.txt
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    file(REMOVE ${OUT}/stdin.txt)
    set(input "")
    if(NOT status STREQUAL "${expected}")
        math(EXPR failures "${failures} + 1")
        message("FAILED: vndf ${command_words} ${ARGN}\nstatus ${status}, expected ${expected}\n${output}${errors}")
    endif()
endmacro()

# has(VARIABLE text): the text that a run printed contains this. An argument of a macro named as the variable that is
# given, text say, would be compared with itself.
macro(has has_variable has_text)
    string(FIND "${${has_variable}}" "${has_text}" place)
    if(place EQUAL -1)
        math(EXPR failures "${failures} + 1")
        message("FAILED: ${has_variable} has no '${has_text}':\n${${has_variable}}")
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
