# The exported C is C99 and the exported C++ is C++11, for every compiler of both that is here: no warning with
# -Wall -Wextra -Wpedantic -Wshadow -Wconversion, numbers embedded or read from their file; answers are the library's,
# bit for bit, and near them with -ffast-math, as renderers compile; BSDFs scatter as the library's do; two kernels with
# prefixes of their own live in one program, and one may be included twice.
cmake_minimum_required(VERSION 3.16)

if(SANITIZE)
    message("SKIPPED: the programs would be compiled without sanitizers (${SANITIZE})")
    return()
endif()
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
set(flags -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I${OUT})
set(tables ${SOURCE}/tables/student-t-2.5-small.vndf ${SOURCE}/tables/hazy.vndf)
set(standard_c -x c -std=c99)
set(standard_cpp -x c++ -std=c++11)

function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors
        WORKING_DIRECTORY ${OUT})
    if(NOT status EQUAL 0)
        message(SEND_ERROR "${what} failed (${status}):\n${output}${errors}")
    endif()
endfunction()

# two(LANGUAGE COMPILER): two kernels in one program.
function(two language compiler)
    foreach(prefix one two)
        run("export" ${VNDF} export ${SOURCE}/tables/student-t-2.5-small.vndf --language ${language}
            --prefix ${prefix} -o ${prefix}.h)
    endforeach()
    file(WRITE ${OUT}/two.c "
#include \"one.h\"
#include \"two.h\"
#include \"one.h\"
int main(void)
{
    one_view a = one_view_of(one_surface_of(ONE_STUDENT_T_2_5_SMALL, 0.5f, 0.1f), one_vec3_of(0.6f, 0.0f, 0.8f));
    two_view b = two_view_of(two_surface_of(TWO_STUDENT_T_2_5_SMALL, 0.5f, 0.1f), two_vec3_of(0.6f, 0.0f, 0.8f));
    one_sampled s = one_sample(a, 0.25f, 0.75f);
    two_sampled t = two_sample(b, 0.25f, 0.75f);
    return !(s.pdf > 0.0f && !(s.pdf < t.pdf) && !(s.pdf > t.pdf) && !(s.wm.x < t.wm.x) && !(s.wm.x > t.wm.x));
}
")
    run("${compiler} of two kernels" ${compiler} ${standard_${language}} ${flags} two.c -lm -o two)
    run("the program of two kernels by ${compiler}" ${OUT}/two)
endfunction()

# try(LANGUAGE COMPILER WHAT embedded|fetching HOW [FLAG...]): WHAT and HOW are vndf_agreement's.
function(try language compiler what form how)
    set(raw "")
    set(program ${OUT}/answer)
    set(bsdf "")
    if(form STREQUAL fetching)
        set(raw --buffer numbers.f32)
        list(APPEND ARGN "-DKERNEL_RAW=\"${OUT}/numbers.f32\"")
    endif()
    if(NOT what STREQUAL normals)
        set(bsdf --bsdf "${what}")
    endif()
    run("export of ${what}" ${VNDF} export ${tables} --language ${language} --prefix kernel ${raw} ${bsdf} -o kernel.h)
    execute_process(COMMAND ${AGREEMENT} ask "${what}" ${language} kernel ${form}
        INPUT_FILE ${SOURCE}/tests/export/ask.h OUTPUT_FILE ${OUT}/asked.h)
    run("questions of ${what}" ${AGREEMENT} make "${what}" 8000 questions ${tables})
    run("${compiler} of ${form} ${what} in ${language}" ${compiler} -O1 -ffp-contract=off ${standard_${language}}
        ${flags} ${ARGN} "-DKERNEL_FILE=\"kernel.h\"" ${SOURCE}/tests/export/answer.c -lm -o ${program})
    run("the program of ${compiler}" ${program} questions answers)
    run("agreement of ${compiler}, ${form} ${what} in ${language}" ${AGREEMENT} check "${what}" ${how} questions answers
        ${tables})
endfunction()

# Compilers that take gcc's flags; the build's own first.
function(try_all language)
    set(found "")
    foreach(name IN LISTS ARGN)
        unset(compiler CACHE)
        find_program(compiler ${name})
        if(compiler AND NOT compiler IN_LIST found)
            list(APPEND found ${compiler})
            try(${language} ${compiler} normals embedded BITS)
            two(${language} ${compiler})
            set_property(GLOBAL APPEND PROPERTY tried ${compiler})
        endif()
    endforeach()
    if(found)
        list(GET found 0 compiler)
        try(${language} ${compiler} normals fetching BITS)
        try(${language} ${compiler} normals embedded FAST -O3 -ffast-math)
        foreach(effects "lobes=reflection" "lobes=both fresnel=dielectric" "lobes=transmission masking=none"
                "lobes=both fresnel=schlick masking=v-cavities transport=importance"
                "fresnel=conductor masking=separable reflection=retro")
            try(${language} ${compiler} "${effects}" embedded ROUNDED)
        endforeach()
    endif()
endfunction()

# A family of tables at a parameter is the library's mixture.
run("a family" ${VNDF} build --family student-t --parameter 1.6..6 --max-tv 0.01 -o tails.vndfs)
run("export of a family" ${VNDF} export tails.vndfs --language c --prefix kernel --lobes 2 -o tails.h)
run("the program of a family" ${C_COMPILER} -O1 -ffp-contract=off -std=c99 ${flags} -I${SOURCE}/include
    ${SOURCE}/tests/export/family.c ${STATIC_LIBRARY} -lm -o family)
run("the family" ${OUT}/family tails.vndfs)
message("${output}")

try_all(c gcc clang)
try_all(cpp g++ clang++)
get_property(tried GLOBAL PROPERTY tried)
if(NOT tried)
    message("SKIPPED: neither gcc nor clang is here")
endif()
message("compiled by ${tried}")
