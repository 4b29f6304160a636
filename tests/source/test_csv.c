/* A CSV of D or P22 becomes a curve that meets its rows, stays between neighbouring rows, never goes below
 * zero (at the ends of double: fuzz_csv) and has the tail that csv.h states; what is not such a CSV is refused with the
 * number of the line. */
#include "harness/constants.h"
#include "harness/test.h"

#include <stdlib.h>

#include "core/checksum.h"
#include "source/csv/csv.h"
#include "source/source.h"

static vndf_source *read_text(const char *text)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_csv_text("test.csv", text, strlen(text), &error);
    if (!TEST(source != NULL))
        fprintf(stderr, "  %s\n", error.message);
    return source;
}

/* GGX of roughness 0.3; at 1, D would be constant. */
static double ggx(double r)
{
    double q = 1 + r * r / 0.09;
    return 1 / (0.09 * PI * q * q);
}

/* The same curve in every unit; comments, blanks, CRLF, a byte order mark, and no newline at the end. */
static void test_units(void)
{
    vndf_source *slope = read_text("slope,p22\n0,4\n1,2\n1.7320508075688772,1");
    vndf_source *ndf = read_text("# measured\r\n\r\n"
                                 " slope ,\tndf \r\n0,4\r\n#\r\n1 , 8\r\n1.7320508075688772,16\r");
    vndf_source *degrees = read_text("\xEF\xBB\xBFtheta_deg,p22\n0,4\n45,2\n60,1\n");
    vndf_source *radians = read_text("theta,p22\n0,4\n0.78539816339744831,2\n1.0471975511965977,1\n");
    const vndf_source *all[] = {slope, ndf, degrees, radians};
    for (size_t i = 0; i < 4; i++) {
        TEST_RELATIVE(vndf_source_p22(all[i], 0), 4.0, 1e-14);
        TEST_RELATIVE(vndf_source_p22(all[i], 1), 2.0, 1e-14);
        TEST_RELATIVE(vndf_source_p22(all[i], 1.7320508075688772), 1.0, 1e-14);
        TEST(vndf_source_p22(all[i], 0.5) < 4 && vndf_source_p22(all[i], 0.5) > 2);
    }
    for (double r = 0; r < 2; r += 0.01)
        TEST_RELATIVE(vndf_source_p22(degrees, r), vndf_source_p22(radians, r), 1e-14);
    vndf_source_free(slope);
    vndf_source_free(ndf);
    vndf_source_free(degrees);
    vndf_source_free(radians);
}

static size_t add_row(char *text, size_t used, double x, double y)
{
    return used + (size_t)sprintf(text + used, "%.17g,%.17g\n", x, y);
}

/* Between the rows of smooth curves, at points that are no rows; first is the first point. */
static double worst_error(const vndf_source *source, double first, double last)
{
    double worst = 0;
    for (double r = first; r < last; r = r * 1.013 + 1e-5)
        worst = fmax(worst, fabs(vndf_source_p22(source, r) / ggx(r) - 1));
    return worst;
}

static void test_accuracy(void)
{
    static char text[1 << 20];
    size_t used = (size_t)sprintf(text, "theta_deg,ndf\n");
    for (int i = 0; i <= 180; i++) {
        double theta = i * PI / 360, c = cos(theta);
        used = add_row(text, used, i * 0.5, i == 180 ? 0.09 / PI : ggx(tan(theta)) / (c * c * c * c));
    }
    vndf_source *even = read_text(text);
    used = (size_t)sprintf(text, "slope,p22\n0,%.17g\n", ggx(0));
    for (double r = 1e-3; r < 1e3; r *= 1.05)
        used = add_row(text, used, r, ggx(r));
    vndf_source *geometric = read_text(text);
    printf("GGX 0.3 from CSV: worst error %.2g from rows every half degree, %.2g from 283 rows 5%% apart\n",
           worst_error(even, 0, 1e4), worst_error(geometric, 1e-3, 1e6));
    TEST(worst_error(even, 0, 1e4) < 1e-5);
    TEST(worst_error(geometric, 1e-3, 1e6) < 1e-5);
    vndf_source_free(even);
    vndf_source_free(geometric);
}

