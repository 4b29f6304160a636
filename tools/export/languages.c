#include "export/export.h"

#include <string.h>

/* Of some languages: what a struct is before its members are set (ZERO), which Python needs of numbers, too (UNSET);
 * the pointer to numbers, which is the first parameter of what fetches them; what asks for a loop with a constant end
 * to be unrolled. */
static const char common[] =
    "VARIABLE: $T $V; MEMBER: $T $V; SEVERAL: $T $V[$N]; END: ;; MEMBER_END: ;; FUNCTION: $T $D($P) {$S}; "
    "STRUCT: struct $D {$M};; CONSTANT: enum { $D = $N };; MAKE: {$I}; FOR: for (int $V = $A$;$V < $B$;$V++); "
    "OPEN:  {; CLOSE: }; "
    "real: float; integer: int; mask: bool; vec3: float3; direction: float3; "
    "set = $1; set_int = $1; any = $1; lt = ($1 < $2); le = ($1 <= $2); eq = ($1 == $2); both = ($1 && $2); "
    "either = ($1 || $2); select = ($1 ? $2 : $3); select_int = ($1 ? $2 : $3); sqrt = sqrt($1); abs = abs($1); "
    "to_real = float($1); to_int = int($1); vec3 = float3($1, $2, $3); fetch = numbers[$1]; "
    "view_frame = $1.f; view_table = $1.t; view_weighs = 1; lobe_end = VNDF_LOBES; its_count = $1.count; "
    "its_view = $1.lobe[$2]; its_share = $1.share.lobe[$2]; its_weights = $1.weight; "
    "material_of = $1.material; hit_of = $1.h; ";

#define BOUND(how, declared)                                                     \
  "// Define VNDF_FETCH(i) before this to fetch number i from anywhere else" how \
  ".\n#ifndef VNDF_FETCH\n" declared "\n#define VNDF_FETCH(i) vndf_numbers[i]\n#endif\n"

#define FUNCTION(declared)                                                                                             \
  "\n// Define VNDF_FUNCTION before this to have functions declared in another way.\n#ifndef VNDF_FUNCTION\n" declared \
  "#endif\n"

#define BITS                                                                                                  \
  "\nVNDF_FUNCTION int vndf_bits(float x) {\n    int i;\n    memcpy(&i, &x, sizeof i);\n    return i;\n}\n\n" \
  "VNDF_FUNCTION float vndf_of_bits(int i) {\n    float x;\n    memcpy(&x, &i, sizeof x);\n    return x;\n}\n"

/* What C and C++ do not have. Functions that are not inlined pass views through memory: a sample of a table took 1.6
 * times as long as the library's, and takes 1.2 times. */
#define C_BEGIN                                                                                          \
  FUNCTION("#if defined(__GNUC__)\n#define VNDF_FUNCTION static inline __attribute__((always_inline))\n" \
           "#else\n#define VNDF_FUNCTION static inline\n#endif\n")                                       \
  BITS "\ntypedef struct vndf_vec3 {\n    float x, y, z;\n} vndf_vec3;\n\n"                              \
       "VNDF_FUNCTION vndf_vec3 vndf_vec3_of(float x, float y, float z) {\n"                             \
       "    vndf_vec3 v = {x, y, z};\n    return v;\n}\n"

/* Host and device each have arrays of their own. */
#define CUDA_ARRAYS                                                                                       \
  "\n#ifndef VNDF_ARRAY\n#ifdef __CUDA_ARCH__\n#define VNDF_ARRAY static __device__ const float\n#else\n" \
  "#define VNDF_ARRAY static const float\n#endif\n#endif\n"

#define CUDA_BEGIN \
  "#include <cstring>\n" FUNCTION("#define VNDF_FUNCTION __host__ __device__ inline\n") CUDA_ARRAYS BITS

/* What stands before the kernel in Python; derivatives of bits are 0, those of roots at 0 too. */
static const char python_begin[] =
    "import struct\n\nimport drjit as dr\nimport mitsuba as mi\n\n\n"
    "class _Struct:\n    __slots__ = ()\n\n    def __init__(self, *values):\n"
    "        for name, value in zip(self.__slots__, values):\n            setattr(self, name, value)\n\n\n"
    "def _copy(s):\n    if not isinstance(s, _Struct):\n        return s\n"
    "    return type(s)(*(getattr(s, name, None) for name in s.__slots__))\n\n\n"
    "def _min(a, b):\n    return dr.select(a < b, a, b)\n\n\n"
    "def _max(a, b):\n    return dr.select(a > b, a, b)\n\n\n"
    "def _sqrt(x):\n    return dr.sqrt(_max(x, 1e-36))\n\n\n"
    "def _bits(x):\n    if dr.is_jit_v(mi.Float):\n"
    "        return dr.reinterpret_array(mi.Int32, dr.detach(mi.Float(x)))\n"
    "    return struct.unpack(\"i\", struct.pack(\"f\", x))[0]\n\n\n"
    "def _of_bits(i):\n    if dr.is_jit_v(mi.Float):\n"
    "        return dr.reinterpret_array(mi.Float, mi.Int32(i))\n"
    "    return struct.unpack(\"f\", struct.pack(\"i\", i))[0]\n";

