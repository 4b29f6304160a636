#include "fit/draft.h"

#include <math.h>

#include "math/ascending.h"
#include "table/file.h"

static const double PI = 3.14159265358979323846;

/* ---- one cell ---- */

/* Where it lies. */
static vndf_cell cell_between(double r, double end, unsigned squarings)
{
    double z = 1 / (1 + r), power = end < HUGE_VAL ? 0 : (double)(1u << squarings);
    double h = power > 0 ? power * z : (end - r) * z / (1 + end);
    return (vndf_cell){.r = r, .x = r * z, .z = z, .h = h, .power = power};
}

double vndf_cell_place(const vndf_cell *cell, double r)
{
    double z = 1 / (1 + r), left = z / cell->z;
    if (cell->power == 0)
        return (r - cell->r) * z * cell->z / cell->h;
    for (double power = cell->power; power > 1; power /= 2)
        left = sqrt(left);
    return 1 - left;
}

/* 2 pi P22 h/z^4 at the end with this z, h = z^2 dR/dxi, within bounds about the mean: for poles, zeros and light
 * tails. */
static double end_of(double p22, double h, double z, double mean)
{
    const double least = 0.02, most = 300;
    return fmin(fmax(2 * PI * p22 * h / (z * z * z * z), least * mean), most * mean);
}

vndf_cell vndf_cell_measure(const vndf_profile *profile, const vndf_strips *strips, size_t first, size_t end,
                            unsigned squarings)
{
    const double mass_least = 1e-30, least = 1e-36, cube_most = 1e30;
    const double near_end = 4e-2; /* 1 - xi where the limit of a tail is read */
    double to = strips->at[end].edge;
    vndf_cell c = cell_between(strips->at[first].edge, to, squarings);
    for (size_t i = first; i < end; i++) {
        const vndf_strip *s = &strips->at[i];
        double d = strips->at[i].edge - c.r;
        c.m0 += s->m0;
        c.m1 += s->m1 + d * s->m0;
        c.m2 += s->m2 + d * (2 * s->m1 + d * s->m0);
        c.cube += s->m4;
    }
    c.cube = c.m0 > 0 ? c.cube / c.m0 : 0;
    if (c.m0 < mass_least) { /* an even density that floats can hold */
        double width = to < HUGE_VAL ? to - c.r : c.r;
        c.m0 = mass_least;
        c.m1 = c.m0 * width / 2;
        c.m2 = c.m0 * width * width / 3;
        c.cube = 1 / (c.r * c.r * c.r);
    }
    c.m1 = fmax(c.m1, least);
    c.m2 = fmax(c.m2, least);
    c.cube = c.cube > least ? fmin(fmin(c.cube, 1 / (c.r * c.r * c.r)), cube_most) : 0;
    if (c.r == 0) { /* no law reads these two; the first may be infinite */
        c.m0 = 2 * c.m1 / to;
        c.cube = 0;
    }
    c.g0 = end_of(strips->at[first].p0, c.h, c.z, c.m0 / (c.z * c.z));
    if (c.power > 0) {
        double z = c.z * pow(near_end, c.power), far = 1 / z - 1;
        c.g1 = end_of(vndf_profile_p22(profile, far), c.power * z / near_end, z,
                      c.m2 + (2 * c.m1 + c.m0 * c.r) * c.r);
    } else
        c.g1 = end_of(strips->at[end - 1].p1, c.h, c.z - c.h, c.m0 / ((c.z - c.h) * (c.z - c.h)));
    return c;
}

/* z^2 W, with the mean of R^-3 in the cell. */
static double flat(const vndf_weight *w, double cube, double x, double z)
{
    return w->w1 * x * x + w->w0 * x * z + (w->wq + w->w4 * cube) * z * z;
}

vndf_drawn vndf_drawn_by(const vndf_cell *c, const vndf_weight *w)
{
    double r = c->r, first = 2 * w->w1 * r + w->w0, none = (w->w1 * r + w->w0) * r + w->wq + w->w4 * c->cube;
    double x1 = c->power > 0 ? 1 : c->x + c->h, z1 = c->power > 0 ? 0 : c->z - c->h;
    return (vndf_drawn){w->w1 * c->m2 + first * c->m1 + none * c->m0, c->g0 * flat(w, c->cube, c->x, c->z),
                        c->g1 * flat(w, c->cube, x1, z1)};
}

/* z^2 W at the right end. */
static double below_flat(const vndf_cell *c, double rho, double b0, double b1)
{
    double x = c->power > 0 ? 1 : c->x + c->h, way = 1;
    if (c->power == 0) /* the difference of slopes keeps its digits */
        way = (c->r - rho) * (c->z - c->h) + c->h / c->z;
    return way * (b0 * x + b1 * way);
}

vndf_drawn vndf_drawn_below(const vndf_cell *c, double rho, double b0, double b1)
{
    double d = c->r - rho, e = b0 * c->r + b1 * d;
    return (vndf_drawn){(b0 + b1) * c->m2 + ((b0 + b1) * d + e) * c->m1 + d * e * c->m0,
                        c->g0 * (d * c->z) * (e * c->z), c->g1 * below_flat(c, rho, b0, b1)};
}

/* ---- tables ---- */

