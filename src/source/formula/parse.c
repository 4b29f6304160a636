/* The parser of formulas: one function for each rule of the grammar in expression.h, each emitting its
 * operands and then its operation. A rule returns 0 once an error has been reported; all callers pass it on. */
#include "source/formula/expression.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "core/nearest.h"
#include "source/words.h"

typedef struct parser {
    const char *text;
    size_t length, at; /* at: the first character that has not been read */
    size_t depth;      /* rules that are open around this one */
    const vndf_names *names;
    unsigned char used[VNDF_LIMIT_PARAMETERS];
    vndf_expression *expression;
    vndf_error *error;
} parser;

static int sum(parser *p);
static int sign(parser *p);

/* ---- text ------------------------------------------------------------------------------------- */

static char peek(parser *p)
{
    while (p->at < p->length && strchr(" \t\r\n", p->text[p->at]))
        p->at++;
    return p->at < p->length ? p->text[p->at] : '\0';
}

static int is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static size_t name_length(const char *text, size_t size)
{
    size_t count = 0;
    while (count < size && (is_letter(text[count]) || (count > 0 && is_digit(text[count]))))
        count++;
    return count;
}

/* What is often written in the place of something else, between blanks, and what to say then. */
static const char *const slips[][2] = {
    {" − – — ", "did you mean '-'?"},
    {" · ⋅ × ", "did you mean '*'?"},
    {" ² ", "did you mean '^2'?"},
    {" π ", "did you mean 'pi'?"},
    {" θ ", "did you mean 'theta'?"},
    {" [ { ", "did you mean '('?"},
    {" < > = ", "did you mean 'step'? step(1-r) is 1 where r <= 1, else 0"},
    {" ln ", "did you mean 'log'?"},
    {" e ", "did you mean 'exp'?"},
    {" theta ", "--ndf has theta, which is atan(r) here;"},
    {" t ", "--ndf has t, which is r here;"},
    {" c ", "--ndf has c, which is 1/sqrt(1+r^2) here;"},
    {" r ", "--slope has r, which is t here;"},
};

/* NULL: none of these. */
static const char *slip_of(const char *text, size_t size)
{
    char word[16];
    snprintf(word, sizeof word, " %.*s ", (int)size, text);
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++)
        if (strstr(slips[i][0], word))
            return slips[i][1];
    return NULL;
}

/* "column 7: unexpected 'x'; ..." or "column 7: the expression ends here; ...": what would be right. */
static int unexpected(parser *p, const char *wanted, const char *more)
{
    char excerpt[VNDF_EXCERPT], c = peek(p);
    const char *text = p->text + p->at, *slip = NULL;
    const size_t size = vndf_character(text, p->length - p->at);
    if (!is_letter(c) && (slip = slip_of(text, size)) != NULL)
        wanted = slip, more = "";
    if (c == '\0')
        vndf_fail(p->error, VNDF_ERROR_SYNTAX, "column %zu: the expression ends here; %s%s", p->at + 1, wanted,
                  more);
    else
        vndf_fail(p->error, VNDF_ERROR_SYNTAX, "column %zu: unexpected '%s'; %s%s", p->at + 1,
                  vndf_excerpt(excerpt, text, size), wanted, more);
    return 0;
}

/* The same where an operand may be side by side with another. */
static int unexpected_operand(parser *p, const char *wanted)
{
    char c = peek(p);
    int is_operand = is_letter(c) || is_digit(c) || c == '(';
    return unexpected(p, wanted, is_operand ? "; a product is written with *, as in 3*r" : "");
}

/* ---- output ----------------------------------------------------------------------------------- */

/* Every instruction comes from a character of its own, so the program cannot outgrow the text. */
static int emit(parser *p, vndf_instruction instruction, int change)
{
    instruction.change = change;
    p->expression->program[p->expression->count++] = instruction;
    return 1;
}

static int emit_number(parser *p, double value)
{
    return emit(p, (vndf_instruction){.operation = VNDF_PUSH_NUMBER, .number = value}, 1);
}

static int enter(parser *p)
{
    if (++p->depth <= VNDF_LIMIT_EXPRESSION_DEPTH)
        return 1;
    return vndf_fail(p->error, VNDF_ERROR_SYNTAX,
                     "column %zu: nested deeper than %d levels (parentheses, calls, signs, powers)", p->at + 1,
                     VNDF_LIMIT_EXPRESSION_DEPTH),
           0;
}

/* ---- the grammar ------------------------------------------------------------------------------ */

