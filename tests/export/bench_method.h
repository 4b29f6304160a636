/* The exported C for the loops of tools/bench. */
#ifndef TESTS_EXPORT_BENCH_METHOD_H
#define TESTS_EXPORT_BENCH_METHOD_H

#include "bench/methods/method.h"

typedef struct bench_exported {
    const float *numbers; /* of one table; NULL for GGX */
} bench_exported;

/* Without vector loops, and with everything the compiler knows of this processor and -ffast-math. */
method bench_exported_plain(const bench_exported *is);
method bench_exported_fast(const bench_exported *is);

#endif
