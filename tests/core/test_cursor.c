/* Reading bytes stops at the end: the last byte is had, the one after it is not, and a reader that
 * failed gives zeros from then on; what is written grows. */
#include <stdlib.h>

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

/* Bytes grow, and are little-endian. */
static void test_writer(void)
{
    vndf_writer w = {NULL, 0, 0, 0};
    vndf_write_u32(&w, 0x12345678);
    vndf_write_f32(&w, 1.0f);
    TEST(w.size == 8 && w.bytes[0] == 0x78 && w.bytes[3] == 0x12 && w.bytes[7] == 0x3f);
    for (int i = 0; i < 1000; i++)
        vndf_write_bytes(&w, "xy", 2);
    TEST(w.size == 2008 && w.bytes[4] == 0 && w.bytes[2006] == 'x' && w.bytes[2007] == 'y' && !w.failed);
    free(w.bytes);
}

int main(void)
{
    test_reader();
    test_writer();
    return test_done();
}
