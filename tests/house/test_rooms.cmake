# The order of the house, which src/README.md draws: a folder includes its own headers, those of include/, and those of
# the folders that its line below names. The run time (core to bsdf) does not know vndf_build.h, tools/ know of src/
# some headers of core/ alone, and src/ takes from the system the headers of the C library, but for what is stated
# below. No line of a source is longer than 120 columns.
cmake_minimum_required(VERSION 3.16)

# The kernel knows of a table what it reads while it draws, its numbers; the certificate measures what the run time
# draws, hence fit uses the sampler.
set(order_src
    "core:" "math: core" "table: core" "table/family: core table"
    "kernel: core table" "sampler: core table table/family kernel" "sampler/batch: core table kernel sampler"
    "bsdf: core math table kernel sampler"
    "source: core math table" "source/interval: core math source" "source/formula: core math source source/interval"
    "source/family: core math source source/formula source/interval"
    "fit/profile: core math source"
    "fit: core math table table/family kernel sampler source fit/profile")
set(order_tools
    "cli:" "draw: cli" "bake: cli draw" "render: cli draw" "export: draw" "measured: cli render"
    "evidence/measure: cli" "evidence/methods: evidence" "evidence: cli evidence/measure"
    "judge: cli evidence/measure" "judge/examples:"
    "commands/parts: cli draw export"
    "commands: cli draw bake evidence evidence/measure render export measured judge commands/parts")
set(run_time "^(core|math|table|kernel|sampler|bsdf)/")
# What tools/ share with src/ beside include/, which knows nothing of distributions, their own top, and what the build
# writes.
set(shared core/cursor.h core/replace_file.h core/checksum.h core/nearest.h command.h exported_kernel.h)
set(tools_ cli) # main.c and command.h
# What is not in the C library, and where src/ may use it: a file that is replaced keeps its mode and links and is
# flushed to the disk; lanes are the processor's own.
set(system "<(sys/[a-z]+|unistd|fcntl|dirent|pthread|windows|io|[a-z]*intrin)[.]h>")
set(allowed "^core/[^ ]+ (sys/stat|unistd|fcntl)$|^kernel/[^ ]+ [ei]mmintrin$")

file(GLOB public RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h)
foreach(tower src tools)
    foreach(line IN LISTS order_${tower})
        string(REGEX MATCH "^([^:]+):(.*)$" line "${line}")
        separate_arguments(${tower}_${CMAKE_MATCH_1} UNIX_COMMAND "${CMAKE_MATCH_1} ${CMAKE_MATCH_2}")
    endforeach()
    file(GLOB_RECURSE files RELATIVE ${SOURCE}/${tower} ${SOURCE}/${tower}/*.c ${SOURCE}/${tower}/*.h)
    if(NOT files)
        message(FATAL_ERROR "no sources under ${SOURCE}/${tower}")
    endif()
    foreach(file IN LISTS files)
        get_filename_component(folder ${file} DIRECTORY)
        if(NOT DEFINED ${tower}_${folder})
            message(SEND_ERROR "${tower}/${file}: tests/house/test_rooms.cmake has no line for its folder")
        endif()
        file(STRINGS ${SOURCE}/${tower}/${file} lines REGEX "^[ \t]*#[ \t]*include")
        foreach(line IN LISTS lines)
            if(line MATCHES "\"(.+)\"")
                set(name ${CMAKE_MATCH_1})
                get_filename_component(its ${name} DIRECTORY)
                if(name IN_LIST public)
                    if(name STREQUAL "vndf_build.h" AND tower STREQUAL src AND file MATCHES "${run_time}")
                        message(SEND_ERROR "src/${file}: the run time must not include vndf_build.h")
                    endif()
                elseif(NOT (tower STREQUAL tools AND name IN_LIST shared)
                        AND NOT (its IN_LIST ${tower}_${folder} AND EXISTS ${SOURCE}/${tower}/${name}))
                    message(SEND_ERROR "${tower}/${file} must not include \"${name}\": a name carries its folder, "
                        "which is one of {${${tower}_${folder}}}, or include/; tools/ may have {${shared}}, too")
                endif()
            elseif(tower STREQUAL src AND line MATCHES "${system}")
                if(NOT "${file} ${CMAKE_MATCH_1}" MATCHES "${allowed}")
                    message(SEND_ERROR "src/${file}: this is not of the C library: ${line}")
                endif()
            endif()
        endforeach()
    endforeach()
endforeach()

string(REPEAT "." 121 too_long)
file(GLOB_RECURSE files ${SOURCE}/src/*.[ch] ${SOURCE}/tools/*.[ch] ${SOURCE}/tests/*.[ch] ${SOURCE}/include/*.h*
    ${SOURCE}/tests/*.cmake ${SOURCE}/*/CMakeLists.txt)
foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "^${too_long}")
    if(lines)
        message(SEND_ERROR "${file}: longer than 120 columns:\n${lines}")
    endif()
endforeach()
