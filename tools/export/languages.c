#include "export/languages.h"

#include <string.h>

static const renamed common_types[] = {{"real", "float"}, {"whole", "int"}, {"mask", "bool"}, {NULL, NULL}};
static const renamed common_calls[] = {{"set", "$1"},
                                       {"set_whole", "$1"},
                                       {"any", "$1"},
                                       {"less", "($1 < $2)"},
                                       {"at_most", "($1 <= $2)"},
                                       {"same", "($1 == $2)"},
                                       {"both", "($1 && $2)"},
                                       {"either", "($1 || $2)"},
                                       {"pick", "($1 ? $2 : $3)"},
                                       {"pick_whole", "($1 ? $2 : $3)"},
                                       {"root", "sqrt($1)"},
                                       {"size", "abs($1)"},
                                       {"to_real", "float($1)"},
                                       {"to_whole", "int($1)"},
                                       {NULL, NULL}};

#define CALLS_OF_C                              \
  {"root", "sqrtf($1)"}, {"size", "fabsf($1)"}, \
  {                                             \
    "with_sign", "copysignf($1, $2)"            \
  }
#define CASTS_OF_C            \
  {"to_real", "(float)($1)"}, \
  {                           \
    "to_whole", "(int)($1)"   \
  }
#define BITS_OF_C                 \
  {"bits", "vndf_bits($1)"},      \
  {                               \
    "of_bits", "vndf_of_bits($1)" \
  }
#define BITS_TEXT(how)                                                        \
  how "int vndf_bits(float x) {\n    int i;\n    memcpy(&i, &x, sizeof i);\n" \
      "    return i;\n}\n\n" how                                              \
      "float vndf_of_bits(int i) {\n    float x;\n    memcpy(&x, &i, sizeof x);\n    return x;\n}\n"

/* What stands before the kernel in Python; derivatives of bits are 0, those of roots at 0 too. */
#define PYTHON_TEXT                                                                                       \
  "import struct\n\nimport drjit as dr\nimport mitsuba as mi\n\n\n"                                       \
  "class _Struct:\n    __slots__ = ()\n\n    def __init__(self, *values):\n"                              \
  "        for name, value in zip(self.__slots__, values):\n            setattr(self, name, value)\n\n\n" \
  "def _copy(s):\n    return type(s)(*(getattr(s, name, None) for name in s.__slots__))\n\n\n"            \
  "def _least(a, b):\n    return dr.select(a < b, a, b)\n\n\n"                                            \
  "def _most(a, b):\n    return dr.select(a > b, a, b)\n\n\n"                                             \
  "def _root(x):\n    return dr.sqrt(_most(x, 1e-36))\n\n\n"                                              \
  "def _bits(x):\n    if dr.is_jit_v(mi.Float):\n"                                                        \
  "        return dr.reinterpret_array(mi.Int32, dr.detach(mi.Float(x)))\n"                               \
  "    return struct.unpack(\"i\", struct.pack(\"f\", x))[0]\n\n\n"                                       \
  "def _of_bits(i):\n    if dr.is_jit_v(mi.Float):\n"                                                     \
  "        return dr.reinterpret_array(mi.Float, mi.Int32(i))\n"                                          \
  "    return struct.unpack(\"f\", struct.pack(\"i\", i))[0]\n"

