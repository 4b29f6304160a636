/* No bytes crash the reader of .bsdf files: they are refused with a message that names the file, or D is a curve over
 * ascending angles, and what is said of the rest of the file is finite. */
#include <math.h>

#include "fuzz/fuzz.h"
#include "measured/rgl/rgl.h"

enum { SELDOM = 4099 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const vndf_surface surface = {vndf_ggx(), 0.5f, 0.5f};
    uint8_t *exact = malloc(size ? size : 1);
    profile rows;
    notes said = {"", 0};
    refusal why = {""};
    uint32_t hash = 1;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ data[i]) * 16777619u;
    if (exact == NULL)
        abort();
    if (size > 0)
        memcpy(exact, data, size);
    int good = rgl_read(&rows, "fuzz", exact, size, &said, &why);
    if (good)
        rgl_residuals(&surface, "fuzz", exact, size, &said);
    fuzz_require(good || (strncmp(why.message, "fuzz: ", 6) == 0 && rows.x == NULL),
                 "a refusal has a reason alone");
    for (size_t i = 0; good && i < rows.count; i++)
        fuzz_require(isfinite(rows.value[i]) && rows.value[i] >= 0 && (i == 0 || rows.x[i] > rows.x[i - 1]),
                     "rows are a curve");
    fuzz_require(strstr(said.text, "nan") == NULL && strstr(said.text, "inf") == NULL, "what is said is finite");
    if (good)
        profile_free(&rows);
    /* Drawing takes a quarter of a second. */
    if (hash % SELDOM == 0 && rgl_fit(&rows, "fuzz", exact, size, &said, &why))
        profile_free(&rows);
    free(exact);
    return 0;
}
