#include "fit/law.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* ---- spans ---- */

vndf_span vndf_span_between(double r0, double r1)
{
    double z0 = 1 / (1 + r0), z1 = 1 / (1 + r1);
    vndf_span span = {r0, r0 * z0, z0, (r1 - r0) * z0 * z1, 0};
    return span;
}

vndf_span vndf_span_of_tail(double r0, unsigned squarings)
{
    double z0 = 1 / (1 + r0), power = (double)(1u << squarings);
    vndf_span span = {r0, r0 * z0, z0, power * z0, power};
    return span;
}

double vndf_span_place(const vndf_span *span, double r)
{
    double z = 1 / (1 + r);
    if (span->power == 0)
        return (r - span->r) * z * span->z / span->h;
    double left = z / span->z;
    return 1 - (span->power == 1 ? left : pow(left, 1 / span->power));
}

double vndf_span_density(const vndf_span *span, double r)
{
    double z = 1 / (1 + r);
    if (span->power == 0)
        return z * z / span->h;
    return z / span->power * (1 - vndf_span_place(span, r));
}

static double end_x(const vndf_span *span)
{
    return span->power == 0 ? span->x + span->h : 1;
}

static double end_z(const vndf_span *span)
{
    return span->power == 0 ? span->z - span->h : 0;
}

/* ---- one cell ---- */

/* z^2 W, wq with what w4 adds in the mean of the cell. */
static double flat(const vndf_weight *w, double wq, double x, double z)
{
    return w->w1 * x * x + w->w0 * x * z + wq * z * z;
}

vndf_drawn vndf_drawn_by(const vndf_span *span, const vndf_cell *cell, const vndf_weight *w)
{
    double r = span->r, first = 2 * w->w1 * r + w->w0, wq = w->wq + w->w4 * cell->cube;
    vndf_drawn drawn = {w->w1 * cell->m2 + first * cell->m1 + ((w->w1 * r + w->w0) * r + wq) * cell->m0,
                        cell->g0 * flat(w, wq, span->x, span->z),
                        cell->g1 * flat(w, wq, end_x(span), end_z(span))};
    return drawn;
}

/* z^2 W at the right end. */
static double below_flat(const vndf_span *span, double rho, double b0, double b1)
{
    double x = end_x(span), z = end_z(span), way = x - rho * z;
    if (span->power == 0) /* the difference of slopes keeps its digits */
        way = (span->r - rho) * z + span->h / span->z;
    return way * (b0 * x + b1 * way);
}

vndf_drawn vndf_drawn_below(const vndf_span *span, const vndf_cell *cell, double rho, double b0, double b1)
{
    double r = span->r, d = r - rho, e = b0 * r + b1 * d;
    vndf_drawn drawn = {(b0 + b1) * cell->m2 + ((b0 + b1) * d + e) * cell->m1 + d * e * cell->m0,
                        cell->g0 * (d * span->z) * (e * span->z), cell->g1 * below_flat(span, rho, b0, b1)};
    return drawn;
}

/* The mass before xi. */
static double before(const vndf_drawn *d, double xi)
{
    double w = xi * (1 - xi), under = d->mass + (d->d0 + d->d1 - 2 * d->mass) * w;
    return under > 0 ? d->mass * (d->mass * xi * xi + d->d0 * w) / under : 0;
}

double vndf_drawn_part(const vndf_drawn *d, double xi, double width)
{
    const double wide = 0.2; /* no point of a rule over a whole cell stands for more */
    if (width < wide)
        return vndf_drawn_density(d, fmax(xi, 0)) * width;
    return before(d, fmin(xi + width / 2, 1)) - before(d, fmax(xi - width / 2, 0));
}

/* ---- tables ---- */

vndf_kernel vndf_kernel_of(unsigned moments)
{
    static const vndf_kernel kernel[3] = {{.934604, 2.206989, 0, 0},
                                          {1.00473604, 1.48847826, 0.64837836, 0},
                                          {0.99928177, 1.58441365, 0.47441838, 0.08347885}};
    return kernel[moments - 2];
}

