/* What is no source is refused, in words that name the column of a formula or a family, and what would be right. */
#include "source/sources.h"

/* Words of `vndf build`, and a part of the message. */
static const char *const syntax[][2] = {
    /* formulas */
    {"--slope exp(-2*foo)+a*r --set a=1",
     "column 8: unknown name 'foo'; known are r, pi, a, and with parentheses exp log log1p "},
    {"--slope '1 + theta'", "column 5: unknown name 'theta'; --ndf has theta, which is atan(r) here; known are r"},
    {"--slope c^2", "column 1: unknown name 'c'; --ndf has c, which is 1/sqrt(1+r^2) here; known are r"},
    {"--ndf exp(-r)", "column 6: unknown name 'r'; --slope has r, which is t here; known are c, theta, t, pi"},
    {"--slope ln(r)", "unknown name 'ln'; did you mean 'log'?"},
    {"--slope e^(-r)", "unknown name 'e'; did you mean 'exp'?"},
    {"--slope exp(−r)", "column 5: unexpected '−'; did you mean '-'?"},
    {"--slope exp(-2·r)", "column 7: unexpected '·'; did you mean '*'?"},
    {"--slope exp(-r²)", "column 7: unexpected '²'; did you mean '^2'?"},
    {"--slope exp(-π*r)", "column 6: unexpected 'π'; did you mean 'pi'?"},
    {"--slope 'r<1'", "column 2: unexpected '<'; did you mean 'step'? step(1-r) is 1 where r <= 1, else 0"},
    {"--slope r+é", "column 3: unexpected 'é'; a number, a name"},
    {"--slope r+\xe2\x88", "column 3: unexpected '?'; a number, a name"},
    {"--slope exp(-r)*cso(r)", "column 9: unknown name 'cso'; did you mean 'cos'? known are"},
    {"--slope Exp(-r)", "column 1: unknown name 'Exp'; did you mean 'exp'?"},
    {"--slope\t\n\r''", "column 1: the expression ends here; a number, a name or '('"},
    {"--slope '(1+ * 2'", "column 5: unexpected '*'; a number, a name or '(' would be right"},
    {"--slope *r", "column 1: unexpected '*'; a number"},
    {"--slope {r}", "column 1: unexpected '{'; did you mean '('?"},
    {"--slope exp(-r**2)", "column 8: unexpected '*'; a power is written with ^, as in r^2"},
    {"--slope 'r 2'",
     "column 3: unexpected '2'; an operator (+ - * / ^) or the end would be right; a product is "},
    {"--slope exp(-3r)",
     "column 7: unexpected 'r'; an operator, or ')' for the '(' of column 4, would be right; a "},
    {"--slope (r)(r)",
     "column 4: unexpected '('; an operator (+ - * / ^) or the end would be right; a product is "},
    {"--slope .", "column 1: unexpected '.'; a number has digits"},
    {"--slope 1e999", "column 1: the number 1e999 is too large"},
    {"--slope 2*(r+1", "column 7: the expression ends here; an operator, or ')' for the '(' of column 3"},
    {"--slope r)", "column 2: unexpected ')'"},
    {"--slope 'exp r'", "column 5: unexpected 'r'; the function before it needs"},
    {"--slope r(2)", "column 2: unexpected '('; the name before it is no function"},
    {"--slope min(1)", "column 6: unexpected ')'; min, max and pow take two arguments"},
    {"--slope exp(1,2)", "column 6: unexpected ','; this function takes one argument"},
    {"--slope r\\", "column 2: unexpected '\\'"},
    {"--slope 'r", "column 9: a quote"},
    /* families */
    {"--family ''",
     "column 1: unknown family ''; known are ggx, beckmann, student-t, gtr, epd, abc, sgd, hyper-cauchy, "},
    {"--family GGX", "column 1: unknown family 'GGX'; did you mean 'ggx'? known are ggx, "},
    {"--family ggx:1", "column 5: too many parameters; right would be ggx"},
    {"--family student-t", "column 10: GAMMA is missing; right would be student-t:GAMMA"},
    {"--family student-t:x", "column 11: 'x' is no number"},
    {"--family student-t:1e400", "column 11: the number 1e400 is too large for a double"},
    {"--family student-t:1.5", "GAMMA is 1.5; it must be above 1.5 and at most 1e+09: P22 falls as"},
    {"--family gtr:2,", "column 7: nothing follows the comma; right would be gtr:GAMMA[,ALPHA]"},
    {"--family abc:,2", "column 5: '' is no number"},
    {"--family gtr:2,1.1", "gtr: ALPHA is 1.1; it must be at least 1e-09 and at most 1"},
    {"--family epd:0.04", "epd: P is 0.04; it must be at least 0.05 and at most 1000"},
    {"--family abc:1", "column 6: C is missing; right would be abc:B,C or abc:MATERIAL"},
    {"--family sgd:alum-bronz/r", "unknown material 'sgd:alum-bronz/r'; the nearest is sgd:alum-bronze/r"},
    {"--family sgd:a\xf0\x9d\x9c\x8b\xff\xe2z\x7f\x01", "unknown material 'sgd:a\xf0\x9d\x9c\x8b?"},
    {"--family abc:gold", "unknown material 'abc:gold'; the nearest is "},
    {"--family mix", "column 4: unexpected ''; right would be mix:(W,S,FAMILY)+(W,S,FAMILY)"},
    {"--family mix:ggx", "column 5: unexpected 'ggx'"},
    {"--family mix:(1,1,ggx)", "column 14: unexpected ''"},
    {"--family mix:(1,1,ggx)(1,1,ggx)", "column 14: unexpected '(1,1,ggx)'"},
    {"--family mix:(1,1,ggx)+(1,1,ggx)+(1,1,ggx)", "column 24: unexpected '+(1,1,ggx)'"},
    {"--family mix:(1,1,ggx)+(1,1,ggx", "column 16: unexpected '1,1,ggx'"},
    {"--family mix:(x,1,ggx)+(1,1,ggx)", "column 6: 'x' is no number"},
    {"--family mix:(1,1,gggx)+(1,1,ggx)", "column 10: unknown family 'gggx'"},
    {"--family mix:(1,1,mix:(1,1,ggx)+(1,1,ggx))+(1,1,ggx)", "column 10: a mix is"},
    {"--family mix:(0,1,ggx)+(1,1,ggx)", "mix: the weight W is 0; it must be above 0 and at most 1e+12"},
    {"--family mix:(1,0,ggx)+(1,1,ggx)", "mix: the scale S is 0; it must be at least 1e-09 and at most 1e+09"},
};

