/* Formulas: text -> a postfix program -> a double, or bounds.
 *
 *     sum     = product { (+ | -) product }
 *     product = sign { (* | /) sign }
 *     sign    = (- | +) sign | power
 *     power   = primary [ ^ sign ]          so -r^2 = -(r^2), 2^3^2 = 2^(3^2), and 2^-3 is legal
 *     primary = number | name | function ( sum [, sum] ) | ( sum )
 *
 * A name stands for a variable of the formula, for pi or for a parameter of the caller. A parenthesis behind a
 * name makes it a function, so a parameter may be called gamma. Blanks separate. parse.c reads, expression.c runs the
 * program over numbers, bounds.c over bounds, and formula.c makes a distribution of it. */
#ifndef VNDF_SOURCE_FORMULA_EXPRESSION_H
#define VNDF_SOURCE_FORMULA_EXPRESSION_H

#include "source/interval/interval.h"
#include "source/source.h"
#include "vndf_build.h"

enum {
    VNDF_VARIABLES = 3,
    VNDF_EXPRESSION_STACK = 320 /* operands: a level of depth leaves at most 4 of them waiting, see the grammar */
};

/* clang-format off */
enum {
    VNDF_EXP, VNDF_LOG, VNDF_LOG1P, VNDF_SQRT, VNDF_SIN, VNDF_COS, VNDF_TAN, VNDF_ASIN, VNDF_ACOS, VNDF_ATAN,
    VNDF_SINH, VNDF_COSH, VNDF_TANH, VNDF_ERF, VNDF_ERFC, VNDF_LGAMMA, VNDF_GAMMA, VNDF_ABS, VNDF_MIN, VNDF_MAX,
    VNDF_POW, VNDF_STEP, VNDF_FUNCTIONS
};
/* clang-format on */

/* A function of one argument or of two; the other pointer is NULL. */
typedef struct vndf_function {
    const char *name;
    double (*one)(double);
    double (*two)(double, double);
} vndf_function;

extern const vndf_function vndf_functions[VNDF_FUNCTIONS];

/* Operations beside + - * / ^, which are named as they are written. */
enum { VNDF_PUSH_NUMBER = '#', VNDF_PUSH_VARIABLE = '$', VNDF_NEGATE = '~', VNDF_CALL = '(' };

typedef struct vndf_instruction {
    char operation;
    int change;   /* of the number of operands: 1, or 0 with one argument, or -1 with two */
    int function; /* of CALL */
    size_t variable;
    double number;
} vndf_instruction;

/* A program whose stack ends with one value. */
typedef struct vndf_expression {
    vndf_instruction *program; /* owned */
    size_t count;
} vndf_expression;

/* The names that a formula may use. */
typedef struct vndf_names {
    const char *const *variables;
    size_t variable_count;
    const vndf_parameter *parameters;
    size_t parameter_count;
} vndf_names;

/* Compiles text; parameters become constants. VNDF_ERROR_SYNTAX with the column (from 1) and what would
 * be right; VNDF_ERROR_ARGUMENT for a parameter that is bad or not used. On failure *expression needs no freeing. */
vndf_status vndf_expression_parse(const char *text, const vndf_names *names, vndf_expression *expression,
                                  vndf_error *error);
void vndf_expression_free(vndf_expression *expression);

/* The values of variable i at up to VNDF_SOURCE_MANY points: variables[i]. */
typedef double vndf_points[VNDF_SOURCE_MANY];

/* The values of the formula at `count` points. An instruction is looked at once for all points; a point alone gets the
 * same bits. */
void vndf_expression_run(const vndf_expression *expression, vndf_points *variables, size_t count, double *values);

/* ---- distributions ---- */

/* One lobe of P22: factor F(r/scale), F by a formula in r, or by one of D in c, theta, t. */
typedef struct vndf_lobe {
    vndf_expression formula; /* owned */
    double factor, scale;
} vndf_lobe;

enum { VNDF_LOBES = 2 };
typedef enum vndf_formula_of { VNDF_FORMULA_OF_P22, VNDF_FORMULA_OF_NDF } vndf_formula_of;

/* The source that is the sum of `count` lobes. It takes the formulas and the description, also where it fails. */
vndf_source *vndf_formula_source(vndf_formula_of of, const vndf_lobe *lobes, size_t count, char *description,
                                 vndf_error *error);

/* ---- bounds ---- */

/* Bounds of a function on an interval of u: enclosures of its values and of its Taylor coefficients, f^(k)(u)/k!,
 * at all points of the interval. Where f is not smooth the coefficients are the whole line; at a kink the first
 * coefficient stays bounded. */
enum { VNDF_JET = 3 }; /* the last coefficient */

typedef struct vndf_jet {
    int constant; /* coefficients beyond the value are 0 */
    vndf_interval at[VNDF_JET + 1];
} vndf_jet;

vndf_jet vndf_jet_number(double x);

/* Bounds over u = log r on all slopes between two: of r itself, and of formulas and P22 of it. */
vndf_jet vndf_jet_of_slope(double low, double high);
vndf_jet vndf_expression_jet(const vndf_expression *expression, const vndf_jet *variables);
vndf_jet vndf_lobes_jet(vndf_formula_of of, const vndf_lobe *lobes, size_t count, vndf_jet r);
vndf_reach vndf_lobes_reach(vndf_formula_of of, const vndf_lobe *lobes, size_t count, double low, double high);

#endif
