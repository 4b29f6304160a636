/* No bytes crash the reader of PFM, PGM and PPM: they are refused with a message, or make an image of finite numbers
 * that look-ups stay inside of. */
#include "fuzz/fuzz.h"
#include "render/image.h"

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    image made;
    vndf_error error = {VNDF_OK, ""};
    float between[3];
    int good = image_read_bytes(&made, "fuzz.pfm", size ? data : (uint8_t *)text, size, &error);
    fuzz_require(good == (made.rgb != NULL), "an image comes with success");
    fuzz_require(good || strstr(error.message, "fuzz.pfm: ") == error.message, "an error begins with the file");
    if (!good)
        return;
    fuzz_require((size_t)made.width * (size_t)made.height < size, "an image is not larger than its file");
    for (int y = 0; y < made.height; y++)
        for (int x = 0; x < made.width; x++) {
            const float *rgb = image_pixel(&made, x, y);
            fuzz_require(isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]), "pixels are finite");
        }
    for (int i = -8; i < 8; i++) {
        image_bilinear(&made, i * 0.37, i * 1.71, between);
    }
    image_free(&made);
}
