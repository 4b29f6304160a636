/* The types of the kernel as VNDF_LANES numbers side by side: 4, 8 or 16, by the vector extensions of GCC and Clang.
 * The same names as in one.h, the same operations in the same order: the same bits. Intrinsics stand only where the
 * extensions have no word for an instruction.
 *
 * A table is read by rows of four numbers, one load a lane and a transposition. With 16 lanes, searches of small tables
 * read columns in registers instead, by permutations. A search begins with the anchors, a few knots at equal distances.
 * Columns and anchors are copies that a call makes once. */
#ifndef VNDF_KERNEL_LANES_H
#define VNDF_KERNEL_LANES_H

#include <stdint.h>
#include <string.h>

#include "core/inline.h"
#include "table/table.h"

#if defined(__x86_64__) || defined(__i386__)
#  include <immintrin.h>
#  define VNDF_KERNEL_X86 1
#else
#  define VNDF_KERNEL_X86 0
#endif

#define HERE VNDF_INLINE

/* Before loops over lanes, which gcc -O2 would not unroll. */
#if defined(__clang__)
#  define LANES_UNROLLED _Pragma("clang loop unroll(full)")
#else
#  define LANES_UNROLLED _Pragma("GCC unroll 16")
#endif

enum { LANES = VNDF_LANES };

typedef float real __attribute__((vector_size(4 * VNDF_LANES)));
typedef int32_t whole __attribute__((vector_size(4 * VNDF_LANES)));

#if VNDF_LANES == 16
typedef __mmask16 mask;
#else
typedef whole mask; /* 0 or -1 */
#endif

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real a, b, c, d;
} quad;

HERE real set(float x)
{
    return x - (real){0};
}

HERE whole set_whole(int i)
{
    return i - (whole){0};
}

HERE real load(const float *from)
{
    real x;
    memcpy(&x, from, sizeof x);
    return x;
}

HERE void store(float *to, real x)
{
    memcpy(to, &x, sizeof x);
}

HERE whole bits(real x)
{
    return (whole)x;
}

HERE real of_bits(whole i)
{
    return (real)i;
}

/* ---- choices ---- */

#if VNDF_LANES == 16 /* masks in registers of their own */

HERE mask less(real a, real b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}

HERE mask at_most(real a, real b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}

HERE mask same(whole a, int b)
{
    return _mm512_cmpeq_epi32_mask((__m512i)a, _mm512_set1_epi32(b));
}

HERE mask less_whole(whole a, whole b)
{
    return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}

HERE int any(mask m)
{
    return m != 0;
}

HERE real pick(mask m, real yes, real no)
{
    return (real)_mm512_mask_blend_ps(m, (__m512)no, (__m512)yes);
}

HERE whole pick_whole(mask m, whole yes, whole no)
{
    return (whole)_mm512_mask_blend_epi32(m, (__m512i)no, (__m512i)yes);
}

#else

HERE mask less(real a, real b)
{
    return a < b;
}

HERE mask at_most(real a, real b)
{
    return a <= b;
}

HERE mask same(whole a, int b)
{
    return a == b;
}

HERE mask less_whole(whole a, whole b)
{
    return a < b;
}

HERE int any(mask m)
{
#  if VNDF_KERNEL_X86 && VNDF_LANES == 8
    return _mm256_movemask_ps((__m256)m);
#  elif VNDF_KERNEL_X86
    return _mm_movemask_ps((__m128)m);
#  else
    uint64_t half[2];
    memcpy(half, &m, sizeof half);
    return (half[0] | half[1]) != 0;
#  endif
}

HERE whole pick_whole(mask m, whole yes, whole no)
{
#  if VNDF_KERNEL_X86 && VNDF_LANES == 8 /* one instruction for three */
    return (whole)_mm256_blendv_epi8((__m256i)no, (__m256i)yes, (__m256i)m);
#  else
    return (m & yes) | (~m & no);
#  endif
}

HERE real pick(mask m, real yes, real no)
{
    return of_bits(pick_whole(m, bits(yes), bits(no)));
}

#endif

HERE mask both(mask a, mask b)
{
    return (mask)(a & b);
}

HERE mask either(mask a, mask b)
{
    return (mask)(a | b);
}

