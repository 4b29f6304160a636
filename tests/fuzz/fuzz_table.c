/* No bytes crash the loader: they are refused with a message, or they are a table that samples, evaluates
 * and inverts without a fault and without a NaN. Each input is tried as it is, and again with the size and
 * the checksum of the file format put right, since nothing random gets past those. What somebody forged
 * that way may overflow to an infinite density; a table as the builder wrote it may not. */
#include "fuzz/fuzz.h"

static void sample_and_evaluate(const vndf_surface *surface, vndf_vec3 wi, int forged)
{
    static const float uniform[][2] = {{0.0f, 0.0f}, {1.0f, 1.0f}, {0.3f, 0.6f}, {0.999f, 0.001f}};
    const vndf_view view = vndf_view_from(surface, wi);

    for (size_t i = 0; i < sizeof uniform / sizeof uniform[0]; i++) {
        float pdf = -1.0f, u1 = -1.0f, u2 = -1.0f;
        const vndf_vec3 wm = vndf_sample(&view, uniform[i][0], uniform[i][1], &pdf);
        vndf_invert(&view, wm, &u1, &u2);
        fuzz_require(fuzz_is_finite(wm) && wm.z >= 0.0f, "a sample is finite and not below the surface");
        fuzz_require(pdf >= 0.0f && (forged || isfinite(pdf)), "its density is finite");
        fuzz_require(u1 >= 0.0f && u1 <= 1.0f && u2 >= 0.0f && u2 <= 1.0f, "its uniform numbers are in [0, 1]");
        fuzz_require(vndf_pdf(&view, wm) >= 0.0f && vndf_ndf(surface, wm) >= 0.0f, "pdf and ndf are not NaN");
    }
    fuzz_require(vndf_projected_area(surface, wi) >= 0.0f, "the projected area is not NaN");
    fuzz_require(!isnan(vndf_lambda(surface, wi)) && vndf_g1(surface, wi) >= 0.0f, "lambda and g1 are not NaN");
}

static void load_and_use(const uint8_t *data, size_t size, int forged)
{
    static const vndf_vec3 directions[] = {
        {0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}, {0.0f, 1.0f, 0.0f}, {-0.6f, 0.5f, -0.6244998f}};
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *distribution = vndf_load_memory(data, size, &error);
    const vndf_surface surface = {distribution, 0.5f, 0.01f};

    if (!fuzz_loaded(distribution, &error))
        return;
    fuzz_require(vndf_distribution_info(distribution).source != NULL, "a table says where it came from");
    for (size_t i = 0; i < sizeof directions / sizeof directions[0]; i++)
        sample_and_evaluate(&surface, directions[i], forged);
    vndf_free(distribution);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    load_and_use(data, size, 0);
    if (size < FUZZ_MENDABLE)
        return;
    fuzz_mend((uint8_t *)text, size);
    load_and_use((uint8_t *)text, size, 1);
}
