/* The cost and the worth of each effect of vndf_bsdf.h: the inside of `vndf bench effects`.
 *
 *     open.c          distributions
 *     set.c           the sets of effects, and the materials made of them
 *     run.c           the loops that are timed, with the library
 *     batch.c         the same over its batch calls
 *     hand.c          bare reflection by hand, as a user would write it over vndf.h
 *     caps.c          the same for GGX without the library
 *     list.c          which sets of which distributions
 *     block.c         inputs
 *     worth.c         verification; mean, lost samples, largest weight and variance
 *     time.c          time, in turns
 *     print.c         tables for people, and all numbers as CSV */
#ifndef TOOLS_BENCH_EFFECTS_EFFECTS_H
#define TOOLS_BENCH_EFFECTS_EFFECTS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "cli/figures.h"
#include "cli/progress.h"
#include "vndf_bsdf.h"

/* ---- sets --------------------------------------------------------------------------------------- */

typedef enum effects_kind {
    EFFECTS_LIBRARY, /* vndf_bsdf_at */
    EFFECTS_ROUGH,   /* vndf_bsdf_rough, a roughness for each hit */
    EFFECTS_BATCH,   /* vndf_bsdf_sample_n and the like */
    EFFECTS_BY_HAND, /* bare reflection written over vndf.h */
    EFFECTS_BY_CAPS, /* bare reflection of GGX written without the library */
    EFFECTS_KINDS
} effects_kind;

typedef struct effects_set {
    const char *name;
    effects_kind kind;
    vndf_effects effects;
    int stretched;       /* alpha_y is a quarter of alpha_x */
    int inside;          /* wi comes from below */
    const char *visible; /* the set with visible normals that efficiency is compared with; NULL: none */
} effects_set;

extern const effects_set effects_sets[];
extern const size_t effects_set_count;

/* The set of that name, or NULL. */
const effects_set *effects_find(const char *name);

/* ---- work -------------------------------------------------------------------------------------- */

enum { EFFECTS_BLOCK = 1024, EFFECTS_SHARE = 256 };

/* An input; evaluation reads wo. Inputs are whole, as renderers have them, and no arrays of floats: see method.h. */
typedef struct effects_input {
    vndf_vec3 wi, wo;
    float u[3];
} effects_input;

/* The same for batches: wi, wo and u as arrays, and results. */
enum { EFFECTS_ARRAYS_IN = 9 };

typedef struct effects_arrays {
    float in[EFFECTS_ARRAYS_IN][EFFECTS_BLOCK], wo[3][EFFECTS_BLOCK], wm[3][EFFECTS_BLOCK];
    float weight[3][EFFECTS_BLOCK], density[EFFECTS_BLOCK];
    uint8_t lobe[EFFECTS_BLOCK];
} effects_arrays;

typedef struct effects_loops effects_loops;

/* A set made ready for one distribution and roughness. Do not copy: hits point to its material. */
typedef struct effects_subject {
    const effects_set *set;
    const effects_loops *loops;
    vndf_surface surface;
    vndf_mixture mixture; /* its first lobe is the affine surface of sets that have one */
    vndf_albedo *albedo;  /* owned; NULL unless energy is compensated */
    vndf_material material;
    const vndf_roughness *roughness; /* of the hits of a block, for EFFECTS_ROUGH */
} effects_subject;

typedef struct effects_job {
    const effects_subject *of;
    const effects_input *in;
    vndf_scattered *out; /* eval leaves its values in weight, pdf in density */
    size_t count;
    effects_arrays *arrays; /* of the block, */
    size_t first;           /* where the job's begin */
} effects_job;

/* Copies inputs into the arrays, for all sets, and results from there, for those of EFFECTS_BATCH. */
void effects_pack(const effects_job *job);
void effects_unpack(const effects_job *job);

typedef void effects_loop(const effects_job *job);

/* Loops with a hit for each sample, and loops that share the hit of the first input. */
struct effects_loops {
    effects_loop *each, *shared, *eval, *pdf;
};

extern const effects_loops effects_loops_library, effects_loops_rough, effects_loops_batch;
extern const effects_loops effects_loops_by_hand, effects_loops_by_caps;

