# Builds the tables of recipes.txt, then writes manifest.csv from what `vndf info` says of each.
#
#   cmake -DVNDF=path/of/vndf [-DOUT=folder] -P tables/make.cmake
#
# Without OUT they go to this folder, which is what the target `tables` does when it is asked for by name; the
# test `tables` gives a folder of its own. The program runs here, so that a table names its CSV without a path.
cmake_minimum_required(VERSION 3.16)

if(NOT DEFINED VNDF)
    message(FATAL_ERROR "-DVNDF=... is missing: the program to build with; see the head of make.cmake")
endif()
if(NOT DEFINED OUT)
    set(OUT ${CMAKE_CURRENT_LIST_DIR})
endif()
file(MAKE_DIRECTORY ${OUT})

set(columns tv tv_theta tv_above tv_above_theta max_weight weight_bounded area_error consistency ndf_error hidden finest
    horizon_power)

# vndf(VARIABLE words...): runs the program; what it prints goes to the variable.
function(vndf output)
    execute_process(COMMAND ${VNDF} ${ARGN} WORKING_DIRECTORY ${CMAKE_CURRENT_LIST_DIR}
        RESULT_VARIABLE status OUTPUT_VARIABLE printed)
    if(NOT status EQUAL 0)
        list(JOIN ARGN " " words)
        message(FATAL_ERROR "vndf ${words}: exit status ${status}")
    endif()
    set(${output} "${printed}" PARENT_SCOPE)
endfunction()

# What a line says behind its key: a value and its unit.
function(value_of key lines result)
    if(NOT "\n${lines}" MATCHES "\n${key} ([^\n]*)\n")
        message(FATAL_ERROR "vndf info prints no ${key}:\n${lines}")
    endif()
    set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# The checksum that a table ends with (little-endian there); `vndf info` refuses a file where it is wrong.
function(checksum_of file result)
    file(SIZE ${file} size)
    math(EXPR place "${size} - 4")
    file(READ ${file} hex OFFSET ${place} HEX)
    string(REGEX REPLACE "(..)(..)(..)(..)" "\\4\\3\\2\\1" hex "${hex}")
    set(${result} ${hex} PARENT_SCOPE)
endfunction()

function(manifest_row file command result)
    vndf(info info ${OUT}/${file})
    file(SIZE ${OUT}/${file} bytes)
    checksum_of(${OUT}/${file} checksum)
    value_of(tool "${info}" tool)
    set(row "${file},\"${command}\",${bytes},${checksum},${tool}")
    foreach(column IN LISTS columns)
        value_of(${column} "${info}" value)
        string(REGEX REPLACE " .*" "" value "${value}")
        string(REPLACE "yes" "1" value "${value}")
        string(REPLACE "no" "0" value "${value}")
        string(APPEND row ",${value}")
    endforeach()
    set(${result} "${row}" PARENT_SCOPE)
endfunction()

file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/recipes.txt recipes REGEX "^[^#]")
list(JOIN columns "," manifest)
string(PREPEND manifest "file,command,bytes,crc32,tool,")
foreach(recipe IN LISTS recipes)
    if(NOT recipe MATCHES "^([-.a-z0-9]+\\.vndf) +([^ ;\"].*)$")
        message(FATAL_ERROR "recipes.txt: a recipe is FILE.vndf ARGUMENTS, without ; and \", not\n${recipe}")
    endif()
    set(file ${CMAKE_MATCH_1})
    set(arguments "${CMAKE_MATCH_2}")
    separate_arguments(words UNIX_COMMAND "${arguments}")
    vndf(built build ${words} -o ${OUT}/${file})
    value_of(tv "${built}" tv)
    message("${file}: tv ${tv}")
    manifest_row(${file} "vndf build ${arguments} -o ${file}" row)
    string(APPEND manifest "\n${row}")
endforeach()
file(WRITE ${OUT}/manifest.csv "${manifest}\n")
