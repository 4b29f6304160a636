/* Damage to files that are read: bytes that change, checksums that are put right, and what a table has to do, whatever
 * it holds. */
#pragma once

#include "cli/files.h"
#include "core/checksum.h"
#include "harness/test.h"
#include "vndf.h"

enum { DAMAGE_BYTES_MAX = 1 << 17 };

/* ---- bytes ---- */

static inline void put_u32(unsigned char *bytes, unsigned long value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(value >> (8 * i) & 0xffu);
}

static inline void mend_checksum(unsigned char *bytes, size_t size)
{
    put_u32(bytes + size - 4, vndf_crc32(0, bytes, size - 4));
}

/* ---- tables ---- */

/* Where next to nothing is seen densities may be 0. What somebody forged may overflow to an infinite one. */
static inline int is_density(float pdf, float area, int forged)
{
    return forged ? pdf >= 0 : isfinite(pdf) && (pdf > 0 || (pdf == 0 && area < 1e-25f));
}

/* By the calls of mixtures and, of a first lobe, those that draw for one. */
static inline int is_safe_at(const vndf_mixture *of, vndf_vec3 wi, float u1, float u2, int forged)
{
    float pdf = -1, own = -1, v1 = -1, v2 = -1;
    const vndf_surface *first = &of->lobe[0].surface;
    const vndf_view view_of_first = vndf_view_from(first, wi);
    const vndf_mixture_view view = vndf_mixture_view_from(of, wi);
    const vndf_vec3 wm = vndf_mixture_sample(&view, u1, u2, &pdf, NULL);
    const float again = vndf_mixture_pdf(&view, wm), area = vndf_mixture_projected_area(of, wi);
    const double length = sqrt((double)wm.x * wm.x + (double)wm.y * wm.y + (double)wm.z * wm.z);
    vndf_mixture_invert(&view, wm, -1, &v1, &v2);
    vndf_sample(&view_of_first, u1, u2, &own);
    return is_density(own, vndf_projected_area(first, wi), forged) &&
           (forged ? isfinite(length) : fabs(length - 1) < 1e-6) && wm.z >= 0 && is_density(pdf, area, forged) &&
           is_density(again, area, forged) && vndf_mixture_ndf(of, wm) >= 0 && area >= 0 &&
           (forged || isfinite(area)) && v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1 &&
           !isnan(vndf_mixture_lambda(of, wi)) && vndf_mixture_g1(of, wi) >= 0;
}

/* Samples are unit and not below the surface, densities finite and positive, from all sides. */
static inline int is_safe_mixture(const vndf_mixture *of, int forged)
{
    static const float heights[] = {1, 0.5f, 1e-3f, 0, -1e-3f, -0.6f, -1};
    static unsigned long long state = 29;
    int safe = 1;
    for (int i = 0; i < 42; i++) {
        const float height = heights[i / 6], across = sqrtf(1 - height * height);
        const vndf_vec3 wi = {0.6f * across, 0.8f * across, height};
        float u1 = i % 6 < 4 ? test_uniform(&state) : i % 6 == 4,
              u2 = i % 6 < 4 ? test_uniform(&state) : i % 6 == 5;
        safe &= is_safe_at(of, wi, u1, u2, forged);
    }
    return safe;
}

/* The same of a table, smooth along x and rough. */
static inline int is_safe(const vndf_distribution *table, int forged)
{
    const vndf_mixture smooth = {1, {{{table, 1e-3f, 0, 0, 0.5f, 0, 0}, 1}}};
    const vndf_mixture rough = {1, {{{table, 0.5f, 0, 0, 0.5f, 0, 0}, 1}}};
    return is_safe_mixture(&smooth, forged) && is_safe_mixture(&rough, forged);
}

/* ---- every truncation, every flip ---- */

typedef enum verdict { REFUSED, SAFE, UNSAFE } verdict;

/* A kind of file: what becomes of bytes, and how all checksums in damaged ones are put right, whose parts lie where
 * they do in the sound ones. */
