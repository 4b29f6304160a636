/* The types of the kernel as VNDF_LANES numbers side by side: 4, 8 or 16, by the vector extensions of GCC and Clang.
 * The same names as in one.h, the same operations in the same order: the same bits. Intrinsics stand only where the
 * extensions have no word for an instruction.
 *
 * A table is read by rows of four numbers, one load a lane and a transposition. Searches begin with columns in the
 * order of the levels of a search, and with 16 lanes all of a small table is in columns: they are in registers, which
 * are permuted. Columns are copies that a call makes once. */
#ifndef VNDF_KERNEL_LANES_H
#define VNDF_KERNEL_LANES_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/inline.h"
#include "table/table.h"

#if defined(__x86_64__) || defined(__i386__)
#  include <immintrin.h>
#  define VNDF_KERNEL_X86 1
#else
#  define VNDF_KERNEL_X86 0
#endif

#define KERNEL VNDF_INLINE

/* Before loops over lanes, which gcc -O2 would not unroll. */
#if defined(__clang__)
#  define LANES_UNROLLED _Pragma("clang loop unroll(full)")
#else
#  define LANES_UNROLLED _Pragma("GCC unroll 16")
#endif

enum { LANES = VNDF_LANES };

typedef float real __attribute__((vector_size(4 * VNDF_LANES)));
typedef int32_t integer __attribute__((vector_size(4 * VNDF_LANES)));

#if VNDF_LANES == 16
typedef __mmask16 mask;
#else
typedef integer mask; /* 0 or -1 */
#endif

#if VNDF_KERNEL_X86 && VNDF_LANES == 16
#  define LANES_INSTRUCTION(name) _mm512_##name
typedef __m512 lanes_register;
typedef __m512d lanes_doubles;
#elif VNDF_KERNEL_X86 && VNDF_LANES == 8
#  define LANES_INSTRUCTION(name) _mm256_##name
typedef __m256 lanes_register;
typedef __m256d lanes_doubles;
#elif VNDF_KERNEL_X86
#  define LANES_INSTRUCTION(name) _mm_##name
typedef __m128 lanes_register;
typedef __m128d lanes_doubles;
#endif

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real x, y, z, w;
} quad;

KERNEL real set(float x)
{
    return x - (real){0};
}

KERNEL integer set_int(int i)
{
    return i - (integer){0};
}

KERNEL real load(const float *from)
{
    real x;
    memcpy(&x, from, sizeof x);
    return x;
}

KERNEL void store(float *to, real x)
{
    memcpy(to, &x, sizeof x);
}

KERNEL integer bits(real x)
{
    return (integer)x;
}

KERNEL real of_bits(integer i)
{
    return (real)i;
}

/* ---- choices ---- */

#if VNDF_LANES == 16 /* masks in registers of their own */

KERNEL mask lt(real a, real b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}

KERNEL mask le(real a, real b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}

KERNEL mask eq(integer a, int b)
{
    return _mm512_cmpeq_epi32_mask((__m512i)a, _mm512_set1_epi32(b));
}

KERNEL mask lt_int(integer a, integer b)
{
    return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}

KERNEL unsigned mask_bits(mask m)
{
    return m;
}

KERNEL real select(mask m, real yes, real no)
{
    return (real)_mm512_mask_blend_ps(m, (__m512)no, (__m512)yes);
}

KERNEL integer select_int(mask m, integer yes, integer no)
{
    return (integer)_mm512_mask_blend_epi32(m, (__m512i)no, (__m512i)yes);
}

#else

KERNEL mask lt(real a, real b)
{
    return a < b;
}

KERNEL mask le(real a, real b)
{
    return a <= b;
}

KERNEL mask eq(integer a, int b)
{
    return a == b;
}

KERNEL mask lt_int(integer a, integer b)
{
    return a < b;
}

KERNEL unsigned mask_bits(mask m)
{
#  if VNDF_KERNEL_X86
    return (unsigned)LANES_INSTRUCTION(movemask_ps)((lanes_register)m);
#  else
    unsigned found = 0;
    for (int l = 0; l < LANES; l++)
        found |= (unsigned)m[l] & 1u << l;
    return found;
#  endif
}

