#include "export/languages.h"

#include <string.h>

static const char common_types[] = "real: float; whole: int; mask: bool; ";
static const char common_calls[] =
    "set: $1; set_whole: $1; any: $1; less: ($1 < $2); at_most: ($1 <= $2); same: ($1 == $2); both: ($1 && $2); "
    "either: ($1 || $2); pick: ($1 ? $2 : $3); pick_whole: ($1 ? $2 : $3); root: sqrt($1); size: abs($1); "
    "to_real: float($1); to_whole: int($1); ";

#define TYPED .typed = "$T $V", .several = "$T $V[$N]"
#define PLAIN_STRUCTS .structs = "struct $D {", .structs_close = "};"
#define TYPEDEF_STRUCTS .structs = "typedef struct $D {", .structs_close = "} $D;"
#define C_CONSTANTS .constant = "enum { $D = $N };", .array_close = "\n};"
#define BY_POINTER .fetched = "numbers[$1]"
#define BOUND(how, declared)                                                                        \
  .fetched = "VNDF_FETCH($1)", .bound = "// Define VNDF_FETCH(i) before this to fetch number i "    \
                                        "from anywhere else" how ".\n#ifndef VNDF_FETCH\n" declared \
                                        "\n#define VNDF_FETCH(i) vndf_numbers[i]\n#endif\n"

/* What C and C++ do not have. Functions that are not inlined pass views through memory: a sample of a table took 1.6
 * times as long as the library's, and takes 1.2 times. */
#define C_BEGIN                                                                                                \
  "\n// Define VNDF_FUNCTION before this to have functions declared in another way.\n#ifndef VNDF_FUNCTION\n"  \
  "#if defined(__GNUC__)\n#define VNDF_FUNCTION static inline __attribute__((always_inline))\n#else\n"         \
  "#define VNDF_FUNCTION static inline\n#endif\n#endif\n\n"                                                    \
  "VNDF_FUNCTION int vndf_bits(float x) {\n    int i;\n    memcpy(&i, &x, sizeof i);\n    return i;\n}\n\n"    \
  "VNDF_FUNCTION float vndf_of_bits(int i) {\n    float x;\n    memcpy(&x, &i, sizeof x);\n    return x;\n}\n" \
  "\ntypedef struct vndf_vec3 {\n    float x, y, z;\n} vndf_vec3;\n\n"                                         \
  "VNDF_FUNCTION vndf_vec3 vndf_vec3_of(float x, float y, float z) {\n"                                        \
  "    vndf_vec3 v = {x, y, z};\n    return v;\n}\n"

/* What stands before the kernel in Python; derivatives of bits are 0, those of roots at 0 too. */
static const char python_begin[] =
    "import struct\n\nimport drjit as dr\nimport mitsuba as mi\n\n\n"
    "class _Struct:\n    __slots__ = ()\n\n    def __init__(self, *values):\n"
    "        for name, value in zip(self.__slots__, values):\n            setattr(self, name, value)\n\n\n"
    "def _copy(s):\n    return type(s)(*(getattr(s, name, None) for name in s.__slots__)) if isinstance(s, _Struct) else s\n\n\n"
    "def _least(a, b):\n    return dr.select(a < b, a, b)\n\n\n"
    "def _most(a, b):\n    return dr.select(a > b, a, b)\n\n\n"
    "def _root(x):\n    return dr.sqrt(_most(x, 1e-36))\n\n\n"
    "def _bits(x):\n    if dr.is_jit_v(mi.Float):\n"
    "        return dr.reinterpret_array(mi.Int32, dr.detach(mi.Float(x)))\n"
    "    return struct.unpack(\"i\", struct.pack(\"f\", x))[0]\n\n\n"
    "def _of_bits(i):\n    if dr.is_jit_v(mi.Float):\n"
    "        return dr.reinterpret_array(mi.Float, mi.Int32(i))\n"
    "    return struct.unpack(\"f\", struct.pack(\"i\", i))[0]\n";

