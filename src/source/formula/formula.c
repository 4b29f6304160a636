/* Distributions given by formulas: P22(r) itself, or D in c = cos(theta), theta, t = tan(theta), for
 * which P22(r) = D c^4 at t = r. 1 + r^2 is never formed, so that r = 1e200 has its right cosine. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "source/formula/expression.h"
#include "source/source.h"
#include "source/words.h"

enum {
    OPERATIONS = 4,     /* the cost of an evaluation besides its instructions */
    CALL_OPERATIONS = 8 /* of a power or a function */
};

static const double TIGHT = 1e-9; /* bounds this close count as a value */

typedef struct formula_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_formula_of of;
    vndf_lobe lobe[VNDF_LOBES];
    size_t count;
} formula_source;

/* ---- values and bounds ---- */

static vndf_reach reach(const vndf_source *self, double low, double high)
{
    const formula_source *source = (const formula_source *)self;
    return vndf_lobes_reach(source->of, source->lobe, source->count, low, high);
}

/* The value at a slope where doubles overflow on the way, as in r^11 exp(-r^2) far out: the value that the bounds
 * leave, if they are close enough. At an infinite slope there is nothing. */
static double bounded_value(const formula_source *source, double r, double value)
{
    if (!(r > 0) || isinf(r))
        return r > 0 ? 0 : value;
    vndf_interval at = vndf_lobes_jet(source->of, source->lobe, source->count, vndf_jet_number(r)).at[0];
    double low = vndf_interval_low(at), high = vndf_interval_high(at), size = fmax(fabs(low), fabs(high));
    return isfinite(size) && high - low <= fmax(TIGHT * size, 8 * DBL_MIN) ? fmax(low, 0) : value;
}

static void p22(const vndf_source *self, const double *r, size_t count, double *values)
{
    const formula_source *source = (const formula_source *)self;
    for (size_t k = 0; k < source->count; k++) {
        const vndf_lobe *l = &source->lobe[k];
        int is_ndf = source->of == VNDF_FORMULA_OF_NDF;
        vndf_points variables[VNDF_VARIABLES], value;
        for (size_t i = 0; i < count; i++) {
            double unit = r[i] / l->scale;
            variables[0][i] = is_ndf ? 1 / hypot(1, unit) : unit;
            variables[1][i] = is_ndf ? atan(unit) : 0;
            variables[2][i] = unit;
        }
        vndf_expression_run(&l->formula, variables, count, value);
        for (size_t i = 0; i < count; i++) {
            double c2 = is_ndf ? variables[0][i] * variables[0][i] : 1;
            values[i] = (k ? values[i] : 0) + l->factor * (value[i] * c2 * c2);
        }
    }
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            values[i] = bounded_value(source, r[i], values[i]);
}

static void release(formula_source *source)
{
    for (size_t i = 0; i < source->count; i++)
        vndf_expression_free(&source->lobe[i].formula);
    free(source->base.description);
}

static void destroy(vndf_source *self)
{
    release((formula_source *)self);
    free(self);
}

/* ---- making ---- */

vndf_source *vndf_formula_source(vndf_formula_of of, const vndf_lobe *lobes, size_t count, char *description,
                                 vndf_error *error)
{
    formula_source made = {.of = of, .count = count};
    formula_source *source = malloc(sizeof *source);
    made.base = (vndf_source){
        .p22 = p22, .destroy = destroy, .description = description, .rebuildable = 1, .reach = reach};
    for (size_t i = 0; i < count; i++) {
        made.lobe[i] = lobes[i];
        made.base.operations += OPERATIONS;
        for (size_t k = 0; k < lobes[i].formula.count; k++) {
            char operation = lobes[i].formula.program[k].operation;
            made.base.operations += operation == VNDF_CALL || operation == '^' ? CALL_OPERATIONS : 1;
        }
    }
    if (source && description) {
        *source = made;
        return &source->base;
    }
    release(&made);
    free(source);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
    return NULL;
}

/* Its description is "--slope 'exp(-a*r)' --set a=0.3". */
static vndf_source *read_formula(vndf_formula_of of, const char *text, const vndf_parameter *parameters,
                                 size_t count, vndf_error *error)
{
    static const char *const names_of_p22[] = {"r"}, *const names_of_ndf[VNDF_VARIABLES] = {"c", "theta", "t"};
    int is_ndf = of == VNDF_FORMULA_OF_NDF;
    vndf_names names = {is_ndf ? names_of_ndf : names_of_p22, is_ndf ? VNDF_VARIABLES : 1, parameters, count};
    vndf_writer words = {NULL, 0, 0, 0};
    vndf_lobe lobe = {{NULL, 0}, 1, 1};
    if (vndf_expression_parse(text, &names, &lobe.formula, error) != VNDF_OK)
        return NULL;
    vndf_text_add_word(&words, is_ndf ? "--ndf" : "--slope");
    vndf_text_add_word(&words, text);
    for (size_t i = 0; i < count; i++) {
        vndf_text_add_word(&words, "--set");
        vndf_text_add_word(&words, parameters[i].name);
        vndf_text_add(&words, "=");
        vndf_text_add_number(&words, parameters[i].value);
    }
    return vndf_formula_source(of, &lobe, 1, vndf_text_finish(&words, error), error);
}

vndf_source *vndf_source_ndf_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                        vndf_error *error)
{
    return read_formula(VNDF_FORMULA_OF_NDF, text, parameters, count, error);
}

vndf_source *vndf_source_slope_expression(const char *text, const vndf_parameter *parameters, size_t count,
                                          vndf_error *error)
{
    return read_formula(VNDF_FORMULA_OF_P22, text, parameters, count, error);
}
