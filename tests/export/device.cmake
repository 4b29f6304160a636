# The kernel that is exported to LANGUAGE, run by run_kernel.py on what runs the language here, answers as
# the library does, with numbers embedded or read from a buffer that two tables share: FORMS says how they get there.
# Other words of FORMS are BSDFs, whose numbers are read. What is absent is skipped.
cmake_minimum_required(VERSION 3.16)

if(NOT PYTHON)
    message("SKIPPED: no Python 3")
    return()
endif()
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
string(REPLACE "," ";" FORMS "${FORMS}")

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

# Of BSDFs these effects, which between them call all of the text.
set(scattering "lobes=both fresnel=dielectric")
set(metal "fresnel=conductor masking=v-cavities reflection=retro")
set(thin "lobes=both fresnel=schlick masking=separable transport=importance")
run("a family" ${VNDF} build --family student-t --parameter 2..4 --knots 3 --max-bytes 2048 -q -o tails.vndfs)
foreach(form IN LISTS FORMS)
    set(tables ${SOURCE}/tables/student-t-2.5-small.vndf tails.vndfs)
    set(how --buffer numbers.f32)
    set(numbers fetching)
    if(form STREQUAL fetching)
        list(PREPEND tables ${SOURCE}/tables/student-t-2.5.vndf)
    elseif(form STREQUAL embedded)
        set(how "")
        set(numbers embedded)
    endif()
    set(what normals)
    set(bsdf "")
    if(DEFINED ${form})
        set(what "${${form}}")
        set(bsdf --bsdf "${what}")
    endif()
    run("vndf export" ${VNDF} export ${tables} --language ${LANGUAGE} -o kernel.${form} ${how} ${bsdf})
    run("ask.h" ${AGREEMENT} ask "${what}" ${LANGUAGE} vndf ${numbers} INPUT_FILE ${SOURCE}/tests/export/ask.h
        OUTPUT_FILE ${OUT}/asked)
    run("questions" ${AGREEMENT} make "${what}" ${QUESTIONS} questions ${tables})
    run("${form} ${LANGUAGE}" ${PYTHON} ${SOURCE}/tests/export/run_kernel.py ${LANGUAGE} kernel.${form} asked
        questions answers ${how})
    string(REGEX MATCH "${LANGUAGE} on [^\n]*" device "${errors}")
    run("agreement of ${form} ${LANGUAGE} with the library" ${AGREEMENT} check "${what}" ROUNDED questions answers
        ${tables})
    message("${form}, ${device}\n${output}")
endforeach()
