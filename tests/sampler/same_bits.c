/* Prints hashes of the bits that the run time computes for the closed forms and the tables that are its arguments:
 *
 *     same_bits COUNT [TABLE...]
 *
 * after COUNT steps of harness/hash.h. A line has the hash after so many steps, that number, and the distribution: one
 * after PREFIX, so that a slow machine that takes fewer is compared with a fast one, and one after COUNT.
 * test_same_bits.cmake compares differently compiled copies. */
#include <stdlib.h>

#include "harness/hash.h"

enum { PREFIX = 20000 };

static void print_hashes(const vndf_distribution *distribution, const char *name, unsigned long count)
{
    unsigned long long state = 20140716, hash = hash_begin;
    for (unsigned long i = 0; i < count; i++) {
        hash = hash_step(hash, distribution, i, &state);
        if (i + 1 == PREFIX || i + 1 == count)
            printf("%016llx %lu %s\n", hash, i + 1, name);
    }
}

int main(int arguments, char **argument)
{
    const unsigned long count = arguments > 1 ? strtoul(argument[1], NULL, 10) : 0;
    if (!TEST(count >= PREFIX))
        return test_done();
    print_hashes(vndf_ggx(), "ggx", count);
    print_hashes(vndf_beckmann(), "beckmann", count);
    for (int i = 2; i < arguments; i++) {
        vndf_distribution *table = vndf_load(argument[i], NULL);
        const char *slash = strrchr(argument[i], '/');
        if (TEST(table != NULL))
            print_hashes(table, slash ? slash + 1 : argument[i], count);
        vndf_free(table);
    }
    return test_done();
}
