#include "fit/assemble.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/even.h"

/* In the first cell f begins at 0. Only this cell is drawn to first order, so it stays small. */
static const double POLE_CELL = 1.0 / 512;

/* ---- beginning ---- */

static int begin_radial(vndf_plan *plan, size_t limit)
{
    const vndf_radial_fit *fit = &plan->radial_fit;
    double *start = malloc((fit->jump_count + 5) * sizeof *start);
    size_t n = 0;
    if (!start)
        return 0;
    start[n++] = 0.0;
    if (fit->jump_count == 0 || fit->jump[0] > 2 * POLE_CELL)
        start[n++] = POLE_CELL;
    for (size_t i = 0; i < fit->jump_count; i++)
        start[n++] = fit->jump[i];
    start[n++] = HUGE_VAL;
    int good =
        vndf_refine_begin(&plan->radial, start, n, limit, vndf_fit_middle, vndf_fit_cell_error, &plan->radial_fit);
    free(start);
    return good;
}

/* If everything visible below the horizon lies beyond this y, rows begin at the edge of the visible part. */
static const double ROWS_END = 1.0 / 32;

static int begin_rows(vndf_refinement *rows, vndf_wedge_fit *fit, size_t limit)
{
    double least = fit->least;
    const double whole[] = {0.0, 0.5, 1.0}, seen[] = {0.0, least, (least + 1) / 2, 1.0};
    const double few[] = {0.0, 1.0}, few_seen[] = {0.0, least, 1.0};
    int ends = least > ROWS_END, all = fit->side.weight >= 1;
    const double *start = all ? (ends ? seen : whole) : ends ? few_seen : few;
    return vndf_refine_begin(rows, start, 2 + (size_t)ends + (size_t)all, limit, NULL, vndf_wedge_row_error, fit);
}

static int begin_area(vndf_refinement *area, vndf_side *side, size_t limit)
{
    static const double start[] = {0.0, 0.25, 0.5, 0.75, 1.0};
    return vndf_refine_begin(area, start, sizeof start / sizeof *start, limit, NULL, vndf_area_fit_error, side);
}

int vndf_plan_make(vndf_plan *plan, const vndf_profile *profile, size_t max_bytes, int sphere)
{
    size_t most_rows = max_bytes / 64, most_cells = max_bytes / 24, most_knots = max_bytes / 12;
    vndf_budget budget = vndf_budget_for(max_bytes, sphere);
    vndf_side above = {profile, 0, 1.0, 0.0, 1.0},
              below = {profile, 1, budget.below, budget.fade, budget.below_areas};
    memset(plan, 0, sizeof *plan);
    plan->profile = profile;
    plan->budget = budget;
    plan->radial_fit.below = budget.below;
    plan->radial_fit.fade = budget.fade;
    plan->finest = budget.finest;
    if (!vndf_radial_fit_from(&plan->radial_fit, profile) ||
        !vndf_wedge_fit_from(&plan->above_fit, above, budget.row_cells, 2 * plan->finest) ||
        !vndf_wedge_fit_from(&plan->below_fit, below, budget.row_cells, 2 * plan->finest))
        return 0;
    size_t cell_limit = most_cells < 4000 ? most_cells : 4000, row_limit = most_rows < 1000 ? most_rows : 1000;
    size_t knot_limit = most_knots < 1000 ? most_knots : 1000;
    vndf_guard_stage(profile->guard, 0.1, "radial cells");
    int good = begin_radial(plan, cell_limit);
    vndf_guard_stage(profile->guard, 0.2, "azimuth rows above the horizon");
    good = good && begin_rows(&plan->above_rows, &plan->above_fit, row_limit);
    vndf_guard_stage(profile->guard, 0.4, "azimuth rows below the horizon");
    good = good && begin_rows(&plan->below_rows, &plan->below_fit, row_limit);
    vndf_guard_stage(profile->guard, 0.6, "projected area");
    good = good && begin_area(&plan->above_area, &plan->above_fit.side, knot_limit) &&
           begin_area(&plan->below_area, &plan->below_fit.side, knot_limit);
    return good && !vndf_guard_stopped(profile->guard);
}

