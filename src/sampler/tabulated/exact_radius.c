/* The slope length at one azimuth in double (exact.h). radial.h explains its law, and the cells at the cut and beside
 * it. */
#include "sampler/tabulated/density_wedge.h"
#include "sampler/tabulated/exact.h"
#include "sampler/tabulated/radial.h"

/* ---- places ---- */

/* A place in the table. */
typedef struct place {
    uint32_t cell;
    vndf_exact_place in;
} place;

static place place_of(const vndf_distribution *d, double x, double z)
{
    vndf_radial_location found = vndf_radial_location_at(d, x, z);
    double per = 1.0 / (found.inner + found.outer);
    place at = {found.cell, {found.inner * per, found.outer * per}};
    return at;
}

/* The slope at a place; knots have X + Z = 1 but for their rounding. */
static vndf_exact_slope slope_at(const vndf_distribution *d, place at)
{
    const vndf_knot *k = d->knots.at + at.cell;
    vndf_exact_slope slope = {at.in.eta * k[0].x + at.in.xi * k[1].x, at.in.eta * k[0].z + at.in.xi * k[1].z};
    return slope;
}

/* ---- cells ---- */

/* W at a knot, below 0 where it is not visible. */
static double weight_at(const vndf_azimuth_slice *law, uint32_t j)
{
    return law->c * law->table->knots.at[j].z + law->k * law->table->knots.at[j].x;
}

static double knot_weight(const vndf_azimuth_slice *law, uint32_t j)
{
    double w = weight_at(law, j);
    return w > 0.0 ? w : 0.0;
}

/* The visible part of cell j, which holds the cut. Below the horizon the visible end is the outer one, and the cubic is
 * turned. */
static vndf_engine_piece piece_at_cut(const vndf_azimuth_slice *law, uint32_t j)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    const doubles_four f = {cell->f0, cell->f1, cell->mu0, cell->mu1};
    int above = law->c > 0.0;
    vndf_bump bump = vndf_bump_of(f), turned = {bump.a + bump.b, -bump.b}, bend = above ? bump : turned;
    double near = above ? f.a : f.b, far = above ? f.b : f.a, w = knot_weight(law, above ? j : j + 1);
    double h = vndf_visible_part(w, weight_at(law, above ? j + 1 : j)), half = 0.5 * w * h;
    double cubic = near * (1.0 - h) + far * h + h * (1.0 - h) * (bend.a + bend.b * h);
    double seen = near * half, cut = (cubic > 0.0 ? cubic : 0.0) * half;
    double mass = w * h * vndf_bump_part(near, far, bend, h);
    vndf_engine_piece inside = {seen, cut, mass, w, 0.0, 0.0, h, 1};
    vndf_engine_piece beyond = {cut, seen, mass, 0.0, w, 1.0 - h, h, 1};
    return above ? inside : beyond;
}

/* Beyond the cut V is W; radial.h derives V in the second cell inside. V and W vanish together. */
static void weigh_piece(vndf_engine_piece *p, const vndf_azimuth_slice *law, uint32_t j)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    double w0 = p->v0, w1 = p->v1, way = 16.0 * law->part;
    p->weighted = 1;
    if (j + 2 == law->cut)
        p->v1 += (way < 1.0 ? way : 1.0) * (w0 - w1);
    double half = 0.5 * (p->v0 + p->v1);
    p->e0 = cell->f0 * half;
    p->e1 = cell->f1 * (p->v1 > 0.0 ? w1 / p->v1 : 1.0) * half;
}

vndf_engine_piece vndf_engine_piece_of(const vndf_azimuth_slice *law, uint32_t j)
{
    if (j == law->cut)
        return piece_at_cut(law, j);
    const vndf_radial_cell *cell = &law->table->cells[j];
    double w0 = knot_weight(law, j), w1 = knot_weight(law, j + 1);
    vndf_engine_piece p = {cell->f0 * w0, cell->f1 * w1, w0 * cell->mu0 + w1 * cell->mu1, w0, w1, 0.0, 1.0, 0};
    if (j + 2 >= law->cut)
        weigh_piece(&p, law, j);
    return p;
}

