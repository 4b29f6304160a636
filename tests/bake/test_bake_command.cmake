# `vndf bake` writes the tables it is asked for in the forms it is asked for, the same bytes twice, and a page; refuses
# wrong words with status 2 and a folder with other files in it, and leaves nothing behind. It ends with
# a verdict.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

set(command_words bake)

run(0 ggx --what dfg,prefilter --size 8 -o one)
has(output "largest error")
run(0 ggx --what dfg,prefilter --size 8 --json -o two)
has(output "\"name\": \"dfg\"")
file(GLOB names RELATIVE ${OUT}/one ${OUT}/one/*)
list(LENGTH names count)
expect("one has ${names}" count EQUAL 13)
foreach(name IN LISTS names)
    file(SHA256 ${OUT}/one/${name} a)
    file(SHA256 ${OUT}/two/${name} b)
    expect("${name} differs the second time" a STREQUAL b)
endforeach()
# A header of 128 bytes and three numbers of four bytes for 64 texels; 148 bytes and four of two.
foreach(form "npy 896 934e554d50590100" "dds 660 444453207c000000")
    string(SUBSTRING ${form} 0 3 type)
    file(SIZE ${OUT}/one/dfg.${type} size)
    file(READ ${OUT}/one/dfg.${type} magic LIMIT 8 HEX)
    expect("dfg.${type}: ${size} bytes, ${magic}" "${type} ${size} ${magic}" STREQUAL "${form}")
endforeach()
file(READ ${OUT}/one/dfg.h header)
has(header "static const float dfg[192] = {")
has(header "// made by: vndf bake ggx --what dfg,prefilter --size 8")
file(READ ${OUT}/one/dfg.glsl shader)
has(shader "const float dfg[192] = float[192](")
file(READ ${OUT}/one/index.html page)
has(page "dfg.png")

run(0 ggx --what ltc --size 4 --format js -o one -q)
expect("-q prints ${output}" "x${output}" STREQUAL "x")
run(0 ${SOURCE}/tables/hazy.vndf --what ltc --size 8 --format npy -o haze)
file(GLOB names RELATIVE ${OUT}/haze ${OUT}/haze/*)
list(LENGTH names count)
expect("haze has ${names}" count EQUAL 5)

has(output "\nverdict good to ship\n")
execute_process(COMMAND ${VNDF} build --slope "exp(-3*r)*(1+0.8*cos(6*r))" -q -o rings.vndf WORKING_DIRECTORY ${OUT})
run(0 rings.vndf --what ltc --size 8 --format npy -o rings) # no transformed cosine resembles a ring of light
expect("${output}" output MATCHES "\nverdict doubtful: ltc_inverse is 0.3[0-9]* off in the mean, [^\n]*\n$")
expect("on stderr: ${errors}" errors MATCHES "vndf bake: doubtful: ltc_inverse is ")

file(MAKE_DIRECTORY ${OUT}/full)
file(WRITE ${OUT}/full/notes.txt "mine")
answers(2 "-o DIR is missing" bake ggx)
answers(2 "did you mean 'dfg'?" bake ggx --what dgf -o none)
answers(2 "--format" bake ggx --format jpg -o none)
answers(2 "--size" bake ggx --size 3 -o none)
answers(2 "--shape" bake ggx --shape blender -o none)
answers(2 "missing.vndf" bake missing.vndf -o none)
answers(2 "has files in it" bake ggx --what prefilter -o full)
file(GLOB names ${OUT}/none)
expect("there is ${names}" "none${names}" STREQUAL "none")

# The example in GLSL compiles, where there is a compiler.
find_program(GLSLANG glslangValidator)
if(GLSLANG)
    execute_process(COMMAND ${GLSLANG} ${SOURCE}/tools/bake/examples/haze.frag RESULT_VARIABLE status
        OUTPUT_VARIABLE output)
    expect("haze.frag: ${output}" status EQUAL 0)
endif()