static const language languages[] = {
    {"c", "C99", 0, 0, NULL, NULL, "#include <math.h>\n#include <stdbool.h>\n#include <string.h>\n" C_BEGIN,
     "FUNCTION: VNDF_FUNCTION $T $D($P) {$S}; UNUSED: (void)$V;; STRUCT: typedef struct $D {$M} $D;; "
     "ARRAY: static const float $D[$N] = {\n    $I\n};; ZERO:  = {0}; POINTER: const float *; "
     "vec3: vndf_vec3; direction: vndf_vec3; "
     "sqrt = sqrtf($1); abs = fabsf($1); with_sign = copysignf($1, $2); to_real = (float)($1); to_int = (int)($1); "
     "bits = vndf_bits($1); of_bits = vndf_of_bits($1); vec3 = vndf_vec3_of($1, $2, $3); "},
    {"cpp", "C++11", 0, 0, NULL, NULL, "#include <cmath>\n#include <cstring>\n" C_BEGIN,
     "FUNCTION: VNDF_FUNCTION $T $D($P) {$S}; UNUSED: (void)$V;; "
     "ARRAY: static const float $D[$N] = {\n    $I\n};; ZERO:  = {}; "
     "POINTER: const float *; vec3: vndf_vec3; direction: vndf_vec3; sqrt = std::sqrt($1); abs = std::fabs($1); "
     "with_sign = std::copysign($1, $2); bits = vndf_bits($1); of_bits = vndf_of_bits($1); "
     "vec3 = vndf_vec3_of($1, $2, $3); "},
    {"cuda", "CUDA", 0, 0, NULL, NULL, CUDA_BEGIN,
     "UNROLL: #pragma unroll; FUNCTION: VNDF_FUNCTION $T $D($P) {$S}; "
     "ARRAY: VNDF_ARRAY $D[$N] = {\n    $I\n};; ZERO:  = {}; POINTER: const float *__restrict__ ; "
     "sqrt = sqrtf($1); abs = fabsf($1); with_sign = copysignf($1, $2); "
     "quad: float4; fetch_4 = *reinterpret_cast<const float4 *>(numbers + ($1)); bits = vndf_bits($1); "
     "of_bits = vndf_of_bits($1); vec3 = make_float3($1, $2, $3); "},
    {"opencl", "OpenCL C 1.2", 0, 16384, "OpenCL promises 64 KiB of constants", NULL, "",
     "FUNCTION: static inline $T $D($P) {$S}; STRUCT: typedef struct $D {$M} $D;; "
     "ARRAY: __constant float $D[$N] = {\n    $I\n};; ZERO:  = {0}; POINTER: __global const float *; abs = fabs($1); "
     "with_sign = copysign($1, $2); to_real = (float)($1); to_int = (int)($1); bits = as_int($1); "
     "of_bits = as_float($1); vec3 = (float3)($1, $2, $3); "},
    {"glsl", "GLSL 4.30 and GLSL ES 3.00", 0, 4096,
     "drivers copy a constant array that is read at an index into registers, or refuse it",
     BOUND(", as a texture", "layout(std430, binding = 0) readonly buffer vndf_buffer { float vndf_numbers[]; };"),
     "",
     "CONSTANT: const int $D = $N;; ARRAY: const float $D[$N] = float[$N](\n    $I\n);; MAKE: $T($I); "
     "vec3: vec3; direction: vec3; bits = floatBitsToInt($1); of_bits = intBitsToFloat($1); vec3 = vec3($1, $2, $3); "
     "fetch = VNDF_FETCH($1); "},
    {"hlsl", "HLSL, shader model 5 and later", 0, 4096,
     "a shader's constants end at 64 KiB, where each number takes 16 bytes",
     BOUND("", "StructuredBuffer<float> vndf_numbers : register(t0);"), "",
     "CONSTANT: static const int $D = $N;; ARRAY: static const float $D[$N] = {\n    $I\n};; ZERO:  = ($T)0; "
     "bits = asint($1); of_bits = asfloat($1); fetch = VNDF_FETCH($1); "},
    /* naga copies constant arrays at every fetch, private ones not */
    {"wgsl", "WGSL", LANGUAGE_APART, 2047, "WGSL promises arrays of 2047 constants",
     "@group(0) @binding(0) var<storage, read> vndf_numbers: array<f32>;\n", "",
     "VARIABLE: var $V: $T; MEMBER: $V: $T; SEVERAL: $V: array<$T, $N>; MEMBER_END: ,; "
     "FUNCTION: fn $D($P) -> $T {$S}; STRUCT: struct $D {$M}; CONSTANT: const $D: i32 = $N;; "
     "ARRAY: var<private> $D: array<f32, $N> = array<f32, $N>(\n    $I\n);; MAKE: $T($I); "
     "FOR: for (var $V: i32 = $A$;$V < $B$;$V++); int: i32; float: f32; real: f32; integer: i32; "
     "vec3: vec3<f32>; direction: vec3<f32>; "
     "select = select($3, $2, $1); select_int = select($3, $2, $1); to_real = f32($1); to_int = i32($1); "
     "bits = bitcast<i32>($1); of_bits = bitcast<f32>($1); vec3 = vec3<f32>($1, $2, $3); fetch = vndf_numbers[$1]; "},
    {"msl", "the Metal shading language", 0, 16384, "Metal has 64 KiB of constants", NULL,
     "#include <metal_stdlib>\nusing namespace metal;\n",
     "FUNCTION: inline $T $D($P) {$S}; ARRAY: constant float $D[$N] = {\n    $I\n};; ZERO:  = {}; "
     "POINTER: device const float *; "
     "bits = as_type<int>($1); of_bits = as_type<float>($1); with_sign = copysign($1, $2); "},
    {"python", "Python, for Dr.Jit", LANGUAGE_APART | LANGUAGE_INDENTS, 0, NULL, NULL, python_begin,
     "VARIABLE: $V; MEMBER: $V; SEVERAL: $V; END: ; MEMBER_END: ; FUNCTION: def $D($P):$S; "
     "STRUCT: class $D(_Struct):\n    __slots__ = \"\"\"$M\"\"\".split(); CONSTANT: $D = $N; ARRAY: $D = ($I); "
     "MAKE: $T($I); ZERO:  = $T(); UNSET:  = 0; FOR: for $V in range($A, $B); OPEN: :; CLOSE: ; "
     "any = True; both = ($1 & $2); either = ($1 | $2); select = dr.select($1, $2, $3); "
     "select_int = dr.select($1, $2, $3); min = _min($1, $2); max = _max($1, $2); "
     "min_int = _min($1, $2); max_int = _max($1, $2); sqrt = _sqrt($1); with_sign = dr.copysign($1, $2); "
     "bits = _bits($1); of_bits = _of_bits($1); to_real = mi.Float($1); to_int = mi.Int32($1); "
     "exp_of = dr.exp($1); exp_near = dr.exp($1); log_of = dr.log($1); load_row = $1.load_row($2, $3); fetch = ; "
     "vec3 = mi.Vector3f($1, $2, $3); place = $1.place($2); frame_below = 0; lobe_end = $1; view_weighs = 0; "},
};

