# The shipped tables are what their recipes give: all of tables/recipes.txt is built again, and every table has the same
# bytes.
#
# A build evaluates the distribution with the C library's exp, log and pow, whose last bit depends on the library and
# the processor. A table whose bytes differ passes if it says that it has the same source, and `vndf check` finds its
# certificate true; a line says so.
cmake_minimum_required(VERSION 3.16)

file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CMAKE_COMMAND} -DVNDF=${VNDF} -DOUT=${OUT} -P ${SOURCE}/tables/make.cmake
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "tables/make.cmake fails:\n${output}")
endif()

file(GLOB shipped RELATIVE ${SOURCE}/tables ${SOURCE}/tables/*.vndf)
file(GLOB built RELATIVE ${OUT} ${OUT}/*.vndf)
if(NOT shipped OR NOT shipped STREQUAL built)
    message(FATAL_ERROR "tables/ has\n  ${shipped}\nand its recipes give\n  ${built}")
endif()
set(same 0)
foreach(file IN LISTS shipped)
    file(SHA256 ${SOURCE}/tables/${file} expected)
    file(SHA256 ${OUT}/${file} sum)
    if(sum STREQUAL expected)
        math(EXPR same "${same} + 1")
        continue()
    endif()
    message("${file}: built again it has other bytes, as another C library or processor may give")
    execute_process(COMMAND ${VNDF} check ${SOURCE}/tables/${file} WORKING_DIRECTORY ${SOURCE}/tables
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    foreach(folder ${SOURCE}/tables ${OUT})
        execute_process(COMMAND ${VNDF} info ${folder}/${file} OUTPUT_VARIABLE info)
        string(REGEX MATCH "^source [^\n]+" source_in_${folder} "${info}")
    endforeach()
    if(NOT status EQUAL 0 OR NOT source_in_${OUT} STREQUAL source_in_${SOURCE}/tables)
        message(SEND_ERROR "tables/${file} is not what its recipe gives; if the program was changed on purpose, build "
            "the target `tables`. vndf check says:\n${output}")
    endif()
endforeach()
list(LENGTH shipped count)
message("${same} of ${count} tables are the same bytes")
