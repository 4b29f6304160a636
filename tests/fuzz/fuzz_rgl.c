/* No bytes crash the reader of .bsdf files: they are refused with a message that names the file, or D is a curve over
 * ascending angles, and what is said of the rest of the file is finite. */
#include "fuzz/measured.h"
#include "measured/rgl/rgl.h"

enum { SELDOM = 4099 }; /* drawing takes a quarter of a second */

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    const vndf_surface surface = {vndf_ggx(), 0.5f, 0.5f};
    const uint8_t *bytes = size ? data : (uint8_t *)text;
    profile rows;
    notes said = {"", 0};
    refusal why = {""};
    int good = rgl_read(&rows, "fuzz", bytes, size, &said, &why);
    if (good)
        rgl_residuals(&surface, "fuzz", bytes, size, &said);
    fuzz_judge(good, &rows, &said, &why);
    if (fuzz_is_seldom(data, size, SELDOM) && rgl_fit(&rows, "fuzz", bytes, size, &said, &why))
        profile_free(&rows);
}
