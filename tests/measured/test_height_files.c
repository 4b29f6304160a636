/* The same heights come out of every kind of file that they are read from, normal maps have the slopes of the heights
 * that they were made of, and what is no such file is refused with its name and the place. */
#include "measured/surface_case.h"

#include <stdint.h>

#include "measured/surface/maps.h"

enum { WIDTH = 37, HEIGHT = 29, ROOM = 1 << 16 };

static char file[ROOM];

static float height_at(int x, int y)
{
    return (float)(0.4 * sin(0.9 * x + 0.4 * y) + 0.25 * cos(1.7 * y) + 0.7);
}

static void put_float(size_t at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        file[at + (size_t)i] = (char)(bits >> 8 * i & 255);
}

static size_t make_pfm(int channels)
{
    size_t at = (size_t)sprintf(file, "%s\n%d %d\n-1\n", channels == 3 ? "PF" : "Pf", WIDTH, HEIGHT);
    for (int y = HEIGHT - 1; y >= 0; y--) /* from the bottom */
        for (int x = 0; x < WIDTH; x++)
            for (int i = 0; i < channels; i++, at += 4)
                put_float(at, i == 0 ? height_at(x, y) : 7);
    return at;
}

static size_t make_raw(void)
{
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        put_float(4 * (size_t)i, height_at(i % WIDTH, i / WIDTH));
    return 4 * WIDTH * HEIGHT;
}

static size_t make_text(void)
{
    size_t at = (size_t)sprintf(file, "\xEF\xBB\xBF# heights\r\n\n");
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++)
            at += (size_t)sprintf(file + at, "%s%.9g", x ? "\t " : "", (double)height_at(x, y));
        at += (size_t)sprintf(file + at, y % 2 ? "\r\n" : "  # end\n");
    }
    return at;
}

static size_t make_sdf(void)
{
    size_t at = (size_t)sprintf(file,
                                "aISO-1.0\nManufacID = us\nNumPoints =%d\nNumProfiles= %d\nXscale=2e-6\n"
                                "Yscale = 3e-6\nZscale   = 1e-6\nZresolution = -1\nCompression = 0\nDataType = 7\n"
                                "CheckType = 0\n*\n",
                                WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        at += (size_t)sprintf(file + at, "%.9g%s", (double)height_at(i % WIDTH, i / WIDTH),
                              i % 10 == 9 ? "\n" : " ");
    return at + (size_t)sprintf(file + at, "\n*\nend of it\n*\n");
}

static size_t make_pgm(int most)
{
    size_t at = (size_t)sprintf(file, "P5\n# a map\n%d %d # sides\n%d\n", WIDTH, HEIGHT, most);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int value = (int)floor((double)height_at(i % WIDTH, i / WIDTH) / 1.4 * most + 0.5);
        if (most > 255)
            file[at++] = (char)(value >> 8);
        file[at++] = (char)(value & 255);
    }
    return at;
}

/* Read with the form; every height is that of height_at times `scale`, to `off`. */
static void read_back(const char *what, size_t size, const height_form *form, double scale, double off,
                      double step_x, double step_y)
{
    height_field field;
    refusal why = {""};
    double worst = 0;
    char *exact = malloc(size);
    memcpy(exact, file, size);
    if (!TEST(heights_read(&field, what, exact, size, form, &why))) {
        fprintf(stderr, "  %s\n", why.message);
        free(exact);
        return;
    }
    TEST(field.width == WIDTH && field.height == HEIGHT);
    TEST(field.step_x == step_x && field.step_y == step_y);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        worst = fmax(worst, fabs((double)field.z[i] - scale * (double)height_at(i % WIDTH, i / WIDTH)) / scale);
    if (!TEST(worst <= off))
        fprintf(stderr, "  %s: off by %g\n", what, worst);
    heights_free(&field);
    free(exact);
}

static void test_kinds(void)
{
    const height_form plain = {0, 0, 0, 0}, raw = {WIDTH, HEIGHT, 0, 0}, stretched = {0, 0, 0.5, 0.25};
    read_back("x.pfm", make_pfm(1), &plain, 1, 0, 1, 1);
    read_back("colour.pfm", make_pfm(3), &stretched, 1, 0, 0.5, 0.25);
    read_back("x.raw", make_raw(), &raw, 1, 0, 1, 1);
    read_back("x.txt", make_text(), &plain, 1, 1e-7, 1, 1);
    read_back("x.sdf", make_sdf(), &plain, 1e-6, 1e-7, 2e-6, 3e-6);
    read_back("x.sdf", make_sdf(), &stretched, 1e-6, 1e-7, 0.5, 0.25);
    read_back("8.pgm", make_pgm(255), &plain, 1 / 1.4, 0.6 / 255 * 1.4, 1, 1);
    read_back("16.pgm", make_pgm(65535), &plain, 1 / 1.4, 0.6 / 65535 * 1.4, 1, 1);
}