static vndf_exact_cell cell_of(const vndf_engine_piece *p)
{
    vndf_exact_cell cell = {p->e0, p->e1, p->mass};
    return cell;
}

/* A place in the rational cell of a piece, zeta over xi, and (dzeta/dxi) over the weight. */
typedef struct inner {
    vndf_exact_place in;
    double ratio, per;
} inner;

/* The place where the normal has the weight w. */
static inner inner_of(const vndf_engine_piece *p, vndf_exact_place at, double w)
{
    double xi = at.xi, eta = at.eta;
    if (p->length < 1.0) {
        xi /= p->length;
        eta /= p->length;
        xi = p->begin > 0.0 ? (eta < 1.0 ? 1.0 - eta : 0.0) : xi;
        eta = p->begin > 0.0 ? eta : (xi < 1.0 ? 1.0 - xi : 0.0);
    }
    inner in = {{xi, eta}, 1.0, 1.0};
    if (p->weighted) {
        double per = 1.0 / (p->v0 + p->v1), v = p->v0 * eta + p->v1 * xi;
        in.ratio = (p->v0 + v) * per;
        in.in.xi = xi * in.ratio;
        in.in.eta = eta * ((v + p->v1) * per);
        in.per = 2.0 * (p->length < 1.0 ? w : v) * per;
    }
    return in;
}

/* ---- density ---- */

/* Mass per xi over xi in a rational cell where e0 = 0. */
static double density_over(const vndf_engine_piece *p, vndf_exact_place at)
{
    double q = 1.0 + (p->e1 / p->mass - 2.0) * (at.xi * at.eta);
    return (p->e1 * at.xi + 2.0 * p->mass * at.eta) / (q * q);
}

/* Mass per xi over X at a place where the normal has the weight w. Where f begins at 0, the mass per xi does so as X
 * does, and their quotient is finite. */
VNDF_INLINE double density_over_x(const vndf_azimuth_slice *law, const vndf_engine_piece *p, place at, double w)
{
    inner in = inner_of(p, at.in, w);
    double per = in.per / p->length;
    if (at.cell == 0 && p->e0 == 0.0)
        return per * in.ratio * density_over(p, in.in) / (p->length * law->table->knots.at[1].x);
    vndf_exact_cell cell = cell_of(p);
    return per * vndf_exact_cell_density(&cell, in.in) / slope_at(law->table, at).x;
}

/* Whether rounding took a place beyond the cut. */
static int is_hidden(const vndf_azimuth_slice *law, uint32_t cell)
{
    return law->cut < law->table->radial_count && (law->c > 0.0 ? cell > law->cut : cell < law->cut);
}

double vndf_azimuth_slice_density(const vndf_azimuth_slice *law, double x, double z, double w)
{
    place at = place_of(law->table, x, z);
    int hidden = is_hidden(law, at.cell);
    if (!(law->mass > 0.0) || !(law->azimuth > 0.0))
        return 0.0;
    vndf_engine_piece p = vndf_engine_piece_of(law, hidden ? law->cut : at.cell);
    if (!(p.length > 0.0))
        return 0.0;
    if (hidden) { /* by rounding alone, since w > 0: the place is the cut */
        place end = {law->cut, {law->c > 0.0 ? p.length : p.begin, law->c > 0.0 ? 1.0 - p.length : p.length}};
        at = end;
    }
    /* from X + Z = 1 of the normal to X + Z of the knots */
    vndf_exact_slope slope = slope_at(law->table, at);
    double sum = slope.x + slope.z, density = density_over_x(law, &p, at, w * sum) * (sum * sum * sum);
    return law->azimuth * density / (law->mass * law->table->cells[at.cell].width);
}

double vndf_engine_piece_density(const vndf_azimuth_slice *law, const vndf_engine_piece *p, uint32_t j, double xi,
                                 double eta)
{
    place at = {j, {xi, eta}};
    vndf_exact_slope slope = slope_at(law->table, at);
    double w = law->k * slope.x + law->c * slope.z;
    return w > 0.0 && p->length > 0.0 && law->mass > 0.0
               ? law->azimuth * slope.x * density_over_x(law, p, at, w) / law->mass
               : 0.0;
}

