/* Moving the ends of an interval outwards; inside of interval.c and functions.c. */
#ifndef VNDF_SOURCE_INTERVAL_ENDS_H
#define VNDF_SOURCE_INTERVAL_ENDS_H

#include "source/interval/interval.h"

static const double VNDF_LIBRARY = 3e-15; /* error of functions of the C library: many units in the last place */

/* Both ends moved by this part of them; the whole line if one is not a number. */
vndf_interval vndf_interval_widened(vndf_wide low, vndf_wide high, double part);

/* Of what the C library gave for the two ends. */
vndf_interval vndf_interval_of_library(double low, double high);

vndf_wide vndf_wide_larger(vndf_wide a, vndf_wide b);

#endif
