# Every file includes only what stands below its room: the order of the rooms under src/, and tools/ on
# include/ alone. The run time (core, math, table, sampler, bsdf) does not know vndf_build.h. Only headers of
# the C library are used in src/, but for what is stated below.
cmake_minimum_required(VERSION 3.16)

set(rooms core math table sampler bsdf quadrature distribution build)
set(below_core "")
set(below_math core)
set(below_table core math)
set(below_sampler core math table)
set(below_bsdf core math table sampler)
set(below_quadrature "")
set(below_distribution core math quadrature)
# The certificate is measured with the run time itself, hence the sampler.
set(below_build core math quadrature distribution table sampler)

set(run_time core math table sampler bsdf)
set(c_library assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign
    stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype)

# Saving a table keeps modes and links and flushes to the disk, which the C library has no calls for.
set(system_build fcntl sys/stat unistd)
# Lanes are the processor's own.
set(system_math immintrin)

file(GLOB public RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h)

# Checks one name between quotes, included by a file of src/ROOM.
function(check_quoted room name where)
    if(name IN_LIST public)
        if(name STREQUAL "vndf_build.h" AND room IN_LIST run_time)
            message(SEND_ERROR "${where}: src/${room} belongs to the run time and must not include vndf_build.h")
        endif()
    elseif(NOT name MATCHES "^([a-z]+)/[^/]+$")
        message(SEND_ERROR "${where}: \"${name}\" should carry its room, as in \"core/error.h\"")
    elseif(NOT CMAKE_MATCH_1 STREQUAL room AND NOT CMAKE_MATCH_1 IN_LIST below_${room})
        list(JOIN below_${room} ", " below)
        message(SEND_ERROR "${where}: src/${room} must not include \"${name}\"; "
            "it may use its own headers, include/ and the rooms {${below}}")
    endif()
endfunction()

function(check_angled room name where)
    string(REGEX REPLACE "\\.h$" "" stem "${name}")
    if(NOT stem IN_LIST c_library AND NOT stem IN_LIST system_${room})
        message(SEND_ERROR "${where}: <${name}> is not a header of the C library")
    endif()
endfunction()

# tools/ include the public headers, their own headers and the system's.
function(check_tool name where)
    if(NOT name IN_LIST public AND NOT EXISTS ${SOURCE}/tools/${name})
        message(SEND_ERROR "${where}: tools/ must not include \"${name}\", only headers of include/ and tools/")
    endif()
endfunction()

# Finds the #include lines of a file and passes each to the check of its place.
function(check_file file)
    file(READ ${SOURCE}/${file} text)
    string(REGEX REPLACE "[][;\\]" " " text "${text}") # these would change how CMake splits the text
    string(REPLACE "\n" ";" lines "${text}")
    set(number 0)
    foreach(line IN LISTS lines)
        math(EXPR number "${number} + 1")
        if(line MATCHES "^[ \t]*#[ \t]*include[ \t]*([\"<])([^\">]+)[\">]")
            set(bracket "${CMAKE_MATCH_1}")
            set(name "${CMAKE_MATCH_2}")
            if(file MATCHES "^tools/" AND bracket STREQUAL "\"")
                check_tool(${name} ${file}:${number})
            elseif(file MATCHES "^src/([^/]+)/" AND bracket STREQUAL "\"")
                check_quoted(${CMAKE_MATCH_1} ${name} ${file}:${number})
            elseif(file MATCHES "^src/([^/]+)/")
                check_angled(${CMAKE_MATCH_1} ${name} ${file}:${number})
            endif()
        endif()
    endforeach()
endfunction()

file(GLOB_RECURSE files RELATIVE ${SOURCE}
    ${SOURCE}/src/*.c ${SOURCE}/src/*.h ${SOURCE}/tools/*.c ${SOURCE}/tools/*.h)
list(LENGTH files count)
if(count LESS 2)
    message(FATAL_ERROR "no sources under ${SOURCE}")
endif()
foreach(file IN LISTS files)
    if(file MATCHES "^src/([^/]+)/[^/]+$" AND CMAKE_MATCH_1 IN_LIST rooms OR file MATCHES "^tools/((render|compare)/)?[^/]+$")
        check_file(${file})
    else()
        list(JOIN rooms ", " names)
        message(SEND_ERROR "${file}: not in a room; a source lies in tools/ or in one of src/ {${names}}, "
            "and tests/test_rooms.cmake states what a new room may include")
    endif()
endforeach()
message("${count} files in order")
