/* Builds a table of albedos: quadrature in the nodes of the grid, splines through them, averages of the splines,
 * and the errors between the nodes. */
#include <stdlib.h>
#include <string.h>

#include "bsdf/albedo/file.h"
#include "bsdf/albedo/quadrature.h"
#include "bsdf/albedo/spline.h"
#include "core/error.h"

typedef struct builder {
    vndf_albedo *albedo;
    vndf_albedo_options is; /* without zeros */
    vndf_quadrature usual, finer;
    double *node;       /* layers x rows x columns: the quadrature there */
    double *row;        /* room for coefficients: (columns + 2) x rows */
    double least_slope; /* that stands for 0 */
    int calls;          /* of `progress` so far, and */
    int all;            /* in the end */
} builder;

/* ---- the grid ------------------------------------------------------------------------------------ */

static uint32_t sides_of(const builder *b)
{
    return b->albedo->layers > 1 ? 2 : 1;
}

/* The inverse of vndf_albedo_y, as a roughness. */
static double alpha_at(const builder *b, double y)
{
    double scale = (double)b->albedo->is.scale, most = (double)VNDF_ALBEDO_ALPHA_MAX * scale, part = y * y * most;
    return part / (1.0 + (double)vndf_albedo_bend * (most - part)) / scale;
}

/* t^(1/4) for the x of a node: halved until no double lies between. */
static double root_at(const builder *b, double x)
{
    double least = (double)vndf_albedo_from(b->albedo), twice = 2.0 * (least + x * (1.0 - least)), low = 0.0,
           high = 1.0;
    if (!(twice > 0.0 && twice < 2.0))
        return twice > 0.0 ? 1.0 : 0.0;
    for (;;) {
        double middle = 0.5 * (low + high), square = middle * middle;
        if (!(middle > low && middle < high))
            return middle;
        if (square * square + middle < twice)
            low = middle;
        else
            high = middle;
    }
}

/* The inverse of vndf_albedo_x. */
static double cosine_at(const builder *b, uint32_t layer, double x, double alpha)
{
    double knee = (double)vndf_albedo_knee * (double)b->albedo->is.scale * alpha, root = root_at(b, x);
    double t = (root * root) * (root * root), cosine = layer % 2 == 1 ? t : t * knee / (knee + (1.0 - t));
    return cosine < 1.0 ? cosine : 1.0;
}

/* The roughness that stands for 0. */
static double least_alpha(const builder *b)
{
    return b->least_slope / (double)b->albedo->is.scale;
}

static double eta_from(const builder *b, uint32_t side)
{
    return side ? 1.0 / (double)b->is.eta : (double)b->is.eta;
}

/* A direction for a place in the grid of a layer. */
typedef struct spot {
    double cosine, alpha;
} spot;

static spot spot_at(const builder *b, uint32_t layer, double x, double y)
{
    double alpha = alpha_at(b, y), least = least_alpha(b);
    alpha = alpha > least ? alpha : least;
    return (spot){cosine_at(b, layer, x, alpha), alpha};
}

/* 0 if the build is to stop. */
static int goes_on(builder *b, const char *what)
{
    double done = (double)b->calls++ / b->all;
    return !b->is.progress || b->is.progress(done < 1.0 ? done : 1.0, what, b->is.progress_user) == 0;
}

static double *node_at(const builder *b, uint32_t layer, int row, int column)
{
    return b->node + ((size_t)layer * (size_t)b->is.rows + (size_t)row) * (size_t)b->is.columns + column;
}

/* The quadrature in a node of a layer. */
static double integrate_node(const builder *b, uint32_t layer, int row, int column)
{
    spot at = spot_at(b, layer, column / (b->is.columns - 1.0), row / (b->is.rows - 1.0));
    double eta = eta_from(b, layer / 2);
    if (layer % 2 == 1)
        return vndf_quadrature_reflected(&b->usual, at.cosine, at.alpha, eta);
    vndf_parts p = vndf_quadrature_albedo(&b->usual, at.cosine, at.alpha, eta);
    return p.reflected + p.transmitted;
}

static int fill_nodes(builder *b)
{
    for (int i = 0; i < b->is.rows; i++)
        for (uint32_t layer = 0; layer < b->albedo->layers; layer++) {
            if (!goes_on(b, "quadrature"))
                return 0;
            for (int j = 0; j < b->is.columns; j++)
                *node_at(b, layer, i, j) = integrate_node(b, layer, i, j);
        }
    return 1;
}

/* ---- splines ------------------------------------------------------------------------------------- */

