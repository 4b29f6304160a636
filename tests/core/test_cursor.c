/* Reading and writing bytes stop at the end: the last byte is had, the one after it is not, and a reader that
 * failed gives zeros from then on. */
#include "core/cursor.h"
#include "harness/test.h"

static void test_reader(void)
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
}

/* What does not fit is counted, and nothing is written. */
static void test_writer(void)
{
    unsigned char bytes[9];
    memset(bytes, 0xEE, sizeof bytes);
    vndf_writer w = {bytes, 8, 0};
    vndf_write_u32(&w, 0x12345678);
    vndf_write_f32(&w, 1.0f);
    TEST(w.at == 8 && bytes[0] == 0x78 && bytes[3] == 0x12 && bytes[7] == 0x3f && bytes[8] == 0xEE);
    vndf_write_bytes(&w, "x", 1);
    TEST(w.at == 9 && bytes[8] == 0xEE);
    vndf_writer part = {bytes, 8, 5};
    vndf_write_u32(&part, 0);
    TEST(part.at == 9 && bytes[5] == 0 && bytes[6] == 0x80 && bytes[8] == 0xEE);
}

int main(void)
{
    test_reader();
    test_writer();
    return test_done();
}
