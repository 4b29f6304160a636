/* D goes out to a .bsdf and comes in again as the same table, with the F0 and the area that it went out with; a file
 * that is not whole, or whose D depends on the azimuth, is refused with the field or the measure. */
#include "harness/test.h"
#include "measured/model.h"
#include "measured/rgl/fit_grid.h"
#include "measured/rgl/rgl.h"
#include "measured/rgl/tensor.h"
#include "measured/rgl/warp.h"

enum { ROOM = 1 << 23 };

static unsigned char *file_bytes;

static size_t write_file(const vndf_distribution *distribution, const rgl_form *form)
{
    FILE *file = tmpfile();
    TEST(file && rgl_write(file, distribution, form));
    rewind(file);
    size_t size = fread(file_bytes, 1, ROOM, file);
    fclose(file);
    TEST(size > 1000000 && size < ROOM);
    return size;
}

/* ---- round trip ---------------------------------------------------------------------------------- */

/* The largest difference of D, relative, up to 89 degrees. */
static double worst_ndf(const profile *rows, const vndf_surface *surface)
{
    double worst = 0;
    for (size_t i = 0; i < rows->count && rows->x[i] < 1.553; i++)
        worst = fmax(worst, fabs(rows->value[i] / model_ndf(surface, rows->x[i]) - 1));
    return worst;
}

static double number_after(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

static void test_round_trip(const vndf_distribution *distribution, const char *what, float alpha)
{
    const rgl_form form = {alpha, 3, {0.25, 0.5, 0.75}, 0, {0}, "made by the test"};
    const vndf_surface before = {distribution, alpha, alpha};
    profile rows;
    refusal why = {""};
    notes said = {"", 0};
    size_t size = write_file(distribution, &form);
    if (!TEST(rgl_read(&rows, "made", file_bytes, size, &said, &why)))
        return;
    vndf_distribution *table = profile_table(&rows, "made", &why);
    const vndf_surface after = {table, 1, 1};
    rgl_residuals(&after, "made", file_bytes, size, &said);
    double off = worst_ndf(&rows, &before);
    printf("%s, alpha %g: %zu bytes, D off by %.2g; %s", what, (double)alpha, size, off, said.text);
    TEST(off < 1e-5);
    for (double theta = 0; theta < 1.57; theta += 0.1) {
        vndf_vec3 w = {(float)sin(theta), 0, (float)cos(theta)};
        TEST_RELATIVE((double)vndf_projected_area(&after, w), (double)vndf_projected_area(&before, w), 3e-4);
    }
    TEST(number_after(said.text, "residual_isotropy ") == 0);
    TEST(number_after(said.text, "residual_sigma ") < 1e-3);
    TEST_NEAR(number_after(said.text, "\nf0 "), 0.5, 1e-3);
    /* The file is fitted to the light, not to single points, and little light tells F90. */
    TEST_NEAR(number_after(said.text, "\nf90 "), 1, 0.1);
    TEST(number_after(said.text, "residual_reflectance ") < 5e-3);
    vndf_free(table);
    profile_free(&rows);
}

/* ---- the model ----------------------------------------------------------------------------------- */

/* D R/(4 A) is D G2/(4 cos_i) by the library's own masking; R has a limit at grazing incidence. */
static void test_model(const vndf_distribution *table)
{
    const vndf_surface surface = {table, 0.4f, 0.4f};
    for (double theta_i = 0.1; theta_i < 1.5; theta_i += 0.3)
        for (double theta_o = 0.05; theta_o < 1.5; theta_o += 0.3) {
            direction wi = direction_at(theta_i, 0.3), wo = direction_at(theta_o, 2),
                      m = direction_between(wi, wo);
            vndf_vec3 i = {(float)wi.x, (float)wi.y, (float)wi.z}, o = {(float)wo.x, (float)wo.y, (float)wo.z};
            vndf_vec3 h = {(float)m.x, (float)m.y, (float)m.z};
            double want = (double)vndf_ndf(&surface, h) *
                          (double)vndf_g2(&surface, i, o, VNDF_G2_HEIGHT_CORRELATED) / (4 * wi.z);
            TEST_RELATIVE(model_reflected(&surface, wi, wo), want, 1e-4);
        }
    TEST(model_masked(0.3, 0, 0.9, 0.5) == 1);
    TEST(model_masked(0.3, 0.1, 0.9, -0.1) == 0);
}

/* ---- the warp ------------------------------------------------------------------------------------ */

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

/* ---- the grid ------------------------------------------------------------------------------------ */

/* What is bilinear comes back, also where a corner is not seen; what ends in a cell goes on beyond it. */
static void test_fit(void)
{
    enum { SIDE = 6, POINTS = 4, FINE = (SIDE - 1) * POINTS };
    float value[FINE][FINE], weight[FINE][FINE];
    double grid[SIDE][SIDE];
    for (int y = 0; y < FINE; y++)
        for (int x = 0; x < FINE; x++) {
            double v = (y + 0.5) / POINTS, u = (x + 0.5) / POINTS;
            weight[y][x] = u + v < 7.5;
            value[y][x] = weight[y][x] > 0 ? (float)(2 + 0.5 * u - 0.25 * v + 0.1 * u * v) : 0;
        }
    fit_grid(&value[0][0], &weight[0][0], SIDE, POINTS, &grid[0][0]);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            double want = 2 + 0.5 * x - 0.25 * y + 0.1 * x * y;
            TEST_NEAR(grid[y][x], want, x + y < 8 ? 0.01 : x + y < 9 ? 0.1 : 1.5);
        }
}

