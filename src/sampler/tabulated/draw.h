/* Samples in float, for one or for lanes (sampler/tabulated/theory.h): the azimuth, the radius, the normal, its
 * density, and whether float is trusted. */
#ifndef VNDF_SAMPLER_TABULATED_DRAW_H
#define VNDF_SAMPLER_TABULATED_DRAW_H

#include "sampler/tabulated/stretched_view.h"
#include "sampler/tabulated/radial.h"

/* The horizontal unit vector at an azimuth of the turned frame, stretched back; and its square. */
typedef struct vndf_level {
    lanes_f x, y, square;
} vndf_level;

/* `half` has the sign of the azimuth. */
VNDF_INLINE vndf_level vndf_level_at(lanes_f ax, lanes_f ay, lanes_f cos_phi, lanes_f sin_phi, lanes_f cosine,
                                     lanes_f sine, lanes_f half)
{
    sine = lanes_sign(sine, half);
    vndf_level level = {ax * (cos_phi * cosine - sin_phi * sine), ay * (sin_phi * cosine + cos_phi * sine),
                        cosine};
    level.square = level.x * level.x + level.y * level.y;
    return level;
}

/* ---- whether the density at the place that was drawn is the density of the rounded normal ---- */

VNDF_INLINE lanes_m vndf_trusts_normal_in_front(lanes_f s, lanes_f c, lanes_f cosine, lanes_f x, lanes_f z)
{
    lanes_f across = s * x, along = across * cosine, up = c * z;
    return lanes_both(vndf_trusts_side(cosine), vndf_trusts_facing_in_front(across, along, up));
}

VNDF_INLINE lanes_m vndf_trusts_normal_in_wedge(lanes_f s, lanes_f c, lanes_f cosine, lanes_f x, lanes_f z)
{
    lanes_f across = s * x, along = across * cosine, up = c * z;
    return lanes_both(vndf_trusts_side(-cosine), vndf_trusts_facing_in_wedge(across, along, up));
}

/* The place is away from knots that may matter, and the density changes little from a normal to its rounded self. Most
 * cells in front of wi are known to be smooth. */
VNDF_INLINE lanes_m vndf_trusts_place_in_cell(const vndf_radial_lanes *at, const vndf_rational_cell *cell,
                                              const vndf_rational_place *in)
{
    lanes_m at_knots = lanes_less(lanes_set(1.0f), at->smooth);
    if (!lanes_any(lanes_without(lanes_all(), at_knots)))
        return lanes_all();
    lanes_m inside = lanes_less(lanes_set(0.0f), at->smooth);
    lanes_m beside = lanes_without(vndf_is_beside_knot(in->over, in->under), at_knots);
    return lanes_without(lanes_either(inside, vndf_radial_is_trusted(at, cell, in)), beside);
}

/* ---- the normal ---- */

typedef struct vndf_drawn {
    lanes_f x, y, z, density;
} vndf_drawn;

/* A place in the table, (X, Z) of any length. The density of the normal is above/below times the third power of the
 * normal's, since dwm is ax ay X Z^2 dR da over that power. */
typedef struct vndf_place {
    lanes_f x, z, above, below;
} vndf_place;

/* Neither division waits for the root. Clears *trusted where numbers underflow, or overflow as a hostile table may make
 * them. */
VNDF_INLINE vndf_drawn vndf_drawn_at(const vndf_level *level, const vndf_place *at, lanes_m *trusted)
{
    lanes_f square = at->x * at->x * level->square + at->z * at->z, root = lanes_root(square);
    lanes_f per = root * (1.0f / square), density = at->above * square * (1.0f / at->below) * root;
    vndf_drawn n = {at->x * level->x * per, at->x * level->y * per, at->z * per, density};
    *trusted =
        lanes_both(*trusted, lanes_both(vndf_trusts_lengths(square, at->below), vndf_trusts_density(density)));
    return n;
}

/* ---- the azimuth ---- */

/* The surface and the direction of a sample. */
typedef struct vndf_incidence {
    lanes_f ax, ay, s, c, cos_phi, sin_phi, spread;
    lanes_m trusted;
} vndf_incidence;

VNDF_INLINE vndf_incidence vndf_incidence_from(lanes_f ax, lanes_f ay, const vndf_stretched_view *stretched)
{
    vndf_incidence w = {ax,
                        ay,
                        stretched->s,
                        stretched->c,
                        stretched->cos_phi,
                        stretched->sin_phi,
                        stretched->area * (ax * ay),
                        vndf_trusts_scale(ax, ay, stretched->c)};
    return w;
}

