# `vndf bench`: the rows that are asked for and no others, CSV and Markdown of one shape, refusals. Times
# themselves are not judged; --seconds 0.1 makes as few turns as there may be.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

set(command_words bench)

# ---- refusals -----------------------------------------------------------------------------------

run(2 --seconds 0)
has(errors "--seconds")
run(2 --only no-such-method)
has(errors "vndf bench: no method, distribution or instruction set has 'no-such-method' in its name")
run(2 --family ggx --slope "exp(-r)")
has(errors "more than one of --ndf, --slope, --csv and --family")
run(2 --family nonsense --seconds 0.1)
has(errors "vndf bench: ")
run(2 --family ggx --set a=3)
has(errors "--set is for --ndf and --slope")
run(2 --csv missing.csv)
has(errors "missing.csv")
run(2 ggx)
run(2 -o a.csv -o a.csv)
has(errors "names 'a.csv' twice")
run(2 --only ggx --seconds 0.1 -o no-folder/a.csv)
has(errors "no-folder/a.csv")
file(GLOB left ${OUT}/*)
expect("refusals left ${left}" NOT left)
# ---- the closed forms ---------------------------------------------------------------------------

run(0 --only ggx --seconds 0.1 -o rows.csv --format md)
expect("progress without a terminal: '${errors}'" NOT errors MATCHES ".")
split("${output}" lines)
list(LENGTH lines line_count)
file(READ ${OUT}/rows.csv csv)
split("${csv}" rows)
list(LENGTH rows row_count)
list(GET rows 0 head)
expect("head of the CSV: ${head}" head STREQUAL "method,distribution,instructions,kind,memory,file_bytes,moments,wrong,\
ns,ns_low,ns_high,shared_ns,latency_ns,ratio,tv,tv_theta,tv_below,max_weight,stratified,\
efficiency_60,efficiency_85,efficiency_light,bias_60,bias_85")
list(REMOVE_AT rows 0)
set(numbers "(,(-?[0-9.e+-]+|inf)?)+")
set(sets "scalar|portable|avx2|avx512")
foreach(row IN LISTS rows)
    expect("shape of ${row}" row MATCHES
        "^\"[^\"]+\",\"ggx\",(${sets}),(published|closed|exported|call),0,0,0,0${numbers}$")
    string(REGEX REPLACE "\"[^\"]*\"" "text" plain "${row}")
    string(REGEX MATCHALL "," commas "${plain}")
    list(LENGTH commas comma_count)
    expect("${row} has ${comma_count} commas, not 23" comma_count EQUAL 23)
endforeach()
list(GET rows 0 caps)
expect("the yardstick's ratio to itself: ${caps}" caps MATCHES
    "^\"spherical caps .2023.\",\"ggx\",scalar,published,0,0,0,0,([^,]*,)([^,]*,)([^,]*,)([^,]*,)([^,]*,)1,")
foreach(line IN LISTS lines)
    if(line MATCHES "^[|]")
        string(REGEX MATCHALL "[|]" bars "${line}")
        list(LENGTH bars bar_count)
        expect("${line} has ${bar_count} bars, not 19" bar_count EQUAL 19)
    endif()
endforeach()
foreach(method "spherical caps (2023) | scalar" "spherical caps (2023), batch | portable"
        "GGX disc (2018) | scalar" "all normals (2007) | scalar"
        "closed form | scalar" "closed form, batch | portable" "closed form: diagonal | scalar"
        "closed form: affine | scalar" "closed form: two lobes | scalar" "closed form: affine, batch | portable"
        "closed form: two lobes, batch | portable")
    has(output "| ggx | ${method} |")
endforeach()

# ---- a distribution of one's own ----------------------------------------------------------------

run(0 --slope "exp(-a*r)" --set a=3 --only "table 2 KiB, 4 moments" --seconds 0.1 -o -)
split("${output}" rows)
foreach(instructions scalar portable) # bytes in memory, then of the file, which is smaller
    expect("a table, ${instructions}: ${output}" output MATCHES
        "--slope 'exp.-a.r.' --set a=3.,${instructions},table,[0-9]+,(19|20)[0-9][0-9],4,0,")
endforeach()
expect("rows that were not asked for: ${output}" NOT output MATCHES "8 KiB|3 moments|caps|all normals")
run(0 --slope "exp(-r)" --only "two lobes" --seconds 0.1 -o -)
foreach(row "closed form: two lobes\",\"ggx\",scalar,call,0,0,0,0"
        "closed form: two lobes\",\"beckmann\",scalar,call,0,0,0,0"
        "table 8 KiB, 4 moments: two lobes\",\"--slope 'exp(-r)'\",scalar,call,")
    has(output "${row}")
endforeach()
run(0 --only beckmann --seconds 0.1)
has(output "Newton on erf (2014)")
has(output "latency")
expect("rows that were not asked for: ${output}" NOT output MATCHES "student|GGX")
file(GLOB left RELATIVE ${OUT} ${OUT}/*)
expect("left: ${left}" left STREQUAL "rows.csv")

if(failures)
    message(FATAL_ERROR "${failures} failed")
endif()
