# cmake --install puts headers, both libraries, the program, its manual page and completions, the tables, the CMake
# package and the pkg-config file under a prefix of the user's choice, and the installed program runs. The consumer
# tests use this copy.
cmake_minimum_required(VERSION 3.16)

file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} --config "${CONFIG}"
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "cmake --install failed:\n${errors}")
endif()

get_filename_component(shared_name ${SHARED_LIBRARY} NAME)
get_filename_component(static_name ${STATIC_LIBRARY} NAME)
get_filename_component(program_name ${VNDF} NAME)
file(GLOB headers RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h ${SOURCE}/include/*.hpp)
file(GLOB tables RELATIVE ${SOURCE}/tables ${SOURCE}/tables/*.vndf)
foreach(name IN ITEMS ${headers} ${tables} ${shared_name} ${static_name} ${program_name}
        vndf.1 vndfConfig.cmake vndfTargets.cmake vndfConfigVersion.cmake vndf.pc)
    file(GLOB_RECURSE found ${PREFIX}/*/${name})
    if(NOT found)
        message(SEND_ERROR "${name} was not installed under ${PREFIX}")
    endif()
endforeach()

if(NOT EXISTS ${PREFIX}/share/bash-completion/completions/vndf)
    message(SEND_ERROR "the completion of bash was not installed under ${PREFIX}/share")
endif()

file(GLOB_RECURSE program ${PREFIX}/bin/${program_name})
execute_process(COMMAND ${program} --version RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0 OR NOT output MATCHES "${VERSION}")
    message(SEND_ERROR "installed `vndf --version` should print ${VERSION}; exit status ${status}, output:\n"
        "${output}")
endif()
