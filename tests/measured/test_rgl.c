/* D goes out to a .bsdf and comes in again (the light that it reflects, as a host reads it: python_measured); an
 * anisotropic D is refused with the measure; a file that is not whole is refused with the field. Noticed: an axis of
 * angles in another measure, azimuths that are counted twice, a field that is not looked for. */
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

static void test_round_trip(const vndf_distribution *distribution, float alpha)
{
    const rgl_form form = {alpha, 3, {0.25, 0.5, 0.75}, 0, {0}, "made by the test"};
    const vndf_surface surface = vndf_rough(distribution, alpha, alpha);
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
