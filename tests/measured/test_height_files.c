/* The same heights come out of every kind of file that they are read from, normal maps have the slopes of the heights
 * that they were made of, and what is no such file is refused with the place. Noticed: rows from the wrong end, a step
 * or a scale in another's place, the wrong byte first. */
#include "measured/measured_case.h"

enum { WIDTH = 37, HEIGHT = 29, ROOM = 1 << 16 };

static char text[ROOM];

static float height_at(int i)
{
    int x = i % WIDTH, y = i / WIDTH;
    return (float)(0.4 * sin(0.9 * x + 0.4 * y) + 0.25 * cos(1.7 * y) + 0.7);
}

static size_t put_float(char *at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        at[i] = (char)(bits >> 8 * i & 255);
    return 4;
}

static size_t make_pfm(int channels)
{
    size_t at = (size_t)sprintf(text, "%s\n%d %d\n-1\n", channels == 3 ? "PF" : "Pf", WIDTH, HEIGHT);
    for (int y = HEIGHT - 1; y >= 0; y--) /* from the bottom */
        for (int x = 0; x < WIDTH; x++)
            for (int i = 0; i < channels; i++)
                at += put_float(text + at, i == 0 ? height_at(y * WIDTH + x) : 7);
    return at;
}

static size_t make_text(void)
{
    size_t at = (size_t)sprintf(text, "\xEF\xBB\xBF# heights\r\n\n");
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        at += (size_t)sprintf(text + at, "%.9g%s", (double)height_at(i),
                              (i + 1) % WIDTH ? "\t "
                              : i % 2         ? "\r\n"
                                              : "  # end\n");
    return at;
}

static size_t make_pgm(int most)
{
    size_t at = (size_t)sprintf(text, "P5\n# a map\n%d %d # sides\n%d\n", WIDTH, HEIGHT, most);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int value = (int)floor((double)height_at(i) / 1.4 * most + 0.5);
        if (most > 255)
            text[at++] = (char)(value >> 8);
        text[at++] = (char)(value & 255);
    }
    return at;
}

/* Every height is that of height_at times `scale`, to `off`. */
static void read_back(size_t size, double scale, double off)
{
    height_field field;
    double worst = 0;
    data_file file = case_file(text, size);
    if (case_read(heights_read(&file, &field), &file)) {
        TEST(field.width == WIDTH && field.height == HEIGHT && field.step_x == 1 && field.step_y == 1);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            worst = fmax(worst, fabs((double)field.z[i] - scale * (double)height_at(i)) / scale);
        if (!TEST(worst <= off))
            fprintf(stderr, "  %.20s: off by %g\n", text, worst);
        heights_free(&field);
    }
    case_free(&file);
}

static void test_kinds(void)
{
    read_back(make_pfm(1), 1, 0);
    read_back(make_pfm(3), 1, 0);
    read_back(make_text(), 1, 1e-7);
    read_back(make_pgm(255), 1 / 1.4, 0.6 / 255 * 1.4);
    read_back(make_pgm(65535), 1 / 1.4, 0.6 / 65535 * 1.4);
}

/* nan in a text is a place without a height. */
static void test_gap(void)
{
    const char *rows = "1 2 3\n4 nan 6\n7 8 9\n";
    height_field field;
    data_file file = case_file(rows, strlen(rows));
    if (case_read(heights_read(&file, &field), &file))
        for (int i = 0; i < 9; i++)
            TEST(i == 4 ? isnan(field.z[i]) : field.z[i] == (float)(i + 1));
    heights_free(&field);
    case_free(&file);
}