/* nan in a text, BAD in an .sdf and floats that are no numbers are places without a height. */
static void test_gaps(void)
{
    const char text[] = "1 2 3\n4 nan 6\n7 8 9\n";
    const char sdf[] = "aBCR-1.0\nNumPoints = 3\nNumProfiles = 3\nXscale = 1\nYscale = 1\nZscale = 1\n*\n"
                       "1 2 3 4 BAD 6 7 8 9\n*\n";
    const height_form plain = {0, 0, 0, 0}, raw = {3, 3, 0, 0};
    height_field field;
    refusal why = {""};
    for (int i = 0; i < 9; i++)
        put_float(4 * (size_t)i, i == 4 ? NAN : (float)(i + 1));
    const void *bytes[3] = {text, sdf, file};
    const size_t sizes[3] = {sizeof text - 1, sizeof sdf - 1, 36};
    for (int k = 0; k < 3; k++) {
        if (!TEST(heights_read(&field, "gaps", bytes[k], sizes[k], k == 2 ? &raw : &plain, &why)))
            continue;
        for (int i = 0; i < 9; i++)
            TEST(i == 4 ? isnan(field.z[i]) : field.z[i] == (float)(i + 1));
        heights_free(&field);
    }
}

/* ---- normal maps --------------------------------------------------------------------------------- */

/* Heights of a Gaussian surface as normals, of bytes or floats; the law is that of the heights. */
static void test_normals(void)
{
    enum { SIDE = 256 };
    static const char *const said_of[3] = {"n/2 + 1/2, whole numbers", "n, floats", "n/2 + 1/2, floats"};
    height_field field = surface_gaussian(SIDE, 3, 3, 0.2);
    char *map = malloc(SIDE * SIDE * 12 + 64), *floats = file;
    refusal why = {""};
    for (int kind = 0; kind < 3; kind++) {
        size_t at = (size_t)sprintf(map, "%s\n%d %d\n%s\n", kind ? "PF" : "P6", SIDE, SIDE, kind ? "-1" : "255");
        for (int i = 0; i < SIDE * SIDE; i++) {
            int x = i % SIDE, y = kind ? SIDE - 1 - i / SIDE : i / SIDE, row = y * SIDE;
            double sx = ((double)field.z[row + (x + 1) % SIDE] - (double)field.z[row + (x + SIDE - 1) % SIDE]) / 2;
            double sy =
                ((double)field.z[(y + 1) % SIDE * SIDE + x] - (double)field.z[(y + SIDE - 1) % SIDE * SIDE + x]) /
                2;
            double n[3] = {-sx, -sy, 1}, length = sqrt(sx * sx + sy * sy + 1);
            for (int k = 0; k < 3; k++) {
                double value = kind == 1 ? n[k] / length : n[k] / length / 2 + 0.5;
                put_float(0, (float)value);
                if (kind == 0)
                    map[at++] = (char)(int)floor(value * 255 + 0.5);
                else
                    memcpy(map + at, floats, 4);
                at += kind ? 4 : 0;
            }
        }
        slope_set slopes;
        slope_law law;
        notes said = {"", 0};
        if (!TEST(maps_read(&slopes, "map", map, at, &said, &why)) ||
            !TEST(slopes_law(&slopes, "map", &law, &said, &why)))
            continue;
        TEST_HAS(said.text, said_of[kind]);
        TEST_HAS(said.text, "left_out 0\n");
        TEST_RELATIVE(law.rms, 0.2, 0.02);
        vndf_source *source = profile_source(&law.rows, "map", &why);
        double off = surface_from_beckmann(source, sqrt(2) * law.rms);
        printf("normal map of %s: rms %.5f, TV from Beckmann %.4f\n", said_of[kind], law.rms, off);
        TEST(off < (kind ? 0.015 : 0.04)); /* bytes are coarse */
        vndf_source_free(source);
        profile_free(&law.rows);
        slopes_free(&slopes);
    }
    free(map);
    heights_free(&field);
}

/* ---- refusals ------------------------------------------------------------------------------------ */

static void refused(const void *bytes, size_t size, const height_form *form, const char *message)
{
    height_field field;
    refusal why = {""};
    char *exact = malloc(size ? size : 1);
    memcpy(exact, bytes, size);
    if (!(TEST(!heights_read(&field, "bad.file", exact, size, form, &why)) & TEST(field.z == NULL) &
          TEST(strncmp(why.message, "bad.file: ", 10) == 0) & TEST_HAS(why.message, message)))
        fprintf(stderr, "  %s\n", why.message);
    free(exact);
}

static void refused_text(const char *text, const char *message)
{
    const height_form plain = {0, 0, 0, 0};
    refused(text, strlen(text), &plain, message);
}

