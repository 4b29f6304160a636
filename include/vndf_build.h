/* vndf_build.h - tables of visible normals from any isotropic distribution: the offline side.
 *
 *     sources     vndf_source_...: a distribution that a user brings, at any scale, normalised or not
 *     tables      vndf_build, vndf_save; vndf_certify measures a table
 *     families    vndf_build_family, vndf_family_save
 *
 * The conventions of vndf.h hold. */
#ifndef VNDF_BUILD_H
#define VNDF_BUILD_H

#include "vndf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- sources ----------------------------------------------------------------------------------- */

typedef struct vndf_source vndf_source;

/* A named number for an expression: name is [A-Za-z_][A-Za-z0-9_]*. */
typedef struct vndf_parameter {
    const char *name;
    double value;
} vndf_parameter;

/* D as a formula in c = cos(theta_m), theta (radians), t = tan(theta_m). + - * / ^, parentheses, numbers, pi,
 * parameters, and exp log log1p sqrt sin cos tan asin acos atan sinh cosh tanh erf erfc lgamma gamma abs min max pow
 * step(x) (1 for x >= 0, else 0). Names, constants and functions are case-sensitive. If the text cannot be read,
 * or does not use a parameter, returns NULL and an error that says where. The text and parameters are copied. */
VNDF_API vndf_source *vndf_source_ndf_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                                 vndf_error *error);

/* P22 as a formula in r = tan(theta_m), the slope length; the rest is as above. */
VNDF_API vndf_source *vndf_source_slope_expression(const char *text, const vndf_parameter *parameters,
                                                   size_t count, vndf_error *error);

/* A CSV: a header line that names the columns - one of theta_deg, theta, slope and one of ndf, p22 - then numbers, the
 * first column ascending. Blank lines and lines that begin with # are skipped. Shape-preserving interpolation joins the
 * rows. Beyond the last row P22 falls as the power of r that the last two rows give, at least as r^-4. A last row of
 * value 0 ends the support there; at 90 degrees it says that D vanishes as cos(theta_m) or faster. */
VNDF_API vndf_source *vndf_source_csv_file(const char *path, vndf_error *error);
VNDF_API vndf_source *vndf_source_csv_text(const char *name, const char *text, size_t size, vndf_error *error);

/* The same from numbers in memory: x[], theta_m in radians from 0 to pi/2 or the slope length, ascending from 0 or
 * above by more than 1e-12 of itself, and value[], D or P22, finite and not negative; 2 to VNDF_LIMIT_CSV_ROWS of
 * each. A row at 90 degrees (within 1e-9 radians) is for D alone. The numbers are copied. `name` says what they
 * are, and may be NULL; with a checksum of the numbers it becomes the provenance: "--rows NAME (crc32 ...)". If a
 * row is refused, returns NULL and VNDF_ERROR_DISTRIBUTION with its number, counted from 0. */
typedef enum vndf_rows_over { VNDF_ROWS_OVER_THETA, VNDF_ROWS_OVER_SLOPE } vndf_rows_over;
typedef enum vndf_rows_of { VNDF_ROWS_OF_NDF, VNDF_ROWS_OF_P22 } vndf_rows_of;
VNDF_API vndf_source *vndf_source_rows(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                                       size_t count, const char *name, vndf_error *error);

/* A family by name: ggx, beckmann, student-t:GAMMA, gtr:GAMMA, epd:P, abc:B,C or abc:MATERIAL,
 * sgd:ALPHA,P or sgd:MATERIAL/CHANNEL, hyper-cauchy:..., phong:N, charlie:A, mix:(...). vndf_family_help lists them.
 * Masking is Smith's of the same D in all of them, also of charlie, whose paper fits another. */
VNDF_API vndf_source *vndf_source_family(const char *specification, vndf_error *error);

/* One line per family with its parameters, ranges, formula and reference; a static string. */
VNDF_API const char *vndf_family_help(void);

/* The i-th measured material that is shipped ("sgd:alum-bronze/r", ..., "abc:two-layer-gold"), or NULL past the
 * last. */
VNDF_API const char *vndf_family_material(size_t index);

/* A C function: D(cos theta_m), or P22(r), which is better for narrow distributions (1 - cos loses digits). It
 * returns the same value for the same argument. The name is copied into the table as its provenance. A feature
 * narrower than 1e-3 of its slope can hide between the samples of a function. */
typedef double vndf_density_function(double x, void *user);
VNDF_API vndf_source *vndf_source_ndf_callback(vndf_density_function *ndf, void *user, const char *name,
                                               vndf_error *error);
VNDF_API vndf_source *vndf_source_slope_callback(vndf_density_function *p22, void *user, const char *name,
                                                 vndf_error *error);

