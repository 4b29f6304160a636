/* A table that breaks one rule of the format is refused, whatever its checksum says, and the message names the
 * rule: every rule of src/table/validate.c, the limits of the counts, and parts that leave bytes over. Random
 * damage (test_table_hostile.c) nearly always breaks several rules at once: it would not miss one of them. */
#include <stdlib.h>

#include "core/checksum.h"
#include "oracle/oracle.h"
#include "table/file.h"
#include "table/table.h"
#include "harness/test.h"

enum { SIZE = 4096, COUNTS = 32 /* where the seven counts begin */ };

static void put_u32(unsigned char *at, unsigned value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(value >> 8 * i);
}

/* The bytes with a right size and checksum are refused for a reason that holds `part`. */
static void test_refused(unsigned char *bytes, size_t size, const char *part)
{
    vndf_error error = {VNDF_OK, ""};
    put_u32(bytes + 12, (unsigned)size);
    put_u32(bytes + size - 4, vndf_crc32(0, bytes, size - 4));
    vndf_distribution *table = vndf_load_memory(bytes, size, &error);
    if (!(TEST(!table) & TEST(error.status == VNDF_ERROR_TABLE) & TEST_HAS(error.message, part)))
        fprintf(stderr, "  asked for: %s, had: %s\n", part, error.message);
    vndf_free(table);
}

/* ---- rules of what is in the parts --------------------------------------------------------------- */

static void off_line(vndf_distribution *t)
{
    t->knots.at[3].x += 1e-4f;
}

static void moment_zero(vndf_distribution *t)
{
    t->cells[2].mu0 = 0;
}

static void moment_large(vndf_distribution *t)
{
    t->cells[2].mu1 = 1e7f;
}

static void density_negative(vndf_distribution *t)
{
    t->cells[2].f1 = -1e-6f;
}

static void density_nan(vndf_distribution *t)
{
    t->cells[2].f0 = NAN;
}

static void pole_dense(vndf_distribution *t)
{
    t->cells[0].f0 = 0.1f;
}

static void cubic_negative(vndf_distribution *t)
{
    t->cells[2].mu0 = 1e-30f;
}

static void claim_nan(vndf_distribution *t)
{
    t->certificate.max_weight = NAN;
}

static void claim_negative(vndf_distribution *t)
{
    t->certificate.tv = -1;
}

static void scale_zero(vndf_distribution *t)
{
    t->scale = 0;
}

static void normalization_infinite(vndf_distribution *t)
{
    t->normalization = INFINITY;
}

static void cells_coincide(vndf_wedge *w)
{
    w->q[2] = w->q[1];
}

static void row_mass_zero(vndf_wedge *w)
{
    w->row_cell[1].mass += w->row_cell[0].mass;
    w->row_cell[0].mass = 0;
}

static void row_density_negative(vndf_wedge *w)
{
    w->row_cell[1].density = -1e-3f;
}

static void row_heavy(vndf_wedge *w)
{
    w->row_cell[1].mass += 0.001f;
}

static void aspect_zero(vndf_wedge *w)
{
    *vndf_aspect_r(w, 1) = 0;
}

static void rows_coincide(vndf_wedge *w)
{
    w->row_y[1] = 0;
}

static void rows_nearly_coincide(vndf_wedge *w)
{
    w->row_y[1] = 1e-20f;
}

static void knots_coincide(vndf_wedge *w)
{
    w->knot_y[1] = 0;
}

static void no_mass(vndf_wedge *w)
{
    w->mass[1] = 0;
}

static void slope_negative(vndf_wedge *w)
{
    w->slope[1] = -1;
}

static void curve_nan(vndf_wedge *w)
{
    w->curve[1] = NAN;
}

static void mass_falls(vndf_wedge *w)
{
    w->mass[1] = 2 * w->mass[2];
}

static void knots_swapped(vndf_distribution *t)
{
    vndf_knot knot = t->knots.at[3];
    t->knots.at[3] = t->knots.at[4];
    t->knots.at[4] = knot;
}

static void knots_equal(vndf_distribution *t)
{
    t->knots.at[4] = t->knots.at[3];
}

