/* vndf.h - sampling of visible normals for any isotropic distribution: the run time.
 *
 * README.md has an example.
 *
 *     distributions   vndf_load, vndf_load_memory, vndf_free; vndf_ggx, vndf_beckmann; vndf_distribution_info
 *     surfaces        vndf_surface {distribution, matrix, mean slope}, made by vndf_rough from alpha_x and alpha_y;
 *                     vndf_mixture of up to eight surfaces with weights
 *     one direction   vndf_view_from: a view; then vndf_sample, vndf_sample_weight, vndf_pdf, vndf_visible,
 *                     vndf_invert; vndf_mixture_view_from with calls of its own
 *     any direction   vndf_ndf, vndf_p22, vndf_projected_area, vndf_lambda, vndf_g1, vndf_g2, and the same
 *                     with vndf_mixture_
 *     many at once    the same calls with _n at their ends, for surfaces and mixtures
 *     families        vndf_family_load, vndf_family_at: a parameter of the distribution that is a texture
 *     GPUs            vndf_numbers, and the kernels of `vndf export`
 *
 * Conventions. Local frame: z is the geometric normal, x the axis of alpha_x. Directions are unit vectors that
 * point away from the surface; wi is the known direction, wm a microfacet normal (wm.z >= 0), whose slope is
 * (-wm.x/wm.z, -wm.y/wm.z). The density of normals D is per steradian with integral D(wm) cos(theta_m) dwm = 1,
 * and P22 = D cos^4(theta_m) is the density of slopes. The roughness stretches the distribution that the table was
 * built from, so alpha = 1 is the distribution as the builder received it:
 *
 *     D(wm) = P22(x/alpha_x, y/alpha_y) / (alpha_x alpha_y cos^4(theta_m)).
 *
 * The visible normals (Heitz & d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
 * Visible Normals", EGSR 2014) have the density Dv(wm) = max(0, wi.wm) D(wm)/A(wi) per steradian; the projected
 * area A(wi) is integral max(0, wi.wm) D(wm) dwm. All directions wi are valid, from 0 to 180 degrees from the
 * normal: from below the horizon a ray inside the microsurface sees the surface.
 *
 * Densities. A sample returns the density with which it was drawn, by a formula in the numbers of the table. An
 * estimator that divides by this density is unbiased at every size of the table: a coarse table costs variance,
 * never bias. The density is positive wherever the true one is, and the certificate holds the largest ratio of
 * both. No density is zero, infinite or NaN, and no normal is turned away from wi. The run time computes in float.
 * The density is right to 1e-5 for a normal at most one float rounding (2^-23) from the returned one. Beside
 * vndf_pdf of the normal returned it is within 1e-5 for 99.9% of the samples and 1e-4 for 99.99% above the horizon,
 * 1e-4 and 1e-3 below it, where alpha times the scale of the table is at least 0.02 and no lobe of D is narrower than a
 * tenth of its slope: there one rounding of wm moves the density itself.
 *
 * Errors. Calls that allocate, read or write take a vndf_error*, which the caller owns and which may be NULL.
 * Calls on values (sample, pdf, ...) cannot fail: valid input gives finite results, and vndf_view_from states the
 * result of invalid input. The library keeps no state: distributions are immutable, and any number of threads may
 * call every function at once.
 *
 * Same bits everywhere. Single calls and batches, gcc and clang, -O0 and -O3, SSE2, AVX2, AVX-512 and NEON agree to
 * the bit, but where denormals are flushed to zero: every function of this header uses only + - * / sqrt,
 * comparisons, conversions and the bits of numbers, without contraction. That needs IEEE 754 floats, rounding to
 * nearest, and FLT_EVAL_METHOD 0 (32-bit x86: -msse2 -mfpmath=sse). Builds (vndf_build.h) use exp, log and pow of the
 * C library: the last digits of a new table depend on the machine, those of its samples do not. */
#ifndef VNDF_H
#define VNDF_H

#include <stddef.h>

