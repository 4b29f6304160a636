/* D goes out to a .bsdf and comes in again, with the F0 and the area that it went out with; noise in it is found and
 * smoothed; an anisotropic D is refused with the measure, or fitted with its matrix; a file that is not whole is
 * refused with the field. Noticed: a fit to points in the place of the light, a warp that is turned, noise. */
#include "measured/measured_case.h"

#include "measured/grid.h"
#include "measured/model.h"
#include "measured/brdf.h"
#include "measured/tensor.h"

enum { ROOM = 1 << 23 };

static data_file read_all(FILE *written)
{
    static unsigned char room[ROOM];
    rewind(written);
    size_t size = fread(room, 1, ROOM, written);
    fclose(written);
    return case_file(room, size);
}

static data_file file_of(const tensor *fields, size_t count)
{
    FILE *written = tmpfile();
    TEST(written && tensor_write(written, fields, count));
    return read_all(written);
}

/* ---- round trip ---------------------------------------------------------------------------------- */

static void test_round_trip(const vndf_distribution *distribution, float alpha)
{
    const rgl_form form = {alpha, 3, {0.25, 0.5, 0.75}, 0, {0}, "made by the test"};
    const vndf_surface surface = {distribution, alpha, alpha};
    profile rows;
    double off = 0;
    FILE *written = tmpfile();
    TEST(written && rgl_write(written, distribution, &form));
    data_file file = read_all(written);
    TEST(file.size > 1000000 && file.size < ROOM);
    if (!case_read(rgl_read(&file, &rows), &file))
        return;
    for (size_t i = 0; i < rows.count && rows.x[i] < 1.553; i++)
        off = fmax(off, fabs(rows.value[i] / model_ndf(&surface, rows.x[i]) - 1));
    printf("alpha %g: %zu bytes, D off by %.2g; %s", (double)alpha, file.size, off, file.notes);
    TEST(off < 1e-5);
    TEST(case_number(&file, "residual_isotropy ") == 0);
    TEST(case_number(&file, "noise ") < 1e-5);
    TEST(case_number(&file, "residual_sigma ") < 1e-3);
    TEST_NEAR(case_number(&file, "\nf0 "), 0.5, 1e-3);
    /* The file is fitted to the light, not to single points, and little light tells F90. */
    TEST_NEAR(case_number(&file, "\nf90 "), 1, 0.1);
    TEST(case_number(&file, "residual_reflectance ") < 5e-3);
    profile_free(&rows);
    case_free(&file);
}

/* D R/(4 A) is D G2/(4 cos_i) by the library's own masking; R has a limit at grazing incidence. */
static void test_model(const vndf_distribution *table)
{
    const vndf_surface surface = {table, 0.4f, 0.4f};
    for (double i = 0.1; i < 1.5; i += 0.3)
        for (double o = 0.05; o < 1.5; o += 0.3) {
            vndf_vec3 wi = {(float)sin(i), 0, (float)cos(i)}, wo = {0, (float)sin(o), (float)cos(o)};
            double area_i = model_area(&surface, i),
                   left = model_masked(area_i, cos(i), model_area(&surface, o), cos(o));
            double g2 = (double)vndf_g2(&surface, wi, wo, VNDF_G2_HEIGHT_CORRELATED);
            TEST_RELATIVE(left / area_i, g2 / cos(i), 1e-4);
        }
    TEST(model_masked(0.3, 0, 0.9, 0.5) == 1 && model_masked(0.3, 0.1, 0.9, -0.1) == 0);
}

/* 5% of noise at each of 2049 angles of GGX: found as that, and a third of it left. */
static void test_noise(void)
{
    enum { ANGLES = 2049 };
    static float ndf[2][ANGLES];
    const tensor field = {"ndf", TENSOR_F32, 2, {2, ANGLES}, ndf};
    const vndf_surface surface = {vndf_ggx(), 0.3f, 0.3f};
    unsigned long long state = 3;
    double square = 0;
    profile rows;
    for (int j = 0; j < ANGLES; j++) {
        double u = (double)j / (ANGLES - 1);
        ndf[0][j] = ndf[1][j] = (float)(model_ndf(&surface, PI / 2 * u * u) * exp(0.05 * case_normal(&state)));
    }
    data_file file = file_of(&field, 1);
    if (!case_read(rgl_read(&file, &rows), &file))
        return;
    for (size_t i = 0; i < ANGLES - 1; i++)
        square += pow(log(rows.value[i] / model_ndf(&surface, rows.x[i])), 2) / ANGLES;
    printf("noise of 5%%: %s%.4f is left\n", file.notes, sqrt(square));
    TEST_NEAR(case_number(&file, "noise "), 0.05, 0.006);
    TEST(sqrt(square) < 0.017);
    profile_free(&rows);
    case_free(&file);
}

