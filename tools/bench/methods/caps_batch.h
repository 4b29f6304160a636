/* What one instruction set has of caps_lanes.h; pointers are NULL where the compiler cannot make it. */
#ifndef TOOLS_BENCH_METHODS_CAPS_BATCH_H
#define TOOLS_BENCH_METHODS_CAPS_BATCH_H

#include "bench/methods/method.h"

typedef struct caps_code {
    method_run *each, *shared, *move;
} caps_code;

caps_code caps_code_portable(void);
caps_code caps_code_avx2(void);
caps_code caps_code_avx512(void);

#endif