typedef struct file_kind {
    verdict (*load)(const unsigned char *bytes, size_t size, vndf_error *error);
    void (*mend)(unsigned char *bytes, const unsigned char *sound, size_t size);
} file_kind;

/* Loads a copy in a block of its exact size, beyond which sanitizers see every read. A refusal has its status and a
 * message. */
static inline verdict load_exact(const file_kind *kind, const unsigned char *bytes, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    unsigned char *own = malloc(size ? size : 1);
    if (!TEST(own != NULL))
        return UNSAFE;
    memcpy(own, bytes, size);
    verdict found = kind->load(own, size, &error);
    free(own);
    TEST(found == REFUSED ? error.status == VNDF_ERROR_TABLE && error.message[0] : error.status == VNDF_OK);
    return found;
}

/* All truncations, and bits 0, step, 2 step, ...: refused as they are, and with mended checksums refused or safe. */
static inline void test_damaged_file(const file_kind *kind, const char *path, size_t step)
{
    static unsigned char bytes[DAMAGE_BYTES_MAX], changed[DAMAGE_BYTES_MAX];
    size_t size = read_bytes(path, bytes, DAMAGE_BYTES_MAX - 8), taken = 0;
    TEST(size > 1000 && size < DAMAGE_BYTES_MAX - 8 && load_exact(kind, bytes, size) == SAFE);
    for (size_t n = 0; n < size; n++)
        TEST(load_exact(kind, bytes, n) == REFUSED);
    memset(bytes + size, 0, 8);
    TEST(load_exact(kind, bytes, size + 1) == REFUSED && load_exact(kind, bytes, size + 8) == REFUSED);
    for (size_t bit = 0; bit < 8 * size; bit += step) {
        memcpy(changed, bytes, size);
        changed[bit / 8] ^= (unsigned char)(1 << bit % 8);
        int good = TEST(load_exact(kind, changed, size) == REFUSED);
        kind->mend(changed, bytes, size);
        verdict mended = load_exact(kind, changed, size);
        taken += mended == SAFE;
        if (!(good & TEST(mended != UNSAFE)) && test_failures < 20)
            fprintf(stderr, "  %s: bit %lu flipped\n", path, (unsigned long)bit);
    }
    fprintf(stderr, "%s: %lu flips were taken once the checksum was mended\n", path, (unsigned long)taken);
}

/* Bytes that break one rule, with the right size and checksum, are refused for a reason that holds `part`. */
static inline void test_refused_for(const file_kind *kind, unsigned char *bytes, size_t size, const char *part)
{
    vndf_error error = {VNDF_OK, ""};
    put_u32(bytes + 12, (unsigned long)size);
    mend_checksum(bytes, size);
    verdict found = kind->load(bytes, size, &error);
    if (!(TEST(found == REFUSED) & TEST(error.status == VNDF_ERROR_TABLE) & TEST_HAS(error.message, part)))
        fprintf(stderr, "  asked for: %s, had: %s\n", part, error.message);
}

/* One number that breaks a rule: at its place in a part of the file, or before the end of the part where that is
 * negative; and what is said of it. */
typedef struct broken_rule {
    int part, at;
    enum { WORD, FLOAT } type;
    double value;
    const char *message;
} broken_rule;

/* Part i is from part[i] to part[i + 1]. */
static inline void test_broken_rules(const file_kind *kind, const unsigned char *sound, size_t size,
                                     const size_t *part, const broken_rule *rules, size_t count)
{
    static unsigned char bytes[DAMAGE_BYTES_MAX];
    for (const broken_rule *r = rules; r < rules + count; r++) {
        const float number = (float)r->value;
        uint32_t bits = r->type == WORD ? (uint32_t)r->value : 0;
        memcpy(bytes, sound, size);
        memcpy(&bits, &number, r->type == FLOAT ? sizeof bits : 0);
        put_u32(bytes + part[r->part + (r->at < 0)] + r->at, bits);
        test_refused_for(kind, bytes, size, r->message);
    }
}
