#include "measured/measured.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void note(data_file *file, const char *format, ...)
{
    size_t used = strlen(file->notes), room = sizeof file->notes - used;
    va_list list;
    va_start(list, format);
    int length = vsnprintf(file->notes + used, room, format, list);
    va_end(list);
    int fits = length >= 0 && (size_t)length + 1 < room;
    memcpy(file->notes + used + (fits ? (size_t)length : 0), fits ? "\n" : "", fits ? 2 : 1);
}

int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count, data_file *file)
{
    double *x = calloc(2 * count, sizeof *x);
    *made = (profile){over, of, x ? count : 0, x, x ? x + count : NULL};
    return x != NULL || refuse(file, "there is no memory for %zu rows", count);
}

void profile_free(profile *freed)
{
    free(freed->x);
    *freed = (profile){freed->over, freed->of, 0, NULL, NULL};
}

vndf_source *profile_source(const profile *from, data_file *file)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_rows(from->over, from->of, from->x, from->value, from->count, NULL, &error);
    if (!source)
        refuse(file, "what was found is no curve: %s", error.message);
    return source;
}

int profile_write(FILE *file, const profile *from, const char *title)
{
    fprintf(file, "# %s\n", title);
    fprintf(file, "%s,%s\n", from->over == VNDF_ROWS_OVER_SLOPE ? "slope" : "theta",
            from->of == VNDF_ROWS_OF_P22 ? "p22" : "ndf");
    for (size_t i = 0; i < from->count; i++)
        fprintf(file, "%.17g,%.17g\n", from->x[i], from->value[i]);
    return fflush(file) == 0 && !ferror(file);
}