/* The source that a table was built from, made again from the table's provenance. This works for expressions and
 * families; for other sources it returns NULL and VNDF_ERROR_ARGUMENT with the reason. */
VNDF_API vndf_source *vndf_source_of(const vndf_distribution *distribution, vndf_error *error);

/* P22(r) of the source as it was given, before normalisation; r >= 0. 0 for NULL. */
VNDF_API double vndf_source_p22(const vndf_source *source, double r);

/* How the source was given, as arguments of `vndf build`. The text belongs to the source; it is empty for NULL. */
VNDF_API const char *vndf_source_description(const vndf_source *source);

/* Puts other words in the place of that text, which tables keep as provenance, for programs that make rows or a
 * function out of data of their own: "--rgl leather.bsdf (crc32 0f3a22bc)". One line of 1 to
 * VNDF_LIMIT_NAME_LENGTH characters without control characters, its quotes closed; the text is copied.
 * VNDF_ERROR_ARGUMENT for any other line, for words that begin with --ndf, --slope or --family, and for a source
 * that was made by one of these. Not while a build reads the source. */
VNDF_API vndf_status vndf_source_describe(vndf_source *source, const char *words, vndf_error *error);

/* Puts notes that every table of the source keeps (vndf_info), for programs that measure: what was found, and what a
 * table leaves unsaid, as the matrix that it needs. Lines `key value` with a line feed behind each, at most
 * VNDF_LIMIT_NOTES characters, which count in max_bytes: a key of a to z, 0 to 9 and _, one blank, printable ASCII.
 * tools/measured/README.md has the keys that the verdict of `vndf` knows. VNDF_ERROR_ARGUMENT for any other lines. Not
 * while a build reads the source. */
VNDF_API vndf_status vndf_source_note(vndf_source *source, const char *notes, vndf_error *error);

VNDF_API void vndf_source_free(vndf_source *source);

/* ---- limits ------------------------------------------------------------------------------------ */

/* An input beyond a limit is refused with an error that names the limit. Builds are bounded by operations, not by
 * seconds, so that the same input gives the same result on every machine. An evaluation of P22 counts as 8
 * operations; of a formula, as families are, as 4, plus 8 for each power and function, plus 1 for each number, name and
 * other operator. An operation takes some 4 to 12 ns, so no formula takes more than minutes; a callback takes its own
 * time. Memory stays below 512 MiB. */
enum {
    VNDF_LIMIT_EXPRESSION_LENGTH = 4096, /* characters */
    VNDF_LIMIT_EXPRESSION_DEPTH = 64,    /* parentheses, calls, signs and powers inside one another */
    VNDF_LIMIT_PARAMETERS = 64,          /* of an expression */
    VNDF_LIMIT_PARAMETER_NAME = 64,      /* characters */
    VNDF_LIMIT_FAMILY_LENGTH = 4096,     /* characters of a family's specification */
    VNDF_LIMIT_NAME_LENGTH = 4096,       /* characters of the name of a CSV or a callback */
    VNDF_LIMIT_CSV_ROWS = 1 << 14,
    VNDF_LIMIT_CSV_LINE = 4096,     /* characters of a line */
    VNDF_LIMIT_CSV_BYTES = 1 << 24, /* of a file */
    VNDF_LIMIT_BUILD_PANELS = 60000 /* pieces in which P22 is smooth to 1e-10 */
};
#define VNDF_LIMIT_BUILD_OPERATIONS 1e10

/* ---- building ---------------------------------------------------------------------------------- */

/* The builder calls this when a new stage begins, and at least every 2^18 operations (see limits), which take some
 * milliseconds. `done` is the part that is done, in [0, 1]; `what` names the stage. Return 0 to go on, any other
 * value to stop the build (VNDF_ERROR_ARGUMENT, "interrupted"). */
typedef int vndf_progress(double done, const char *what, void *user);

/* Zeroed options are the defaults.
 *
 * Size and moments are what accuracy costs. Bytes buy cells: the slope length is drawn closer to D. Moments bound
 * how far the law of the slope length from one direction is from the visible one: above the horizon by 6.5e-2 with
 * 2 moments, 4.7e-3 with 3 and 7.2e-4 with 4, for every D, direction and roughness. Below the horizon the total
 * variation is some 3e-2 at most with any of them. Fewer moments take fewer bytes and less time. What moments leave
 * whatever the size is in the certificate: floor_above and floor.
 *
 * The default. If max_bytes and max_tv are both 0, the table has 64 knots, some 3000 bytes. If these do not reach
 * 1e-3 above the horizon and 3e-2 below it, it has as many more as do, to a fourth, or is the best of 8192 bytes. With
 * a max_tv of 1e-3 it may be smaller: that is not faster, since lanes hold 64 knots in registers, and its D and areas
 * err some ten times as much.
 *
 * Narrow features. The builder bounds formulas and families between all points by interval arithmetic, and reads
 * every row of a CSV. From slope 1e-30 to 1e30 at most 1e-5 of the mass, or of the area at grazing incidence,
 * escapes it: all hidden features together, however narrow they are, down to the spacing of doubles. It resolves
 * anything larger, or refuses the source and names the slope (VNDF_ERROR_DISTRIBUTION). A formula that cannot be
 * bounded, as one with gamma or lgamma of the slope, is refused. A callback can only be sampled: features narrower
 * than 1e-3 of their slope may escape; bring such a D as a formula or as rows. */