static const language languages[] = {
    {.name = "c",
     .title = "C99",
     .zero = "{0}",
     .structs = STRUCT_TYPEDEF,
     .buffer = BUFFER_PARAMETER,
     .keeps_const = 1,
     .vec3_is_ours = 1,
     .guarded = 1,
     .function = "static inline ",
     .begin = "#include <math.h>\n#include <stdbool.h>\n#include <string.h>\n\n" BITS_TEXT("static inline "),
     .constant = "enum { $NAME = $N };\n",
     .array = "static const float $NAME[$N] = {",
     .array_close = "};",
     .pointer = "const float *",
     .fetched = "numbers[$1]",
     .types = {{"vec3", "vndf_vec3"}},
     .calls = {CALLS_OF_C, CASTS_OF_C, BITS_OF_C, {"vec3", "vndf_vec3_of($1, $2, $3)"}}},
    {.name = "cpp",
     .title = "C++11",
     .zero = "{}",
     .buffer = BUFFER_PARAMETER,
     .keeps_const = 1,
     .vec3_is_ours = 1,
     .guarded = 1,
     .function = "inline ",
     .begin = "#include <cmath>\n#include <cstring>\n\n" BITS_TEXT("inline "),
     .constant = "enum { $NAME = $N };\n",
     .array = "static const float $NAME[$N] = {",
     .array_close = "};",
     .pointer = "const float *",
     .fetched = "numbers[$1]",
     .types = {{"vec3", "vndf_vec3"}},
     .calls = {{"root", "std::sqrt($1)"},
               {"size", "std::fabs($1)"},
               {"with_sign", "std::copysign($1, $2)"},
               BITS_OF_C,
               {"vec3", "vndf_vec3_of($1, $2, $3)"}}},
    {.name = "cuda",
     .title = "CUDA",
     .zero = "{}",
     .buffer = BUFFER_PARAMETER,
     .keeps_const = 1,
     .guarded = 1,
     .function = "__device__ inline ",
     .unroll = "#pragma unroll",
     .begin = "",
     .constant = "enum { $NAME = $N };\n",
     .array = "static __device__ const float $NAME[$N] = {",
     .array_close = "};",
     .pointer = "const float *__restrict__ ",
     .fetched = "numbers[$1]",
     .types = {{"vec3", "float3"}},
     .calls = {CALLS_OF_C,
               {"bits", "__float_as_int($1)"},
               {"of_bits", "__int_as_float($1)"},
               {"vec3", "make_float3($1, $2, $3)"}}},
    {.name = "opencl",
     .title = "OpenCL C 1.2",
     .zero = "{0}",
     .structs = STRUCT_TYPEDEF,
     .buffer = BUFFER_PARAMETER,
     .keeps_const = 1,
     .function = "static inline ",
     .begin = "",
     .constant = "enum { $NAME = $N };\n",
     .array = "__constant float $NAME[$N] = {",
     .array_close = "};",
     .pointer = "__global const float *",
     .fetched = "numbers[$1]",
     .most_embedded = 16384,
     .why = "OpenCL promises 64 KiB of constants",
     .types = {{"vec3", "float3"}},
     .calls = {{"size", "fabs($1)"},
               {"with_sign", "copysign($1, $2)"},
               CASTS_OF_C,
               {"bits", "as_int($1)"},
               {"of_bits", "as_float($1)"},
               {"vec3", "(float3)($1, $2, $3)"}}},
    {.name = "glsl",
     .title = "GLSL 4.30 and GLSL ES 3.00",
     .buffer = BUFFER_BOUND,
     .made_by_call = 1,
     .function = "",
     .begin = "",
     .constant = "const int $NAME = $N;\n",
     .array = "const float $NAME[$N] = float[$N](",
     .array_close = ");",
     .fetched = "VNDF_FETCH($1)",
     .bound = "// Define VNDF_FETCH(i) before this to fetch number i from anywhere else, as a texture.\n"
              "#ifndef VNDF_FETCH\n"
              "layout(std430, binding = 0) readonly buffer vndf_buffer { float vndf_numbers[]; };\n"
              "#define VNDF_FETCH(i) vndf_numbers[i]\n"
              "#endif\n",
     .most_embedded = 4096,
     .why = "drivers copy a constant array that is read at an index into registers, or refuse it",
     .calls = {{"bits", "floatBitsToInt($1)"}, {"of_bits", "intBitsToFloat($1)"}, {"vec3", "vec3($1, $2, $3)"}}},
    {.name = "hlsl",
     .title = "HLSL, shader model 5 and later",
     .zero = "($)0",
     .buffer = BUFFER_BOUND,
     .function = "",
     .begin = "",
     .constant = "static const int $NAME = $N;\n",
     .array = "static const float $NAME[$N] = {",
     .array_close = "};",
     .fetched = "VNDF_FETCH($1)",
     .bound = "// Define VNDF_FETCH(i) before this to fetch number i from anywhere else.\n"
              "#ifndef VNDF_FETCH\n"
              "StructuredBuffer<float> vndf_numbers : register(t0);\n"
              "#define VNDF_FETCH(i) vndf_numbers[i]\n"
              "#endif\n",
     .most_embedded = 4096,
     .why = "a shader's constants end at 64 KiB, where each number takes 16 bytes",
     .types = {{"vec3", "float3"}},
     .calls = {{"bits", "asint($1)"}, {"of_bits", "asfloat($1)"}, {"vec3", "float3($1, $2, $3)"}}},
    {.name = "wgsl",
     .title = "WGSL",
     .structs = STRUCT_FIELDS,
     .buffer = BUFFER_BOUND,
     .typed_after = 1,
     .made_by_call = 1,
     .function = "fn ",
     .begin = "",
     .constant = "const $NAME: i32 = $N;\n",
     .array = "const $NAME: array<f32, $N> = array<f32, $N>(",
     .numbers = /* naga copies constant arrays at every fetch */
     "var<private> $NAME: array<f32, $N> = array<f32, $N>(",
     .array_close = ");",
     .fetched = "vndf_numbers[$1]",
     .bound = "@group(0) @binding(0) var<storage, read> vndf_numbers: array<f32>;\n",
     .most_embedded = 2047,
     .why = "WGSL promises arrays of 2047 constants",
     .types = {{"int", "i32"}, {"float", "f32"}, {"real", "f32"}, {"whole", "i32"}, {"vec3", "vec3<f32>"}},
     .calls = {{"pick", "select($3, $2, $1)"},
               {"pick_whole", "select($3, $2, $1)"},
               {"to_real", "f32($1)"},
               {"to_whole", "i32($1)"},
               {"bits", "bitcast<i32>($1)"},
               {"of_bits", "bitcast<f32>($1)"},
               {"vec3", "vec3<f32>($1, $2, $3)"}}},
    {.name = "msl",
     .title = "the Metal shading language",
     .zero = "{}",
     .buffer = BUFFER_PARAMETER,
     .keeps_const = 1,
     .function = "inline ",
     .begin = "#include <metal_stdlib>\nusing namespace metal;\n",
     .constant = "enum { $NAME = $N };\n",
     .array = "constant float $NAME[$N] = {",
     .array_close = "};",
     .pointer = "device const float *",
     .fetched = "numbers[$1]",
     .most_embedded = 16384,
     .why = "Metal has 64 KiB of constants",
     .types = {{"vec3", "float3"}},
     .calls = {{"bits", "as_type<int>($1)"},
               {"of_bits", "as_type<float>($1)"},
               {"with_sign", "copysign($1, $2)"},
               {"vec3", "float3($1, $2, $3)"}}},
    {.name = "python",
     .title = "Python, for Dr.Jit",
     .zero = "$()",
     .structs = STRUCT_CLASS,
     .made_by_call = 1,
     .indents = 1,
     .begin = PYTHON_TEXT,
     .constant = "$NAME = $N\n",
     .array = "$NAME = (",
     .array_close = ")",
     .calls = {{"both", "($1 & $2)"},
               {"either", "($1 | $2)"},
               {"pick", "dr.select($1, $2, $3)"},
               {"pick_whole", "dr.select($1, $2, $3)"},
               {"least", "_least($1, $2)"},
               {"most", "_most($1, $2)"},
               {"least_whole", "_least($1, $2)"},
               {"most_whole", "_most($1, $2)"},
               {"root", "_root($1)"},
               {"with_sign", "dr.copysign($1, $2)"},
               {"bits", "_bits($1)"},
               {"of_bits", "_of_bits($1)"},
               {"to_real", "mi.Float($1)"},
               {"to_whole", "mi.Int32($1)"},
               {"exp_of", "dr.exp($1)"},
               {"exp_near", "dr.exp($1)"},
               {"log_of", "dr.log($1)"},
               {"look", "$1.look($2, $3)"}}},
};

