# The order of the house, which src/README.md draws: a room includes rooms below it, a sub-room its own room and
# the sub-rooms that are listed before it. The run time (core to bsdf) does not know vndf_build.h, tools/ know src/
# through include/ and some headers of core/ alone, and src/ takes from the system the headers of the C library, but
# for what is stated below. No line of a source is longer than 120 columns.
cmake_minimum_required(VERSION 3.16)

# A line a room: the room / its sub-rooms, of which each may use those before it : the rooms that it may use. The kernel
# knows of a table what it reads while it draws, its numbers; the certificate measures what the run time draws, hence
# fit uses the sampler.
set(order_src "core:" "math: core" "table / family: core" "kernel: core table" "sampler / batch: core table kernel"
    "bsdf / walk: core math table kernel sampler" "source / interval formula family: core math"
    "fit / profile: core math source table kernel sampler")
set(order_tools "cli:" "draw: cli" "bake: cli draw" "evidence / measure methods page: cli draw" "render: cli draw"
    "export: draw" "measured: cli render" "judge / examples: cli evidence"
    "commands / parts: cli draw bake evidence render export measured judge")
set(run_time core math table kernel sampler bsdf)
# What tools/ share with src/ beside include/, which knows nothing of distributions, and what the build writes.
set(shared core/replace_file.h core/checksum.h core/nearest.h)
set(written exported_kernel.h)
# What is not in the C library, and where src/ may use it: a file that is replaced keeps its mode and links and is
# flushed to the disk; lanes are the processor's own.
set(system "<(sys/[a-z]+|unistd|fcntl|dirent|pthread|windows|io|[a-z]*intrin)[.]h>")
set(allowed "^core/[^ ]+ (sys/stat|unistd|fcntl)$|^kernel/[^ ]+ [ei]mmintrin$")

foreach(tower src tools)
    foreach(line IN LISTS order_${tower})
        string(REGEX MATCH "^([a-z]+)( / ([a-z ]+))?:([a-z ]*)$" line "${line}")
        set(room ${CMAKE_MATCH_1})
        list(APPEND rooms_${tower} ${room})
        separate_arguments(subs_${room} UNIX_COMMAND "${CMAKE_MATCH_3}")
        separate_arguments(below_${room} UNIX_COMMAND "${CMAKE_MATCH_4}")
    endforeach()
endforeach()

# ---- one include --------------------------------------------------------------------------------

file(GLOB public RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h)

# room_of(NAME ROOM SUB): of "room/x.h" or "room/sub/x.h"; SUB is empty for the room itself.
macro(room_of name room sub)
    set(${room} "")
    set(${sub} "")
    if("${name}" MATCHES "^([a-z_]+)/(([a-z_]+)/)?[^/]+$")
        set(${room} ${CMAKE_MATCH_1})
        set(${sub} "${CMAKE_MATCH_3}")
    endif()
endmacro()

# NAME between quotes, included by FILE ("room/sub/x.c") of the tower src or tools.
function(check_quoted tower file name where)
    room_of(${file} room sub)
    room_of("${name}" its_room its_sub)
    if(name IN_LIST public)
        if(name STREQUAL "vndf_build.h" AND tower STREQUAL src AND room IN_LIST run_time)
            message(SEND_ERROR "${where}: src/${room} belongs to the run time and must not include vndf_build.h")
        endif()
        return()
    endif()
    if(tower STREQUAL tools AND (name IN_LIST shared OR name IN_LIST written))
        return()
    endif()
    if(NOT EXISTS ${SOURCE}/${tower}/${name})
        message(SEND_ERROR "${where}: there is no ${tower}/${name}; a name carries its room, as in \"core/error.h\", "
            "and tools/ know src/ through include/ and {${shared}} alone")
    elseif(NOT its_room STREQUAL "" AND NOT room STREQUAL "" AND NOT its_room STREQUAL room
            AND NOT its_room IN_LIST below_${room})
        list(JOIN below_${room} ", " below)
        message(SEND_ERROR "${where}: ${tower}/${room} must not include \"${name}\"; "
            "it may use its own headers, include/ and the rooms {${below}}")
    elseif(its_room STREQUAL room AND NOT sub STREQUAL "" AND NOT its_sub STREQUAL "")
        list(FIND subs_${room} ${sub} mine)
        list(FIND subs_${room} ${its_sub} its)
        if(its GREATER mine)
            message(SEND_ERROR "${where}: ${room}/${sub} must not include \"${name}\", which stands above it in "
                "{${subs_${room}}}")
        endif()
    endif()
endfunction()

# Checks every #include of FILE.
function(check_file tower file)
    file(STRINGS ${SOURCE}/${tower}/${file} lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
        if(line MATCHES "include[ \t]*\"([^\"]+)\"")
            check_quoted(${tower} ${file} ${CMAKE_MATCH_1} ${tower}/${file})
        elseif(tower STREQUAL src AND line MATCHES "${system}")
            if(NOT "${file} ${CMAKE_MATCH_1}" MATCHES "${allowed}")
                message(SEND_ERROR "src/${file}: this is not of the C library: ${line}")
            endif()
        endif()
    endforeach()
endfunction()

# ---- all files ----------------------------------------------------------------------------------

foreach(tower src tools)
    file(GLOB_RECURSE files RELATIVE ${SOURCE}/${tower} ${SOURCE}/${tower}/*.c ${SOURCE}/${tower}/*.h)
    list(LENGTH files count)
    if(count LESS 80)
        message(FATAL_ERROR "${count} sources under ${SOURCE}/${tower}")
    endif()
    foreach(file IN LISTS files)
        room_of(${file} room sub)
        if(NOT "${tower}/${file}" MATCHES "^tools/(main\\.c|command\\.h)$"
                AND (NOT room IN_LIST rooms_${tower} OR NOT (sub STREQUAL "" OR sub IN_LIST subs_${room})))
            message(SEND_ERROR "${tower}/${file}: not in a room; tests/house/test_rooms.cmake states the rooms and "
                "sub-rooms and what each may include")
        endif()
        check_file(${tower} ${file})
    endforeach()
    message("${tower}/: ${count} files in order")
endforeach()

# ---- long lines ---------------------------------------------------------------------------------

string(REPEAT "." 121 too_long)
file(GLOB_RECURSE files ${SOURCE}/src/*.[ch] ${SOURCE}/tools/*.[ch] ${SOURCE}/tests/*.[ch] ${SOURCE}/include/*.h*
    ${SOURCE}/tests/*.cmake ${SOURCE}/*/CMakeLists.txt)
foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "^${too_long}")
    if(lines)
        message(SEND_ERROR "${file}: longer than 120 columns:\n${lines}")
    endif()
endforeach()
