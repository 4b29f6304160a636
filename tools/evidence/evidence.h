/* Evidence: what it costs to sample, and what a sample is worth; the inside of `vndf bench` and `vndf report`.
 *
 *     method.h     what a method is, and the blocks of inputs it runs over; the methods are in methods/, materials with
 *                  their sets of effects among them
 *     list.c       a row for each method of each distribution, made ready, and which of them are needed
 *     verify.c     whether the results of a method are right, before it is timed
 *     worth.c      error and variance of a method from one direction
 *     evidence.c   all of these in order, and time in turns, into the numbers of the rows
 *     row.c        the one list of columns, the printer
 *     measure/     what `vndf check` asks: certificates, chi-square, hard cases, agreement of calls; points of Sobol'
 *
 * All methods run in one process and take turns; each is verified before its time counts. */
#pragma once

#include "cli/figures.h"
#include "cli/progress.h"
#include "evidence/method.h"
#include "vndf_build.h"

/* ---- what is asked ------------------------------------------------------------------------------- */

/* Both axes of what accuracy costs; 0 bytes: what vndf_build makes by default; and a table so fine that it stands for D
 * itself. */
typedef struct table_size {
    size_t bytes;
    int moments;
    const char *name;
} table_size;

enum { SIZES = 11, SIZE_PLAIN = 3, SIZE_DEFAULT = 9, SIZE_FINE = 10 };
extern const table_size table_sizes[SIZES];

/* A D and its tables, which are built when they are wanted. */
typedef struct subject {
    char name[64];
    vndf_source *source;             /* owned */
    vndf_distribution *table[SIZES]; /* owned; NULL: not built yet */
} subject;

/* `name` is cut to fit. */
void subject_begin(subject *s, vndf_source *source, const char *name);
void subject_free(subject *s);

/* Normals: the tables of the D at hand, the closed forms, and the published methods; or materials of GGX, Beckmann and
 * the default table of that D, each with every set of effects. */
typedef struct evidence_plan {
    subject *at_hand;
    int is_of_materials;
    float alpha_x, alpha_y; /* of materials; and the direction that their variance is measured for */
    double theta;
    const char *only; /* NULL, or a part of the method or distribution of the rows wanted */
    double seconds;   /* to spend in all, roughly; building the tables may take longer */
    progress *progress;
    double start; /* on the clock */
} evidence_plan;

/* Shows how far the work is. 0: the user wants to stop. */
int evidence_go_on(const evidence_plan *plan, const char *what);

/* Builds table i if it was not. NULL and an error, "interrupted" for one, if it cannot be. */
const vndf_distribution *subject_table(subject *s, size_t i, const evidence_plan *plan, vndf_error *error);

/* ---- rows: what is measured of one method for one distribution ----------------------------------- */

typedef enum evidence_column {
    COL_ALPHA_X, /* of materials: roughness */
    COL_ALPHA_Y,
    COL_MEMORY, /* bytes that its tables take when loaded; 0 for closed forms */
    COL_FILE,   /* bytes of the file of a table of ours */
    COL_MOMENTS,
    COL_WRONG,    /* 1: its results failed verification, so nothing was timed */
    COL_NS,       /* per sample, a direction each (view, sample, density; hit and sample): median of the turns */
    COL_PORTABLE, /* the same in a batch, by three sets of instructions */
    COL_AVX2,
    COL_AVX512,
    COL_SHARED, /* SHARE samples, values, densities of one direction or hit */
    COL_EVAL,
    COL_PDF,
    COL_SPREAD,   /* half of what lies between the quartiles of ns, over its median */
    COL_RATIO,    /* ns over that of spherical caps, or of bare reflection, of the same run */
    COL_TV,       /* largest total variation to the true visible normals from above the horizon */
    COL_TV_BELOW, /* of tables of ours: from all directions */
    COL_WEIGHT,   /* largest true/drawn density that was met; of materials the largest weight */
    COL_SOBOL,  /* of ours: RMSE under 64 Owen-scrambled Sobol' points over that of caps (measure/stratified.c) */
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

/* What is timed of a method, in the order of COL_NS and the columns behind it: one by one; batches by each set of
 * instructions; shared, eval and density. */
enum { SETS = VNDF_INSTRUCTIONS_AVX512 + 1, SERIES = SETS + 3, TURNS_MOST = 501, ROWS_MAX = 96 };

typedef struct evidence_row evidence_row;
struct evidence_row {
    method m;
    const method_reference *of;
    block_law law;
    int is_shown, is_needed;        /* needed: shown, or the yardstick of what is */
    evidence_row *beside, *normals; /* what time is compared with, and what worth is; NULL: nothing */
    double variance[3]; /* of normals, for efficiencies: of the albedo at 60 and 85 degrees, of the small light */
    double ns[SERIES][TURNS_MOST]; /* of each turn */
    double number[COLUMNS];        /* NaN where it does not apply or was not measured */
};

typedef struct evidence {
    evidence_row row[ROWS_MAX];
    size_t count;
    method_reference reference[3];
    const evidence_plan *plan;
    vndf_error *error;
} evidence;

/* The rows that a plan asks for, measured; the subject of the plan has to outlive them. NULL and an error if something
 * stopped it. */
evidence *evidence_run(const evidence_plan *plan, vndf_error *error);
void evidence_free(evidence *of);

/* Text and Markdown are for people, without the columns that no row has. CSV and JSON have every number of every
 * row. 0 if there was no memory. */
int evidence_print(FILE *file, const evidence *all, figures_form form);

/* The same without the legend, to be freed; and that of normals. */
figures evidence_table(const evidence *all, figures_form form);
extern const char evidence_legend[];

/* ---- parts of it --------------------------------------------------------------------------------- */

/* All rows, not yet measured; an error if a table or a material cannot be made or `only` fits nothing. */
vndf_status evidence_list(evidence *to);

/* Whether the results of a method, or of its batch by a set of instructions, are right: unit normals above the surface
 * that face wi (where the method says so), densities positive and finite, the same bits as of single calls where that
 * is promised; of materials samples that are sane. BEST stands for single calls. There is a block behind b, too. */
int evidence_verify(const method *m, vndf_instructions set, const block_law *law, block *b, uint64_t seed);

/* What a few samples of a method from one direction show, roughness 1/2 at the scale of the reference. */
typedef struct findings {
    double albedo, albedo_noise; /* mean, and its standard error */
    double variance;             /* of one sample */
    double light_variance;
    double tv, max_weight;
} findings;

/* `replicates` blocks of samples. */
findings worth_of_normals(const method *m, const method_reference *reference, double theta, size_t replicates,
                          block *b);

/* Fills mean, noise, lost, weight and variance from `blocks` blocks. */
void worth_of_material(const method *m, const block_law *law, double theta, block *b, size_t blocks,
                       double found[COLUMNS]);