#if defined(_WIN32) && defined(VNDF_SHARED)
#  ifdef VNDF_EXPORTS
#    define VNDF_API __declspec(dllexport)
#  else
#    define VNDF_API __declspec(dllimport)
#  endif
#elif defined(__GNUC__)
#  define VNDF_API __attribute__((visibility("default")))
#else
#  define VNDF_API
#endif

#define VNDF_VERSION_MAJOR 0
#define VNDF_VERSION_MINOR 1
#define VNDF_VERSION_PATCH 0
#define VNDF_VERSION "0.1.0"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum vndf_status {
    VNDF_OK = 0,
    VNDF_ERROR_ARGUMENT,     /* an argument of the call is outside its stated range */
    VNDF_ERROR_MEMORY,       /* no memory */
    VNDF_ERROR_IO,           /* a file cannot be opened, read or written; errno's text is in the message */
    VNDF_ERROR_TABLE,        /* the bytes are not a vndf table of a version this library reads */
    VNDF_ERROR_SYNTAX,       /* an expression, CSV or family name cannot be read; the message says where */
    VNDF_ERROR_DISTRIBUTION, /* the input cannot be the normals of a microsurface; the message says why */
    VNDF_ERROR_TARGET        /* no table meets the accuracy or size asked for; the message says what was reached */
} vndf_status;

/* What went wrong, in words for people. The caller owns it; a successful call leaves it untouched. */
typedef struct vndf_error {
    vndf_status status;
    char message[512];
} vndf_error;

typedef struct vndf_vec3 {
    float x, y, z;
} vndf_vec3;

/* The version of the library that runs, "0.1.0". Before 1.0 a minor version may change the members of the structs
 * below, so a program that loads the library itself compares this with VNDF_VERSION. */
VNDF_API const char *vndf_version(void);

/* ---- distributions ---------------------------------------------------------------------------- */

/* A distribution of normals: a table, or a closed form. It is immutable; threads may share it. */
typedef struct vndf_distribution vndf_distribution;

/* No table is larger, and no notes in it. Tables that vndf_build makes have at most 180 KiB. */
enum { VNDF_LIMIT_TABLE_BYTES = 1 << 23, VNDF_LIMIT_NOTES = 4096 };

/* Reads a table from a file or from memory, whose bytes are copied. NULL and an error if the file cannot be read,
 * or is not a whole, consistent table. No bytes crash the loader. Free the result with vndf_free. */
VNDF_API vndf_distribution *vndf_load(const char *path, vndf_error *error);
VNDF_API vndf_distribution *vndf_load_memory(const void *bytes, size_t size, vndf_error *error);

/* Frees a table; does nothing for NULL and the closed forms. */
VNDF_API void vndf_free(vndf_distribution *distribution);

/* GGX (Trowbridge-Reitz), P22(r) = 1/(pi (1 + r^2)^2), sampled by spherical caps (Dupuy & Benyoub, "Sampling
 * Visible GGX Normals with Spherical Caps", HPG 2023). It need not be freed. */
VNDF_API const vndf_distribution *vndf_ggx(void);

/* Beckmann, P22(r) = exp(-r^2)/pi: Lambda by erf, samples by an inverse of the CDF of slopes. It need not be freed. */
VNDF_API const vndf_distribution *vndf_beckmann(void);

/* What the builder measured: the table as it is stored against quadrature of the given D, for incident directions
 * from 0 to 180 degrees whose projected area at alpha = 1 exceeds 1e-10 of that at grazing incidence, but within
 * some 1e-9 radians of straight down. Each is at most a tenth, or 2e-5, too low. Slopes nearer to each other than
 * 2^-20 of themselves count as one. No slope is drawn beyond 1e26 times the median: what tails heavier than r^-3.2
 * have there is missing in tv and consistency. All members are zero for the closed forms.
 *
 * `hidden` and `finest` say how well the builder knew D. It bounds formulas and families between all points, and
 * knows every row of a CSV: then finest is 0, and at most the part `hidden` of the mass, or of the area at grazing
 * incidence, has escaped. A callback can only be sampled: then hidden is 1, and a feature narrower than `finest`
 * times its slope may have escaped. */
