/* The file of a family gives back what was saved, to the byte; every truncation and every flip of a bit is refused, and
 * nothing is read beyond its end (as sanitizers see); where the checksums are put right again, it is refused, or each
 * of its tables is safe to use; and what breaks one rule of the format is refused with that rule's name. */
#include "harness/damage.h"
#include "table/family/family.h"
#include "vndf_build.h"

enum { COUNT = 16, MAP = 20, GRAZING = 24, SOURCE = 28, ROOM = 1 << 14 };

static const char path[] = VNDF_SOURCE_DIR "/tests/corpus/family/two.vndfs";

/* Where the parameters begin: behind both texts. */
static size_t parameters_at(const unsigned char *bytes)
{
    size_t tool = SOURCE + 4 + little_whole(bytes + SOURCE, 4);
    return tool + 4 + little_whole(bytes + tool, 4);
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
    TEST(first.bytes == little_whole(bytes + at - 4, 4) && memcmp(bytes + at, "VNDFtab\n", 8) == 0);
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
    TEST(!vndf_family_of(&ggx, NULL, 1, NULL) &&
         vndf_family_parameter(NULL, 0) + vndf_family_distance(NULL, 0) == 0);
    TEST(!vndf_family_load(NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_family_load_memory(NULL, 9, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_family_load(VNDF_SOURCE_DIR "/no such file", &error) && error.status == VNDF_ERROR_IO);
    TEST(!vndf_family_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", &error) &&
         error.status == VNDF_ERROR_TABLE);
    TEST_HAS(error.message, "not a vndf family: it must begin with \"VNDFfam\"");
}

/* ---- damage ---- */

static verdict load(const unsigned char *bytes, size_t size, vndf_error *error)
{
    vndf_family *family = vndf_family_load_memory(bytes, size, error);
    verdict found = family ? SAFE : REFUSED;
    for (size_t i = 0; i < 2 && family; i++)
        found = is_safe(vndf_family_distribution(family, i), 0) ? found : UNSAFE;
    vndf_family_free(family);
    return found;
}

/* Checksums of both tables and of the whole. */
static void mend(unsigned char *bytes, const unsigned char *sound, size_t size)
{
    size_t at = parameters_at(sound) + 3 * 4;
    for (int i = 0; i < 2; i++) {
        size_t table = little_whole(sound + at, 4);
        mend_checksum(bytes + at + 4, table);
        at += 4 + table;
    }
    mend_checksum(bytes, size);
}

/* ---- rules ---- */

/* The parameters of both knots are followed by the distance between them and the size of the first table. */
enum { FILE_START, PARAMETERS, PARTS };

static const broken_rule RULES[] = {
    {FILE_START, COUNT, WORD, 0, "counts are outside"},
    {FILE_START, COUNT, WORD, VNDF_LIMIT_FAMILY_KNOTS + 1, "counts are outside"},
    {FILE_START, COUNT, WORD, 1, "do not fill the file"}, /* parameter 2 is read as the size of a table */
    {FILE_START, MAP, WORD, 2, "counts are outside"},
    {FILE_START, GRAZING, FLOAT, 1.01, "no part of 1"},
    {FILE_START, SOURCE + 4, WORD, 0x1b2d2d2d, "ends early"}, /* a control character */
    {PARAMETERS, 0, FLOAT, 0, "must be positive"},
    {PARAMETERS, 4, FLOAT, 1.8, "must ascend"},
    {PARAMETERS, 4, FLOAT, (double)NAN, "not a number"},
    {PARAMETERS, 8, FLOAT, -0.01, "no part of 1"},
    {PARAMETERS, 12, WORD, 100, "table 1: the table says that it has"},
    {PARAMETERS, 12, WORD, 0xfffffff0u, "do not fill the file"},
    {PARAMETERS, -204, WORD, 7, "table 2: the checksum does not match"},
};

int main(void)
{
    static unsigned char bytes[ROOM], longer[ROOM];
    const file_kind families = {load, mend};
    size_t size = read_bytes(path, bytes, ROOM);
    if (!TEST(size > 1000 && size < ROOM - 8))
        return test_done();
    test_same(bytes, size);
    test_not_saved();
    const size_t part[PARTS + 1] = {0, parameters_at(bytes), size};
    test_broken_rules(&families, bytes, size, part, RULES, sizeof RULES / sizeof *RULES);
    memcpy(longer, bytes, size);
    test_refused_for(&families, longer, size + 4, "do not fill the file");
    test_damaged_file(&families, path, test_quick() ? 11 : 1);
    return test_done();
}
