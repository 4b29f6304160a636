/* Images as measurements: PGM and PPM, binary, of 8 or 16 bits (a line P5 or P6, then width, height and the largest
 * value, with comments from # to the end of a line; one blank; rows from the top, the greater byte first), and PFM. */
#ifndef TOOLS_MEASURED_RASTER_H
#define TOOLS_MEASURED_RASTER_H

#include "measured/data.h"

typedef struct raster {
    int width, height, channels; /* 1 or 3 */
    size_t stride;               /* numbers a pixel */
    double quantum;              /* 1 over the largest value; 0 of floats */
    float *value;                /* owned; 0 to 1 of PGM and PPM */
} raster;

int raster_read(data_file *file, raster *made);

#endif