typedef struct vndf_certificate {
    float tv;       /* largest total variation distance between sampled and true visible normals */
    float tv_theta; /* the incident angle where it was found, degrees */
    float tv_above; /* the same over directions from 0 to 90 degrees */
    float tv_above_theta;
    float max_weight;     /* largest true/sampled density over the region that holds all but 1e-6 of the mass that
                           * a direction sees */
    float weight_bounded; /* 1 if true/sampled is bounded on the whole hemisphere, 0 if not */
    float area_error;     /* largest relative error of the projected area, hence of Lambda and G1 */
    float consistency;    /* largest |integral of the pdf - 1| */
    float ndf_error;      /* largest relative error of ndf() over the slopes that hold all but 1e-6 of the mass */
    float hidden;         /* the part that may have escaped, in [0, 1] */
    float finest;         /* relative width in slope of features that may have escaped; 0 if there are none */
    float horizon_power;  /* p < 0 if D grows as cos(theta_m)^p towards the horizon; 0 if D is bounded there */
    float floor_above; /* where tv_above ends at large sizes with these moments, to a tenth; higher for r^-3.1 */
    float floor;       /* the same of tv; small tables may stay a tenth below that */
} vndf_certificate;

/* What a distribution is. The strings belong to the distribution. */
typedef struct vndf_info {
    const char *source;   /* how it was made, as arguments of `vndf build`: "--slope exp(-r)" ... */
    const char *tool;     /* version that made it, "vndf 0.1.0" */
    const char *notes;    /* lines `key value` that a measurement left (vndf_source_note); or "" */
    size_t bytes;         /* size of the table file; 0 for closed forms */
    size_t memory;        /* bytes that the loaded table takes, all its allocations together; 0 for closed forms */
    size_t cells;         /* intervals of the slope length before the tail; 0 for closed forms */
    int moments;          /* 2, 3 or 4: see vndf_build_options; 0 for closed forms */
    double normalization; /* the given D or P22 was multiplied by this */
    double scale;         /* median slope length |(x, y)| under D cos(theta_m) at alpha = 1 */
    vndf_certificate certificate;
} vndf_info;

/* For NULL: empty texts and zeros. */
VNDF_API vndf_info vndf_distribution_info(const vndf_distribution *distribution);

/* The numbers of a table that the kernels of `vndf export` read from a buffer of the host
 * (tools/export/README.md): writes up to `capacity` of them to numbers[], which may be NULL if that is 0, and
 * returns how many there are, 8 and 20 for each of the cells + 1 knots; 0 for a closed form or NULL. */
VNDF_API size_t vndf_numbers(const vndf_distribution *distribution, float *numbers, size_t capacity);

/* ---- a surface and one incident direction ------------------------------------------------------ */

/* A surface, a plain value: its slopes are s = M u + mean, where u are slopes of the distribution and the matrix M =
 * (xx xy; yx yy) stretches, turns and shears them, as roughness, anisotropy along a direction and filtered normal maps
 * do. A mean slope (m, 0) with m > 0 leans the surface towards -x.
 *
 * With wi'.z = wi.z - wi.x mean.x - wi.y mean.y, the projection of wi on the mean plane, A(wi) - A(-wi) = wi'.z
 * takes the place of cos(theta) (Dupuy et al., "Linear Efficient Antialiased Displacement and Reflectance
 * Mapping", TOG 32(6), 2013): Lambda(wi) = A(wi)/wi'.z - 1 and G1(wi) = wi'.z/A(wi). A direction above the horizon
 * may be below the mean plane, wi'.z < 0: then G1 is 0, and Lambda(wi) = -1 - Lambda(-wi). */
typedef struct vndf_surface {
    const vndf_distribution *distribution;
    float xx, xy, yx, yy;
    float mean_x, mean_y;
} vndf_surface;

