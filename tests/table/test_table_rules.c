/* A table that breaks one rule of format 4 is refused, whatever its checksum says, and the message names the rule: the
 * counts, the range of every number, knots that ascend, masses that add up to 1, parts that fill the file. Random
 * damage (test_table_damage.c) nearly always breaks several rules at once: it would not miss one of them. */
#include "harness/damage.h"
#include "oracle/oracle.h"
#include "vndf_build.h"

enum { ROOM = 1 << 16, SCALES = 16, COUNTS = 32, CLAIMS = 44, TEXTS = 92 };

/* The arrays in their order. */
enum { KNOT, DENSITY_LEFT, DENSITY_RIGHT, M0, M1, M2, M4, B0, B1, AREA, SLOPE };

typedef struct table_bytes {
    unsigned char bytes[ROOM];
    size_t size, arrays, knots; /* where the arrays begin; cells + 1 */
} table_bytes;

static float get_f32(const unsigned char *bytes)
{
    uint32_t bits = (uint32_t)get_u32(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Of four moments, so that all arrays are there. */
static int make_table(table_bytes *t)
{
    oracle o = oracle_get(ORACLE_LAPLACE);
    vndf_distribution *table = oracle_build(o.name, 8192, NULL, NULL);
    t->size = vndf_distribution_info(table).bytes;
    int made = TEST(table && t->size <= ROOM && vndf_save_memory(table, t->bytes, t->size, NULL) == VNDF_OK);
    vndf_free(table);
    if (!made || !TEST(get_u32(t->bytes + 8) == 4 && get_u32(t->bytes + COUNTS + 4) == 4))
        return 0;
    size_t tool = TEXTS + 4 + get_u32(t->bytes + TEXTS);
    t->arrays = tool + 4 + get_u32(t->bytes + tool);
    t->knots = get_u32(t->bytes + COUNTS) + 1;
    return TEST(t->arrays + 44 * t->knots + 4 == t->size);
}

static verdict load(const unsigned char *bytes, size_t size, vndf_error *error)
{
    vndf_distribution *table = vndf_load_memory(bytes, size, error);
    vndf_free(table);
    return table ? SAFE : REFUSED;
}

static const file_kind tables = {load, NULL};

static void refuse(table_bytes *changed, const char *part)
{
    test_refused_for(&tables, changed->bytes, changed->size, part);
}

/* ---- numbers ---- */

static const struct {
    int array;
    size_t index; /* one beyond the last stands for the last */
    float value;
    const char *message;
} NUMBERS[] = {{KNOT, 0, 1e-3f, "knots do not run"},
               {KNOT, 1, 1e-13f, "knots do not run"},
               {KNOT, 9999, 2e14f, "knots do not run"},
               {KNOT, 5, 0, "ascend"},
               {KNOT, 5, NAN, "ascend"},
               {DENSITY_LEFT, 2, -1e-6f, "density is out of range"},
               {DENSITY_RIGHT, 9999, NAN, "density is out of range"},
               {DENSITY_LEFT, 0, 1e37f, "density is out of range"},
               {M0, 3, 0, "moment is out of range"},
               {M1, 3, -1, "moment is out of range"},
               {M2, 9999, INFINITY, "moment is out of range"},
               {M4, 2, -1e-9f, "moment is out of range"},
               {B0, 1, -0.1f, "share is out of range"},
               {B1, 9999, NAN, "share is out of range"},
               {B0, 4, 1e7f, "share is out of range"},
               {AREA, 0, 0, "area is out of range"},
               {SLOPE, 3, NAN, "area is out of range"},
               {M0, 40, 0.5f, "add up to 1"},
               {M1, 6, 0.5f, "moment is out of range"},
               {DENSITY_LEFT, 6, 1e9f, "density is out of range"},
               {SLOPE, 6, 1e9f, "area is out of range"}};

static void test_numbers(const table_bytes *sound)
{
    static table_bytes t;
    for (size_t i = 0; i < sizeof NUMBERS / sizeof *NUMBERS; i++) {
        size_t index = NUMBERS[i].index < sound->knots ? NUMBERS[i].index : sound->knots - 1;
        t = *sound;
        put_f32(t.bytes + t.arrays + 4 * ((size_t)NUMBERS[i].array * t.knots + index), NUMBERS[i].value);
        refuse(&t, NUMBERS[i].message);
    }
    t = *sound; /* two knots that are one */
    put_f32(t.bytes + t.arrays + 20, get_f32(t.bytes + t.arrays + 16));
    refuse(&t, "ascend");
    for (int claim = 0; claim < 12; claim++) {
        t = *sound;
        put_f32(t.bytes + CLAIMS + 4 * claim, claim % 2 ? NAN : claim == 11 ? 1 : -1);
        refuse(&t, "no measurement");
    }
    for (int which = 0; which < 2; which++)
        for (int i = 0; i < 3; i++) { /* zero, infinity, NaN */
            static const unsigned char tops[3][2] = {{0, 0}, {0xf0, 0x7f}, {0xf8, 0x7f}};
            t = *sound;
            memset(t.bytes + SCALES + 8 * which, 0, 6);
            memcpy(t.bytes + SCALES + 8 * which + 6, tops[i], 2);
            refuse(&t, "scale or normalization");
        }
}

/* ---- the whole ---- */

static void test_whole(const table_bytes *sound)
{
    static const unsigned long counts[][2] = {{0, 1}, {0, 0}, {0, 5000}, {0, 0xffffffff}, {1, 1}, {1, 5}, {2, 6}};
    static table_bytes t;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        t = *sound;
        put_u32(t.bytes + COUNTS + 4 * counts[i][0], counts[i][1]);
        refuse(&t, "outside the limits");
    }
    for (size_t more = 1; more <= 8; more++) { /* parts that end before the file does */
        t = *sound;
        memset(t.bytes + t.size - 4, 0, 12);
        t.size += more;
        refuse(&t, "do not fill the file");
    }
    t = *sound;
    put_u32(t.bytes + COUNTS, (unsigned long)sound->knots + 3); /* and after it */
    refuse(&t, "do not fill the file");
    t = *sound;
    put_u32(t.bytes + COUNTS + 4, 3); /* one array less */
    refuse(&t, "do not fill the file");
    for (unsigned version = 1; version < 4; version++) {
        t = *sound;
        put_u32(t.bytes + 8, version);
        refuse(&t, "build it again");
    }
    t = *sound;
    put_u32(t.bytes + 8, 5);
    refuse(&t, "version");
}

int main(void)
{
    static table_bytes sound;
    if (make_table(&sound)) {
        TEST(load(sound.bytes, sound.size, NULL) == SAFE);
        test_numbers(&sound);
        test_whole(&sound);
    }
    return test_done();
}
