/* One direction of incidence: the density that a table draws there, against the true one. */
#ifndef VNDF_FIT_CERTIFICATE_VALIDATE_H
#define VNDF_FIT_CERTIFICATE_VALIDATE_H

#include "fit/profile/profile.h"
#include "table/table.h"

/* The part of the mass that the largest weight and the error of D leave out. */
#define VNDF_VALIDATION_LEFT_OUT 1e-6

/* One Gauss point of a direction: its parts of the true and of the drawn mass. */
typedef struct vndf_validation_point {
    double reference, drawn;
} vndf_validation_point;

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

/* An azimuth that is looked at along the radius: its samples, and the sums that it stands for. */
typedef struct vndf_validation_slice {
    size_t first, count, first_sum, sums;
} vndf_validation_slice;

typedef struct vndf_validation {
    const vndf_distribution *table;
    const vndf_profile *profile;
    vndf_validation_stretch *stretch;
    vndf_validation_node *node;
    size_t stretch_count, node_count;
    vndf_validation_point *samples; /* of one direction after the other */
    vndf_validation_point *sums;    /* of its azimuths, many more of them: the law of the radius taken as true */
    vndf_validation_slice *slices;
    size_t count, capacity, sum_count, sum_capacity, slice_count, slice_capacity;
    double area; /* true area of the direction, for s + |c| = 1 */
    double lack; /* the drawn mass that the samples leave out */
    double blur; /* by how much rounding of normals to float changes the drawn density, all together */
} vndf_validation;

typedef struct vndf_finding {
    double tv, max_weight, consistency, area_error; /* as in vndf_certificate */
    int measured;                                   /* 0 where nothing is claimed */
} vndf_finding;

/* 0 if there is no memory; free it either way. */
int vndf_validation_from(vndf_validation *validation, const vndf_distribution *table, const vndf_profile *profile);
void vndf_validation_free(vndf_validation *validation);

/* The direction (s, 0, c) of the unit problem. */
vndf_finding vndf_validation_direction(vndf_validation *validation, double s, double c);

/* About the largest weight there, from the sums alone: costs a fiftieth. */
double vndf_validation_foreseen(vndf_validation *validation, double s, double c);

/* Slope at part/parts of a radial cell in xi. */
double vndf_validation_slope(const vndf_distribution *table, uint32_t cell, uint32_t part, uint32_t parts);

#endif