static int number(parser *p)
{
    double value;
    char excerpt[VNDF_EXCERPT];
    size_t size = vndf_number_read(p->text + p->at, p->length - p->at, &value);
    if (size == 0)
        return unexpected(p, "a number has digits, like 0.5 or 1e-3", "");
    if (isinf(value))
        return vndf_fail(p->error, VNDF_ERROR_SYNTAX, "column %zu: the number %s is too large for a double",
                         p->at + 1, vndf_excerpt(excerpt, p->text + p->at, size)),
               0;
    p->at += size;
    return emit_number(p, value);
}

/* The known name of this index: variables, pi, parameters, functions; NULL past the last. */
static const char *known_name(const vndf_names *n, size_t i)
{
    size_t behind_pi = i - n->variable_count - 1;
    if (i <= n->variable_count)
        return i < n->variable_count ? n->variables[i] : "pi";
    if (behind_pi < n->parameter_count)
        return n->parameters[behind_pi].name;
    size_t function = behind_pi - n->parameter_count;
    return function < VNDF_FUNCTIONS ? vndf_functions[function].name : NULL;
}

static int unknown_name(parser *p, size_t size)
{
    char excerpt[VNDF_EXCERPT], known[320] = "", functions[160] = "", hint[VNDF_LIMIT_PARAMETER_NAME + 32] = "";
    size_t least = vndf_word_slip(size), first_function = p->names->variable_count + p->names->parameter_count + 1;
    const char *name, *text = p->text + p->at, *slip = slip_of(text, size);
    for (size_t i = 0; (name = known_name(p->names, i)) != NULL; i++) {
        char *list = i < first_function ? known : functions, *end = list + strlen(list);
        size_t room = i < first_function ? sizeof known : sizeof functions;
        if (vndf_word_is_nearer(text, size, name, &least))
            snprintf(hint, sizeof hint, "did you mean '%s'? ", name);
        snprintf(end, room - strlen(list), "%s%s", end == list ? "" : i < first_function ? ", " : " ", name);
    }
    if (slip)
        snprintf(hint, sizeof hint, "%s ", slip);
    vndf_fail(p->error, VNDF_ERROR_SYNTAX,
              "column %zu: unknown name '%s'; %sknown are %s, and with parentheses %s", p->at + 1,
              vndf_excerpt(excerpt, text, size), hint, known, functions);
    return 0;
}

/* A name of this length that is no function. */
static int name(parser *p, size_t size)
{
    const char *known, *text = p->text + p->at;
    const vndf_names *n = p->names;
    size_t i = 0;
    while ((known = known_name(n, i)) != NULL && !vndf_is_word(text, size, known))
        i++;
    if (!known)
        return unknown_name(p, size);
    p->at += size;
    if (i < n->variable_count)
        return emit(p, (vndf_instruction){.operation = VNDF_PUSH_VARIABLE, .variable = i}, 1);
    if (i == n->variable_count)
        return emit_number(p, 3.14159265358979323846);
    i -= n->variable_count + 1;
    if (i >= n->parameter_count)
        return unexpected(p, "the function before it needs its argument in parentheses", "");
    p->used[i] = 1;
    return emit_number(p, n->parameters[i].value);
}

static int close_parenthesis(parser *p, size_t opened)
{
    char wanted[80];
    snprintf(wanted, sizeof wanted, "an operator, or ')' for the '(' of column %zu, would be right", opened + 1);
    if (peek(p) != ')')
        return unexpected_operand(p, wanted);
    p->at++;
    p->depth--;
    return 1;
}

static int name_or_call(parser *p)
{
    size_t start = p->at, size = name_length(p->text + start, p->length - start);
    int function = 0;
    while (function < VNDF_FUNCTIONS && !vndf_is_word(p->text + start, size, vndf_functions[function].name))
        function++;
    p->at += size;
    int is_call = peek(p) == '(';
    size_t open = p->at;
    if (!is_call || function == VNDF_FUNCTIONS) {
        p->at = start;
        return name(p, size) &&
               (!is_call || unexpected(p, "the name before it is no function; a product is written with *", ""));
    }
    p->at++;
    if (!enter(p) || !sum(p))
        return 0;
    int takes_two = vndf_functions[function].two != NULL;
    if (!takes_two && peek(p) == ',')
        return unexpected(p, "this function takes one argument", "");
    if (takes_two) {
        if (peek(p) != ',')
            return unexpected(p, "min, max and pow take two arguments, separated by a comma", "");
        p->at++;
        if (!sum(p))
            return 0;
    }
    return close_parenthesis(p, open) &&
           emit(p, (vndf_instruction){.operation = VNDF_CALL, .function = function}, takes_two ? -1 : 0);
}

