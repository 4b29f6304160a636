/* Every truncation and every single-bit flip of a shipped table is refused, and nothing is read beyond its end (as
 * sanitizers see); where the checksum is put right again, the table is refused or its samples are finite, unit and not
 * below the surface, and its densities finite and positive: it may be wrong, never dangerous. Arguments: tables. */
#include "harness/damage.h"

static verdict load(const unsigned char *bytes, size_t size, vndf_error *error)
{
    vndf_distribution *table = vndf_load_memory(bytes, size, error);
    verdict found = !table ? REFUSED : is_safe(table) ? SAFE : UNSAFE;
    vndf_free(table);
    return found;
}

static void mend(unsigned char *bytes, const unsigned char *sound, size_t size)
{
    (void)sound;
    mend_checksum(bytes, size);
}

int main(int count, char **paths)
{
    const file_kind tables = {load, mend};
    for (int i = 1; i < count; i++)
        test_damaged_file(&tables, paths[i], 1);
    if (count == 1)
        test_damaged_file(&tables, VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", test_quick() ? 5 : 1);
    return test_done();
}
