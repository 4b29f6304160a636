/* caps_lanes.h compiled for AVX-512 (CMakeLists.txt); nothing, if the compiler has no AVX-512. */
#include "evidence/methods/caps_lanes.h"

caps_code caps_code_avx512(void)
{
    return LANES == 16 ? (caps_code){caps_each, caps_shared, caps_move} : (caps_code){NULL, NULL, NULL};
}
