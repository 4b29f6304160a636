/* No bytes crash the reader of CSV: they are refused with a message, or P22 is finite and not negative
 * at any slope that is inside the data. */
#include "fuzz/fuzz.h"
#include "vndf_build.h"

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    static const double slopes[] = {0.0, 1e-320, 1e-300, 1e-6, 0.1, 0.5, 1.0, 7.0, 1e3, 1e18, 1e300};
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_csv_text("fuzz.csv", size ? (const char *)data : text, size, &error);
    for (size_t i = 0; fuzz_loaded(source, &error) && i < sizeof slopes / sizeof slopes[0]; i++)
        fuzz_require(vndf_source_p22(source, slopes[i]) >= 0.0, "P22 of a CSV is not negative and not NaN");
    vndf_source_free(source);
}
