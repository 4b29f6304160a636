/* D goes out to a .bsdf and comes in again; the light that goes with it is what the library reflects, in each colour;
 * noise in D is found and smoothed; an anisotropic D is refused with the measure; a file that is not whole is refused
 * with the field. Noticed: a fit to points in the place of the light, a warp that is turned, masking, noise. */
#include "measured/measured_case.h"

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

static double ndf_at(const vndf_surface *surface, double theta)
{
    return (double)vndf_ndf(surface, (vndf_vec3){(float)sin(theta), 0, (float)cos(theta)});
}

/* rgb over the unit square, from where directions are drawn evenly by visible normals, has the mean of F G2/G1. */
static void test_light(data_file *file, const vndf_surface *surface, const double f0[3])
{
    enum { SIDE = 100 };
    tensor theta, rgb;
    if (!case_read(tensor_find(file, "theta_i", 1, &theta) && tensor_find(file, "rgb", 5, &rgb), file))
        return;
    const size_t *n = rgb.shape;
    TEST(n[0] == 1 && n[1] == theta.shape[0] && n[2] == 3 && tensor_at(&theta, n[1] - 1) > 1.57);
    for (size_t i = 0; i + 1 < n[1]; i += 9) {
        const double angle = tensor_at(&theta, i);
        const vndf_vec3 wi = {(float)sin(angle), 0, (float)cos(angle)};
        const vndf_view view = vndf_view_from(surface, wi);
        double low = 0, high = 0;
        for (int k = 0; k < SIDE * SIDE; k++) {
            float pdf, u = ((float)(k % SIDE) + 0.5f) / SIDE, v = ((float)(k / SIDE) + 0.5f) / SIDE;
            const vndf_vec3 m = vndf_sample(&view, u, v, &pdf);
            const float cosine = wi.x * m.x + wi.y * m.y + wi.z * m.z;
            const vndf_vec3 wo = {2 * cosine * m.x - wi.x, 2 * cosine * m.y - wi.y, 2 * cosine * m.z - wi.z};
            const double left =
                (double)(vndf_g2(surface, wi, wo, VNDF_G2_HEIGHT_CORRELATED) / vndf_g1(surface, wi)) /
                (SIDE * SIDE);
            high += wo.z > 0 ? left * pow(1 - (double)cosine, 5) : 0;
            low += wo.z > 0 ? left * (1 - pow(1 - (double)cosine, 5)) : 0;
        }
        for (size_t channel = 0; channel < 3; channel++) {
            double sum = 0;
            for (size_t k = 0; k < n[3] * n[4]; k++) {
                const int x_end = k % n[4] == 0 || k % n[4] == n[4] - 1,
                          y_end = k < n[4] || k >= (n[3] - 1) * n[4];
                sum += tensor_at(&rgb, (i * 3 + channel) * n[3] * n[4] + k) / (x_end ? 2 : 1) / (y_end ? 2 : 1);
            }
            TEST_RELATIVE(sum / (double)((n[3] - 1) * (n[4] - 1)), f0[channel] * low + high, 6e-3);
        }
    }
}

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
        off = fmax(off, fabs(rows.value[i] / ndf_at(&surface, rows.x[i]) - 1));
    printf("alpha %g: %zu bytes, D off by %.2g; %s", (double)alpha, file.size, off, file.notes);
    TEST(off < 1e-5);
    TEST(case_number(&file, "residual_isotropy ") == 0);
    TEST(case_number(&file, "noise ") < 1e-5);
    test_light(&file, &surface, form.f0);
    profile_free(&rows);
    case_free(&file);
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
        ndf[0][j] = ndf[1][j] = (float)(ndf_at(&surface, PI / 2 * u * u) * exp(0.05 * case_normal(&state)));
    }
    data_file file = file_of(&field, 1);
    if (!case_read(rgl_read(&file, &rows), &file))
        return;
    for (size_t i = 0; i < ANGLES - 1; i++)
        square += pow(log(rows.value[i] / ndf_at(&surface, rows.x[i])), 2) / ANGLES;
    printf("noise of 5%%: %s%.4f is left\n", file.notes, sqrt(square));
    TEST_NEAR(case_number(&file, "noise "), 0.05, 0.006);
    TEST(sqrt(square) < 0.017);
    profile_free(&rows);
    case_free(&file);
}

/* ---- grids --------------------------------------------------------------------------------------- */

/* Bilinear between points of a grid of this width, at the middle of part (column, row) of cells cut into parts^2. */
static double bilinear(const double *grid, int width, int parts, int column, int row)
{
    const double *at = grid + row / parts * width + column / parts;
    double u = (column % parts + 0.5) / parts, v = (row % parts + 0.5) / parts;
    return (1 - v) * ((1 - u) * at[0] + u * at[1]) + v * ((1 - u) * at[width] + u * at[width + 1]);
}