/* Many places of a piece that is not cut and whose density does not begin at 0, without a branch: compilers make lanes
 * of it. Of one place they differ by rounding: X cancels, and one quotient serves all. */
static void densities_plain(const vndf_azimuth_slice *law, const vndf_engine_piece *p,
                            const vndf_engine_places *at, double *restrict density)
{
    const double *restrict xi = at->xi, *restrict eta = at->eta;
    const vndf_exact_cell cell = cell_of(p);
    const double per = law->azimuth / law->mass;
    for (size_t i = 0; i < at->count; i++) {
        vndf_exact_place in = {xi[i], eta[i]};
        density[i] = per * vndf_exact_cell_density(&cell, in);
    }
}

static void densities_weighted(const vndf_azimuth_slice *law, const vndf_engine_piece *p,
                               const vndf_engine_places *at, double *restrict density)
{
    const double *restrict xi = at->xi, *restrict eta = at->eta;
    const vndf_exact_cell cell = cell_of(p);
    const double v0 = p->v0, v1 = p->v1, per = 1.0 / (v0 + v1), over = 2.0 * per * (law->azimuth / law->mass);
    for (size_t i = 0; i < at->count; i++) {
        double v = v0 * eta[i] + v1 * xi[i];
        vndf_exact_place in = {xi[i] * ((v0 + v) * per), eta[i] * ((v + v1) * per)};
        density[i] = over * (v * vndf_exact_cell_density(&cell, in));
    }
}

void vndf_engine_piece_densities(const vndf_azimuth_slice *law, const vndf_engine_piece *p, uint32_t j,
                                 const vndf_engine_places *at, double *density)
{
    int plain = p->length == 1.0 && p->begin == 0.0 && law->mass > 0.0 && !(j == 0 && p->e0 == 0.0);
    if (!plain)
        for (size_t i = 0; i < at->count; i++)
            density[i] = vndf_engine_piece_density(law, p, j, at->xi[i], at->eta[i]);
    else if (p->weighted)
        densities_weighted(law, p, at, density);
    else
        densities_plain(law, p, at, density);
}

/* ---- mass ---- */

/* Mass of the law before knot j, c >= 0. */
static double mass_before(const vndf_azimuth_slice *law, uint32_t j)
{
    const vndf_knots *knots = &law->table->knots;
    return law->k < 0.0 ? law->c * knots->pole[j].e + knot_weight(law, j) * knots->pole[j].g
                        : law->c * knots->f0[j] + law->k * knots->f1[j];
}

/* Mass beyond knot j, c < 0. */
static double mass_beyond(const vndf_azimuth_slice *law, uint32_t j)
{
    const vndf_tail_sums *tail = &law->table->knots.tail[j];
    return law->k * tail->s + knot_weight(law, j) * tail->t;
}

/* Finds the cut and the mass of a law. */
void vndf_exact_law_find(vndf_azimuth_slice *law)
{
    const vndf_distribution *d = law->table;
    double c = law->c, k = law->k;
    law->cut = d->radial_count;
    law->part = law->mass = 0.0;
    if (c >= 0.0 && k >= 0.0) {
        law->mass = c * d->f0_total + k * d->f1_total;
        return;
    }
    if (!(c > 0.0) && !(k > 0.0))
        return;
    uint32_t j = law->cut = vndf_radial_location_at(d, fabs(c), fabs(k)).cell;
    vndf_engine_piece p = piece_at_cut(law, j);
    law->part = p.length;
    law->mass = p.mass + (c > 0.0 ? mass_before(law, j) : mass_beyond(law, j + 1));
}

static double unit(double part)
{
    return part > 0.0 ? (part < 1.0 ? part : 1.0) : 0.0;
}

