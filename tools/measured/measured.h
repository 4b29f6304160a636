/* Files of measurements, and the rows of D or P22 that every reader of them ends in, for vndf_source_rows. */
#pragma once

#include "cli/arguments.h"
#include "cli/files.h"
#include "render/image.h"
#include "vndf_build.h"

/* A file, whose bytes are not trusted, with a 0 behind them. A reader returns 1, or 0 with the reason in `error`: the
 * file, the place in it, what is wrong, what would be right. What it finds goes to `notes`, lines `key value`;
 * `implausible` is the key of what only a mistake explains. Members that are not given are zeroed. */
typedef struct data_file {
    const char *name;
    const unsigned char *bytes;
    size_t size;
    vndf_error error;
    char notes[4096];
} data_file;

/* "NAME: message"; 0, so that a reader can end with it. */
#define refuse(file, ...) refuse_at(&(file)->error, (file)->name, __VA_ARGS__)

/* Adds a line, unless it does not fit. */
void note(data_file *file, const char *format, ...) PRINTF_LIKE(2, 3);

typedef struct profile {
    vndf_rows_over over;
    vndf_rows_of of;
    size_t count;
    double *x, *value; /* owned, one behind the other */
} profile;

/* Room for `count` rows of zeros. 0 and the reason if there is no memory. */
int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count, data_file *file);
void profile_free(profile *freed);

/* The curve through the rows, to be freed; NULL and the reason if they are none: not finite, not ascending. */
vndf_source *profile_source(const profile *from, data_file *file);

/* Writes the rows as a CSV that `vndf build --csv` reads, with `title` as a comment; 0 if that fails. */
int profile_write(FILE *file, const profile *from, const char *title);

/* ---- reflectances: rgl.c, merl.c ----------------------------------------------------------------- */

/* D over theta of a .bsdf, the mean of its field `ndf` over azimuths. A material whose D strays from that mean by more
 * than 0.05 of all normals is refused with the measure. */
int rgl_read(data_file *file, profile *rows);

/* A field of such a file, see rgl.c: bytes or floats, the slowest dimension first. */
typedef enum tensor_type { TENSOR_U8 = 1, TENSOR_F32 = 10 } tensor_type;
typedef struct tensor {
    const char *name;
    tensor_type type;
    int dimensions;
    size_t shape[5];
    const void *data;
} tensor;

/* The field of floats of this name and number of dimensions; its data are bytes of the file. Number i of them. */
int tensor_find(data_file *file, const char *name, int dimensions, tensor *found);
double tensor_at(const tensor *of, size_t i);

int tensor_write(FILE *file, const tensor *fields, size_t count);

enum { RGL_CHANNELS = 16 };

typedef struct rgl_form {
    float alpha;                    /* roughness, isotropic */
    int channels;                   /* 3 of rgb, or as many as there are wavelengths */
    double f0[RGL_CHANNELS];        /* reflectance at normal incidence; F is Schlick's */
    int is_spectral;                /* spectra and wavelengths, for spectral hosts, in the place of rgb */
    float wavelength[RGL_CHANNELS]; /* ascending */
    const char *description;
} rgl_form;

/* Writes single scattering of the distribution to an open file; 0 if there is no memory, or that fails. Some 4 MB for
 * three channels. */
int rgl_write(FILE *file, const vndf_distribution *distribution, const rgl_form *form);

typedef enum merl_channel { MERL_RED, MERL_GREEN, MERL_BLUE, MERL_LUMINANCE } merl_channel;

/* D over theta of one channel, by the light that goes back less a constant, the diffuse part, chosen so that D
 * explains all of the file best. Noted are that part (pi f, an albedo), F0 and F90 of Schlick's F, the part of the
 * light that the model has elsewhere, and F0 of each channel by itself, diffuse light counted in. */
int merl_read(data_file *file, merl_channel channel, profile *rows);

/* ---- the slopes of a surface: surface.c, slopes.c ------------------------------------------------ */

enum { SLOPE_PARTS = 64, SLOPES_LEAST = 1000, SURFACE_MAX = 1 << 24, CUTOFF_MAX = 256 };

/* Slopes of points of a surface, and the part of it, 0 to SLOPE_PARTS - 1, where each lies. */
typedef struct slope {
    float x, y;
    int part;
} slope;

typedef struct slope_set {
    slope *at; /* owned; room for as many as were asked for */
    size_t count;
    double quantum; /* the least difference that slopes can have, 0 of floats: no bin is narrower than two */
} slope_set;

/* Room for `room` slopes, none of them there. */
int slopes_make(slope_set *made, size_t room, data_file *file);
void slopes_free(slope_set *freed);
void slopes_add(slope_set *to, double x, double y, int part);

/* Turns the slopes into u, notes what was found, and makes rows of P22 over |u|. Refused are fewer than SLOPES_LEAST
 * slopes, and such as are all alike or lie on a line. */
int slopes_law(slope_set *slopes, data_file *file, profile *rows);

/* Reads heights, the first channel of an image: PFM, PGM of 8 or 16 bits (0 to 1), or numbers between blanks, a line
 * for each row, NaN where there is none. */
int heights_read(data_file *file, image *made);

/* Takes away what is shorter than `cutoff` samples, 2 to CUTOFF_MAX: the Gaussian filter of ISO 16610-21, which
 * halves waves of that length. 0 if there is no memory. */
int heights_smooth(image *changed, int cutoff);

/* Slopes by central differences of samples that are `step` apart along x and y, in the unit of the heights; those whose
 * neighbours are not there are left out, as are `margin` samples along the rim. */
int heights_slopes(const image *of, const double step[2], int margin, slope_set *made, data_file *file);

/* Slopes of a normal map, a PPM (P6) or a colour PFM. A normal n has the slope (-n.x/n.z, -n.y/n.z). Numbers of 8 or
 * 16 bits are n/2 + 1/2, and so are those of a PFM without negative ones; a PFM with negative numbers holds n itself.
 * Lengths need not be 1: normals shorter than a half, longer than 3/2 or without z above 0 are left out, and more
 * than half of them are a reason to refuse. */
int normals_slopes(data_file *file, slope_set *made);
