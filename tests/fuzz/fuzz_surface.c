/* No bytes crash the readers of heights and of normal maps: they are refused with a message that names the file, or
 * their slopes are finite; and no slopes crash what looks for their law: its rows are a curve, or it says why not. */
#include "fuzz/measured.h"
#include "measured/surface.h"

static void judge(slope_set *slopes, int good, data_file *file)
{
    profile rows = {0};
    fuzz_require(good || strncmp(file->refused, "fuzz: ", 6) == 0, "a message begins with the file");
    fuzz_require(good || slopes->at == NULL, "what is refused holds no memory");
    for (size_t i = 0; i < slopes->count; i++)
        fuzz_require(isfinite(slopes->at[i].x) && isfinite(slopes->at[i].y), "slopes are finite");
    if (good && slopes_law(slopes, file, &rows)) {
        vndf_source *source = profile_source(&rows, file);
        fuzz_require(source != NULL && rows.count >= 4, "rows are a curve");
        fuzz_require(strstr(file->notes, "nan") == NULL, "what is said is a number");
        vndf_source_free(source);
    } else
        fuzz_require(strncmp(file->refused, "fuzz: ", 6) == 0 && rows.x == NULL,
                     "a refused law has a reason alone");
    profile_free(&rows);
    slopes_free(slopes);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    height_field field;
    slope_set slopes = {0};
    data_file heights = fuzz_file(size ? data : (uint8_t *)text, size), normals = heights;
    int good = heights_read(&heights, &field);
    fuzz_require(good || field.z == NULL, "refused heights hold no memory");
    fuzz_require(!good || (size_t)field.width * (size_t)field.height <= size, "a height takes a byte at least");
    good = good && heights_slopes(&field, 1, &slopes, &heights);
    heights_free(&field);
    judge(&slopes, good, &heights);
    good = normals_slopes(&normals, &slopes);
    judge(&slopes, good, &normals);
}
