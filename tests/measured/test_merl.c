/* A MERL file of a GGX surface, in closed form, is read as GGX within 1%, also where a diffuse part is under it,
 * which is told apart; what is no MERL file is refused. Noticed: a scale in another's place, masking left out, a power
 * iteration that ends at something else than D. */
#include "measured/measured_case.h"

enum { PLANE = 90 * 90 * 180, SIZE = 12 + 3 * 8 * PLANE };

static const double unit_of[3] = {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
static unsigned char *bytes;

static void put(size_t channel, size_t i, double value)
{
    memcpy(bytes + 12 + 8 * (channel * PLANE + i), &value, sizeof value); /* little-endian machines */
}

static double ggx(double theta, double alpha)
{
    return case_ggx(tan(theta), alpha) / pow(cos(theta), 4);
}

/* Single scattering of GGX at the middle of each bin: half vector (sin h, 0, cos h), both directions at d from it. */
static void make(double alpha, const double f0[3])
{
    static const unsigned char head[12] = {90, 0, 0, 0, 90, 0, 0, 0, 180};
    memcpy(bytes, head, sizeof head);
    for (size_t i = 0; i < PLANE; i++) {
        double u = ((double)(i / 16200) + 0.5) / 90, h = PI / 2 * u * u,
               d = ((double)(i / 180 % 90) + 0.5) / 180 * PI;
        double side = sin(h) * sin(d) * cos(((double)(i % 180) + 0.5) / 180 * PI), square = alpha * alpha;
        double ci = cos(h) * cos(d) - side, co = cos(h) * cos(d) + side;
        double a = ci + sqrt(ci * ci + square * (1 - ci * ci)), b = co + sqrt(co * co + square * (1 - co * co));
        double f =
            ci > 0 && co > 0 ? ggx(h, alpha) / (2 * (a * co + b * ci - 2 * ci * co)) : 0; /* a, b: twice areas */
        for (size_t k = 0; k < 3; k++)
            put(k, i, f * (f0[k] + (1 - f0[k]) * pow(1 - cos(d), 5)) / unit_of[k]);
    }
}

/* The largest difference of D from GGX up to 75 degrees, relative. */
static double read_back(data_file *file, double alpha, merl_channel channel)
{
    profile rows;
    double worst = 0;
    *file = (data_file){.name = "made", .bytes = bytes, .size = SIZE};
    if (!case_read(merl_read(file, channel, &rows), file))
        return 1;
    for (size_t i = 0; i < rows.count && rows.x[i] < 75 * PI / 180; i++)
        worst = fmax(worst, fabs(rows.value[i] / ggx(rows.x[i], alpha) - 1));
    printf("D off by %.4f\n%s\n", worst, file->notes);
    profile_free(&rows);
    return worst;
}

static void test_ggx(double alpha)
{
    static const double f0[3] = {0.9, 0.6, 0.3};
    data_file file;
    make(alpha, f0);
    TEST(read_back(&file, alpha, MERL_LUMINANCE) < 0.01);
    TEST(case_number(&file, "diffuse ") == 0);
    TEST_RELATIVE(case_number(&file, "\nf0 "), 0.2126 * 0.9 + 0.7152 * 0.6 + 0.0722 * 0.3, 0.01);
    TEST_NEAR(case_number(&file, "\nf90 "), 1, 0.05);
    TEST(case_number(&file, "residual_reflectance ") < 0.005);
    TEST_RELATIVE(case_number(&file, "\nf0_red "), 0.9, 0.01);
    TEST_RELATIVE(case_number(&file, "\nf0_green "), 0.6, 0.01);
    TEST_RELATIVE(case_number(&file, "\nf0_blue "), 0.3, 0.01);
}

/* An albedo of 0.25 under it, in red alone. */
static void test_diffuse(void)
{
    data_file file;
    for (size_t i = 0; i < PLANE; i++)
        put(0, i, little_number(bytes + 12 + 8 * i, 8) + 0.25 / PI / unit_of[0]);
    TEST(read_back(&file, 0.3, MERL_RED) < 0.03);
    TEST_NEAR(case_number(&file, "diffuse "), 0.25, 0.005);
    TEST_RELATIVE(case_number(&file, "\nf0 "), 0.9, 0.02);
    TEST(case_number(&file, "residual_reflectance ") < 0.01);
    TEST(read_back(&file, 0.3, MERL_BLUE) < 0.01 && case_number(&file, "diffuse ") == 0);
}

/* What measurements could not see is negative. */
static void test_missing(void)
{
    data_file file;
    for (size_t i = 85 * 90 * 180; i < PLANE; i++)
        put(2, i, -1);
    put(2, 0, NAN);
    put(2, 5, INFINITY);
    TEST(read_back(&file, 0.3, MERL_BLUE) < 0.02);
    TEST(case_number(&file, "angles_without_light ") == 5);
}

static void refused(size_t size, const char *reason)
{
    profile rows;
    data_file file = case_file(bytes, size);
    int good = merl_read(&file, MERL_RED, &rows);
    TEST(rows.x == NULL);
    case_refused(good, &file, reason);
}

static void test_refusals(void)
{
    refused(11, "it begins with 0 0 0 in the place of 90 90 180");
    refused(12, "a MERL file of 90 x 90 x 180 has 34992012 bytes, and there are 12");
    refused(SIZE - 1, "and there are 34992011");
    for (int light = 0; light >= -1; light--) {
        for (size_t i = 0; i < PLANE; i++)
            put(0, i, light);
        refused(SIZE, light ? "no direction within 80 degrees has a value" : "no light comes back");
    }
    bytes[0] = 91;
    refused(SIZE, "it begins with 91 90 180");
    bytes[0] = 90;
    bytes[8] = 0x68, bytes[9] = 1;
    refused(SIZE, "a MERL file of 90 x 90 x 360 has 69984012 bytes");
}

int main(void)
{
    bytes = malloc(SIZE);
    if (!test_quick())
        test_ggx(0.1);
    test_ggx(0.3);
    test_diffuse();
    test_missing();
    test_refusals();
    free(bytes);
    return test_done();
}