/* Random rows, some zero, over many decades: every point lies between its two rows. */
static void test_shape(void)
{
    static char text[1 << 16];
    unsigned long long state = 5;
    for (int trial = 0; trial < 200; trial++) {
        double x[40], y[40];
        size_t used = (size_t)sprintf(text, "slope,p22\n");
        int count = 2 + trial % 38;
        for (int i = 0; i < count; i++) {
            x[i] = (i > 0 ? x[i - 1] : 0) + pow(10, 6 * test_uniform_double(&state) - 4);
            y[i] = trial % 2 && i % 5 == 3 ? 0 : pow(10, 20 * test_uniform_double(&state) - 10);
            used = add_row(text, used, x[i], y[i]);
        }
        vndf_source *source = read_text(text);
        TEST(vndf_source_p22(source, x[0] / 2) == vndf_source_p22(source, 0));
        for (int i = 1; i < count; i++)
            for (double t = 0; t <= 1; t += 0.0625) {
                double value = vndf_source_p22(source, x[i - 1] + t * (x[i] - x[i - 1]));
                double low = fmin(y[i - 1], y[i]), high = fmax(y[i - 1], y[i]);
                TEST(value >= low * (1 - 1e-13) && value <= high * (1 + 1e-13));
            }
        vndf_source_free(source);
    }
}

/* P22 at slopes beyond the rows, and the breaks. */
static void test_tails(void)
{
    static const struct {
        const char *text;
        double r, want;
    } tails[] = {
        {"slope,p22\n1,1\n2,0.03125\n", 20, 3.125e-7}, /* r^-5 goes on as it is */
        {"slope,p22\n1,1\n2,0.5\n", 20, 0.5e-4},       /* r^-1 becomes r^-4 */
        {"slope,p22\n0,1\n2,3\n", 20, 3e-4},           /* it rises */
        {"slope,p22\n0,1\n1,1\n1.000001,0\n", 1e300, 0},
        {"slope,p22\n0,1\n1,1\n1.000001,0\n", 0.7, 1},
        {"theta_deg,ndf\n0,3\n45,2\n90,1\n", 1e9, 1e-36}, /* D at 90 degrees is given */
        {"theta_deg,ndf\n0,3\n45,2\n90,1\n", 1, 0.5},
        {"theta_deg,ndf\n0,3\n45,2\n90,1\n", 1e300, 0},
    };
    for (size_t i = 0; i < sizeof tails / sizeof *tails; i++) {
        vndf_source *source = read_text(tails[i].text);
        TEST_RELATIVE(vndf_source_p22(source, tails[i].r), tails[i].want, 1e-8);
        vndf_source_free(source);
    }
    vndf_source *steep = read_text(tails[0].text), *full = read_text(tails[5].text);
    TEST(full->break_count == 1 && fabs(full->breaks[0] - 1) < 1e-15);
    TEST(steep->break_count == 2 && steep->breaks[1] == 2);
    vndf_source_free(steep);
    vndf_source_free(full);
}

static void test_thinning(void)
{
    static char text[1 << 20];
    size_t used = (size_t)sprintf(text, "slope,p22\n");
    for (int i = 0; i < 20000; i++)
        used = add_row(text, used, i, 1.0 / (1 + i));
    vndf_source *source = read_text(text);
    TEST(source->break_count == 4095 && source->breaks[4094] == 19999); /* the row at 0 is no break */
    for (size_t i = 1; i < source->break_count; i++)
        TEST(source->breaks[i] > source->breaks[i - 1]);
    vndf_source_free(source);
}

static void test_error_size(const char *text, size_t size, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_csv_text("t.csv", text, size, &error);
    if (!(TEST(source == NULL) & TEST(error.status == VNDF_ERROR_SYNTAX) & TEST_HAS(error.message, message)))
        fprintf(stderr, "  %s\n", error.message);
    vndf_source_free(source);
}

