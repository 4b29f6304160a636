/* A PFM that is written is read back to the bit; files of either byte order, of one channel, with CR LF are read;
 * broken ones are refused with the reason. Notices rows from the wrong end, a byte order that is not swapped, and
 * sizes that are believed. */
#include "harness/test.h"
#include "render/image.h"

static void test_round_trip(void)
{
    static const float values[6][3] = {{0, -1, 1e-30f}, {1e30f, 0.1f, 3}, {4, 5, 6},
                                       {7, 8, 9},       {10, 11, 12},     {13, 14, 15}};
    image made, back;
    image_error error = {""};
    unsigned char bytes[256];
    FILE *file = tmpfile();
    if (!TEST(file && image_make(&made, 3, 2)))
        return;
    memcpy(made.rgb, values, sizeof values);
    TEST(image_write_pfm(file, &made));
    rewind(file);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    TEST(size == strlen("PF\n3 2\n-1.0\n") + sizeof values && memcmp(bytes, "PF\n3 2\n-1.0\n", 12) == 0);
    if (TEST(image_read_pfm_bytes(&back, "x", bytes, size, &error)))
        TEST(back.width == 3 && back.height == 2 && memcmp(back.rgb, values, sizeof values) == 0);
    image_free(&back);
    image_free(&made);
    fclose(file);
}

static void test_forms(void)
{
    static const char big[] = "PF\n1 1\n2.5\n\x3f\x80\0\0\x40\0\0\0\xc0\0\0\0",
                      grey[] = "Pf\r\n1 2\r\n-1\r\n\0\0\x80\x3f\0\0\0\x40";
    image made;
    image_error error;
    if (TEST(image_read_pfm_bytes(&made, "x", big, sizeof big - 1, &error)))
        TEST(made.rgb[0] == 1.0f && made.rgb[1] == 2.0f && made.rgb[2] == -2.0f);
    image_free(&made);
    if (TEST(image_read_pfm_bytes(&made, "x", grey, sizeof grey - 1, &error)))
        TEST(made.rgb[0] == 2.0f && made.rgb[2] == 2.0f && made.rgb[3] == 1.0f && made.rgb[5] == 1.0f);
    image_free(&made);
}

static void test_refusals(void)
{
#define PIXEL "\0\0\x80\x3f"
    static const struct {
        const char *bytes;
        size_t size;
        const char *says;
    } bad[] = {
        {"", 0, "x: this is no PFM image"},
        {"P6\n1 1\n255\n", 11, "x: this is no PFM image"},
        {"PFx\n1 1\n-1\n", 11, "x: this is no PFM image"},
        {"PF\n1 1\n", 7, "the head of the PFM is not whole"},
        {"Pf\n0 1\n-1\n" PIXEL, 14, "width 0 and height 1: both must be whole numbers"},
        {"Pf\n1 1.5\n-1\n" PIXEL, 16, "both must be whole numbers from 1 to 16384"},
        {"Pf\n16384 16384\n-1\n" PIXEL, 22, "16384 x 16384 pixels are more than"},
        {"Pf\n1 1\n0\n" PIXEL, 13, "'0' must be a number other than 0"},
        {"Pf\n1 1\n-1\n" PIXEL "\0", 15, "1 x 1 pixels take 4 bytes after the head, and there are 5"},
        {"Pf\n2 1\n-1\n" PIXEL, 14, "2 x 1 pixels take 8 bytes after the head, and there are 4"},
        {"Pf\n2 1\n-1\n" PIXEL "\0\0\x80\x7f", 18,
         "the pixel in column 1 of row 0 (from the top, from 0) is not finite"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        image made;
        image_error error = {""};
        if (!(TEST(!image_read_pfm_bytes(&made, "x", bad[i].bytes, bad[i].size, &error) && !made.rgb) &
              TEST_HAS(error.message, bad[i].says)))
            fprintf(stderr, "    says %s\n", error.message);
    }
}

int main(void)
{
    test_round_trip();
    test_forms();
    test_refusals();
    return test_done();
}
