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
set(flags -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I${SOURCE}/tests/export -I${OUT})
set(tables ${SOURCE}/tables/student-t-2.5-small.vndf ${SOURCE}/tables/hazy.vndf)

function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors
        WORKING_DIRECTORY ${OUT})
    if(NOT status EQUAL 0)
        message(SEND_ERROR "${what} failed (${status}):\n${output}${errors}")
    endif()
endfunction()

foreach(language c cpp)
    run("export" ${VNDF} export ${tables} --language ${language} --prefix kernel -o embedded.${language}.h)
    run("export" ${VNDF} export ${tables} --language ${language} --prefix kernel --buffer numbers.f32
        -o fetching.${language}.h)
    foreach(prefix one two)
        run("export" ${VNDF} export ${SOURCE}/tables/student-t-2.5-small.vndf --language ${language}
            --prefix ${prefix} -o ${prefix}.${language}.h)
    endforeach()
    file(WRITE ${OUT}/two.${language} "
#include \"one.${language}.h\"
#include \"two.${language}.h\"
#include \"one.${language}.h\"
int main(void)
{
    one_view a = one_view_of(one_surface_of(ONE_STUDENT_T_2_5_SMALL, 0.5f, 0.1f), one_vec3_of(0.6f, 0.0f, 0.8f));
    two_view b = two_view_of(two_surface_of(TWO_STUDENT_T_2_5_SMALL, 0.5f, 0.1f), two_vec3_of(0.6f, 0.0f, 0.8f));
    one_sampled s = one_sample(a, 0.25f, 0.75f);
    two_sampled t = two_sample(b, 0.25f, 0.75f);
    return !(s.pdf > 0.0f && !(s.pdf < t.pdf) && !(s.pdf > t.pdf) && !(s.wm.x < t.wm.x) && !(s.wm.x > t.wm.x));
}
")
endforeach()
run("questions" ${AGREEMENT} make normals 8000 questions ${tables})

# try_compiler(COMPILER LANGUAGE FORM [DEFINITION])
function(try_compiler compiler language form)
    set(standard -x c -std=c99)
    set(how BITS)
    if("${ARGN}" MATCHES "fast-math")
        set(how FAST)
    endif()
    if(language STREQUAL cpp)
        set(standard -x c++ -std=c++11)
    endif()
    set(program ${OUT}/answer)
    run("${compiler} of ${form} ${language}" ${compiler} -O1 -ffp-contract=off ${standard} ${flags} ${ARGN}
        "-DKERNEL_FILE=\"${form}.${language}.h\"" ${SOURCE}/tests/export/exported.c ${SOURCE}/tests/export/answer.c
        -lm -o ${program})
    run("the program of ${compiler}" ${program} questions answers)
    run("agreement of ${compiler}, ${form} ${language}" ${AGREEMENT} check normals ${how} questions answers ${tables})
    if(form STREQUAL embedded)
        run("${compiler} of two kernels" ${compiler} ${standard} ${flags} two.${language} -lm -o two)
        run("the program of two kernels by ${compiler}" ${OUT}/two)
    endif()
    set_property(GLOBAL APPEND PROPERTY tried ${compiler})
endfunction()

# try_bsdf(COMPILER LANGUAGE EFFECTS [DEFINITION...]): of BSDFs numbers are embedded.
function(try_bsdf compiler language effects)
    set(standard -x c -std=c99)
    if(language STREQUAL cpp)
        set(standard -x c++ -std=c++11)
    endif()
    run("export of ${effects}" ${VNDF} export ${tables} --language ${language} --prefix kernel --bsdf "${effects}"
        -o bsdf.${language}.h)
    run("questions of ${effects}" ${AGREEMENT} make "${effects}" 8000 hits ${tables})
    run("${compiler} of ${effects}" ${compiler} -O1 -ffp-contract=off ${standard} ${flags} -DKERNEL_SCATTERS ${ARGN}
        "-DKERNEL_FILE=\"bsdf.${language}.h\"" ${SOURCE}/tests/export/exported.c ${SOURCE}/tests/export/answer.c
        -lm -o ${OUT}/scatter)
    run("the program of ${effects}" ${OUT}/scatter hits scattered)
    run("agreement of ${effects}" ${AGREEMENT} check "${effects}" ROUNDED hits scattered ${tables})
endfunction()

# Compilers that take gcc's flags; the build's own first.
function(try_all language)
    set(found "")
    foreach(name IN LISTS ARGN)
        unset(compiler CACHE)
        find_program(compiler ${name})
        if(compiler AND NOT compiler IN_LIST found)
            list(APPEND found ${compiler})
            try_compiler(${compiler} ${language} embedded)
        endif()
    endforeach()
    if(found)
        list(GET found 0 compiler)
        try_compiler(${compiler} ${language} fetching "-DKERNEL_RAW=\"${OUT}/numbers.f32\"")
        try_compiler(${compiler} ${language} embedded -O3 -ffast-math)
        try_bsdf(${compiler} ${language} "lobes=reflection")
        try_bsdf(${compiler} ${language} "lobes=both fresnel=dielectric" -DKERNEL_INDEXED)
        try_bsdf(${compiler} ${language} "lobes=both fresnel=schlick masking=v-cavities transport=importance"
            -DKERNEL_INDEXED -DKERNEL_SCHLICK)
        try_bsdf(${compiler} ${language} "fresnel=conductor masking=separable reflection=retro" -DKERNEL_CONDUCTOR)
        try_bsdf(${compiler} ${language} "lobes=transmission masking=none" -DKERNEL_INDEXED)
    endif()
endfunction()

try_all(c gcc clang)
try_all(cpp g++ clang++)
get_property(tried GLOBAL PROPERTY tried)
if(NOT tried)
    message("SKIPPED: neither gcc nor clang is here")
endif()
message("compiled by ${tried}")
