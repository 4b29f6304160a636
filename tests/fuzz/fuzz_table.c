/* No bytes crash the loaders of tables and of families: they are refused with a message, or they are a table that
 * samples, evaluates and inverts without a fault and without a NaN, or a family whose mixture at any parameter does.
 * Each input is tried as it is, and again with the size and the checksum of the file put right, since nothing random
 * gets past those. What somebody forged that way may overflow to an infinite density; a table as the builder wrote it
 * may not. */
#include "fuzz/fuzz.h"
#include "harness/damage.h"

static const vndf_vec3 DIRECTIONS[] = {
    {0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}, {0.0f, 1.0f, 0.0f}, {-0.6f, 0.5f, -0.6244998f}};
enum { DIRECTION_COUNT = sizeof DIRECTIONS / sizeof *DIRECTIONS };

static int is_normal(vndf_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z) && v.z >= 0.0f;
}

/* A table is a mixture of one lobe. */
static void use(const vndf_mixture *mixture, vndf_vec3 wi, int forged)
{
    static const float uniform[][2] = {{0.0f, 0.0f}, {1.0f, 1.0f}, {0.3f, 0.6f}, {0.999f, 0.001f}};
    const vndf_mixture_view view = vndf_mixture_view_from(mixture, wi);
    for (size_t i = 0; i < sizeof uniform / sizeof uniform[0]; i++) {
        float pdf = -1.0f, u1 = -1.0f, u2 = -1.0f;
        const vndf_vec3 wm = vndf_mixture_sample(&view, uniform[i][0], uniform[i][1], &pdf, NULL);
        vndf_mixture_invert(&view, wm, -1, &u1, &u2);
        fuzz_require(is_normal(wm), "a sample is finite and not below the surface");
        fuzz_require(pdf >= 0.0f && (forged || isfinite(pdf)), "its density is finite");
        fuzz_require(u1 >= 0.0f && u1 <= 1.0f && u2 >= 0.0f && u2 <= 1.0f, "its uniform numbers are in [0, 1]");
        fuzz_require(vndf_mixture_pdf(&view, wm) >= 0.0f && vndf_mixture_ndf(mixture, wm) >= 0.0f,
                     "pdf and ndf are not NaN");
    }
    fuzz_require(vndf_mixture_projected_area(mixture, wi) >= 0.0f, "the projected area is not NaN");
    fuzz_require(!isnan(vndf_mixture_lambda(mixture, wi)) && vndf_mixture_g1(mixture, wi) >= 0.0f,
                 "lambda and g1 are not NaN");
}

static void load_and_use(const uint8_t *data, size_t size, int forged)
{
    static const vndf_affine shape = {NULL, 0.5f, 0.1f, -0.1f, 0.3f, 0.2f, 0.0f};
    vndf_error of_table = {VNDF_OK, ""}, of_family = {VNDF_OK, ""};
    vndf_distribution *distribution = vndf_load_memory(data, size, &of_table);
    vndf_family *family = vndf_family_load_memory(data, size, &of_family);
    vndf_mixture mixture = {1, {{{distribution, 0.5f, 0.0f, 0.0f, 0.01f, 0.0f, 0.0f}, 1.0f}}};
    if (fuzz_loaded(distribution, &of_table)) {
        fuzz_require(vndf_distribution_info(distribution).source != NULL, "a table says where it came from");
        for (size_t i = 0; i < DIRECTION_COUNT; i++)
            use(&mixture, DIRECTIONS[i], forged);
    }
    if (fuzz_loaded(family, &of_family)) {
        const vndf_family_facts facts = vndf_family_info(family);
        const float at[] = {facts.low, facts.low + 0.4f * (facts.high - facts.low), INFINITY};
        fuzz_require(facts.low <= facts.high && facts.source != NULL, "a family has a range and a source");
        for (size_t i = 0; i < 3 * DIRECTION_COUNT; i++) {
            const vndf_family_place place = vndf_family_at(family, at[i % 3], &shape, &mixture);
            fuzz_require(place != VNDF_FAMILY_INVALID && mixture.count >= 1 && mixture.count <= 2,
                         "one or two lobes");
            use(&mixture, DIRECTIONS[i / 3], 1);
        }
    }
    vndf_free(distribution);
    vndf_family_free(family);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    load_and_use(data, size, 0);
    if (size < 20)
        return;
    put_u32((uint8_t *)text + 12, (unsigned long)size);
    mend_checksum((uint8_t *)text, size);
    load_and_use((uint8_t *)text, size, 1);
}
