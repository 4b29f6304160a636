# `vndf export` writes one file for every language, the same bytes each time, with the numbers in it or beside it; it
# refuses what a language forbids with the reason, and wrong words, and leaves no file behind then.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)
set(small ${SOURCE}/tables/student-t-2.5-small.vndf)
set(large ${SOURCE}/tables/student-t-2.5.vndf)
set(languages c cpp cuda opencl glsl hlsl wgsl msl)

set(command_words export)

# ---- every language -----------------------------------------------------------------------------

# exports(HAS LACKS WORDS...): in every language, with these words, the file OUT.LANGUAGE has these texts and calls none
# of those functions, and begins no name by itself.
macro(exports present absent)
    foreach(language IN LISTS languages)
        run(0 ${ARGN} --language ${language} -o out.${language})
        file(READ ${OUT}/out.${language} text)
        foreach(part ${present})
            has(text "${part}")
        endforeach()
        foreach(call ${absent} surface_of table_at frame_of)
            expect("${language}: ${call} stands in ${ARGN}" NOT text MATCHES "[^a-zA-Z_]${call} *[(]")
        endforeach()
    endforeach()
endmacro()

exports("// VNDF_STUDENT_T_2_5_SMALL, ;--family student-t:2.5\n;above the horizon;VNDF_GGX;VNDF_LOBES;vndf_sample(;\
vndf_pdf(;vndf_visible(;vndf_ndf(;vndf_lambda(;vndf_g1(;vndf_g2(;vndf_projected_area(;vndf_mixture_sample(;VNDF_NUMBERS"
    "" ${small})
exports("VNDF_HAZY" "" ${SOURCE}/tables/hazy.vndf) # a table of the default size
exports("vndf_sample(" "vndf_pdf;vndf_table_pdf;vndf_mixture_pdf;vndf_family_at" ${small} --only view,sample)
exports("lobes=both fresnel=dielectric masking=correlated;vndf_bsdf_sample(;vndf_bsdf_eval(;vndf_bsdf_pdf(;\
vndf_dielectric(;vndf_beta_of(;vndf_refracted_at("
    "vndf_conductor;vndf_schlick;vndf_masked_apart;vndf_mixture_pdf;vndf_g2" ${small} --bsdf both
    --fresnel dielectric)
exports("vndf_bsdf_eval(" "vndf_bsdf_sample;vndf_bsdf_pdf;vndf_refracting;vndf_ggx_draw;vndf_masked_by_height"
    ${small} --bsdf reflection --masking none --only bsdf_eval)
# Numbers beside the file, two tables, another prefix.
exports("// MY_D_STUDENT_T_2_5, ;MY_D_STUDENT_T_2_5_SMALL;my_d_sample(" "" ${small} ${large} --buffer two.f32
    --prefix my_d --lobes 2)
foreach(language IN LISTS languages)
    file(READ ${OUT}/out.${language} text)
    expect("${language}: numbers are embedded though a buffer was asked for" NOT text MATCHES "MY_D_NUMBERS")
    expect("${language}: a name has the old prefix" NOT text MATCHES "[^.]vndf_|VNDF_")
    expect("${language}: --lobes 2 is lost" text MATCHES "MY_D_LOBES(: i32)? = 2")
endforeach()
run(0 ${small} ${large} --buffer two.f32 --prefix my_d --lobes 2 --language msl -o -)
expect("-o - prints something else than the file" output STREQUAL text)

# The raw file has as many numbers as the comments say, and where the second table begins.
file(READ ${OUT}/out.c text)
string(REGEX MATCHALL "[0-9]+ numbers" counts "${text}")
string(REGEX REPLACE " numbers" "" counts "${counts}")
list(GET counts 0 first)
list(GET counts 1 second)
math(EXPR bytes "4 * (${first} + ${second})")
file(SIZE ${OUT}/two.f32 size)
expect("two.f32 has ${size} bytes, not ${bytes}" size EQUAL bytes)
has(text "MY_D_STUDENT_T_2_5 = ${first} ")
has(text "const float *numbers")

# The source of a table is a text of anybody's: it cannot end the comment.
execute_process(COMMAND ${VNDF} build --slope "exp(-r\n)" --max-bytes 2048 -o ${OUT}/lines.vndf
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
    run(0 lines.vndf --language c -o lines.c)
    file(READ ${OUT}/lines.c text)
    string(FIND "${text}" "\n)" at)
    expect("a line break of the source ends the comment" at EQUAL -1)
endif()

# ---- refusals -----------------------------------------------------------------------------------

set(many "")
foreach(copy a b c d e)
    configure_file(${small} ${OUT}/${copy}.vndf COPYONLY)
    list(APPEND many ${copy}.vndf)
endforeach()
file(WRITE ${OUT}/wrong.vndf "VNDFtab\nwrong")
configure_file(${small} ${OUT}/input.vndf COPYONLY)
file(GLOB before RELATIVE ${OUT} ${OUT}/*)

# refuses(REASON WORDS...): of this table in C.
function(refuses reason)
    answers(2 "${reason}" export ${small} --language c -o no.txt ${ARGN})
endfunction()
foreach(language glsl hlsl wgsl)
    answers(2 "numbers cannot be embedded in " export ${many} --language ${language} -o no.txt)
    answers(2 "use --buffer FILE, or smaller tables: vndf build --max-bytes " export ${many} --language ${language}
        -o no.txt)
endforeach()
answers(2 "did you mean 'cuda'?" export ${small} --language cudaa -o no.txt)
answers(2 "msl" export ${small} --language fortran -o no.txt)
answers(2 "--language is missing" export ${small} -o no.txt)
answers(2 "-o OUT is missing" export ${small} --language c)
answers(2 "FILE" export --language c -o no.txt)
answers(2 "'ggx' is a closed form: every kernel has it" export ggx --language c -o no.txt)
answers(2 "missing.vndf" export missing.vndf --language c -o no.txt)
answers(2 "wrong.vndf" export wrong.vndf --language c -o no.txt)
answers(2 "missing/no.txt" export ${small} --language c -o missing/no.txt)
answers(2 "input" export input.vndf --language c -o input.vndf)
answers(2 "input" export input.vndf --language c --buffer input.vndf -o no.txt)
answers(2 "--buffer and -o both name" export ${small} --language c --buffer no.txt -o ./no.txt)
refuses("a file is needed" --buffer -)
refuses("which is taken; rename the file" ${small})
foreach(prefix Vndf 2d a-b a_ a__b gl gl_a "abcdefghijabcdefghijabcdefghijabc")
    refuses("--prefix" --prefix "${prefix}")
endforeach()
foreach(lobes 0 9)
    refuses("--lobes" --lobes ${lobes})
endforeach()
answers(0 "good to ship" build --family student-t --parameter 2..4 --max-tv 0.05 -o ${OUT}/tails.vndfs)
answers(2 "a family is a mixture of two tables" export tails.vndfs --language c --lobes 1 -o no.txt)
file(REMOVE ${OUT}/tails.vndfs)
refuses("did you mean 'sample'?" --only smple,sample)
refuses("did you mean 'both'?" --bsdf bth)
refuses("needs --bsdf" --only bsdf_eval)
refuses("is for --bsdf, which is not given" --fresnel schlick)
refuses("VNDF_FRESNEL_NONE" --bsdf both)
file(GLOB after RELATIVE ${OUT} ${OUT}/*)
expect("a refusal left a file: ${after}" before STREQUAL after)
