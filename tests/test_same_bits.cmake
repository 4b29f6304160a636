# The run time gives the same bits for a table whatever compiled it: gcc and clang where they are found,
# from no optimisation to everything that this machine's processor has. Only the rooms of the run time
# are compiled here, so they do not need the offline ones.
cmake_minimum_required(VERSION 3.16)

file(GLOB tables ${SOURCE}/tables/*.vndf)
if(NOT tables)
    message(FATAL_ERROR "no tables in ${SOURCE}/tables")
endif()
set(sources ${SOURCE}/tests/same_bits.c)
foreach(room core math table sampler)
    file(GLOB room_sources ${SOURCE}/src/${room}/*.c)
    list(APPEND sources ${room_sources})
endforeach()

set(compilers ${C_COMPILER})
foreach(name gcc clang)
    find_program(found_${name} ${name})
    if(found_${name})
        list(APPEND compilers ${found_${name}})
    endif()
endforeach()
list(REMOVE_DUPLICATES compilers)

file(MAKE_DIRECTORY ${OUT})
separate_arguments(arithmetic UNIX_COMMAND "${ARITHMETIC}")
set(first "")
foreach(compiler IN LISTS compilers)
    foreach(level "-O0" "-O2" "-O3 -march=native")
        separate_arguments(flags UNIX_COMMAND "${level}")
        execute_process(
            COMMAND ${compiler} -std=c11 ${flags} ${arithmetic} -I${SOURCE}/src -I${SOURCE}/include
                ${sources} -o ${OUT}/same_bits -lm
            RESULT_VARIABLE status ERROR_VARIABLE errors)
        if(NOT status EQUAL 0)
            message(FATAL_ERROR "${compiler} ${level} cannot build the run time:\n${errors}")
        endif()
        execute_process(COMMAND ${OUT}/same_bits ${tables}
            RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
        if(NOT status EQUAL 0)
            message(FATAL_ERROR "built by ${compiler} ${level}, the program failed:\n${output}${errors}")
        elseif(first STREQUAL "")
            set(first "${output}")
            set(reference "${compiler} ${level}")
        elseif(NOT output STREQUAL first)
            message(SEND_ERROR "${compiler} ${level} gives\n${output}and ${reference} gave\n${first}")
        endif()
        message("${compiler} ${level}: done")
    endforeach()
endforeach()
