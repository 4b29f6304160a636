/* The bytes of a table (src/table/file.c says what they are, in order), the masses of its rows and moments. */
#include "oracle/oracle_table.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Bytes not yet read; beyond their end all is 0 and `short_of` is set. */
typedef struct bytes {
    const unsigned char *at, *end;
    int short_of;
} bytes;

static uint64_t read_integer(bytes *b, size_t size)
{
    uint64_t value = 0;
    if ((size_t)(b->end - b->at) < size) {
        b->short_of = 1;
        return 0;
    }
    for (size_t i = 0; i < size; i++)
        value |= (uint64_t)b->at[i] << (8 * i);
    b->at += size;
    return value;
}

static double read_single(bytes *b)
{
    uint32_t bits = (uint32_t)read_integer(b, 4);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static double read_double(bytes *b)
{
    uint64_t bits = read_integer(b, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void skip_text(bytes *b)
{
    size_t n = (size_t)read_integer(b, 4);
    if ((size_t)(b->end - b->at) < n)
        b->short_of = 1;
    else
        b->at += n;
}

/* The next n numbers of the file, put behind those before. */
static double *read_numbers(bytes *b, double **free_place, size_t n)
{
    double *place = *free_place;
    for (size_t i = 0; i < n; i++)
        place[i] = read_single(b);
    *free_place += n;
    return place;
}

static void scale_rows(oracle_wedge *w)
{
    for (size_t i = 0; i < w->rows; i++) {
        double total = 0;
        for (size_t j = 0; j < w->cells; j++)
            total += w->mass[i * w->cells + j];
        for (size_t j = 0; j < w->cells; j++)
            w->mass[i * w->cells + j] /= total;
        for (size_t j = 0; j <= w->cells; j++)
            w->density[i * (w->cells + 1) + j] /= total;
    }
}

static void read_wedge(bytes *b, double **place, oracle_wedge *w)
{
    w->q = read_numbers(b, place, w->cells + 1);
    w->row_y = read_numbers(b, place, (w->rows + 1) / 2);
    w->aspect_p = read_numbers(b, place, w->rows);
    w->aspect_r = read_numbers(b, place, w->rows);
    w->mass = read_numbers(b, place, w->rows * w->cells);
    w->density = read_numbers(b, place, w->rows * (w->cells + 1));
    w->knot_y = read_numbers(b, place, w->knots);
    w->area = read_numbers(b, place, w->knots);
    w->slope = read_numbers(b, place, w->knots);
    w->curve = read_numbers(b, place, w->knots);
    scale_rows(w);
}

/* P22 R dR = f Z dxi, so a cell has z0 mu0 + z1 mu1 of the one moment and x0 mu0 + x1 mu1 of the other. */
static void add_up(oracle_table *t)
{
    t->total0 = t->total1 = 0;
    for (size_t j = 0; j < t->count; j++) {
        t->total0 += t->z[j] * t->mu0[j] + t->z[j + 1] * t->mu1[j];
        t->total1 += t->x[j] * t->mu0[j] + t->x[j + 1] * t->mu1[j];
    }
}

static int read_table(oracle_table *t, bytes b, size_t size)
{
    enum { HEAD = 16, CERTIFICATE = 12 };
    if (size < HEAD || memcmp(b.at, "VNDFtab\n\3\0\0", 11) != 0)
        return 0;
    b.at += HEAD;
    read_double(&b); /* normalization */
    t->scale = read_double(&b);
    t->count = (size_t)read_integer(&b, 4);
    for (int i = 0; i < 2; i++) {
        oracle_wedge *w = i ? &t->below : &t->above;
        w->cells = (size_t)read_integer(&b, 4);
        w->rows = (size_t)read_integer(&b, 4);
        w->knots = (size_t)read_integer(&b, 4);
    }
    for (int i = 0; i < CERTIFICATE; i++)
        read_single(&b);
    skip_text(&b);
    skip_text(&b);
    double *place = t->numbers = malloc(size / 4 * sizeof *place);
    size_t n = t->count, head = 6 * n + 2, all = head;
    for (int i = 0; i < 2; i++) {
        oracle_wedge *w = i ? &t->below : &t->above;
        all += w->cells + 1 + (w->rows + 1) / 2 + w->rows * (2 * w->cells + 3) + 4 * w->knots;
    }
    if (!place || b.short_of || (size_t)(b.end - b.at) != 4 * all + 4)
        return 0;
    t->x = read_numbers(&b, &place, n + 1);
    t->z = read_numbers(&b, &place, n + 1);
    t->f0 = read_numbers(&b, &place, n);
    t->f1 = read_numbers(&b, &place, n);
    t->mu0 = read_numbers(&b, &place, n);
    t->mu1 = read_numbers(&b, &place, n);
    read_wedge(&b, &place, &t->above);
    read_wedge(&b, &place, &t->below);
    add_up(t);
    return 1;
}

int oracle_table_read(oracle_table *t, const char *path)
{
    enum { MOST = 1 << 22 };
    FILE *file = fopen(path, "rb");
    unsigned char *all = malloc(MOST);
    size_t size = file && all ? fread(all, 1, MOST, file) : 0;
    memset(t, 0, sizeof *t);
    bytes b = {all, all + size, 0};
    int good = size > 0 && size < MOST && read_table(t, b, size);
    if (!good) {
        fprintf(stderr, "%s: no table that the oracle reads\n", path);
        oracle_table_free(t);
    }
    if (file)
        fclose(file);
    free(all);
    return good;
}

void oracle_table_free(oracle_table *t)
{
    free(t->numbers);
    memset(t, 0, sizeof *t);
}
