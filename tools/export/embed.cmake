# Writes texts as lines of C: the table NAME of {file name, lines}, ended by {NULL, NULL}; lines are ended by NULL.
#   cmake "-DTEXTS=one.h;two.h" -DNAME=kernel_text -DHEADER=export/export.h -DTO=kernel_text.c -P embed.cmake
cmake_minimum_required(VERSION 3.16)

set(body "/* Made by tools/export/embed.cmake. */\n#include \"${HEADER}\"\n")
set(table "")
foreach(file IN LISTS TEXTS)
    file(READ ${file} text)
    string(REPLACE "\\" "\\\\" text "${text}")
    string(REPLACE "\"" "\\\"" text "${text}")
    string(REGEX REPLACE "\n$" "" text "${text}")
    string(REPLACE "\n" "\",\n    \"" text "${text}")
    get_filename_component(text_name ${file} NAME)
    string(MAKE_C_IDENTIFIER "text_${text_name}" array)
    string(APPEND body "\nstatic const char *const ${array}[] = {\n    \"${text}\",\n    NULL};\n")
    string(APPEND table "    {\"${text_name}\", ${array}},\n")
endforeach()
string(APPEND body "\nconst embedded_text ${NAME}[] = {\n${table}    {NULL, NULL}};\n")
file(WRITE ${TO} "${body}")
