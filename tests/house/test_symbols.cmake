# The shared library exports the functions that the headers declare with VNDF_API, all of them and nothing
# else, with a version of symbols, VNDF_0.1; every external symbol of the static library begins with vndf_, and it has
# no variable that can be written.
cmake_minimum_required(VERSION 3.16)

if(NOT NM OR SANITIZE OR NOT SHARED_LIBRARY MATCHES "\\.so(\\.|$)")
    message("SKIPPED: no nm, or sanitizers with symbols of their own, or no ELF: ${SHARED_LIBRARY}")
    return()
endif()

# Lines "address letter name", where older linkers export the bounds of sections, too; newer versions of nm print the
# version of a symbol behind it.
function(read_symbols result)
    execute_process(COMMAND ${NM} --defined-only ${ARGN} OUTPUT_VARIABLE output ERROR_QUIET)
    string(REGEX MATCHALL "[0-9a-fA-F]+ [A-Za-z] [^\n]+" lines "${output}")
    list(TRANSFORM lines REPLACE "^[0-9a-fA-F]+ [A-Za-z] " "")
    list(REMOVE_ITEM lines _init _fini _edata _end __bss_start)
    set(${result} "${lines}" PARENT_SCOPE)
endfunction()

# The functions after VNDF_API, comments left out.
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
list(LENGTH declared count)
string(REGEX REPLACE "^([0-9]+\\.[0-9]+).*$" "VNDF_\\1" node ${VERSION})
read_symbols(exported -D ${SHARED_LIBRARY})
if(count LESS 50 OR NOT "${exported}" MATCHES "(^|;|@@)${node}(;|$)")
    message(SEND_ERROR "${count} functions are declared; the shared library has no version ${node}: ${exported}")
endif()
list(TRANSFORM exported REPLACE "@@${node}$" "")
list(REMOVE_ITEM exported ${node})
foreach(name IN LISTS declared exported)
    if(NOT (name IN_LIST declared AND name IN_LIST exported))
        message(SEND_ERROR "${name} is declared with VNDF_API, or exported with ${node}, not both")
    endif()
endforeach()

read_symbols(external -g ${STATIC_LIBRARY})
list(FILTER external EXCLUDE REGEX "^vndf_")
# No state, so threads share distributions and views freely (test_render_command has a picture made by many).
execute_process(COMMAND ${NM} --format=sysv ${STATIC_LIBRARY} OUTPUT_VARIABLE output ERROR_QUIET)
if(NOT output MATCHES "[|][.]text\n")
    message(SEND_ERROR "nm tells no sections of the static library")
elseif(external OR output MATCHES "\n([^\n]*)[|]([.]t?data|[.]t?bss|[*]COM[*])\n")
    message(SEND_ERROR "in the static library do not begin with vndf_: ${external}; can be written: ${CMAKE_MATCH_1}")
endif()
message("${count} functions are declared")