const language *language_named(const char *name)
{
    for (size_t i = 0; i < sizeof languages / sizeof *languages; i++)
        if (strcmp(languages[i].name, name) == 0)
            return &languages[i];
    return NULL;
}

const char *language_word(const language *in, const char *name, int size, const char *means)
{
    const size_t gap = strlen(means), n = (size_t)size;
    for (const char *list = in->words; list; list = list == in->words ? common : NULL)
        for (const char *at = list; *at; at = strstr(at, "; ") + 2)
            if (strncmp(at, name, n) == 0 && strncmp(at + n, means, gap) == 0)
                return at + n + gap;
    return NULL;
}

/* Of the eight and Python; those of C need not stand here. */
const char language_reserved[] =
    " and as asm async auto await become buffer cast centroid class common compile constant debugger def del "
    "delete device discard elif enable except export extern filter final finally fixed flat fn fragment friend "
    "from function get global handle half hook impl import in inout input instance interface invariant is "
    "kernel lambda layout length let line linear local lowp macro match matrix meta mod module move namespace "
    "new not null of operator or out output override partition pass patch pixel point precise precision "
    "private public raise ref require resource sample sampler self set shared smooth string subroutine super "
    "target technique template texture this thread throw trait try type typename uniform unless use using var "
    "varying vec vector vertex virtual where with yield ";