/* The surface with roughness alone, alpha_x and alpha_y along x and y; of other numbers than those above 0 it is
 * invalid. */
static inline vndf_surface vndf_rough(const vndf_distribution *distribution, float alpha_x, float alpha_y)
{
    const vndf_surface s = {
        distribution, alpha_x > 0.0f ? alpha_x : 0.0f, 0.0f, 0.0f, alpha_y > 0.0f ? alpha_y : 0.0f, 0.0f, 0.0f};
    return s;
}

/* A surface turned about z by the angle with this cosine and sine. Brushed metal under a normal map: the brush runs at
 * the angle phi from x, the roughness is `along` it and `across` it in the plane z = 0, and n is the normal of the
 * map, n.z > 0:
 *
 *     vndf_surface brushed = vndf_rotated(vndf_rough(metal, along, across), cosf(phi), sinf(phi));
 *     brushed.mean_x = -n.x / n.z;
 *     brushed.mean_y = -n.y / n.z;
 *     const vndf_view view = vndf_view_from(&brushed, wi);
 *     float pdf;
 *     const vndf_vec3 wm = vndf_sample(&view, u[0], u[1], &pdf);
 */
static inline vndf_surface vndf_rotated(vndf_surface s, float cosine, float sine)
{
    const vndf_surface turned = {s.distribution,
                                 cosine * s.xx - sine * s.yx,
                                 cosine * s.xy - sine * s.yy,
                                 sine * s.xx + cosine * s.yx,
                                 sine * s.xy + cosine * s.yy,
                                 cosine * s.mean_x - sine * s.mean_y,
                                 sine * s.mean_x + cosine * s.mean_y};
    return turned;
}

/* Everything that depends on a surface and wi alone: a plain value, valid while the distribution lives. */
enum { VNDF_VIEW_NUMBERS = 40 };

typedef struct vndf_view {
    const vndf_distribution *distribution; /* NULL marks an invalid view */
    vndf_vec3 wi;                          /* as it was given */
    float numbers[VNDF_VIEW_NUMBERS];      /* private */
} vndf_view;

/* wi may have any length: |x| + |y| + |z| within [1e-20, 1e20]. Invalid input gives an invalid view: NULL, another
 * length, NaN; and of the matrix times the scale of the distribution (vndf_info; 1 for closed forms) an entry above
 * 1e15, a determinant below 1e-15 times the largest entry or outside [1e-36, 1e36], and a mean slope above 1e6 along x
 * or y. From an invalid view samples are (0, 0, 1) with density 0, and all other results are 0.
 *
 * From straight above, wi.x = wi.y = 0 < wi.z, every normal is visible: the density is D(wm) cos(theta_m), and u1
 * turns the normal from -x through +x. From straight below no normal is visible: samples have density 0 and may be
 * turned away; so it is where |x| + |y| of M^T wi_xy, times that scale, is at most 1e-15 |wi'.z|. Where the singular
 * values of a sheared matrix are k apart, rounding moves a normal k times as far, and its density beside vndf_pdf with
 * it. */
VNDF_API vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi);

/* A visible normal from two uniform numbers in [0, 1] (a number outside is clamped, NaN is 0). It has unit length
 * within 4 ulps of 2^-23, wm.z >= 0 and wi.wm > 0. *pdf, unless NULL, receives the density per steradian with
 * which the normal was drawn, within [FLT_MIN, FLT_MAX].
 *
 * The map from (u1, u2) to the normal is continuous, and monotone in each number within rounding, so stratified
 * and quasi-random points keep their worth. In the frame of the slopes u, seen from (M^T wi_xy, wi'.z): of tables u2
 * moves the normal away from z, and u1 turns it about z over the visible arc, from its end behind wi (0) through the
 * side of wi (1/2) to the other end (1). Of GGX both move the direction that the normal mirrors wi to, in the same way.
 * Of Beckmann u1 moves the slope along wi, and u2 across it. */
