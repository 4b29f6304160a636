/* What the tests of damaged tables share: a copy of bytes that nothing can be read beyond, and what a table has
 * to do, whatever it holds. */
#ifndef TESTS_HARNESS_DAMAGE_H
#define TESTS_HARNESS_DAMAGE_H

#if defined(__unix__) || defined(__APPLE__)
#  include <sys/mman.h>
#  include <unistd.h>
#  if defined(MAP_ANONYMOUS)
#    define DAMAGE_HAS_PAGES 1
#  endif
#endif

#include <stdlib.h>

#include "core/checksum.h"
#include "harness/test.h"
#include "vndf.h"

/* Room for bytes that end where a page begins that nobody may read; elsewhere blocks of the exact size, for
 * sanitizers. */
typedef struct fence {
    unsigned char *base; /* NULL: no pages */
    size_t room;
} fence;

static inline fence fence_for(size_t most)
{
    fence f = {NULL, 0};
#ifdef DAMAGE_HAS_PAGES
    size_t page = (size_t)sysconf(_SC_PAGESIZE), room = (most + page - 1) / page * page;
    void *base = mmap(NULL, room + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base != MAP_FAILED && mprotect((char *)base + room, page, PROT_NONE) == 0) {
        f.base = base;
        f.room = room;
    }
#else
    (void)most;
#endif
    return f;
}

/* Loads a copy that ends at the fence. */
static inline vndf_distribution *load_fenced(const fence *f, const unsigned char *bytes, size_t size,
                                             vndf_error *error)
{
    unsigned char *own = f->base ? f->base + f->room - size : malloc(size ? size : 1);
    if (!own)
        return NULL;
    memcpy(own, bytes, size);
    vndf_distribution *table = vndf_load_memory(own, size, error);
    if (!f->base)
        free(own);
    return table;
}

/* The whole of a small file; its size, or 0. */
static inline size_t read_bytes(const char *path, unsigned char *bytes, size_t most)
{
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(bytes, 1, most, file) : 0;
    if (file)
        fclose(file);
    return size;
}

static inline void put_u32(unsigned char *bytes, unsigned long value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(value >> (8 * i) & 0xffu);
}

static inline void mend_checksum(unsigned char *bytes, size_t size)
{
    put_u32(bytes + size - 4, vndf_crc32(0, bytes, size - 4));
}

/* Where next to nothing is seen densities may be 0. */
static inline int is_density(float pdf, float area)
{
    return isfinite(pdf) && (pdf > 0 || (pdf == 0 && area < 1e-25f));
}

static inline int is_safe_at(const vndf_surface *surface, vndf_vec3 wi, float u1, float u2)
{
    float pdf = -1, v1 = -1, v2 = -1;
    vndf_view view = vndf_view_from(surface, wi);
    vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
    float again = vndf_pdf(&view, wm), ndf = vndf_ndf(surface, wm), area = vndf_projected_area(surface, wi);
    double length = sqrt((double)wm.x * wm.x + (double)wm.y * wm.y + (double)wm.z * wm.z);
    vndf_invert(&view, wm, &v1, &v2);
    return fabs(length - 1) < 1e-6 && wm.z >= 0 && is_density(pdf, area) && is_density(again, area) && ndf >= 0 &&
           isfinite(area) && area >= 0 && v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1 && vndf_g1(surface, wi) >= 0;
}

/* Samples are finite, unit and not below the surface, densities finite and positive, from all sides. */
static inline int is_safe(const vndf_distribution *table, unsigned long long *state)
{
    static const float heights[] = {1, 0.5f, 1e-3f, 0, -1e-3f, -0.6f, -1};
    int safe = 1;
    for (int i = 0; i < 7; i++) {
        vndf_surface surface = {table, i % 2 ? 0.5f : 1e-3f, 0.5f};
        float across = sqrtf(1 - heights[i] * heights[i]);
        vndf_vec3 wi = {0.6f * across, 0.8f * across, heights[i]};
        safe &= is_safe_at(&surface, wi, 0, 1) && is_safe_at(&surface, wi, 1, 0);
        for (int j = 0; j < 4; j++) {
            float u1 = test_uniform(state), u2 = test_uniform(state);
            safe &= is_safe_at(&surface, wi, u1, u2);
        }
    }
    return safe;
}

/* ---- every truncation, every flip ---- */

enum { DAMAGE_BYTES_MAX = 1 << 17 };

static inline int is_refused(const fence *f, const unsigned char *bytes, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = load_fenced(f, bytes, size, &error);
    int refused = !table && error.status == VNDF_ERROR_TABLE && error.message[0];
    vndf_free(table);
    return refused;
}

/* All truncations, and bits 0, step, 2 step, ...: refused, with the checksum as it was. */
static inline void test_refused(const char *path, unsigned char *bytes, size_t step)
{
    size_t size = read_bytes(path, bytes, DAMAGE_BYTES_MAX), wrong = 0;
    fence f = fence_for(DAMAGE_BYTES_MAX);
    TEST(size > 1000 && size < DAMAGE_BYTES_MAX && !is_refused(&f, bytes, size));
    for (size_t n = 0; n < size; n++)
        wrong += !is_refused(&f, bytes, n);
    TEST(wrong == 0);
    memset(bytes + size, 0, 8);
    TEST(is_refused(&f, bytes, size + 1) && is_refused(&f, bytes, size + 8)); /* more than the table */
    for (size_t bit = 0; bit < 8 * size; bit += step) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        if (!TEST(is_refused(&f, bytes, size)))
            fprintf(stderr, "  %s: bit %lu flipped\n", path, (unsigned long)bit);
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
#ifdef DAMAGE_HAS_PAGES
    if (f.base)
        munmap(f.base, f.room + (size_t)sysconf(_SC_PAGESIZE));
#endif
}

/* The same flips with the checksum put right again: refused, or safe. */
static inline void test_mended(const char *path, unsigned char *bytes, size_t step)
{
    size_t size = read_bytes(path, bytes, DAMAGE_BYTES_MAX), taken = 0, tries = 0, told = 0;
    unsigned long long state = 29;
    fence none = {NULL, 0};
    for (size_t bit = 0; bit < 8 * (size - 4); bit += step) {
        vndf_error error = {VNDF_OK, ""};
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        mend_checksum(bytes, size);
        vndf_distribution *table = load_fenced(&none, bytes, size, &error);
        TEST((table == NULL) == (error.status == VNDF_ERROR_TABLE));
        if (table && !TEST(is_safe(table, &state)) && told++ < 20)
            fprintf(stderr, "  %s: bit %lu flipped and the checksum mended\n", path, (unsigned long)bit);
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        taken += table != NULL;
        tries++;
        vndf_free(table);
    }
    fprintf(stderr, "%s: %lu of %lu flips were taken once the checksum was mended\n", path, (unsigned long)taken,
            (unsigned long)tries);
}

#endif