static vndf_cell cell_of(const vndf_table_draft *d, unsigned i)
{
    vndf_cell cell = {d->g0[i], d->g1[i], d->m0[i], d->m1[i], d->m2[i], d->cubes && i > 0 ? d->cubes[i] : 0};
    return cell;
}

static double turn_of(const vndf_table_draft *d, unsigned i)
{
    if (i < 2)
        return i == 0 ? 0 : 0.75 * d->knot[1];
    double before = d->knot[i - 1], here = d->knot[i];
    return fmin(here, fmax(before / 0.8, sqrt(before * here)));
}

/* The mass of the cell that rho lies in, as it is estimated: W vanishes at rho and grows about evenly. */
static double estimate(const vndf_span *span, const vndf_cell *cell, double rho, double xi, double b0, double b1)
{
    double part = 1 - xi, here = cell->g0 + xi * (cell->g1 - cell->g0);
    return part * below_flat(span, rho, b0, b1) * (cell->g1 / 3 + here / 6);
}

static void fill(vndf_laws *laws, unsigned i)
{
    const vndf_table_draft *d = laws->draft;
    double r = d->knot[i], b0 = d->b0[i], b1 = d->b1[i];
    laws->cell[i] = cell_of(d, i);
    laws->span[i] = i < laws->cells ? vndf_span_between(r, d->knot[i + 1]) : vndf_span_of_tail(r, d->squarings);
    laws->turn[i] = turn_of(d, i);
    laws->part[i] = fmin(vndf_drawn_below(&laws->span[i], &laws->cell[i], r, b0, b1).mass /
                             estimate(&laws->span[i], &laws->cell[i], r, 0, b0, b1),
                         1e3);
}

void vndf_laws_read(vndf_laws *laws)
{
    for (unsigned i = 0; i <= laws->cells; i++)
        fill(laws, i);
}

int vndf_laws_from(vndf_laws *laws, const vndf_table_draft *draft)
{
    size_t n = draft->cells + 1;
    vndf_laws made = {draft,
                      draft->cells,
                      malloc(n * sizeof *made.span),
                      malloc(n * sizeof *made.cell),
                      malloc(n * sizeof *made.turn),
                      malloc(n * sizeof *made.part)};
    *laws = made;
    int good = made.span && made.cell && made.turn && made.part;
    if (good)
        vndf_laws_read(laws);
    return good;
}

void vndf_laws_free(vndf_laws *laws)
{
    free(laws->span);
    free(laws->cell);
    free(laws->turn);
    free(laws->part);
}

/* The last index whose value is at most a number. */
static unsigned last_at_most(const double *value, unsigned count, double number)
{
    unsigned low = 0, high = count;
    while (high - low > 1) {
        unsigned middle = (low + high) / 2;
        if (value[middle] <= number)
            low = middle;
        else
            high = middle;
    }
    return low;
}

