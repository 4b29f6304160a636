/* No bytes crash the reader of MERL files, which are read as its head, and now and then as what its numbers repeat:
 * they are refused with a message that names the file, or D is a curve over ascending angles. */
#include "fuzz/measured.h"
#include "measured/brdf.h"

enum { MERL_SIZE = 12 + 3 * 8 * 90 * 90 * 180, SELDOM = 8192 };

static void try_merl(const uint8_t *bytes, size_t size)
{
    profile rows;
    data_file file = fuzz_file(bytes, size);
    int good = merl_read(&file, MERL_GREEN, &rows);
    fuzz_judge(good, &rows, &file);
}

/* A whole file whose numbers are the bytes over and over. */
static void try_whole_merl(const uint8_t *bytes, size_t size)
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
    const uint8_t *bytes = size ? data : (uint8_t *)text;
    try_merl(bytes, size);
    if (fuzz_is_seldom(data, size, SELDOM))
        try_whole_merl(data, size);
}
