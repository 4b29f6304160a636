#include "measured/tensor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const unsigned char head[14] = "tensor_file\0\1\0";
enum { HEAD = sizeof head + 4 };

/* Bytes of a number. */
static const unsigned char sizes[] = {[TENSOR_U8] = 1, [TENSOR_F32] = 4};

size_t tensor_count(const tensor *of)
{
    size_t count = 1;
    for (int i = 0; i < of->dimensions; i++)
        count *= of->shape[i];
    return count;
}

/* ---- in ------------------------------------------------------------------------------------------ */

double tensor_at(const tensor *of, size_t i)
{
    return little_number((const unsigned char *)of->data + 4 * i, 4);
}

/* The numbers of a field whose dimensions begin at byte `at`: 0 and the reason if they do not fit the file. */
static int find_numbers(data_file *file, size_t at, uint64_t begin, tensor *found)
{
    uint64_t count = 1;
    for (int i = 0; i < found->dimensions; i++) {
        const uint64_t length = little_whole(file->bytes + at + 8 * (size_t)i, 8);
        if (length > file->size / (count ? count : 1))
            return refuse(file, "field '%s' is larger than the file", found->name);
        found->shape[i] = (size_t)length;
        count *= length;
    }
    if (begin > file->size || (file->size - begin) / sizes[found->type] < count)
        return refuse(file, "the numbers of field '%s' do not end before the file: it is cut off", found->name);
    found->data = file->bytes + begin;
    return 1;
}

int tensor_find(data_file *file, const char *name, int dimensions, tensor *found)
{
    const unsigned char *b = file->bytes;
    *found = (tensor){.name = name, .type = TENSOR_F32, .dimensions = dimensions};
    if (file->size == 0 || memcmp(b, head, file->size < 12 ? file->size : 12) != 0)
        return refuse(file, "this is no tensor file; it would begin with tensor_file");
    if (file->size < HEAD)
        return refuse(file, "this tensor file ends too early: it has %zu bytes, and its head takes %d", file->size,
                      HEAD);
    if (memcmp(b, head, sizeof head) != 0)
        return refuse(file, "a tensor file of version %d.%d; 1.0 is read", b[12], b[13]);
    const unsigned long count = (unsigned long)little_whole(b + sizeof head, 4);
    size_t at = HEAD;
    for (unsigned long i = 0; i < count; i++) {
        const size_t left = file->size - at, length = left >= 2 ? (size_t)little_whole(b + at, 2) : 0;
        const unsigned char *text = b + at + 2, *behind = text + length;
        const size_t fixed = 2 + length + 11; /* up to the lengths of dimensions */
        const size_t sides = left >= fixed ? (size_t)little_whole(behind, 2) : 0;
        if (left < fixed || left - fixed < 8 * sides)
            return refuse(file, "the list of fields is cut off at field %lu of %lu", i + 1, count);
        at += fixed + 8 * sides;
        if (length != strlen(name) || memcmp(text, name, length) != 0)
            continue;
        if (sides != (size_t)dimensions || behind[2] != TENSOR_F32)
            return refuse(file, "field '%s' has the type %d and %zu dimensions; the type %d and %d are needed",
                          name, behind[2], sides, TENSOR_F32, dimensions);
        return find_numbers(file, at - 8 * sides, little_whole(behind + 3, 8), found);
    }
    return refuse(file, "it has no field '%s'", name);
}

/* ---- out ----------------------------------------------------------------------------------------- */

/* Numbers begin at multiples of 8, for hosts that map files. */
int tensor_write(FILE *file, const tensor *fields, size_t count)
{
    uint64_t at = HEAD;
    for (size_t i = 0; i < count; i++)
        at += 2 + strlen(fields[i].name) + 2 + 1 + 8 + 8 * (uint64_t)fields[i].dimensions;
    const size_t gap = (size_t)((8 - at % 8) % 8);
    at += gap;
    fwrite(head, 1, sizeof head, file);
    put_little(file, count, 4);
    for (size_t i = 0; i < count; i++) {
        put_little(file, strlen(fields[i].name), 2);
        fputs(fields[i].name, file);
        put_little(file, (uint64_t)fields[i].dimensions, 2);
        put_little(file, (uint64_t)fields[i].type, 1);
        put_little(file, at, 8);
        for (int d = 0; d < fields[i].dimensions; d++)
            put_little(file, fields[i].shape[d], 8);
        at += (tensor_count(&fields[i]) * sizes[fields[i].type] + 7) / 8 * 8;
    }
    put_little(file, 0, gap);
    for (size_t i = 0; i < count; i++) {
        const size_t numbers = tensor_count(&fields[i]), size = sizes[fields[i].type];
        if (fields[i].type == TENSOR_F32)
            put_floats(file, fields[i].data, numbers);
        else
            fwrite(fields[i].data, 1, numbers, file);
        put_little(file, 0, (8 - numbers * size % 8) % 8);
    }
    return fflush(file) == 0 && !ferror(file);
}

