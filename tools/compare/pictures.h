/* Pictures of a contest, as PNG. */
#ifndef COMPARE_PICTURES_H
#define COMPARE_PICTURES_H

#include "compare/contest.h"

typedef struct crop {
    int x, y, width, height; /* pixels of the film */
} crop;

enum { CROPS = 2, CROP_MAGNIFIED = 320 /* pixels across, at least, when it is shown */ };

/* Where to look: where all ways are seen to err most after equal time, and where the others most beside the first.
 * Their size follows the film's. 0 if there is no memory. */
int choose_crops(const contest *c, float exposure, crop crops[CROPS]);

/* 0 if there is no memory or the file takes no more. */
int picture_of_film(FILE *file, const film *f, float exposure);

/* Relative errors from `low` (black) to `high` (white), by their logarithm. */
int picture_of_error(FILE *file, const film *of, const film *reference, double low, double high);

/* A row for each of CROPS crops: the reference, then all ways after equal time. */
int picture_of_crops(FILE *file, const contest *c, const crop *crops, float exposure);

/* The colours of picture_of_error, for a legend: `part` from 0 to 1. */
void error_colour(double part, unsigned char rgb[3]);

#endif