VNDF_API vndf_vec3 vndf_sample(const vndf_view *view, float u1, float u2, float *pdf);

/* The same, and the weight vndf_visible/vndf_pdf: true density over drawn density, by which an estimator with Dv
 * in it is multiplied; faster than the three calls. The weight has the accuracy of the densities (head of this
 * file) and of the projected area (area_error of the certificate); it is finite, 0 where next to no area is seen from
 * below, and 1 for closed forms. `pdf` may be NULL. */
VNDF_API vndf_vec3 vndf_sample_weight(const vndf_view *view, float u1, float u2, float *pdf, float *weight);

/* The density per steradian with which vndf_sample draws wm, a unit vector: 0 where wm.z < 0 or wi.wm <= 0,
 * elsewhere at least FLT_MIN. */
VNDF_API float vndf_pdf(const vndf_view *view, vndf_vec3 wm);

/* The true density Dv(wm) = max(0, wi.wm) D(wm)/A(wi), per steradian; 0 where wm.z < 0. For the closed forms it
 * equals vndf_pdf. */
VNDF_API float vndf_visible(const vndf_view *view, vndf_vec3 wm);

/* The uniform numbers that vndf_sample turns into wm. Of the normals that vndf_sample drew 99.9% come back within
 * 1e-5 and 99.99% within 1e-4, measured between unit normals of the slopes u, or their numbers
 * come back within eight steps of 2^-24. Only the range [0, 1] is promised within 2^-22 of the border of the unit
 * square, for directions that see less than 1e-10 of the area at grazing incidence, and from straight below. */
VNDF_API void vndf_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

/* ---- many at once ------------------------------------------------------------------------------ */

/* The instruction sets that batches are compiled for. Results are the same to the bit. */
typedef enum vndf_instructions {
    VNDF_INSTRUCTIONS_BEST,     /* the best set of this machine */
    VNDF_INSTRUCTIONS_PORTABLE, /* 4 lanes by gcc and clang (SSE2, NEON), else one by one */
    VNDF_INSTRUCTIONS_AVX2,     /* 8 lanes */
    VNDF_INSTRUCTIONS_AVX512    /* 16 lanes; needs AVX-512 F, DQ, BW and VL */
} vndf_instructions;

/* The set that a batch runs on if it may go up to `limit`: one of the last three. */
VNDF_API vndf_instructions vndf_instructions_used(vndf_instructions limit);

enum { VNDF_SHARED_SURFACE = 1, VNDF_SHARED_WI = 2, VNDF_SHARED_WEIGHT = 4, VNDF_MIXTURE_LOBES = 8 };

/* Surfaces of one distribution, structure of arrays. Any of xy, yx, mean_x and mean_y may be NULL, for 0. */
typedef struct vndf_surface_batch {
    const vndf_distribution *distribution;
    const float *xx, *xy, *yx, *yy, *mean_x, *mean_y;
} vndf_surface_batch;

typedef struct vndf_lobe_batch {
    vndf_surface_batch surface;
    const float *weight;
} vndf_lobe_batch;

/* `count` surfaces and incident directions, the arguments of vndf_view_from. An array holds `count` numbers; if
 * its bit is set in `shared`, it points to one number that serves all elements. No array needs an alignment.
 * With `lobes` above 0 these are mixtures (below), and their lobes count in the place of `surface`. */
typedef struct vndf_batch {
    vndf_surface_batch surface;
    size_t count;
    unsigned shared; /* a sum of VNDF_SHARED_SURFACE, VNDF_SHARED_WI and VNDF_SHARED_WEIGHT, or 0 */
    vndf_instructions limit;
    const float *wi_x, *wi_y, *wi_z;
    int lobes;  /* 0, or the number of lobes of each mixture */
    int *drawn; /* NULL, or what receives the index of the lobe of each sample of a mixture, -1 if it is invalid */
    vndf_lobe_batch lobe[VNDF_MIXTURE_LOBES];
} vndf_batch;

