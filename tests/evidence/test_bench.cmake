# `vndf bench` and `vndf bench effects`: the rows that are asked for and no others, CSV, JSON and Markdown of one shape,
# refusals. Times themselves are not judged; few seconds make as few turns as there may be. And `vndf check` passes a
# ring so narrow that floats hardly tell its slopes apart.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

# refuses(TEXT WORDS...): status 2 and this complaint
macro(refuses text)
    run(2 ${ARGN})
    has(errors "${text}")
endmacro()

# counts(LINES PREFIX CHARACTER COUNT): outside quotes, in every line that begins with PREFIX
macro(counts lines prefix character wanted)
    foreach(line IN LISTS ${lines})
        if(line MATCHES "^${prefix}")
            string(REGEX REPLACE "\"[^\"]*\"" "text" plain "${line}")
            string(REGEX MATCHALL "${character}" found "${plain}")
            list(LENGTH found count)
            expect("${count}, not ${wanted}, of ${character} in ${line}" ${count} EQUAL ${wanted})
        endif()
    endforeach()
endmacro()

set(command_words bench)
refuses("--seconds" --seconds 0)
refuses("vndf bench: no method, distribution or instruction set has 'bilinaer' in its name; did you mean 'bilinear'?"
    --only bilinaer)
refuses("--slope and --family are given; only one" --family ggx --slope "exp(-r)")
refuses("vndf bench: " --family nonsense --seconds 0.1)
refuses("missing.csv" --csv missing.csv)
refuses("no-folder/a.csv" --only ggx --seconds 0.1 -o no-folder/a.csv)
set(command_words bench effects)
refuses("--theta" --theta 90)
refuses("--alpha" --alpha 0.5,nonsense)
refuses("vndf bench effects: no set of effects, distribution or instruction set has 'no-such-effect'"
    --distribution ggx --only no-such-effect)
refuses("missing.vndf" --distribution missing.vndf)
file(GLOB left ${OUT}/*)
expect("refusals left ${left}" NOT left)

# ---- normals ------------------------------------------------------------------------------------

set(head "method,distribution,instructions,kind,alpha_x,alpha_y,memory,file_bytes,moments,wrong,ns,spread,ratio,\
shared_ns,eval_ns,pdf_ns,tv,tv_below,max_weight,stratified,efficiency_60,efficiency_85,efficiency_light,\
mean,noise,lost,variance,efficiency")
set(command_words bench)
run(0 --only ggx --seconds 0.1 -o rows.md)
file(READ ${OUT}/rows.md markdown)
split("${markdown}" lines)
counts(lines "[|]" "[|]" 15)
run(0 --only ggx --seconds 0.1 -o rows.csv)
expect("progress without a terminal: '${errors}'" NOT errors MATCHES ".")
has(output "ggx  ")
file(READ ${OUT}/rows.csv csv)
split("${csv}" rows)
list(GET rows 0 caps)
expect("head of the CSV: ${caps}" caps STREQUAL head)
counts(rows "" "," 27)
list(GET rows 1 caps)
expect("the yardstick's ratio to itself: ${caps}" caps MATCHES
    "^\"spherical caps .2023.\",\"ggx\",scalar,published,,,0,,,0,([^,]*,)([^,]*,)1,")
foreach(method "spherical caps (2023), batch | portable" "all normals (2007) | scalar" "closed form | scalar"
        "closed form, batch | portable" "closed form: affine | scalar" "closed form: mixture, batch | portable")
    has(markdown "| ggx | ${method} |")
endforeach()
run(0 --only "caps (2023), batch" --seconds 0.1 --json)
expect("JSON: ${output}" output MATCHES
    "^.\n{\"method\": \"spherical caps .2023., batch\", \"distribution\": \"ggx\", .*\"memory\": 0, \
\"file_bytes\": null, .*\"wrong\": 0, \"ns\": [0-9.e+]+, .*\"efficiency\": null}\n.\n$")
run(0 --only caps --seconds 0.1 -q)
expect("-q prints ${output}" NOT output MATCHES ".")
run(0 --slope "exp(-a*r)" --set a=3 --only "table 2 KiB, 4 moments" --seconds 0.1 -o -)
foreach(instructions scalar portable) # bytes in memory, then of the file, which is smaller
    expect("a table, ${instructions}: ${output}" output MATCHES
        "--slope 'exp.-a.r.' --set a=3.,${instructions},table,,,[0-9]+,(19|20)[0-9][0-9],4,0,")
endforeach()
expect("rows that were not asked for: ${output}" NOT output MATCHES "8 KiB|3 moments|caps|all normals")
run(0 --slope "exp(-r)" --only "8 KiB, 4 moments" --seconds 0.1 -o -)
foreach(row "table 8 KiB, 4 moments: mixture\",\"--slope 'exp(-r)'\",scalar,call,"
        "table 8 KiB, 4 moments\",\"student-t:2.5\",scalar,table,")
    has(output "${row}")
endforeach()
run(0 --only beckmann --seconds 0.1)
has(output "shared")
expect("rows that were not asked for: ${output}" NOT output MATCHES "student|GGX")
run(0 --only moments --seconds 0.1)
split("${output}" lines)
foreach(line IN LISTS lines)
    string(LENGTH "${line}" length)
    expect("wider than 100 columns: ${line}" NOT length GREATER 100)
endforeach()

# ---- effects ------------------------------------------------------------------------------------

set(command_words bench effects)
run(0 --distribution ggx --only masking --seconds 0.01)
foreach(set "separable masking" "V-cavity masking" "no masking")
    has(output "  ${set} ")
endforeach()
expect("rows that were not asked for: ${output}" NOT output MATCHES "\n  bare reflection|walk|both lobes")
run(0 --distribution ggx --distribution beckmann --seconds 0.01 -o rows.md -q)
file(READ ${OUT}/rows.md markdown)
split("${markdown}" lines)
counts(lines "[|]" "[|]" 16)
has(markdown "| beckmann | walk, both lobes |")
run(0 --distribution ggx --distribution beckmann --seconds 0.01 -o rows.csv -q)
file(READ ${OUT}/rows.csv csv)
split("${csv}" rows)
counts(rows "" "," 27)
list(LENGTH rows row_count)
expect("${row_count} rows, not 57: a head, 28 sets of each" row_count EQUAL 57)
expect("a row is wrong: ${csv}" NOT csv MATCHES ",effects,[^,]*,[^,]*,,,,1,")
expect("bare reflection costs more than itself: ${csv}" csv MATCHES
    "\n\"bare reflection\",\"ggx\",scalar,effects,0.5,0.5,,,,0,([^,]*,)([^,]*,)1,")
file(GLOB left RELATIVE ${OUT} ${OUT}/*)
list(REMOVE_ITEM left rows.csv rows.md)
expect("left: ${left}" NOT left)

set(command_words "")
run(0 build --slope "exp(-((r-1)/1e-4)^2)" -o ring.vndf -q)
run(0 check ring.vndf --samples 20000 -q)

if(failures)
    message(FATAL_ERROR "${failures} failed")
endif()
