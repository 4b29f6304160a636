/* Quadrature over all visible normals of one direction: a fixed fine grid in the stretched slopes in polar
 * form about wi, where the visible density is smooth but for its known edges, so that sums over the grid are
 * integrals over the hemisphere. */
#ifndef TESTS_ORACLE_ORACLE_VALIDATE_H
#define TESTS_ORACLE_ORACLE_VALIDATE_H

#include "oracle/oracle.h"

/* One grid point. wm is rounded to float, as the library takes it. */
typedef struct oracle_point {
    vndf_vec3 wm;
    double reference; /* visible density per steradian, by the oracle */
    double weight;    /* steradians that the point stands for */
} oracle_point;

typedef void oracle_visitor(const oracle_point *point, void *user);

/* The true projected area of a surface with the oracle's distribution. */
double oracle_surface_area(const oracle *o, const vndf_surface *surface, vndf_vec3 wi);

/* Visible density per steradian at wm, given that area. */
double oracle_visible(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wm, double area);

/* Visits the whole grid, of some million points. Panels end where the reference has an edge: where normals turn
 * away from wi, at breaks of P22, and at right angles to wi. */
void oracle_visit(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, oracle_visitor *visit, void *user);

/* What is measured of a table in one direction. */
typedef struct oracle_finding {
    double mass;       /* integral of vndf_pdf over the hemisphere */
    double reference;  /* of the reference over the same grid; 1 up to the error of the grid */
    double tv;         /* half the integral of |pdf - reference| */
    double area_error; /* of vndf_projected_area, relative */
    double heavier;    /* part of the reference where it exceeds `heavy` times the pdf */
} oracle_finding;
oracle_finding oracle_validate(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, double heavy);

/* wi at theta and phi in degrees; exactly horizontal at 90. */
vndf_vec3 oracle_direction(double theta, double phi);

#endif