/* The same from a view, equal in all lanes. */
VNDF_INLINE vndf_incidence vndf_incidence_of(const vndf_view *v)
{
    vndf_incidence w = {lanes_set(v->ax),
                        lanes_set(v->ay),
                        lanes_set(v->of.table.s),
                        lanes_set(v->of.table.c),
                        lanes_set(v->of.table.cos_phi),
                        lanes_set(v->of.table.sin_phi),
                        lanes_set(v->of.table.spread),
                        v->trusted ? lanes_all() : lanes_none()};
    return w;
}

/* The range where an azimuth is drawn: in front of wi or in the wedge, and its mass. `apart` is the mass from the side
 * of wi, where both ranges begin, to the azimuth, with the sign of the azimuth. */
typedef struct vndf_azimuth_range {
    lanes_m in_front;
    lanes_f mass, apart;
} vndf_azimuth_range;

/* |half| is the part of a half turn's mass between straight ahead and the azimuth; `half` = 2 u1 - 1. */
VNDF_INLINE vndf_azimuth_range vndf_azimuth_range_at(lanes_f front, lanes_f wedge, lanes_f half)
{
    lanes_f target = lanes_abs(half), rest = front * (1.0f - target) - target * wedge; /* wedge comes late */
    lanes_m in_front = lanes_less(lanes_set(0.0f), rest);
    vndf_azimuth_range range = {in_front, lanes_pick(in_front, front, wedge), lanes_sign(rest, half)};
    return range;
}

/* A sample whose azimuth is drawn: the inputs of its radius and its normal. */
typedef struct vndf_azimuth_sample {
    vndf_level level;
    lanes_f cosine, c, k;   /* of the azimuth; weights of the law of the radius */
    lanes_f total, density; /* the law's mass; mass per radian of the azimuth, in the wedge */
    lanes_u code;           /* of the window where the radius is */
} vndf_azimuth_sample;

/* ---- in front of wi ---- */

/* Where the azimuth is about (vndf_front_start). */
VNDF_INLINE lanes_f vndf_azimuth_about(const vndf_distribution *d, const vndf_incidence *w,
                                       const vndf_azimuth_range *range)
{
    return vndf_front_start(vndf_front_of(d, w->s, w->c), lanes_abs(range->apart), range->mass);
}

VNDF_INLINE vndf_azimuth_sample vndf_azimuth_sample_from(const vndf_distribution *d, const vndf_incidence *w,
                                                         const vndf_azimuth_range *range, lanes_f about,
                                                         lanes_f u2)
{
    lanes_f near, k;
    vndf_azimuth a = vndf_front_step(vndf_front_of(d, w->s, w->c), lanes_abs(range->apart), about, &near);
    lanes_u code = vndf_window_of(d, w->c, w->s * near, u2); /* windows are wide enough for `near` */
    k = w->s * a.c;
    vndf_azimuth_sample b = {vndf_level_at(w->ax, w->ay, w->cos_phi, w->sin_phi, a.c, a.s, range->apart),
                             a.c,
                             w->c,
                             k,
                             vndf_radial_total(d, w->c, k),
                             a.c,
                             code};
    return b;
}

VNDF_INLINE vndf_azimuth_sample vndf_azimuth_sample_front(const vndf_distribution *d, const vndf_incidence *w,
                                                          const vndf_azimuth_range *range, lanes_f u2)
{
    return vndf_azimuth_sample_from(d, w, range, vndf_azimuth_about(d, w, range), u2);
}

/* X and Z at a place in a cell, times in->under. */
VNDF_INLINE vndf_place vndf_place_in(const vndf_radial_lanes *cell, const vndf_rational_place *in)
{
    vndf_place at = {in->rest * cell->x0 + in->over * cell->x1, in->rest * cell->z0 + in->over * cell->z1,
                     in->root, in->below};
    return at;
}

/* The visible density at a place over the drawn one, which is density root/below; c and k are the true weights of the
 * law. 0 where it may not stand for that of the rounded normal. */
VNDF_INLINE lanes_f vndf_weight_in(const vndf_radial_lanes *cell, const vndf_rational_place *in,
                                   const vndf_place *at, lanes_f c, lanes_f k, lanes_f density)
{
    lanes_f per = 1.0f / in->under, xi = in->over * per, eta = 1.0f - xi, w = xi * eta,
            bump = cell->a + cell->b * xi;
    lanes_f line = cell->f0 * eta + cell->f1 * xi, f = line + w * bump;
    lanes_f rise = (cell->f1 - cell->f0) + ((eta - xi) * bump + w * cell->b);
    lanes_f seen = f * ((c * at->z + k * at->x) * per) * (in->below * (per * per)), drawn = density * in->root;
    lanes_m follows = vndf_trusts_p22(f, line + w * (lanes_abs(cell->a) + lanes_abs(cell->b)), rise, cell->width,
                                      cell->x1 * cell->z0);
    return lanes_keep(lanes_both(follows, vndf_trusts_drawn(drawn)), seen / drawn);
}

