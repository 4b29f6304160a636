/* The azimuth in double (exact.h): the front, and the rows of a wedge mixed by their shares (density_wedge.h). */
#include "sampler/tabulated/density_wedge.h"
#include "sampler/tabulated/exact.h"
#include "sampler/tabulated/front.h"

static const double QUARTER_TURN = 1.57079632679489662;

/* ---- rows: azimuths with cos >= 0, masses times the square of shares ---- */

/* Cell j of the mix, `width` wide in q. */
static vndf_exact_cell cell_of(const vndf_wedge *w, const vndf_shares *s, uint32_t j, double width)
{
    vndf_mixed_cell mixed = vndf_shares_cell(w, s, j);
    vndf_exact_cell cell = {mixed.begin * width, mixed.end * width, mixed.mass};
    return cell;
}

/* Mass before cell j. */
static double mass_before(const vndf_wedge *w, const vndf_shares *s, uint32_t j)
{
    const float *a = w->cdf + (size_t)s->row * w->stride + j, *b = a + w->stride, *c = b + w->stride;
    return s->first * *a + s->middle * *b + s->last * *c;
}

/* The azimuth with the part `part` of the row's mass before it; the search is in float. */
static vndf_exact_azimuth row_draw(const vndf_wedge *w, double y, double part, vndf_wedge_near *near)
{
    vndf_shares s = near->shares = vndf_shares_at(w, y);
    double target = part * s.square;
    uint32_t j = vndf_azimuth_find(w, s.row, (float)s.first, (float)s.middle, (float)s.last, (float)target);
    double from = w->q[j], to = w->q[j + 1], h = to - from;
    vndf_exact_cell cell = cell_of(w, &s, j, h);
    vndf_exact_place in = vndf_exact_cell_invert(&cell, target - mass_before(w, &s, j));
    double q = from + in.xi * h, rest = (1.0 - to) + in.eta * h;
    double along = s.p * rest * (1.0 + q), aside = 2.0 * s.r * q;
    vndf_exact_azimuth a = {along, aside, sqrt(along * along + aside * aside), 1};
    near->azimuth = j;
    return a;
}

/* The part of the row's mass before an azimuth. */
static vndf_exact_part row_part(const vndf_wedge *w, double y, double cosine, double sine)
{
    vndf_shares s = vndf_shares_at(w, y);
    vndf_row_place at = vndf_row_place_at(w, &s, cosine, sine, NULL);
    vndf_exact_cell cell = cell_of(w, &s, at.cell, at.width);
    vndf_exact_place in = {at.inner / at.width, at.outer / at.width};
    double before = vndf_exact_cell_before(&cell, in), per = 1.0 / s.square;
    vndf_quotient density = vndf_row_density(w, &s, &at);
    vndf_exact_part part = {(mass_before(w, &s, at.cell) + before) * per, density.above / density.below * per};
    return part;
}

/* ---- the density of a row ---- */

/* The certificates of shipped tables were measured with this order of operations; another order would change a last
 * digit in them. */

static double mixed_mass(const vndf_exact_row *row, uint32_t j)
{
    const vndf_row_cell *const *cell = row->cell;
    return row->share[0] * cell[0][j].mass + row->share[1] * cell[1][j].mass + row->share[2] * cell[2][j].mass;
}

/* Density where cell j begins. */
static double mixed_density(const vndf_exact_row *row, uint32_t j)
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

