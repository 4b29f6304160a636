# include/vndf.hpp says all that the headers of C say; its example prints what it promises; bits.cpp and owners.cpp hold
# with this build's library, one as C++17 and one as C++20, without a warning. With LONG: each as both, by g++ and
# clang++, both linked together; the header without exceptions; and defects in it are noticed.
cmake_minimum_required(VERSION 3.16)

# Sanitizers come from the compiler of the library.
get_filename_component(name ${C_COMPILER} NAME)
get_filename_component(folder ${C_COMPILER} DIRECTORY)
string(REGEX REPLACE "^gcc" "g++" sibling ${name})
string(REGEX REPLACE "^clang" "clang++" sibling ${sibling})
if(NOT sibling STREQUAL name AND EXISTS ${folder}/${sibling})
    set(CXX_COMPILER ${folder}/${sibling})
endif()
if(NOT CXX_COMPILER)
    message("SKIPPED: no C++ compiler was found")
    return()
elseif(NOT SHARED_LIBRARY MATCHES "\\.(so|dylib)(\\.|$)")
    message("SKIPPED: the options of compilers are those of gcc and clang")
    return()
endif()

set(flags -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
set(wrap "")
if(SANITIZE)
    list(APPEND flags -fsanitize=${SANITIZE} -fno-sanitize-recover=all -g)
elseif(SHARED_LIBRARY MATCHES "\\.so") # ELF: the linker can put a test's functions in the place of the C library's
    set(wrap -DVNDF_TEST_WRAP -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=free)
endif()
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})

function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    set(status "${status}" PARENT_SCOPE)
    set(output "${output}" PARENT_SCOPE)
    if(NOT status EQUAL 0 AND NOT what STREQUAL "")
        message(SEND_ERROR "${what} failed (${status}):\n${output}${errors}")
    endif()
endfunction()

# compile(COMPILER STANDARD HEADERS SOURCE TO FLAG...): with HEADERS before those of this project.
function(compile compiler standard headers source to)
    run("${source} by ${compiler} as C++${standard}" ${compiler} -std=c++${standard} ${flags} -I${headers}
        -I${SOURCE}/include -I${SOURCE}/tests "-DVNDF_SOURCE_DIR=\"${SOURCE}\"" ${source} ${ARGN} -o ${to})
endfunction()

# ---- what it says -------------------------------------------------------------------------------

file(READ ${SOURCE}/include/vndf.hpp text)
foreach(header vndf vndf_albedo vndf_bsdf vndf_build)
    file(READ ${SOURCE}/include/${header}.h declared)
    string(REPLACE ";" "\n" declared "${declared}")
    string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" declared "${declared}")
    string(REGEX MATCHALL "VNDF_API[ \n][^#(]*vndf_[a-z0-9_]+\\(" calls "${declared}")
    foreach(call IN LISTS calls)
        string(REGEX REPLACE "^.*[ *\n](vndf_[a-z0-9_]+)\\($" "\\1" call "${call}")
        if(NOT text MATCHES "[^a-z0-9_]${call}[^a-z0-9_]")
            message(SEND_ERROR "vndf.hpp does not know ${call} of ${header}.h")
        endif()
    endforeach()
endforeach()

# The example in its head.
string(REGEX MATCH "//     #include <cmath>\n(//[^\n]*\n)*//     }\n" example "${text}")
string(REGEX REPLACE "(^|\n)//( |)( |)( |)( |)( |)" "\\1" example "${example}")
file(WRITE ${OUT}/example.cpp "${example}")
string(REPLACE ";" "" lines "${example}")
string(REGEX MATCHALL "[^\n]\n" lines "${lines}")
list(LENGTH lines count)
if(count LESS 15 OR count GREATER 25)
    message(SEND_ERROR "the example in the head of vndf.hpp has ${count} lines")
endif()
compile(${CXX_COMPILER} 17 ${SOURCE}/include ${OUT}/example.cpp ${OUT}/example ${STATIC_LIBRARY})
run("the example" ${OUT}/example)
if(NOT output STREQUAL "0 0 0 0\n")
    message(SEND_ERROR "the example prints ${output}")
endif()

# ---- what it does -------------------------------------------------------------------------------

# test(COMPILER STANDARD NAME): compiles and runs it.
function(test compiler standard name)
    set(options "")
    if(name STREQUAL "owners")
        set(options ${wrap})
    endif()
    compile(${compiler} ${standard} ${SOURCE}/include ${SOURCE}/tests/cpp/${name}.cpp ${OUT}/${name} ${options}
        ${STATIC_LIBRARY})
    run("${name} of ${compiler}, C++${standard}" ${OUT}/${name})