void vndf_plan_free(vndf_plan *plan)
{
    vndf_radial_fit_free(&plan->radial_fit);
    vndf_wedge_fit_free(&plan->above_fit);
    vndf_wedge_fit_free(&plan->below_fit);
    vndf_refinement_free(&plan->radial);
    vndf_refinement_free(&plan->above_rows);
    vndf_refinement_free(&plan->below_rows);
    vndf_refinement_free(&plan->above_area);
    vndf_refinement_free(&plan->below_area);
}

/* ---- cutting a table ---- */

/* With all cells that were placed, whatever a table took since. */
static void refine_rows_to(const vndf_plan *plan, vndf_refinement *rows, vndf_wedge_fit *fit, double error)
{
    if (vndf_refinement_reaches(rows, error))
        return;
    vndf_wedge_fit_use(fit, vndf_wedge_fit_cells(fit, 2 * plan->finest));
    vndf_refine_to(rows, error);
}

vndf_table_size vndf_plan_size(vndf_plan *plan, double error)
{
    double area = vndf_budget_areas(&plan->budget, error);
    vndf_table_size size;
    vndf_refine_to(&plan->radial, fmax(error / plan->budget.radial, plan->finest));
    refine_rows_to(plan, &plan->above_rows, &plan->above_fit, fmax(error / plan->budget.rows, plan->finest));
    refine_rows_to(plan, &plan->below_rows, &plan->below_fit, error);
    vndf_refine_to(&plan->above_area, area);
    vndf_refine_to(&plan->below_area, area);
    size.radial = vndf_refinement_needed(&plan->radial, error / plan->budget.radial) - 1;
    size.above_cells = vndf_wedge_fit_cells(&plan->above_fit, error);
    size.below_cells = vndf_wedge_fit_cells(&plan->below_fit, error);
    size.above_rows = vndf_row_count(vndf_refinement_needed(&plan->above_rows, error / plan->budget.rows));
    size.below_rows = vndf_row_count(vndf_refinement_needed(&plan->below_rows, error));
    size.above_knots = vndf_refinement_needed(&plan->above_area, area);
    size.below_knots = vndf_refinement_needed(&plan->below_area, area);
    return size;
}

/* A round takes a millisecond or two. */
enum { ROW_ROUNDS = 2 };

static void fill_radial(vndf_plan *plan, vndf_distribution *table, double *knots)
{
    uint32_t n = table->radial_count;
    vndf_refinement_knots(&plan->radial, n + 1, knots);
    vndf_fit_knot a = vndf_fit_knot_at(&plan->radial_fit, 0.0);
    for (uint32_t j = 0; j < n; j++) {
        vndf_fit_knot b = vndf_fit_knot_at(&plan->radial_fit, knots[j + 1]);
        table->knots.at[j] = (vndf_knot){a.x, a.z};
        table->cells[j] = vndf_fit_cell(&plan->radial_fit, a, b);
        a = b;
    }
    table->knots.at[n] = (vndf_knot){a.x, a.z};
}

static void put_row(vndf_wedge *wedge, uint32_t i, const vndf_row *row, uint32_t cells)
{
    vndf_row_cell *cell = vndf_row_cells(wedge, i);
    *vndf_aspect_p(wedge, i) = (float)row->p;
    *vndf_aspect_r(wedge, i) = (float)row->r;
    for (uint32_t j = 0; j <= cells; j++) {
        cell[j].mass = j < cells ? row->mass[j] : 0.0f;
        cell[j].density = row->density[j];
    }
}

