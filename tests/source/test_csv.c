/* Rows of D or P22 become a curve that meets them, stays between neighbours, never goes below zero (at the ends of
 * double: fuzz_source) and has the tail that csv.c states, whatever their columns, from a CSV as from memory; what is
 * no such curve is refused with the number of the line or row. */
#include "source/sources.h"

static vndf_source *csv(const char *text)
{
    vndf_error error = {VNDF_OK, ""};
    return made(vndf_source_csv_text("test.csv", text, strlen(text), &error), &error, text);
}

/* The same numbers as a CSV and from memory, where the columns are not in degrees. */
static char text[1 << 20];
static const char *const headers[] = {"theta,ndf", "theta,p22", "slope,ndf", "slope,p22", "theta_deg,ndf"};
enum { THETA_NDF, THETA_P22, SLOPE_NDF, SLOPE_P22, DEGREES_NDF };

static vndf_source *csv_of(int columns, const double *x, const double *y, size_t count)
{
    size_t used = (size_t)sprintf(text, "%s\n", headers[columns]);
    for (size_t i = 0; i < count; i++)
        used += (size_t)sprintf(text + used, "%.17g,%.17g\n", x[i], y[i]);
    return csv(text);
}

static vndf_source *rows_of(int columns, const double *x, const double *y, size_t count)
{
    vndf_error error = {VNDF_OK, ""};
    return made(
        vndf_source_rows((vndf_rows_over)(columns / 2), (vndf_rows_of)(columns % 2), x, y, count, "test", &error),
        &error, headers[columns]);
}

/* GGX of roughness 0.3; at 1, D would be constant. */
static double ggx(double r)
{
    double q = 1 + r * r / 0.09;
    return 1 / (0.09 * PI * q * q);
}

/* Between the rows of a smooth curve, at points that are no rows. */
static void test_accuracy(void)
{
    double x[300], y[300], radians[300];
    for (int i = 0; i <= 180; i++) {
        double c = cos(i * PI / 360);
        x[i] = i * 0.5, radians[i] = i * PI / 360;
        y[i] = i == 180 ? 0.09 / PI : ggx(tan(i * PI / 360)) / (c * c * c * c);
    }
    vndf_source *even = csv_of(DEGREES_NDF, x, y, 181), *same = rows_of(THETA_NDF, radians, y, 181);
    for (int i = 0; i < 284; i++) {
        x[i] = i ? 1e-3 * pow(1.05, i - 1) : 0;
        y[i] = ggx(x[i]);
    }
    vndf_source *geometric = csv_of(SLOPE_P22, x, y, 284);
    for (double r = 1e-3; r < 1e4; r *= 1.013) {
        TEST_RELATIVE(vndf_source_p22(even, r), ggx(r), 1e-5);
        TEST_RELATIVE(vndf_source_p22(same, r), ggx(r), 1e-5);
        TEST_RELATIVE(vndf_source_p22(geometric, r), ggx(r), 1e-5);
    }
    vndf_source_free(even);
    vndf_source_free(same);
    vndf_source_free(geometric);
}

/* Random rows, some zero, over many decades: every point lies between its two rows; from memory to the same bits. */
static void test_shape(void)
{
    unsigned long long state = 5;
    for (int trial = 0; trial < 200; trial++) {
        double x[40], y[40];
        int count = 2 + trial % 38;
        for (int i = 0; i < count; i++) {
            x[i] = (i > 0 ? x[i - 1] : 0) + pow(10, 6 * test_uniform_double(&state) - 4);
            y[i] = trial % 2 && i % 5 == 3 ? 0 : pow(10, 20 * test_uniform_double(&state) - 10);
        }
        vndf_source *source = csv_of(SLOPE_P22, x, y, (size_t)count),
                    *rows = rows_of(SLOPE_P22, x, y, (size_t)count);
        TEST(rows->break_count == source->break_count);
        TEST(vndf_source_p22(source, x[0] / 2) == vndf_source_p22(source, 0));
        for (int i = 1; i < count; i++)
            for (double t = 0; t <= 1; t += 0.0625) {
                double value = vndf_source_p22(source, x[i - 1] + t * (x[i] - x[i - 1]));
                double low = fmin(y[i - 1], y[i]), high = fmax(y[i - 1], y[i]);
                TEST(value >= low * (1 - 1e-13) && value <= high * (1 + 1e-13));
                TEST(value == vndf_source_p22(rows, x[i - 1] + t * (x[i] - x[i - 1])));
            }
        vndf_source_free(source);
        vndf_source_free(rows);
    }
}