static int fit_grid(const builder *b)
{
    uint32_t columns = (uint32_t)b->is.columns, rows = (uint32_t)b->is.rows, pitch = columns + 2;
    vndf_spline across = {0}, along = {0};
    double *column = malloc((rows + 2) * sizeof *column);
    int good = column && vndf_spline_of(&across, columns) && vndf_spline_of(&along, rows);
    for (uint32_t layer = 0; good && layer < b->albedo->layers; layer++) {
        float *to = b->albedo->value + (size_t)layer * (rows + 2) * pitch;
        for (uint32_t i = 0; i < rows; i++)
            vndf_spline_fit(&across, node_at(b, layer, (int)i, 0), 1, b->row + i * pitch, 1);
        for (uint32_t j = 0; j < pitch; j++) {
            vndf_spline_fit(&along, b->row + j, pitch, column, 1);
            for (uint32_t i = 0; i < rows + 2; i++)
                to[i * pitch + j] = (float)column[i];
        }
    }
    vndf_spline_free(&across);
    vndf_spline_free(&along);
    free(column);
    return good;
}

/* Adds 2 integral E mu dmu of one layer as it is looked up, from a cosine to another, in panels of an octave: E
 * changes with the cosine over alpha. */
static double integrate_cell(const builder *b, const vndf_gauss_rule *rule, uint32_t layer,
                             const vndf_albedo_place *y, float slope, double from, double to)
{
    double sum = 0.0, end;
    for (; from < to; from = end) {
        end = 2.0 * from < to ? 2.0 * from : to;
        for (int i = 0; i < rule->count; i++) {
            double cosine = from + (end - from) * rule->node[i];
            vndf_albedo_place x = vndf_albedo_place_of(vndf_albedo_x(b->albedo, layer, (float)cosine, slope),
                                                       (uint32_t)b->is.columns);
            sum += (end - from) * rule->weight[i] * cosine * (double)vndf_albedo_value(b->albedo, layer, &x, y);
        }
    }
    return 2.0 * sum;
}

/* Below the second node from a thousandth of it on: what is left is below 1e-9. */
static double integral_of(const builder *b, const vndf_gauss_rule *rule, uint32_t layer, double alpha)
{
    int cells = b->is.columns - 1;
    double bent = alpha > least_alpha(b) ? alpha : least_alpha(b), sum = 0.0, from = 0.0;
    float slope = vndf_albedo_slope(b->albedo, (float)bent);
    vndf_albedo_place y = vndf_albedo_place_of(vndf_albedo_y(b->albedo, slope), (uint32_t)b->is.rows);
    for (int j = 1; j <= cells; j++) {
        double to = cosine_at(b, layer, (double)j / cells, bent);
        sum += integrate_cell(b, rule, layer, &y, slope, j == 1 ? 1e-3 * to : from, to);
        from = to;
    }
    return sum;
}

/* The side from which reflection may become total. */
static uint32_t inner_side(const builder *b)
{
    return b->is.eta > 1.0f ? 1 : 0;
}

/* The average of a layer. Of what the inner side reflects look-ups are too rough an idea, as F has a step there.
 * But what passes a surface one way passes it the other way too, by reciprocity: as a part of the light eta^2 times
 * that. */
static double average_of(const builder *b, const vndf_gauss_rule *rule, uint32_t layer, double alpha)
{
    uint32_t inner = 2 * inner_side(b), outer = 2 - inner;
    double eta = (double)b->is.eta, square = eta > 1.0 ? 1.0 / (eta * eta) : eta * eta;
    if (b->albedo->layers == 1 || layer != inner + 1)
        return integral_of(b, rule, layer, alpha);
    double passes = integral_of(b, rule, outer, alpha) - integral_of(b, rule, outer + 1, alpha);
    return integral_of(b, rule, inner, alpha) - square * passes;
}

static double average_error(const builder *b, const vndf_gauss_rule *rule, uint32_t layer)
{
    double worst = 0.0;
    for (uint32_t i = 0; i + 1 < b->albedo->averages; i++) {
        double y = (i + 0.5) / (b->albedo->averages - 1);
        vndf_albedo_place place = vndf_albedo_place_of((float)y, b->albedo->averages);
        double off = fabs((double)vndf_albedo_average_value(b->albedo, layer, &place) -
                          average_of(b, rule, layer, alpha_at(b, y)));
        worst = off > worst ? off : worst;
    }
    return worst;
}

static void fit_average(const builder *b, const vndf_gauss_rule *rule, const vndf_spline *spline, uint32_t layer,
                        double *value)
{
    uint32_t count = spline->nodes;
    double *fitted = value + count;
    for (uint32_t i = 0; i < count; i++)
        value[i] = average_of(b, rule, layer, alpha_at(b, i / (count - 1.0)));
    vndf_spline_fit(spline, value, 1, fitted, 1);
    for (uint32_t i = 0; i < count + 2; i++)
        b->albedo->average[layer * (count + 2) + i] = (float)fitted[i];
}

