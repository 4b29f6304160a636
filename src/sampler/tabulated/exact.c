/* The density of a given normal, and D, in double from the very numbers that came in. In float three things would
 * cancel: W = wi.wm at the cut, where the density ends; the place of a slope in its cell, which is narrow where D
 * is steep; and the distance to a right angle from wi, where the azimuth's density ends below the horizon. None of
 * them has to be formed in the turned frame:
 *
 *     s X cos a = wi.x wm.x + wi.y wm.y,       s X sin a = ax wi.x (wm.y/ay) - ay wi.y (wm.x/ax)
 *
 * for the normal (wm.x/ax, wm.y/ay, wm.z) = (X cos a, X sin a, Z), whatever the stretch, with s of the
 * stretched direction before per_length brings it to s + |c| = 1. Cells are those of math/rational_cell.h,
 * math/weighted_cell.h and radial.h, which draws from them. This serves every normal, and the builder of tables; most
 * normals, in lanes too, are evaluated by density.h and density_wedge.h. The relative error is below 1e-5 of the
 * density that the numbers of the file define, wherever that exceeds 1e-30 (test float_accuracy). */
#include <math.h>

#include "math/vector.h"
#include "sampler/tabulated/theory.h"
#include "sampler/tabulated/density_wedge.h"
#include "sampler/stretch.h"
#include "sampler/tabulated/wedge.h"
#include "table/moment_cubic.h"

/* ---- cells ---- */

/* Mass per xi; eta = 1 - xi, exact where it is small. */
static double rational_density(double e0, double e1, double mass, double xi, double eta)
{
    double w = xi * eta, q = 1.0 + ((e0 + e1) / mass - 2.0) * w;
    return (e1 * xi * xi + 2.0 * mass * w + e0 * eta * eta) / (q * q);
}

/* The same over xi where e0 = 0. */
static double rational_density_over(double e1, double mass, double xi, double eta)
{
    double q = 1.0 + (e1 / mass - 2.0) * (xi * eta);
    return (e1 * xi + 2.0 * mass * eta) / (q * q);
}

/* ---- azimuth ---- */

/* Rows of cells and their shares. */
typedef struct mixed_row {
    const vndf_row_cell *cell[3]; /* of each row */
    const float *q;
    double share[3], p, r;
    uint32_t cells;
} mixed_row;

static double mixed_mass(const mixed_row *row, uint32_t j)
{
    const vndf_row_cell *const *cell = row->cell;
    return row->share[0] * cell[0][j].mass + row->share[1] * cell[1][j].mass + row->share[2] * cell[2][j].mass;
}

/* Where cell j begins. */
static double mixed_density(const mixed_row *row, uint32_t j)
{
    const vndf_row_cell *const *cell = row->cell;
    return row->share[0] * cell[0][j].density + row->share[1] * cell[1][j].density +
           row->share[2] * cell[2][j].density;
}

/* The last of ascending knots at or below y: the guide finds it but for the rounding of y. */
static uint32_t knot_before(const vndf_guide *guide, const float *knots, double y)
{
    uint32_t i = vndf_guide_find(guide, (float)y);
    return i - (i > 0 && y < knots[i]);
}

static mixed_row wedge_row(const vndf_wedge *w, double y)
{
    uint32_t i = knot_before(&w->row_guide, w->row_y, y);
    double m = (y - w->row_y[i]) / (w->row_y[i + 1] - w->row_y[i]), rest = 1.0 - m;
    size_t first = 2 * (size_t)i;
    mixed_row row = {{vndf_row_cells(w, first), vndf_row_cells(w, first + 1), vndf_row_cells(w, first + 2)},
                     w->q,
                     {rest * rest, 2.0 * rest * m, m * m},
                     0.0,
                     0.0,
                     w->cell_count};
    for (size_t n = 0; n < 3; n++) {
        row.p += row.share[n] * w->row_span[i].p[n];
        row.r += row.share[n] * w->row_span[i].r[n];
    }
    return row;
}

