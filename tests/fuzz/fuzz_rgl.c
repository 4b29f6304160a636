/* No bytes crash the reader of .bsdf files: they are refused with a message that names the file, or D is a curve over
 * ascending angles, and what is said of the rest of the file is finite. */
#include "fuzz/measured.h"
#include "measured/brdf.h"

enum { SELDOM = 4099 }; /* drawing takes a quarter of a second */

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    profile rows;
    data_file file = fuzz_file(size ? data : (uint8_t *)text, size);
    int good = rgl_read(&file, &rows);
    fuzz_judge(good, &rows, &file);
    if (fuzz_is_seldom(data, size, SELDOM) && rgl_read_matrix(&file, &rows))
        profile_free(&rows);
}
