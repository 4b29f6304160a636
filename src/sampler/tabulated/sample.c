/* The fast tier for one sample of a table (theory.h): draw.h draws in float, and exact.c where trust.h forbids that. */
#include "math/vector.h"
#include "sampler/tabulated/draw.h"
#include "sampler/tabulated/theory.h"

VNDF_INLINE vndf_drawn draw_in_front(const vndf_distribution *d, const vndf_incidence *w,
                                     const vndf_azimuth_range *range, float u2, lanes_m *trusted, float *weight)
{
    vndf_azimuth_sample b = vndf_azimuth_sample_front(d, w, range, u2);
    uint32_t j = vndf_radial_find_one(d, b.code, b.c, b.k, u2 * b.total, 1);
    j = j < d->radial_count - 1 ? j : d->radial_count - 1;
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    vndf_place at = vndf_place_front(d, w, &b, &cell, j, u2, trusted, weight);
    return vndf_drawn_at(&b.level, &at, trusted);
}

VNDF_INLINE vndf_drawn draw_in_wedge(const vndf_distribution *d, const vndf_incidence *w,
                                     const vndf_azimuth_range *range, float u2, lanes_m *trusted, float *weight)
{
    vndf_azimuth_row row = vndf_wedge_row(&d->above, w->c);
    float part = vndf_wedge_part(fabsf(range->apart), range->mass);
    vndf_azimuth a = vndf_azimuth_draw_one(&row, part, trusted);
    vndf_azimuth_sample b = vndf_azimuth_sample_wedge(d, w, range, &a, u2);
    vndf_radial_law law = vndf_radial_law_above(d, b.c, b.k, &b.total);
    uint32_t j = vndf_radial_find_one(d, b.code, b.c, b.k, u2 * b.total, 0);
    j = j < law.cut ? j : law.cut;
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    vndf_place at = vndf_place_wedge(d, w, &b, &law, &cell, j, u2, trusted, weight);
    return vndf_drawn_at(&b.level, &at, trusted);
}

/* Draws in float, for a trusted view. Clears *trusted where that does not do. `weight` may be NULL. */
VNDF_INLINE vndf_drawn draw(const vndf_view *view, float u1, float u2, lanes_m *trusted, float *weight)
{
    const vndf_distribution *d = view->distribution;
    float half = 2.0f * u1 - 1.0f;
    vndf_incidence w = vndf_incidence_of(view);
    vndf_azimuth_range range = vndf_azimuth_range_at(view->of.table.front, view->of.table.wedge, half);
    *trusted = vndf_trusts_wedge_mass(view->of.table.front, range.mass);
    if (!*trusted)
        return (vndf_drawn){0};
    return range.in_front ? draw_in_front(d, &w, &range, u2, trusted, weight)
                          : draw_in_wedge(d, &w, &range, u2, trusted, weight);
}

vndf_vec3 vndf_engine_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    lanes_m trusted;
    if (!view->trusted)
        return vndf_engine_sample_exactly(view, u1, u2, pdf);
    vndf_drawn n = draw(view, u1, u2, &trusted, NULL);
    if (!trusted)
        return vndf_engine_sample_exactly(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

vndf_vec3 vndf_engine_sample_telling(const vndf_view *view, float u1, float u2, float *pdf, int *fast)
{
    vndf_drawn n;
    *fast = view->trusted;
    if (*fast)
        n = draw(view, u1, u2, fast, NULL);
    if (!*fast)
        return vndf_engine_sample_exactly(view, u1, u2, NULL);
    *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

vndf_vec3 vndf_engine_sample_weight(const vndf_view *view, float u1, float u2, float *pdf, float *weight)
{
    vndf_drawn n;
    lanes_m trusted = view->trusted;
    *weight = 0.0f;
    if (trusted)
        n = draw(view, u1, u2, &trusted, weight);
    if (!trusted) {
        *weight = 0.0f;
        return vndf_engine_sample_exactly(view, u1, u2, pdf);
    }
    *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}