static const language languages[] = {
    {.name = "c",
     .title = "C99",
     .function = "VNDF_FUNCTION $T $D($P) {",
     .begin = "#include <math.h>\n#include <stdbool.h>\n#include <string.h>\n" C_BEGIN,
     .array = "static const float $D[$N] = {\n    ",
     .pointer = "const float *",
     .types = "vec3: vndf_vec3; ",
     .calls =
         "root: sqrtf($1); size: fabsf($1); with_sign: copysignf($1, $2); to_real: (float)($1); "
         "to_whole: (int)($1); bits: vndf_bits($1); of_bits: vndf_of_bits($1); vec3: vndf_vec3_of($1, $2, $3); ",
     .zero = "{0}",
     .guarded = 1,
     TYPED,
     TYPEDEF_STRUCTS,
     C_CONSTANTS,
     BY_POINTER},
    {.name = "cpp",
     .title = "C++11",
     .function = "VNDF_FUNCTION $T $D($P) {",
     .begin = "#include <cmath>\n#include <cstring>\n" C_BEGIN,
     .array = "static const float $D[$N] = {\n    ",
     .pointer = "const float *",
     .types = "vec3: vndf_vec3; ",
     .calls = "root: std::sqrt($1); size: std::fabs($1); with_sign: std::copysign($1, $2); bits: vndf_bits($1); "
              "of_bits: vndf_of_bits($1); vec3: vndf_vec3_of($1, $2, $3); ",
     .zero = "{}",
     .guarded = 1,
     TYPED,
     PLAIN_STRUCTS,
     C_CONSTANTS,
     BY_POINTER},
    {.name = "cuda",
     .title = "CUDA",
     .function = "__device__ inline $T $D($P) {",
     .begin = "",
     .array = "static __device__ const float $D[$N] = {\n    ",
     .pointer = "const float *__restrict__ ",
     .types = "vec3: float3; ",
     .calls = "root: sqrtf($1); size: fabsf($1); with_sign: copysignf($1, $2); bits: __float_as_int($1); "
              "of_bits: __int_as_float($1); vec3: make_float3($1, $2, $3); ",
     .unroll = "#pragma unroll",
     .zero = "{}",
     .guarded = 1,
     TYPED,
     PLAIN_STRUCTS,
     C_CONSTANTS,
     BY_POINTER},
    {.name = "opencl",
     .title = "OpenCL C 1.2",
     .function = "static inline $T $D($P) {",
     .begin = "",
     .array = "__constant float $D[$N] = {\n    ",
     .pointer = "__global const float *",
     .most_embedded = 16384,
     .why = "OpenCL promises 64 KiB of constants",
     .types = "vec3: float3; ",
     .calls = "size: fabs($1); with_sign: copysign($1, $2); to_real: (float)($1); to_whole: (int)($1); "
              "bits: as_int($1); of_bits: as_float($1); vec3: (float3)($1, $2, $3); ",
     .zero = "{0}",
     TYPED,
     TYPEDEF_STRUCTS,
     C_CONSTANTS,
     BY_POINTER},
    {.name = "glsl",
     .title = "GLSL 4.30 and GLSL ES 3.00",
     .function = "$T $D($P) {",
     .begin = "",
     .constant = "const int $D = $N;",
     .array = "const float $D[$N] = float[$N](\n    ",
     .array_close = "\n);",
     BOUND(", as a texture", "layout(std430, binding = 0) readonly buffer vndf_buffer { float vndf_numbers[]; };"),
     .most_embedded = 4096,
     .why = "drivers copy a constant array that is read at an index into registers, or refuse it",
     .types = "",
     .calls = "bits: floatBitsToInt($1); of_bits: intBitsToFloat($1); vec3: vec3($1, $2, $3); ",
     .made_by_call = 1,
     TYPED,
     PLAIN_STRUCTS},
    {.name = "hlsl",
     .title = "HLSL, shader model 5 and later",
     .function = "$T $D($P) {",
     .begin = "",
     .constant = "static const int $D = $N;",
     .array = "static const float $D[$N] = {\n    ",
     .array_close = "\n};",
     BOUND("", "StructuredBuffer<float> vndf_numbers : register(t0);"),
     .most_embedded = 4096,
     .why = "a shader's constants end at 64 KiB, where each number takes 16 bytes",
     .types = "vec3: float3; ",
     .calls = "bits: asint($1); of_bits: asfloat($1); vec3: float3($1, $2, $3); ",
     .zero = "($T)0",
     TYPED,
     PLAIN_STRUCTS},
    {.name = "wgsl",
     .title = "WGSL",
     .typed = "$V: $T",
     .several = "$V: array<$T, $N>",
     .given = "$V_in: $T",
     .copied = "var $V = $V_in;",
     .apart = 1,
     .made_by_call = 1,
     .function = "fn $D($P) -> $T {",
     .structs = "struct $D {",
     .structs_close = "}",
     .begin = "",
     .constant = "const $D: i32 = $N;",
     .array =
         "var<private> $D: array<f32, $N> = array<f32, $N>(\n    ", /* naga copies constant ones at every fetch */
     .array_close = "\n);",
     .fetched = "vndf_numbers[$1]",
     .bound = "@group(0) @binding(0) var<storage, read> vndf_numbers: array<f32>;\n",
     .most_embedded = 2047,
     .why = "WGSL promises arrays of 2047 constants",
     .types = "int: i32; float: f32; real: f32; whole: i32; vec3: vec3<f32>; ",
     .calls = "pick: select($3, $2, $1); pick_whole: select($3, $2, $1); to_real: f32($1); to_whole: i32($1); "
              "bits: bitcast<i32>($1); of_bits: bitcast<f32>($1); vec3: vec3<f32>($1, $2, $3); "},
    {.name = "msl",
     .title = "the Metal shading language",
     .function = "inline $T $D($P) {",
     .begin = "#include <metal_stdlib>\nusing namespace metal;\n",
     .array = "constant float $D[$N] = {\n    ",
     .pointer = "device const float *",
     .most_embedded = 16384,
     .why = "Metal has 64 KiB of constants",
     .types = "vec3: float3; ",
     .calls = "bits: as_type<int>($1); of_bits: as_type<float>($1); with_sign: copysign($1, $2); "
              "vec3: float3($1, $2, $3); ",
     .zero = "{}",
     TYPED,
     PLAIN_STRUCTS,
     C_CONSTANTS,
     BY_POINTER},
    {.name = "python",
     .title = "Python, for Dr.Jit",
     .typed = "$V",
     .given = "$V",
     .copied = "$V = _copy($V)",
     .apart = 1,
     .made_by_call = 1,
     .indents = 1,
     .function = "def $D($P):",
     .structs = "class $D(_Struct):\n    __slots__ = (",
     .structs_close = ")",
     .begin = python_begin,
     .constant = "$D = $N",
     .array = "$D = (\n    ",
     .array_close = ")",
     .fetched = "",
     .types = "",
     .calls = "any: True; both: ($1 & $2); either: ($1 | $2); pick: dr.select($1, $2, $3); "
              "pick_whole: dr.select($1, $2, $3); least: _least($1, $2); most: _most($1, $2); "
              "least_whole: _least($1, $2); most_whole: _most($1, $2); root: _root($1); "
              "with_sign: dr.copysign($1, $2); bits: _bits($1); of_bits: _of_bits($1); to_real: mi.Float($1); "
              "to_whole: mi.Int32($1); exp_of: dr.exp($1); exp_near: dr.exp($1); log_of: dr.log($1); "
              "look: $1.look($2, $3); ",
     .zero = "$T()"},
};

