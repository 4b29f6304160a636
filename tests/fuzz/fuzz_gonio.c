/* No bytes crash the reader of goniometer tables: they are refused with a message that names the file, or D is a curve
 * over ascending angles; and no bytes crash the reader of MERL files, which are read as its head, and now and then as
 * what its numbers repeat. */
#include "fuzz/measured.h"
#include "measured/brdf/gonio.h"
#include "measured/brdf/merl.h"

enum { MERL_SIZE = 12 + 3 * 8 * 90 * 90 * 180, SELDOM = 8192 };

static void try_gonio(const char *bytes, size_t size)
{
    gonio_points points;
    profile rows = {VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, NULL, NULL, 0, NULL};
    notes said = {"", 0};
    refusal why = {""};
    int good =
        gonio_read(&points, "fuzz", bytes, size, &why) && gonio_law(&points, -1, "fuzz", &rows, &said, &why);
    fuzz_judge(good, &rows, &said, &why);
    gonio_free(&points);
}

static void try_merl(const unsigned char *bytes, size_t size)
{
    profile rows;
    notes said = {"", 0};
    refusal why = {""};
    int good = merl_read(&rows, "fuzz", bytes, size, MERL_GREEN, &said, &why);
    fuzz_judge(good, &rows, &said, &why);
}

/* A whole file whose numbers are the bytes over and over. */
static void try_whole_merl(const unsigned char *bytes, size_t size)
{
    static const unsigned char head[12] = {90, 0, 0, 0, 90, 0, 0, 0, 180};
    unsigned char *whole = malloc(MERL_SIZE);
    if (whole == NULL)
        abort();
    memcpy(whole, head, sizeof head);
    for (size_t i = sizeof head; i < MERL_SIZE; i++)
        whole[i] = bytes[(i - sizeof head) % size];
    try_merl(whole, MERL_SIZE);
    free(whole);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    try_gonio(text, size);
    try_merl(size ? data : (uint8_t *)text, size);
    if (fuzz_is_seldom(data, size, SELDOM))
        try_whole_merl(data, size);
}