/* Normals, structure of arrays, `count` each. */
typedef struct vndf_normals {
    float *x, *y, *z;
} vndf_normals;

/* Element i equals, to the bit, the result of the call for one element; weights of mixtures are vndf_mixture_visible
 * over the density, inverses those of the lobe that draws the normal most often. An array of results may be an array of
 * inputs that is not shared; apart from that arrays must not overlap. `pdf` of samples may be NULL. vndf_ndf_n does not
 * read wi; vndf_lambda_n, vndf_g1_n and vndf_projected_area_n take wi as their direction. Scratch is on the stack:
 * optimised, at most 32 KiB for any call of this header and vndf_bsdf.h but those that build albedos. */
VNDF_API void vndf_sample_n(const vndf_batch *batch, const float *u1, const float *u2, vndf_normals wm,
                            float *pdf);
VNDF_API void vndf_sample_weight_n(const vndf_batch *batch, const float *u1, const float *u2, vndf_normals wm,
                                   float *pdf, float *weight);
VNDF_API void vndf_pdf_n(const vndf_batch *batch, vndf_normals wm, float *pdf);
VNDF_API void vndf_visible_n(const vndf_batch *batch, vndf_normals wm, float *visible);
VNDF_API void vndf_invert_n(const vndf_batch *batch, vndf_normals wm, float *u1, float *u2);
VNDF_API void vndf_ndf_n(const vndf_batch *batch, vndf_normals wm, float *ndf);
VNDF_API void vndf_projected_area_n(const vndf_batch *batch, float *area);
VNDF_API void vndf_lambda_n(const vndf_batch *batch, float *lambda);
VNDF_API void vndf_g1_n(const vndf_batch *batch, float *g1);

/* ---- the distribution itself ------------------------------------------------------------------- */

/* D(wm) per steradian; 0 for wm.z < 0. wm is unit. */
VNDF_API float vndf_ndf(const vndf_surface *surface, vndf_vec3 wm);

/* P22 at the slope (x, y), per unit of slope area. */
VNDF_API float vndf_p22(const vndf_surface *surface, float x, float y);

/* A(w) = integral max(0, w.wm) D(wm) dwm for any w on the sphere, in [0, inf). Far below the horizon it may
 * underflow to 0, where samples and densities are right all the same. */
VNDF_API float vndf_projected_area(const vndf_surface *surface, vndf_vec3 w);

/* Smith's Lambda(w) = A(w)/cos(theta) - 1: >= 0 above the horizon, and Lambda(-w) = -1 - Lambda(w). It is never
 * infinite: at cos(theta) = 0 it is the largest float, with the sign of the side. */
VNDF_API float vndf_lambda(const vndf_surface *surface, vndf_vec3 w);

/* Smith's masking function 1/(1 + Lambda(w)) = cos(theta)/A(w), for w.wm > 0: in [0, 1] above the horizon, 0 below. */
VNDF_API float vndf_g1(const vndf_surface *surface, vndf_vec3 w);

/* How G2 correlates masking and shadowing (Heitz, "Understanding the Masking-Shadowing Function
 * in Microfacet-Based BRDFs", JCGT 2014). */
typedef enum vndf_g2_model {
    VNDF_G2_SEPARABLE,        /* G1(wi) G1(wo), eq. 98 */
    VNDF_G2_HEIGHT_CORRELATED /* 1/(1 + Lambda(wi) + Lambda(wo)), eq. 99 */
} vndf_g2_model;

/* G2: masking and shadowing for two directions above the horizon, in [0, 1]; 0 if either is below. */
VNDF_API float vndf_g2(const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model);

/* ---- several lobes on one surface --------------------------------------------------------------- */