typedef struct vndf_build_options {
    size_t max_bytes; /* largest size of the file, from 2048 to 1 MiB; 0: 8192, see above */
    double max_tv; /* the smallest table that reaches this total variation above the horizon, and the lesser of 30
                    * times it and 5e-2 below: with a sixteenth fewer knots it does not. 0: the best that fits */
    vndf_progress *progress; /* may be NULL */
    void *progress_user;
    int moments; /* 2, 3 or 4; 0: 4 */
} vndf_build_options;

/* Builds a table. options and certificate may be NULL. Returns NULL and an error if the source cannot be the
 * normals of a microsurface (VNDF_ERROR_DISTRIBUTION, with the reason) or if the target cannot be met
 * (VNDF_ERROR_TARGET: the message says which size meets it, or what is left whatever the size, and whether more
 * moments leave less). Deterministic. Free the result with vndf_free. */
VNDF_API vndf_distribution *vndf_build(const vndf_source *source, const vndf_build_options *options,
                                       vndf_certificate *certificate, vndf_error *error);

/* Measures a table against a source: the certificate that vndf_build would write. */
VNDF_API vndf_status vndf_certify(const vndf_distribution *distribution, const vndf_source *source,
                                  vndf_certificate *certificate, vndf_error *error);

/* Writes the table to a file: first to a temporary file beside it, vndf.NUMBER.tmp, which is flushed to the disk and
 * renamed over path. If a step fails, the old file is whole and no temporary is left. A file that is replaced keeps its
 * permissions, and a symbolic link that leads to one stays; other hard links keep the old file. Anything but a regular
 * file is refused. A signal that ends the process meanwhile may leave the temporary: block it, as `vndf build` does. */
VNDF_API vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error);

/* The same to memory, for vndf_load_memory: `size` bytes, which is `bytes` of vndf_distribution_info. */
VNDF_API vndf_status vndf_save_memory(const vndf_distribution *distribution, void *bytes, size_t size,
                                      vndf_error *error);

/* ---- families ---------------------------------------------------------------------------------- */

/* Zeroed options are the defaults. The distance is the total variation between the slopes of the family and of the
 * mixture of neighbouring knots (vndf_family_at), by quadrature without tables, measured at VNDF_FAMILY_PROBES
 * parameters between each two knots: where the family changes smoothly, the largest is within a few percent of it.
 */
enum { VNDF_FAMILY_PROBES = 7 };

typedef struct vndf_family_options {
    double max_distance; /* as few knots as reach this distance; 0: 1e-3 */
    size_t knots;        /* so many knots instead, 2 to VNDF_LIMIT_FAMILY_KNOTS, placed for the least distance */
    size_t max_bytes;    /* of each table, as in vndf_build_options */
    int moments;         /* the same */
    vndf_progress *progress; /* may be NULL */
    void *progress_user;
} vndf_family_options;

/* Builds the tables of a family along one of its numbers, from `low` to `high`. The specification is that of
 * vndf_source_family with {p} where the number is, "abc:{p},0.8" or "mix:({p},1,ggx)+(1,0.1,beckmann)"; a family
 * with one number needs no {p}: "student-t". Mixtures are linear in p, or in 1/p where low > 0 and the distance is
 * less by a quarter at least. Parameters of knots have seven digits. NULL and an error as for vndf_build,
 * VNDF_ERROR_TARGET if 256 knots do not reach the distance. Free the result with vndf_family_free. */
VNDF_API vndf_family *vndf_build_family(const char *specification, double low, double high,
                                        const vndf_family_options *options, vndf_error *error);

/* Writes a family that was built or loaded, as vndf_save and vndf_save_memory do; vndf_family_info says its bytes.
 */
VNDF_API vndf_status vndf_family_save(const vndf_family *family, const char *path, vndf_error *error);
VNDF_API vndf_status vndf_family_save_memory(const vndf_family *family, void *bytes, size_t size,
                                             vndf_error *error);

#ifdef __cplusplus
}
#endif
#endif