static void test_errors(void)
{
    static const char *const refused[][2] = {
        {"", "t.csv: line 1: no header line"},
        {"# only\n\n", "no header line"},
        {"slope\n0\n", "line 1: 1 field; two are needed"},
        {"\nangle,p22\n", "line 2: the first column is called 'angle'; the header names it theta_deg"},
        {"slope,D\n", "line 1: the second column is called 'D'; the header names it ndf or p22"},
        {"0,1\n1,2\n", "line 1: the first column is called '0'"},
        {"slope,p22\n0,1\n", "line 2: the text ends with 1 row; at least two"},
        {"slope,p22\n0,1\n1\n", "line 3: 1 field;"},
        {"slope,p22\n0,1\n#\n\n1,abc\n", "line 5: p22 is 'abc', which is no number"},
        {"slope,p22\n0,1\n1,2x\n", "line 3: p22 is '2x', a number with something behind it"},
        {"slope,p22\n0,1\n1 1,2\n", "line 3: slope is '1 1', a number with something behind it"},
        {"slope,p22\n0,1\n,2\n", "line 3: slope is missing"},
        {"slope,p22\n0,1\n1,nan\n", "line 3: p22 is 'nan', which is no number"},
        {"slope,p22\n0,1\n1,1e999\n", "line 3: p22 is '1e999', too large"},
        {"slope,p22\n0,1\n1,-1e-9\n", "t.csv: line 3: p22 is -1e-09; it must be finite and not negative"},
        {"slope,p22\n-1,1\n1,1\n", "line 2: slope is -1; it must be finite and not negative"},
        {"slope,p22\n0,1\n2,1\n\n1,1\n", "line 5: slope is 1, which is not above that of line 3; rows"},
        {"theta_deg,ndf\n0,1\n90.5,1\n", "line 3: theta_deg is 90.5; angles from the normal are at most 90"},
        {"theta_deg,p22\n0,1\n90,0\n", "line 3: at 90 degrees the slope is infinite"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        test_error_size(refused[i][0], strlen(refused[i][0]), refused[i][1]);
    test_error_size("slope,p22\n0,1\n1\0,2\n", 20, "line 3: a byte of value 0");
}

static void test_limits(void)
{
    static char line[5000];
    vndf_error error = {VNDF_OK, ""};
    memset(line, ' ', sizeof line);
    memcpy(line, "slope,p22\n", 10);
    test_error_size(line, sizeof line, "line 2: 4990 characters; at most 4096");
    TEST(vndf_source_csv_text("x", NULL, 0, &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
    size_t used = 10, rows = 1000001, size = 20 * rows;
    char *many = malloc(size);
    if (!many)
        return;
    memcpy(many, "slope,p22\n", 10);
    for (size_t i = 0; i < rows; i++)
        used += (size_t)sprintf(many + used, "%zu,1\n", i);
    test_error_size(many, used, "line 1000002: more than 1000000 rows");
    free(many);
}

static void test_files(void)
{
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_source_csv_file(VNDF_SOURCE_DIR "/tables/merl_abc.csv", &error) == NULL);
    TEST_HAS(error.message, "merl_abc.csv: line 4: 3 fields");
    TEST(vndf_source_csv_file("no/such/file.csv", &error) == NULL && error.status == VNDF_ERROR_IO);
    TEST_HAS(error.message, "no/such/file.csv: cannot be opened: ");
    TEST(vndf_source_csv_file(NULL, &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
    TEST(vndf_source_csv_file(VNDF_SOURCE_DIR, &error) == NULL && error.status == VNDF_ERROR_IO);
}

static void test_description(void)
{
    const char *text = "slope,p22\n0,1\n1,0\n";
    char want[80];
    TEST(vndf_crc32(0, "123456789", 9) == 0xCBF43926u);
    TEST(vndf_crc32(vndf_crc32(0, "1234", 4), "56789", 5) == 0xCBF43926u);
    TEST(vndf_crc32(0, "", 0) == 0);
    sprintf(want, "--csv 'my gloss.csv' (crc32 %08lx)", (unsigned long)vndf_crc32(0, text, strlen(text)));
    vndf_source *source = vndf_source_csv_text("my gloss.csv", text, strlen(text), NULL);
    TEST(strcmp(vndf_source_description(source), want) == 0 && !source->rebuildable);
    vndf_source_free(source);
}

int main(void)
{
    test_units();
    test_accuracy();
    test_shape();
    test_tails();
    test_thinning();
    test_errors();
    test_limits();
    test_files();
    test_description();
    return test_done();
}
