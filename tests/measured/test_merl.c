/* A GGX surface goes out to a MERL file and comes in again as GGX within 1%, also where a diffuse part is under it,
 * which is told apart; the power iteration finds an eigenvector; what is no MERL file is refused. */
#include "harness/constants.h"
#include "harness/test.h"

#include <stdint.h>

#include "measured/brdf/merl.h"
#include "measured/brdf/power.h"

enum { PLANE = 90 * 90 * 180, SIZE = 12 + 3 * 8 * PLANE };

static const double scale[3] = {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
static unsigned char *bytes;

static double number_after(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

static double get(size_t channel, size_t i)
{
    double value;
    memcpy(&value, bytes + 12 + 8 * (channel * PLANE + i), sizeof value); /* little-endian machines */
    return value;
}

static void put(size_t channel, size_t i, double value)
{
    memcpy(bytes + 12 + 8 * (channel * PLANE + i), &value, sizeof value);
}

static void write_file(const vndf_distribution *distribution, float alpha)
{
    static const double f0[3] = {0.9, 0.6, 0.3};
    FILE *file = tmpfile();
    TEST(file && merl_write(file, distribution, alpha, f0));
    rewind(file);
    TEST(fread(bytes, 1, SIZE, file) == SIZE && fgetc(file) == EOF);
    fclose(file);
    for (size_t i = 90, channel = 1; channel < 3; channel++) /* at normal incidence colours are as f0 */
        TEST_RELATIVE(get(channel, i) * scale[channel] / (get(0, i) * scale[0]), f0[channel] / f0[0], 1e-6);
}

static double ggx(double theta, double alpha)
{
    double c = cos(theta), t = tan(theta) / alpha, q = 1 + t * t;
    return 1 / (PI * alpha * alpha * c * c * c * c * q * q);
}

/* The largest difference of D from GGX up to 75 degrees, relative. */
static double read_file(double alpha, merl_channel channel, notes *said)
{
    profile rows;
    refusal why = {""};
    double worst = 0;
    *said = (notes){"", 0};
    if (!TEST(merl_read(&rows, "made", bytes, SIZE, channel, said, &why))) {
        fprintf(stderr, "  %s\n", why.message);
        return 1;
    }
    TEST(rows.count == 90);
    for (size_t i = 0; i < rows.count && rows.x[i] < 75 * PI / 180; i++)
        worst = fmax(worst, fabs(rows.value[i] / ggx(rows.x[i], alpha) - 1));
    profile_free(&rows);
    return worst;
}

/* ---- out and in ---------------------------------------------------------------------------------- */

static void test_round_trip(float alpha)
{
    notes said;
    write_file(vndf_ggx(), alpha);
    double off = read_file((double)alpha, MERL_LUMINANCE, &said);
    printf("GGX %g: D off by %.4f\n%s", (double)alpha, off, said.text);
    double f0 = 0.2126 * 0.9 + 0.7152 * 0.6 + 0.0722 * 0.3;
    TEST(off < 0.01);
    TEST_HAS(said.text, "bins middle\n");
    TEST(number_after(said.text, "diffuse ") == 0);
    TEST_RELATIVE(number_after(said.text, "\nf0 "), f0, 0.01);
    TEST_NEAR(number_after(said.text, "\nf90 "), 1, 0.05);
    TEST(number_after(said.text, "residual_reflectance ") < 0.005);
    TEST_RELATIVE(number_after(said.text, "\nf0_red "), 0.9, 0.01);
    TEST_RELATIVE(number_after(said.text, "\nf0_blue "), 0.3, 0.01);
}

/* An albedo of 0.25 under it, in red alone. */
static void test_diffuse(void)
{
    notes said;
    for (size_t i = 0; i < PLANE; i++)
        put(0, i, get(0, i) + 0.25 / PI / scale[0]);
    double red = read_file(0.3, MERL_RED, &said);
    printf("with a diffuse part, red: D off by %.4f\n%s", red, said.text);
    TEST(red < 0.03);
    TEST_NEAR(number_after(said.text, "diffuse "), 0.25, 0.005);
    TEST_RELATIVE(number_after(said.text, "\nf0 "), 0.9, 0.02);
    TEST(number_after(said.text, "residual_reflectance ") < 0.01);
    TEST(read_file(0.3, MERL_BLUE, &said) < 0.01 && number_after(said.text, "diffuse ") == 0);
}

/* Values at the lower ends of bins, or masked by the product of G1, as programs that fill files often have them: found
 * out, and taken as that. */
static void test_convention(double place, int is_separable)
{
    notes said;
    const double alpha = 0.5;
    for (int half = 0; half < 90; half++)
        for (int i = 0; i < 90; i++)
            for (int k = 0; k < 180; k++) {
                double theta_h = (half + place) * (half + place) * PI / 2 / 8100;
                double theta_d = (i + place) * PI / 180, phi_d = (k + place) * PI / 180;
                double s = sin(theta_h), c = cos(theta_h), x = sin(theta_d) * cos(phi_d), z = cos(theta_d);
                double cos_i = c * z - s * x, cos_o = c * z + s * x, f = 0;
                if (cos_i > 0 && cos_o > 0) {
                    double a_i = (cos_i + sqrt(cos_i * cos_i + alpha * alpha * (1 - cos_i * cos_i))) / 2;
                    double a_o = (cos_o + sqrt(cos_o * cos_o + alpha * alpha * (1 - cos_o * cos_o))) / 2;
                    f = ggx(theta_h, alpha) /
                        (4 * (is_separable ? a_i * a_o : a_i * cos_o + a_o * cos_i - cos_i * cos_o));
                }
                put(0, (size_t)((half * 90 + i) * 180 + k), f / scale[0]);
            }
    double off = read_file(alpha, MERL_RED, &said);
    printf("of another program: D off by %.4f\n%s", off, said.text);
    TEST(off < 0.01);
    TEST_HAS(said.text, place == 0 ? "bins lower end\n" : "bins middle\n");
    TEST_HAS(said.text, is_separable ? "masking separable\n" : "masking correlated\n");
    TEST_NEAR(number_after(said.text, "diffuse "), 0, 1e-4);
    TEST(number_after(said.text, "residual_reflectance ") < 1e-3);
}

/* What measurements could not see is negative. */
static void test_missing(void)
{
    notes said;
    for (size_t half = 85; half < 90; half++)
        for (size_t i = 0; i < 90 * 180; i++)
            put(2, half * 90 * 180 + i, -1);
    put(2, 0, NAN);
    put(2, 5, INFINITY);
    double off = read_file(0.3, MERL_BLUE, &said);
    printf("nothing beyond 80 degrees: D off by %.4f\n%s", off, said.text);
    TEST(off < 0.02);
    TEST(number_after(said.text, "angles_without_light ") == 5);
}

/* ---- the iteration ------------------------------------------------------------------------------- */

/* 4 cos f int |w.m| D dm is F0 D, by another quadrature. */
static void test_eigenvector(void)
{
    power_bins bins;
    double f[POWER_ANGLES], ndf[POWER_ANGLES] = {0}, f0, whole = 0;
    power_even(&bins, 90, 0.5);
    for (int i = 0; i < 90; i++)
        f[i] = exp(-3 * bins.theta[i]) * (1 + 0.5 * sin(7 * bins.theta[i]));
    TEST(power_iterate(&bins, POWER_CORRELATED, f, ndf, &f0) && f0 > 0);
    for (int i = 0; i < 90; i++)
        whole += 2 * PI * bins.share[i] * cos(bins.theta[i]) * ndf[i];
    TEST_RELATIVE(whole, 1.0, 1e-12);
    for (int i = 4; i < 90; i += 17) {
        double sum = 0, c = cos(bins.theta[i]), s = sin(bins.theta[i]);
        for (int k = 0; k < 90; k++)
            for (int phi = 0; phi < 360; phi++)
                sum += 2 * PI / 360 * bins.share[k] * ndf[k] *
                       fabs(c * cos(bins.theta[k]) + s * sin(bins.theta[k]) * cos((phi + 0.5) * PI / 180));
        TEST_RELATIVE(4 * c * f[i] * sum, f0 * ndf[i], 1e-3);
        TEST_RELATIVE(2 * power_area(&bins, ndf, bins.theta[i]) - c, sum, 1e-3);
    }
    for (int i = 0; i < 90; i++)
        f[i] = 0;
    TEST(!power_iterate(&bins, POWER_CORRELATED, f, ndf, &f0));
}

/* ---- refusals ------------------------------------------------------------------------------------ */

static void refused(size_t size, const char *message)
{
    profile rows;
    refusal why = {""};
    notes said = {"", 0};
    if (!(TEST(!merl_read(&rows, "bad.binary", bytes, size, MERL_RED, &said, &why)) & TEST(rows.x == NULL) &
          TEST_HAS(why.message, "bad.binary: ") & TEST_HAS(why.message, message)))
        fprintf(stderr, "  %s\n", why.message);
}

static void test_refusals(void)
{
    refused(0, "the file is empty");
    refused(11, "it ends within the head, three numbers of 4 bytes");
    refused(12, "a MERL file of 90 x 90 x 180 has 34992012 bytes, and there are 12");
    refused(SIZE - 1, "and there are 34992011");
    for (size_t i = 0; i < PLANE; i++)
        put(0, i, 0);
    refused(SIZE, "no light comes back");
    for (size_t i = 0; i < PLANE; i++)
        put(0, i, -1);
    refused(SIZE, "no direction within 80 degrees has a value");
    bytes[0] = 91;
    refused(SIZE, "it begins with 91 90 180");
    bytes[0] = 90;
    bytes[8] = 0x68, bytes[9] = 1;
    refused(SIZE, "a MERL file of 90 x 90 x 360 has 69984012 bytes");
}

int main(void)
{
    bytes = malloc(SIZE);
    test_eigenvector();
    if (!test_quick())
        test_round_trip(0.1f);
    test_round_trip(0.3f);
    test_diffuse();
    test_missing();
    if (!test_quick())
        test_convention(0, 0);
    test_convention(0.5, 1);
    test_refusals();
    free(bytes);
    return test_done();
}
