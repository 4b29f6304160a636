# `vndf albedo` prints, exports and saves what its help says: E that falls with roughness, a CSV with one row for each
# angle and roughness, an array of C that compiles and holds the same numbers, a file; and refuses wrong words without
# leaving a file behind.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

set(command_words albedo)
set(coarse --columns 12 --rows 10)

# ---- text ---------------------------------------------------------------------------------------

# From straight above GGX of alpha 1 keeps 1 - log 2 = 0.30685.
run(0 ggx --alpha 0,1 --theta 0,90)
has(output "ggx, mirror\n")
has(output "\n      0   1.00000   0.30685\n     90   1.00000   1.00000\naverage")
foreach(key error error_usual split_error split_usual average_error quadrature_error)
    expect("albedo prints no ${key}" output MATCHES "\n${key} [-+.e0-9]+")
endforeach()
run(0 beckmann --eta 1.5 ${coarse} --alpha 0.3)
has(output "beckmann, dielectric, eta 1.5\n")
has(output "albedo, from the other side\n")
has(output "transmitted part, from the side of z\n")
run(0 --family student-t:3 ${coarse})
has(output "student-t:3, mirror\n")

# ---- files --------------------------------------------------------------------------------------

run(0 ggx --eta 1.5 ${coarse} --alpha 0.2,1 --theta 0,45,80 -o glass.csv --c rough-glass.h --size 9 --save glass.albedo)
has(output "dielectric")
file(WRITE ${OUT}/wrong.albedo "wrong")
file(STRINGS ${OUT}/glass.csv lines)
list(LENGTH lines count)
expect("glass.csv has ${count} lines, not 13" count EQUAL 13)
list(GET lines 0 header)
expect("glass.csv begins with ${header}" header STREQUAL
    "distribution,eta,side,alpha,theta,albedo,reflected,transmitted,average")
list(GET lines 12 last)
expect("glass.csv ends with ${last}" last MATCHES "^\"ggx\",1.5,-1,1,80,0[.][0-9]+,0[.][0-9]+,0[.][0-9]+,0[.][0-9]+$")
file(READ ${OUT}/glass.albedo magic LIMIT 7 HEX)
expect("glass.albedo begins with ${magic}" magic STREQUAL "564e4446616c62")
string(REGEX REPLACE "^.*\n(error [^c]+[(]cosine )" "\\1" facts "${output}")
answers(0 "source --family ggx\ntool vndf ${VERSION}\neta 1.5\n${facts}" info glass.albedo)
answers(2 "missing.albedo" info missing.albedo)
answers(2 "not a vndf table of albedos" info wrong.albedo)
file(READ ${OUT}/rough-glass.h header)
foreach(name rough_glass rough_glass_other_side)
    has(header "static const float ${name}[9][9] = {")
    has(header "static const float ${name}_average[9] = {")
endforeach()
has(header "sqrt(alpha) = i/8, cosine of incidence j/8")
if(C_COMPILER AND NOT C_COMPILER MATCHES "cl(.exe)?$")
    file(WRITE ${OUT}/use.c "#include \"rough-glass.h\"\n"
        "int main(void)\n{\n    return !(rough_glass[0][4] == 1.0f && rough_glass[8][8] < 1.0f &&\n"
        "             rough_glass_average[8] < rough_glass_average[2] &&\n"
        "             rough_glass_other_side_average[8] > 0.0f);\n}\n")
    execute_process(COMMAND ${C_COMPILER} ${OUT}/use.c -o ${OUT}/use RESULT_VARIABLE status ERROR_VARIABLE errors)
    expect("the array does not compile: ${errors}" status EQUAL 0)
    execute_process(COMMAND ${OUT}/use RESULT_VARIABLE status)
    expect("the array holds other numbers" status EQUAL 0)
endif()
run(0 ggx ${coarse} --alpha 0.5 --theta 30 -o -)
expect("-o - prints ${output}" output MATCHES "^distribution,[^ ]+\n\"ggx\",0,1,0.5,30,[^ ]+\n$")
run(0 ggx ${coarse} --c - --size 2)
expect("--c - prints ${output}" output MATCHES "^/[*] Directional albedo ")
has(output "static const float albedo[2][2] = {")

# ---- wrong use ----------------------------------------------------------------------------------

run(2)
has(errors "exactly one is needed")
run(2 ggx --family ggx)
run(2 ggx --eta 1)
has(errors "farther than 0.001 from 1")
run(2 ggx --eta 0.001)
run(2 ggx --alpha 5)
run(2 ggx --theta 91)
run(2 ggx --columns 7)
run(2 ggx --size 1)
run(2 ggx -o none.txt)
has(errors "must end in .csv")
run(2 ggx -o same.csv --c same.csv)
has(errors "-o and --c both name 'same.csv'")
run(2 ggx -o - --c -)
run(2 ggx --c same.h --save same.h)
run(2 ggx --save -)
run(2 missing.vndf -o none.csv --c none.h --save none.albedo)
run(2 ggx -o none.csv --c no-such-folder/none.h)
file(GLOB names RELATIVE ${OUT} ${OUT}/none* ${OUT}/same*)
expect("there are files that should not be: ${names}" "none${names}" STREQUAL "none")

if(failures)
    message(FATAL_ERROR "${failures} failed")
endif()