static int fit_averages(const builder *b)
{
    double *value = malloc((2 * (size_t)b->albedo->averages + 2) * sizeof *value), worst = 0.0;
    vndf_spline spline = {0};
    vndf_gauss_rule rule;
    int good = value && vndf_spline_of(&spline, b->albedo->averages);
    vndf_gauss_rule_of(&rule, 8);
    for (uint32_t layer = 0; good && layer < b->albedo->layers; layer++) {
        fit_average(b, &rule, &spline, layer, value);
        double error = layer % 2 == 0 ? average_error(b, &rule, layer) : 0.0;
        worst = error > worst ? error : worst;
    }
    b->albedo->is.average_error = (float)worst;
    vndf_spline_free(&spline);
    free(value);
    return good;
}

/* ---- errors -------------------------------------------------------------------------------------- */

/* Raises *worst, and *usual where alpha is usual. */
static void note_error(float *worst, float *usual, double off, float alpha)
{
    if (off > (double)*worst)
        *worst = (float)off;
    if (off > (double)*usual && alpha >= 0.05f && alpha <= 1.0f)
        *usual = (float)off;
}

/* Compares a look-up with the quadrature of the very same numbers. */
static void measure_at(const builder *b, uint32_t side, double x, double y)
{
    vndf_albedo_properties *is = &b->albedo->is;
    spot at = spot_at(b, 2 * side, x, y);
    float alpha = (float)at.alpha, cosine = (float)at.cosine, from = side ? -cosine : cosine;
    vndf_parts p = vndf_quadrature_albedo(&b->usual, (double)cosine, (double)alpha, eta_from(b, side));
    vndf_albedo_parts got = vndf_albedo_split(b->albedo, from, alpha);
    double off = fabs((double)vndf_albedo_directional(b->albedo, from, alpha) - p.reflected - p.transmitted);
    if (off > (double)is->error) {
        is->error_cosine = from;
        is->error_alpha = alpha;
    }
    note_error(&is->error, &is->error_usual, off, alpha);
    note_error(&is->split_error, &is->split_usual, fabs((double)got.reflected - p.reflected), alpha);
    note_error(&is->split_error, &is->split_usual, fabs((double)got.transmitted - p.transmitted), alpha);
}

/* The same of what is reflected, in the grid of its own. */
static void measure_reflected(const builder *b, uint32_t side, double x, double y)
{
    vndf_albedo_properties *is = &b->albedo->is;
    spot at = spot_at(b, 2 * side + 1, x, y);
    float alpha = (float)at.alpha, cosine = (float)at.cosine;
    double reflected = vndf_quadrature_reflected(&b->usual, (double)cosine, (double)alpha, eta_from(b, side));
    vndf_albedo_parts got = vndf_albedo_split(b->albedo, side ? -cosine : cosine, alpha);
    note_error(&is->split_error, &is->split_usual, fabs((double)got.reflected - reflected), alpha);
}

/* In the middle of a cell and of an edge; in the first and last cells of a row at 15 places, the ends among them. */
static void measure_cell(const builder *b, uint32_t side, int row, int column)
{
    int columns = b->is.columns - 1;
    double dx = 1.0 / columns, dy = 1.0 / (b->is.rows - 1), x = column * dx, y = row * dy;
    measure_at(b, side, x + 0.5 * dx, y);
    measure_at(b, side, x + 0.5 * dx, y + 0.5 * dy);
    if (b->albedo->layers > 1)
        measure_reflected(b, side, x + 0.5 * dx, y + 0.5 * dy);
    for (int i = 0; i < 15 && (column == 0 || column == columns - 1); i++)
        measure_at(b, side, x + 0.25 * (i % 5) * dx, y + (0.25 + 0.25 * (i / 5)) * dy);
}

static int measure_errors(builder *b)
{
    for (int i = 0; i + 1 < b->is.rows; i++)
        for (uint32_t side = 0; side < sides_of(b); side++) {
            for (int j = 0; j + 1 < b->is.columns; j++) {
                if (j % 8 == 0 && !goes_on(b, "measuring"))
                    return 0;
                measure_cell(b, side, i, j);
            }
        }
    return 1;
}

