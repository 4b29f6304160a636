# A small program in LANGUAGE (C or CXX) builds against vndf and runs: found by WAY = find_package or
# pkg_config in the copy that the test `install` installed, or added as a subdirectory of its project: then the
# library compiles without a warning, not optimised.
cmake_minimum_required(VERSION 3.16)

if(SANITIZE)
    message("SKIPPED: a program without sanitizers cannot load a library with them (${SANITIZE})")
    return()
elseif(NOT ${LANGUAGE}_COMPILER)
    message("SKIPPED: no ${LANGUAGE} compiler was found")
    return()
elseif(WAY STREQUAL "pkg_config" AND NOT PKG_CONFIG)
    message("SKIPPED: no pkg-config was found")
    return()
endif()

function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${what} failed (${status}):\n${output}${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

# The program itself checks what it draws; its output names the version it was compiled with.
function(run_consumer program)
    run("the consumer" ${program})
    message("${output}")
    if(NOT output MATCHES "^vndf ${VERSION}: [-0-9.]+ [-0-9.]+ [-0-9.]+ pdf [0-9.]+\n$")
        message(FATAL_ERROR "the consumer printed something unexpected")
    endif()
endfunction()

function(build_with_cmake)
    file(REMOVE_RECURSE ${OUT})
    run("configuring" ${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer -B ${OUT} -G ${GENERATOR} -DWAY=${WAY}
        -DLANGUAGE=${LANGUAGE} -DVNDF_SOURCE=${SOURCE} -DCMAKE_PREFIX_PATH=${PREFIX}
        -DCMAKE_BUILD_TYPE=Debug -DVNDF_WERROR=ON
        -DCMAKE_${LANGUAGE}_COMPILER=${${LANGUAGE}_COMPILER} -DCMAKE_C_COMPILER=${C_COMPILER})
    run("building" ${CMAKE_COMMAND} --build ${OUT} --config Debug)
    foreach(library shared static)
        file(GLOB_RECURSE program ${OUT}/bin/consumer_${library} ${OUT}/bin/consumer_${library}.exe)
        run_consumer(${program})
    endforeach()
endfunction()

function(build_with_pkg_config)
    file(GLOB_RECURSE pc ${PREFIX}/*/vndf.pc)
    get_filename_component(dir ${pc} DIRECTORY)
    set(ENV{PKG_CONFIG_PATH} ${dir})
    run("pkg-config --static" ${PKG_CONFIG} --static --libs vndf)
    if(NOT output MATCHES "-lm")
        message(FATAL_ERROR "pkg-config --static --libs should name -lm, it prints: ${output}")
    endif()
    run("pkg-config" ${PKG_CONFIG} --cflags --libs vndf)
    separate_arguments(flags UNIX_COMMAND "${output}")
    set(extension c)
    if(LANGUAGE STREQUAL "CXX")
        set(extension cpp)
    endif()
    file(MAKE_DIRECTORY ${OUT})
    get_filename_component(libdir ${dir} DIRECTORY)
    run("compiling" ${${LANGUAGE}_COMPILER} ${SOURCE}/tests/consumer/consumer.${extension} -o ${OUT}/consumer
        ${flags} -Wl,-rpath,${libdir})
    run_consumer(${OUT}/consumer)
endfunction()

if(WAY STREQUAL "pkg_config")
    build_with_pkg_config()
else()
    build_with_cmake()
endif()