unsigned vndf_laws_cell(const vndf_laws *laws, double r)
{
    unsigned low = 0, high = laws->cells + 1;
    while (high - low > 1) {
        unsigned middle = (low + high) / 2;
        if (laws->span[middle].r <= r)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* ---- directions ---- */

/* Rho as the run time rounds it (table.h). */
static double rounded(double rho)
{
    int exponent;
    double part = frexp(rho, &exponent), quarter = 4 * (exponent - 1 + 16) + floor(8 * part) - 4;
    return vndf_rounded_rho((int)fmin(fmax(quarter, 0), VNDF_RHO_PARTS - 1));
}

static void weigh_above(vndf_law *law)
{
    vndf_kernel k = vndf_kernel_of(law->laws->draft->moments);
    double c = law->c, s = law->s, rho = law->rho;
    law->first = last_at_most(law->laws->turn, law->laws->cells + 1, rounded(rho));
    law->near = (vndf_weight){0, c, 0, 0};
    law->far = (vndf_weight){s * k.a1 / PI, c * k.a0 / PI, c * rho * k.aq / PI,
                             rho < 1e-3 ? 0 : c * pow(rho, 4) * k.a4 / PI};
    law->end = (vndf_weight){law->far.w1, c, 0, 0};
}

static void weigh_below(vndf_law *law)
{
    const vndf_laws *laws = law->laws;
    const vndf_table_draft *d = laws->draft;
    unsigned i = law->first = vndf_laws_cell(laws, law->rho), next = i < laws->cells ? i + 1 : i;
    law->xi = vndf_span_place(&laws->span[i], law->rho);
    law->b0 = d->b0[i] + law->xi * ((double)d->b0[next] - d->b0[i]);
    law->b1 = d->b1[i] + law->xi * ((double)d->b1[next] - d->b1[i]);
}

vndf_law vndf_law_of(const vndf_laws *laws, double rho, int below)
{
    vndf_law law = {.laws = laws, .rho = rho, .s = 1 / (1 + rho), .c = rho / (1 + rho), .below = below};
    if (below)
        weigh_below(&law);
    else
        weigh_above(&law);
    return law;
}

static vndf_drawn scaled(vndf_drawn drawn, double by)
{
    drawn.mass *= by;
    drawn.d0 *= by;
    drawn.d1 *= by;
    return drawn;
}

static vndf_drawn partial_cell(const vndf_law *law)
{
    unsigned i = law->first;
    const vndf_span *span = &law->laws->span[i];
    const vndf_cell *cell = &law->laws->cell[i];
    vndf_drawn drawn = {law->laws->part[i] * estimate(span, cell, law->rho, law->xi, law->b0, law->b1), 0,
                        (1 - law->xi) * cell->g1 * below_flat(span, law->rho, law->b0, law->b1)};
    return scaled(drawn, law->s / PI);
}

vndf_drawn vndf_law_cell(const vndf_law *law, unsigned i)
{
    const vndf_laws *laws = law->laws;
    const vndf_span *span = &laws->span[i];
    if (law->below && i == law->first)
        return partial_cell(law);
    if (law->below)
        return scaled(vndf_drawn_below(span, &laws->cell[i], law->rho, law->b0, law->b1), law->s / PI);
    const vndf_weight *far = i == 0 || law->first == laws->cells ? &law->end : &law->far;
    return vndf_drawn_by(span, &laws->cell[i], i < law->first ? &law->near : far);
}

double vndf_law_area(const vndf_law *law)
{
    double sum = 0;
    for (unsigned i = law->below ? law->first : 0; i <= law->laws->cells; i++)
        sum += vndf_law_cell(law, i).mass;
    return sum;
}

/* The spline of A/(c + s) above the horizon, against x = c/(c + s). */
static double spline(const vndf_laws *laws, double rho)
{
    const vndf_table_draft *d = laws->draft;
    unsigned i = vndf_laws_cell(laws, rho);
    const vndf_span *span = &laws->span[i];
    int last = i == laws->cells;
    double width = last ? span->z : span->h, t = last ? 1 - 1 / (1 + rho) / span->z : vndf_span_place(span, rho);
    double a0 = d->area[i], a1 = last ? 1 : d->area[i + 1], u = 1 - t;
    double d0 = d->slope[i] * width, d1 = (last ? 1 : d->slope[i + 1]) * width;
    return u * u * ((1 + 2 * t) * a0 + t * d0) + t * t * ((1 + 2 * u) * a1 - u * d1);
}

double vndf_law_public_area(const vndf_law *law, double drawn)
{
    double above = spline(law->laws, law->rho), part = fmin(fmax((drawn / above - 4e-4) / 1.6e-3, 0), 1);
    return law->below ? drawn + part * (above - law->c - drawn) : above;
}
