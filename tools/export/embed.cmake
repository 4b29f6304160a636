# Writes the kernel's text as lines of C:  cmake -DTEXT=kernel.glsl -DTO=kernel_text.c -P embed.cmake
cmake_minimum_required(VERSION 3.16)
file(READ ${TEXT} text)
string(REPLACE "\\" "\\\\" text "${text}")
string(REPLACE "\"" "\\\"" text "${text}")
string(REPLACE ";" "\;" text "${text}")
string(REGEX REPLACE "\n$" "" text "${text}")
string(REPLACE "\n" ";" lines "${text}")
set(body "")
foreach(line IN LISTS lines)
    string(APPEND body "    \"${line}\",\n")
endforeach()
file(WRITE ${TO} "/* Made from tools/export/kernel.glsl by tools/export/embed.cmake. */
#include \"export/kernel_text.h\"

const char *const kernel_text[] = {\n${body}    NULL};\n")
