/* Images survive the PFM that they are written to, no PFM is taken that is not whole, look-ups find the pixels
 * they should, and patterns are light or roughness. */
#include "harness/test.h"

#include <stdlib.h>

#include "render/scene/scene.h"

enum { ROOM = 4096 };

/* What was written to a temporary file; `bytes` has ROOM. */
static size_t take_back(FILE *file, unsigned char *bytes)
{
    rewind(file);
    size_t size = fread(bytes, 1, ROOM, file);
    fclose(file);
    return size;
}

static void fill(image *made, unsigned long long seed)
{
    size_t count = (size_t)made->width * (size_t)made->height * 3;
    for (size_t i = 0; i < count; i++)
        made->rgb[i] = ldexpf(test_uniform(&seed) - 0.25f, (int)(test_random_bits(&seed) >> 60) - 8);
}

/* ---- PFM ---- */

static void test_round_trip(unsigned char *bytes)
{
    image first, second;
    image_error error;
    FILE *file = tmpfile();
    if (!TEST(file && image_make(&first, 7, 5)))
        return;
    fill(&first, 3);
    TEST(image_write_pfm(file, &first));
    size_t size = take_back(file, bytes);
    if (TEST(image_read_pfm_bytes(&second, "x", bytes, size, &error))) {
        TEST(second.width == 7 && second.height == 5);
        TEST(memcmp(first.rgb, second.rgb, 7 * 5 * 3 * sizeof(float)) == 0);
        image_free(&second);
    }
    image_free(&first);
}

/* 2 x 2 grey, the most significant byte first: 1, 2 below 3, -0.5. */
static void test_grey_big_endian(void)
{
    static const char file[] = "Pf\n2 2\n1.0\n\x40\x40\0\0\xbf\0\0\0\x3f\x80\0\0\x40\0\0\0";
    static const float want[4] = {1.0f, 2.0f, 3.0f, -0.5f};
    image made;
    image_error error;
    float rgb[3];
    if (!TEST(image_read_pfm_bytes(&made, "x", file, sizeof file - 1, &error)))
        return;
    for (int i = 0; i < 4; i++) {
        image_at(&made, i % 2, i / 2, rgb);
        TEST(rgb[0] == want[i] && rgb[1] == want[i] && rgb[2] == want[i]);
    }
    image_free(&made);
}

static void refused(const char *bytes, size_t size, const char *part)
{
    image made = {1, 1, NULL};
    image_error error = {""};
    TEST(!image_read_pfm_bytes(&made, "sky.pfm", bytes, size, &error));
    TEST(made.rgb == NULL);
    TEST_HAS(error.message, "sky.pfm: ");
    TEST_HAS(error.message, part);
}

static void test_hostile(void)
{
    static const char infinite[] = "Pf 1 2 -1 \0\0\0\0\0\0\x80\x7f", one[] = "Pf 1 1 -1 \0\0\0\0";
    refused("", 0, "no PFM");
    refused("P6 1 1 255 abc", 14, "no PFM");
    refused("PFM 1 1 1 ", 10, "no PFM");
    refused("PF\n", 3, "not whole");
    refused("PF 10", 5, "not whole");
    refused("PF 1 1 -1", 9, "not whole"); /* no blank behind the scale */
    refused("PF 0 1 -1 ", 10, "whole numbers from 1");
    refused("PF -4 1 -1 ", 11, "whole numbers from 1");
    refused("PF 1 99999999999999999999 -1 ", 29, "whole numbers from 1");
    refused("PF 1x 1 -1 ", 11, "whole numbers from 1");
    refused("PF 16384 16384 -1 ", 18, "pixels are more than");
    refused("PF 1 1 0 123456789012", 21, "other than 0");
    refused("PF 1 1 nan 123456789012", 23, "other than 0");
    refused("PF 2 1 -1 123456789012", 22, "24 bytes after the head, and there are 12");
    refused("PF 1 1 -1 1234567890123", 23, "12 bytes after the head, and there are 13");
    refused(infinite, sizeof infinite - 1, "column 0 of row 0");
    for (size_t size = 0; size < sizeof one - 1; size++)
        refused(one, size, "");
}

static void test_missing_file(void)
{
    image made;
    image_error error;
    TEST(!image_read_pfm(&made, VNDF_SOURCE_DIR "/tests/there-is-none.pfm", &error));
    TEST_HAS(error.message, "there-is-none.pfm: ");
    TEST(!image_read_pfm(&made, VNDF_SOURCE_DIR "/tests", &error)); /* a folder */
}

/* ---- look-up ---- */

