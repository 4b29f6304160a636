/* The batches of caps_lanes.h as methods, if this machine has their instructions. */
#include "bench/methods/caps_batch.h"

static int machine_has(vndf_instructions set)
{
#if defined(__x86_64__) || defined(__i386__)
    if (set == VNDF_INSTRUCTIONS_AVX2)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (set == VNDF_INSTRUCTIONS_AVX512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
#endif
    return set == VNDF_INSTRUCTIONS_PORTABLE;
}

static caps_code code_for(vndf_instructions set)
{
    const caps_code none = {NULL, NULL, NULL};
    if (!machine_has(set))
        return none;
    return set == VNDF_INSTRUCTIONS_AVX512 ? caps_code_avx512()
           : set == VNDF_INSTRUCTIONS_AVX2 ? caps_code_avx2()
                                           : caps_code_portable();
}

const char *method_instructions_name(vndf_instructions set)
{
    return set == VNDF_INSTRUCTIONS_AVX512     ? "avx512"
           : set == VNDF_INSTRUCTIONS_AVX2     ? "avx2"
           : set == VNDF_INSTRUCTIONS_PORTABLE ? "portable"
                                               : "scalar";
}

method method_ggx_caps_batch(vndf_instructions set)
{
    caps_code code = code_for(set);
    return (method){.name = "spherical caps (2023), batch",
                    .instructions = method_instructions_name(set),
                    .kind = BENCH_PUBLISHED,
                    .each = code.each,
                    .shared = code.shared};
}

method method_move(vndf_instructions set)
{
    caps_code code = code_for(set);
    return (method){.name = "moving 36 bytes",
                    .instructions = method_instructions_name(set),
                    .kind = BENCH_MOVE,
                    .each = code.move};
}