/* P22 at rows in every unit, with comments, blanks, CRLF, a byte order mark and no newline at the end; and at slopes
 * beyond the rows. The breaks. */
static void test_points(void)
{
    static const struct {
        const char *text;
        double r, want;
    } points[] = {
        {"slope,p22\n0,4\n1,2\n1.7320508075688772,1", 1, 2},
        {"# measured\r\n\r\n slope ,\tndf \r\n0,4\r\n#\r\n1 , 8\r\n1.7320508075688772,16\r", 1.7320508075688772,
         1},
        {"\xEF\xBB\xBFtheta_deg,p22\n0,4\n45,2\n60,1\n", 1, 2},
        {"theta_deg,p22\n0,4\n45,2\n60,1\n", 1.7320508075688772, 1},
        {"theta,p22\n0,4\n0.78539816339744831,2\n1.0471975511965977,1\n", 1.7320508075688772, 1},
        {"theta,p22\n0,4\n0.78539816339744831,2\n1.0471975511965977,1\n", 0, 4},
        {"slope,p22\n1,1\n2,0.03125\n", 20, 3.125e-7}, /* r^-5 goes on as it is */
        {"slope,p22\n1,1\n2,0.5\n", 20, 0.5e-4},       /* r^-1 becomes r^-4 */
        {"slope,p22\n0,1\n2,3\n", 20, 3e-4},           /* it rises */
        {"slope,p22\n0,1\n1,1\n1.000001,0\n", 1e300, 0},
        {"slope,p22\n0,1\n1,1\n1.000001,0\n", 0.7, 1},
        {"theta_deg,ndf\n0,3\n45,2\n90,1\n", 1e9, 1e-36},           /* D at 90 degrees is given */
        {"theta,ndf\n0,3\n0.5,200\n1.5707963263,1\n", 1e14, 1e-56}, /* or nearly there */
        {"theta_deg,ndf\n0,3\n45,2\n90,1\n", 1, 0.5},
        {"theta_deg,ndf\n0,3\n45,2\n90,1\n", 1e300, 0},
        {"theta_deg,ndf\n0,3\n80,0.171\n90,0\n", 11.430052302761343,
         4.933443377501309e-06}, /* it falls to 0 there */
        {"theta_deg,ndf\n0,3\n80,0.171\n90,0\n", 1e6, 9.624789422114103e-31},
        {"theta_deg,ndf\n0,3\n80,0\n90,0\n", 1e6, 0},
    };
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        vndf_source *source = csv(points[i].text);
        TEST_RELATIVE(vndf_source_p22(source, points[i].r), points[i].want, points[i].r < 2 ? 1e-14 : 1e-8);
        vndf_source_free(source);
    }
    vndf_source *steep = csv("slope,p22\n1,1\n2,0.03125\n"), *full = csv("theta_deg,ndf\n0,3\n45,2\n90,1\n");
    TEST(full->break_count == 1 && fabs(full->breaks[0] - 1) < 1e-15);
    TEST(steep->break_count == 2 && steep->breaks[1] == 2);
    vndf_source_free(steep);
    vndf_source_free(full);
}

/* ---- refusals ---- */

static void refuse_text(const char *bytes, size_t size, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    refused(vndf_source_csv_text("t.csv", bytes, size, &error), &error, VNDF_ERROR_SYNTAX, message);
}

