/* One direction of incidence: the density that a table draws there, against the true one. */
#ifndef VNDF_FIT_CERTIFICATE_VALIDATE_H
#define VNDF_FIT_CERTIFICATE_VALIDATE_H

#include "fit/certificate/largest_weight.h"
#include "fit/profile/profile.h"
#include "table/table.h"

/* How closely a direction is looked at. The cells of small tables are integrated in parts, at least so many in all, so
 * that the rule errs less than the table. */
typedef struct vndf_validation_rule {
    uint32_t radial_parts, cut_points;    /* cut_points: in each part of the cell of the cut */
    uint32_t azimuth_parts, front_panels; /* front_panels: cells of the quarter towards wi */
    uint32_t sums, foreseen;              /* azimuths that are not looked at along the radius */
} vndf_validation_rule;

/* The rule of certificates, and one that costs a twelfth: it finds where errors are large, and not how large to a few
 * per cent. */
extern const vndf_validation_rule vndf_validation_close, vndf_validation_coarse;

/* A stretch of a radial cell, in xi, and its Gauss points. The stretches of all cells stand in order. */
typedef struct vndf_validation_stretch {
    double from, to;
    uint32_t cell, first, count; /* points */
} vndf_validation_stretch;

/* A Gauss point where the cell is not cut: xi, weight per xi, slope and P22 R dR; and how far rounding of a
 * normal to float moves xi, 0 where that is negligible beside the stretch. */
typedef struct vndf_validation_node {
    double xi, weight, r, mass, rounding;
} vndf_validation_node;

/* Places number by number: xi and 1 - xi; one block, which begins at xi. */
typedef struct vndf_validation_places {
    double *xi, *eta;
} vndf_validation_places;

/* The same points number by number; and moved by rounding, every second one inwards and the others outwards. */
typedef struct vndf_validation_lines {
    vndf_validation_places at, moved[2]; /* moved[0]: the first of a cell outwards */
    double *weight, *mass, *r;           /* one block, which begins at weight */
} vndf_validation_lines;

/* The stretches and points of a radial cell, and whether rounding matters at any. */
typedef struct vndf_validation_cell {
    uint32_t first_stretch, stretches, first, count;
    int rounded;
} vndf_validation_cell;

/* An azimuth that is looked at along the radius: its samples, and the sums that it stands for. */
typedef struct vndf_validation_slice {
    size_t first, count, first_sum, sums;
} vndf_validation_slice;

/* Sums over samples: the drawn mass, the true one, and |drawn - true|. */
typedef struct vndf_validation_total {
    double drawn, reference, miss;
} vndf_validation_total;

typedef struct vndf_validation {
    const vndf_distribution *table;
    const vndf_profile *profile;
    vndf_validation_rule rule;
    vndf_validation_stretch *stretch;
    vndf_validation_node *node;
    size_t stretch_count, node_count;
    vndf_validation_cell *cells;
    vndf_validation_lines lines;
    vndf_points samples; /* of one direction after the other */
    vndf_validation_total total;
    vndf_points sums; /* of its azimuths, many more of them: the law of the radius taken as true */
    vndf_validation_slice *slices;
    vndf_weights weights;
    double *beside; /* the densities of a cell at moved points */
    size_t slice_count, slice_capacity;
    double area; /* true area of the direction, for s + |c| = 1 */
    double lack; /* the drawn mass that the samples leave out */
    double blur; /* by how much rounding of normals to float changes the drawn density, all together */
} vndf_validation;

typedef struct vndf_finding {
    double tv, max_weight, consistency, area_error; /* as in vndf_certificate */
    int measured;                                   /* 0 where nothing is claimed */
} vndf_finding;

/* 0 if there is no memory; free it either way. */
int vndf_validation_from(vndf_validation *validation, const vndf_distribution *table, const vndf_profile *profile,
                         vndf_validation_rule rule);
void vndf_validation_free(vndf_validation *validation);

/* The direction (s, 0, c) of the unit problem. */
vndf_finding vndf_validation_direction(vndf_validation *validation, double s, double c);

/* The true area of a direction, 0 where nothing is claimed. */
double vndf_validation_claimed(const vndf_validation *validation, double s, double c);

/* About the largest weight there, from the sums alone: costs a fiftieth. */
double vndf_validation_foreseen(vndf_validation *validation, double s, double c);

/* Slope at part/parts of a radial cell in xi. */
double vndf_validation_slope(const vndf_distribution *table, uint32_t cell, uint32_t part, uint32_t parts);

#endif
