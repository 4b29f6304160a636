/* The file of a family gives back what was saved, to the byte; every truncation and every flip of a bit is refused, and
 * nothing is read beyond its end; where the checksums are put right again, it is refused, or each of its tables is
 * safe to use; and what breaks one rule of the format is refused with that rule's name. */
#define _DEFAULT_SOURCE
#include "harness/damage.h"
#include "table/family/family.h"
#include "vndf_build.h"

enum { COUNT = 16, MAP = 20, GRAZING = 24, SOURCE = 28, ROOM = 1 << 14 };

static const char path[] = VNDF_SOURCE_DIR "/tests/corpus/family/two.vndfs";

static unsigned long get_u32(const unsigned char *bytes)
{
    return bytes[0] | (unsigned long)bytes[1] << 8 | (unsigned long)bytes[2] << 16 | (unsigned long)bytes[3] << 24;
}

static void put_f32(unsigned char *bytes, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_u32(bytes, bits);
}

/* Where the parameters begin: behind both texts. */
static size_t parameters_at(const unsigned char *bytes)
{
    size_t tool = SOURCE + 4 + get_u32(bytes + SOURCE);
    return tool + 4 + get_u32(bytes + tool);
}

static vndf_family *load_behind(const fence *f, const unsigned char *bytes, size_t size, vndf_error *error)
{
    unsigned char *own = f->base ? f->base + f->room - size : malloc(size ? size : 1);
    if (!own)
        return NULL;
    memcpy(own, bytes, size);
    vndf_family *family = vndf_family_load_memory(own, size, error);
    if (!f->base)
        free(own);
    return family;
}

static int is_refused_here(const fence *f, const unsigned char *bytes, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_family *family = load_behind(f, bytes, size, &error);
    int refused = !family && error.status == VNDF_ERROR_TABLE && error.message[0];
    vndf_family_free(family);
    return refused;
}

/* ---- what is saved ---- */

static void test_same(const unsigned char *bytes, size_t size)
{
    static unsigned char again[ROOM];
    vndf_error error = {VNDF_OK, ""};
    vndf_family *family = vndf_family_load(path, &error);
    if (!TEST(family != NULL))
        return;
    vndf_family_facts facts = vndf_family_info(family);
    TEST(facts.bytes == size && facts.count == 2 && facts.reciprocal == 1);
    TEST(facts.low == 1.8f && facts.high == 3.0f && facts.distance > 0.01f && facts.grazing > facts.distance);
    TEST(strcmp(facts.source, "--family student-t --parameter 1.8..3") == 0 && facts.tool[0]);
    TEST(facts.memory == vndf_distribution_info(vndf_family_distribution(family, 0)).memory +
                             vndf_distribution_info(vndf_family_distribution(family, 1)).memory);
    TEST(vndf_family_distance(family, 0) == facts.distance && vndf_family_distance(family, 1) == 0);
    TEST(vndf_family_save_memory(family, again, size, &error) == VNDF_OK && memcmp(again, bytes, size) == 0);
    TEST(vndf_family_save_memory(family, again, size - 1, &error) == VNDF_ERROR_ARGUMENT);
    size_t at = parameters_at(bytes) + 3 * 4 + 4;
    vndf_info first = vndf_distribution_info(vndf_family_distribution(family, 0));
    TEST(strcmp(first.source, "--family student-t:1.8") == 0);
    TEST(first.bytes == get_u32(bytes + at - 4) && memcmp(bytes + at, "VNDFtab\n", 8) == 0);
    vndf_family_free(family);
}

