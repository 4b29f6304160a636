# Writes texts as lines of C, each text an array of strings that NULL ends:
#   cmake "-DTEXTS=kernel.glsl" -DNAME=kernel_text -DHEADER=export/kernel_text.h -DTO=kernel_text.c -P embed.cmake
# NAME is the array of the one text, or with -DTABLE=ON a table of all of them, each {file name, lines}.
cmake_minimum_required(VERSION 3.16)

# The lines of a file as elements of an array.
function(read_lines file lines)
    file(READ ${file} text)
    string(REPLACE "\\" "\\\\" text "${text}")
    string(REPLACE "\"" "\\\"" text "${text}")
    string(REGEX REPLACE "\n$" "" text "${text}")
    string(REPLACE "\n" "\",\n    \"" text "${text}")
    set(${lines} "    \"${text}\",\n    NULL" PARENT_SCOPE)
endfunction()

set(body "/* Made by tools/export/embed.cmake. */\n#include \"${HEADER}\"\n")
set(table "")
foreach(file IN LISTS TEXTS)
    read_lines(${file} lines)
    get_filename_component(text_name ${file} NAME)
    if(TABLE)
        string(MAKE_C_IDENTIFIER "text_${text_name}" array)
        string(APPEND body "\nstatic const char *const ${array}[] = {\n${lines}};\n")
        string(APPEND table "    {\"${text_name}\", ${array}},\n")
    else()
        string(APPEND body "\nconst char *const ${NAME}[] = {\n${lines}};\n")
    endif()
endforeach()
if(TABLE)
    string(APPEND body "\nconst embedded_text ${NAME}[] = {\n${table}    {NULL, NULL}};\n")
endif()
file(WRITE ${TO} "${body}")
