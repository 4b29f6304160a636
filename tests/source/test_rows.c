/* Rows of numbers are the source that a CSV of the same numbers is, to the bit of the table, whatever their columns;
 * rows that are no such curve are refused with their number; and a program may say what its rows were made of. */
#include "harness/constants.h"
#include "harness/test.h"

#include <stdlib.h>

#include "core/checksum.h"
#include "vndf_build.h"

enum { ROWS = 60 };

static vndf_source *rows_of(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                            size_t count)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_rows(over, of, x, value, count, "test", &error);
    if (!TEST(source != NULL))
        fprintf(stderr, "  %s\n", error.message);
    return source;
}

static vndf_source *csv_of(const char *header, const double *x, const double *value, size_t count)
{
    char text[ROWS * 60];
    size_t used = (size_t)sprintf(text, "%s\n", header);
    for (size_t i = 0; i < count; i++)
        used += (size_t)sprintf(text + used, "%.17g,%.17g\n", x[i], value[i]);
    return vndf_source_csv_text("test", text, used, NULL);
}

/* The bytes of the table, past the description at its end being of other length. */
static void test_same_table(const vndf_source *a, const vndf_source *b)
{
    const vndf_build_options options = {.max_bytes = 4096};
    vndf_distribution *of_a = vndf_build(a, &options, NULL, NULL), *of_b = vndf_build(b, &options, NULL, NULL);
    float first[4096], second[4096];
    size_t count = vndf_numbers(of_a, first, 4096);
    TEST(count > 100 && count == vndf_numbers(of_b, second, 4096));
    TEST(memcmp(first, second, count * sizeof *first) == 0);
    vndf_free(of_a);
    vndf_free(of_b);
}

static void test_columns(void)
{
    static const char *const headers[4] = {"theta,ndf", "theta,p22", "slope,ndf", "slope,p22"};
    for (int kind = 0; kind < 4; kind++) {
        double x[ROWS], value[ROWS];
        for (int i = 0; i < ROWS; i++) {
            x[i] = kind < 2 ? i * PI / 2 / ROWS : i * 0.05;
            value[i] = exp(-4 * x[i]) * (1 + 0.5 * cos(9 * x[i]));
        }
        vndf_source *rows = rows_of((vndf_rows_over)(kind / 2), (vndf_rows_of)(kind % 2), x, value, ROWS);
        vndf_source *csv = csv_of(headers[kind], x, value, ROWS);
        for (double r = 0; r < 100; r = r * 1.1 + 1e-3)
            TEST(vndf_source_p22(rows, r) == vndf_source_p22(csv, r));
        if (kind == 0 || !test_quick())
            test_same_table(rows, csv);
        vndf_source_free(rows);
        vndf_source_free(csv);
    }
}

/* At 90 degrees D may be anything. */
static void test_grazing(void)
{
    const double x[3] = {0, 0.5, PI / 2 - 5e-10}, value[3] = {3, 2, 1};
    vndf_source *source = rows_of(VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, x, value, 3);
    TEST_RELATIVE(vndf_source_p22(source, 1e9), 1e-36, 1e-8);
    vndf_source_free(source);
}

/* D that falls to 0 at 90 degrees, as cos^k: it joins, it keeps its digits, and a table is made of it. */
static void test_falling(void)
{
    static const int counts[2] = {10, 91};
    const vndf_build_options options = {0};
    for (int k = 1; k <= 4; k *= 2)
        for (int n = 0; n < 2; n++) {
            double x[91], value[91];
            int last = counts[n] - 1;
            for (int i = 0; i <= last; i++) {
                x[i] = PI / 2 * i / last;
                value[i] = i < last ? pow(cos(x[i]), k) : 0;
            }
            vndf_error error = {VNDF_OK, ""};
            vndf_source *source = rows_of(VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, x, value, (size_t)counts[n]);
            double join = tan(x[last - 1]);
            TEST_RELATIVE(vndf_source_p22(source, join * (1 + 1e-12)), vndf_source_p22(source, join), 1e-10);
            double far = vndf_source_p22(source, 1e12), near = vndf_source_p22(source, 1e11);
            double power = log10(near / far);
            TEST(fabs(power - 5) < 1e-6 || fabs(power - 6) < 1e-6);
            vndf_distribution *table = vndf_build(source, &options, NULL, &error);
            if (!TEST(table != NULL))
                fprintf(stderr, "  cos^%d, %d rows: %s\n", k, counts[n], error.message);
            vndf_free(table);
            vndf_source_free(source);
        }
}

static void refused(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value, size_t count,
                    vndf_status status, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_rows(over, of, x, value, count, NULL, &error);
    if (!(TEST(source == NULL) & TEST(error.status == status) & TEST_HAS(error.message, message)))
        fprintf(stderr, "  %s\n", error.message);
    vndf_source_free(source);
}

