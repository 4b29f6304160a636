/* No text crashes the readers of expressions, families and CSV: it is refused with a message, or it evaluates at any
 * slope without a fault, to a number that may be NaN or infinite - of a CSV it is not negative - and a formula and a
 * family between slopes to bounds. */
#include "fuzz/fuzz.h"
#include "source/source.h"

static void evaluate(vndf_source *source, int is_csv, const vndf_error *error)
{
    static const double slopes[] = {0.0, 1e-320, 1e-300, 1e-6, 0.1, 0.5, 1.0, 7.0, 1e3, 1e18, 1e300};
    for (size_t i = 0; fuzz_loaded(source, error) && i < sizeof slopes / sizeof slopes[0]; i++) {
        vndf_reach reach = {0, 0, 0};
        const double p22 = vndf_source_p22(source, slopes[i]);
        fuzz_require(!is_csv || p22 >= 0.0, "P22 of a CSV is not negative and not NaN");
        if (i > 1 && !is_csv)
            reach = source->reach(source, slopes[i - 1], slopes[i]);
        fuzz_require(reach.low <= reach.high && reach.stray >= 0.0, "bounds are in order");
    }
    vndf_source_free(source);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    static const vndf_parameter parameters[] = {{"a", 0.3}, {"b_1", -2.0}};
    for (size_t count = 0; count <= 2; count += 2) { /* a parameter that is not used is refused */
        vndf_error of_ndf = {VNDF_OK, ""}, of_slope = {VNDF_OK, ""};
        evaluate(vndf_source_ndf_expression(text, parameters, count, &of_ndf), 0, &of_ndf);
        evaluate(vndf_source_slope_expression(text, parameters, count, &of_slope), 0, &of_slope);
    }
    vndf_error error = {VNDF_OK, ""};
    evaluate(vndf_source_family(text, &error), 0, &error);
    error = (vndf_error){VNDF_OK, ""};
    evaluate(vndf_source_csv_text("fuzz.csv", size ? (const char *)data : text, size, &error), 1, &error);
}
