/* Evidence: what it costs to sample, and what a sample is worth; the inside of `vndf bench` and `vndf report`.
 *
 *     method.h     what a method is, the blocks of inputs it runs over, and the row of numbers that is measured of it;
 *                  the methods are in methods/, materials with their sets of effects among them
 *     row.c        the one list of columns, the printers
 *     list.c       which methods of which distributions: entries, made ready, and which of them are needed
 *     verify.c     whether the results of a method are right, before it is timed
 *     worth.c      error and variance of a method from one direction
 *     evidence.c   all of these in order, and time in turns, into rows
 *     measure/     what `vndf check` asks: chi-square, hard cases and agreement of calls; points of Sobol'
 *     page/        what `vndf report` writes
 *
 * All methods run in one process and take turns; each is verified before its time counts. */
#ifndef TOOLS_EVIDENCE_EVIDENCE_H
#define TOOLS_EVIDENCE_EVIDENCE_H

#include "cli/progress.h"
#include "evidence/method.h"
#include "vndf_build.h"

/* ---- what is asked ------------------------------------------------------------------------------- */

/* Both axes of what accuracy costs; and a table so fine that it stands for D itself. */
typedef struct table_size {
    size_t bytes;
    int moments;
    const char *name;
} table_size;

enum { SIZES = 10, SIZE_DEFAULT = 8, SIZE_FINE = 9, MATERIALS_MAX = 8, ENTRIES_MAX = 256 };
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

typedef struct evidence_plan {
    subject *at_hand; /* normals: its tables, the closed forms, and the published methods; NULL: materials */
    struct {
        const char *name;
        const vndf_distribution *distribution;
    } of[MATERIALS_MAX]; /* of materials */
    size_t count;
    float alpha_x, alpha_y;
    double theta;     /* of the direction that variance is measured for */
    const char *only; /* NULL, or a part of the method, distribution or instructions of the rows wanted */
    double seconds;   /* to spend in all, roughly; building the tables may take longer */
    progress *progress;
    double start; /* on the clock */
} evidence_plan;

/* Shows how far the work is. 0: the user wants to stop. */
int evidence_go_on(const evidence_plan *plan, const char *what);

/* Builds table i if it was not. NULL and an error, "interrupted" for one, if it cannot be. */
const vndf_distribution *subject_table(subject *s, size_t i, const evidence_plan *plan, vndf_error *error);

/* VNDF_OK and rows that the caller frees, or the status and error that stopped it. */
vndf_status evidence_run(const evidence_plan *plan, evidence_rows *found, vndf_error *error);

/* ---- entries ------------------------------------------------------------------------------------- */

/* What is timed: each, shared, eval, density of a method. */
enum { SERIES = 4, TURNS_MOST = 501 };

typedef struct entry entry;
struct entry {
    method m;
    const method_reference *of;
    block_law law;
    int is_shown, is_needed; /* needed: shown, or the yardstick of what is */
    entry *beside;           /* what its time is compared with: caps or bare reflection; NULL: nothing */
    entry *normals;          /* what its worth is compared with: all normals, of materials visible ones; or NULL */
    double variance[3]; /* of normals, for efficiencies: of the albedo at 60 and 85 degrees, of the small light */
    double ns[SERIES][TURNS_MOST]; /* of each turn */
    evidence_row row;
};

typedef struct evidence_list {
    entry entry[ENTRIES_MAX];
    size_t count;
    subject student; /* time for a D that everybody has, beside that at hand */
    method_reference reference[MATERIALS_MAX];
    const evidence_plan *plan;
    vndf_error *error;
} evidence_list;

/* Everything the plan asks for: at most 8 x 28 materials fit. Free it whatever this returns; an error if a table
 * or a material cannot be made or `only` fits nothing. */
vndf_status evidence_list_make(evidence_list *list, const evidence_plan *plan, vndf_error *error);
void evidence_list_free(evidence_list *list);

/* Whether the method's results are right: unit normals above the surface that face wi (where the method says
 * so), densities positive and finite, the same bits as the scalar call where that is promised; of materials
 * samples, values and densities that agree. */
int evidence_verify(const method *m, const block_law *law, block *b, uint64_t seed);

/* What a few samples of a method from one direction show, roughness 1/2 at the scale of the reference. */
typedef struct findings {
    double albedo, albedo_noise; /* mean, and its standard error */
    double variance;             /* of one sample */
    double light_variance;
    double tv, max_weight;
} findings;

/* `replicates` blocks of samples. */
void worth_of_normals(const method *m, const method_reference *reference, double theta, size_t replicates,
                      block *b, findings *found);

/* Fills mean, noise, lost, weight and variance from twice `blocks` blocks. 0: the two halves disagree. */
int worth_of_material(const method *m, const block_law *law, double theta, block *b, size_t blocks,
                      evidence_row *found);

/* Index of refraction n + ik, cosine of the angle to the microfacet: reflectance of unpolarised light. */
double worth_fresnel(double cosine, double n, double k);

#endif
