/* No bytes crash the loader of families: they are refused with a message, or they are a family whose mixture at any
 * parameter samples and evaluates without a NaN. Each input is tried as it is, and again with the size and the checksum
 * of the whole put right; fuzz_table forges tables. */
#include "fuzz/fuzz.h"

static void use_at(const vndf_family *family, float parameter)
{
    static const vndf_vec3 directions[] = {{0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}, {-0.6f, 0.5f, -0.6244998f}};
    const vndf_affine shape = {NULL, 0.5f, 0.1f, -0.1f, 0.3f, 0.2f, 0.0f};
    vndf_mixture mixture;
    const vndf_family_place place = vndf_family_at(family, parameter, &shape, &mixture);
    fuzz_require(place != VNDF_FAMILY_INVALID && mixture.count >= 1 && mixture.count <= 2, "one or two lobes");
    for (size_t i = 0; i < sizeof directions / sizeof directions[0]; i++) {
        float pdf = -1.0f;
        const vndf_mixture_view view = vndf_mixture_view_from(&mixture, directions[i]);
        const vndf_vec3 wm = vndf_mixture_sample(&view, 0.3f, 0.6f, &pdf, NULL);
        fuzz_require(fuzz_is_finite(wm) && wm.z >= 0.0f, "a sample is finite and not below the surface");
        fuzz_require(pdf >= 0.0f && vndf_mixture_ndf(&mixture, wm) >= 0.0f, "densities are not NaN");
        fuzz_require(vndf_mixture_projected_area(&mixture, directions[i]) >= 0.0f, "the area is not NaN");
    }
}

static void load_and_use(const uint8_t *data, size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_family *family = vndf_family_load_memory(data, size, &error);
    if (!fuzz_loaded(family, &error))
        return;
    const vndf_family_facts facts = vndf_family_info(family);
    fuzz_require(facts.low <= facts.high && facts.source != NULL,
                 "a family has a range and says where it came from");
    use_at(family, facts.low);
    use_at(family, facts.low + 0.4f * (facts.high - facts.low));
    use_at(family, INFINITY);
    vndf_family_free(family);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    uint8_t *mended = (uint8_t *)text;
    load_and_use(data, size);
    if (size < 36)
        return;
    fuzz_mend(mended, size);
    load_and_use(mended, size);
}
