/* No bytes crash the reader of .bsdf files: they are refused with a message that names the file, or D is a curve over
 * ascending angles, and what is said of the rest of the file is finite. */
#include "fuzz/measured.h"
#include "measured/brdf.h"

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    profile rows;
    data_file file = fuzz_file(size ? data : (uint8_t *)text, size);
    int good = rgl_read(&file, &rows);
    fuzz_judge(good, &rows, &file);
}