/* The part of the mass before a place in the piece p, counted from the side where nothing cancels. */
static double part_in(const vndf_azimuth_slice *law, const vndf_engine_piece *p, place at)
{
    int above = law->c >= 0.0;
    if (!(law->mass > 0.0) || is_hidden(law, at.cell))
        return above ? 1.0 : 0.0;
    vndf_exact_cell cell = cell_of(p);
    double inside =
        p->length > 0.0 && p->mass > 0.0 ? vndf_exact_cell_before(&cell, inner_of(p, at.in, 0.0).in) : 0.0;
    return above ? unit((mass_before(law, at.cell) + inside) / law->mass)
                 : 1.0 - unit((mass_beyond(law, at.cell + 1) + (p->mass - inside)) / law->mass);
}

double vndf_azimuth_slice_part(const vndf_azimuth_slice *law, double x, double z)
{
    place at = place_of(law->table, x, z);
    vndf_engine_piece p = vndf_engine_piece_of(law, at.cell);
    return part_in(law, &p, at);
}

vndf_exact_part vndf_exact_law_part(const vndf_azimuth_slice *law, vndf_exact_slope slope)
{
    place at = place_of(law->table, slope.x, slope.z);
    vndf_engine_piece p = vndf_engine_piece_of(law, at.cell);
    vndf_exact_cell cell = cell_of(&p);
    vndf_exact_part part = {law->mass > 0.0 ? part_in(law, &p, at) : 0.5, 0.0};
    if (p.weighted)
        return part;
    vndf_exact_slope on = slope_at(law->table, at);
    double per = (on.x * on.x + on.z * on.z) / (law->mass * law->table->cells[at.cell].width);
    part.rate = vndf_exact_cell_density(&cell, at.in) * per;
    return part;
}

/* ---- drawing ---- */

/* The cell in which the mass `target` ends, c >= 0, by its window. */
static uint32_t search_before(const vndf_azimuth_slice *law, double u, double target)
{
    float c = (float)law->c, k = (float)law->k;
    uint32_t last = law->cut < law->table->radial_count ? law->cut : law->table->radial_count - 1;
    uint32_t code = vndf_window_of(law->table, c, k, (float)u);
    uint32_t j = vndf_radial_find_one(law->table, code, c, k, (float)target, k >= 0.0f);
    return j < last ? j : last;
}

/* The place in a piece from the place in its rational cell, xi from zeta (math/weighted_cell.h): xi : eta =
 * zeta/(v0 + V) : (1 - zeta)/(v1 + V). Unless the piece is cut, the result may have any factor. */
static vndf_exact_place place_in_piece(const vndf_engine_piece *p, vndf_exact_place zeta)
{
    if (!p->weighted)
        return zeta;
    double v = sqrt(p->v0 * p->v0 * zeta.eta + p->v1 * p->v1 * zeta.xi);
    vndf_exact_place in = {zeta.xi * (p->v1 + v), zeta.eta * (p->v0 + v)};
    in = v > 0.0 ? in : zeta;
    if (!(p->length < 1.0))
        return in;
    double per = p->length / (in.xi + in.eta), hidden = p->begin > 0.0 ? 0.0 : 1.0 - p->length;
    vndf_exact_place cut = {p->begin + in.xi * per, hidden + in.eta * per};
    return cut;
}

vndf_exact_slope vndf_exact_law_draw(const vndf_azimuth_slice *law, double u, uint32_t *cell)
{
    const vndf_exact_slope horizon = {1.0, 0.0};
    *cell = law->table->radial_count - 1;
    if (!(law->mass > 0.0))
        return horizon;
    int above = law->c >= 0.0;
    double target = (above ? u : 1.0 - u) * law->mass;
    uint32_t j = *cell = above ? search_before(law, u, target)
                               : vndf_find_beyond(law->table, (float)law->c, law->cut, (float)target);
    vndf_engine_piece p = vndf_engine_piece_of(law, j);
    vndf_exact_cell inside = cell_of(&p);
    double before = above ? target - mass_before(law, j) : p.mass - (target - mass_beyond(law, j + 1));
    place at = {j, place_in_piece(&p, vndf_exact_cell_invert(&inside, before))};
    return slope_at(law->table, at);
}
