/* caps_lanes.h compiled for AVX2 (CMakeLists.txt); where the compiler has none, there is nothing to run. */
#include "bench/methods/caps_lanes.h"

caps_code caps_code_avx2(void)
{
    return LANES == 8 ? (caps_code){caps_each, caps_shared, caps_move} : (caps_code){NULL, NULL, NULL};
}