/* Heights of a Gaussian surface as normals, of bytes or floats; the law is that of the heights. */
static void test_normals(void)
{
    enum { SIDE = 256 };
    static const char *const said_of[3] = {"n/2 + 1/2, whole numbers", "n, floats", "n/2 + 1/2, floats"};
    static char map[SIDE * SIDE * 12 + 64];
    height_field field = case_gaussian(SIDE, 3, 3, 0.2);
    for (int kind = 0; kind < 3; kind++) {
        size_t at = (size_t)sprintf(map, "%s\n%d %d\n%s\n", kind ? "PF" : "P6", SIDE, SIDE, kind ? "-1" : "255");
        for (int i = 0; i < SIDE * SIDE; i++) {
            int x = i % SIDE, y = kind ? SIDE - 1 - i / SIDE : i / SIDE, left = (x + SIDE - 1) % SIDE;
            int above = (y + SIDE - 1) % SIDE, below = (y + 1) % SIDE;
            double n[3] = {(double)field.z[y * SIDE + left] - (double)field.z[y * SIDE + (x + 1) % SIDE],
                           (double)field.z[above * SIDE + x] - (double)field.z[below * SIDE + x], 2};
            double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (int k = 0; k < 3; k++) {
                double value = kind == 1 ? n[k] / length : n[k] / length / 2 + 0.5;
                if (kind)
                    at += put_float(map + at, (float)value);
                else
                    map[at++] = (char)(int)floor(value * 255 + 0.5);
            }
        }
        slope_set slopes;
        profile rows;
        data_file file = case_file(map, at);
        if (!case_read(normals_slopes(&file, &slopes) && slopes_law(&slopes, &file, &rows), &file))
            continue;
        TEST_HAS(file.notes, said_of[kind]);
        TEST_HAS(file.notes, "left_out 0\n");
        double rms = case_number(&file, "rms_slope "), off = case_from_beckmann(&rows, sqrt(2) * rms);
        printf("normal map of %s: rms %.5f, TV from Beckmann %.4f\n", said_of[kind], rms, off);
        TEST_RELATIVE(rms, 0.2, 0.02);
        TEST(off < (kind ? 0.015 : 0.04)); /* bytes are coarse */
        profile_free(&rows);
        slopes_free(&slopes);
        case_free(&file);
    }
    heights_free(&field);
}

/* ---- refusals ------------------------------------------------------------------------------------ */

static void refused(const void *bytes, size_t size, const char *reason)
{
    height_field field;
    data_file file = case_file(bytes, size);
    int good = heights_read(&file, &field);
    TEST(field.z == NULL);
    case_refused(good, &file, reason);
}

static void test_refusals(void)
{
    static const char *const cases[][2] = {
        {"", "0 x 0 heights; both sides must be from 3"},
        {"1 2 3\n4 5 6\n", "3 x 2 heights; both sides must be from 3"},
        {"1 2 3\n4 5\n", "line 2: 2 numbers, and 3 in the lines before"},
        {"1 2 3\n\n# no\n4 5 x6\n", "line 4: 'x6' is no height"},
        {"1 2 3\n4 5 inf\n", "line 2: 'inf' is no height"},
        {"1,2,3\n", "line 1: '1,2,3' is no height; numbers between blanks"},
        {"1 2 1e31\n", "line 1: '1e31' is no height"},
        {"P2\n3 3\n255\n", "the binary ones are read, which begin with P5 or P6"},
        {"P5\n3 3\n255\n12345678", "3 x 3 pixels take 9 bytes after the head, and there are 8"},
        {"P5\n3 x\n255\n", "the head of the image is not whole"},
        {"P5\n3 3\n65536\n123", "the head of the image is not whole"},
        {"P6\n1 1\n255\n123", "a PPM has colours"},
        {"Pf\n3 3\n-1\n1234", "3 x 3 pixels take 36 bytes after the head, and there are 4"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        refused(cases[i][0], strlen(cases[i][0]), cases[i][1]);
    size_t size = make_pgm(255);
    for (size_t cut = 0; cut < size; cut += 7)
        refused(text, cut, "");
}

static void test_refused_maps(void)
{
    static const struct {
        const char *bytes;
        size_t size;
        const char *reason;
    } cases[] = {
        {"", 0, "begin with P5 or P6"},
        {"P5\n1 1\n255\n1", 12, "an image of one channel"},
        {"Pf\n1 1\n-1\n1234", 14, "an image of one channel"},
        {"P6\n1 2\n255\n12345", 16, "1 x 2 pixels take 6 bytes after the head, and there are 5"},
        {"P6\n1 2\n255\n\0\0\0\0\0\0", 17, "2 of 2 pixels are no normals"},
        {"P6\n1 2\n255\n\x7f\x7f\0\x7f\x7f\1", 17, "2 of 2 pixels are no normals with z above 0"},
        {"PF\n2 1\n-1\nabc", 13, "2 x 1 pixels take 24 bytes"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        slope_set slopes;
        data_file file = case_file(cases[i].bytes, cases[i].size);
        int good = normals_slopes(&file, &slopes);
        TEST(slopes.x == NULL);
        case_refused(good, &file, cases[i].reason);
    }
}

int main(void)
{
    test_kinds();
    test_gap();
    test_normals();
    test_refusals();
    test_refused_maps();
    return test_done();
}