/* The place in cell j. Clears *trusted beside the cut - here at infinity, where W vanishes - where cells have another
 * form (exact_radius.c). *weight is the visible density over the drawn one, unless it is NULL. */
VNDF_INLINE vndf_place vndf_place_front(const vndf_distribution *d, const vndf_incidence *w,
                                        const vndf_azimuth_sample *b, const vndf_radial_lanes *cell, lanes_u j,
                                        lanes_f u2, lanes_m *trusted, lanes_f *weight)
{
    const float lift = d->lift;
    vndf_radial_law law = vndf_radial_law_whole(d, lift * b->c, lift * b->k);
    vndf_rational_cell in_cell = vndf_radial_cell_away(&law, cell);
    lanes_f before = vndf_radial_before_whole(&law, cell);
    vndf_rational_place in = vndf_rational_invert(&in_cell, lanes_positive(u2 * (lift * b->total) - before));
    vndf_place at = vndf_place_in(cell, &in);
    *trusted = lanes_both(*trusted, vndf_trusts_normal_in_front(w->s, w->c, b->cosine, at.x, at.z));
    *trusted = lanes_both(*trusted, vndf_trusts_place_in_cell(cell, &in_cell, &in));
    *trusted = lanes_both(*trusted, lanes_at_most_u(j + 3u, lanes_set_u(d->radial_count)));
    *trusted = lanes_both(*trusted, vndf_trusts_root(in.root));
    if (weight)
        *weight = vndf_weight_in(cell, &in, &at, law.c, law.k, lanes_set(1.0f));
    at.below *= (lift * cell->width) * (w->spread * at.x);
    return at;
}

/* ---- in the wedge above the horizon ---- */

/* The weights (c, k) of the law of the radius, times n, at an azimuth of the wedge counted from the far side. */
VNDF_INLINE vndf_azimuth_sample vndf_azimuth_sample_wedge(const vndf_distribution *d, const vndf_incidence *w,
                                                          const vndf_azimuth_range *range, const vndf_azimuth *a,
                                                          lanes_f u2)
{
    lanes_f per = 1.0f / a->n, cosine = -a->c * per, c = w->c * a->n, k = w->s * -a->c;
    vndf_azimuth_sample b = {vndf_level_at(w->ax, w->ay, w->cos_phi, w->sin_phi, cosine, a->s * per, range->apart),
                             cosine,
                             c,
                             k,
                             c,
                             a->density * range->mass,
                             vndf_window_of(d, c, k, u2)};
    return b;
}

/* The same in the wedge. */
VNDF_INLINE vndf_place vndf_place_wedge(const vndf_distribution *d, const vndf_incidence *w,
                                        const vndf_azimuth_sample *b, const vndf_radial_law *unscaled,
                                        const vndf_radial_lanes *cell, lanes_u j, lanes_f u2, lanes_m *trusted,
                                        lanes_f *weight)
{
    const float lift = d->lift;
    vndf_radial_law law = vndf_radial_scaled(*unscaled, b->total, lift);
    vndf_rational_cell in_cell = vndf_radial_cell_away(&law, cell);
    lanes_f before = vndf_radial_before(&law, cell);
    vndf_rational_place in = vndf_rational_invert(&in_cell, lanes_positive(lift * u2 - before));
    vndf_place at = vndf_place_in(cell, &in);
    *trusted = lanes_both(*trusted, vndf_trusts_normal_in_wedge(w->s, w->c, b->cosine, at.x, at.z));
    *trusted = lanes_both(*trusted, vndf_trusts_place_in_cell(cell, &in_cell, &in));
    *trusted = lanes_both(*trusted, vndf_radial_is_away(&law, j));
    *trusted = lanes_both(*trusted, unscaled->trusted);
    *trusted = lanes_both(*trusted, vndf_trusts_root(in.root));
    if (weight) /* b->c is n times the direction's; in.root is lift/total times */
        *weight = vndf_weight_in(cell, &in, &at, lift * w->c * b->c, lift * w->c * b->k, b->c * b->density);
    at.above *= b->density;
    at.below *= (lift * cell->width) * (w->spread * at.x);
    return at;
}

#endif
