# The shared library exports the functions that the headers declare with VNDF_API, all of them and nothing
# else, with a version of symbols, VNDF_0.1; every external symbol of the static library begins with vndf_, and it has
# no variable that can be written.
cmake_minimum_required(VERSION 3.16)

if(NOT NM)
    message("SKIPPED: no nm was found")
    return()
elseif(SANITIZE)
    message("SKIPPED: sanitizers add symbols of their own (${SANITIZE})")
    return()
elseif(NOT SHARED_LIBRARY MATCHES "\\.so(\\.|$)")
    message("SKIPPED: symbols are read from ELF libraries, this is ${SHARED_LIBRARY}")
    return()
endif()

# The names in nm's lines "address letter name"; archives have other lines too, which name their members.
function(read_symbols result)
    execute_process(COMMAND ${NM} ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${NM} ${ARGN} failed:\n${errors}")
    endif()
    string(REGEX MATCHALL "[0-9a-fA-F]+ [A-Za-z] [^\n]+" lines "${output}")
    list(TRANSFORM lines REPLACE "^[0-9a-fA-F]+ [A-Za-z] " "")
    # Older linkers export the bounds of the sections and the hooks of the loader.
    list(REMOVE_ITEM lines _init _fini _edata _end __bss_start)
    set(${result} "${lines}" PARENT_SCOPE)
endfunction()

# The function names after VNDF_API in include/*.h, comments left out.
set(declared "")
file(GLOB headers ${SOURCE}/include/*.h)
foreach(header IN LISTS headers)
    file(READ ${header} text)
    string(REPLACE ";" "\n" text "${text}")
    string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
    string(REGEX MATCHALL "VNDF_API[ \n][^#(]*vndf_[a-z0-9_]+\\(" matches "${text}")
    list(TRANSFORM matches REPLACE "^.*[ *\n](vndf_[a-z0-9_]+)\\($" "\\1")
    list(APPEND declared ${matches})
endforeach()
list(SORT declared)
list(LENGTH declared count)
if(count EQUAL 0)
    message(FATAL_ERROR "no function is declared with VNDF_API in ${SOURCE}/include")
endif()

string(REGEX REPLACE "^([0-9]+\\.[0-9]+).*$" "VNDF_\\1" node ${VERSION})
read_symbols(exported -D --defined-only ${SHARED_LIBRARY})
# Newer versions of nm print that of a symbol behind it.
if(NOT node IN_LIST exported AND NOT exported MATCHES "@@${node}(;|$)")
    message(SEND_ERROR "the shared library does not define the version ${node}")
endif()
list(TRANSFORM exported REPLACE "@@${node}$" "")
list(REMOVE_ITEM exported ${node})
list(SORT exported)
if(NOT exported STREQUAL declared)
    set(missing ${declared})
    list(REMOVE_ITEM missing ${exported})
    list(REMOVE_ITEM exported ${declared})
    message(SEND_ERROR "exported with ${node}, but not declared with VNDF_API: {${exported}}; "
        "declared, but not exported: {${missing}}")
endif()

read_symbols(external -g --defined-only ${STATIC_LIBRARY})
foreach(name IN LISTS external)
    if(NOT name MATCHES "^vndf_")
        message(SEND_ERROR "${name} in the static library does not begin with vndf_: rename it or make it static")
    endif()
endforeach()

# No state, so threads share distributions and views freely (test_render_command has a picture made by many).
execute_process(COMMAND ${NM} --format=sysv ${STATIC_LIBRARY} OUTPUT_VARIABLE output ERROR_QUIET)
if(NOT output MATCHES "[|][.]text\n")
    message(SEND_ERROR "nm tells no sections of the static library")
elseif(output MATCHES "\n([^\n]*)[|]([.]t?data|[.]t?bss|[*]COM[*])\n")
    message(SEND_ERROR "the static library has a variable that can be written: ${CMAKE_MATCH_1}")
endif()
message("${count} functions are declared")
