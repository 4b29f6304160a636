/* No bytes crash the readers of measured files - reflectances (.bsdf and MERL), heights, normal maps, hence PFM, PGM
 * and PPM: they are refused with a message that names the file and hold no memory then, or D is a curve over ascending
 * angles and slopes are finite; look-ups stay inside of an image; and no slopes crash what looks for their law: its
 * rows are a curve, or it says why not. */
#include "fuzz/fuzz.h"
#include "measured/measured.h"

static void judge(int good, profile *rows, const data_file *file)
{
    fuzz_require(good || (strncmp(file->error.message, "fuzz: ", 6) == 0 && rows->x == NULL),
                 "a refusal has a reason alone");
    for (size_t i = 0; good && i < rows->count; i++)
        fuzz_require(isfinite(rows->value[i]) && rows->value[i] >= 0 && (i == 0 || rows->x[i] > rows->x[i - 1]),
                     "rows are a curve");
    fuzz_require(strstr(file->notes, "nan") == NULL && strstr(file->notes, "inf") == NULL,
                 "what is said is finite");
    if (good)
        profile_free(rows);
}

static void judge_slopes(slope_set *slopes, int good, data_file *file)
{
    profile rows = {0};
    fuzz_require(good || slopes->at == NULL, "what is refused holds no memory");
    for (size_t i = 0; i < slopes->count; i++)
        fuzz_require(isfinite(slopes->at[i].x) && isfinite(slopes->at[i].y), "slopes are finite");
    judge(good && slopes_law(slopes, file, &rows), &rows, file);
    slopes_free(slopes);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    (void)data;
    const data_file file = {.name = "fuzz", .bytes = (const unsigned char *)text, .size = size};
    data_file bsdf = file, merl = file, heights = file, normals = file;
    profile rows = {0};
    image field;
    slope_set slopes = {0};
    float between[3];
    int good = rgl_read(&bsdf, &rows);
    judge(good, &rows, &bsdf);
    good = merl_read(&merl, MERL_GREEN, &rows);
    judge(good, &rows, &merl);
    good = heights_read(&heights, &field);
    fuzz_require(good || field.rgb == NULL, "refused heights hold no memory");
    fuzz_require(!good || (size_t)field.width * (size_t)field.height <= size, "a height takes a byte at least");
    for (int i = -8; i < 8 && good; i++)
        image_bilinear(&field, i * 0.37, i * 1.71, between);
    good = good && heights_slopes(&field, (const double[]){1, 1}, 1, &slopes, &heights);
    image_free(&field);
    judge_slopes(&slopes, good, &heights);
    good = normals_slopes(&normals, &slopes);
    judge_slopes(&slopes, good, &normals);
}
