# `vndf build` from measured files and `vndf export --rgl`: what goes out comes in as the same distribution, tables
# say what file they were made of, and wrong words and bad files end with exit status 2, a reason and no output.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

# number(VARIABLE KEY): of a line `KEY number`.
macro(number variable key)
    set(${variable} "none")
    if("\n${output}" MATCHES "\n${key} ([-+.e0-9]+)")
        set(${variable} ${CMAKE_MATCH_1})
    endif()
endmacro()

# refused(COMMAND "WORDS;REASON"...): with these words it ends with status 2 and the reason.
function(refused command)
    foreach(words ${ARGN})
        string(REPLACE "|" ";" words "${words}")
        list(GET words 0 given)
        list(GET words 1 reason)
        separate_arguments(given)
        if(command STREQUAL "build")
            list(APPEND given -o bad.vndf)
        endif()
        run(2 ${command} ${given})
        has(errors "${reason}")
    endforeach()
endfunction()

# ---- .bsdf --------------------------------------------------------------------------------------

run(0 export ggx --rgl --alpha 0.4 --f0 0.9,0.6,0.3 -o out.bsdf)
expect("export prints on stdout" "x${output}" STREQUAL x)
run(0 build --rgl out.bsdf --max-bytes 2048 -o in.vndf)
has(output "source --rgl out.bsdf (crc32 ")
number(scale scale) # the median slope of GGX is its alpha
expect("the median slope is ${scale}, 0.4 went out" scale GREATER 0.3998 AND scale LESS 0.4002)
run(0 export in.vndf --rgl --wavelengths 400,700 --f0 0.5 -o spectral.bsdf)
file(SIZE ${OUT}/spectral.bsdf size)
expect("two channels take ${size} bytes" size LESS 4000000)

file(WRITE ${OUT}/no.bsdf "tensor_fool")
refused(build
    "--rgl no.bsdf|no.bsdf: this is no tensor file"
    "--rgl none.bsdf|none.bsdf: No such file"
    "--rgl out.bsdf --step 2|--step is for --height"
    "--rgl out.bsdf --family ggx|--family and --rgl are given")
run(2 build --rgl out.bsdf -o out.bsdf)
has(errors "an input of this command")
refused(export
    "ggx --rgl|-o OUT is missing"
    "ggx --rgl --language c -o bad.bsdf|--language is for kernels"
    "ggx --rgl --f0 2 -o bad.bsdf|--f0 '2' is not in the range"
    "ggx --rgl --f0 1,1 -o bad.bsdf|--f0 has 2 numbers"
    "ggx --rgl --wavelengths 500,400 -o bad.bsdf|they must ascend"
    "ggx --alpha 1 --language c -o bad.h|--alpha is for"
    "none.vndf --rgl -o bad.bsdf|none.vndf")

# ---- surfaces -----------------------------------------------------------------------------------

# 48 x 48 whole numbers by a recurrence, smoothed along rows: slopes of both axes differ.
set(state 1)
set(text "# heights\n")
foreach(y RANGE 1 48)
    set(before 500)
    foreach(x RANGE 1 48)
        math(EXPR state "(${state} * 1103515245 + 12345) % 2147483648")
        math(EXPR before "(3 * ${before} + ${state} / 65536 % 1000) / 4")
        string(APPEND text " ${before}")
    endforeach()
    string(APPEND text "\n")
endforeach()
file(WRITE ${OUT}/heights.txt "${text}")
run(0 build --height heights.txt --step 200,300 --max-bytes 2048 -o heights.vndf)
has(output "source --height heights.txt --step 200,300 (crc32 ")
has(output "\nheights 48 x 48, 200 x 300 apart\nslopes 2116\n")
number(finer rms_slope)
run(0 build --height heights.txt --step 400,400 --max-bytes 2048 --profile curve.csv -o heights.vndf)
number(rms rms_slope)
number(before scale)
expect("half the step: rms ${finer} after ${rms}" finer GREATER rms)
foreach(key anisotropy p22_error_median p22_error_99 residual_isotropy)
    has(output "\n${key} ")
endforeach()
expect("no matrix" output MATCHES "\nmatrix [.0-9]+,[-.e0-9]+,[-.e0-9]+,[.0-9]+\n")
file(READ ${OUT}/curve.csv curve)
has(curve "# --height heights.txt --step 400,400 (crc32 ")
expect("no rows in ${curve}" curve MATCHES "\nslope,p22\n[.e0-9-]+,[.e0-9-]+\n")
run(0 build --csv curve.csv --max-bytes 2048 -o again.vndf)
number(scale scale)
expect("the median slope of the profile is ${scale}, of the table ${before}" scale STREQUAL before)
run(0 build --height heights.txt --cutoff 4 --max-bytes 2048 -o heights.vndf)
has(output "\ncutoff 4\nslopes 1936\n")
run(0 build --height heights.txt --step 0.001 --max-bytes 2048 -o heights.vndf)
has(errors "heights.txt: implausible median slope ")

refused(build
    "--height heights.txt --cutoff 300|--cutoff '300'"
    "--height heights.txt --cutoff 46|4 slopes"
    "--normal-map heights.txt|begin with PF, Pf, P5 or P6"
    "--height heights.txt --profile bad.vndf|-o and --profile both name"
    "--height heights.txt --profile -|--profile '-': a file is needed"
    "--family ggx --profile bad.csv|--profile is for files of measurements"
    "--normal-map heights.txt --cutoff 3|--cutoff is for --height")
file(GLOB bad ${OUT}/bad*)
expect("a refused command leaves ${bad}" NOT bad)
