# The kernel that is exported to LANGUAGE, run by tools/export/run_kernel.py on what runs the language here, answers as
# the library does, with numbers embedded or read from a buffer that two tables share, and its samples follow the
# library's vndf_pdf: one view of a million samples or, with SAMPLES, six views of so many of one table. FORMS says
# how the numbers get there. What is absent is skipped.
cmake_minimum_required(VERSION 3.16)

if(NOT PYTHON)
    message("SKIPPED: no Python 3")
    return()
endif()
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
string(REPLACE "," ";" FORMS "${FORMS}")
set(small ${SOURCE}/tables/student-t-2.5-small.vndf)

# run(WHAT COMMAND...): leaves the script where something is absent.
macro(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors
        WORKING_DIRECTORY ${OUT})
    if(status EQUAL 77)
        string(REGEX MATCH "SKIPPED: [^\n]*" why "${errors}")
        message("${why}")
        return()
    elseif(NOT status EQUAL 0)
        message(FATAL_ERROR "${what} failed (${status}):\n${output}${errors}")
    endif()
endmacro()

# export(FORM TABLE...): sets `given`, what run_kernel.py is told of it.
macro(export form)
    set(given ${LANGUAGE} kernel.${form})
    set(how "")
    if("${form}" STREQUAL fetching)
        set(how --buffer numbers.f32)
    endif()
    run("vndf export" ${VNDF} export ${ARGN} --language ${LANGUAGE} -o kernel.${form} ${how})
endmacro()

macro(check_answers form)
    run("questions" ${AGREEMENT} make ${QUESTIONS} questions ${ARGN})
    run("${form} ${LANGUAGE}" ${PYTHON} ${SOURCE}/tools/export/run_kernel.py ${given} answers questions answers ${how})
    string(REGEX MATCH "${LANGUAGE} on [^\n]*" device "${errors}")
    run("agreement of ${form} ${LANGUAGE} with the library" ${AGREEMENT} check 2 questions answers ${ARGN})
    message("${form}, ${device}")
endmacro()

# Of the small table, which is the last subject.
macro(check_samples view samples)
    run("view ${view}" ${AGREEMENT} view ${view} ${small})
    string(STRIP "${output}" question)
    execute_process(
        COMMAND ${PYTHON} ${SOURCE}/tools/export/run_kernel.py ${given} draw ${samples} 1${view} ${question} ${how}
        COMMAND ${AGREEMENT} bins ${view} ${samples} ${small}
        RESULTS_VARIABLE statuses OUTPUT_VARIABLE output ERROR_VARIABLE errors WORKING_DIRECTORY ${OUT})
    if(statuses MATCHES "^77")
        string(REGEX MATCH "SKIPPED: [^\n]*" why "${errors}")
        message("${why}")
        return()
    elseif(NOT statuses STREQUAL "0;0")
        message(SEND_ERROR "chi-square of view ${view} failed (${statuses}):\n${output}${errors}")
    endif()
    message("${output}")
endmacro()

if(SAMPLES)
    export(${FORMS} ${small})
    foreach(view RANGE 5)
        check_samples(${view} ${SAMPLES})
    endforeach()
    return()
endif()
foreach(form IN LISTS FORMS)
    set(tables ${small})
    if(form STREQUAL fetching)
        set(tables ${SOURCE}/tables/student-t-2.5.vndf ${small})
    endif()
    export(${form} ${tables})
    check_answers(${form} ${tables})
endforeach()
list(GET FORMS 0 form)
export(${form} ${small})
check_samples(2 1048576)
