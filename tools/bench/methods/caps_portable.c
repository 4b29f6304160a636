/* caps_lanes.h for the compiler's default instructions: SSE2 on x86-64. */
#include "bench/methods/caps_lanes.h"

caps_code caps_code_portable(void)
{
    return (caps_code){caps_each, caps_shared, caps_move};
}