static void test_look_up(void)
{
    image made;
    float rgb[3];
    if (!TEST(image_make(&made, 4, 2)))
        return;
    for (int i = 0; i < 8; i++)
        made.rgb[3 * i] = (float)i; /* 0 1 2 3 over 4 5 6 7 */
    image_at(&made, 1, 1, rgb);
    TEST(rgb[0] == 5.0f);
    image_bilinear(&made, 0.625f, 0.25f, rgb); /* a centre */
    TEST_NEAR(rgb[0], 2.0, 1e-6);
    image_bilinear(&made, 0.5f, 0.5f, rgb); /* between 1, 2, 5, 6 */
    TEST_NEAR(rgb[0], 3.5, 1e-6);
    image_bilinear(&made, 0.0f, 0.25f, rgb); /* between the last and the first */
    TEST_NEAR(rgb[0], 1.5, 1e-6);
    static const float odd[] = {-1e-9f, 0.99999999f, 1e30f, -1e30f, 0.0f, 1.0f, -0.0f};
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++)
        for (size_t j = 0; j < sizeof odd / sizeof odd[0]; j++) {
            image_bilinear(&made, odd[i], odd[j], rgb);
            TEST(rgb[0] >= 0.0f && rgb[0] <= 7.0f);
        }
    image_free(&made);
}

static void test_sizes(void)
{
    image made;
    TEST(!image_make(&made, 0, 5) && !image_make(&made, 5, -1) && !image_make(&made, IMAGE_SIDE_MAX + 1, 1));
    TEST(made.rgb == NULL);
}

/* ---- patterns ---- */

static void test_patterns(void)
{
    static const char *const names[] = {"checks", "tiles", "stripes", "grid",    "studio",
                                        "stars",  "noise", "blots",   "brushed", "ramp"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        image made;
        image_error error;
        float least = INFINITY, most = 0.0f;
        TEST_HAS(scene_grammar[0], names[i]); /* told there */
        if (!TEST(image_make_pattern(&made, names[i], 96, 64, &error)))
            continue;
        for (int k = 0; k < 96 * 64 * 3; k++) {
            least = fminf(least, made.rgb[k]);
            most = fmaxf(most, made.rgb[k]);
        }
        TEST(least > 0.0f && most > 1.3f * least && most < 1000.0f); /* light, and not flat */
        TEST(i < 6 || (least > 0.09f && most <= 1.0f));              /* roughness */
        image_free(&made);
    }
}

static void expect_grey(const char *name, int width, int height, float even, float odd, int rows_differ)
{
    image made;
    image_error error;
    if (!TEST(image_make_pattern(&made, name, width, height, &error)))
        return;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            TEST_NEAR((double)made.rgb[3 * (y * width + x) + 2], (double)((x + rows_differ * y) % 2 ? odd : even),
                      1e-6);
    image_free(&made);
}

/* Those that repeat are shaded once and copied. */
static void test_repeated_patterns(void)
{
    image made;
    image_error error;
    float rgb[3];
    expect_grey("checks", 64, 32, 0.05f, 0.9f, 1);
    expect_grey("tiles", 16, 16, 0.25f, 0.75f, 1);
    expect_grey("stripes", 128, 3, 0.12f, 0.45f, 0);
    if (!TEST(image_make_pattern(&made, "grid", 480, 240, &error)))
        return;
    image_at(&made, 240, 125, rgb);
    TEST(rgb[0] > 0.5f && rgb[1] < 0.2f); /* a red line in every third black one */
    image_at(&made, 250, 125, rgb);
    TEST(rgb[0] < 0.2f);
    image_at(&made, 245, 125, rgb);
    TEST(rgb[0] > 0.8f && rgb[1] > 0.8f);
    image_at(&made, 245, 90, rgb);
    TEST(rgb[0] > 0.5f && rgb[1] < 0.2f);
    image_free(&made);
}

static void test_pattern_refusals(void)
{
    image made;
    image_error error;
    TEST(!image_make_pattern(&made, "strips", 8, 8, &error));
    TEST_HAS(error.message, "'strips'; did you mean 'stripes'?");
    TEST(!image_make_pattern(&made, "plaid", 8, 8, &error));
    TEST_HAS(error.message, "there are checks");
    TEST(!image_make_pattern(&made, "checks", 16384, 16384, &error) && made.rgb == NULL);
}

int main(void)
{
    unsigned char bytes[ROOM];
    test_round_trip(bytes);
    test_grey_big_endian();
    test_hostile();
    test_missing_file();
    test_look_up();
    test_sizes();
    test_patterns();
    test_repeated_patterns();
    test_pattern_refusals();
    return test_done();
}
