/* What test_table_damage does with a small table holds for every table given: all truncations and all
 * single-bit flips are refused, and with the checksum put right again each flip is refused or safe. */
#define _DEFAULT_SOURCE
#include "harness/damage.h"

int main(int count, char **paths)
{
    static unsigned char bytes[DAMAGE_BYTES_MAX + 8];
    TEST(count > 1);
    for (int i = 1; i < count; i++) {
        test_refused(paths[i], bytes, 1);
        test_mended(paths[i], bytes, 1);
    }
    return test_done();
}
