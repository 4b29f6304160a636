/* Reading bytes stops at the end: the last byte is had, the one after it is not, and a reader that
 * failed gives zeros from then on. (What is written: table_round_trip.) */
#include "core/cursor.h"
#include "harness/test.h"

int main(void)
{
    const unsigned char bytes[12] = {0x78, 0x56, 0x34, 0x12, 0, 0, 0x80, 0x3f, 1, 2, 3, 4};
    vndf_reader whole = {bytes, 8, 0, 0}, last = {bytes, 11, 8, 0}, none = {bytes, 8, 8, 0};
    TEST(vndf_read_u32(&whole) == 0x12345678 && vndf_read_f32(&whole) == 1.0f && !whole.failed);
    TEST(vndf_read_bytes(&whole, 0) == bytes + 8 && !whole.failed);
    TEST(vndf_read_bytes(&whole, 1) == NULL && whole.failed && whole.at == 8);
    TEST(vndf_read_u32(&last) == 0 && last.failed && last.at == 8);
    TEST(vndf_read_bytes(&last, 1) == NULL); /* though a byte is left */
    TEST(vndf_read_f64(&none) == 0.0 && none.failed);
    none.failed = 0;
    TEST(vndf_read_bytes(&none, (size_t)-1) == NULL && none.failed);
    return test_done();
}
