/* No bytes crash the loader of albedos: they are refused with a message, or every look-up is in [0, 1] and the table
 * is saved as the same bytes. Each input is tried as it is, and with size and checksum put right. */
#include <math.h>

#include "fuzz/fuzz.h"
#include "vndf_albedo.h"

static int is_part(float x)
{
    return x >= 0.0f && x <= 1.0f;
}

static void look_up(const vndf_albedo *albedo, float cosine, float alpha)
{
    vndf_albedo_parts parts = vndf_albedo_split(albedo, cosine, alpha);
    vndf_albedo_parts average = vndf_albedo_average_split(albedo, alpha, cosine < 0.0f ? -1 : 1);
    fuzz_require(is_part(vndf_albedo_directional(albedo, cosine, alpha)), "E is in [0, 1]");
    fuzz_require(is_part(parts.reflected) && is_part(parts.transmitted), "its parts are in [0, 1]");
    fuzz_require(is_part(average.reflected) && is_part(average.transmitted), "averages are in [0, 1]");
}

static void save_again(const vndf_albedo *albedo, const uint8_t *data, size_t size)
{
    uint8_t *bytes = malloc(size);
    if (bytes == NULL)
        abort();
    fuzz_require(vndf_albedo_save_memory(albedo, bytes, size, NULL) == VNDF_OK, "a table can be saved");
    fuzz_require(memcmp(bytes, data, size) == 0, "it is saved as it was loaded");
    free(bytes);
}

static void load_and_use(const uint8_t *data, size_t size)
{
    static const float numbers[] = {-INFINITY, -1.0f, -1e-3f, 0.0f, 1e-30f, 1e-5f, 0.03f, 0.4f, 1.0f, 4.0f, NAN};
    const size_t count = sizeof numbers / sizeof numbers[0];
    vndf_error error = {VNDF_OK, ""};
    vndf_albedo *albedo = vndf_albedo_load_memory(data, size, &error);
    fuzz_require_error(albedo != NULL, &error);
    if (albedo == NULL)
        return;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            look_up(albedo, numbers[i], numbers[j]);
    save_again(albedo, data, size);
    vndf_albedo_free(albedo);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *repaired = (uint8_t *)fuzz_text(data, size);
    load_and_use(data, size);
    if (size >= FUZZ_MENDABLE) {
        fuzz_mend(repaired, size);
        load_and_use(repaired, size);
    }
    free(repaired);
    return 0;
}