HERE int all(mask m)
{
#if VNDF_LANES == 16
    return m == 0xffff;
#else
    return !any(~m);
#endif
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. That is what the instructions of x86 do. */
HERE real least(real a, real b)
{
#if VNDF_KERNEL_X86 && VNDF_LANES == 16
    return (real)_mm512_min_ps((__m512)a, (__m512)b);
#elif VNDF_KERNEL_X86 && VNDF_LANES == 8
    return (real)_mm256_min_ps((__m256)a, (__m256)b);
#elif VNDF_KERNEL_X86
    return (real)_mm_min_ps((__m128)a, (__m128)b);
#else
    return pick(less(a, b), a, b);
#endif
}

HERE real most(real a, real b)
{
#if VNDF_KERNEL_X86 && VNDF_LANES == 16
    return (real)_mm512_max_ps((__m512)a, (__m512)b);
#elif VNDF_KERNEL_X86 && VNDF_LANES == 8
    return (real)_mm256_max_ps((__m256)a, (__m256)b);
#elif VNDF_KERNEL_X86
    return (real)_mm_max_ps((__m128)a, (__m128)b);
#else
    return pick(less(b, a), a, b);
#endif
}

HERE real root(real x)
{
#if VNDF_KERNEL_X86 && VNDF_LANES == 16
    return (real)_mm512_sqrt_ps((__m512)x);
#elif VNDF_KERNEL_X86 && VNDF_LANES == 8
    return (real)_mm256_sqrt_ps((__m256)x);
#elif VNDF_KERNEL_X86
    return (real)_mm_sqrt_ps((__m128)x);
#else
    for (int l = 0; l < LANES; l++)
        x[l] = __builtin_sqrtf(x[l]);
    return x;
#endif
}

HERE real size(real x)
{
    return of_bits(bits(x) & 0x7fffffff);
}

/* |x| with the sign of y. */
HERE real with_sign(real x, real y)
{
    return of_bits((bits(x) & 0x7fffffff) | (bits(y) & ~0x7fffffff));
}

HERE real to_real(whole i)
{
    return __builtin_convertvector(i, real);
}

/* The whole part of x, |x| < 2^31. */
HERE whole to_whole(real x)
{
    return __builtin_convertvector(x, whole);
}

HERE whole least_whole(whole a, whole b)
{
    return pick_whole(less_whole(a, b), a, b);
}

HERE whole most_whole(whole a, whole b)
{
    return pick_whole(less_whole(b, a), a, b);
}

/* ---- tables ---- */

enum {
    ANCHORS = VNDF_LANES == 16 ? 16 : 8, /* anchor k is knot k * stride */
    COPIED = 128,                        /* cells of a table whose columns are copied, with 16 lanes */
    COPIED_COUNT = 256,                  /* for so many elements or more */
    COPIED_GROUPS = 3                    /* VNDF_KNOT, VNDF_TAIL, VNDF_LOW */
};

typedef struct table_copies {
    float anchor[5][ANCHORS]; /* R and the four sums of VNDF_TAIL */
#if VNDF_LANES == 16
    float column[COPIED_GROUPS][4][COPIED]; /* without the last row */
#endif
} table_copies __attribute__((aligned(64)));

/* A table as the kernel reads it (table/table.h). */
typedef struct table {
    const float *numbers;
    const table_copies *copies;
    const uint16_t *first;
    int cells, moments, squarings, highest, steps; /* highest: the highest power of two <= cells, 2^(steps - 1) */
    int stride, copied;
} table;

/* Four numbers of each lane, those of lane l from row[l] on. */
HERE quad transposed(const float *const row[LANES])
{
    quad q;
#if VNDF_LANES == 4
    real a = load(row[0]), b = load(row[1]), c = load(row[2]), d = load(row[3]);
#  if VNDF_KERNEL_X86
    _MM_TRANSPOSE4_PS(a, b, c, d);
    q = (quad){a, b, c, d};
#  else
    q.a = (real){a[0], b[0], c[0], d[0]};
    q.b = (real){a[1], b[1], c[1], d[1]};
    q.c = (real){a[2], b[2], c[2], d[2]};
    q.d = (real){a[3], b[3], c[3], d[3]};
#  endif
#elif VNDF_LANES == 8
    __m256 r[4];
    LANES_UNROLLED
    for (int l = 0; l < 4; l++)
        r[l] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[l])), _mm_loadu_ps(row[l + 4]), 1);
    __m256d e = (__m256d)_mm256_unpacklo_ps(r[0], r[1]), f = (__m256d)_mm256_unpackhi_ps(r[0], r[1]);
    __m256d g = (__m256d)_mm256_unpacklo_ps(r[2], r[3]), h = (__m256d)_mm256_unpackhi_ps(r[2], r[3]);
    q.a = (real)_mm256_unpacklo_pd(e, g);
    q.b = (real)_mm256_unpackhi_pd(e, g);
    q.c = (real)_mm256_unpacklo_pd(f, h);
    q.d = (real)_mm256_unpackhi_pd(f, h);
