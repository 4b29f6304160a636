/* Heights on a grid, and their slopes. */
#ifndef TOOLS_MEASURED_SURFACE_HEIGHTS_H
#define TOOLS_MEASURED_SURFACE_HEIGHTS_H

#include "measured/surface/slopes.h"

enum { HEIGHTS_SIDE_MAX = 16384, HEIGHTS_MAX = 1 << 24, CUTOFF_MAX = 256 };

/* Heights over places (x step_x, y step_y), all in one unit; a row after the other. NaN: there is none. */
typedef struct height_field {
    int width, height;
    double step_x, step_y;
    double quantum; /* the least difference that heights can have; 0 if they are floats */
    float *z;       /* owned */
} height_field;

/* Room, and steps of 1. 0 and the reason if the sides are out of range or there is no memory. */
int heights_make(height_field *made, int width, int height, const char *name, refusal *why);
void heights_free(height_field *freed);

/* What the bytes cannot say themselves. */
typedef struct height_form {
    int width, height;     /* of raw floats; 0: another file */
    double step_x, step_y; /* 0: what the file says, else 1 */
} height_form;

/* Reads PFM (its first channel), PGM of 8 or 16 bits (0 to 1), ASCII .sdf (ISO 25178-71), numbers between blanks, a
 * line for each row, or, where the form has a size, raw little-endian floats. Returns 1, or 0 and the reason; untrusted
 * bytes are safe. */
int heights_read(height_field *made, const char *name, const void *bytes, size_t size, const height_form *form,
                 refusal *why);

/* The same of each kind. */
int heights_read_text(height_field *made, const char *name, const char *bytes, size_t size, refusal *why);
int heights_read_sdf(height_field *made, const char *name, const char *bytes, size_t size, refusal *why);

/* Takes away what is shorter than `cutoff` samples, 2 to CUTOFF_MAX: the Gaussian filter of ISO 16610-21, which halves
 * waves of that length. 0 if there is no memory. */
int heights_smooth(height_field *changed, int cutoff);

/* Slopes by central differences; those whose neighbours are not there are left out, as are `margin` samples along the
 * rim. 0 and the reason. */
int heights_slopes(const height_field *of, int margin, const char *name, slope_set *made, refusal *why);

/* Smith's assumption, that masking does not know the slope: of the slopes towards a direction `elevation` radians from
 * z, along and against both axes, how far those that are seen (along the rows and columns of the grid) are from those
 * that face it, as a total variation. -1 if there is no memory, or nothing to be seen. */
double heights_smith(const height_field *of, double elevation);

#endif
