/* No bytes crash the reader of CSV: they are refused with a message, or P22 is finite and not negative
 * at any slope that is inside the data. */
#include <math.h>

#include "fuzz/fuzz.h"
#include "vndf_build.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const double slopes[] = {0.0, 1e-320, 1e-300, 1e-6, 0.1, 0.5, 1.0, 7.0, 1e3, 1e18, 1e300};
    vndf_error error = {VNDF_OK, ""};
    char *text = fuzz_text(data, size); /* an exact copy, so that a read past size is a read past the block */
    vndf_source *source = vndf_source_csv_text("fuzz.csv", text, size, &error);

    free(text);
    fuzz_require_error(source != NULL, &error);
    for (size_t i = 0; source && i < sizeof slopes / sizeof slopes[0]; i++) {
        const double p22 = vndf_source_p22(source, slopes[i]);
        fuzz_require(!(p22 < 0.0) && !isnan(p22), "P22 of a CSV is not negative and not NaN");
    }
    vndf_source_free(source);
    return 0;
}