static void test_refused_rows(void)
{
    static const struct {
        vndf_rows_of of;
        double x, value;
        const char *message;
    } rows[] = {
        {VNDF_ROWS_OF_P22, NAN, 1, "row 1: theta is nan; it must be finite"},
        {VNDF_ROWS_OF_P22, INFINITY, 1, "row 1: theta is inf; it must be finite"},
        {VNDF_ROWS_OF_P22, -1, 1, "row 1: theta is -1; it must be finite and not negative"},
        {VNDF_ROWS_OF_P22, 0.2, NAN, "row 1: p22 is nan; it must be finite"},
        {VNDF_ROWS_OF_P22, 0.2, -1e-300, "row 1: p22 is -1e-300; it must be finite and not negative"},
        {VNDF_ROWS_OF_P22, 0.1, 1, "row 1: theta is 0.1, which is not above that of row 0; rows must ascend"},
        {VNDF_ROWS_OF_P22, 0.1 * (1 + 5e-13), 1, "which is not above that of row 0"},
        {VNDF_ROWS_OF_P22, 1.5, 1, "row 2: theta is 1.5, which is not above that of row 1"},
        {VNDF_ROWS_OF_P22, PI / 2, 1, "row 1: at 90 degrees the slope is infinite"},
        {VNDF_ROWS_OF_NDF, 1.6, 1, "row 1: theta is 1.6; angles from the normal are at most pi/2"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double x[3] = {0.1, rows[i].x, 1.5}, value[3] = {1, rows[i].value, 1};
        refused(VNDF_ROWS_OVER_THETA, rows[i].of, x, value, 3, VNDF_ERROR_DISTRIBUTION, rows[i].message);
    }
}

static void test_refusals(void)
{
    const double x[2] = {0, 1};
    const vndf_rows_over slope = VNDF_ROWS_OVER_SLOPE;
    const vndf_rows_of p22 = VNDF_ROWS_OF_P22;
    refused(slope, p22, x, NULL, 2, VNDF_ERROR_ARGUMENT, "the array of p22 is NULL");
    refused(slope, p22, NULL, x, 2, VNDF_ERROR_ARGUMENT, "the array of slope is NULL");
    refused(slope, p22, x, x, 1, VNDF_ERROR_ARGUMENT, "1 rows; from 2 to 1000000");
    refused(slope, p22, x, x, 1000001, VNDF_ERROR_ARGUMENT, "1000001 rows; from 2");
    refused((vndf_rows_over)7, p22, x, x, 2, VNDF_ERROR_ARGUMENT, "the columns are neither");
    refused(slope, (vndf_rows_of)-1, x, x, 2, VNDF_ERROR_ARGUMENT, "the columns are neither");
}

/* ---- what they came from ----------------------------------------------------------------------- */

static void test_name(void)
{
    const double x[2] = {0, 1}, value[2] = {4, 1};
    const unsigned char bytes[32] = {[14] = 0xf0, 0x3f, [22] = 0x10, 0x40, [30] = 0xf0, 0x3f};
    char want[80];
    sprintf(want, "--rows test (crc32 %08lx)", (unsigned long)vndf_crc32(0, bytes, sizeof bytes));
    vndf_source *source = rows_of(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, value, 2);
    TEST(strcmp(vndf_source_description(source), want) == 0);
    vndf_source_free(source);
    source = vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, value, 2, NULL, NULL);
    TEST_HAS(vndf_source_description(source), "--rows unnamed (crc32 ");
    vndf_source_free(source);
}

static void undescribed(vndf_source *source, const char *words, const char *message)
{
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_source_describe(source, words, &error) == VNDF_ERROR_ARGUMENT);
    TEST(error.status == VNDF_ERROR_ARGUMENT && TEST_HAS(error.message, message));
}

static void test_description(void)
{
    static char words[VNDF_LIMIT_NAME_LENGTH + 2];
    static const char *const refused[][2] = {
        {"", "a description of 0 characters"},
        {"--height a\nb", "column 11 of the description: a control character"},
        {"--height 'a", "column 10: a quote in this word is not closed"},
        {"--family ggx", "begins as that of a formula or a family"},
        {"'--slope' 1", "begins as that of a formula or a family"},
        {NULL, "the description is NULL"},
        {words, "a description of 4097 characters; 1 to 4096"},
    };
    const double x[2] = {0, 1}, value[2] = {4, 1};
    vndf_source *source = rows_of(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, value, 2);
    vndf_source *family = vndf_source_family("ggx", NULL);
    memset(words, 'x', VNDF_LIMIT_NAME_LENGTH + 1);
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        undescribed(source, refused[i][0], refused[i][1]);
    undescribed(NULL, "a", "the source is NULL");
    undescribed(family, "--height a", "the description '--family ggx' makes this source again");
    words[VNDF_LIMIT_NAME_LENGTH] = '\0';
    TEST(vndf_source_describe(source, words, NULL) == VNDF_OK);
    TEST(strcmp(vndf_source_description(source), words) == 0);
    TEST(vndf_source_describe(source, "--rgl 'a b.bsdf' (crc32 1)", NULL) == VNDF_OK);

    const vndf_build_options options = {.max_bytes = 2048};
    vndf_distribution *table = vndf_build(source, &options, NULL, NULL);
    vndf_error error = {VNDF_OK, ""};
    TEST(strcmp(vndf_distribution_info(table).source, "--rgl 'a b.bsdf' (crc32 1)") == 0);
    TEST(vndf_source_of(table, &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
    vndf_free(table);
    vndf_source_free(source);
    vndf_source_free(family);
}

int main(void)
{
    test_columns();
    test_grazing();
    test_falling();
    test_refused_rows();
    test_refusals();
    test_name();
    test_description();
    return test_done();
}
