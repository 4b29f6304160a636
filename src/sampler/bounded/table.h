/* Bounded visible normals of tables; table.c has the mathematics. */
#ifndef VNDF_SAMPLER_BOUNDED_TABLE_H
#define VNDF_SAMPLER_BOUNDED_TABLE_H

#include "sampler/bounded/disc.h"

vndf_bounded vndf_bounded_table(const vndf_view *view, float u1, float u2);
vndf_bounded_factors vndf_bounded_table_at(const vndf_view *view, vndf_normal wm, double facing);

#endif
