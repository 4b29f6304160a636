/* No bytes crash the loaders of tables and of families: they are refused with a message, or they are a table that
 * samples, evaluates and inverts without a fault and without a NaN, or a family whose mixture at any parameter does.
 * Each input is tried as it is, and again with the size and the checksum of the file put right, since nothing random
 * gets past those. What somebody forged that way may overflow to an infinite density; a table as the builder wrote it
 * may not. */
#include "fuzz/fuzz.h"
#include "harness/damage.h"

static void load_and_use(const uint8_t *data, size_t size, int forged)
{
    static const vndf_surface shape = {NULL, 0.5f, 0.1f, -0.1f, 0.3f, 0.2f, 0.0f};
    vndf_error of_table = {VNDF_OK, ""}, of_family = {VNDF_OK, ""};
    vndf_distribution *distribution = vndf_load_memory(data, size, &of_table);
    vndf_family *family = vndf_family_load_memory(data, size, &of_family);
    if (fuzz_loaded(distribution, &of_table)) {
        fuzz_require(vndf_distribution_info(distribution).source != NULL, "a table says where it came from");
        fuzz_require(is_safe(distribution, forged), "a table is safe to use");
    }
    if (fuzz_loaded(family, &of_family)) {
        const vndf_family_facts facts = vndf_family_info(family);
        const float at[] = {facts.low, facts.low + 0.4f * (facts.high - facts.low), INFINITY};
        fuzz_require(facts.low <= facts.high && facts.source != NULL, "a family has a range and a source");
        for (int i = 0; i < 3; i++) {
            vndf_mixture mixture;
            const vndf_family_place place = vndf_family_at(family, at[i], &shape, &mixture);
            fuzz_require(place != VNDF_FAMILY_INVALID && mixture.count >= 1 && mixture.count <= 2,
                         "one or two lobes");
            fuzz_require(is_safe_mixture(&mixture, forged), "a family is safe to use");
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
