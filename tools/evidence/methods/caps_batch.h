/* The functions of caps_lanes.h for one instruction set; NULL if the compiler lacks the set. */
#ifndef TOOLS_EVIDENCE_METHODS_CAPS_BATCH_H
#define TOOLS_EVIDENCE_METHODS_CAPS_BATCH_H

#include "evidence/method.h"

typedef struct caps_code {
    method_run *each, *shared, *move;
} caps_code;

caps_code caps_code_portable(void);
caps_code caps_code_avx2(void);
caps_code caps_code_avx512(void);

#endif
