/* What readers of measured files have to leave: a reason that names the file, or rows that are a curve. */
#ifndef TESTS_FUZZ_MEASURED_H
#define TESTS_FUZZ_MEASURED_H

#include "fuzz/fuzz.h"
#include "measured/data.h"

static inline data_file fuzz_file(const uint8_t *bytes, size_t size)
{
    data_file file = {.name = "fuzz", .bytes = bytes, .size = size};
    return file;
}

static inline void fuzz_judge(int good, profile *rows, const data_file *file)
{
    fuzz_require(good || (strncmp(file->refused, "fuzz: ", 6) == 0 && rows->x == NULL),
                 "a refusal has a reason alone");
    for (size_t i = 0; good && i < rows->count; i++)
        fuzz_require(isfinite(rows->value[i]) && rows->value[i] >= 0 && (i == 0 || rows->x[i] > rows->x[i - 1]),
                     "rows are a curve");
    fuzz_require(strstr(file->notes, "nan") == NULL && strstr(file->notes, "inf") == NULL,
                 "what is said is finite");
    if (good)
        profile_free(rows);
}

#endif
