# The manual page and the completion hold every command and every option of its help, and no others; troff and the
# shells that are here read them without a complaint, and bash completes what stands in them.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

# run(STATUS words...): `vndf words...` ends with the exit status; leaves `output` and `errors`.
macro(run expected)
    execute_process(COMMAND ${VNDF} ${ARGN} WORKING_DIRECTORY ${OUT}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    expect("vndf ${ARGN}: exit status ${status}, expected ${expected}\n${errors}" status STREQUAL "${expected}")
endmacro()

# holds(VARIABLE TEXT): as `has`, which would lose backslashes.
function(holds variable text)
    string(FIND "${${variable}}" "${text}" place)
    if(place EQUAL -1)
        math(EXPR failures "${failures} + 1")
        set(failures ${failures} PARENT_SCOPE)
        message("FAILED: ${variable} has no '${text}'")
    endif()
endfunction()

# ---- help ---------------------------------------------------------------------------------------

run(0 --help)
set(head "${output}")
run(0 help)
expect("vndf help is not vndf --help" output STREQUAL head)
run(0 build --help)
set(build "${output}")
run(0 help build)
expect("vndf help build is not vndf build --help" output STREQUAL build)
run(0 help bench effects)
has(output "usage: vndf bench effects")
run(2 help bulid)
has(errors "there is no command 'bulid'")
has(errors "did you mean 'build'?")
run(2 help build sample)
run(2 help build --man)
run(2 help -o manual)
run(2 help --completion csh)
has(errors "'csh' is not bash")
run(0 help --man -o vndf.1)
run(0 help --man)
file(READ ${OUT}/vndf.1 man)
expect("--man differs by -o" output STREQUAL man)
run(0 help --completion bash -o completion.bash)
file(READ ${OUT}/completion.bash bash)

# ---- every command, every option ----------------------------------------------------------------

# What bash completes for each command is its table of options; its help has an item for each, and no other item that
# looks like an option.
string(REGEX MATCHALL "\n  [a-z]+ " commands "${head}")
string(REGEX REPLACE "[ \n]" "" commands "${commands}")
list(LENGTH commands count)
expect("vndf --help lists ${count} commands" count GREATER 12)
foreach(command IN LISTS commands ITEMS "bench effects")
    separate_arguments(words UNIX_COMMAND "${command}")
    run(0 ${words} --help)
    set(help "${output}")
    string(TOUPPER "vndf ${command}" heading)
    holds(man "\n.SH \"${heading}\"\n")
    set(options "")
    if(bash MATCHES "'${command} '\\) [^\n]* options='([^\n']*)'")
        separate_arguments(options UNIX_COMMAND "${CMAKE_MATCH_1}")
    endif()
    expect("bash does not know the options of ${command}" options)
    foreach(option IN LISTS options)
        if(option STREQUAL "--help")
            continue()
        endif()
        if(NOT help MATCHES "\n  ([^\n]*[ ,])?${option}[ \n,]")
            math(EXPR failures "${failures} + 1")
            message("FAILED: ${option} has no item in the help of ${command}")
        endif()
        string(REPLACE "-" "\\-" troff "${option}")
        holds(man "${troff}")
    endforeach()
    string(REGEX MATCHALL "\n  (-[-a-z0-9]+)" items "${help}")
    string(REGEX REPLACE "[ \n]" "" items "${items}")
    foreach(item IN LISTS items)
        expect("the help of ${command} has ${item}, its table of options has not" item IN_LIST options)
    endforeach()
endforeach()

# ---- who reads them -----------------------------------------------------------------------------

# read(PROGRAM words...): says nothing on stderr, if it is here.
function(read program)
    find_program(${program}_found ${program})
    if(NOT ${program}_found)
        message("without ${program}")
        return()
    endif()
    execute_process(COMMAND ${${program}_found} ${ARGN} WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status
        OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status STREQUAL "0" OR NOT errors STREQUAL "")
        math(EXPR failures "${failures} + 1")
        message("FAILED: ${program}: ${status}\n${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
    set(found ON PARENT_SCOPE)
    set(failures ${failures} PARENT_SCOPE)
endfunction()

read(groff -man -ww -Tascii -P-cbou vndf.1)
if(found)
    holds(output "VNDF BUILD")
    holds(output "exp(-k*r)*(1+0.8*cos(6*r))")
endif()
read(man -l vndf.1)

file(WRITE ${OUT}/ask.bash "source ./completion.bash
ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _vndf; printf '%s,' \"\${COMPREPLY[@]}\"; echo; }
ask vndf bui
ask vndf build --mom
ask vndf build --moments ''
ask vndf build --ndf ''
ask vndf export --language gl
ask vndf sample 'a ta'
ask vndf sample gg
ask vndf bench eff
ask vndf bench effects --the
ask vndf bench --the
ask vndf help alb
")
file(WRITE "${OUT}/a table.vndf" "")
set(found OFF)
read(bash ask.bash)
if(found)
    expect("bash completes\n${output}" output STREQUAL
        "build,\n--moments,\n2,3,4,\n,\nglsl,\na table.vndf,\nggx,\neffects,\n--theta,\n,\nalbedo,\n")
endif()
if(failures)
    message(FATAL_ERROR "${failures} failures")
endif()
