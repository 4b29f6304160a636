#include "export/languages.h"

#include <string.h>

#define ROOTS_OF_C                                                                        \
  {"abs", "fabsf"}, {"sqrt", "sqrtf"}, {"exp", "expf"}, {"log", "logf"}, {"sin", "sinf"}, \
  {                                                                                       \
    "cos", "cosf"                                                                         \
  }
/* The C library's fminf is a call, with care for NaN. */
#define OUR_LIMITS                          \
  {"min", "vndf_min"}, {"max", "vndf_max"}, \
  {                                         \
    "clamp", "vndf_clamp"                   \
  }

static const language languages[] = {
    {.name = "c",
     .constant = "enum { VNDF_$NAME = $N };\n",
     .guarded = 1,
     .title = "C99",
     .structs = STRUCT_TYPEDEF,
     .made = MADE_COMPOUND,
     .buffer = BUFFER_PARAMETER,
     .casts = 1,
     .vec3_is_ours = 1,
     .suffix = "f",
     .function = "static inline ",
     .begin = "#include <math.h>\n#include <stdbool.h>\n",
     .numbers = "static const float VNDF_NUMBERS[$N] = {",
     .numbers_close = "};",
     .pointer = "const float *",
     .names = {ROOTS_OF_C, OUR_LIMITS, {"vec3", "vndf_vec3"}}},
    {.name = "cpp",
     .constant = "enum { VNDF_$NAME = $N };\n",
     .guarded = 1,
     .title = "C++11",
     .structs = STRUCT_PLAIN,
     .made = MADE_BRACES,
     .buffer = BUFFER_PARAMETER,
     .vec3_is_ours = 1,
     .suffix = "f",
     .function = "inline ",
     .begin = "#include <cmath>\n",
     .numbers = "static const float VNDF_NUMBERS[$N] = {",
     .numbers_close = "};",
     .pointer = "const float *",
     .names = {{"abs", "std::fabs"},
               {"sqrt", "std::sqrt"},
               {"exp", "std::exp"},
               {"log", "std::log"},
               {"sin", "std::sin"},
               {"cos", "std::cos"},
               OUR_LIMITS,
               {"vec3", "vndf_vec3"}}},
    {.name = "cuda",
     .constant = "enum { VNDF_$NAME = $N };\n",
     .guarded = 1,
     .title = "CUDA",
     .structs = STRUCT_PLAIN,
     .made = MADE_BRACES,
     .buffer = BUFFER_PARAMETER,
     .suffix = "f",
     .function = "__device__ inline ",
     .vec3_made = "make_float3",
     .begin = "",
     .numbers = "static __device__ const float VNDF_NUMBERS[$N] = {",
     .numbers_close = "};",
     .pointer = "const float *__restrict__ ",
     .names = {ROOTS_OF_C, {"min", "fminf"}, {"max", "fmaxf"}, {"clamp", "vndf_clamp"}, {"vec3", "float3"}}},
    {.name = "opencl",
     .constant = "enum { VNDF_$NAME = $N };\n",
     .title = "OpenCL C 1.2",
     .structs = STRUCT_TYPEDEF,
     .made = MADE_COMPOUND,
     .buffer = BUFFER_PARAMETER,
     .casts = 1,
     .suffix = "f",
     .function = "static inline ",
     .vec3_made = "(float3)",
     .begin = "",
     .numbers = "__constant float VNDF_NUMBERS[$N] = {",
     .numbers_close = "};",
     .pointer = "__global const float *",
     .most_embedded = 16384,
     .why = "OpenCL promises 64 KiB of constants",
     .names = {{"abs", "fabs"}, {"min", "fmin"}, {"max", "fmax"}, {"vec3", "float3"}}},
    {.name = "glsl",
     .constant = "const int VNDF_$NAME = $N;\n",
     .title = "GLSL 4.30 and GLSL ES 3.10",
     .structs = STRUCT_PLAIN,
     .made = MADE_CALL,
     .buffer = BUFFER_BOUND,
     .suffix = "",
     .function = "",
     .vec3_made = "vec3",
     .begin = "",
     .numbers = "const float VNDF_NUMBERS[$N] = float[$N](",
     .numbers_close = ");",
     .fetched = "VNDF_FETCH(i)",
     .bound = "// Define VNDF_FETCH(i) before this to fetch number i from anywhere else, as a texture.\n"
              "#ifndef VNDF_FETCH\n"
              "layout(std430, binding = 0) readonly buffer vndf_buffer { float vndf_numbers[]; };\n"
              "#define VNDF_FETCH(i) vndf_numbers[i]\n"
              "#endif\n",
     .most_embedded = 4096,
     .why = "drivers copy a constant array that is read at an index into registers, or refuse it",
     .names = {{NULL, NULL}}},
    {.name = "hlsl",
     .constant = "static const int VNDF_$NAME = $N;\n",
     .title = "HLSL, shader model 5 and later",
     .structs = STRUCT_PLAIN,
     .made = MADE_FUNCTION,
     .buffer = BUFFER_BOUND,
     .suffix = "",
     .function = "",
     .vec3_made = "float3",
     .begin = "",
     .numbers = "static const float VNDF_NUMBERS[$N] = {",
     .numbers_close = "};",
     .fetched = "VNDF_FETCH(i)",
     .bound = "// Define VNDF_FETCH(i) before this to fetch number i from anywhere else.\n"
              "#ifndef VNDF_FETCH\n"
              "StructuredBuffer<float> vndf_numbers : register(t0);\n"
              "#define VNDF_FETCH(i) vndf_numbers[i]\n"
              "#endif\n",
     .most_embedded = 4096,
     .why = "a shader's constants end at 64 KiB, where each number takes 16 bytes",
     .names = {{"vec3", "float3"}}},
    {.name = "wgsl",
     .constant = "const VNDF_$NAME: i32 = $N;\n",
     .title = "WGSL",
     .structs = STRUCT_FIELDS,
     .made = MADE_CALL,
     .buffer = BUFFER_BOUND,
     .typed_after = 1,
     .suffix = "",
     .function = "fn ",
     .vec3_made = "vec3<f32>",
     .begin = "",
     .numbers =
         "var<private> VNDF_NUMBERS: array<f32, $N> = array<f32, $N>(", /* naga copies constant arrays at every fetch */
     .numbers_close = ");",
     .fetched = "vndf_numbers[i]",
     .bound = "@group(0) @binding(0) var<storage, read> vndf_numbers: array<f32>;\n",
     .most_embedded = 2047,
     .why = "WGSL promises arrays of 2047 constants",
     .names = {{"int", "i32"}, {"float", "f32"}, {"vec3", "vec3<f32>"}}},
    {.name = "msl",
     .constant = "enum { VNDF_$NAME = $N };\n",
     .title = "the Metal shading language",
     .structs = STRUCT_PLAIN,
     .made = MADE_BRACES,
     .buffer = BUFFER_PARAMETER,
     .suffix = "f",
     .function = "inline ",
     .vec3_made = "float3",
     .begin = "#include <metal_stdlib>\nusing namespace metal;\n",
     .numbers = "constant float VNDF_NUMBERS[$N] = {",
     .numbers_close = "};",
     .pointer = "device const float *",
     .most_embedded = 16384,
     .why = "Metal has 64 KiB of constants",
     .names = {{"vec3", "float3"}}},
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

const char *language_word(const language *in, const char *name, size_t length)
{
    for (size_t i = 0; i < RENAMED_MAX && in->names[i].from; i++)
        if (strlen(in->names[i].from) == length && memcmp(in->names[i].from, name, length) == 0)
            return in->names[i].to;
    return NULL;
}