/* A surface with D = sum of w_i D_i, w_i the weights divided by their sum: a core and a haze, or neighbours of a
 * family. A mixture is one microsurface, where a blend of BSDFs has several: it masks as a whole, A = sum of w_i
 * A_i, and Dv = sum of (w_i A_i/A) Dv_i (d'Eon et al., "Microfacet Theory for Non-Uniform Heightfields", SIGGRAPH
 * 2023). Weights are >= 0 and finite; a lobe of weight 0, or of one that is 0 when it is divided by the
 * largest, is not read. A plain value without memory of its own. */
typedef struct vndf_mixture_lobe {
    vndf_surface surface;
    float weight;
} vndf_mixture_lobe;

typedef struct vndf_mixture {
    int count; /* 1 to VNDF_MIXTURE_LOBES */
    vndf_mixture_lobe lobe[VNDF_MIXTURE_LOBES];
} vndf_mixture;

typedef struct vndf_mixture_part {
    vndf_view view;
    float weight, share;
    int lobe;
} vndf_mixture_part;

typedef struct vndf_mixture_view {
    int count;                                  /* 0 marks an invalid view */
    vndf_mixture_part part[VNDF_MIXTURE_LOBES]; /* private */
} vndf_mixture_view;

/* Invalid, with the results of an invalid vndf_view, are a count out of range, a weight that is negative or not
 * finite, weights that are all 0, and an invalid surface of a lobe whose weight is above 0. */
VNDF_API vndf_mixture_view vndf_mixture_view_from(const vndf_mixture *mixture, vndf_vec3 wi);

/* u1 picks a lobe by its interval of [0, 1], which is as long as w_i A_i/A; stretched to [0, 1] it draws, with u2,
 * from the lobe. The cost is one draw, and one density for each lobe. *pdf, unless NULL, receives the density of
 * the whole; *lobe, unless NULL, the index of the lobe, or -1 for an invalid view. The map is continuous and
 * monotone within each lobe. Where no lobe has an area that a float holds, weights pick, and the density may be 0. */
VNDF_API vndf_vec3 vndf_mixture_sample(const vndf_mixture_view *view, float u1, float u2, float *pdf, int *lobe);
VNDF_API float vndf_mixture_pdf(const vndf_mixture_view *view, vndf_vec3 wm);
VNDF_API float vndf_mixture_visible(const vndf_mixture_view *view, vndf_vec3 wm);

/* The numbers that draw wm from the lobe with this index; if `lobe` is -1, from the lobe that draws it most often.
 * Returns the index of the lobe, or -1 with numbers of 0 for an invalid view and for a lobe that is never drawn.
 */
VNDF_API int vndf_mixture_invert(const vndf_mixture_view *view, vndf_vec3 wm, int lobe, float *u1, float *u2);

/* Of the whole mixture. Its mean slope is the sum of w_i mean_i, and wi'.z = wi.z - wi.mean takes the place of
 * cos(theta), as for one surface. */
VNDF_API float vndf_mixture_ndf(const vndf_mixture *mixture, vndf_vec3 wm);
VNDF_API float vndf_mixture_p22(const vndf_mixture *mixture, float x, float y);
VNDF_API float vndf_mixture_projected_area(const vndf_mixture *mixture, vndf_vec3 w);
VNDF_API float vndf_mixture_lambda(const vndf_mixture *mixture, vndf_vec3 w);
VNDF_API float vndf_mixture_g1(const vndf_mixture *mixture, vndf_vec3 w);
VNDF_API float vndf_mixture_g2(const vndf_mixture *mixture, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model);

/* ---- families with a textured parameter --------------------------------------------------------- */

/* Distributions along one parameter, p_0 < p_1 < ...: a family whose tail, say, is a texture. At p between two of
 * these knots it is the mixture of both neighbours,
 *
 *     D = (1 - t) D_i + t D_i+1,    t = (p - p_i)/(p_i+1 - p_i),  or linear in 1/p where that takes fewer knots,
 *
 * for which samples and densities are exact. vndf_build_family (vndf_build.h) makes the tables, and measures how
 * far the mixture is from the family that is meant. Immutable; threads may share it. */
typedef struct vndf_family vndf_family;

