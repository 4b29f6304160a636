/* Saved and loaded, a table is the same: the same bits of sample, pdf, invert, area and certificate. What cannot
 * be saved or loaded gives its status and leaves nothing behind. vndf_numbers gives as many numbers as it says, a head
 * of 8 and five rows of four for each knot, and no more than there is room for. (What they say: exported_*.) */
#include <stdlib.h>

#include "harness/hash.h"
#include "harness/test.h"
#include "oracle/oracle.h"
#include "vndf_build.h"

static int same(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static void test_equal(const vndf_distribution *a, const vndf_distribution *b)
{
    unsigned long long state = 17;
    vndf_info ia = vndf_distribution_info(a), ib = vndf_distribution_info(b);
    unsigned long long of_a = hash_begin, of_b = hash_begin;
    for (int i = 0; i < 20000; i++) {
        float z = 2 * test_uniform(&state) - 1, s = sqrtf(1 - z * z), u1 = test_uniform(&state),
              u2 = test_uniform(&state);
        vndf_vec3 wi = {0.6f * s, -0.8f * s, z};
        vndf_surface sa = {a, 0.3f, 0.7f}, sb = {b, 0.3f, 0.7f};
        vndf_view va = vndf_view_from(&sa, wi), vb = vndf_view_from(&sb, wi);
        vndf_vec3 wm;
        of_a = hash_others(hash_sample(of_a, &va, u1, u2, &wm), &va, &sa, wi, wm, u1, u2);
        of_b = hash_others(hash_sample(of_b, &vb, u1, u2, &wm), &vb, &sb, wi, wm, u1, u2);
    }
    TEST(of_a == of_b);
    TEST(strcmp(ia.source, ib.source) == 0 && strcmp(ia.tool, ib.tool) == 0);
    TEST(same(&ia.certificate, &ib.certificate, sizeof ia.certificate));
    TEST(ia.bytes == ib.bytes && ia.normalization == ib.normalization && ia.scale == ib.scale);
}

static void test_numbers(const vndf_distribution *d)
{
    static float all[1 << 14], part[1 << 14];
    size_t count = vndf_numbers(d, NULL, 0);
    if (!TEST(count == 8 + 5 * 4 * (vndf_distribution_info(d).cells + 1) && count < 1 << 14))
        return;
    all[count] = part[count / 2] = 7;
    TEST(vndf_numbers(d, all, count) == count && all[count] == 7);
    TEST(vndf_numbers(d, part, count / 2) == count && part[count / 2] == 7 &&
         same(all, part, count / 2 * sizeof *all));
    TEST(vndf_numbers(NULL, part, 1) == 0 && vndf_numbers(vndf_ggx(), part, 1) == 0);
}

static void test_round_trip(const oracle *o, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = oracle_build(o, 4096, NULL);
    TEST(table && vndf_save(table, path, &error) == VNDF_OK);
    vndf_distribution *loaded = vndf_load(path, &error);
    if (TEST(loaded != NULL))
        test_equal(table, loaded);
    test_numbers(loaded);
    vndf_free(table);
    vndf_free(loaded);
    remove(path);
}

static int exists(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file)
        fclose(file);
    return file != NULL;
}

static void test_errors(void)
{
    oracle o = oracle_get(ORACLE_GGX);
    vndf_distribution *table = oracle_build(&o, 2048, NULL);
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_save(table, "no-such-folder/table.vndf", &error) == VNDF_ERROR_IO && error.status == VNDF_ERROR_IO);
    TEST_HAS(error.message, "no-such-folder");
    TEST(!exists("no-such-folder/table.vndf"));
    TEST(vndf_save(table, "no-such-folder/table.vndf", NULL) == VNDF_ERROR_IO);
    TEST(vndf_save(NULL, "x.vndf", &error) == VNDF_ERROR_ARGUMENT && !exists("x.vndf"));
    TEST(vndf_save(vndf_ggx(), "x.vndf", &error) == VNDF_ERROR_ARGUMENT && !exists("x.vndf"));
    TEST(vndf_save(table, NULL, &error) == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_load("no-such-file.vndf", &error) && error.status == VNDF_ERROR_IO);
    TEST_HAS(error.message, "no-such-file.vndf");
    TEST(!vndf_load(NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_load(VNDF_SOURCE_DIR "/README.md", &error) && error.status != VNDF_OK);
    TEST(!vndf_load_memory(NULL, 100, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_load_memory("VNDFtab\n", 8, &error) && error.status == VNDF_ERROR_TABLE);
    TEST(!vndf_load_memory("", 0, NULL));
    vndf_free(NULL);
    vndf_free(table);
}

int main(void)
{
    const size_t kinds[] = {ORACLE_GGX, ORACLE_MEASURED, ORACLE_RING};
    for (int i = 0; i < 3; i++) {
        oracle o = oracle_get(kinds[i]);
        test_round_trip(&o, "test_table_round_trip.vndf");
    }
    test_errors();
    return test_done();
}
