/* No bytes crash the reader of .bsdf files: they are refused with a message that names the file, or D is a curve over
 * ascending angles, and what is said of the rest of the file is finite. */
#include <math.h>

#include "fuzz/fuzz.h"
#include "measured/brdf.h"

enum { SELDOM = 4099 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *exact = malloc(size ? size : 1);
    profile rows;
    data_file file = {.name = "fuzz", .bytes = exact, .size = size};
    uint32_t hash = 1;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ data[i]) * 16777619u;
    if (exact == NULL)
        abort();
    if (size > 0)
        memcpy(exact, data, size);
    int good = rgl_read(&file, &rows);
    fuzz_require(good || (strncmp(file.refused, "fuzz: ", 6) == 0 && rows.x == NULL),
                 "a refusal has a reason alone");
    for (size_t i = 0; good && i < rows.count; i++)
        fuzz_require(isfinite(rows.value[i]) && rows.value[i] >= 0 && (i == 0 || rows.x[i] > rows.x[i - 1]),
                     "rows are a curve");
    fuzz_require(strstr(file.notes, "nan") == NULL && strstr(file.notes, "inf") == NULL, "what is said is finite");
    if (good)
        profile_free(&rows);
    /* Drawing takes a quarter of a second. */
    if (hash % SELDOM == 0 && rgl_read_matrix(&file, &rows))
        profile_free(&rows);
    free(exact);
    return 0;
}
