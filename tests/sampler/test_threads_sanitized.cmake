# Under ThreadSanitizer the eight threads of test_threads.c have no data race. The sanitizer is first shown a
# race: where it cannot be linked, does not run, or does not report that, nothing could be learnt, and this test
# is skipped. Only the rooms of the run time are compiled.
cmake_minimum_required(VERSION 3.16)

file(MAKE_DIRECTORY ${OUT})
file(WRITE ${OUT}/race.c "#include <pthread.h>
static int shared;
static void *enter(void *data) { return shared++, data; }
int main(void) { pthread_t a; return pthread_create(&a, 0, enter, 0) || shared++ < 0 || pthread_join(a, 0); }
")
set(flags -std=c11 -O1 -g -pthread -fsanitize=thread)
execute_process(COMMAND ${C_COMPILER} ${flags} ${OUT}/race.c -o ${OUT}/race
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(NOT status EQUAL 0)
    message("SKIPPED: ${C_COMPILER} cannot link ThreadSanitizer")
    return()
endif()
execute_process(COMMAND ${OUT}/race RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "data race")
    message("SKIPPED: ThreadSanitizer does not report a race here, it says: ${output}")
    return()
endif()

set(sources ${SOURCE}/tests/sampler/test_threads.c)
foreach(room core math kernel table sampler bsdf)
    file(GLOB_RECURSE room_sources ${SOURCE}/src/${room}/*.c)
    list(APPEND sources ${room_sources})
endforeach()
separate_arguments(arithmetic UNIX_COMMAND "${ARITHMETIC}")
execute_process(
    COMMAND ${C_COMPILER} ${flags} ${arithmetic} -DVNDF_TEST_PTHREADS -DVNDF_SOURCE_DIR="${SOURCE}"
        -I${SOURCE}/src -I${SOURCE}/include -I${SOURCE}/tests ${sources} -o ${OUT}/threads -lm
    RESULT_VARIABLE status ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "the run time cannot be built with ThreadSanitizer:\n${errors}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env VNDF_TEST_QUICK=1 ${OUT}/threads
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "under ThreadSanitizer:\n${output}")
endif()
message("${output}")