static vndf_exact_row wedge_row(const vndf_wedge *w, double y)
{
    uint32_t i = knot_before(&w->row_guide, w->row_y, y);
    double m = (y - w->row_y[i]) / (w->row_y[i + 1] - w->row_y[i]), rest = 1.0 - m;
    size_t first = 2 * (size_t)i;
    vndf_exact_row row = {{vndf_row_cells(w, first), vndf_row_cells(w, first + 1), vndf_row_cells(w, first + 2)},
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
static double row_density(const vndf_exact_row *row, double cosine, double sine)
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
    vndf_exact_cell cell = {mixed_density(row, j) * h, mixed_density(row, j + 1) * h, mixed_mass(row, j)};
    vndf_exact_place in = {xi, eta};
    double per_q = vndf_exact_cell_density(&cell, in) / h;
    double x = row->p * rest * (1.0 + q), y = 2.0 * row->r * q;
    return per_q * (x * x + y * y) / (2.0 * row->p * row->r * (1.0 + q * q));
}

/* ---- half a turn ---- */

vndf_azimuth_fan vndf_azimuth_fan_of(const vndf_distribution *d, double s, double c, int wedge)
{
    int above = c >= 0.0;
    const vndf_wedge *side = vndf_wedge_of(d, c);
    /* below it may underflow */
    double y = vndf_wedge_y(s, c), mass = above ? vndf_wedge_mass(side, y) : 1.0;
    double front = above ? c * (d->f0_total * QUARTER_TURN) + s * d->f1_total : 0.0;
    vndf_azimuth_fan fan = {.table = d, .s = s, .c = c, .mass = mass, .per = 0.5 / (front + mass)};
    if (wedge && (s > 0.0 || above))
        fan.row = wedge_row(side, y);
    return fan;
}

double vndf_azimuth_fan_density(const vndf_azimuth_fan *fan, double cosine, double sine)
{
    int toward = cosine >= 0.0, above = fan->c >= 0.0;
    if (above && toward)
        return fan->per * (fan->c * fan->table->f0_total + fan->s * fan->table->f1_total * cosine);
    if (above == toward || !(fan->row.p > 0.0))
        return 0.0;
    return fan->per * fan->mass * row_density(&fan->row, fabs(cosine), sine);
}

static vndf_front front_of(const vndf_view *view)
{
    return vndf_front_of(view->distribution, view->of.table.s, view->of.table.c);
}

static vndf_exact_azimuth draw_below(const vndf_view *view, const vndf_stretched *w, float half,
                                     vndf_wedge_near *near)
{
    const double least = 1e-7; /* at a right angle from wi nothing is visible */
    vndf_exact_azimuth a = row_draw(&view->distribution->below, w->s, half, near);
    a.cosine = a.cosine > least * a.n ? a.cosine : least * a.n;
    return a;
}

/* Rows count from the far side. Float decided that the azimuth is in the wedge, so `part` may need the clamp. */
static vndf_exact_azimuth draw_wedge(const vndf_view *view, const vndf_stretched *w, float half,
                                     vndf_wedge_near *near)
{
    double front = view->of.table.front, wedge = view->of.table.wedge;
    double part = 1.0 - (half * (front + wedge) - front) / wedge;
    part = part > 0.0 ? (part < 1.0 ? part : 1.0) : 0.0;
    vndf_exact_azimuth a = row_draw(&view->distribution->above, w->c, part, near);
    a.cosine = -a.cosine;
    return a;
}

/* front.h solves the front in float; its density is the density of the azimuth it draws. */
vndf_exact_azimuth vndf_exact_azimuth_draw(const vndf_view *view, const vndf_stretched *w, float half,
                                           vndf_wedge_near *near)
{
    float front = view->of.table.front, wedge = view->of.table.wedge, target = half * (front + wedge), about;
    if (vndf_is_below(view))
        return draw_below(view, w, half, near);
    if (wedge > 0.0f && target >= front)
        return draw_wedge(view, w, half, near);
    vndf_azimuth at = vndf_front_draw(front_of(view), lanes_positive(front - target), front, &about);
    vndf_exact_azimuth a = {at.c, at.s, 1.0, 0};
    return a;
}

static vndf_exact_part part_in_front(const vndf_view *view, double cosine, double sine)
{
    double front = view->of.table.front, total = front + view->of.table.wedge;
    float rest = vndf_front_rest(front_of(view), (float)cosine, (float)sine);
    double rate = rest > 0x1p-20 * total ? vndf_front_density(front_of(view), (float)cosine) / total : 0.0;
    vndf_exact_part part = {(front - rest) / total, rate};
    return part;
}

vndf_exact_part vndf_exact_azimuth_part(const vndf_view *view, const vndf_stretched *w, double cosine, double sine)
{
    const vndf_exact_part all = {1.0, 0.0};
    double front = view->of.table.front, wedge = view->of.table.wedge, total = front + wedge;
    int above = !vndf_is_below(view), toward = cosine >= 0.0;
    if (above && toward)
        return part_in_front(view, cosine, sine);
    if (above == toward || !(wedge > 0.0))
        return all;
    const vndf_wedge *side = vndf_wedge_of(view->distribution, w->c);
    vndf_exact_part before = row_part(side, vndf_wedge_y(w->s, w->c), fabs(cosine), sine);
    vndf_exact_part behind = {(front + (1.0 - before.part) * wedge) / total, before.rate * wedge / total};
    return above ? behind : before;
}