#else
    __m512 r[4];
    LANES_UNROLLED
    for (int l = 0; l < 4; l++) {
        r[l] = _mm512_castps128_ps512(_mm_loadu_ps(row[l]));
        r[l] = _mm512_insertf32x4(r[l], _mm_loadu_ps(row[l + 4]), 1);
        r[l] = _mm512_insertf32x4(r[l], _mm_loadu_ps(row[l + 8]), 2);
        r[l] = _mm512_insertf32x4(r[l], _mm_loadu_ps(row[l + 12]), 3);
    }
    __m512d e = (__m512d)_mm512_unpacklo_ps(r[0], r[1]), f = (__m512d)_mm512_unpackhi_ps(r[0], r[1]);
    __m512d g = (__m512d)_mm512_unpacklo_ps(r[2], r[3]), h = (__m512d)_mm512_unpackhi_ps(r[2], r[3]);
    q.a = (real)_mm512_unpacklo_pd(e, g);
    q.b = (real)_mm512_unpackhi_pd(e, g);
    q.c = (real)_mm512_unpacklo_pd(f, h);
    q.d = (real)_mm512_unpackhi_pd(f, h);
#endif
    return q;
}

HERE quad look_rows(table t, int group, whole i)
{
    const float *first = t.numbers + 4 * (group * (t.cells + 1)), *row[LANES];
    int32_t at[LANES];
    memcpy(at, &i, sizeof at);
    LANES_UNROLLED
    for (int l = 0; l < LANES; l++)
        row[l] = first + 4 * at[l];
    return transposed(row);
}

HERE whole look_first(table t, whole quarter)
{
    int32_t at[LANES];
    memcpy(at, &quarter, sizeof at);
    LANES_UNROLLED
    for (int l = 0; l < LANES; l++)
        at[l] = t.first[at[l]];
    memcpy(&quarter, at, sizeof at);
    return quarter;
}

#if VNDF_LANES == 16

/* Where the columns of a group are copied; -1 if they are not: all numbers of a cell are read at once, best by rows. */
HERE int copied_group(int group)
{
    return group == VNDF_KNOT ? 0 : group == VNDF_TAIL ? 1 : group == VNDF_LOW ? 2 : -1;
}

HERE real look_column(table t, int group, int n, whole i)
{
    const float *c = t.copies->column[copied_group(group)][n];
    const __m512i at = (__m512i)i;
    __m512 r = _mm512_permutex2var_ps(_mm512_load_ps(c), at, _mm512_load_ps(c + 16));
    mask odd = _mm512_test_epi32_mask(at, _mm512_set1_epi32(32));
    r = _mm512_mask_blend_ps(odd, r, _mm512_permutex2var_ps(_mm512_load_ps(c + 32), at, _mm512_load_ps(c + 48)));
    if (t.cells > 64) {
        __m512 s = _mm512_permutex2var_ps(_mm512_load_ps(c + 64), at, _mm512_load_ps(c + 80));
        s = _mm512_mask_blend_ps(odd, s,
                                 _mm512_permutex2var_ps(_mm512_load_ps(c + 96), at, _mm512_load_ps(c + 112)));
        r = _mm512_mask_blend_ps(_mm512_test_epi32_mask(at, _mm512_set1_epi32(64)), r, s);
    }
    return pick(same(i, t.cells), set(t.numbers[4 * (group * (t.cells + 1) + t.cells) + n]), (real)r);
}

HERE void copy_columns(table t, table_copies *copies)
{
    const int groups[COPIED_GROUPS] = {VNDF_KNOT, VNDF_TAIL, VNDF_LOW};
    const whole lanes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    for (int first = 0; first < (t.cells > 64 ? 128 : 64); first += 16)
        for (int g = 0; g < COPIED_GROUPS; g++) {
            quad q = look_rows(t, groups[g], least_whole(lanes + first, set_whole(t.cells)));
            store(copies->column[g][0] + first, q.a);
            store(copies->column[g][1] + first, q.b);
            store(copies->column[g][2] + first, q.c);
            store(copies->column[g][3] + first, q.d);
        }
}

#endif

/* Row i of a group. */
HERE quad look(table t, int group, whole i)
{
#if VNDF_LANES == 16
    if (t.copied && copied_group(group) >= 0) {
        quad q = {look_column(t, group, 0, i), look_column(t, group, 1, i), look_column(t, group, 2, i),
                  look_column(t, group, 3, i)};
        return q;
    }
#endif
    return look_rows(t, group, i);
}

/* A table, and its copies for a call with `count` elements. */
HERE table table_of(const vndf_distribution *d, table_copies *copies, size_t count)
{
    table t = {d->numbers + VNDF_HEAD, copies,     d->first, d->cells, d->moments,
               d->squarings,           d->highest, d->steps, 1,        0};
    while (ANCHORS * t.stride < t.cells)
        t.stride *= 2;
    for (int k = 0; k < ANCHORS; k++) {
        int knot = k * t.stride, there = knot < t.cells;
        const float *tail = t.numbers + 4 * (VNDF_TAIL * (t.cells + 1) + knot);
        copies->anchor[0][k] = there ? t.numbers[4 * knot] : 3e38f; /* fails all comparisons, as sums of -1 do */
        for (int n = 0; n < 4; n++)
            copies->anchor[1 + n][k] = there ? tail[n] : -1.0f;
    }
#if VNDF_LANES == 16
    t.copied = t.cells <= COPIED && count >= COPIED_COUNT;
    if (t.copied)
        copy_columns(t, copies);
#else
    (void)count;
#endif
    return t;
}