/* Mass per radian at an azimuth, cos >= 0; 1 - q is formed without a difference. */
static double row_density(const mixed_row *row, double cosine, double sine)
{
    double c = row->r * cosine, s = row->p * sine, n = sqrt(c * c + s * s);
    if (!(n > 0.0))
        return 0.0;
    double q = s / (c + n), rest = (c + c * (c / (n + s))) / (c + n);
    uint32_t j = 0;
    for (uint32_t i = 1; i < row->cells; i++)
        j += row->q[i] <= q;
    double from = row->q[j], to = row->q[j + 1], h = to - from;
    double xi = (q - from) / h, eta = (rest - (1.0 - to)) / h;
    double per_q =
        rational_density(mixed_density(row, j) * h, mixed_density(row, j + 1) * h, mixed_mass(row, j), xi, eta) /
        h;
    double x = row->p * rest * (1.0 + q), y = 2.0 * row->r * q;
    return per_q * (x * x + y * y) / (2.0 * row->p * row->r * (1.0 + q * q));
}

static const double QUARTER_TURN = 1.57079632679489662;

/* Per radian, of mass 1 in a whole turn. */
static double azimuth_density(const vndf_distribution *d, const vndf_stretched *w, double cosine, double sine)
{
    int toward = cosine >= 0.0, above = w->c >= 0.0;
    const vndf_wedge *side = vndf_wedge_of(d, w->c);
    /* below it may underflow */
    double y = vndf_wedge_y(w->s, w->c), mass = above ? vndf_wedge_mass(side, y) : 1.0;
    double front = above ? w->c * (d->f0_total * QUARTER_TURN) + w->s * d->f1_total : 0.0;
    double per = 0.5 / (front + mass);
    if (above && toward)
        return per * (w->c * d->f0_total + w->s * d->f1_total * cosine);
    if (above == toward || !(w->s > 0.0 || above))
        return 0.0;
    mixed_row row = wedge_row(side, y);
    return row.p > 0.0 ? per * mass * row_density(&row, fabs(cosine), sine) : 0.0;
}

/* ---- radius ---- */

/* A place in the table: xi and eta from both knots, each exact where it is small. */
typedef struct place {
    uint32_t cell;
    double xi, eta;
} place;

/* The guide finds the cell but for the rounding of the slope. */
static place place_of(const vndf_distribution *d, double x, double z)
{
    const vndf_knot *k = d->knots.at;
    uint32_t j = vndf_guide_find(&d->slope_guide, z > 0.0 ? (float)(x / z) : HUGE_VALF);
    if (j > 0 && x * k[j].z < z * k[j].x)
        j--;
    if (j + 1 < d->radial_count && x * k[j + 1].z >= z * k[j + 1].x)
        j++;
    double inner = x * k[j].z - z * k[j].x, outer = z * k[j + 1].x - x * k[j + 1].z;
    place at = {j, inner / (inner + outer), outer / (inner + outer)};
    return at;
}

/* X + Z at a place: the knots have 1 but for their rounding. What is per X + Z = 1 of the normal becomes per
 * that. */
static double sum_at(const vndf_distribution *d, place at)
{
    const vndf_knot *k = d->knots.at + at.cell;
    return at.eta * ((double)k[0].x + k[0].z) + at.xi * ((double)k[1].x + k[1].z);
}

/* The cell's cubic, from its moments: rounded to float its bump would show where f nearly vanishes. */
static vndf_moment_cubic bump_of(const vndf_radial_cell *cell)
{
    return vndf_moment_cubic_from(cell->f0, cell->f1, cell->mu0, cell->mu1);
}

static double cubic(const vndf_radial_cell *cell, double xi, double eta)
{
    vndf_moment_cubic bend = bump_of(cell);
    double f = cell->f0 * eta + cell->f1 * xi + xi * eta * (bend.a + bend.b * xi);
    return f > 0.0 ? f : 0.0;
}

/* vndf_radial_part (radial.h). */
static double part_integral(double f0, double f1, double a, double b, double h)
{
    double slope = f1 - f0;
    double whole = 0.5 * f0 + h * ((slope + a) / 6.0 + h * ((b - a) / 12.0 - h * b / 20.0));
    double least = 1e-3 * (0.5 * f0 + h * slope / 6.0);
    return whole > least ? whole : least;
}

