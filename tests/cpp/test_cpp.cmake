# The example of include/vndf.hpp prints what it promises; vndf_hpp.cpp holds in C++17 and 20, by every compiler here,
# without a warning; the header compiles without exceptions and RTTI; defects in it are noticed.
cmake_minimum_required(VERSION 3.16)

# Sanitizers come from the compiler of the library.
get_filename_component(name ${C_COMPILER} NAME)
get_filename_component(folder ${C_COMPILER} DIRECTORY)
string(REGEX REPLACE "^gcc" "g++" sibling ${name})
string(REGEX REPLACE "^clang" "clang++" sibling ${sibling})
if(NOT sibling STREQUAL name AND EXISTS ${folder}/${sibling})
    set(CXX_COMPILER ${folder}/${sibling})
endif()
if(NOT CXX_COMPILER OR NOT SHARED_LIBRARY MATCHES "\\.(so|dylib)(\\.|$)")
    message("SKIPPED: no C++ compiler with the options of gcc and clang was found")
    return()
endif()

set(flags -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
if(SANITIZE)
    list(APPEND flags -fsanitize=${SANITIZE} -fno-sanitize-recover=all -g)
endif()
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
file(WRITE ${OUT}/leak.cpp "int main() {}\n")
if(NOT SANITIZE)
    execute_process(COMMAND ${CXX_COMPILER} -fsanitize=leak ${OUT}/leak.cpp -o ${OUT}/leak RESULT_VARIABLE absent
        OUTPUT_QUIET ERROR_QUIET)
    if(NOT absent)
        set(leaks -fsanitize=leak) # what is not freed fails the test, by the sanitizer of the library otherwise
    endif()
endif()

# compile(COMPILER STANDARD HEADERS SOURCE FLAG...): with HEADERS before those of this project.
function(compile compiler standard headers source)
    execute_process(COMMAND ${compiler} -std=c++${standard} ${flags} -I${headers} -I${SOURCE}/include
        -I${SOURCE}/tests "-DVNDF_SOURCE_DIR=\"${SOURCE}\"" ${source} -o ${OUT}/program ${ARGN}
        RESULT_VARIABLE status ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${source} by ${compiler} as C++${standard}:\n${errors}")
    endif()
endfunction()

# try(HEADERS SOURCE): what the program says, and its status.
function(try headers source)
    compile(${CXX_COMPILER} 17 ${headers} ${source} ${leaks} ${STATIC_LIBRARY})
    execute_process(COMMAND ${OUT}/program RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    set(status "${status}" PARENT_SCOPE)
    set(said "${output}${errors}" PARENT_SCOPE)
endfunction()

file(READ ${SOURCE}/include/vndf.hpp text)
string(REGEX MATCH "//     #include <cmath>\n(//[^\n]*\n)*//     }\n" example "${text}")
string(REGEX REPLACE "(^|\n)//( |)( |)( |)( |)( |)" "\\1" example "${example}")
file(WRITE ${OUT}/example.cpp "${example}")
try(${SOURCE}/include ${OUT}/example.cpp)
if(NOT said STREQUAL "1.000\n")
    message(FATAL_ERROR "the example in the head of vndf.hpp prints ${said}")
endif()

set(test ${SOURCE}/tests/cpp/vndf_hpp.cpp)
try(${SOURCE}/include ${test})
if(NOT status EQUAL 0)
    message(FATAL_ERROR "${said}")
endif()
find_program(GXX g++)
find_program(CLANGXX clang++)
foreach(compiler ${GXX} ${CLANGXX})
    if(NOT compiler)
        continue()
    endif()
    foreach(standard 17 20)
        compile(${compiler} ${standard} ${SOURCE}/include ${test} -fsyntax-only)
    endforeach()
endforeach()
file(WRITE ${OUT}/alone.cpp "#include \"vndf.hpp\"\n#include \"vndf.hpp\"\nint main() { return !vndf::load(\"\"); }\n")
compile(${CXX_COMPILER} 17 ${SOURCE}/include ${OUT}/alone.cpp -fno-exceptions -fno-rtti -fsyntax-only)

# defect(OLD NEW): the test fails by a header with NEW in the place of OLD.
function(defect old new)
    string(REPLACE "${old}" "${new}" unsound "${text}")
    file(WRITE ${OUT}/unsound/vndf.hpp "${unsound}")
    try(${OUT}/unsound ${test})
    if(unsound STREQUAL text OR status EQUAL 0)
        message(SEND_ERROR "survives: ${new}")
    endif()
endfunction()

if(leaks)
    defect("Free(owned);" "static_cast<void>(owned);")
endif()
defect("throw error(error_);" "return value_;")
defect("? 0 : 1;" "? 1 : 0;")