enum {
    VNDF_LIMIT_FAMILY_KNOTS = 256,
    VNDF_LIMIT_FAMILY_BYTES = 1 << 26 /* of a file */
};

/* Reads what `vndf build --parameter` or vndf_family_save wrote, as vndf_load and vndf_load_memory do. Free the
 * result with vndf_family_free. */
VNDF_API vndf_family *vndf_family_load(const char *path, vndf_error *error);
VNDF_API vndf_family *vndf_family_load_memory(const void *bytes, size_t size, vndf_error *error);

/* A family of 1 to VNDF_LIMIT_FAMILY_KNOTS distributions of any kind, linear in its parameters, which are finite
 * and ascend. The arrays are copied. The caller frees the distributions, after the family and all its views. */
VNDF_API vndf_family *vndf_family_of(const vndf_distribution *const *distributions, const float *parameters,
                                     size_t count, vndf_error *error);

/* Frees the family, and the tables that came with its file; does nothing for NULL. */
VNDF_API void vndf_family_free(vndf_family *family);

/* What a family is. The strings belong to it. */
typedef struct vndf_family_facts {
    const char *source; /* "--family student-t --parameter 1.6..6"; empty without a file */
    const char *tool;   /* version that made it */
    size_t bytes;       /* size of the file; 0 without one */
    size_t memory;      /* bytes that its tables take, all together */
    size_t count;       /* knots */
    float low, high;    /* the first and the last parameter */
    int reciprocal;     /* 1 if mixtures are linear in 1/p, 0 if in p */
    float distance;     /* largest total variation distance between the slopes of family and mixture that was found
                         * between the knots; 0 without a file */
    float grazing;      /* the same of the normals that are visible at grazing incidence, which weighs the tail */
} vndf_family_facts;

/* For NULL: empty texts and zeros. */
VNDF_API vndf_family_facts vndf_family_info(const vndf_family *family);

/* Of the knot `index` < count: its parameter, its distribution, which belongs to the family, and the distance that
 * was found between it and the next knot (0 for the last). Any other index gives 0 and NULL. */
VNDF_API float vndf_family_parameter(const vndf_family *family, size_t index);
VNDF_API const vndf_distribution *vndf_family_distribution(const vndf_family *family, size_t index);
VNDF_API float vndf_family_distance(const vndf_family *family, size_t index);

typedef enum vndf_family_place {
    VNDF_FAMILY_INVALID, /* no family, no shape, or a parameter that is NaN: the mixture is invalid (count 0) */
    VNDF_FAMILY_INSIDE,
    VNDF_FAMILY_BELOW, /* the parameter was below the first knot, which was taken */
    VNDF_FAMILY_ABOVE  /* above the last one, likewise */
} vndf_family_place;

/* The family at a parameter, with the matrix and the mean slope of `shape`, whose distribution is not read: a
 * mixture of one lobe at a knot, of two between knots, with weights whose sum is 1, valid while the family lives.
 * Other lobes of *mixture are not written, so more may be added behind. Two families on one surface, of which the
 * second is 30%:
 *
 *     vndf_mixture whole, haze;
 *     vndf_family_at(metals, p, narrow, &whole);
 *     vndf_family_at(tails, q, wide, &haze);
 *     for (int i = 0; i < whole.count; i++)
 *         whole.lobe[i].weight *= 0.7f;
 *     for (int i = 0; i < haze.count; i++) {
 *         haze.lobe[i].weight *= 0.3f;
 *         whole.lobe[whole.count++] = haze.lobe[i];
 *     }
 *     const vndf_mixture_view view = vndf_mixture_view_from(&whole, wi);
 *     float pdf;
 *     const vndf_vec3 wm = vndf_mixture_sample(&view, u[0], u[1], &pdf, NULL);
 */
VNDF_API vndf_family_place vndf_family_at(const vndf_family *family, float parameter, const vndf_surface *shape,
                                          vndf_mixture *mixture);

#ifdef __cplusplus
}
#endif
#endif