/* ---- grids --------------------------------------------------------------------------------------- */

/* Mass before a place, by the midpoint rule, is the number that leads there. */
static void test_warp(void)
{
    enum { W = 5, H = 4, FINE = 400 };
    const double density[H * W] = {0, 1, 2, 0, 0, 0, 3, 1, 4, 0, 0, 0, 0, 2, 1, 5, 1, 0, 0, 2};
    warp to;
    double x, y, last = -1;
    if (!TEST(warp_make(&to, density, W, H)))
        return;
    for (int i = 0; i < 40; i++) {
        double s = (i + 0.5) / 40, below = 0, whole = 0;
        warp_sample(&to, 0.3, s, &x, &y);
        TEST(y > last && y >= 0 && y <= 1 && x >= 0 && x <= 1);
        last = y;
        for (int row = 0; row < FINE * (H - 1); row++) {
            double v = (row + 0.5) / FINE, sum = 0;
            for (int column = 0; column < W; column++)
                sum += (column == 0 || column == W - 1 ? 0.5 : 1) *
                       ((1 - (v - (int)v)) * density[(int)v * W + column] +
                        (v - (int)v) * density[((int)v + 1) * W + column]);
            whole += sum;
            below += v / (H - 1) < y ? sum : 0;
        }
        TEST_NEAR(below / whole, s, 2e-3);
    }
    warp_sample(&to, 0, 0, &x, &y);
    TEST(x >= 0 && y == 0);
    warp_sample(&to, 1, 1, &x, &y);
    TEST(x <= 1 && y == 1);
    warp_free(&to);
    const double nothing[4] = {0, 0, 0, 0};
    TEST(!warp_make(&to, nothing, 2, 2));
}

/* ---- refusals ------------------------------------------------------------------------------------ */

static void refused(data_file file, const char *reason)
{
    profile rows;
    int good = rgl_read(&file, &rows);
    TEST(rows.x == NULL);
    case_refused(good, &file, reason);
}

/* D of nine azimuths and 16 angles, which rises by `uneven` from one azimuth to the other. */
static data_file uneven_file(double uneven)
{
    static float ndf[9][16];
    const tensor field = {"ndf", TENSOR_F32, 2, {9, 16}, ndf};
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 16; j++)
            ndf[i][j] = (float)(exp(-0.2 * j) * (1 + uneven * cos(i * PI / 2)));
    return file_of(&field, 1);
}

static void test_refusals(void)
{
    static const float zeros[64] = {0}, bad[16] = {1, 1, -1}, few[4] = {1, 1, 1, 1};
    const tensor flat = {"ndf", TENSOR_F32, 1, {16}, zeros}, other = {"sigma", TENSOR_F32, 2, {2, 8}, zeros},
                 negative = {"ndf", TENSOR_F32, 2, {2, 8}, bad}, narrow = {"ndf", TENSOR_F32, 2, {2, 2}, few};
    refused(case_file("", 0), "this is no tensor file");
    refused(case_file("tensor_fool", 11), "this is no tensor file");
    refused(case_file("tensor_file\0\1\0\0\1", 16), "ends too early: it has 16 bytes, and its head takes 18");
    refused(case_file("tensor_file\0\2\0\0\0\0\0", 18), "a tensor file of version 2.0; 1.0 is read");
    refused(case_file("tensor_file\0\1\0\0\0\0\0", 18), "it has no field 'ndf'");
    refused(case_file("tensor_file\0\1\0\0\1\0\0", 18), "the list of fields is cut off at field 1 of 256");
    refused(case_file("tensor_file\0\1\0\1\0\0\0\3", 19), "the list of fields is cut off at field 1 of 1");
    refused(file_of(&flat, 1), "field 'ndf' has the type 10 and 1 dimensions; the type 10 and 2 are needed");
    refused(file_of(&other, 1), "it has no field 'ndf'");
    refused(file_of(&negative, 1), "number 2 of field 'ndf' is -1; it must be finite and not negative");
    refused(file_of(&narrow, 1), "field 'ndf' is 2 x 2; it needs from 8");
    data_file whole = uneven_file(0.1);
    for (size_t cut = 0; cut < whole.size; cut++)
        refused(case_file(whole.bytes, cut), "");
    refused(case_file(whole.bytes, whole.size - 1), "the numbers of field 'ndf' do not end before the file");
    case_free(&whole);
}