static void test_refused_texts(void)
{
    static const char *const texts[][2] = {
        {"", "t.csv: line 1: no header line"},
        {"slope\n0\n", "line 1: fields: 1; two are needed"},
        {"\nangle,p22\n", "line 2: the first column is called 'angle'; the header names it theta_deg"},
        {"slope,D\n", "line 1: the second column is called 'D'; the header names it ndf or p22"},
        {"slope,p22\n0,1\n", "line 2: rows of numbers: 1; at least two"},
        {"material,channel,alpha\n", "line 1: fields: 3; two are needed"},
        {"slope,p22\n0,1\n#\n\n1,abc\n", "line 5: p22 is 'abc', which is no number"},
        {"slope,p22\n0,1\n,2\n", "line 3: slope is '', which is no number"},
        {"slope,p22\n0,1\n1,nan\n", "line 3: p22 is 'nan', which is no number"},
        {"slope,p22\n0,1\n1,1e999\n", "line 3: p22 is '1e999', too large"},
        {"slope,p22\n0,1\n1,-1e-9\n", "t.csv: line 3: p22 is -1e-09; it must be finite and not negative"},
        {"slope,p22\n-1,1\n1,1\n", "line 2: slope is -1; it must be finite and not negative"},
        {"slope,p22\n0,1\n2,1\n\n1,1\n", "line 5: slope is 1, which is not above that of line 3; rows"},
        {"theta_deg,ndf\n0,1\n90.5,1\n", "line 3: theta_deg is 90.5; angles from the normal are at most 90"},
        {"theta_deg,p22\n0,1\n90,0\n", "line 3: at 90 degrees the slope is infinite"},
    };
    static char line[5000];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        refuse_text(texts[i][0], strlen(texts[i][0]), texts[i][1]);
    refuse_text("slope,p22\n0,1\n1\0,2\n", 20, "line 3: slope is '1?', which is no number");
    memset(line, ' ', sizeof line);
    memcpy(line, "slope,p22\n", 10);
    refuse_text(line, sizeof line, "line 2: 4990 characters; at most 4096");
    size_t used = 10, rows = VNDF_LIMIT_CSV_ROWS + 1;
    char *many = malloc(20 * rows);
    memcpy(many, "slope,p22\n", 10);
    for (size_t i = 0; i < rows; i++)
        used += (size_t)sprintf(many + used, "%zu,1\n", i);
    refuse_text(many, used, "line 16386: more than 16384 rows");
    free(many);
}

static void test_refused_files(void)
{
    vndf_error error = {VNDF_OK, ""};
    refused(vndf_source_csv_file(VNDF_SOURCE_DIR "/CMakeLists.txt", &error), &error, VNDF_ERROR_SYNTAX,
            "CMakeLists.txt: line ");
    refused(vndf_source_csv_file("no/such/file.csv", &error), &error, VNDF_ERROR_IO,
            "no/such/file.csv: cannot be opened: ");
    refused(vndf_source_csv_file(NULL, &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
    refused(vndf_source_csv_file(VNDF_SOURCE_DIR, &error), &error, VNDF_ERROR_IO, "");
    refused(vndf_source_csv_text(NULL, "", 0, &error), &error, VNDF_ERROR_SYNTAX, "unnamed: line 1: no");
    refused(vndf_source_csv_text("x", NULL, 0, &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
}

/* Calls with three rows: two of them, (0.1, 1) and (1.5, 1), and one between. */
static void test_refused_rows(void)
{
    static const double none = 0;
    static const struct {
        int over, of;
        double x, value;
        size_t count;
        const char *message;
    } calls[] = {
        {VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_P22, NAN, 1, 3, "row 1: theta is nan; it must be finite"},
        {VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_P22, 0.2, NAN, 3, "row 1: p22 is nan; it must be finite"},
        {VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_P22, 0.1 * (1 + 5e-13), 1, 3, "which is not above that of row 0"},
        {VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, 1.6, 1, 3,
         "row 1: theta is 1.6; angles from the normal are at most pi/2"},
        {VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, 1, 1, 1, "1 rows; from 2 to 16384"},
        {VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, 1, 1, 16385, "16385 rows; from 2"},
        {7, VNDF_ROWS_OF_P22, 1, 1, 3, "the columns are neither"},
        {VNDF_ROWS_OVER_SLOPE, -1, 1, 1, 3, "the columns are neither"},
    };
    vndf_error error = {VNDF_OK, ""};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        const double x[3] = {0.1, calls[i].x, 1.5}, y[3] = {1, calls[i].value, 1};
        refused(vndf_source_rows((vndf_rows_over)calls[i].over, (vndf_rows_of)calls[i].of, x, y, calls[i].count,
                                 NULL, &error),
                &error, i < 4 ? VNDF_ERROR_DISTRIBUTION : VNDF_ERROR_ARGUMENT, calls[i].message);
    }
    refused(vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, NULL, &none, 2, NULL, &error), &error,
            VNDF_ERROR_ARGUMENT, "the array of slope is NULL");
    refused(vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, &none, NULL, 2, NULL, &error), &error,
            VNDF_ERROR_ARGUMENT, "the array of p22 is NULL");
}

int main(void)
{
    test_accuracy();
    test_shape();
    test_points();
    test_refused_texts();
    test_refused_files();
    test_refused_rows();
    return test_done();
}
