/* No text crashes the reader of expressions: it is refused with a message, or it evaluates at any slope
 * without a fault, to a number that may be NaN or infinite, and between slopes to bounds. */
#include "source/source.h"
#include "fuzz/fuzz.h"

typedef vndf_source *read_function(const char *text, const vndf_parameter *parameters, size_t count,
                                   vndf_error *error);

static void read_and_evaluate(read_function *read, const char *text, size_t count)
{
    static const vndf_parameter parameters[] = {{"a", 0.3}, {"b_1", -2.0}};
    static const double slopes[] = {0.0, 1e-300, 1e-6, 0.5, 1.0, 7.0, 1e3, 1e18, 1e300};
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = read(text, parameters, count, &error);
    double sum = 0.0;

    fuzz_require_error(source != NULL, &error);
    for (size_t i = 0; source && i < sizeof slopes / sizeof slopes[0]; i++)
        sum += vndf_source_p22(source, slopes[i]);
    fuzz_use(sum);
    for (size_t i = 2; source && i < sizeof slopes / sizeof slopes[0]; i++) {
        vndf_reach reach = source->reach(source, slopes[i - 1], slopes[i]);
        fuzz_require(reach.low <= reach.high && reach.stray >= 0.0, "bounds are in order");
    }
    fuzz_require(source == NULL || vndf_source_description(source) != NULL, "a source has a description");
    vndf_source_free(source);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = fuzz_text(data, size);

    for (size_t count = 0; count <= 2; count += 2) { /* a parameter that is not used is refused */
        read_and_evaluate(vndf_source_ndf_expression, text, count);
        read_and_evaluate(vndf_source_slope_expression, text, count);
    }
    free(text);
    return 0;
}
