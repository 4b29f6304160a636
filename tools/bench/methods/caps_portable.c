/* caps_lanes.h for whatever the compiler makes for all: SSE2 on x86-64. */
#include "bench/methods/caps_lanes.h"

caps_code caps_code_portable(void)
{
    return (caps_code){caps_each, caps_shared, caps_move};
}