/* ---- anisotropy ---------------------------------------------------------------------------------- */

/* cos(phi) over a whole turn: the mean of |uneven cos| at nine azimuths is uneven/2. */
static void test_anisotropy(void)
{
    profile rows;
    data_file file = uneven_file(0.1);
    TEST(rgl_read(&file, &rows));
    TEST_NEAR(case_number(&file, "residual_isotropy "), 0.1 / 4, 1e-4);
    profile_free(&rows);
    case_free(&file);
    refused(uneven_file(0.3), "D is anisotropic: 0.075 of all normals would have to turn about z");
}

/* GGX of roughness 0.6 along 30 degrees and 0.2 across is GGX of 0.3464 under a matrix with the axes sqrt 3. */
static void test_matrix(void)
{
    enum { AZIMUTHS = 129, ANGLES = 257 };
    static float ndf[AZIMUTHS][ANGLES];
    const tensor field = {"ndf", TENSOR_F32, 2, {AZIMUTHS, ANGLES}, ndf};
    const double c30 = sqrt(0.75), s30 = 0.5;
    for (int i = 0; i < AZIMUTHS; i++)
        for (int j = 0; j < ANGLES; j++) {
            double theta = PI / 2 * j * j / 65536, phi = 2 * PI * i / 128 - PI, s = sin(theta), c = cos(theta);
            double x = s * cos(phi), y = s * sin(phi), along = (c30 * x + s30 * y) / 0.6,
                   across = (c30 * y - s30 * x) / 0.2;
            double q = along * along + across * across + c * c;
            ndf[i][j] = (float)(1 / (PI * 0.12 * q * q));
        }
    data_file file = file_of(&field, 1);
    refused(case_file(file.bytes, file.size), "--matrix fits the matrix of an isotropic one");
    profile rows;
    if (!case_read(rgl_read_matrix(&file, &rows), &file))
        return;
    double xx = 0, xy = 0, yx = 0, yy = 0, alpha = sqrt(0.12), off = 0;
    const char *matrix = strstr(file.notes, "matrix ");
    TEST(matrix && sscanf(matrix, "matrix %lf,%lf,%lf,%lf", &xx, &xy, &yx, &yy) == 4);
    const double long_axis = sqrt(3), short_axis = 1 / sqrt(3); /* R diag R^T, R by 30 degrees */
    TEST_NEAR(xx, 0.75 * long_axis + 0.25 * short_axis, 0.01);
    TEST_NEAR(yy, 0.25 * long_axis + 0.75 * short_axis, 0.01);
    TEST_NEAR(xy, c30 * s30 * (long_axis - short_axis), 0.01);
    TEST(xy == yx);
    for (size_t i = 0; i < rows.count && rows.x[i] < 10 * alpha; i++) {
        double q = 1 + rows.x[i] * rows.x[i] / (alpha * alpha);
        off = fmax(off, fabs(rows.value[i] * PI * alpha * alpha * q * q - 1));
    }
    printf("anisotropic GGX: P22 under the matrix off by %.4f\n%s", off, file.notes);
    TEST(off < 0.05);
    TEST(case_number(&file, "residual_isotropy ") < 0.01);
    profile_free(&rows);
    case_free(&file);
}

int main(void)
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    test_warp();
    test_model(table);
    test_round_trip(vndf_ggx(), 0.5f);
    if (!test_quick())
        test_round_trip(table, 0.1f);
    test_noise();
    test_refusals();
    test_anisotropy();
    test_matrix();
    vndf_free(table);
    return test_done();
}
