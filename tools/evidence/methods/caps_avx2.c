/* caps_lanes.h compiled for AVX2 (CMakeLists.txt); nothing, if the compiler has no AVX2. */
#include "evidence/methods/caps_lanes.h"

caps_code caps_code_avx2(void)
{
    return LANES == 8 ? (caps_code){caps_each, caps_shared, caps_move} : (caps_code){NULL, NULL, NULL};
}