/* Where rows stand; the edge of the visible part stays where it is. 0 if there is no memory. */
static int row_knots(const vndf_plan *plan, const vndf_refinement *rows, vndf_wedge_fit *fit, uint32_t count,
                     double *knots)
{
    const vndf_even even = {&fit->least, 1, ROW_ROUNDS, vndf_wedge_row_error, fit};
    vndf_refinement_knots(rows, count, knots);
    return !plan->budget.even_rows || vndf_even_knots(knots, count, &even);
}

static int fill_rows(const vndf_plan *plan, vndf_wedge *wedge, const vndf_refinement *rows, vndf_wedge_fit *fit,
                     double *knots)
{
    uint32_t count = vndf_row_knots(wedge->row_count);
    vndf_wedge_fit_use(fit, wedge->cell_count);
    if (!row_knots(plan, rows, fit, count, knots))
        return 0;
    memcpy(wedge->q, fit->node, (fit->cells + 1) * sizeof *wedge->q);
    for (uint32_t i = 0; i < count; i++) {
        const vndf_row *row = vndf_wedge_fit_row(fit, knots[i]);
        const vndf_row *next = i + 1 < count ? vndf_wedge_fit_row(fit, knots[i + 1]) : row;
        vndf_row middle;
        if (!row || !next)
            return 0;
        wedge->row_y[i] = (float)row->y;
        put_row(wedge, 2 * i, row, fit->cells);
        if (i + 1 < count) {
            vndf_wedge_fit_middle(fit, row, next, &middle);
            put_row(wedge, 2 * i + 1, &middle, fit->cells);
        }
    }
    if (!fit->side.below) /* at the horizon the wedge has no width */
        *vndf_aspect_p(wedge, 0) = 0.0f;
    return 1;
}

/* Leaves out knots whose mass is not a normal float, except the first. */
static uint32_t keep_normal(const vndf_side *side, double *knots, uint32_t count)
{
    uint32_t n = 1;
    for (uint32_t i = 1; i < count; i++)
        if (vndf_side_mass(side, knots[i]) >= 1e-36 && (float)knots[i] > (float)knots[n - 1])
            knots[n++] = knots[i];
    return n;
}

static void put_knot(vndf_wedge *wedge, uint32_t i, double y, vndf_area_knot knot)
{
    wedge->knot_y[i] = (float)y;
    wedge->mass[i] = (float)knot.mass;
    wedge->slope[i] = (float)knot.slope;
    wedge->curve[i] = (float)knot.curve;
}

static void fill_area(vndf_wedge *wedge, const vndf_refinement *area, const vndf_side *side, double *knots)
{
    vndf_area_knot from, to;
    vndf_refinement_knots(area, wedge->knot_count, knots);
    wedge->knot_count = keep_normal(side, knots, wedge->knot_count);
    for (uint32_t i = 0; i + 1 < wedge->knot_count; i++) {
        vndf_area_fit_piece(side, knots[i], knots[i + 1], &from, &to);
        if (i == 0)
            put_knot(wedge, 0, knots[0], from);
        put_knot(wedge, i + 1, knots[i + 1], to);
    }
}

vndf_distribution *vndf_plan_assemble(vndf_plan *plan, vndf_table_size size)
{
    vndf_distribution *table = vndf_table_allocate(size);
    size_t most = size.radial + size.above_rows + size.below_rows + size.above_knots + size.below_knots + 8;
    double *knots = malloc(most * sizeof *knots);
    int good = table && knots && fill_rows(plan, &table->above, &plan->above_rows, &plan->above_fit, knots) &&
               fill_rows(plan, &table->below, &plan->below_rows, &plan->below_fit, knots);
    if (good) {
        fill_radial(plan, table, knots);
        fill_area(&table->above, &plan->above_area, &plan->above_fit.side, knots);
        fill_area(&table->below, &plan->below_area, &plan->below_fit.side, knots);
        table->normalization = plan->profile->normalization;
        table->scale = plan->profile->scale;
    }
    free(knots);
    if (good)
        return table;
    vndf_free(table);
    return NULL;
}
