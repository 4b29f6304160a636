/* Tables of perfect sampling: which numbers (u1, u2) to hand to a sampler of visible normals, for any direction
 * wi, and how to choose between two lobes there.
 *
 * A node is a direction with a table of PERFECT_CELLS x PERFECT_CELLS cells of the unit square. A cell holds a
 * probability, and the worth of reflection beside transmission. Between nodes both are mixed with the weights of
 * linear interpolation: choosing a node draws a cell, and its density is exactly the mean over the nodes. Cells
 * are narrow towards the border of the square, where the tails are: their knots are 2 x^2 up to the middle, x even
 * from 0 to 1, and the same from the other end.
 *
 * Nodes stand on up to three axes, with wi in the first quadrant of x and y: its side of the surface, its tilt,
 * and, for two roughnesses, its turn about the normal. The weight changes with the direction itself (Fresnel) and
 * with the direction stretched by the roughness (masking, and the part lost below the horizon). The two may be far
 * apart: at alpha 0.05 all of the masking lies in the last degrees before grazing. So an axis is the mean of its
 * two coordinates: of tan(angle/2) for the tilt, and of y/(x + y) for the turn. If light is reflected totally from
 * some angle on, the weight changes within alpha of that angle, and the tilt has a third coordinate that rises
 * there. */
#ifndef TOOLS_RENDER_PERFECT_TABLE_H
#define TOOLS_RENDER_PERFECT_TABLE_H

#include <stddef.h>

#include "render/vector.h"

enum { PERFECT_CELLS = 64, PERFECT_CORNERS = 4 };

typedef struct perfect_table {
    float alpha_x, alpha_y; /* of the stretch; > 0 */
    float critical[2];      /* of each side: sine of the angle from which a mirror reflects totally; 0: none */
    int lobes, sides, turns;
    float *nodes; /* of each: sums of its rows, of the cells in each row; with two lobes, shares of one */
} perfect_table;

/* The nodes about a direction, and their weights. */
typedef struct perfect_place {
    const float *node[PERFECT_CORNERS];
    float weight[PERFECT_CORNERS];
    int count;
} perfect_place;

/* The cell at (u1, u2). */
typedef struct perfect_cell {
    float density; /* its integral over the unit square is 1 */
    float share;   /* in (0, 1): worth of reflection over the worth of both lobes, if both are as likely */
} perfect_cell;

/* Makes room for the nodes and fills none; alpha, critical, lobes and sides are set before. 0 if there is no
 * memory. */
int perfect_table_make(perfect_table *t);
void perfect_table_free(perfect_table *t);
size_t perfect_table_nodes(const perfect_table *t);
size_t perfect_table_bytes(const perfect_table *t);

/* The direction of a node: x, y >= 0; z < 0 on the second side. */
vndf_vec3 perfect_table_direction(const perfect_table *t, size_t node);

/* Where cell i begins in u; 1 for i = PERFECT_CELLS. */
float perfect_table_knot(int i);

/* `worth`: the density that each cell should have, up to a factor, [row of u1][column of u2], >= 0 and finite. A
 * cell gets at least 3e-4 of the mean over its row, and a row at least 3e-4 of the mean of rows: light from a cell
 * that is never drawn would be missing, and a few points do not tell everything about a cell. With one lobe
 * `share` is not read. */
void perfect_table_fill(perfect_table *t, size_t node, const float *worth, const float *share);

/* The place of wi, which lies in the first quadrant of x and y. */
void perfect_table_place(const perfect_table *t, vndf_vec3 wi, perfect_place *place);

/* Turns u, three uniform numbers in [0, 1), into (u1, u2) and another uniform number, for the lobe. */
perfect_cell perfect_table_draw(const perfect_table *t, const perfect_place *place, float u[3]);
perfect_cell perfect_table_at(const perfect_table *t, const perfect_place *place, float u1, float u2);

#endif
