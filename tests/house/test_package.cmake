# What tools/package says is so: the newest version in CHANGELOG.md is that of the header, and README.md names the
# SONAME, the version of symbols, the package, and every header.
cmake_minimum_required(VERSION 3.16)

file(READ ${SOURCE}/tools/package/CHANGELOG.md changes)
file(READ ${SOURCE}/tools/package/README.md readme)
string(REGEX MATCH "^([0-9]+[.][0-9]+)" minor ${VERSION})
if(NOT changes MATCHES "\n## ([^\n]*)\n" OR NOT CMAKE_MATCH_1 STREQUAL VERSION)
    message(SEND_ERROR "CHANGELOG.md begins with '${CMAKE_MATCH_1}', the header says ${VERSION}")
endif()
file(GLOB headers RELATIVE ${SOURCE}/include ${SOURCE}/include/*.h ${SOURCE}/include/*.hpp)
foreach(text libvndf.so.${minor} VNDF_${minor} "find_package(vndf ${minor})" ${headers})
    string(FIND "${readme}" "`${text}`" place)
    if(place EQUAL -1)
        message(SEND_ERROR "tools/package/README.md does not name ${text}")
    endif()
endforeach()