endfunction()

test(${CXX_COMPILER} 17 bits)
test(${CXX_COMPILER} 20 owners)
find_program(GXX g++)
find_program(CLANGXX clang++)
if(NOT LONG)
    set(other ${CLANGXX})
    if(CXX_COMPILER MATCHES "clang")
        set(other ${GXX})
    endif()
    if(other AND NOT SANITIZE)
        compile(${other} 20 ${SOURCE}/include ${SOURCE}/tests/cpp/bits.cpp ${OUT}/nothing -fsyntax-only)
        compile(${other} 17 ${SOURCE}/include ${SOURCE}/tests/cpp/owners.cpp ${OUT}/nothing -fsyntax-only)
    endif()
    return()
endif()

# ---- everywhere ---------------------------------------------------------------------------------

file(WRITE ${OUT}/alone.cpp "#include \"vndf.hpp\"\n#include \"vndf.hpp\"\nint main() { return !vndf::ggx(); }\n")
foreach(compiler ${GXX} ${CLANGXX})
    if(NOT compiler)
        continue()
    endif()
    foreach(standard 17 20)
        test(${compiler} ${standard} bits)
        test(${compiler} ${standard} owners)
        compile(${compiler} ${standard} ${SOURCE}/include ${OUT}/alone.cpp ${OUT}/alone -fno-exceptions -fno-rtti
            ${STATIC_LIBRARY})
        compile(${compiler} ${standard} ${SOURCE}/include ${SOURCE}/tests/cpp/bits.cpp ${OUT}/bits_${standard}.o -c)
    endforeach()
    # Sources of both standards in one program.
    compile(${compiler} 20 ${SOURCE}/include ${SOURCE}/tests/cpp/owners.cpp ${OUT}/owners_20.o -c -Dmain=other_main)
    compile(${compiler} 17 ${SOURCE}/include ${OUT}/bits_17.o ${OUT}/both ${OUT}/owners_20.o ${STATIC_LIBRARY})
    run("bits with owners of C++20, by ${compiler}" ${OUT}/both)
endforeach()

# ---- defects are noticed ------------------------------------------------------------------------

# defect(TEST OLD NEW): a header with NEW in the place of OLD fails TEST.
function(defect name old new)
    string(FIND "${text}" "${old}" first)
    string(FIND "${text}" "${old}" last REVERSE)
    if(first EQUAL -1 OR NOT first EQUAL last)
        message(SEND_ERROR "vndf.hpp does not have exactly once:\n${old}")
        return()
    endif()
    string(REPLACE "${old}" "${new}" unsound "${text}")
    file(WRITE ${OUT}/unsound/vndf.hpp "${unsound}")
    set(options "")
    if(name STREQUAL "owners")
        set(options ${wrap})
    endif()
    compile(${CXX_COMPILER} 17 ${OUT}/unsound ${SOURCE}/tests/cpp/${name}.cpp ${OUT}/unsound/${name} ${options}
        ${STATIC_LIBRARY})
    run("" ${OUT}/unsound/${name})
    if(status EQUAL 0)
        message(SEND_ERROR "survives ${name}:\n${new}")
    endif()
endfunction()

if(wrap)
    defect(owners "    ~distribution() { vndf_free(release()); }" "    ~distribution() { release(); }")
    defect(owners "vndf_albedo *albedo) const noexcept { vndf_albedo_free(albedo); }"
        "vndf_albedo *) const noexcept {}")
endif()
defect(owners "            vndf_free(release());\n            distribution_ref::" "            distribution_ref::")
defect(owners "    if (here.thrown())\n        describe(here.thrown(), &error);\n    else if (owner)" "    if (owner)")
defect(owners "    ~shield() { innermost() = outer_; }"
    "    ~shield() { if (outer_ && thrown_) outer_->thrown_ = thrown_; innermost() = outer_; }")
defect(owners "all->callable_ = std::move(*kept);" "")
defect(owners "if (tables.size() != parameters.size())" "if (tables.size() > parameters.size())")
defect(bits "else if (good_ && size != count_)" "else if (good_ && size > count_)")
defect(bits "if (of.one && of.many)" "if (of.one && of.many && of.name == nullptr)")
defect(bits "c.mean_y = mean.y.data();" "c.mean_y = mean.x.data();")
defect(bits "c.sin_rotation = sine_.data();" "c.sin_rotation = cosine_.data();")
defect(bits "static void visible(const batch &c, vndf_normals wm, float *to) { vndf_visible_n(&c, wm, to); }"
    "static void visible(const batch &c, vndf_normals wm, float *to) { vndf_pdf_n(&c, wm, to); }")