KERNEL integer select_int(mask m, integer yes, integer no)
{
#  if VNDF_KERNEL_X86 && VNDF_LANES == 8 /* one instruction for three */
    return (integer)_mm256_blendv_epi8((__m256i)no, (__m256i)yes, (__m256i)m);
#  else
    return (m & yes) | (~m & no);
#  endif
}

KERNEL real select(mask m, real yes, real no)
{
    return of_bits(select_int(m, bits(yes), bits(no)));
}

#endif

KERNEL int any(mask m)
{
    return mask_bits(m) != 0;
}

KERNEL mask both(mask a, mask b)
{
    return (mask)(a & b);
}

KERNEL mask either(mask a, mask b)
{
    return (mask)(a | b);
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. That is what the instructions of x86 do. */
KERNEL real min(real a, real b)
{
#if VNDF_KERNEL_X86
    return (real)LANES_INSTRUCTION(min_ps)((lanes_register)a, (lanes_register)b);
#else
    return select(lt(a, b), a, b);
#endif
}

KERNEL real max(real a, real b)
{
#if VNDF_KERNEL_X86
    return (real)LANES_INSTRUCTION(max_ps)((lanes_register)a, (lanes_register)b);
#else
    return select(lt(b, a), a, b);
#endif
}

KERNEL real kernel_sqrt(real x)
{
#if VNDF_KERNEL_X86
    return (real)LANES_INSTRUCTION(sqrt_ps)((lanes_register)x);
#else
    for (int l = 0; l < LANES; l++)
        x[l] = __builtin_sqrtf(x[l]);
    return x;
#endif
}

KERNEL real kernel_abs(real x)
{
    return of_bits(bits(x) & 0x7fffffff);
}

/* C's own are of doubles and of ints. */
#define sqrt(x) kernel_sqrt(x)
#define abs(x) kernel_abs(x)

/* |x| with the sign of y. */
KERNEL real with_sign(real x, real y)
{
    return of_bits((bits(x) & 0x7fffffff) | (bits(y) & ~0x7fffffff));
}

KERNEL real to_real(integer i)
{
    return __builtin_convertvector(i, real);
}

/* The whole part of x, |x| < 2^31. */
KERNEL integer to_int(real x)
{
    return __builtin_convertvector(x, integer);
}

KERNEL integer min_int(integer a, integer b)
{
    return select_int(lt_int(a, b), a, b);
}

KERNEL integer max_int(integer a, integer b)
{
    return select_int(lt_int(b, a), a, b);
}

/* ---- some of 64 numbers, those whose bits are set ---- */

typedef struct picks {
    uint64_t which;
    int count;
    uint8_t at[64]; /* where they are, for fewer than 16 lanes */
} picks;

KERNEL picks picks_of(uint64_t which)
{
    picks p;
    p.which = which;
    p.count = __builtin_popcountll(which);
    for (int n = 0; VNDF_LANES < 16 && which; which &= which - 1)
        p.at[n++] = (uint8_t)__builtin_ctzll(which);
    return p;
}

/* Puts them together; what is behind them, up to number 64, may change. */
KERNEL void pack(const float *from, const picks *p, float *to)
{
#if VNDF_LANES == 16
    for (int i = 0, n = 0; i < 64; n += __builtin_popcount(p->which >> i & 0xffff), i += LANES) {
        const mask some = (mask)(p->which >> i);
        store(to + n, (real)_mm512_maskz_compress_ps(some, _mm512_maskz_loadu_ps(some, from + i)));
    }
#else
    for (int n = 0; n < p->count; n++)
        to[n] = from[p->at[n]];
#endif
}

KERNEL void unpack(const float *from, const picks *p, float *to)
{
#if VNDF_LANES == 16
    for (int i = 0, n = 0; i < 64; n += __builtin_popcount(p->which >> i & 0xffff), i += LANES) {
        const mask some = (mask)(p->which >> i);
        _mm512_mask_storeu_ps(to + i, some, _mm512_maskz_expand_ps(some, (__m512)load(from + n)));
    }
#else
    for (int n = 0; n < p->count; n++)
        to[p->at[n]] = from[n];
#endif
}

/* ---- tables ---- */

/* Steps of a search in one register, and in registers. */
#if VNDF_LANES == 16
enum { FIRST_LEVELS = 4, LEVELS = 7 };
#elif VNDF_LANES == 8
enum { FIRST_LEVELS = 3, LEVELS = 6 };
#else
enum { FIRST_LEVELS = 1, LEVELS = 3 };
#endif

/* A table as the kernel reads it (table/table.h). */
typedef struct table {
    const float *numbers;
    const vndf_layout *layout;
    int cells, moments, squarings, highest, steps; /* highest: the highest power of two <= cells, 2^(steps - 1) */
    int levels, stride; /* search steps in the level arrays; knots per leaf left for the search by rows */
    int copied;         /* registers of a column in pairs: 2 or 4, 0 if there are no columns */
} table;

/* Four numbers of each lane, those of lane l from row[l] on: quarters of registers are transposed. */
KERNEL quad transposed(const float *const row[LANES])
{
#if VNDF_KERNEL_X86
    lanes_register r[4];
    LANES_UNROLLED
    for (int l = 0; l < 4; l++) {
#  if VNDF_LANES == 4
        r[l] = _mm_loadu_ps(row[l]);
#  elif VNDF_LANES == 8
        r[l] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[l])), _mm_loadu_ps(row[l + 4]), 1);