static int primary(parser *p)
{
    char c = peek(p);
    size_t opened = p->at;
    if (is_digit(c) || c == '.')
        return number(p);
    if (is_letter(c))
        return name_or_call(p);
    if (c == '*' && p->at > 0 && p->text[p->at - 1] == '*')
        return unexpected(p, "a power is written with ^, as in r^2", "");
    if (c != '(')
        return unexpected(p, "a number, a name or '(' would be right", "");
    p->at++;
    return enter(p) && sum(p) && close_parenthesis(p, opened);
}

/* Behind a sign or ^. */
static int inner_sign(parser *p)
{
    p->at++;
    if (!enter(p) || !sign(p))
        return 0;
    p->depth--;
    return 1;
}

static int power(parser *p)
{
    if (!primary(p))
        return 0;
    if (peek(p) != '^')
        return 1;
    return inner_sign(p) && emit(p, (vndf_instruction){.operation = '^'}, -1);
}

static int sign(parser *p)
{
    char c = peek(p);
    if (c != '-' && c != '+')
        return power(p);
    return inner_sign(p) && (c == '+' || emit(p, (vndf_instruction){.operation = VNDF_NEGATE}, 0));
}

/* Operands between which one of these signs stands. */
static int chain(parser *p, int (*operand)(parser *), const char *signs)
{
    if (!operand(p))
        return 0;
    for (char c; (c = peek(p)) != '\0' && strchr(signs, c);) {
        p->at++;
        if (!operand(p) || !emit(p, (vndf_instruction){.operation = c}, -1))
            return 0;
    }
    return 1;
}

static int product(parser *p)
{
    return chain(p, sign, "*/");
}

static int sum(parser *p)
{
    return chain(p, product, "+-");
}

/* ---- the whole -------------------------------------------------------------------------------- */

static vndf_status check_parameters(const vndf_names *names, vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    if (names->parameter_count > VNDF_LIMIT_PARAMETERS)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%zu parameters; at most %d are possible",
                         names->parameter_count, VNDF_LIMIT_PARAMETERS);
    if (names->parameter_count > 0 && !names->parameters)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "parameters is NULL but their count is not 0");
    for (size_t i = 0; i < names->parameter_count; i++) {
        const char *text = names->parameters[i].name ? names->parameters[i].name : "";
        size_t size = strlen(text);
        vndf_excerpt(excerpt, text, size);
        if (size == 0 || size > VNDF_LIMIT_PARAMETER_NAME || name_length(text, size) != size)
            return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                             "parameter '%s': a name is a letter or _, then letters, digits or _; at most %d",
                             excerpt, VNDF_LIMIT_PARAMETER_NAME);
        for (size_t j = 0; j <= names->variable_count + i; j++)
            if (strcmp(text, known_name(names, j)) == 0)
                return vndf_fail(error, VNDF_ERROR_ARGUMENT, "parameter '%s': the name is taken; choose another",
                                 excerpt);
        if (!isfinite(names->parameters[i].value))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "parameter '%s' is %g; a finite number is needed",
                             excerpt, names->parameters[i].value);
    }
    return VNDF_OK;
}

vndf_status vndf_expression_parse(const char *text, const vndf_names *names, vndf_expression *expression,
                                  vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    parser p = {text, text ? strlen(text) : 0, 0, 0, names, {0}, expression, error};
    *expression = (vndf_expression){NULL, 0};
    if (!text)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the expression is NULL");
    if (p.length > VNDF_LIMIT_EXPRESSION_LENGTH)
        return vndf_fail(error, VNDF_ERROR_SYNTAX, "the expression has %zu characters; at most %d are possible",
                         p.length, VNDF_LIMIT_EXPRESSION_LENGTH);
    vndf_status status = check_parameters(names, error);
    if (status != VNDF_OK)
        return status;
    expression->program = malloc((p.length + 1) * sizeof *expression->program);
    if (!expression->program)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for an expression of %zu characters", p.length);
    if (sum(&p) &&
        (peek(&p) == '\0' || unexpected_operand(&p, "an operator (+ - * / ^) or the end would be right")))
        for (size_t i = 0; i < names->parameter_count && status == VNDF_OK; i++)
            status = p.used[i]
                         ? VNDF_OK
                         : vndf_fail(error, VNDF_ERROR_ARGUMENT, "parameter '%s': the formula '%s' has no '%s'",
                                     names->parameters[i].name, vndf_excerpt(excerpt, text, p.length),
                                     names->parameters[i].name);
    else
        status = VNDF_ERROR_SYNTAX;
    if (status != VNDF_OK)
        vndf_expression_free(expression);
    return status;
}
