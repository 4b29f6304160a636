/* Every truncation and every single-bit flip of a table is refused, and nothing is read beyond its end: the
 * bytes are given in a block of exactly their size, which a sanitizer guards. */
#include <stdlib.h>

#include "oracle.h"
#include "table/file.h"
#include "test.h"

/* Tries a copy of its own of the first `size` bytes. */
static int is_refused(const unsigned char *bytes, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    unsigned char *own = malloc(size ? size : 1);
    if (!own)
        return 0;
    memcpy(own, bytes, size);
    vndf_distribution *table = vndf_load_memory(own, size, &error);
    free(own);
    int refused = !table && error.status == VNDF_ERROR_TABLE && error.message[0];
    vndf_free(table);
    return refused;
}

int main(void)
{
    unsigned char bytes[2048 + 8];
    oracle o = oracle_get(ORACLE_GGX);
    vndf_distribution *table = oracle_build(&o, 2048, NULL);
    size_t size = vndf_table_encode(table, bytes, 2048), step = oracle_quick() ? 5 : 1;
    TEST(table && size > 1000 && size <= 2048 && !is_refused(bytes, size));
    for (size_t n = 0; n < size; n++)
        if (!TEST(is_refused(bytes, n)))
            fprintf(stderr, "  the first %lu bytes\n", (unsigned long)n);
    for (size_t bit = 0; bit < 8 * size; bit += step) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        if (!TEST(is_refused(bytes, size)))
            fprintf(stderr, "  bit %lu flipped\n", (unsigned long)bit);
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    memset(bytes + size, 0, 8);
    TEST(is_refused(bytes, size + 1) && is_refused(bytes, size + 8)); /* more than the table */
    vndf_free(table);
    return test_done();
}
