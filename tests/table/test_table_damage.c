/* Every truncation and every single-bit flip of a shipped table is refused, and nothing is read beyond its end (as
 * sanitizers see); where the checksum is put right again, the table is refused or its samples are finite, unit and not
 * below the surface, and its densities finite and positive: it may be wrong, never dangerous. A table that breaks one
 * rule of format 5 is refused, whatever its checksum says, and the message names the rule: the counts, the range of
 * every number, knots that ascend, masses that add up to 1, notes in lines, parts that fill the file. (Random damage
 * nearly always breaks several rules at once: it would not miss one of them.) Arguments: tables, damaged alone. */
#include "harness/damage.h"
#include "oracle/oracle.h"

enum { ROOM = 1 << 14, VERSION = 8, SCALES = 16, COUNTS = 32, CLAIMS = 44, TEXTS = 100 };

/* The arrays in their order, then the head and the end of the file. */
enum { KNOT, DENSITY_LEFT, DENSITY_RIGHT, M0, M1, M2, M4, B0, B1, AREA, SLOPE, ARRAYS, FILE_START };

static const broken_rule RULES[] = {
    {KNOT, 0, FLOAT, 1e-3, "knots do not run"},
    {KNOT, 4, FLOAT, 1e-13, "knots do not run"},
    {KNOT, -4, FLOAT, 2e14, "knots do not run"},
    {KNOT, 20, FLOAT, 0, "ascend"},
    {KNOT, 20, FLOAT, (double)NAN, "ascend"},
    {DENSITY_LEFT, 8, FLOAT, -1e-6, "density is out of range"},
    {DENSITY_LEFT, 0, FLOAT, 1e37, "density is out of range"},
    {DENSITY_LEFT, 24, FLOAT, 1e9, "density is out of range"},
    {DENSITY_RIGHT, -4, FLOAT, (double)NAN, "density is out of range"},
    {M0, 12, FLOAT, 0, "moment is out of range"},
    {M0, 160, FLOAT, 0.01, "add up to 1"},
    {M1, 12, FLOAT, -1, "moment is out of range"},
    {M1, 24, FLOAT, 0.5, "moment is out of range"},
    {M2, -4, FLOAT, (double)INFINITY, "moment is out of range"},
    {M4, 8, FLOAT, -1e-9, "moment is out of range"},
    {M4, -4, FLOAT, 1, "moment is out of range"},
    {B0, 4, FLOAT, -0.1, "share is out of range"},
    {B0, 16, FLOAT, 1e7, "share is out of range"},
    {B1, -4, FLOAT, (double)NAN, "share is out of range"},
    {AREA, 0, FLOAT, 0, "area is out of range"},
    {SLOPE, 12, FLOAT, (double)NAN, "area is out of range"},
    {SLOPE, 24, FLOAT, 1e9, "area is out of range"},
    {SLOPE, 24, FLOAT, -1e9, "area is out of range"},
    {FILE_START, SCALES + 4, WORD, 0xbff00000, "scale or normalization"}, /* a negative double, and no number */
    {FILE_START, SCALES + 4, WORD, 0xfff80000, "scale or normalization"},
    {FILE_START, SCALES + 12, WORD, 0x7fe00000, "scale or normalization"},
    {FILE_START, SCALES + 12, WORD, 0xfff80000, "scale or normalization"},
    {FILE_START, COUNTS, WORD, 1, "outside the limits"},
    {FILE_START, COUNTS, WORD, 4096, "outside the limits"},
    {FILE_START, COUNTS, WORD, 200, "do not fill the file"},
    {FILE_START, COUNTS + 4, WORD, 1, "outside the limits"},
    {FILE_START, COUNTS + 4, WORD, 3, "do not fill the file"}, /* one array less */
    {FILE_START, COUNTS + 4, WORD, 5, "outside the limits"},
    {FILE_START, COUNTS + 8, WORD, 6, "outside the limits"},
    {FILE_START, TEXTS + 4, WORD, 0x0a0a0a0a, "do not fill the file"}, /* a source in lines */
    {FILE_START, VERSION, WORD, 4, "build it again"},
    {FILE_START, VERSION, WORD, 6, "version"},
};

static verdict load(const unsigned char *bytes, size_t size, vndf_error *error)
{
    vndf_distribution *table = vndf_load_memory(bytes, size, error);
    verdict found = !table ? REFUSED : is_safe(table, 0) ? SAFE : UNSAFE;
    vndf_free(table);
    return found;
}

static void mend(unsigned char *bytes, const unsigned char *sound, size_t size)
{
    (void)sound;
    mend_checksum(bytes, size);
}

static void test_rules(const file_kind *tables)
{
    static unsigned char sound[ROOM], longer[ROOM];
    static const char notes[] = "key value\n",
                      *const wrong = "0K0 3_3=5\2004 4\n9 9\0010\0335\t5\1775\n"; /* a place, and what is there */
    vndf_source *source = oracle_source("exp(-r)", NULL);
    TEST(vndf_source_note(NULL, notes, NULL) && vndf_source_note(source, "k \177\n", NULL));
    TEST(vndf_source_note(source, notes, NULL) == VNDF_OK);
    vndf_distribution *table = vndf_build(source, NULL, NULL, NULL); /* of four moments: all arrays are there */
    size_t size = vndf_distribution_info(table).bytes, part[FILE_START + 1] = {0};
    TEST(table && vndf_save_memory(table, sound, size, NULL) == VNDF_OK);
    TEST(strcmp(vndf_distribution_info(table).notes, notes) == 0);
    vndf_free(table);
    vndf_source_free(source);
    size_t arrays = TEXTS;
    for (int i = 0; i < 3; i++)
        arrays += 4 + little_whole(sound + arrays, 4);
    for (size_t i = 0; i <= ARRAYS; i++)
        part[i] = arrays + 4 * i * (little_whole(sound + COUNTS, 4) + 1);
    if (!TEST(part[ARRAYS] + 4 == size && size < ROOM - 16))
        return;
    test_broken_rules(tables, sound, size, part, RULES, sizeof RULES / sizeof *RULES);
    for (int claim = 0; claim < 14; claim++) {
        const broken_rule bad = {FILE_START, CLAIMS + 4 * claim, FLOAT, claim % 2 ? (double)NAN : -1,
                                 "no measurement"};
        test_broken_rules(tables, sound, size, part, &bad, 1);
    }
    for (const char *at = wrong; *at; at += 2) {
        memcpy(longer, sound, size);
        longer[arrays - strlen(notes) + (size_t)(*at - '0')] = (unsigned char)at[1];
        test_refused_for(tables, longer, size, strchr(" K_=\200\n", at[1]) ? "`key value`" : "do not fill");
    }
    for (size_t more = 1; more <= 8; more++) { /* parts that end before the file does */
        memcpy(longer, sound, size);
        test_refused_for(tables, longer, size + more, "do not fill the file");
    }
}

int main(int count, char **paths)
{
    const file_kind tables = {load, mend};
    for (int i = 1; i < count; i++)
        test_damaged_file(&tables, paths[i], 1);
    if (count == 1) {
        test_damaged_file(&tables, VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", test_quick() ? 5 : 1);
        test_rules(&tables);
    }
    return test_done();
}