const language *language_named(const char *name)
{
    for (size_t i = 0; i < sizeof languages / sizeof *languages; i++)
        if (strcmp(languages[i].name, name) == 0)
            return &languages[i];
    return NULL;
}

const char *const language_names[LANGUAGES] = {"c", "cpp", "cuda", "opencl", "glsl", "hlsl", "wgsl", "msl"};

/* In a list of "word: pattern; ". */
static const char *find(const char *list, const char *name, int size, int *length)
{
    for (const char *end; (end = strchr(list, ';')); list = end + 2)
        if (strncmp(list, name, (size_t)size) == 0 && list[size] == ':') {
            *length = (int)(end - list) - size - 2;
            return list + size + 2;
        }
    return NULL;
}

const char *language_type(const language *in, const char *name, int size, int *length)
{
    const char *own = find(in->types, name, size, length);
    return own ? own : find(common_types, name, size, length);
}

const char *language_call(const language *in, const char *name, int size, int *length)
{
    const char *own = find(in->calls, name, size, length);
    return own ? own : find(common_calls, name, size, length);
}

/* Of the eight and Python; those of C need not stand here. */
const char language_reserved[] =
    " abstract active alignas and as asm assert async attribute auto await become binding buffer cast centroid "
    "class coherent common compile constant crate debugger def del delete demote device discard elif enable "
    "except export extern filter final finally fixed flat fn fragment friend from function fxgroup generic get "
    "global goto groupshared half handle hook impl implements import in inline inout input interface invariant "
    "is kernel lambda layout length let line linear local lowp macro match matrix mediump meta mod module move "
    "mut namespace new nil noexcept noinline nointerpolation None nonlocal not null of operator or out output "
    "override package packed partition pass patch pipe pixelfragment point precise precision priv private "
    "protected ptr pub public raise readonly ref regardless register require resource row_major sample sampler "
    "self set shared smooth snorm std string subroutine super superp target technique template texture this "
    "thread throw trait triangle try type typename uniform unless unorm use using var varying vec vector vertex "
    "virtual wgsl where with writeonly xor yield ";
