/* What a renderer sees of the map from uniform numbers to normals: the error of an estimate under stratified points. */
#ifndef TOOLS_MEASURE_STRATIFIED_ERROR_H
#define TOOLS_MEASURE_STRATIFIED_ERROR_H

#include "vndf.h"

/* The root mean square error of estimates by `points` Owen-scrambled Sobol' points whose normals vndf_sample draws, over
 * that of GGX drawn by spherical caps with the same points; the geometric mean over 6 views and 2 lights. `points` is a
 * power of two up to 4096. NaN if the lights are hardly seen. */
double vndf_stratified_error(const vndf_distribution *distribution, unsigned points);

#endif
