# `vndf bench effects`: the rows that are asked for and no others, CSV and Markdown of one shape, and refusals.
# Times themselves are not judged; --seconds 0.01 makes as few turns as
# there may be.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

set(command_words bench effects)

# ---- refusals -----------------------------------------------------------------------------------

run(2 --seconds 0)
has(errors "--seconds")
run(2 --theta 90)
has(errors "--theta")
run(2 --alpha 0.5,nonsense)
has(errors "--alpha")
run(2 --distribution ggx --only no-such-effect)
has(errors "vndf bench effects: no set of effects or distribution has 'no-such-effect' in its name")
run(2 --distribution missing.vndf)
has(errors "missing.vndf")
run(2 ggx)
has(errors "'ggx' is not expected")
run(2 -o a.csv -o a.csv)
has(errors "names 'a.csv' twice")
run(2 --distribution ggx -o no-folder/a.csv)
has(errors "no-folder/a.csv")
file(GLOB left ${OUT}/*)
expect("refusals left ${left}" NOT left)

# ---- costs --------------------------------------------------------------------------------------

run(0 --help)
has(output "example: vndf bench effects")
run(0 --distribution ggx --only masking --seconds 0.01)
foreach(set "separable masking" "V-cavity masking" "no masking")
    has(output "  ${set} ")
endforeach()
expect("rows that were not asked for: ${output}" NOT output MATCHES "\n  bare reflection|walk|both lobes")
expect("progress without a terminal: '${errors}'" NOT errors MATCHES ".")

run(0 --distribution ggx --distribution beckmann --seconds 0.01 -o rows.csv --format md)
split("${output}" lines)
file(READ ${OUT}/rows.csv csv)
split("${csv}" rows)
list(GET rows 0 head)
expect("head of the CSV: ${head}" head STREQUAL "set,distribution,alpha_x,alpha_y,directions_theta,weight_theta,\
wrong,ns,ns_low,ns_high,to_bare,shared_ns,eval_ns,pdf_ns,mean,noise,lost,max_weight,variance,\
efficiency")
list(REMOVE_AT rows 0)
list(LENGTH rows row_count)
expect("${row_count} rows, not 109: 31 sets of GGX, 30 of Beckmann, 24 of variance each" row_count EQUAL 109)
set(number "[-+.e0-9]+")
foreach(row IN LISTS rows)
    string(REGEX REPLACE "\"[^\"]*\"" "text" plain "${row}")
    expect("${row} has a time that is none, or is wrong" plain MATCHES
        "^text,text,${number},${number},(${number})?,${number},0,${number},${number},${number},")
    string(REGEX MATCHALL "," commas "${plain}")
    list(LENGTH commas comma_count)
    expect("${row} has ${comma_count} commas, not 19" comma_count EQUAL 19)
endforeach()
expect("bare reflection costs more than itself: ${csv}" csv MATCHES
    "\n\"bare reflection\",\"ggx\",0.5,0.5,,60,0,${number},${number},${number},0,")
foreach(line IN LISTS lines)
    string(REGEX MATCHALL "[|]" bars "${line}")
    list(LENGTH bars bar_count)
    if(line MATCHES "^[|] distribution") # the second table
        set(variance_begun 1)
    endif()
    if(line MATCHES "^[|]" AND variance_begun)
        expect("${line} has ${bar_count} bars, not 14" bar_count EQUAL 14)
    elseif(line MATCHES "^[|]")
        expect("${line} has ${bar_count} bars, not 13" bar_count EQUAL 13)
    endif()
endforeach()
has(output "| by hand, without the library |")
has(output "| walk, both lobes |")
has(output "| beckmann | 1 | 85 |")
file(GLOB left RELATIVE ${OUT} ${OUT}/*)
expect("left: ${left}" left STREQUAL "rows.csv")

if(failures)
    message(FATAL_ERROR "${failures} failed")
endif()
