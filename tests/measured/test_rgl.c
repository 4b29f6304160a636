/* D goes out to a .bsdf and comes in again; a host that looks the file up as Mitsuba and pbrt do finds the light that
 * the library reflects, in each colour, and draws it with nearly equal weights; an anisotropic D is refused with the
 * measure; a file that is not whole is refused with the field. Noticed: masking,
 * Fresnel's term, a colour in another's place, a warp or a luminance of other normals. */
#include "measured_case.h"

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

/* Layer i of a field over the unit square, bilinear. */
static double look_up(const tensor *of, size_t i, double x, double y)
{
    const size_t width = of->shape[of->dimensions - 1], height = of->shape[of->dimensions - 2];
    const double column = x * (double)(width - 1), row = y * (double)(height - 1);
    const size_t left = (size_t)fmin(column, (double)width - 2), low = (size_t)fmin(row, (double)height - 2);
    const double u = column - (double)left, v = row - (double)low;
    const size_t at = (i * height + low) * width + left;
    return (1 - v) * ((1 - u) * tensor_at(of, at) + u * tensor_at(of, at + 1)) +
           v * ((1 - u) * tensor_at(of, at + width) + u * tensor_at(of, at + width + 1));
}

/* The integral of layer i up to x, over all y. */
static double mass_up_to(const tensor *of, size_t i, double x)
{
    const size_t width = of->shape[of->dimensions - 1], height = of->shape[of->dimensions - 2];
    const double places = (double)((width - 1) * (height - 1));
    double sum = 0;
    for (size_t k = 0; k < width - 1 && (double)k < x * (double)(width - 1); k++) {
        const double part = fmin(x * (double)(width - 1) - (double)k, 1);
        for (size_t row = 0; row < height; row++) {
            const double a = tensor_at(of, (i * height + row) * width + k),
                         b = tensor_at(of, (i * height + row) * width + k + 1);
            sum += part * (a + part * (b - a) / 2) / (row > 0 && row < height - 1 ? 1 : 2) / places;
        }
    }
    return sum;
}

/* For incident directions of the file and normals that are seen from there: what the host makes of the file is near
 * F D G2/(4 cos), and so is what it draws. */
static void test_light(data_file *file, const vndf_surface *surface, const double f0[3])
{
    enum { COUNT = 40 };
    tensor theta, ndf, sigma, vndf, luminance, rgb;
    if (!case_read(tensor_find(file, "theta_i", 1, &theta) && tensor_find(file, "ndf", 2, &ndf) &&
                       tensor_find(file, "sigma", 2, &sigma) && tensor_find(file, "vndf", 4, &vndf) &&
                       tensor_find(file, "luminance", 4, &luminance) && tensor_find(file, "rgb", 5, &rgb),
                   file))
        return;
    TEST(rgb.shape[1] == theta.shape[0] && rgb.shape[2] == 3 && tensor_at(&theta, rgb.shape[1] - 1) > 1.57);
    for (size_t i = 0; i + 1 < rgb.shape[1]; i += 9) {
        const double angle = tensor_at(&theta, i), whole = mass_up_to(&vndf, i, 1);
        const double drawn = mass_up_to(&luminance, i, 1);
        const vndf_vec3 wi = {(float)sin(angle), 0, (float)cos(angle)};
        const vndf_view view = vndf_view_from(surface, wi);
        double missed = 0, light = 0, square = 0, found = 0;
        for (int k = 0; k < COUNT * COUNT; k++) {
            float pdf, u1 = ((float)(k % COUNT) + 0.5f) / COUNT, u2 = ((float)(k / COUNT) + 0.5f) / COUNT;
            const vndf_vec3 m = vndf_sample(&view, u1, u2, &pdf);
            const float cosine = wi.x * m.x + wi.y * m.y + wi.z * m.z;
            const vndf_vec3 wo = {2 * cosine * m.x - wi.x, 2 * cosine * m.y - wi.y, 2 * cosine * m.z - wi.z};
            const double sine = hypot((double)m.x, (double)m.y), u = sqrt(2 / PI * atan2(sine, (double)m.z));
            const double v = 0.5 + atan2((double)m.y, (double)m.x) / (2 * PI);
            const double x = mass_up_to(&vndf, i, u) / whole, scale = 4 * (double)cosine / (double)pdf;
            const double by = look_up(&ndf, 0, u, 0) / (4 * look_up(&sigma, 0, sqrt(2 / PI * angle), 0));
            const double density = look_up(&vndf, i, u, v) / whole * look_up(&luminance, i, x, v) / drawn /
                                   (2 * PI * PI * u * sine * 4 * (double)cosine);
            double all = 0;
            if (!(wo.z > 0))
                continue;
            for (size_t channel = 0; channel < 3; channel++) {
                const double f = by * look_up(&rgb, i * 3 + channel, x, v);
                const double want = (f0[channel] + (1 - f0[channel]) * pow(1 - (double)cosine, 5)) *
                                    (double)(vndf_ndf(surface, m) *
                                             vndf_g2(surface, wi, wo, VNDF_G2_HEIGHT_CORRELATED) / (4 * wi.z));
                missed += fabs(f - want) * scale;
                light += want * scale;
                all += f;
            }
            found += all * scale;
            square += all * all * scale / density;
        }
        const double spread = square * COUNT * COUNT / (found * found) - 1;
        printf("%.4g: light off by %.4f, each by %.4f; weights by %.3f\n", angle, found / light - 1,
               missed / light, sqrt(fmax(spread, 0)));
        TEST_RELATIVE(found, light, 6e-3);
        TEST(missed < 0.01 * light && spread < 0.01);
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
    test_light(&file, &surface, form.f0);
    profile_free(&rows);
    case_free(&file);
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
        {"tensor_file\0\1\0\0\1", 16, "this is no tensor file of version 1.0"},
        {"tensor_file\0\2\0\0\0\0\0", 18, "this is no tensor file of version 1.0"},
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
    refused(case_file(whole.bytes, whole.size - 1), "the file ends before the numbers of field 'ndf' do");
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
    test_round_trip(vndf_ggx(), 0.5f);
    if (!test_quick())
        test_round_trip(table, 0.1f);
    test_refusals();
    test_anisotropy();
    vndf_free(table);
    return test_done();
}