vndf_cell vndf_cell_of(const vndf_table_draft *t, unsigned i)
{
    vndf_cell c = cell_between(t->knot[i], i < t->cells ? (double)t->knot[i + 1] : HUGE_VAL, t->squarings);
    c.g0 = t->g0[i];
    c.g1 = t->g1[i];
    c.m0 = t->m0[i];
    c.m1 = t->m1[i];
    c.m2 = t->m2[i];
    c.cube = t->cubes && i > 0 ? t->cubes[i] : 0;
    return c;
}

unsigned vndf_draft_cell(const vndf_draft *draft, double r)
{
    return (unsigned)vndf_last_before(&draft->cell->r, sizeof *draft->cell, draft->table.cells + 1, r);
}

/* ---- directions ---- */

/* The part of rho by which the run time finds the switch (table.h). */
static int part_of(double rho)
{
    int exponent;
    double part = frexp(rho, &exponent), eighth = 8 * (exponent - 1 + 13) + floor(16 * part) - 8;
    return (int)fmin(fmax(eighth, 0), VNDF_RHO_PARTS - 1);
}

vndf_law vndf_law_of(const vndf_draft *draft, double rho, int below)
{
    /* k~(y) = a1 y + a0 + aq/y + a4/y^4 for 2, 3 and 4 moments */
    static const double term[3][4] = {{.934604, 2.206989, 0, 0},
                                      {1.00473604, 1.48847826, 0.64837836, 0},
                                      {0.99928177, 1.58441365, 0.47441838, 0.08347885}};
    const vndf_table_draft *d = &draft->table;
    const double *k = term[d->moments - 2];
    double s = 1 / (1 + rho), c = rho * s;
    unsigned i = vndf_draft_cell(draft, rho), next = i < d->cells ? i + 1 : i;
    vndf_law law = {.draft = draft, .rho = rho, .s = s, .c = c, .below = below, .first = i};
    if (below) {
        law.xi = vndf_cell_place(&draft->cell[i], rho);
        law.b0 = d->b0[i] + law.xi * ((double)d->b0[next] - d->b0[i]);
        law.b1 = d->b1[i] + law.xi * ((double)d->b1[next] - d->b1[i]);
        return law;
    }
    int part = part_of(rho);
    double rounded = vndf_rounded_rho(part);
    i = vndf_draft_cell(draft, rounded);
    law.first = i < d->cells && vndf_table_turn(d, i + 1) <= rounded ? i + 1 : i;
    law.near = (vndf_weight){0, c, 0, 0};
    law.far = (vndf_weight){s * k[0] / PI, c * k[1] / PI, c * rho * k[2] / PI,
                            rho < 1e-3 ? 0 : c * pow(rho, 4) * k[3] / PI};
    law.end = (vndf_weight){law.far.w1, c, 0, 0};
    if (law.first == d->cells || part == VNDF_RHO_PARTS - 1)
        law.far = law.end;
    return law;
}

/* The mass of the cell that rho lies in is estimated: W vanishes at rho and grows about evenly. The estimate is scaled
 * so that it is exact where rho is the left knot. */
static vndf_drawn partial_cell(const vndf_law *law)
{
    const vndf_cell *c = &law->draft->cell[law->first];
    double all = vndf_drawn_below(c, c->r, law->b0, law->b1).mass, here = c->g0 + law->xi * (c->g1 - c->g0);
    double near = below_flat(c, c->r, law->b0, law->b1) * (c->g1 / 3 + c->g0 / 6);
    double end = (1 - law->xi) * below_flat(c, law->rho, law->b0, law->b1);
    double mass = fmin(all / near, 1e3) * (end * (c->g1 / 3 + here / 6));
    return (vndf_drawn){mass, 0, fmin(end * c->g1, 1e4 * mass)};
}

vndf_drawn vndf_law_cell(const vndf_law *law, unsigned i)
{
    const vndf_cell *c = &law->draft->cell[i];
    if (!law->below)
        return vndf_drawn_by(c, i < law->first ? &law->near : i == 0 ? &law->end : &law->far);
    vndf_drawn drawn = i == law->first ? partial_cell(law) : vndf_drawn_below(c, law->rho, law->b0, law->b1);
    double by = law->s / PI;
    return (vndf_drawn){by * drawn.mass, by * drawn.d0, by * drawn.d1};
}

double vndf_law_public_area(const vndf_law *law, double drawn)
{
    const vndf_table_draft *d = &law->draft->table;
    unsigned i = vndf_draft_cell(law->draft, law->rho);
    const vndf_cell *c = &law->draft->cell[i];
    int last = i == d->cells;
    double width = last ? c->z : c->h, t = last ? 1 - law->s / c->z : vndf_cell_place(c, law->rho), u = 1 - t;
    double a0 = d->area[i], a1 = last ? 1 : d->area[i + 1];
    double d0 = d->slope[i] * width, d1 = (last ? 1 : d->slope[i + 1]) * width;
    double above = u * u * ((1 + 2 * t) * a0 + t * d0) + t * t * ((1 + 2 * u) * a1 - u * d1);
    double part = fmin(fmax((drawn / above - 4e-4) / 1.6e-3, 0), 1);
    return law->below ? drawn + part * (above - law->c - drawn) : above;
}