/* Of even numbers each quarter of a cell gets its part of the mass, and the border stays the border. */
static void test_warp(void)
{
    enum { W = 5, H = 4, ACROSS = 2 * (W - 1), BOXES = ACROSS * 2 * (H - 1), FINE = 800 };
    static const double density[W * H] = {0, 1, 2, 0, 0, 0, 3, 1, 4, 0, 0, 0, 0, 2, 1, 5, 1, 0, 0, 2}, nothing[4];
    double x, y, count[BOXES] = {0}, whole = 0;
    warp to;
    TEST(!warp_make(&to, nothing, 2, 2) && warp_make(&to, density, W, H));
    for (int i = 0; i < FINE * FINE; i++) {
        warp_sample(&to, (i % FINE + 0.5) / FINE, ((double)(i / FINE) + 0.5) / FINE, &x, &y);
        count[(int)(y * 2 * (H - 1)) * ACROSS + (int)(x * ACROSS)] += 1.0 / (FINE * FINE);
    }
    for (int i = 0; i < BOXES; i++)
        whole += bilinear(density, W, 2, i % ACROSS, i / ACROSS);
    for (int i = 0; i < BOXES; i++)
        TEST_NEAR(count[i], bilinear(density, W, 2, i % ACROSS, i / ACROSS) / whole, 2e-4);
    warp_sample(&to, 0, 0, &x, &y);
    TEST(x >= 0 && y == 0);
    warp_sample(&to, 1, 1, &x, &y);
    TEST(x <= 1 && y == 1);
    warp_free(&to);
}

/* A function that ends within cells, at x + y = 1.3: what interpolates the grid has its light and, nearly, its
 * values. */
static void test_fit(void)
{
    enum { SIDE = 9, POINTS = 4, FINE = (SIDE - 1) * POINTS };
    static float value[FINE * FINE], is_known[FINE * FINE];
    double grid[SIDE * SIDE], light = 0, found = 0, worst = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        double x = (i % FINE + 0.5) / FINE, y = ((double)(i / FINE) + 0.5) / FINE;
        is_known[i] = x + y < 1.3;
        value[i] = x + y < 1.3 ? (float)(1 + x - y * y) : 0;
    }
    grid_fit(value, is_known, SIDE, POINTS, 8, grid);
    for (int i = 0; i < FINE * FINE; i++) {
        double here = bilinear(grid, SIDE, POINTS, i % FINE, i / FINE);
        light += (double)value[i];
        found += is_known[i] > 0 ? here : 0;
        worst = fmax(worst, is_known[i] > 0 ? fabs(here - (double)value[i]) : 0);
    }
    TEST_RELATIVE(found, light, 1e-6);
    TEST(worst < 0.02);
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

/* A file with one field. */
static data_file one_field(const char *name, int dimensions, size_t columns, const float *numbers)
{
    const tensor field = {name, TENSOR_F32, dimensions, {dimensions > 1 ? 2 : columns, columns}, numbers};
    return file_of(&field, 1);
}

static void test_refusals(void)
{
    static const float zeros[64] = {0}, bad[16] = {1, 1, -1};
    static const struct {
        const char *bytes;
        size_t size;
        const char *reason;
    } heads[] = {
        {"", 0, "this is no tensor file"},
        {"tensor_fool", 11, "this is no tensor file"},
        {"tensor_file\0\1\0\0\1", 16, "ends too early: it has 16 bytes, and its head takes 18"},
        {"tensor_file\0\2\0\0\0\0\0", 18, "a tensor file of version 2.0; 1.0 is read"},
        {"tensor_file\0\1\0\0\0\0\0", 18, "it has no field 'ndf'"},
        {"tensor_file\0\1\0\0\1\0\0", 18, "the list of fields is cut off at field 1 of 256"},
        {"tensor_file\0\1\0\1\0\0\0\3", 19, "the list of fields is cut off at field 1 of 1"},
    };
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        refused(case_file(heads[i].bytes, heads[i].size), heads[i].reason);
    refused(one_field("ndf", 1, 16, zeros),
            "field 'ndf' has the type 10 and 1 dimensions; the type 10 and 2 are needed");
    refused(one_field("sigma", 2, 8, zeros), "it has no field 'ndf'");
    refused(one_field("ndf", 2, 8, bad), "number 2 of field 'ndf' is -1; it must be finite and not negative");
    refused(one_field("ndf", 2, 2, zeros), "field 'ndf' is 2 x 2; it needs from 8");
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

int main(void)
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    test_warp();
    test_fit();
    test_round_trip(vndf_ggx(), 0.5f);
    if (!test_quick())
        test_round_trip(table, 0.1f);
    test_noise();
    test_refusals();
    test_anisotropy();
    vndf_free(table);
    return test_done();
}
