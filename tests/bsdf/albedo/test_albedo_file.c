/* A file of albedos comes back as it was saved, to the bit; every truncation and every flip of a bit is refused;
 * where the checksum is put right again, the file is refused, or its look-ups are in [0, 1]. Files that cannot be
 * read or written give errors that name them. */
#define _DEFAULT_SOURCE
#include "harness/damage.h"
#include "vndf_albedo.h"

enum { BYTES_MAX = 1 << 15 };

static vndf_albedo *build_small(float eta)
{
    vndf_albedo_options options = {.eta = eta, .columns = 9, .rows = 8};
    return vndf_albedo_build(vndf_beckmann(), &options, NULL);
}

static int is_part(float x)
{
    return x >= 0 && x <= 1;
}

static int looks_up(const vndf_albedo *albedo)
{
    int good = 1;
    for (float alpha = -1; alpha < 5; alpha += 0.3f)
        for (float cosine = -1; cosine <= 1; cosine += 0.1f) {
            vndf_albedo_parts parts = vndf_albedo_split(albedo, cosine, alpha);
            good &= is_part(vndf_albedo_directional(albedo, cosine, alpha)) && is_part(parts.reflected) &&
                    is_part(parts.transmitted) && is_part(vndf_albedo_average(albedo, alpha, cosine < 0 ? -1 : 1));
        }
    return good;
}

/* ---- there and back ------------------------------------------------------------------------------ */

static int is_same(const vndf_albedo *a, const vndf_albedo *b)
{
    vndf_albedo_properties p = vndf_albedo_info(a), q = vndf_albedo_info(b);
    int same = strcmp(p.source, q.source) == 0 && strcmp(p.tool, q.tool) == 0 && p.eta == q.eta &&
               p.scale == q.scale && p.columns == q.columns && p.rows == q.rows && p.values == q.values &&
               p.bytes == q.bytes && p.error == q.error && p.error_cosine == q.error_cosine &&
               p.error_alpha == q.error_alpha && p.error_usual == q.error_usual &&
               p.split_error == q.split_error && p.split_usual == q.split_usual &&
               p.average_error == q.average_error && p.quadrature_error == q.quadrature_error;
    for (float alpha = 0; alpha < 4; alpha += 0.07f)
        for (float cosine = -1; cosine <= 1; cosine += 0.03f)
            same &=
                vndf_albedo_directional(a, cosine, alpha) == vndf_albedo_directional(b, cosine, alpha) &&
                vndf_albedo_split(a, cosine, alpha).reflected == vndf_albedo_split(b, cosine, alpha).reflected &&
                vndf_albedo_average(a, alpha, cosine < 0 ? -1 : 1) ==
                    vndf_albedo_average(b, alpha, cosine < 0 ? -1 : 1);
    return same;
}