#  else
        r[l] = _mm512_castps128_ps512(_mm_loadu_ps(row[l]));
        r[l] = _mm512_insertf32x4(r[l], _mm_loadu_ps(row[l + 4]), 1);
        r[l] = _mm512_insertf32x4(r[l], _mm_loadu_ps(row[l + 8]), 2);
        r[l] = _mm512_insertf32x4(r[l], _mm_loadu_ps(row[l + 12]), 3);
#  endif
    }
    lanes_doubles e = (lanes_doubles)LANES_INSTRUCTION(unpacklo_ps)(r[0], r[1]);
    lanes_doubles f = (lanes_doubles)LANES_INSTRUCTION(unpackhi_ps)(r[0], r[1]);
    lanes_doubles g = (lanes_doubles)LANES_INSTRUCTION(unpacklo_ps)(r[2], r[3]);
    lanes_doubles h = (lanes_doubles)LANES_INSTRUCTION(unpackhi_ps)(r[2], r[3]);
    quad q = {(real)LANES_INSTRUCTION(unpacklo_pd)(e, g), (real)LANES_INSTRUCTION(unpackhi_pd)(e, g),
              (real)LANES_INSTRUCTION(unpacklo_pd)(f, h), (real)LANES_INSTRUCTION(unpackhi_pd)(f, h)};
    return q;
#else
    real a = load(row[0]), b = load(row[1]), c = load(row[2]), d = load(row[3]);
    quad q = {
        {a[0], b[0], c[0], d[0]}, {a[1], b[1], c[1], d[1]}, {a[2], b[2], c[2], d[2]}, {a[3], b[3], c[3], d[3]}};
    return q;
#endif
}

KERNEL quad load_rows(table t, int group, integer i)
{
    const float *first = t.numbers + 4 * group, *row[LANES];
    int32_t at[LANES];
    memcpy(at, &i, sizeof at);
    LANES_UNROLLED
    for (int l = 0; l < LANES; l++)
        row[l] = first + VNDF_STRIDE * at[l];
    return transposed(row);
}

#if VNDF_LANES == 16

/* Entry i of 32 numbers; of 64, which bit 5 of i halves. */
KERNEL real entry_32(const float *c, integer i)
{
    return (real)_mm512_permutex2var_ps(_mm512_load_ps(c), (__m512i)i, _mm512_load_ps(c + 16));
}

KERNEL real entry_64(const float *c, integer i)
{
    mask odd = _mm512_test_epi32_mask((__m512i)i, _mm512_set1_epi32(32));
    return select(odd, entry_32(c + 32, i), entry_32(c, i));
}

