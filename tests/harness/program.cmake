# What scripts that run the program share: run, has, expect, answers. What fails is told, and the script goes on,
# to end with a failure; OUT is a fresh folder.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})

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
        message(SEND_ERROR "vndf ${command_words} ${ARGN}\nstatus ${status}, not ${expected}:\n${output}${errors}")
    endif()
endmacro()

# has(VARIABLE text): the text that a run printed contains this. An argument of a macro named as the variable that is
# given, text say, would be compared with itself.
macro(has has_variable has_text)
    string(FIND "${${has_variable}}" "${has_text}" place)
    if(place EQUAL -1)
        message(SEND_ERROR "${has_variable} has no '${has_text}':\n${${has_variable}}")
    endif()
endmacro()

macro(expect what)
    if(NOT (${ARGN}))
        message(SEND_ERROR "FAILED: ${what}")
    endif()
endmacro()

# answers(STATUS TEXT WORDS...): the program, run in OUT, ends with this status and prints this text somewhere.
function(answers expected text)
    set(command_words "")
    run(${expected} ${ARGN})
    set(printed "${output}${errors}")
    has(printed "${text}")
endfunction()
