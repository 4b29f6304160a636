#include "table/validate.h"

#include <math.h>

#include "table/layout.h"

/* In [least, most]; false for NaN. */
static int in_range(float value, float least, float most)
{
    return value >= least && value <= most;
}

/* From 0 to 1, by steps whose inverse is a float, with room for products: the builder's are above 1e-10. */
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
    const float *x = table->knots.x, *z = table->knots.z;
    for (uint32_t j = 0; j <= n; j++)
        if (!in_range(x[j], 0.0f, 1.0f) || !in_range(z[j], 0.0f, 1.0f) || fabsf(x[j] + z[j] - 1.0f) > 1e-6f)
            return "a radial knot lies off the line x + z = 1";
    for (uint32_t j = 0; j < n; j++) {
        vndf_radial_cell c = table->cells[j];
        if (x[j + 1] < x[j] || z[j + 1] > z[j])
            return "the radial knots do not ascend";
        if (!in_range(c.f0, 0.0f, 1e18f) || !in_range(c.f1, 0.0f, 1e18f) || !in_range(c.mu0, 1e-37f, 1e6f) ||
            !in_range(c.mu1, 1e-37f, 1e6f))
            return "a radial cell has a density or moment out of range";
    }
    if (x[0] != 0.0f || z[0] != 1.0f || x[n] != 1.0f || z[n] != 0.0f || table->cells[0].f0 != 0.0f)
        return "the radial knots do not run from the pole to the horizon";
    return NULL;
}

static const char *rows_invalid(const vndf_wedge *wedge)
{
    uint32_t cells = wedge->cell_count;
    if (!ascending(wedge->q, cells + 1))
        return "the azimuth cells do not ascend from 0 to 1";
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        const float *mass = wedge->cell_mass + (size_t)i * wedge->stride;
        const float *density = wedge->density + (size_t)i * (cells + 1);
        double total = 0.0;
        for (uint32_t j = 0; j <= cells; j++) {
            if (!in_range(density[j], 0.0f, 1e6f) || (j < cells && !in_range(mass[j], 1e-12f, 1.0f)))
                return "an azimuth row has a mass or density out of range";
            total += j < cells ? mass[j] : 0.0f;
        }
        if (!(fabs(total - 1.0) < 1e-4))
            return "the masses of an azimuth row do not add up to 1";
        if (!in_range(wedge->aspect_p[i], i ? 1e-12f : 0.0f, 2.0f) || !in_range(wedge->aspect_r[i], 1e-12f, 2.0f))
            return "the aspect of an azimuth row is out of range";
    }
    if (!ascending(wedge->row_y, vndf_row_knots(wedge->row_count)))
        return "the azimuth rows do not ascend from 0 to 1";
    return NULL;
}

/* Knots from 0 to 1, and masses that grow. */
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

/* Bernstein coefficients of the cubic: all >= 0 keeps the density >= 0 in the whole cell. Rounding of a
 * moment moves a coefficient by some 1e-5 of the larger end; that much is forgiven here and cut in the sampler. */
static int cubic_positive(const vndf_radial_cell *c)
{
    float least = -1e-4f * (c->f0 + c->f1 + c->mu0 + c->mu1);
    float first = c->f0 + (c->f1 - c->f0 + c->a) / 3.0f;
    float second = c->f1 + (c->f0 - c->f1 + c->a + c->b) / 3.0f;
    return first >= least && second >= least;
}

const char *vndf_table_invalid_derived(const vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        if (!(table->cells[j].width > 0.0f) || !(table->slope[j] < table->slope[j + 1]))
            return "two radial knots coincide";
        if (!cubic_positive(&table->cells[j]))
            return "the density of a radial cell falls below zero";
    }
    if (!isfinite(table->f0_total) || !isfinite(table->f1_total))
        return "the moments of the table are not finite";
    return NULL;
}