/* ---- grids --------------------------------------------------------------------------------------- */

int warp_make(warp *made, const double *density, int width, int height)
{
    size_t w = (size_t)width, h = (size_t)height;
    double *along = calloc((w + 1) * h, sizeof *along);
    if (!along)
        return 0;
    *made = (warp){width, height, density, along, along + w * h};
    for (size_t y = 0; y < h; y++) {
        const double *row = density + y * w;
        double *sum = made->along + y * w;
        for (size_t x = 1; x < w; x++)
            sum[x] = sum[x - 1] + (row[x - 1] + row[x]) / 2;
        if (y > 0)
            made->up[y] = made->up[y - 1] + (sum[w - 1] + (sum - w)[w - 1]) / 2;
    }
    if (made->up[h - 1] > 0)
        return 1;
    warp_free(made);
    return 0;
}

void warp_free(warp *freed)
{
    free(freed->along);
    freed->along = freed->up = NULL;
}

/* In a cell whose density goes linearly from a to b: the place in [0, 1] with this mass before it. */
static double linear_place(double a, double b, double mass)
{
    double root = sqrt(fmax(a * a + 2 * mass * (b - a), 0)), sum = a + root;
    double place = sum > 0 ? 2 * mass / sum : 0;
    return place < 1 ? place : 1;
}

void warp_sample(const warp *of, double s_x, double s_y, double *x, double *y)
{
    int w = of->width, h = of->height, row = 0, column = 0;
    double mass = s_y * of->up[h - 1];
    while (row < h - 2 && of->up[row + 1] <= mass)
        row++;
    const double *low = of->along + (size_t)row * (size_t)w, *high = low + w;
    double v = linear_place(low[w - 1], high[w - 1], mass - of->up[row]);
    mass = s_x * ((1 - v) * low[w - 1] + v * high[w - 1]);
    while (column < w - 2 && (1 - v) * low[column + 1] + v * high[column + 1] <= mass)
        column++;
    const double *from = of->density + (size_t)row * (size_t)w + (size_t)column, *to = from + w;
    double a = (1 - v) * from[0] + v * to[0], b = (1 - v) * from[1] + v * to[1];
    double u = linear_place(a, b, mass - ((1 - v) * low[column] + v * high[column]));
    *x = (column + u) / (w - 1);
    *y = (row + v) / (h - 1);
}

void grid_fit(const float *value, const float *is_known, int side, int points, int steps, double *grid)
{
    double sum[FIT_SIDE_MAX * FIT_SIDE_MAX], whole[FIT_SIDE_MAX * FIT_SIDE_MAX];
    int fine = (side - 1) * points;
    memset(grid, 0, (size_t)(side * side) * sizeof *grid);
    for (int step = 0; step < steps; step++) {
        memset(sum, 0, sizeof sum);
        memset(whole, 0, sizeof whole);
        for (int i = 0; i < fine * fine; i++) {
            int y = i / fine, x = i % fine, corner = y / points * side + x / points;
            double v = (y % points + 0.5) / points, u = (x % points + 0.5) / points, left = (double)value[i];
            const int at[4] = {corner, corner + 1, corner + side, corner + side + 1};
            const double hat[4] = {(1 - v) * (1 - u), (1 - v) * u, v * (1 - u), v * u};
            if (is_known && !(is_known[i] > 0))
                continue;
            for (int k = 0; k < 4; k++)
                left -= hat[k] * grid[at[k]];
            for (int k = 0; k < 4; k++) {
                sum[at[k]] += hat[k] * left;
                whole[at[k]] += hat[k];
            }
        }
        for (int i = 0; i < side * side; i++)
            grid[i] += whole[i] > 0 ? sum[i] / whole[i] : 0;
    }
}
