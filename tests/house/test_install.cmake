# cmake --install puts headers, both libraries, tables, the CMake package and the pkg-config file under a prefix of the
# user's choice, where the consumer tests find them; and the program, which runs, its manual page and its completion.
cmake_minimum_required(VERSION 3.16)

file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} --config "${CONFIG}"
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
get_filename_component(program ${VNDF} NAME)
execute_process(COMMAND ${PREFIX}/bin/${program} --version RESULT_VARIABLE runs OUTPUT_VARIABLE output)
if(NOT status EQUAL 0 OR NOT runs EQUAL 0 OR NOT output STREQUAL "vndf ${VERSION}\n")
    message(SEND_ERROR "cmake --install: ${status}, ${errors}; the installed `vndf --version`: ${runs}, ${output}")
endif()

foreach(from include/*.h* tables/*.vndf)
    file(GLOB files RELATIVE ${SOURCE} ${SOURCE}/${from})
    list(APPEND names ${files})
endforeach()
foreach(name IN LISTS names ITEMS man1/vndf.1 completions/vndf)
    get_filename_component(last ${name} NAME)
    file(GLOB_RECURSE found ${PREFIX}/*/${last})
    if(NOT found)
        message(SEND_ERROR "${name} was not installed under ${PREFIX}")
    endif()
endforeach()