KERNEL real column_entry(table t, const float *c, integer i)
{
    real r = entry_64(c, i);
    if (t.copied > 2)
        r = select(_mm512_test_epi32_mask((__m512i)i, _mm512_set1_epi32(64)), entry_64(c + 64, i), r);
    return r;
}

#endif

/* The knot where the law begins, by the eighth of an octave of rho. */
KERNEL integer first_knot(table t, integer eighth)
{
#if VNDF_LANES == 16
    const float *parts = (const float *)(const void *)t.layout->first;
    real first = entry_64(parts, eighth);
    LANES_UNROLLED
    for (int n = 64; n < VNDF_RHO_PARTS; n += 64)
        first = select(lt_int(eighth, set_int(n)), first, entry_64(parts + n, eighth));
    return bits(first);
#else
    LANES_UNROLLED
    for (int l = 0; l < LANES; l++)
        eighth[l] = t.layout->first[eighth[l]];
    return eighth;
#endif
}

/* A row of knot i. */
KERNEL quad load_row(table t, int group, integer i)
{
#if VNDF_LANES == 16
    if (t.copied) {
        const float(*c)[VNDF_COPIED] = t.layout->column[group];
        quad q = {column_entry(t, c[0], i), column_entry(t, c[1], i), column_entry(t, c[2], i),
                  column_entry(t, c[3], i)};
        return q;
    }
#endif
    return load_rows(t, group, i);
}

KERNEL table table_of(const vndf_distribution *d)
{
    const int steps = d->steps > VNDF_STEPS_LEAST ? d->steps : VNDF_STEPS_LEAST,
              levels = steps < LEVELS ? steps : LEVELS,
              copied = d->cells < 64            ? 2
                       : d->cells < VNDF_COPIED ? 4
                                                : 0;
    table t = {d->numbers + VNDF_HEAD, d->layout, d->cells, d->moments, d->squarings, d->highest, d->steps, levels,
               1 << (steps - levels),  copied};
    return t;
}

/* ---- searches ----
 *
 * The last knot that passes: each step compares with the knot in the middle of what is left. An entry `at` of a step is
 * followed in the next by entry 2 `at` or, if its knot passes, 2 `at` + 1. */

KERNEL integer follow(integer at, mask passes)
{
#if VNDF_LANES == 16
    return (integer)_mm512_mask_add_epi32((__m512i)(at + at), passes, (__m512i)(at + at), _mm512_set1_epi32(1));
#else
    return at + at - passes;
#endif
}

#if VNDF_LANES < 16

/* By bit `bit` of `at`. */
KERNEL real select_bit(integer at, int bit, real yes, real no)
{
#  if VNDF_LANES == 8 /* which reads signs alone */
    return (real)_mm256_blendv_ps((__m256)no, (__m256)yes, (__m256)(at << (31 - bit)));
#  else
    return select((at << (31 - bit)) >> 31, yes, no);
#  endif
}

#endif

/* Entry `at` of a column, which is one of step `level`. */
KERNEL real level_entry(table t, int column, integer at, int level)
{
    const float *c = t.layout->level[column];
#if VNDF_LANES == 16
    if (level < 5)
        return (real)_mm512_permutexvar_ps((__m512i)at, _mm512_load_ps(c + (level < 4 ? 0 : 16)));
    return level == 5 ? entry_32(c + 32, at) : entry_64(c + 64, at);
#else
    enum { BITS = VNDF_LANES == 8 ? 3 : 0 }; /* of an entry's place in a register */
    const float *first = c + (1 << level);
    int registers = level > BITS ? 1 << (level - BITS) : 1, bit = BITS;
    real r[8] = {{0}};
    LANES_UNROLLED
    for (int n = 0; n < registers; n++)
#  if VNDF_LANES == 8
        r[n] = (real)_mm256_permutevar8x32_ps(_mm256_load_ps((level < BITS ? c : first) + 8 * n), (__m256i)at);
#  else
        r[n] = set(first[n]);
#  endif
    LANES_UNROLLED
    for (; registers > 1; registers /= 2, bit++)
        for (int n = 0; n < registers / 2; n++)
            r[n] = select_bit(at, bit, r[2 * n + 1], r[2 * n]);
    return r[0];
#endif
}

#endif