/* ---- searches ----
 *
 * The last knot R with R^2 under <= square, and the last knot beyond which at least `left` of the law lies, by the sums
 * of law_sum: from the anchors and the last knot on in steps that are halved. Blocks take each step for all their
 * elements before the next, since a step waits for what it looks up. */

#define VNDF_KERNEL_FINDS 1

#if VNDF_LANES > 4

HERE real look_anchor(table t, int n, whole k)
{
#  if VNDF_LANES == 16
    return (real)_mm512_permutexvar_ps((__m512i)k, _mm512_load_ps(t.copies->anchor[n]));
#  else
    return (real)_mm256_permutevar8x32_ps(_mm256_load_ps(t.copies->anchor[n]), (__m256i)k);
#  endif
}

#endif

HERE mask knot_reaches(real r, real square, real under)
{
    return at_most((r * r) * under, square);
}

HERE whole begin_knot(table t, real square, real under)
{
    whole k = set_whole(0);
#if VNDF_LANES > 4
    for (int step = ANCHORS / 2; step > 0; step /= 2)
        k = pick_whole(knot_reaches(look_anchor(t, 0, k + step), square, under), k + step, k);
#else
    LANES_UNROLLED
    for (int n = 1; n < ANCHORS; n++)
        k = k - knot_reaches(set(t.copies->anchor[0][n]), square, under);
#endif
    mask last = knot_reaches(set(t.numbers[4 * t.cells]), square, under);
    return pick_whole(last, set_whole(t.cells), k * t.stride);
}

HERE whole step_knot(table t, real square, real under, whole i, int step)
{
    whole next = least_whole(i + step, set_whole(t.cells));
    return pick_whole(knot_reaches(look(t, VNDF_KNOT, next).a, square, under), next, i);
}

HERE whole find_knot(table t, real square, real under)
{
    whole i = begin_knot(t, square, under);
    for (int step = t.stride / 2; step > 0; step /= 2)
        i = step_knot(t, square, under, i, step);
    return i;
}

/* The fourth term is 0 for fewer moments. */
HERE mask sum_reaches(table t, real w1, real w0, real wq, real w4, quad tail, real left)
{
    real far = wq * tail.c;
    if (t.moments > 3)
        far = far + w4 * tail.d;
    return at_most(left, (w1 * tail.a + w0 * tail.b) + far);
}

HERE quad quad_of(const float *a, const float *b, const float *c, const float *d)
{
    quad q = {set(*a), set(*b), set(*c), set(*d)};
    return q;
}

HERE whole begin_sum(table t, real w1, real w0, real wq, real w4, real left)
{
    const table_copies *c = t.copies;
    const float *end = t.numbers + 4 * (VNDF_TAIL * (t.cells + 1) + t.cells);
    whole k = set_whole(0);
#if VNDF_LANES > 4
    (void)c;
    for (int step = ANCHORS / 2; step > 0; step /= 2) {
        whole next = k + step;
        quad tail = {look_anchor(t, 1, next), look_anchor(t, 2, next), look_anchor(t, 3, next),
                     look_anchor(t, 4, next)};
        k = pick_whole(sum_reaches(t, w1, w0, wq, w4, tail, left), next, k);
    }
#else
    LANES_UNROLLED
    for (int n = 1; n < ANCHORS; n++)
        k = k - sum_reaches(t, w1, w0, wq, w4,
                            quad_of(&c->anchor[1][n], &c->anchor[2][n], &c->anchor[3][n], &c->anchor[4][n]), left);
#endif
    mask last = sum_reaches(t, w1, w0, wq, w4, quad_of(end, end + 1, end + 2, end + 3), left);
    return pick_whole(last, set_whole(t.cells), k * t.stride);
}

HERE whole step_sum(table t, real w1, real w0, real wq, real w4, real left, whole i, int step)
{
    whole next = least_whole(i + step, set_whole(t.cells));
    return pick_whole(sum_reaches(t, w1, w0, wq, w4, look(t, VNDF_TAIL, next), left), next, i);
}

HERE whole find_sum(table t, real w1, real w0, real wq, real w4, real left)
{
    whole i = begin_sum(t, w1, w0, wq, w4, left);
    for (int step = t.stride / 2; step > 0; step /= 2)
        i = step_sum(t, w1, w0, wq, w4, left, i, step);
    return i;
}

#endif
