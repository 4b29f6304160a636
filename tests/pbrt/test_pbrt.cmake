# The distribution of tools/pbrt, by a C++ compiler against a stand-in for pbrt's vectors, does what distribution.cpp
# says. Noticed: directions that are not turned up, a density for another, roughness exchanged.
cmake_minimum_required(VERSION 3.16)

if(NOT CXX_COMPILER OR CXX_COMPILER MATCHES "cl(.exe)?$" OR SANITIZE)
    message("SKIPPED: no C++ compiler with the options of gcc was found, or there are sanitizers")
    return()
endif()
file(MAKE_DIRECTORY ${OUT})
execute_process(COMMAND ${CXX_COMPILER} -std=c++17 -O2 -Wall -Wextra -Wpedantic -Werror -I${SOURCE}/tests/pbrt/stand_in
    -I${SOURCE}/tools/pbrt -I${SOURCE}/include -I${SOURCE}/tests "-DVNDF_SOURCE_DIR=\"${SOURCE}\""
    ${SOURCE}/tests/pbrt/distribution.cpp -o ${OUT}/distribution ${STATIC_LIBRARY} -lm -lpthread
    COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT}/distribution RESULT_VARIABLE bad)
if(bad)
    message(FATAL_ERROR "the distribution is not what its interface says")
endif()
