# `vndf albedo` prints what its help says: E that falls with roughness, as text and as a CSV with one row for each angle
# and roughness; and refuses wrong words without leaving a file behind.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

set(command_words albedo)

# From straight above GGX of alpha 1 keeps 1 - log 2 = 0.30685.
run(0 ggx --alpha 0,1 --theta 0,90)
has(output "ggx, mirror\n")
expect("albedo prints ${output}" output MATCHES
    "\n      0   (1.00000|0.9999.)   0.306[89].\n     90   1.00000   1.00000\naverage")
run(0 beckmann --eta 1.5 --alpha 0.3)
has(output "beckmann, dielectric, eta 1.5\n")
has(output "albedo, from the other side")

run(0 ggx --eta 1.5 --alpha 0.2,1 --theta 0,45,80 -o glass.csv)
has(output "dielectric")
file(STRINGS ${OUT}/glass.csv lines)
list(LENGTH lines count)
expect("glass.csv has ${count} lines, not 13" count EQUAL 13)
list(GET lines 0 header)
expect("glass.csv begins with ${header}" header STREQUAL "distribution,eta,side,alpha,theta,albedo,average")
list(GET lines 12 last)
expect("glass.csv ends with ${last}" last MATCHES "^\"ggx\",1.5,-1,1,80,0[.][0-9]+,0[.][0-9]+$")
run(0 ggx --alpha 0.5 --theta 30 -o -)
expect("-o - prints ${output}" output MATCHES "^distribution,[^ ]+\n\"ggx\",0,1,0.5,30,[^ ]+\n$")

run(2)
has(errors "FILE|ggx|beckmann is missing")
run(2 ggx --eta 1 -o none.csv)
has(errors "farther than 0.001 from 1")
run(2 ggx --eta 0.001)
run(2 ggx --alpha 5)
run(2 ggx --theta 91)
run(2 ggx -o none.txt)
has(errors "must end in .csv, .md or .json")
run(2 missing.vndf -o none.csv)
run(2 ggx -o no-such-folder/none.csv)
file(GLOB names RELATIVE ${OUT} ${OUT}/none*)
expect("there are files that should not be: ${names}" "none${names}" STREQUAL "none")

if(failures)
    message(FATAL_ERROR "${failures} failed")
endif()
