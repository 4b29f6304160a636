# `vndf sample` and `vndf eval` take surfaces of several lobes: one lobe prints the bytes of the plain command, several
# the numbers of their sum, and bad words are refused by name, with exit status 2 and without an output.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

# prints(VARIABLE words...): what `vndf words...` prints, with ${input} as stdin.
function(prints variable)
    file(WRITE ${OUT}/stdin.txt "${input}")
    execute_process(COMMAND ${VNDF} ${ARGN} WORKING_DIRECTORY ${OUT} INPUT_FILE ${OUT}/stdin.txt
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(SEND_ERROR "vndf ${ARGN}: status ${status}: ${errors}")
    endif()
    set(${variable} "${output}" PARENT_SCOPE)
endfunction()

# ---- one lobe -----------------------------------------------------------------------------------

set(input "0,0,1\n0.6,0,0.8\n-0.48,0.64,0.6\n")
foreach(table ggx beckmann ${SOURCE}/tables/student-t-2.5-small.vndf)
    foreach(theta 0 75 90 130)
        prints(plain sample ${table} --theta ${theta} --phi 20 --alpha 0.1,0.3 -n 200 -o -)
        prints(lobe sample --lobe "weight=1 table=${table} alpha=0.1,0.3" --theta ${theta} --phi 20 -n 200 -o -)
        expect("${table} from ${theta} as a lobe has other samples" plain STREQUAL lobe)
        prints(plain eval ${table} --theta ${theta} --phi 20 --alpha 0.3)
        prints(lobe eval --lobe "  alpha=0.3  table=${table} " --theta ${theta} --phi 20)
        expect("${table} from ${theta} as a lobe has other densities" plain STREQUAL lobe)
    endforeach()
endforeach()
prints(plain eval ggx --theta 60 --alpha 0.5,0.25)
foreach(same "matrix=0.5,0,0,0.25" "matrix=-0.5,0,0,0.25" "matrix=0,0.5,0.25,0")
    prints(lobe eval --lobe "table=ggx ${same}" --theta 60)
    string(REGEX REPLACE "([.][0-9][0-9][0-9][0-9][0-9])[0-9]*" "\\1" short "${plain}\n${lobe}") # five digits
    string(LENGTH "${short}" length)
    math(EXPR half "${length} / 2")
    string(SUBSTRING "${short}" 0 ${half} first)
    math(EXPR half "${half} + 1")
    string(SUBSTRING "${short}" ${half} -1 second)
    expect("${same} prints\n${lobe}and alpha=0.5,0.25\n${plain}" first STREQUAL second)
endforeach()

# ---- several ------------------------------------------------------------------------------------

# Straight from above every lobe has the area 1, so that D cos is the density: (3/4 + 4/4)/pi along z.
set(input "0,0,1\n")
set(lobes --lobe "weight=3 table=ggx alpha=1" --lobe "table=ggx alpha=0.5")
prints(values eval ${lobes} --theta 0)
expect("two lobes of GGX print ${values}" values MATCHES "^0.55704[0-9]+,0.55704[0-9]+,0,1\n$")

# The mean slope (1, 0) leans the normal to (-1, 0, 1): there GGX is at its peak, 1/pi of the slopes, cos^4 = 1/4.
# From above A = 1. Lambda and G1 are those of the mean plane, which is seen as it is: A(-wi) = 0.
set(input "-0.70710678,0,0.70710678\n")
prints(values eval --lobe "table=ggx mean=1,0" --theta 0)
expect("a mean slope prints ${values}" values MATCHES "^1.2732[0-9]+,0.90031[0-9]+,0,1\n$")

prints(csv sample ${lobes} --theta 0 -n 1000 -o -)
expect("the CSV of two lobes begins otherwise" csv MATCHES "^wm.x,wm.y,wm.z,pdf,lobe\n[-+.e0-9]+,[^\n]+,[01]\n")
string(REGEX MATCHALL ",0\n" first "${csv}")
string(REGEX MATCHALL ",[01]\n" both "${csv}")
list(LENGTH first first)
list(LENGTH both both)
expect("${first} of ${both} normals come from the lobe of weight 3/4" both EQUAL 1000 AND first GREATER 700
    AND first LESS 800)
prints(csv sample ${lobes} --theta 0 -n 10 -o two.f32)
file(SIZE ${OUT}/two.f32 size)
expect("ten samples of two lobes take ${size} bytes" size EQUAL 160)
file(REMOVE ${OUT}/two.f32)

# Density of sample and eval, one normal of a surface with two lobes apart.
set(lobes --lobe "weight=0.7 table=beckmann matrix=0.2,0.1,-0.05,0.3 mean=0.3,-0.2"
    --lobe "weight=0.3 table=ggx alpha=0.5")
prints(csv sample ${lobes} --theta 70 --phi 200 -n 20 -o -)
string(REGEX REPLACE "^[^\n]*\n" "" csv "${csv}")
string(REGEX REPLACE ",[^,\n]*,[01]\n" "\n" input "${csv}")
prints(values eval ${lobes} --theta 70 --phi 200)
string(REGEX MATCHALL "[^\n]+" csv "${csv}")
string(REGEX MATCHALL "[^\n]+" values "${values}")
foreach(row value IN ZIP_LISTS csv values)
    string(REGEX MATCH "^[^,]+,[^,]+,[^,]+,([0-9]*[.]?[0-9][0-9])" row "${row}")
    set(sampled "${CMAKE_MATCH_1}")
    string(REGEX MATCH "^[^,]+,([0-9]*[.]?[0-9][0-9])" value "${value}")
    expect("sample says ${sampled}, eval ${CMAKE_MATCH_1}" CMAKE_MATCH_1 STREQUAL sampled)
endforeach()

# ---- refused ------------------------------------------------------------------------------------

# refuses(TEXT words...): both commands.
function(refuses text)
    answers(2 "${text}" sample --theta 60 -n 10 -o none.csv ${ARGN})
    answers(2 "${text}" eval --theta 60 ${ARGN})
endfunction()

refuses("FILE|ggx|beckmann|FILE.vndfs@P is missing")
refuses("'ggx' and --lobe are given" ggx --lobe "table=ggx")
refuses("--alpha and --lobe are given" --alpha 1 --lobe "table=ggx")
refuses("--lobe 2: table=FILE|ggx|beckmann|FILE.vndfs@P is missing" --lobe "table=ggx" --lobe "weight=1")
refuses("--lobe 1: the key 'wieght' is not table, parameter, weight, alpha, matrix or mean" --lobe "wieght=1 table=ggx")
refuses("--lobe 1: the key 'roughness' is not table" --lobe "roughness=1 table=ggx")
refuses("--lobe 1: 'ggx' is not KEY=VALUE" --lobe "ggx")
refuses("--lobe 1: alpha is given twice" --lobe "table=ggx alpha=1 alpha=2")
refuses("--lobe 1 has both alpha and matrix" --lobe "table=ggx alpha=1 matrix=1,0,0,1")
refuses("--lobe 1: alpha '' is not a number" --lobe "table=ggx alpha=")
refuses("--lobe 1: alpha '0.1,x' is not a number" --lobe "table=ggx alpha=0.1,x")
refuses("--lobe 1: alpha '0' is not in the range" --lobe "table=ggx alpha=0")
refuses("--lobe 1: matrix '1,0,1' has too few numbers" --lobe "table=ggx matrix=1,0,1")
refuses("--lobe 1: matrix '1,0,0,1,1' has too many numbers" --lobe "table=ggx matrix=1,0,0,1,1")
refuses("--lobe 2: matrix '1,2,2,4' is singular" --lobe "table=ggx" --lobe "table=ggx matrix=1,2,2,4")
refuses("--lobe 1: mean '1' has too few numbers" --lobe "table=ggx mean=1")
refuses("--lobe 1: alpha '0.1,1e400' is too large for a double" --lobe "table=ggx alpha=0.1,1e400")
refuses("--lobe 1: weight '-1e400' is too large for a double" --lobe "table=ggx weight=-1e400")
refuses("--lobe 1: mean 'nan,0' is not a number" --lobe "table=ggx mean=nan,0")
refuses("--lobe 2: weight '-1' is not in the range from 0" --lobe "table=ggx" --lobe "table=ggx weight=-1")
refuses("the weights of all lobes are 0" --lobe "table=ggx weight=0" --lobe "table=ggx weight=0")
refuses("--lobe 1: matrix '1,2,2,4' is singular" --lobe "table=ggx weight=0 matrix=1,2,2,4" --lobe "table=ggx")
refuses("missing.vndf" --lobe "table=ggx" --lobe "table=missing.vndf")
set(nine "")
foreach(i RANGE 1 9)
    list(APPEND nine --lobe "table=ggx")
endforeach()
refuses("--lobe is given more than 8 times" ${nine})
list(REMOVE_AT nine 0 1)
prints(eight eval ${nine} --theta 60)
answers(2 "--theta is missing" sample --lobe "table=ggx" -n 10 -o none.csv)

# ---- families -----------------------------------------------------------------------------------

answers(0 "\nlinear_in 1/p\ndistance 0.0" build --family student-t --parameter 1.8..3 --knots 2 --max-bytes 2048
    -o two.vndfs)
answers(0 "" build --family student-t:1.8 --max-bytes 2048 -o first.vndf)
prints(facts info two.vndfs)
string(REPLACE ";" "," facts "${facts}")
foreach(line "source --family student-t --parameter 1.8..3" "knots 2 tables" "low 1.8 parameter" "high 3 parameter"
        "grazing 0.[0-9]+ of the mass"
        "tables_tv 0.[0-9]+ of the mass"
        "knot at 1.8 parameter bytes [0-9]+ B tv 0.[0-9]+ of the mass distance 0.[0-9]+")
    expect("info of a family has no line '${line}':\n${facts}" "\n${facts}" MATCHES "\n${line}( of the mass)?\n")
endforeach()
prints(knot sample two.vndfs@1.8 --theta 70 --phi 30 --alpha 0.2,0.4 -n 100 -o -)
prints(plain sample first.vndf --theta 70 --phi 30 --alpha 0.2,0.4 -n 100 -o -)
expect("the family at its first knot draws otherwise than its table" knot STREQUAL plain)
prints(between sample two.vndfs@2.4 --theta 70 -n 10 -o -)
expect("a family alone has a column of lobes" between MATCHES "^wm.x,wm.y,wm.z,pdf\n")
set(input "0,0,1\n0.6,0,0.8\n")
prints(between eval two.vndfs@2.4 --theta 70 --alpha 0.3)
prints(lobe eval --lobe "table=two.vndfs parameter=2.4 alpha=0.3" --theta 70)
expect("a family as a lobe has other densities" between STREQUAL lobe)
prints(lobe eval --lobe "table=two.vndfs@2.4 alpha=0.3" --theta 70)
expect("FILE.vndfs@P as a lobe has other densities" between STREQUAL lobe)
foreach(command sample eval)
    answers(0 "usage: vndf ${command} FILE|ggx|beckmann|FILE.vndfs@P --theta DEG" ${command} --help)
endforeach()
prints(halves eval --lobe "table=two.vndfs parameter=1.8" --lobe "table=two.vndfs parameter=3" --theta 0)
prints(middle eval two.vndfs@2.25 --theta 0) # linear in 1/p: 1/2.25 is the mean of 1/1.8 and 1/3
foreach(values halves middle) # five digits
    string(REGEX REPLACE "([.][0-9][0-9][0-9][0-9][0-9])[0-9]*" "\\1" ${values} "${${values}}")
endforeach()
expect("halfway the family is no mixture of halves: ${middle}${halves}" middle STREQUAL halves)
prints(lobes sample --theta 0 -n 50 -o - --lobe "table=two.vndfs parameter=2" --lobe "table=ggx")
expect("lobes of a family and GGX are not numbered by --lobe" lobes MATCHES ",0\n.*,1\n" AND NOT lobes MATCHES ",2\n")

refuses("'two.vndfs' is a family; say at which parameter, as in two.vndfs@2.5" two.vndfs)
refuses("the parameter '3.1' is not in the range of the family, from 1.8 to 3" two.vndfs@3.1)
refuses("the parameter 'x' is not a number" two.vndfs@x)
refuses("missing.vndfs" missing.vndfs@2)
refuses("--lobe 1: parameter '1' is not in the range" --lobe "table=two.vndfs parameter=1")
refuses("--lobe 1: parameter '1' is not in the range" --lobe "table=two.vndfs@1")
refuses("'two.vndfs' is a family; say at which parameter, as in two.vndfs@2.5" --lobe "table=two.vndfs")
refuses("--lobe 1: parameter '3' is given, and 'two.vndfs@2' says one already"
    --lobe "table=two.vndfs@2 parameter=3")
refuses("must begin with" --lobe "table=first.vndf parameter=2")
set(five "")
foreach(i RANGE 1 5)
    list(APPEND five --lobe "table=two.vndfs parameter=2")
endforeach()
refuses("these are more than 8 lobes; a family counts as two" ${five})
answers(2 "a single table is needed (eval and sample take FILE.vndfs@P, info FILE.vndfs)" check two.vndfs@2)
answers(2 "a single table is needed" plot two.vndfs -o none.svg)

# refuses_build(TEXT words...): and nothing is written.
function(refuses_build text)
    answers(2 "${text}" build -o none.vndfs ${ARGN})
endfunction()

refuses_build("--parameter is for --family" --slope "exp(-r)" --parameter 1..2)
refuses_build("--knots is for --parameter" --family student-t:2 --knots 3)
refuses_build("--knots and --max-tv are given" --family student-t --parameter 2..3 --knots 3 --max-tv 0.1)
refuses_build("--parameter takes no --break" --family student-t --parameter 2..3 --break 1)
refuses_build("--parameter takes no --finest" --family student-t --parameter 2..3 --finest 1e-3)
refuses_build("--parameter '2' is not LOW..HIGH" --family student-t --parameter 2)
refuses_build("--parameter 'x' is not a number" --family student-t --parameter x..3)
refuses_build("--parameter '1e400' is too large for a double" --family student-t --parameter 2..1e400)
refuses_build("parameters from 3 to 2: the first must be below the second" --family student-t --parameter 3..2)
refuses_build("ggx has no parameter; families that have one are student-t, gtr, epd" --family ggx --parameter 1..2)
refuses_build("abc has the parameters B and C: right would be abc:{p},C or abc:B,{p}" --family abc --parameter 1..2)
refuses_build("sgd has the parameters ALPHA and P" --family sgd --parameter 1..2)
refuses_build("C is missing; right would be abc:B,C" --family "abc:{p}" --parameter 1..2)
refuses_build("--knots '1' is not in the range from 2 to 256" --family student-t --parameter 2..3 --knots 1)
refuses_build("--max-tv '0' is not in the range" --family student-t --parameter 2..3 --max-tv 0)
refuses_build("2048" --family student-t --parameter 2..3 --max-bytes 100)
refuses_build("at the parameter 1: student-t: GAMMA is 1; it must be above 1.5" --family student-t --parameter 1..3)
refuses_build("'abc:2' does not say where the parameter stands" --family abc:2 --parameter 1..3)
refuses_build("vndf build: column 1: unknown family 'studnt'; known are ggx" --family studnt --parameter 1..3)
answers(2 "has to end in .vndfs" build --family student-t --parameter 2..3 -o none.vndf)

file(GLOB names RELATIVE ${OUT} ${OUT}/*)
string(REPLACE ";" " " names "${names}")
expect("there are files that should not be: ${names}" names STREQUAL "first.vndf stdin.txt two.vndfs")

if(failures)
    message(FATAL_ERROR "${failures} failed")
endif()
