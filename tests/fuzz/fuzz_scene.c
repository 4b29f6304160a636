/* No bytes crash the reader of scenes. Left out are texts that could ask for what only takes long: images of more
 * than three digits a side, and tables that are built. */
#include "fuzz/fuzz.h"
#include "render/scene.h"

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    size_t digits = 0;
    for (size_t i = 0; i < size && digits < 4; i++)
        digits = data[i] && strchr("0123456789eE", data[i]) ? digits + 1 : 0;
    if (digits > 3 || strstr(text, "family") || strstr(text, "slope") || strstr(text, "ndf="))
        return;
    char *copy = malloc(size + 1);
    if (copy == NULL)
        abort();
    scene_free(scene_read_text("fuzz.scene", memcpy(copy, text, size + 1), size));
}