enum { LANGUAGES = sizeof languages / sizeof languages[0] };

const language *language_named(const char *name)
{
    for (size_t i = 0; i < LANGUAGES; i++)
        if (strcmp(languages[i].name, name) == 0)
            return &languages[i];
    return NULL;
}

const char *const *language_names(void)
{
    static const char *const names[] = {"c", "cpp", "cuda", "opencl", "glsl", "hlsl", "wgsl", "msl", NULL};
    return names;
}

static const char *find(const renamed *list, size_t count, const char *name, size_t length)
{
    for (size_t i = 0; i < count && list[i].from; i++)
        if (strlen(list[i].from) == length && memcmp(list[i].from, name, length) == 0)
            return list[i].to;
    return NULL;
}

const char *language_type(const language *in, const char *name, size_t length)
{
    const char *own = find(in->types, sizeof in->types / sizeof in->types[0], name, length);
    return own ? own : find(common_types, 3, name, length);
}

const char *language_call(const language *in, const char *name, size_t length)
{
    const char *own = find(in->calls, RENAMED_MAX, name, length);
    return own ? own : find(common_calls, sizeof common_calls / sizeof common_calls[0], name, length);
}

/* Of the eight and Python; those of C need not stand here. */
static const char reserved[] =
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

int language_reserves(const char *name, size_t length)
{
    for (const char *at = reserved; (at = strchr(at, ' ')) && at[1]; at++)
        if (strncmp(at + 1, name, length) == 0 && at[1 + length] == ' ')
            return 1;
    return 0;
}