/* At 8 x 12 places, most of them off the grid. */
static int measure_quadrature(builder *b)
{
    double worst = 0.0;
    for (uint32_t side = 0; side < sides_of(b); side++)
        for (int i = 0; i <= 7; i++) {
            if (!goes_on(b, "measuring"))
                return 0;
            for (int j = 0; j <= 11; j++) {
                spot at = spot_at(b, 2 * side, j / 11.0, i / 7.0);
                vndf_parts p = vndf_quadrature_albedo(&b->usual, at.cosine, at.alpha, eta_from(b, side));
                vndf_parts q = vndf_quadrature_albedo(&b->finer, at.cosine, at.alpha, eta_from(b, side));
                double r = fabs(p.reflected - q.reflected), t = fabs(p.transmitted - q.transmitted);
                worst = r > worst ? r : worst;
                worst = t > worst ? t : worst;
            }
        }
    b->albedo->is.quadrature_error = (float)worst;
    return 1;
}

/* ---- the whole ----------------------------------------------------------------------------------- */

static vndf_status check_size(const char *what, int given, vndf_error *error)
{
    if (given == 0 || (given >= VNDF_ALBEDO_GRID_MIN && given <= VNDF_ALBEDO_GRID_MAX))
        return VNDF_OK;
    return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%d %s; from %d to %d are possible", given, what,
                     VNDF_ALBEDO_GRID_MIN, VNDF_ALBEDO_GRID_MAX);
}

static vndf_status resolve(vndf_albedo_options *is, vndf_error *error)
{
    double eta = (double)is->eta;
    if (!vndf_albedo_eta_valid(is->eta))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "eta %g; 0 is a mirror, else it is from 0.01 to 100 and farther than 0.001 from 1", eta);
    vndf_status status = check_size("columns", is->columns, error);
    if (status == VNDF_OK)
        status = check_size("rows", is->rows, error);
    is->columns = is->columns ? is->columns : eta > 0.0 ? 48 : 24;
    is->rows = is->rows ? is->rows : eta > 0.0 ? 24 : 20;
    return status;
}

/* A copy to be freed; NULL if there is no memory. */
static char *copy_of(const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

static int begin(builder *b, const vndf_distribution *d)
{
    vndf_info info = vndf_distribution_info(d);
    size_t nodes = (size_t)b->is.columns * (size_t)b->is.rows;
    vndf_albedo *a = vndf_albedo_allocate((uint32_t)b->is.columns, (uint32_t)b->is.rows,
                                          b->is.eta > 0.0f ? VNDF_ALBEDO_LAYERS : 1);
    b->albedo = a;
    if (!a)
        return 0;
    a->is.eta = b->is.eta;
    a->is.scale = (float)info.scale;
    a->is.source = a->source = copy_of(info.source);
    a->is.tool = a->tool = copy_of(info.tool);
    b->node = malloc(a->layers * nodes * sizeof *b->node);
    b->row = malloc((nodes + 2 * (size_t)b->is.rows) * sizeof *b->row);
    double most = (double)VNDF_ALBEDO_ALPHA_MAX * info.scale;
    b->least_slope = 1e-6 * most / (1.0 + most);
    b->all = (int)b->albedo->layers * b->is.rows +
             (int)sides_of(b) * ((b->is.rows - 1) * ((b->is.columns + 6) / 8) + 8);
    return a->source && a->tool && b->node && b->row && vndf_quadrature_of(&b->usual, d, 1) &&
           vndf_quadrature_of(&b->finer, d, 2);
}

static vndf_status build(builder *b, const vndf_distribution *d, vndf_error *error)
{
    if (!begin(b, d))
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of albedos");
    int whole = fill_nodes(b);
    if (whole && !(fit_grid(b) && fit_averages(b)))
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of albedos");
    if (!whole || !measure_quadrature(b) || !measure_errors(b))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "interrupted");
    b->albedo->is.bytes = vndf_albedo_encode(b->albedo, NULL, 0);
    return VNDF_OK;
}

vndf_albedo *vndf_albedo_build(const vndf_distribution *distribution, const vndf_albedo_options *options,
                               vndf_error *error)
{
    builder b = {0};
    if (options)
        b.is = *options;
    if (!distribution) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "no distribution: NULL was given");
        return NULL;
    }
    if (resolve(&b.is, error) != VNDF_OK)
        return NULL;
    double scale = vndf_distribution_info(distribution).scale;
    if (!vndf_albedo_scale_valid((float)scale)) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the median slope is %g; from 1e-6 to 1e6 are possible", scale);
        return NULL;
    }
    vndf_status status = build(&b, distribution, error);
    vndf_quadrature_free(&b.usual);
    vndf_quadrature_free(&b.finer);
    free(b.node);
    free(b.row);
    if (status == VNDF_OK)
        return b.albedo;
    vndf_albedo_free(b.albedo);
    return NULL;
}
