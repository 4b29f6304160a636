/* caps_lanes.h for the compiler's default instructions, SSE2 on x86-64; and the batches of all sets as methods,
 * if this machine has their instructions. */
#include "evidence/methods/caps_lanes.h"

caps_code caps_code_portable(void)
{
    return (caps_code){caps_each, caps_shared, caps_move};
}

static caps_code code_for(vndf_instructions set)
{
    caps_code code = {NULL, NULL, NULL};
#if defined(__x86_64__) || defined(__i386__)
    if (set == VNDF_INSTRUCTIONS_AVX2 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        code = caps_code_avx2();
    if (set == VNDF_INSTRUCTIONS_AVX512 && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        code = caps_code_avx512();
#endif
    return set == VNDF_INSTRUCTIONS_PORTABLE ? caps_code_portable() : code;
}

method method_ggx_caps_batch(vndf_instructions set)
{
    caps_code code = code_for(set);
    return (method){.name = "spherical caps (2023), batch",
                    .instructions = method_instructions_name(set),
                    .kind = ROW_PUBLISHED,
                    .limit = set,
                    .each = code.each,
                    .shared = code.shared};
}

method method_move(vndf_instructions set)
{
    return (method){.name = "moving 36 bytes",
                    .instructions = method_instructions_name(set),
                    .kind = ROW_MOVE,
                    .limit = set,
                    .each = code_for(set).move};
}
