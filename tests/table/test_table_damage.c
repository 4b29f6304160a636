/* Every truncation and every single-bit flip of a shipped table is refused, and nothing is read beyond its end;
 * where the checksum is put right again, the table is refused or safe to use. (test_long_table_damage: all
 * shipped tables.) */
#define _DEFAULT_SOURCE
#include "harness/damage.h"
#include "oracle/oracle.h"

int main(void)
{
    static unsigned char bytes[DAMAGE_BYTES_MAX + 8];
    const char *path = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";
    size_t step = test_quick() ? 5 : 1;
    test_refused(path, bytes, step);
    test_mended(path, bytes, step);
    return test_done();
}
