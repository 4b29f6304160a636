/* No bytes crash the reader of goniometer tables: they are refused with a message that names the file, or D is a curve
 * over ascending angles; and no bytes crash the reader of MERL files, which are read as its head, and now and then as
 * what its numbers repeat. */
#include <math.h>

#include "fuzz/fuzz.h"
#include "measured/brdf.h"

enum { MERL_SIZE = 12 + 3 * 8 * 90 * 90 * 180, SELDOM = 8192 };

static void judge(int good, profile *rows, const data_file *file)
{
    fuzz_require(good || (strncmp(file->refused, "fuzz: ", 6) == 0 && rows->x == NULL),
                 "a refusal has a reason alone");
    for (size_t i = 0; good && i < rows->count; i++)
        fuzz_require(isfinite(rows->value[i]) && rows->value[i] >= 0 && (i == 0 || rows->x[i] > rows->x[i - 1]),
                     "rows are a curve");
    fuzz_require(strstr(file->notes, "nan") == NULL, "what is said is a number");
    if (good)
        profile_free(rows);
}

static void try_gonio(const unsigned char *bytes, size_t size)
{
    profile rows;
    data_file file = {.name = "fuzz", .bytes = bytes, .size = size};
    judge(gonio_read(&file, -1, &rows), &rows, &file);
}

static void try_merl(const unsigned char *bytes, size_t size)
{
    profile rows;
    data_file file = {.name = "fuzz", .bytes = bytes, .size = size};
    judge(merl_read(&file, MERL_GREEN, &rows), &rows, &file);
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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint32_t hash = 1;
    uint8_t *exact = calloc(size ? size : 1, 1);
    if (exact == NULL)
        abort();
    for (size_t i = 0; i < size; i++) {
        exact[i] = data[i];
        hash = (hash ^ data[i]) * 16777619u;
    }
    try_gonio(exact, size);
    try_merl(exact, size);
    if (size > 0 && (hash >> 8) % SELDOM == 0)
        try_whole_merl(exact, size);
    free(exact);
    return 0;
}