/* VNDF_OK, or why the set cannot be made. */
vndf_status effects_subject_make(effects_subject *subject, const effects_set *set, const vndf_surface *surface,
                                 vndf_error *error);

/* The cosine of w that goes with values: to the normal of the mean plane. */
double effects_cosine(const effects_subject *subject, vndf_vec3 w);

/* ---- inputs ------------------------------------------------------------------------------------- */

typedef struct effects_block {
    effects_input in[EFFECTS_BLOCK];
    vndf_scattered out[EFFECTS_BLOCK];
    vndf_roughness roughness[EFFECTS_BLOCK];
    effects_arrays arrays;
} effects_block;

/* Fills a block with the inputs of stream `seed`, the same for all sets except for the side of wi and wo. The
 * directions wo are uniform over the hemisphere, and so is wi if theta is NaN; else wi is at theta degrees. The block's
 * roughness is 0.5 to 1.5 times the subject's; the subject takes it over. */
void effects_fill(effects_block *block, effects_subject *subject, double theta, uint64_t seed);

/* Gives all inputs one direction, theta degrees from the normal. */
void effects_aim(effects_block *block, const effects_set *set, double theta);

/* The job of the whole block. */
effects_job effects_job_of(effects_block *block, const effects_subject *subject);

/* ---- rows --------------------------------------------------------------------------------------- */

/* A figure is NaN where it does not apply or was not measured. */
typedef struct effects_row {
    int wrong;                         /* 1: its results failed verification, so nothing was timed */
    double ns, ns_low, ns_high;        /* vndf_bsdf_at and vndf_bsdf_sample: median and quartiles of the turns */
    double to_bare;                    /* ns more than bare reflection: median over the turns of the difference */
    double shared_ns, eval_ns, pdf_ns; /* where EFFECTS_SHARE samples, values or densities share a hit */
    double mean, noise;                /* the mean weight of the first wavelength, and its standard error */
    double lost;                       /* part of samples */
    double max_weight, variance;
    double efficiency; /* 1/(variance ns) over that of visible normals */
} effects_row;

/* A row without figures. */
extern const effects_row effects_nothing;

enum { EFFECTS_NONE = -1, EFFECTS_DISTRIBUTIONS_MAX = 8 };

typedef struct effects_entry {
    effects_subject subject;
    const char *distribution;
    double theta;       /* of the directions that are timed; NaN: all over the hemisphere */
    double worth_theta; /* of the direction that variance is measured for */
    int of_variance;    /* belongs to the second table */
    int shown, needed;  /* an entry that is not shown may be needed as a yardstick */
    int bare, visible;  /* entries that to_bare and efficiency refer to, or EFFECTS_NONE */
    effects_row row;
} effects_entry;

typedef struct effects_list {
    effects_entry *entry;
    size_t count;
} effects_list;

typedef struct effects_named {
    const char *name;
    const vndf_distribution *distribution;
} effects_named;

typedef struct effects_plan {
    effects_named of[EFFECTS_DISTRIBUTIONS_MAX];
    size_t count;
    float alpha_x, alpha_y;
    double theta;     /* of the direction that variance is measured for */
    const char *only; /* NULL, or a part of the name of a set or distribution, or "variance" */
    double seconds;
    progress *progress;
} effects_plan;

/* An empty list and an error if `only` fits nothing or a set cannot be made. */
vndf_status effects_list_make(effects_list *list, const effects_plan *plan, vndf_error *error);
void effects_list_free(effects_list *list);

/* Sets row.wrong unless samples, values and densities are valid and agree. */
void effects_verify(effects_entry *entry, effects_block *block);

/* Fills mean, noise, lost, max_weight and variance from twice `blocks` blocks. Sets row.wrong if the two halves
 * disagree. */
void effects_weigh(effects_entry *entry, effects_block *block, size_t blocks);

/* Fills times, differences and efficiencies. VNDF_ERROR_ARGUMENT says that the user stopped it. */
vndf_status effects_time(effects_list *list, const effects_plan *plan, effects_block *block);

/* ---- printing ----------------------------------------------------------------------------------- */

/* Prints an effects_list: a rows_printer. */
int effects_print(FILE *file, const void *list, figures_form form);

#endif
