/* Rows of evidence: what was measured of one method for one distribution, a number for each column, and the one
 * list of columns that every printer reads. */
#ifndef TOOLS_EVIDENCE_ROW_H
#define TOOLS_EVIDENCE_ROW_H

#include <stddef.h>
#include <stdio.h>

#include "cli/figures.h"

typedef enum row_kind {
    ROW_PUBLISHED, /* others' methods, written from the publications */
    ROW_CLOSED,    /* our closed forms */
    ROW_TABLE,     /* our tables */
    ROW_EXPORTED,  /* the exported kernel in C */
    ROW_CALL,      /* other calls and surfaces of ours: times alone */
    ROW_EFFECT     /* a material: bare reflection and other sets of effects */
} row_kind;

typedef enum evidence_column {
    COL_ALPHA_X, /* of materials: roughness */
    COL_ALPHA_Y,
    COL_MEMORY, /* bytes that its tables take when loaded; 0 for closed forms */
    COL_FILE,   /* bytes of the file of a table of ours */
    COL_MOMENTS,
    COL_WRONG,  /* 1: its results failed verification, so nothing was timed */
    COL_NS,     /* per sample, a direction each (view, sample, density; hit and sample): median of the turns */
    COL_SPREAD, /* half of what lies between its quartiles, over the median */
    COL_RATIO,  /* ns over that of scalar spherical caps, or of bare reflection, of the same run */
    COL_SHARED, /* SHARE samples, values, densities of one direction or hit */
    COL_EVAL,
    COL_PDF,
    COL_TV,       /* largest total variation to the true visible normals from above the horizon */
    COL_TV_BELOW, /* of tables of ours: from all directions */
    COL_WEIGHT,   /* largest true/drawn density that was met; of materials the largest weight */
    COL_SOBOL,  /* of ours: RMSE under 64 Owen-scrambled Sobol' points over that of caps (measure/stratified.h) */
    COL_EFF_60, /* 1/(variance time) over that of all normals: albedo of gold at 60 and 85 degrees, a small light */
    COL_EFF_85,
    COL_EFF_LIGHT,
    COL_MEAN, /* of weights of a material from one direction: mean, its standard error, part of samples lost */
    COL_NOISE,
    COL_LOST,
    COL_VARIANCE,
    COL_EFF_VISIBLE, /* 1/(variance time) over that of visible normals */
    COLUMNS
} evidence_column;

/* A number is NaN where it does not apply or was not measured. */
typedef struct evidence_row {
    char method[64];       /* "spherical caps (2023)", "table 8 KiB, 4 moments", "bare reflection" ... */
    char distribution[64]; /* "ggx", "beckmann", the caller's name for a source */
    const char *instructions;
    row_kind kind;
    double number[COLUMNS];
} evidence_row;

typedef struct evidence_rows {
    evidence_row *row;
    size_t count;
} evidence_rows;

void rows_free(evidence_rows *of);

/* A rows_printer. Text and Markdown are for people, without the columns that no row has. CSV and JSON have every
 * number of every row. */
int evidence_print(FILE *file, const void *of, figures_form form);

#endif
