# Builds the tables of recipes.txt.
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
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/recipes.txt recipes REGEX "^[^#]")
foreach(recipe IN LISTS recipes)
    if(NOT recipe MATCHES "^([-.a-z0-9]+\\.vndf) +([^ ;\"].*)$")
        message(FATAL_ERROR "recipes.txt: a recipe is FILE.vndf ARGUMENTS, without ; and \", not\n${recipe}")
    endif()
    set(file ${CMAKE_MATCH_1})
    separate_arguments(words UNIX_COMMAND "${CMAKE_MATCH_2}")
    execute_process(COMMAND ${VNDF} build ${words} -o ${OUT}/${file} WORKING_DIRECTORY ${CMAKE_CURRENT_LIST_DIR}
        RESULT_VARIABLE status OUTPUT_VARIABLE printed)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "vndf build ${CMAKE_MATCH_2}: exit status ${status}")
    endif()
    string(REGEX MATCH "verdict [^\n]*" verdict "${printed}")
    message("${file}: ${verdict}")
endforeach()