static double knot_weight(const vndf_azimuth_slice *slice, uint32_t j)
{
    double w = slice->c * slice->table->knots.at[j].z + slice->k * slice->table->knots.at[j].x;
    return w > 0.0 ? w : 0.0;
}

/* The cell j of the cut; c > 0 > k, then c < 0 < k. */
static vndf_engine_piece piece_above(const vndf_azimuth_slice *slice, uint32_t j)
{
    const vndf_radial_cell *cell = &slice->table->cells[j];
    vndf_knot to = slice->table->knots.at[j + 1];
    double w = knot_weight(slice, j), end = slice->c * to.z + slice->k * to.x;
    double h = end < 0.0 ? w / (w - end) : 1.0;
    vndf_moment_cubic bend = bump_of(cell);
    double half = 0.5 * w * h, mass = w * h * part_integral(cell->f0, cell->f1, bend.a, bend.b, h);
    vndf_engine_piece p = {cell->f0 * half, cubic(cell, h, 1.0 - h) * half, mass, w, 0.0, 0.0, h, 1};
    return p;
}

static vndf_engine_piece piece_below(const vndf_azimuth_slice *slice, uint32_t j)
{
    const vndf_radial_cell *cell = &slice->table->cells[j];
    double w = knot_weight(slice, j + 1),
           end = slice->c * slice->table->knots.at[j].z + slice->k * slice->table->knots.at[j].x;
    double h = end < 0.0 ? w / (w - end) : 1.0;
    vndf_moment_cubic bend = bump_of(cell);
    double half = 0.5 * w * h, mass = w * h * part_integral(cell->f1, cell->f0, bend.a + bend.b, -bend.b, h);
    vndf_engine_piece p = {cubic(cell, 1.0 - h, h) * half, cell->f1 * half, mass, 0.0, w, 1.0 - h, h, 1};
    return p;
}

static double over(double w, double v)
{
    return v > 0.0 ? w / v : 1.0; /* what vanishes does so together */
}

/* Beyond the cut V is W; of the second cell inside it see radial.h. */
vndf_engine_piece vndf_engine_piece_of(const vndf_azimuth_slice *slice, uint32_t j)
{
    if (j == slice->cut)
        return slice->c > 0.0 ? piece_above(slice, j) : piece_below(slice, j);
    const vndf_radial_cell *cell = &slice->table->cells[j];
    double w0 = knot_weight(slice, j), w1 = knot_weight(slice, j + 1), way = 16.0 * slice->part;
    vndf_engine_piece p = {cell->f0 * w0, cell->f1 * w1, w0 * cell->mu0 + w1 * cell->mu1, w0, w1, 0.0, 1.0, 0};
    if (j + 2 < slice->cut)
        return p;
    p.weighted = 1;
    if (j + 2 == slice->cut)
        p.v1 += (way < 1.0 ? way : 1.0) * (w0 - w1);
    double half = 0.5 * (p.v0 + p.v1);
    p.e0 = cell->f0 * over(w0, p.v0) * half;
    p.e1 = cell->f1 * over(w1, p.v1) * half;
    return p;
}

/* A place in the rational cell of a piece: zeta and 1 - zeta, zeta over xi, and (dzeta/dxi) over the weight. */
typedef struct inner {
    double zeta, rest, ratio, per;
} inner;

/* Where the normal has the weight w. */
static inner inner_of(const vndf_engine_piece *p, place at, double w)
{
    double xi = at.xi, eta = at.eta;
    if (p->length < 1.0) {
        xi /= p->length;
        eta /= p->length;
        xi = p->begin > 0.0 ? (eta < 1.0 ? 1.0 - eta : 0.0) : xi;
        eta = p->begin > 0.0 ? eta : (xi < 1.0 ? 1.0 - xi : 0.0);
    }
    inner in = {xi, eta, 1.0, 1.0};
    if (p->weighted) {
        double per = 1.0 / (p->v0 + p->v1), v = p->v0 * eta + p->v1 * xi;
        in.ratio = (p->v0 + v) * per;
        in.zeta = xi * in.ratio;
        in.rest = eta * ((v + p->v1) * per);
        in.per = 2.0 * (p->length < 1.0 ? w : v) * per;
    }
    return in;
}