static size_t test_round_trip(const vndf_albedo *albedo, unsigned char *bytes)
{
    static unsigned char again[BYTES_MAX];
    size_t size = vndf_albedo_info(albedo).bytes;
    vndf_error error = {VNDF_OK, ""};
    if (!TEST(size < BYTES_MAX) || !TEST(vndf_albedo_save_memory(albedo, bytes, size, &error) == VNDF_OK))
        return 0;
    vndf_albedo *loaded = vndf_albedo_load_memory(bytes, size, &error);
    if (TEST(loaded) && TEST(is_same(albedo, loaded))) {
        TEST(vndf_albedo_save_memory(loaded, again, size, &error) == VNDF_OK && memcmp(bytes, again, size) == 0);
        TEST(looks_up(loaded));
    }
    vndf_albedo_free(loaded);
    TEST(vndf_albedo_save_memory(albedo, again, size - 1, &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_albedo_save_memory(NULL, again, size, &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_albedo_save_memory(albedo, NULL, size, &error) == VNDF_ERROR_ARGUMENT);
    return size;
}

static void test_files(const vndf_albedo *albedo)
{
    const char *path = "albedo_file.albedo";
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_albedo_save(albedo, path, &error) == VNDF_OK);
    vndf_albedo *loaded = vndf_albedo_load(path, &error);
    TEST(loaded && is_same(albedo, loaded));
    vndf_albedo_free(loaded);
    FILE *file = fopen(path, "ab");
    TEST(file && fputc(0, file) == 0 && fclose(file) == 0);
    TEST(!vndf_albedo_load(path, &error) && error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "more follow");
    remove(path);
    TEST(!vndf_albedo_load(path, &error) && error.status == VNDF_ERROR_IO);
    TEST_HAS(error.message, path);
    TEST(!vndf_albedo_load(NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_albedo_load_memory(NULL, 9, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(vndf_albedo_save(albedo, "no-such-folder/x.albedo", &error) == VNDF_ERROR_IO);
    TEST(vndf_albedo_save(NULL, path, &error) == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_albedo_load(VNDF_SOURCE_DIR "/tables/hazy.vndf", &error) && error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "VNDFalb");
}

/* ---- damage -------------------------------------------------------------------------------------- */

/* A copy of the exact size, so that sanitizers see what is read beyond it. */
static vndf_albedo *load_copy(const unsigned char *bytes, size_t size, vndf_error *error)
{
    unsigned char *copy = malloc(size ? size : 1);
    if (!copy)
        return NULL;
    memcpy(copy, bytes, size);
    vndf_albedo *albedo = vndf_albedo_load_memory(copy, size, error);
    free(copy);
    return albedo;
}

static int refuses(const unsigned char *bytes, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_albedo *albedo = load_copy(bytes, size, &error);
    int refused = !albedo && error.status == VNDF_ERROR_TABLE && error.message[0];
    vndf_albedo_free(albedo);
    return refused;
}

static void test_damage(unsigned char *bytes, size_t size)
{
    size_t wrong = 0, taken = 0, step = test_quick() ? 7 : 1;
    for (size_t n = 0; n < size; n++)
        wrong += !refuses(bytes, n);
    for (size_t bit = 0; bit < 8 * size; bit++) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        wrong += !refuses(bytes, size);
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    TEST(wrong == 0);
    for (size_t bit = 0; bit < 8 * (size - 4); bit += step) {
        vndf_error error = {VNDF_OK, ""};
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        mend_checksum(bytes, size);
        vndf_albedo *albedo = load_copy(bytes, size, &error);
        TEST((albedo == NULL) == (error.status == VNDF_ERROR_TABLE));
        if (albedo && !TEST(looks_up(albedo)))
            fprintf(stderr, "  bit %lu\n", (unsigned long)bit);
        taken += albedo != NULL;
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        vndf_albedo_free(albedo);
    }
    mend_checksum(bytes, size);
    TEST(taken > 0);
    memset(bytes + size, 0, 8);
    TEST(refuses(bytes, size + 1) && refuses(bytes, size + 8));
}

/* A coefficient that is no number or too large, behind a checksum that is right. */
static void test_hostile(unsigned char *bytes, size_t size)
{
    static const unsigned long hostile[] = {0x7FC00000, 0xFFC00000, 0x7F800000,
                                            0xFF800000, 0x447A4000, 0x7F7FFFFF};
    unsigned char kept[4];
    memcpy(kept, bytes + size - 8, 4);
    for (int i = 0; i < 6; i++) {
        put_u32(bytes + size - 8, hostile[i]);
        mend_checksum(bytes, size);
        TEST(refuses(bytes, size));
    }
    memcpy(bytes + size - 8, kept, 4);
    mend_checksum(bytes, size);
    TEST(!refuses(bytes, size));
}

int main(void)
{
    static unsigned char bytes[BYTES_MAX];
    static const float etas[] = {0, 1.5f};
    for (int i = 0; i < 2; i++) {
        vndf_albedo *albedo = build_small(etas[i]);
        size_t size = TEST(albedo) ? test_round_trip(albedo, bytes) : 0;
        if (size) {
            test_files(albedo);
            test_damage(bytes, size);
            test_hostile(bytes, size);
        }
        vndf_albedo_free(albedo);
    }
    return test_done();
}