static void test_refusals(void)
{
    const height_form plain = {0, 0, 0, 0}, raw = {WIDTH, HEIGHT, 0, 0};
    refused_text("", "0 x 0 heights; both sides must be from 3");
    refused_text("1 2 3\n4 5 6\n", "3 x 2 heights; both sides must be from 3");
    refused_text("1 2 3\n4 5\n", "line 2: 2 numbers, and 3 in the lines before");
    refused_text("1 2 3\n\n# no\n4 5 x6\n", "line 4: 'x6' is no height");
    refused_text("1 2 3\n4 5 inf\n", "line 2: 'inf' is no height");
    refused_text("1,2,3\n", "line 1: '1,2,3' is no height; numbers between blanks");
    refused_text("1 2 1e31\n", "line 1: '1e31' is no height");
    refused_text("P2\n3 3\n255\n", "the binary ones are read, which begin with P5 or P6");
    refused_text("P5\n3 3\n255\n12345678", "3 x 3 pixels take 9 bytes after the head, and there are 8");
    refused_text("P5\n3 x\n255\n", "the head of the image is not whole");
    refused_text("P5\n3 3\n65536\n123", "the head of the image is not whole");
    refused_text("P6\n1 1\n255\n123", "a PPM has colours");
    refused_text("Pf\n3 3\n-1\n1234", "3 x 3 pixels take 36 bytes after the head, and there are 4");
    refused_text("bISO-1.0\n", "this is a binary .sdf");
    refused_text("aISO-1.0\nNumPoints = 3\n", "the head of the .sdf does not end");
    refused_text("aISO-1.0\nNumPoints = 3\n*\n", "NumPoints 3 and NumProfiles 0: both must be whole");
    refused_text("aISO-1.0\nNumPoints = 3\nNumProfiles = 3\nXscale = 0\nYscale = 1\nZscale = 1\n*\n",
                 "Xscale 0, Yscale 1");
    refused_text(
        "aISO-1.0\nNumPoints = 3\nNumProfiles = 3\nXscale = 1\nYscale = 1\nZscale = 1\nCompression = 1\n*\n",
        "Compression 1: only 0 is read");
    refused_text(
        "aISO-1.0\nNumPoints = 3\nNumProfiles = 3\nXscale = 1\nYscale = 1\nZscale = 1\n*\n1 2 3 4 5 6\n7 8\n*\n",
        "line 10: the heights end after 8 of 3 x 3");
    refused_text("aISO-1.0\nNumPoints = 3\nNumProfiles = 3\nXscale = 1\nYscale = 1\nZscale = 1\n*\n1 2 3 4 five",
                 "line 8: 'five' is no height");
    refused_text(
        "aISO-1.0\nNumPoints = 3\nNumProfiles = 3\nXscale = 1\nYscale = 1\nZscale = 1\n*\n1 2 3 4 5 6 7 8 9 10\n",
        "line 8: more than 3 x 3 heights");
    refused(file, make_raw() - 1, &raw, "37 x 29 floats take 4292 bytes, and there are 4291");
    refused(file, make_raw() + 1, &raw, "and there are 4293");
    /* Every truncation of every kind is refused, or still a file of that kind. */
    size_t size = make_pgm(255);
    for (size_t cut = 0; cut < size; cut += 7)
        refused(file, cut, &plain, "");
}

static void refused_map(const void *bytes, size_t size, const char *message)
{
    slope_set slopes;
    notes said = {"", 0};
    refusal why = {""};
    if (!(TEST(!maps_read(&slopes, "bad.map", bytes, size, &said, &why)) & TEST(slopes.x == NULL) &
          TEST_HAS(why.message, "bad.map: ") & TEST_HAS(why.message, message)))
        fprintf(stderr, "  %s\n", why.message);
}

static void test_refused_maps(void)
{
    refused_map("", 0, "begin with P5 or P6");
    refused_map("P5\n1 1\n255\n1", 12, "a PGM has one channel");
    refused_map("Pf\n1 1\n-1\n1234", 14, "a PFM of one channel");
    refused_map("P6\n1 2\n255\n12345", 16, "1 x 2 pixels take 6 bytes after the head, and there are 5");
    refused_map("P6\n1 2\n255\n\0\0\0\0\0\0", 17, "2 of 2 pixels are no normals");
    refused_map("P6\n1 2\n255\n\x7f\x7f\0\x7f\x7f\1", 17, "2 of 2 pixels are no normals with z above 0");
    refused_map("PF\n2 1\n-1\nabc", 13, "2 x 1 pixels take 24 bytes");
}

int main(void)
{
    test_kinds();
    test_gaps();
    test_normals();
    test_refusals();
    test_refused_maps();
    return test_done();
}
