# What scripts that run the program share: has, expect, split; `failures` counts, OUT is a fresh folder.
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

# Lines of a text, with what would change how CMake splits it replaced.
macro(split text lines)
    string(REGEX REPLACE "[][;\\]" " " clean "${text}")
    string(REGEX REPLACE "\n$" "" clean "${clean}")
    string(REPLACE "\n" ";" ${lines} "${clean}")
endmacro()