/* Mass per xi over X at a place where the normal has the weight w; f, and with it the mass per xi, begins at 0 as
 * X does. */
static double density_over_x(const vndf_azimuth_slice *slice, const vndf_engine_piece *p, place at, double w)
{
    const vndf_knot *k = slice->table->knots.at;
    inner in = inner_of(p, at, w);
    double per = in.per / p->length;
    if (at.cell == 0 && p->e0 == 0.0)
        return per * in.ratio * rational_density_over(p->e1, p->mass, in.zeta, in.rest) / (p->length * k[1].x);
    double x = at.eta * k[at.cell].x + at.xi * k[at.cell + 1].x;
    return per * rational_density(p->e0, p->e1, p->mass, in.zeta, in.rest) / x;
}

/* The law of the radius for one azimuth: its cut, and all of its mass. */
static void find_law(vndf_azimuth_slice *slice)
{
    const vndf_distribution *d = slice->table;
    double c = slice->c, k = slice->k;
    slice->cut = d->radial_count;
    slice->part = slice->mass = 0.0;
    if (c >= 0.0 && k >= 0.0) {
        slice->mass = c * d->f0_total + k * d->f1_total;
        return;
    }
    if (!(c > 0.0) && !(k > 0.0))
        return;
    uint32_t j = slice->cut = place_of(d, fabs(c), fabs(k)).cell;
    vndf_engine_piece p = vndf_engine_piece_of(slice, j);
    slice->part = p.length;
    if (c > 0.0)
        slice->mass = c * d->knots.pole[j].e + p.v0 * d->knots.pole[j].g + p.mass;
    else
        slice->mass = k * d->knots.tail[j + 1].s + p.v1 * d->knots.tail[j + 1].t + p.mass;
}

/* ---- both ---- */

static vndf_azimuth_slice ray_from(const vndf_view *view, const vndf_stretched *w, double cosine, double sine,
                                   double k)
{
    const vndf_distribution *d = view->distribution;
    vndf_azimuth_slice slice = {d, w->c, k, azimuth_density(d, w, cosine, sine), 0.0, 0.0, 0};
    find_law(&slice);
    return slice;
}

vndf_azimuth_slice vndf_azimuth_slice_at(const vndf_view *view, double cosine, double sine)
{
    vndf_stretched w = vndf_stretched_of(view);
    return ray_from(view, &w, cosine, sine, w.s * cosine);
}

double vndf_azimuth_slice_density(const vndf_azimuth_slice *slice, double x, double z, double w)
{
    place at = place_of(slice->table, x, z);
    int hidden =
        slice->cut < slice->table->radial_count && (slice->c > 0.0 ? at.cell > slice->cut : at.cell < slice->cut);
    if (!(slice->mass > 0.0) || !(slice->azimuth > 0.0))
        return 0.0;
    vndf_engine_piece p = vndf_engine_piece_of(slice, hidden ? slice->cut : at.cell);
    if (!(p.length > 0.0))
        return 0.0;
    if (hidden) { /* by rounding alone, since w > 0: the place is the cut */
        place end = {slice->cut, slice->c > 0.0 ? p.length : p.begin, slice->c > 0.0 ? 1.0 - p.length : p.length};
        at = end;
    }
    double sum = sum_at(slice->table, at), density = density_over_x(slice, &p, at, w * sum) * (sum * sum * sum);
    return slice->azimuth * density / (slice->mass * slice->table->cells[at.cell].width);
}

double vndf_engine_piece_density(const vndf_azimuth_slice *slice, const vndf_engine_piece *p, uint32_t j,
                                 double xi, double eta)
{
    const vndf_knot *k = slice->table->knots.at + j;
    place at = {j, xi, eta};
    double x = eta * k[0].x + xi * k[1].x, w = slice->k * x + slice->c * (eta * k[0].z + xi * k[1].z);
    return w > 0.0 && p->length > 0.0 && slice->mass > 0.0
               ? slice->azimuth * x * density_over_x(slice, p, at, w) / slice->mass
               : 0.0;
}

