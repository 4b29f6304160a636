/* Stand-in until the run time's own: the draft of a table, which the builder fills and vndf_table_encode writes. */
#ifndef VNDF_TABLE_TABLE_H
#define VNDF_TABLE_TABLE_H

#include "vndf.h"

enum { VNDF_CELLS_MAX = 1023, VNDF_SQUARINGS_MAX = 5 };

typedef struct vndf_table_draft {
    unsigned cells, moments, squarings; /* cells = N; arrays hold N + 1 numbers */
    float *knot, *g0, *g1, *m0, *m1, *m2, *m4, *b0, *b1, *area, *slope; /* slope = da */
    double normalization, scale;
    vndf_certificate certificate;
    const char *source, *tool;
} vndf_table_draft;

/* Writes the table into bytes[0..capacity); returns the size that the whole takes, whether it fitted. */
size_t vndf_table_encode(const vndf_table_draft *draft, unsigned char *bytes, size_t capacity);

/* The numbers of a table as they were built; nothing to free. */
vndf_table_draft vndf_table_draft_of(const vndf_distribution *table);

int vndf_is_table(const vndf_distribution *distribution);

#endif
