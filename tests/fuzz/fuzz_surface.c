/* No bytes crash the readers of heights and of normal maps: they are refused with a message that names the file, or
 * their slopes are finite; and no slopes crash what looks for their law: its rows are a curve, or it says why not. */
#include "fuzz/fuzz.h"
#include "measured/surface/heights.h"
#include "measured/surface/maps.h"

static void judge(slope_set *slopes, int good, const refusal *why)
{
    slope_law law;
    notes said = {"", 0};
    refusal reason = {""};
    fuzz_require(good || strncmp(why->message, "fuzz: ", 6) == 0, "a message begins with the file");
    fuzz_require(good || slopes->x == NULL, "what is refused holds no memory");
    for (size_t i = 0; i < slopes->count; i++)
        fuzz_require(isfinite(slopes->x[i]) && isfinite(slopes->y[i]), "slopes are finite");
    if (good && slopes_law(slopes, "fuzz", &law, &said, &reason)) {
        vndf_source *source = profile_source(&law.rows, "fuzz", &reason);
        fuzz_require(source != NULL && law.rows.count >= 4, "rows are a curve");
        fuzz_require(isfinite(law.matrix[0]) && law.anisotropy >= 1 && law.residual >= 0 && law.residual <= 1,
                     "the shape is one");
        vndf_source_free(source);
        profile_free(&law.rows);
    } else if (good)
        fuzz_require(strncmp(reason.message, "fuzz: ", 6) == 0, "a refused law has a reason");
    slopes_free(slopes);
}

static void try_heights(const void *bytes, size_t size, const height_form *form)
{
    height_field field;
    slope_set slopes = {NULL, NULL, NULL, 0, 0, 0};
    refusal why = {""};
    if (!heights_read(&field, "fuzz", bytes, size, form, &why)) {
        fuzz_require(field.z == NULL, "refused heights hold no memory");
        judge(&slopes, 0, &why);
        return;
    }
    fuzz_require((size_t)field.width * (size_t)field.height <= size, "a height takes a byte at least");
    fuzz_use(heights_smith(&field, 1.3));
    int good = heights_slopes(&field, 1, "fuzz", &slopes, &why);
    heights_free(&field);
    judge(&slopes, good, &why);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    const height_form plain = {0, 0, 0, 0}, raw = {32, (int)(size / 128), 0.5, 0.25};
    const uint8_t *bytes = size ? data : (uint8_t *)text;
    slope_set slopes;
    notes said = {"", 0};
    refusal why = {""};
    try_heights(bytes, size, &plain);
    try_heights(bytes, size, &raw);
    int good = maps_read(&slopes, "fuzz", bytes, size, &said, &why);
    judge(&slopes, good, &why);
}