/* Mass of the law before knot j, c >= 0. */
static double mass_before(const vndf_azimuth_slice *slice, uint32_t j)
{
    const vndf_knots *knots = &slice->table->knots;
    return slice->k < 0.0 ? slice->c * knots->pole[j].e + knot_weight(slice, j) * knots->pole[j].g
                          : slice->c * knots->f0[j] + slice->k * knots->f1[j];
}

double vndf_azimuth_slice_part(const vndf_azimuth_slice *slice, double x, double z)
{
    place at = place_of(slice->table, x, z);
    if (!(slice->mass > 0.0) || at.cell > slice->cut)
        return 1.0;
    vndf_engine_piece p = vndf_engine_piece_of(slice, at.cell);
    if (!(p.length > 0.0) || !(p.mass > 0.0))
        return mass_before(slice, at.cell) / slice->mass;
    inner in = inner_of(&p, at, 0.0);
    double w = in.zeta * in.rest;
    double inside = (p.mass * in.zeta * in.zeta + p.e0 * w) / (1.0 + ((p.e0 + p.e1) / p.mass - 2.0) * w);
    double part = (mass_before(slice, at.cell) + inside) / slice->mass;
    return part < 1.0 ? part : 1.0;
}

vndf_azimuth_slice vndf_azimuth_slice_of(const vndf_view *view, vndf_normal wm)
{
    double mx = wm.x / view->alpha_x, my = wm.y / view->alpha_y, x = sqrt(mx * mx + my * my);
    double level = view->wi.x * wm.x + view->wi.y * wm.y, cosine = 1.0, sine = 0.0;
    vndf_stretched w = vndf_stretched_of(view);
    if (x > 0.0) { /* straight up and down the azimuth is the normal's own; that of a level normal is 0 */
        double per = w.s > 0.0 ? w.per_length / (w.s * x) : 1.0 / x;
        cosine = per * (w.s > 0.0 ? level : mx);
        sine = per * fabs(w.s > 0.0 ? w.x * my - w.y * mx : my);
    }
    return ray_from(view, &w, cosine, sine, x > 0.0 ? level * w.per_length / x : w.s);
}

double vndf_engine_density_on(const vndf_view *view, const vndf_azimuth_slice *slice, vndf_normal wm,
                              double facing)
{
    double ax = view->alpha_x, ay = view->alpha_y, mx = wm.x / ax, my = wm.y / ay, x = sqrt(mx * mx + my * my);
    double scale = 1.0 / (x + wm.z), per_length = vndf_stretched_of(view).per_length;
    double density = vndf_azimuth_slice_density(slice, x * scale, wm.z * scale, facing * per_length * scale);
    return density * scale * scale * scale / (ax * ay);
}

/* Any normal that faces wi. */
VNDF_RARE double density_exactly(const vndf_view *view, const vndf_query *g)
{
    vndf_normal wm = {g->x, g->y, g->z};
    vndf_azimuth_slice slice = vndf_azimuth_slice_of(view, wm);
    return vndf_engine_density_on(view, &slice, wm, vndf_query_facing(g));
}

/* The cases of density.h and density_wedge.h first. */
double vndf_engine_density(const vndf_view *view, const vndf_query *g)
{
    const vndf_distribution *d = view->distribution;
    int toward = vndf_query_along(g) >= 0.0;
    doubles_m plain = 1;
    double density = vndf_is_below(view) ? vndf_query_of_wedge(d, g, 1, &plain)
                     : toward            ? vndf_query_in_front(d, g, &plain)
                                         : vndf_query_of_wedge(d, g, 0, &plain);
    return plain ? density : density_exactly(view, g);
}

/* ---- D ---- */

double vndf_engine_p22_over_z4(const vndf_distribution *d, double x, double z)
{
    vndf_radial_location at = vndf_radial_location_at(d, x, z);
    vndf_quotient p22 = vndf_radial_location_p22(d, &at);
    return p22.above > 0.0 ? p22.above / p22.below : 0.0;
}