static const char *const arguments[][2] = {
    {"", "the source was ''"},
    {"--slope", "the source was '--slope'"},
    {"--csv a.csv", "the source was '--csv a.csv', and a table keeps only its name"},
    {"--slope r --set", "--set NAME=NUMBER"},
    {"--slope r --set a", "NAME=NUMBER"},
    {"--slope r --set a=1x", "NAME=NUMBER"},
    {"--slope r --out x", "'--out'"},
    {"--family ggx --set a=1", "takes no --set"},
    {"--ndf c --set 1a=1", "'1a': a name is a letter"},
    {"--ndf c --set theta=1", "'theta': the name is taken"},
    {"--ndf c*a --set a=1 --set a=1", "'a': the name is taken"},
    {"--ndf c --set a=1e999", "a finite number is needed"},
    {"--ndf c --set k=1 --set j=1", "parameter 'k': the formula 'c' has no 'k'"},
};

static void refuse(const char *const cases[][2], size_t count, vndf_status status)
{
    for (size_t i = 0; i < count; i++) {
        vndf_error error = {VNDF_OK, ""};
        refused(vndf_source_from_description(cases[i][0], &error), &error, status, cases[i][1]);
    }
}

static void test_calls(void)
{
    vndf_error error = {VNDF_OK, ""};
    const vndf_parameter nameless = {NULL, 1};
    refused(vndf_source_slope_expression(NULL, NULL, 0, &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
    refused(vndf_source_slope_expression("a", NULL, 1, &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
    refused(vndf_source_slope_expression("a", &nameless, 1, &error), &error, VNDF_ERROR_ARGUMENT, "a letter");
    refused(vndf_source_of(NULL, &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
    refused(vndf_source_family(NULL, &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
    char many[1024] = "--slope r";
    for (int i = 0; i <= VNDF_LIMIT_PARAMETERS; i++)
        strcat(many, " --set a=1");
    refused(vndf_source_from_description(many, &error), &error, VNDF_ERROR_ARGUMENT, "more than 64 parameters");
    refused(vndf_source_ndf_callback(NULL, NULL, "x", &error), &error, VNDF_ERROR_ARGUMENT, "NULL");
}

int main(void)
{
    refuse(syntax, sizeof syntax / sizeof *syntax, VNDF_ERROR_SYNTAX);
    refuse(arguments, sizeof arguments / sizeof *arguments, VNDF_ERROR_ARGUMENT);
    test_calls();
    return test_done();
}
