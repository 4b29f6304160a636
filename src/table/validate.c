#include "table/validate.h"

#include <math.h>

#include "table/layout.h"

/* Whether value is in [least, most]; 0 for NaN. */
static int in_range(float value, float least, float most)
{
    return value >= least && value <= most;
}

/* Whether values ascend from 0 to 1 by steps whose inverse is a float, with room for products. The builder's steps are
 * above 1e-10. */
static int ascending(const float *values, uint32_t count)
{
    for (uint32_t i = 0; i + 1 < count; i++)
        if (!(values[i + 1] - values[i] > 1e-12f))
            return 0;
    return values[0] == 0.0f && values[count - 1] == 1.0f;
}

static const char *radial_invalid(const vndf_distribution *table)
{
    uint32_t n = table->radial_count;
    const vndf_knot *k = table->knots.at;
    for (uint32_t j = 0; j <= n; j++)
        if (!in_range(k[j].x, 0.0f, 1.0f) || !in_range(k[j].z, 0.0f, 1.0f) ||
            fabsf(k[j].x + k[j].z - 1.0f) > 1e-6f)
            return "a radial knot lies off the line x + z = 1";
    for (uint32_t j = 0; j < n; j++) {
        vndf_radial_cell c = table->cells[j];
        if (k[j + 1].x < k[j].x || k[j + 1].z > k[j].z)
            return "the radial knots do not ascend";
        if (!in_range(c.f0, 0.0f, 1e18f) || !in_range(c.f1, 0.0f, 1e18f) || !in_range(c.mu0, 1e-37f, 1e6f) ||
            !in_range(c.mu1, 1e-37f, 1e6f))
            return "a radial cell has a density or moment out of range";
    }
    if (k[0].x != 0.0f || k[0].z != 1.0f || k[n].x != 1.0f || k[n].z != 0.0f || table->cells[0].f0 != 0.0f)
        return "the radial knots do not run from the pole to the horizon";
    return NULL;
}

static const char *rows_invalid(const vndf_wedge *wedge)
{
    uint32_t cells = wedge->cell_count;
    if (!ascending(wedge->q, cells + 1))
        return "the azimuth cells do not ascend from 0 to 1";
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        const vndf_row_cell *cell = vndf_row_cells(wedge, i);
        double total = 0.0;
        for (uint32_t j = 0; j <= cells; j++) {
            if (!in_range(cell[j].density, 0.0f, 1e6f) || (j < cells && !in_range(cell[j].mass, 1e-12f, 1.0f)))
                return "an azimuth row has a mass or density out of range";
            total += j < cells ? cell[j].mass : 0.0f;
        }
        if (!(fabs(total - 1.0) < 1e-4))
            return "the masses of an azimuth row do not add up to 1";
        if (!in_range(*vndf_aspect_p(wedge, i), i ? 1e-12f : 0.0f, 2.0f) ||
            !in_range(*vndf_aspect_r(wedge, i), 1e-12f, 2.0f))
            return "the aspect of an azimuth row is out of range";
    }
    if (!ascending(wedge->row_y, vndf_row_knots(wedge->row_count)))
        return "the azimuth rows do not ascend from 0 to 1";
    return NULL;
}

/* Checks that knots ascend from 0 to 1 and masses ascend. */
static const char *area_invalid(const vndf_wedge *wedge)
{
    const float *m = wedge->mass;
    if (!ascending(wedge->knot_y, wedge->knot_count))
        return "the area knots do not ascend from 0 to 1";
    for (uint32_t i = 0; i < wedge->knot_count; i++)
        if (!in_range(m[i], 0.0f, 1e6f) || !in_range(wedge->slope[i], 0.0f, 1e6f) ||
            !in_range(wedge->curve[i], 0.0f, 1e12f) || (m[i] > 0.0f) != (i > 0))
            return "a wedge mass is out of range";
    for (uint32_t i = 0; i + 1 < wedge->knot_count; i++)
        if (m[i + 1] < m[i])
            return "the wedge masses do not ascend";
    return NULL;
}

const char *vndf_table_invalid(const vndf_distribution *table)
{
    const char *why = radial_invalid(table);
    const vndf_certificate *c = &table->certificate;
    const float claims[] = {c->tv,         c->tv_theta,       c->tv_above,   c->tv_above_theta,
                            c->max_weight, c->weight_bounded, c->area_error, c->consistency,
                            c->ndf_error,  c->hidden,         c->finest,     -c->horizon_power};
    for (unsigned i = 0; i < sizeof claims / sizeof *claims; i++)
        if (!in_range(claims[i], 0.0f, HUGE_VALF))
            return "the certificate holds what is no measurement";
    if (!(table->scale > 1e-18 && table->scale < 1e18) || !(table->normalization > 0.0) ||
        !isfinite(table->normalization))
        return "the scale or normalization is out of range";
    if (!why)
        why = rows_invalid(&table->above);
    if (!why)
        why = rows_invalid(&table->below);
    if (!why)
        why = area_invalid(&table->above);
    return why ? why : area_invalid(&table->below);
}

/* If all Bernstein coefficients of the cubic are >= 0, the density is >= 0 in the whole cell. Rounding a moment moves a
 * coefficient by some 1e-5 of the larger end; this check forgives that much, and the sampler cuts it off. */
static int cubic_positive(const vndf_radial_cell *c, const vndf_radial_bend *bend)
{
    float least = -1e-4f * (c->f0 + c->f1 + c->mu0 + c->mu1);
    float first = c->f0 + (c->f1 - c->f0 + bend->a) / 3.0f;
    float second = c->f1 + (c->f0 - c->f1 + bend->a + bend->b) / 3.0f;
    return first >= least && second >= least;
}

const char *vndf_table_invalid_derived(const vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        if (!(table->cells[j].width > 0.0f) || !(vndf_knot_slope(table, j) < vndf_knot_slope(table, j + 1)))
            return "two radial knots coincide";
        if (!cubic_positive(&table->cells[j], &table->bends[j]))
            return "the density of a radial cell falls below zero";
    }
    if (!isfinite(table->f0_total) || !isfinite(table->f1_total))
        return "the moments of the table are not finite";
    return NULL;
}
