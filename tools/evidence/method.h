/* A method: a way to draw normals, or a material that scatters light, as `vndf bench` measures it. It prepares what
 * depends on the distribution alone; what depends on the direction is part of each draw, or of SHARE draws of a run
 * whose samples share directions.
 *
 * A method is a few loops over a block of inputs. Scalar loops call what they time by name, so that the compiler
 * may inline it, and are compiled without vector loops (CMakeLists.txt). */
#pragma once

#include "vndf_bsdf.h"

typedef enum row_kind {
    ROW_PUBLISHED, /* others' methods, written from the publications */
    ROW_CLOSED,    /* our closed forms */
    ROW_TABLE,     /* our tables */
    ROW_EXPORTED,  /* the exported kernel in C */
    ROW_CALL,      /* other calls and surfaces of ours: times alone */
    ROW_EFFECT     /* a material: bare reflection and other sets of effects */
} row_kind;

/* ---- inputs and results -------------------------------------------------------------------------- */

/* Samples of a block; those that share a direction in one. BLOCK is a multiple of all vectors. */
enum { BLOCK = 1024, SHARE = 256 };

typedef struct method_input {
    vndf_vec3 wi, given; /* given: a normal, or of materials wo, to be evaluated */
    float alpha, u[3];   /* alpha: of both axes; of materials a factor of theirs */
} method_input;

/* The same inputs twice: batches read arrays, scalar calls whole inputs, as renderers have them. (To make a
 * vndf_vec3 from three arrays and pass it on costs some 40 ns with gcc 12, which stores four bytes at a time and
 * loads eight.) Some 150 KB, which stay in the second cache. */
typedef struct block {
    size_t count;            /* how many are run: all of them, unless a caller says less */
    vndf_instructions limit; /* of batches */
    float alpha[BLOCK], wi[3][BLOCK], given[3][BLOCK], u[3][BLOCK];
    method_input in[BLOCK];
    float x[BLOCK], y[BLOCK], z[BLOCK], pdf[BLOCK]; /* normals, or wo, with their densities */
    float value[3][BLOCK], half[3][BLOCK];          /* of batches of materials: weights and normals */
    uint8_t lobe[BLOCK];
    vndf_scattered out[BLOCK]; /* of single calls of materials; eval fills weight, pdf density */
} block;

typedef struct block_law {
    const vndf_distribution *seen; /* whose visible normals are given; NULL: directions wo are */
    float low, high;               /* of alpha */
    double theta;                  /* incident angle; NaN: directions uniform over the hemisphere */
    vndf_lobes lobes;              /* sides that wo is on */
} block_law;

/* Everything is a function of the seed, so that all methods of a turn have the same inputs. */
void block_fill(block *b, const block_law *law, uint64_t seed);

void block_aim(block *b, vndf_vec3 wi, float alpha);

void block_pack(block *b);

/* ---- methods ------------------------------------------------------------------------------------- */

typedef struct method method;
typedef void method_run(const method *m, block *b);

/* What is called of a distribution of ours: view, sample and density; other calls; surfaces beyond two
 * roughnesses; what is exported. */
typedef enum method_call {
    METHOD_SAMPLE,
    METHOD_WEIGHT,
    METHOD_PDF,
    METHOD_INVERT,
    METHOD_NDF,
    METHOD_LAMBDA,
    METHOD_SIXTEEN, /* samples of each direction */
    METHOD_AFFINE,
    METHOD_TWO_LOBES,
    METHOD_EIGHT_LOBES,
    METHOD_EXPORTED,
    METHOD_CALLS
} method_call;

struct method {
    char name[64];
    row_kind kind;
    size_t memory;              /* as in rows */
    const vndf_distribution *d; /* of ours: whose call it is */
    method_call call;
    const void *state;          /* what was prepared */
    void (*release)(void *);    /* NULL: there is nothing to be freed */
    method_run *each, *batch;   /* a direction each, by single calls and at once */
    method_run *shared;         /* the first direction of each SHARE for all of it */
    method_run *eval, *density; /* values and densities of materials, the same */
    int same_bits;              /* of a batch as of single calls */
    int turned;                 /* some normals face away from wi */
};

/* The loop of a scalar method's `each`. `one` is a constant there, so that the compiler inlines it. */
static inline void method_loop(vndf_vec3 (*one)(const method *m, const method_input *in, float *pdf),
                               const method *m, block *b)
{
    for (size_t i = 0; i < b->count; i++) {
        const vndf_vec3 wm = one(m, &b->in[i], &b->pdf[i]);
        b->x[i] = wm.x, b->y[i] = wm.y, b->z[i] = wm.z;
    }
}

/* Whether its batch runs here by a set of instructions. */
static inline int method_has_batch(const method *m, vndf_instructions set)
{
    return m->batch && vndf_instructions_used(set) == set;
}

/* D itself for methods of any D: a table so fine that it stands for it, or a closed form; and the scale that
 * brings its median slope to 1. */
typedef struct method_reference {
    vndf_surface canonical; /* its roughness is 1/scale */
    float scale;
    const char *name;
} method_reference;
method_reference method_reference_of(const vndf_distribution *d, const char *name);

void method_release(method *m);

/* Each makes a method; its `each` is NULL if memory is short. */

/* From the publications: GGX, with the batch of caps_batch.c; and any D. */
method method_ggx_caps(void);
void method_caps_batch(const method *m, block *b);
method method_all_normals(const method_reference *reference);
method method_warp(const method_reference *reference);

/* Ours. */
method method_ours(const vndf_distribution *d, const char *name, method_call call);

/* ---- sets of effects of vndf_bsdf.h, each a method that scatters light ---------------------------- */

typedef struct effect_set {
    const char *name;
    vndf_effects effects;
    int is_rough;        /* a roughness for each hit, by vndf_bsdf_on in the place of vndf_bsdf_at */
    int stretched;       /* alpha_y is a quarter of alpha_x */
    int turned;          /* and their axes are, by half a radian */
    int by_hand;         /* GGX alone: a loop over view and sample that knows its area, single calls alone */
    const char *visible; /* the set with visible normals that efficiency is compared with; NULL: none */
} effect_set;

enum { EFFECT_BARE = 0 }; /* bare reflection, which the others are compared with */

extern const effect_set effect_sets[];
extern const size_t effect_set_count;

/* A set made ready for one distribution and roughness, the state of its method. It stays where it was made: hits
 * point to its material. */
typedef struct effect_case {
    const effect_set *set;
    vndf_mixture mixture; /* its first lobe is the surface of sets that are turned */
    vndf_albedo *albedo;  /* owned; NULL unless energy is compensated */
    vndf_material material;
} effect_case;

/* A method without `each` and an error if the set cannot be made. */
method method_effect(const effect_set *set, const vndf_surface *surface, vndf_error *error);

block_law effect_law(const effect_set *set);

/* The cosine of w that goes with values: to the normal of the mean plane. */
double effect_cosine(const effect_case *of, vndf_vec3 w);