/* ---- refusals ------------------------------------------------------------------------------------ */

static void refused(const unsigned char *bytes, size_t size, const char *message)
{
    profile rows;
    refusal why = {""};
    notes said = {"", 0};
    unsigned char *exact = malloc(size ? size : 1);
    memcpy(exact, bytes, size);
    if (!(TEST(!rgl_read(&rows, "bad.bsdf", exact, size, &said, &why)) & TEST(rows.x == NULL) &
          TEST(strncmp(why.message, "bad.bsdf: ", 10) == 0) & TEST_HAS(why.message, message)))
        fprintf(stderr, "  %s\n", why.message);
    free(exact);
}

static size_t small_file(const tensor_written *fields, size_t count)
{
    FILE *file = tmpfile();
    TEST(file && tensor_write(file, fields, count));
    rewind(file);
    size_t size = fread(file_bytes, 1, ROOM, file);
    fclose(file);
    return size;
}

/* D of `rows` azimuths and 16 angles, which rises by `uneven` from one azimuth to the other. */
static size_t uneven_file(double uneven)
{
    static float ndf[9][16];
    const tensor_written field = {"ndf", TENSOR_F32, 2, {9, 16}, ndf};
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 16; j++)
            ndf[i][j] = (float)(exp(-0.2 * j) * (1 + uneven * cos(i * 3.14159265358979 / 2)));
    return small_file(&field, 1);
}

static void test_refusals(void)
{
    static const float zeros[64] = {0}, bad[16] = {1, 1, -1}, few[4] = {1, 1, 1, 1};
    const tensor_written flat = {"ndf", TENSOR_F32, 1, {16}, zeros},
                         other = {"sigma", TENSOR_F32, 2, {2, 8}, zeros},
                         negative = {"ndf", TENSOR_F32, 2, {2, 8}, bad},
                         narrow = {"ndf", TENSOR_F32, 2, {2, 2}, few};
    refused((const unsigned char *)"", 0, "this is no tensor file");
    refused((const unsigned char *)"tensor_fool", 11, "this is no tensor file");
    refused((const unsigned char *)"tensor_file\0\1\0\1", 16,
            "ends too early: it has 16 bytes, and its head takes 18");
    refused((const unsigned char *)"tensor_file\0\2\0\0\0\0\0", 18, "a tensor file of version 2.0; 1.0 is read");
    refused((const unsigned char *)"tensor_file\0\1\0\0\0\0\0", 18, "it has no field 'ndf'");
    refused((const unsigned char *)"tensor_file\0\1\0\0\1\0\0", 18, "256 fields; 32 are the most");
    refused((const unsigned char *)"tensor_file\0\1\0\1\0\0\0\3", 19,
            "the list of fields is cut off at field 1 of 1");
    refused(file_bytes, small_file(&flat, 1), "field 'ndf' has the type 10 and 1 dimensions; floats (10) and 2");
    refused(file_bytes, small_file(&other, 1), "it has no field 'ndf'");
    refused(file_bytes, small_file(&negative, 1),
            "number 2 of field 'ndf' is -1; it must be finite and not negative");
    refused(file_bytes, small_file(&narrow, 1), "field 'ndf' is 2 x 2; it needs from 8");
    size_t size = uneven_file(0.1);
    for (size_t cut = 0; cut < size; cut++)
        refused(file_bytes, cut, "");
    refused(file_bytes, size - 1, "the numbers of field 'ndf' do not end before the file: it is cut off");
}