static const struct {
    void (*spoil)(vndf_distribution *table);
    const char *message;
} TABLE_RULES[] = {{off_line, "off the line"},
                   {knots_swapped, "radial knots do not ascend"},
                   {knots_equal, "coincide"},
                   {moment_zero, "moment out of range"},
                   {moment_large, "moment out of range"},
                   {density_negative, "moment out of range"},
                   {density_nan, "moment out of range"},
                   {pole_dense, "from the pole"},
                   {cubic_negative, "below zero"},
                   {claim_nan, "no measurement"},
                   {claim_negative, "no measurement"},
                   {scale_zero, "scale or normalization"},
                   {normalization_infinite, "scale or normalization"}};

static const struct {
    void (*spoil)(vndf_wedge *wedge);
    const char *message;
} WEDGE_RULES[] = {{cells_coincide, "azimuth cells do not ascend"},
                   {row_mass_zero, "mass or density"},
                   {row_density_negative, "mass or density"},
                   {row_heavy, "add up to 1"},
                   {aspect_zero, "aspect"},
                   {rows_coincide, "azimuth rows do not ascend"},
                   {rows_nearly_coincide, "azimuth rows do not ascend"},
                   {knots_coincide, "area knots do not ascend"},
                   {no_mass, "wedge mass is out of range"},
                   {slope_negative, "wedge mass is out of range"},
                   {curve_nan, "wedge mass is out of range"},
                   {mass_falls, "wedge masses do not ascend"}};

static void test_spoiled(vndf_distribution *table, const char *message)
{
    unsigned char bytes[SIZE];
    test_refused(bytes, vndf_table_encode(table, bytes, sizeof bytes), message);
    vndf_free(table);
}

static void test_rules(const unsigned char *sound, size_t size)
{
    for (size_t i = 0; i < sizeof TABLE_RULES / sizeof *TABLE_RULES; i++) {
        vndf_distribution *table = vndf_load_memory(sound, size, NULL);
        TABLE_RULES[i].spoil(table);
        test_spoiled(table, TABLE_RULES[i].message);
    }
    for (size_t i = 0; i < 2 * (sizeof WEDGE_RULES / sizeof *WEDGE_RULES); i++) {
        vndf_distribution *table = vndf_load_memory(sound, size, NULL);
        WEDGE_RULES[i / 2].spoil(i % 2 ? &table->below : &table->above);
        test_spoiled(table, WEDGE_RULES[i / 2].message);
    }
}

/* ---- rules of the whole -------------------------------------------------------------------------- */

/* Which count, and a value outside its limits. */
/* clang-format off */
static const unsigned LIMITS[][2] = {
    {0, 1}, {0, VNDF_RADIAL_CELLS_MAX + 1}, {1, 1}, {1, VNDF_WEDGE_CELLS_MAX + 1}, {2, 1}, {2, 4},
    {2, VNDF_WEDGE_ROWS_MAX + 1}, {3, 1}, {3, VNDF_AREA_KNOTS_MAX + 1}, {4, 1}, {4, VNDF_WEDGE_CELLS_MAX + 1},
    {5, 1}, {5, 4}, {5, VNDF_WEDGE_ROWS_MAX + 1}, {6, 1}, {6, VNDF_AREA_KNOTS_MAX + 1}};
/* clang-format on */

static void test_whole(const unsigned char *sound, size_t size)
{
    unsigned char bytes[SIZE + 8];
    for (size_t i = 0; i < sizeof LIMITS / sizeof *LIMITS; i++) {
        memcpy(bytes, sound, size);
        put_u32(bytes + COUNTS + 4 * LIMITS[i][0], LIMITS[i][1]);
        test_refused(bytes, size, "outside the limits");
    }
    for (unsigned more = 1; more <= 8; more++) { /* parts that end before the file does */
        memset(bytes, 0, sizeof bytes);
        memcpy(bytes, sound, size - 4);
        test_refused(bytes, size + more, "do not fill the file");
    }
    memcpy(bytes, sound, size);
    put_u32(bytes + COUNTS, 8000); /* and after it */
    test_refused(bytes, size, "do not fill the file");
}

int main(void)
{
    unsigned char sound[SIZE];
    oracle o = oracle_get(ORACLE_LAPLACE);
    vndf_distribution *table = oracle_build(&o, SIZE, NULL);
    size_t size = table ? vndf_table_encode(table, sound, sizeof sound) : 0;
    vndf_free(table);
    table = vndf_load_memory(sound, size, NULL);
    if (TEST(table != NULL)) {
        test_rules(sound, size);
        test_whole(sound, size);
    }
    vndf_free(table);
    return test_done();
}