static void test_not_saved(void)
{
    const vndf_distribution *ggx = vndf_ggx();
    const float zero = 0;
    unsigned char byte;
    vndf_error error = {VNDF_OK, ""};
    vndf_family *family = vndf_family_of(&ggx, &zero, 1, NULL);
    TEST(vndf_family_save_memory(family, &byte, 1, &error) == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "built or loaded");
    TEST(vndf_family_save(NULL, "x", NULL) == VNDF_ERROR_ARGUMENT);
    vndf_family_free(family);
    TEST(!vndf_family_load(NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_family_load_memory(NULL, 9, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_family_load(VNDF_SOURCE_DIR "/no such file", &error) && error.status == VNDF_ERROR_IO);
    TEST(!vndf_family_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", &error) &&
         error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "not a vndf family: it must begin with \"VNDFfam\"");
}

/* ---- damage ---- */

static void test_damage(unsigned char *bytes, size_t size, size_t step)
{
    fence f = fence_for(ROOM);
    size_t wrong = 0;
    TEST(!is_refused_here(&f, bytes, size));
    for (size_t n = 0; n < size; n++)
        wrong += !is_refused_here(&f, bytes, n);
    TEST(wrong == 0);
    memset(bytes + size, 0, 8);
    TEST(is_refused_here(&f, bytes, size + 1) && is_refused_here(&f, bytes, size + 8));
    for (size_t bit = 0; bit < 8 * size; bit += step) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        TEST(is_refused_here(&f, bytes, size));
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
#ifdef DAMAGE_HAS_PAGES
    if (f.base)
        munmap(f.base, f.room + (size_t)sysconf(_SC_PAGESIZE));
#endif
}

/* Checksums of the tables, whose sizes are those of `sound`, and of the whole. */
static void mend_all(unsigned char *bytes, const unsigned char *sound, size_t size)
{
    size_t at = parameters_at(sound) + 3 * 4;
    for (int i = 0; i < 2; i++) {
        size_t table = get_u32(sound + at);
        mend_checksum(bytes + at + 4, table);
        at += 4 + table;
    }
    mend_checksum(bytes, size);
}

static void test_mended_family(const unsigned char *sound, size_t size, size_t step)
{
    static unsigned char bytes[ROOM];
    unsigned long long state = 31;
    fence none = {NULL, 0};
    size_t taken = 0;
    for (size_t bit = 0; bit < 8 * (size - 4); bit += step) {
        vndf_error error = {VNDF_OK, ""};
        memcpy(bytes, sound, size);
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        mend_all(bytes, sound, size);
        vndf_family *family = load_behind(&none, bytes, size, &error);
        TEST((family == NULL) == (error.status == VNDF_ERROR_TABLE));
        for (size_t i = 0; i < 2 && family; i++)
            TEST(is_safe(vndf_family_distribution(family, i), &state));
        taken += family != NULL;
        vndf_family_free(family);
    }
    fprintf(stderr, "%lu flips were taken once the checksums were mended\n", (unsigned long)taken);
}

/* ---- rules ---- */

typedef void change(unsigned char *bytes, size_t parameters);

static void no_knots(unsigned char *bytes, size_t parameters)
{
    (void)parameters;
    put_u32(bytes + COUNT, 0);
}

static void many_knots(unsigned char *bytes, size_t parameters)
{
    (void)parameters;
    put_u32(bytes + COUNT, VNDF_LIMIT_FAMILY_KNOTS + 1);
}

static void other_map(unsigned char *bytes, size_t parameters)
{
    (void)parameters;
    put_u32(bytes + MAP, 2);
}

static void large_grazing(unsigned char *bytes, size_t parameters)
{
    (void)parameters;
    put_f32(bytes + GRAZING, 1.01f);
}

static void control_character(unsigned char *bytes, size_t parameters)
{
    (void)parameters;
    bytes[SOURCE + 6] = 27;
}

static void same_parameters(unsigned char *bytes, size_t parameters)
{
    put_f32(bytes + parameters + 4, 1.8f);
}

static void no_number(unsigned char *bytes, size_t parameters)
{
    put_f32(bytes + parameters + 4, (float)NAN);
}

static void not_positive(unsigned char *bytes, size_t parameters)
{
    put_f32(bytes + parameters, 0);
}

static void negative_distance(unsigned char *bytes, size_t parameters)
{
    put_f32(bytes + parameters + 8, -0.01f);
}

static void one_knot(unsigned char *bytes, size_t parameters)
{
    (void)parameters;
    put_u32(bytes + COUNT, 1); /* parameter 2 is read as the size of a table */
}

static void short_table(unsigned char *bytes, size_t parameters)
{
    put_u32(bytes + parameters + 12, get_u32(bytes + parameters + 12) - 1);
}

static void long_table(unsigned char *bytes, size_t parameters)
{
    put_u32(bytes + parameters + 12, 0xfffffff0u);
}

static void bad_table(unsigned char *bytes, size_t parameters)
{
    size_t second = parameters + 16 + get_u32(bytes + parameters + 12) + 4;
    bytes[second + 200] ^= 1;
}

static void test_rule(const unsigned char *sound, size_t size, change *apply, const char *part)
{
    static unsigned char bytes[ROOM];
    vndf_error error = {VNDF_OK, ""};
    memcpy(bytes, sound, size);
    apply(bytes, parameters_at(sound));
    mend_checksum(bytes, size);
    vndf_family *family = vndf_family_load_memory(bytes, size, &error);
    TEST(!family && error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, part);
    vndf_family_free(family);
}

static void test_rest(const unsigned char *sound, size_t size)
{
    static unsigned char bytes[ROOM];
    vndf_error error = {VNDF_OK, ""};
    memcpy(bytes, sound, size);
    memset(bytes + size, 0, 4);
    put_u32(bytes + 12, size + 4);
    mend_checksum(bytes, size + 4);
    TEST(!vndf_family_load_memory(bytes, size + 4, &error));
    TEST_HAS(error.message, "do not fill the file");
}

static void test_rules(const unsigned char *sound, size_t size)
{
    test_rule(sound, size, no_knots, "counts are outside");
    test_rule(sound, size, many_knots, "counts are outside");
    test_rule(sound, size, other_map, "counts are outside");
    test_rule(sound, size, large_grazing, "no part of 1");
    test_rule(sound, size, control_character, "ends early");
    test_rule(sound, size, same_parameters, "must ascend");
    test_rule(sound, size, no_number, "not a number");
    test_rule(sound, size, not_positive, "must be positive");
    test_rule(sound, size, negative_distance, "no part of 1");
    test_rule(sound, size, one_knot, "do not fill the file");
    test_rule(sound, size, short_table, "table 1: the table says that it has");
    test_rule(sound, size, long_table, "do not fill the file");
    test_rule(sound, size, bad_table, "table 2: the checksum does not match");
    test_rest(sound, size);
}

int main(void)
{
    static unsigned char bytes[ROOM + 8];
    size_t size = read_bytes(path, bytes, ROOM), step = test_quick() ? 11 : 1;
    if (!TEST(size > 1000 && size < ROOM - 8))
        return test_done();
    test_same(bytes, size);
    test_not_saved();
    test_rules(bytes, size);
    test_damage(bytes, size, step);
    test_mended_family(bytes, size, 3 * step);
    return test_done();
}