/* cos(phi) over a whole turn: the mean of |uneven cos| over two is uneven/pi. */
static void test_anisotropy(void)
{
    profile rows;
    refusal why = {""};
    notes said = {"", 0};
    size_t size = uneven_file(0.1);
    TEST(rgl_read(&rows, "uneven", file_bytes, size, &said, &why));
    TEST_NEAR(number_after(said.text, "residual_isotropy "), 0.1 / 4, 1e-4); /* at nine azimuths */
    profile_free(&rows);
    size = uneven_file(0.3);
    refused(file_bytes, size, "D is anisotropic: 0.075 of all normals would have to turn about z");
}

/* GGX of roughness 0.6 along 30 degrees and 0.2 across is GGX of 0.3464 under a matrix with the axes sqrt 3. */
static void test_matrix(void)
{
    enum { AZIMUTHS = 129, ANGLES = 257 };
    static float ndf[AZIMUTHS][ANGLES];
    const tensor_written field = {"ndf", TENSOR_F32, 2, {AZIMUTHS, ANGLES}, ndf};
    const double pi = 3.14159265358979, c30 = sqrt(0.75), s30 = 0.5;
    for (int i = 0; i < AZIMUTHS; i++)
        for (int j = 0; j < ANGLES; j++) {
            double theta = pi / 2 * j * j / 65536, phi = 2 * pi * i / 128 - pi, s = sin(theta), c = cos(theta);
            double x = s * cos(phi), y = s * sin(phi), along = (c30 * x + s30 * y) / 0.6,
                   across = (c30 * y - s30 * x) / 0.2;
            double q = along * along + across * across + c * c;
            ndf[i][j] = (float)(1 / (pi * 0.12 * q * q));
        }
    size_t size = small_file(&field, 1);
    refused(file_bytes, size, "--matrix fits the matrix of an isotropic one");
    profile rows;
    refusal why = {""};
    notes said = {"", 0};
    if (!TEST(rgl_fit(&rows, "turned", file_bytes, size, &said, &why)))
        return;
    double xx = 0, xy = 0, yx = 0, yy = 0, alpha = sqrt(0.12), off = 0;
    const char *matrix = strstr(said.text, "matrix ");
    TEST(matrix && sscanf(matrix, "matrix %lf,%lf,%lf,%lf", &xx, &xy, &yx, &yy) == 4);
    const double long_axis = sqrt(3), short_axis = 1 / sqrt(3); /* R diag R^T, R by 30 degrees */
    TEST_NEAR(xx, 0.75 * long_axis + 0.25 * short_axis, 0.01);
    TEST_NEAR(yy, 0.25 * long_axis + 0.75 * short_axis, 0.01);
    TEST_NEAR(xy, c30 * s30 * (long_axis - short_axis), 0.01);
    TEST(xy == yx);
    for (size_t i = 0; i < rows.count && rows.x[i] < 10 * alpha; i++) {
        double q = 1 + rows.x[i] * rows.x[i] / (alpha * alpha);
        off = fmax(off, fabs(rows.value[i] * pi * alpha * alpha * q * q - 1));
    }
    printf("anisotropic GGX: P22 under the matrix off by %.4f\n%s", off, said.text);
    TEST(off < 0.05);
    TEST(number_after(said.text, "residual_isotropy ") < 0.01);
    profile_free(&rows);
}

int main(void)
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    file_bytes = malloc(ROOM);
    test_warp();
    test_model(table);
    test_fit();
    test_round_trip(vndf_ggx(), "GGX", 0.5f);
    if (!test_quick())
        test_round_trip(table, "Student-T", 0.1f);
    test_refusals();
    test_anisotropy();
    test_matrix();
    vndf_free(table);
    free(file_bytes);
    return test_done();
}
