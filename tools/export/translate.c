#include "export/translate.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef struct writer {
    const translation *t;
    const language *to;
    FILE *file;
    kernel *kernel;
    const word *word; /* those of the kernel */
    const declaration *in;
    int depth; /* of indentation */
} writer;

/* ---- names --------------------------------------------------------------------------------------- */

int translation_prefix(translation *t, const char *name)
{
    size_t n = strlen(name);
    if (n == 0 || n > PREFIX_MAX || name[0] < 'a' || name[0] > 'z' || name[n - 1] == '_' || strstr(name, "__") ||
        strcmp(name, "gl") == 0 || strncmp(name, "gl_", 3) == 0)
        return 0;
    for (size_t i = 0; i < n; i++) {
        int letter = name[i] >= 'a' && name[i] <= 'z', digit = name[i] >= '0' && name[i] <= '9';
        if (!letter && !digit && name[i] != '_')
            return 0;
        t->lower[i] = name[i];
        t->upper[i] = letter ? (char)(name[i] - 'a' + 'A') : name[i];
    }
    t->lower[n] = t->upper[n] = '_';
    t->lower[n + 1] = t->upper[n + 1] = '\0';
    return 1;
}

void put_prefixed(const translation *t, FILE *to, const char *from, size_t length)
{
    for (const char *at = from, *end = from + length; at < end;) {
        int in_word = at > from && (at[-1] == '_' || isalnum((unsigned char)at[-1]));
        int lower = !in_word && strncmp(at, "vndf_", 5) == 0, upper = !in_word && strncmp(at, "VNDF_", 5) == 0;
        if (lower || upper)
            fputs(lower ? t->lower : t->upper, to);
        else
            fputc(*at, to);
        at += lower || upper ? 5 : 1;
    }
}

/* A variable or a member. */
static void put_name(const writer *w, const word *name)
{
    fprintf(w->file, "%.*s%s", name->length, name->text, word_is_in(name, language_reserved) ? "_" : "");
}

/* Functions and structs begin with the prefix, constants with it in capitals; those of the kernel that a public one
 * has are told apart. */
static void put_declared(const writer *w, const declaration *d)
{
    const word *name = &w->word[d->name];
    int capital = d->kind == CONSTANT || d->kind == ARRAY, public = word_is_public(name);
    fputs(capital ? w->t->upper : w->t->lower, w->file);
    for (int i = 0; i < w->kernel->count && !public; i++) {
        const word *other = &w->word[w->kernel->at[i].name];
        if (word_is_public(other) && other->length == name->length + 5 &&
            memcmp(other->text + 5, name->text, (size_t)name->length) == 0)
            fputs("kernel_", w->file);
    }
    for (int i = public ? 5 : 0; i < name->length; i++) {
        char c = name->text[i];
        fputc(capital && c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c, w->file);
    }
}

static declaration *declared(const writer *w, const word *name, declaration_kind kind)
{
    declaration *d = name->kind == WORD_NAME ? kernel_named(w->kernel, name) : NULL;
    return d && d->kind == kind ? d : NULL;
}

static void put_type(const writer *w, const word *type)
{
    int length;
    const char *own = language_type(w->to, type->text, type->length, &length);
    const declaration *d = declared(w, type, STRUCT);
    if (own)
        put_prefixed(w->t, w->file, own, (size_t)length);
    else if (d)
        put_declared(w, d);
    else
        fprintf(w->file, "%.*s", type->length, type->text);
}

static void put_parameters(writer *w, const declaration *d);

/* A pattern of the language for a type, a variable, a declaration and a number. */
static void put_form(writer *w, const char *pattern, const word *type, const word *name, const declaration *d,
                     long n)
{
    for (size_t plain; *pattern; pattern++) {
        plain = strcspn(pattern, "$");
        put_prefixed(w->t, w->file, pattern, plain);
        if (!*(pattern += plain))
            break;
        switch (*++pattern) {
        case 'T': put_type(w, type); break;
        case 'V': put_name(w, name); break;
        case 'D': put_declared(w, d); break;
        case 'P': put_parameters(w, d); break;
        default: fprintf(w->file, "%ld", n);
        }
    }
}

/* ---- expressions --------------------------------------------------------------------------------- */

static void put_words(writer *w, int at, int end, int in_condition);

void put_float(const translation *t, FILE *to, double x)
{
    char number[40];
    snprintf(number, sizeof number, "%.9g", x);
    fprintf(to, "%s%s%s", number, strpbrk(number, ".en") ? "" : ".0", t->to->indents ? "" : "f");
}

static void put_number(const writer *w, const word *number)
{
    int hex = number->length > 1 && number->text[1] == 'x', last = number->text[number->length - 1];
    int real = hex ? memchr(number->text, 'p', (size_t)number->length) != NULL
                   : last != 'f' && memchr(number->text, '.', (size_t)number->length);
    if (real) /* of doubles too: all is float */
        put_float(w->t, w->file, strtod(number->text, NULL));
    else
        fprintf(w->file, "%.*s", number->length - (w->to->indents && !hex && last == 'f'), number->text);
}

/* Whether one of the signs stands outside of brackets. */
static int has_sign(const writer *w, int at, int end, const char *signs)
{
    for (; at<end; at = w->word[at].other> at ? w->word[at].other + 1 : at + 1)
        if (w->word[at].kind == WORD_SIGN && strchr(signs, *w->word[at].text))
            return 1;
    return 0;
}

/* A call from its bracket on that the language has in a form of its own; `bare`: without the brackets around all. */
static void put_call_of(writer *w, const char *pattern, int length, int open, int bare)
{
    bare = bare && *pattern == '(';
    const char *weak = length == 2 && !bare ? "+-*/&|<>" : "&|<>";
    for (int i = bare; i < length - bare; i++) {
        int at = open + 1, end = w->word[open].other;
        if (pattern[i] != '$') {
            int n = (int)strcspn(pattern + i, "$");
            n = n < length - bare - i ? n : length - bare - i;
            put_prefixed(w->t, w->file, pattern + i, (size_t)n);
            i += n - 1;
            continue;
        }
        for (int skip = pattern[++i] - '1'; skip > 0; skip--)
            at = kernel_find(w->kernel, at, end, ",") + 1;
        end = kernel_find(w->kernel, at, end, ",");
        int closed = has_sign(w, at, end, weak);
        fputs(closed ? "(" : "", w->file);
        put_words(w, at, end, 0);
        fputs(closed ? ")" : "", w->file);
    }
}

/* A pattern of *length characters for a call, or NULL. */
static const char *pattern_of(const writer *w, const word *name, int *length)
{
    if (!word_is(name, "fetch"))
        return language_call(w->to, name->text, name->length, length);
    *length = (int)strlen(w->t->fetched);
    return w->t->fetched;
}

/* A name before its brackets; returns what follows them. */
static int put_call(writer *w, int at, int bare)
{
    int length, close = w->word[at + 1].other;
    const char *pattern = pattern_of(w, &w->word[at], &length);
    const declaration *d = declared(w, &w->word[at], FUNCTION);
    if (pattern) {
        put_call_of(w, pattern, length, at + 1, bare);
        return close + 1;
    }
    if (d)
        put_declared(w, d);
    else
        put_name(w, &w->word[at]);
    fputs(!d || !d->fetches || !w->t->by_pointer ? "(" : close == at + 2 ? "(numbers" : "(numbers, ", w->file);
    put_words(w, at + 2, close, 0);
    fputs(")", w->file);
    return close + 1;
}

/* The space or line break that stands before a word; a comment in an expression is left out. */
static void put_space(const writer *w, const word *at)
{
    int broken = memchr(at->text - at->gap, '\n', (size_t)at->gap) != NULL;
    if (broken && !w->to->indents)
        fprintf(w->file, "\n%*s", 4 * w->depth + 4, "");
    else if (at->gap)
        fputc(' ', w->file);
}

static void put_sign(const writer *w, const word *sign, const word *next)
{
    if (w->to->indents && word_is(sign, "/") && next->kind == WORD_NUMBER &&
        !memchr(next->text, '.', (size_t)next->length))
        fputs("//", w->file); /* of whole numbers */
    else if (w->to->indents && word_is_in(sign, " && || ! "))
        fputs(*sign->text == '!' ? "not " : *sign->text == '&' ? "and" : "or", w->file);
    else
        fprintf(w->file, "%.*s", sign->length, sign->text);
}

/* The end of a name with its members that is an operand of && or || by itself, so a whole number; or 0. */
static int whole_operand(const writer *w, int at, int from, int end)
{
    int stop = at + 1;
    while (stop < end && word_is(&w->word[stop], "."))
        stop += 2;
    int begins = at == from || word_is_in(&w->word[at - 1], " ( ! && || ");
    return w->word[at].kind == WORD_NAME && begins && (stop >= end || word_is_in(&w->word[stop], " ) && || "))
               ? stop
               : 0;
}

static int put_word(writer *w, int at, int end)
{
    const word *next = &w->word[at];
    const declaration *d = next->kind == WORD_NAME ? kernel_named(w->kernel, next) : NULL;
    int member = word_is(next - 1, ".");
    if (next->kind == WORD_NUMBER)
        put_number(w, next);
    else if (next->kind == WORD_SIGN)
        put_sign(w, next, next + 1);
    else if (!member && at + 1 < end && word_is(next + 1, "("))
        return put_call(w, at, 0);
    else if (at + 1 < end && next[1].kind == WORD_NAME && !word_is(next, "return"))
        put_type(w, next);
    else if (!member && d && (d->kind == CONSTANT || d->kind == ARRAY))
        put_declared(w, d);
    else
        put_name(w, next);
    kernel_expect(!word_is(next, "?"), next, "pick or if, not ?:,");
    return at + 1;
}

static void put_words(writer *w, int at, int end, int in_condition)
{
    for (int from = at, stop; at < end;) {
        if (at > from)
            put_space(w, &w->word[at]);
        int no = in_condition && word_is(&w->word[at], "!") && whole_operand(w, at + 1, from, end);
        if (in_condition && (stop = whole_operand(w, at + no, from, end)) != 0) {
            put_words(w, at + no, stop, 0);
            fputs(no ? " == 0" : " != 0", w->file);
            at = stop;
        } else {
            at = put_word(w, at, end);
        }
    }
}

/* What stands between the brackets of an if. */
static void put_condition(writer *w, int at, int end)
{
    if (word_is(&w->word[at], "any") && !w->to->indents && word_is(&w->word[at + 3], "(") &&
        w->word[at + 3].other + 2 == end)
        put_call(w, at + 2, 1); /* any(less(a, b)) is a < b */
    else
        put_words(w, at, end, 1);
}

/* ---- statements ---------------------------------------------------------------------------------- */

static int put_statement(writer *w, int at);

static void put_indent(const writer *w)
{
    fprintf(w->file, "%*s", 4 * w->depth, "");
}

/* A comment that begins there; returns what follows. Python has a sign on each line of it. */
static const char *put_comment(const writer *w, const char *from)
{
    const char *end = strstr(from, "*/") + 2;
    if (!w->to->indents)
        put_prefixed(w->t, w->file, from, (size_t)(end - from));
    for (const char *at = from + 2; w->to->indents && at < end - 3;) {
        at += strspn(at, " *");
        size_t line = strcspn(at, "\n");
        line = at + line < end - 3 ? line : (size_t)(end - 3 - at);
        if (at > from + 3)
            fprintf(w->file, "\n%*s", 4 * w->depth, "");
        fputs("# ", w->file);
        put_prefixed(w->t, w->file, at, line);
        at += line + 1;
    }
    return end;
}

/* The end of a statement's line, before the word `at`, with the comment there. */
static void put_line_end(const writer *w, int at)
{
    const char *from = w->word[at].text - w->word[at].gap;
    from += strspn(from, " ");
    if (*from == '/' && w->word[at].gap > 0) {
        fputs(w->to->indents ? "  " : " ", w->file);
        put_comment(w, from);
    }
    fputs("\n", w->file);
}

/* Comments and blank lines from there on. */
static void put_between(const writer *w, int at)
{
    const char *from = w->word[at].text - w->word[at].gap, *end = w->word[at].text;
    from += strcspn(from, "\n");
    for (int lines = 0; from < end;) {
        if (*from == '/') {
            put_indent(w);
            from = put_comment(w, from);
            fputs("\n", w->file);
            lines = -1;
        } else {
            if (*from == '\n' && ++lines == 2)
                fputs("\n", w->file);
            from += *from == '#' ? strcspn(from, "\n") : 1;
        }
    }
}

/* Whether a word begins a statement that assigns to the name or to a part of it. */
static int assigns(const writer *w, int at, const word *name)
{
    int begins = word_is_in(&w->word[at - 1], " ; } ) else ") ||
                 (word_is(&w->word[at - 1], "{") && word_is_in(&w->word[at - 2], " ) else "));
    return begins && word_is_in(&w->word[at + 1], " = . [ ++ ") && word_equals(&w->word[at], name);
}

static int is_assigned(const writer *w, const declaration *d, const word *name)
{
    for (int at = w->word[d->inner].other + 2; at < d->end; at++)
        if (assigns(w, at, name))
            return 1;
    return 0;
}

/* Python binds names to one struct where C copies it. */
static void put_value(writer *w, const word *type, int at, int end)
{
    int made = word_is(&w->word[at], "{");
    int copied = w->to->indents && !made && declared(w, type, STRUCT) && !has_sign(w, at, end, "(");
    if (made && w->to->made_by_call)
        put_type(w, type);
    if (made)
        fputs(w->to->made_by_call ? "(" : "{", w->file);
    fputs(copied ? "_copy(" : "", w->file);
    put_words(w, at + made, end - made, 0);
    fputs(copied ? ")" : made ? (w->to->made_by_call ? ")" : "}") : "", w->file);
}

/* type a = x, b, c[N] to before `end`: variables, or members of a struct. */
static void put_variables(writer *w, int at, int end, int members)
{
    const language *to = w->to;
    const word *type = &w->word[at];
    for (int name = at + 1, stop; name < end; name = stop + 1) {
        stop = kernel_find(w->kernel, name, end, ",");
        if (name > at + 1) {
            fputs(!to->apart ? "," : to->indents ? "\n" : members ? ",\n" : ";\n", w->file);
            if (to->apart)
                put_indent(w);
            else
                put_space(w, &w->word[name]);
        }
        int has_count = word_is(&w->word[name + 1], "["), equals = word_is(&w->word[name + 1], "=");
        if (to->apart && has_count) { /* of WGSL */
            put_name(w, &w->word[name]);
            fputs(": array<", w->file);
            put_type(w, type);
            fputs(", ", w->file);
            put_words(w, name + 2, name + 3, 0);
            fputs(">", w->file);
            continue;
        }
        int fixed = equals && !declared(w, type, STRUCT) && !is_assigned(w, w->in, &w->word[name]);
        if (to->apart && !to->indents &&
            !members) /* structs are variables, since only those have elements at an index */
            fputs(fixed ? "let " : "var ", w->file);
        put_form(w, name == at + 1 || to->apart ? to->typed : "$V", type, &w->word[name], NULL, 0);
        if (has_count)
            put_words(w, name + 1, name + 4, 0);
        if (equals || (!members && (to->indents || (to->zero && declared(w, type, STRUCT)))))
            fputs(" = ", w->file);
        if (equals)
            put_value(w, type, name + 2, stop);
        else if (!members && to->zero && declared(w, type, STRUCT))
            put_form(w, to->zero, type, NULL, NULL, 0);
        else if (!members && to->indents)
            fputs("0", w->file);
    }
}

/* What an if or a for governs, in braces; returns what follows. */
static int put_governed(writer *w, int at)
{
    int block = word_is(&w->word[at], "{"), end = block ? w->word[at].other : 0;
    fputs(w->to->indents ? ":" : " {", w->file);
    put_line_end(w, at + block);
    w->depth++;
    if (block)
        for (at++; at < end;)
            at = put_statement(w, at);
    else
        at = put_statement(w, at);
    w->depth--;
    if (!w->to->indents) {
        put_indent(w);
        fputs("}", w->file);
    }
    return at + block;
}

static int put_if(writer *w, int at)
{
    int close = w->word[at + 1].other, indents = w->to->indents;
    fputs(indents ? "if " : "if (", w->file);
    put_condition(w, at + 2, close);
    fputs(indents ? "" : ")", w->file);
    at = put_governed(w, close + 1);
    if (!word_is(&w->word[at], "else"))
        return at;
    if (indents)
        put_indent(w);
    fputs(indents ? "" : " ", w->file);
    if (!word_is(&w->word[at + 1], "if")) {
        fputs("else", w->file);
        return put_governed(w, at + 1);
    }
    fputs(indents ? "el" : "else ", w->file);
    return put_if(w, at + 1);
}

/* for (int i = A; i < B; i++) */
static int put_for(writer *w, int at)
{
    int close = w->word[at + 1].other, first = kernel_find(w->kernel, at + 2, close, ";"),
        second = kernel_find(w->kernel, first + 1, close, ";");
    const declaration *end = declared(w, &w->word[first + 3], CONSTANT);
    if (end && w->to->unroll) {
        fprintf(w->file, "%s\n", w->to->unroll);
        put_indent(w);
    }
    if (w->to->indents) {
        fputs("for ", w->file);
        put_name(w, &w->word[at + 3]);
        fputs(" in range(", w->file);
        put_words(w, at + 5, first, 0);
        fputs(", ", w->file);
        put_words(w, first + 3, second, 0);
        fputs(")", w->file);
    } else {
        fputs("for (", w->file);
        put_variables(w, at + 2, first, 0);
        fputs("; ", w->file);
        put_words(w, first + 1, second, 0);
        fputs("; ", w->file);
        put_words(w, second + 1, close, 0);
        fputs(")", w->file);
    }
    return put_governed(w, close + 1);
}

/* Returns what follows. */
static int put_statement(writer *w, int at)
{
    put_between(w, at);
    put_indent(w);
    if (word_is(&w->word[at], "if") || word_is(&w->word[at], "for")) {
        at = word_is(&w->word[at], "if") ? put_if(w, at) : put_for(w, at);
        if (w->to->indents)
            return at;
    } else {
        int end = kernel_find(w->kernel, at, w->in->end, ";");
        at += word_is(&w->word[at], "const");
        if (w->word[at + 1].kind == WORD_NAME && !word_is(&w->word[at], "return"))
            put_variables(w, at, end, 0);
        else
            put_words(w, at, end, 0);
        fputs(w->to->indents ? "" : ";", w->file);
        at = end + 1;
    }
    put_line_end(w, at);
    return at;
}

/* ---- declarations -------------------------------------------------------------------------------- */

/* Python would change the caller's struct, and WGSL forbids to change a parameter. */
static int is_copied(const writer *w, const declaration *d, int name)
{
    return is_assigned(w, d, &w->word[name]) &&
           (w->to->indents ? declared(w, &w->word[name - 1], STRUCT) != NULL : w->to->apart);
}

static void put_parameters(writer *w, const declaration *d)
{
    int close = w->word[d->inner].other;
    if (d->fetches && w->t->by_pointer)
        fprintf(w->file, "%snumbers%s", w->to->pointer, close > d->inner + 2 ? ", " : "");
    for (int at = d->inner + 1; at + 1 < close; at++) {
        at += word_is(&w->word[at], "const");
        word name = w->word[at + 1];
        char copied[64];
        if (is_copied(w, d, at + 1) && !w->to->indents) {
            name.length = snprintf(copied, sizeof copied, "%.*s_in", name.length, name.text);
            name.text = copied;
        }
        put_form(w, w->to->typed, &w->word[at], &name, NULL, 0);
        at = kernel_find(w->kernel, at, close, ",");
        fputs(at < close ? ", " : "", w->file);
    }
}

static void put_function(writer *w, const declaration *d)
{
    int close = w->word[d->inner].other;
    put_form(w, w->to->function, &w->word[d->type], NULL, d, 0);
    fputs("\n", w->file);
    w->depth = 1;
    for (int at = d->inner + 1; at < close; at++)
        if (w->word[at].kind == WORD_NAME && !word_is(&w->word[at + 1], "(") &&
            w->word[at + 1].kind != WORD_NAME && is_copied(w, d, at)) {
            const word *name = &w->word[at];
            put_form(w, w->to->indents ? "    $V = _copy($V)\n" : "    var $V = ", NULL, name, NULL, 0);
            if (!w->to->indents)
                fprintf(w->file, "%.*s_in;\n", name->length, name->text);
        }
    for (int at = close + 2; at < d->end - 1;)
        at = put_statement(w, at);
    w->depth = 0;
    fputs(w->to->indents ? "" : "}\n", w->file);
}

static void put_struct(writer *w, const declaration *d)
{
    int close = w->word[d->inner].other;
    put_form(w, w->to->structs, NULL, NULL, d, 0);
    fputs(w->to->indents ? "\n    __slots__ = (" : "\n", w->file);
    for (int at = d->inner + 1, end; at < close; at = end + 1) {
        end = kernel_find(w->kernel, at, close, ";");
        for (int name = at + 1; name < end && w->to->indents; name = kernel_find(w->kernel, name, end, ",") + 1)
            put_form(w, "\"$V\", ", NULL, &w->word[name], NULL, 0);
        if (w->to->indents)
            continue;
        fputs("    ", w->file);
        w->depth = 1;
        put_variables(w, at, end, 1);
        w->depth = 0;
        fputs(w->to->apart ? "," : ";", w->file);
        put_line_end(w, end + 1);
    }
    if (w->to->indents)
        fputs(")", w->file);
    else
        put_form(w, w->to->structs_close, NULL, NULL, d, 0);
    fputs("\n", w->file);
}

static void put_array(writer *w, const declaration *d)
{
    int close = w->word[d->inner].other, count = 0;
    for (int at = d->inner + 1; at < close; at = kernel_find(w->kernel, at, close, ",") + 1)
        count++;
    put_form(w, w->to->array, NULL, NULL, d, count);
    for (int at = d->inner + 1, i = 0; at < close; at = kernel_find(w->kernel, at, close, ",") + 1, i++) {
        fputs(i % 8 ? ", " : i ? ",\n    " : "\n    ", w->file);
        put_words(w, at, kernel_find(w->kernel, at, close, ","), 0);
    }
    fprintf(w->file, "\n%s\n", w->to->array_close);
}

/* The comment that ends on the line before. */
static void put_comment_before(const writer *w, const declaration *d)
{
    const word *first = &w->word[d->begin];
    const char *comment = NULL;
    if (first->gap < 5 || strncmp(first->text - 4, " */\n", 4) != 0)
        return;
    for (const char *at = first->text - first->gap; at < first->text; at++)
        comment = strncmp(at, "/*", 2) == 0 ? at : comment;
    put_comment(w, comment);
    fputs("\n", w->file);
}

int translation_want(const translation *t, kernel *from, const word *name)
{
    declaration *d = kernel_named(from, name);
    if (!d || d->wanted)
        return d != NULL;
    d->wanted = 1;
    for (int i = d->kind == CONSTANT ? d->end : d->begin; i < d->end; i++) {
        const word *at = &from->word[i];
        int length;
        d->fetches |= word_is(at, "fetch");
        declaration *of = at->kind == WORD_NAME && !word_is(at - 1, ".") ? kernel_named(from, at) : NULL;
        if (!of || of == d || (of->kind == FUNCTION && !word_is(at + 1, "(")) ||
            language_call(t->to, at->text, at->length, &length))
            continue;
        translation_want(t, from, at);
        d->fetches |= of->fetches;
    }
    return 1;
}

void translate(const translation *t, FILE *to, kernel *from)
{
    writer w = {.t = t, .to = t->to, .file = to, .kernel = from, .word = from->word};
    for (int i = 0, in_constants = 0; i < from->count; i++) {
        const declaration *d = w.in = &from->at[i];
        if (!d->wanted)
            continue;
        fputs(in_constants && d->kind != CONSTANT ? "\n" : "", to);
        in_constants = d->kind == CONSTANT;
        if (!in_constants || d->name == d->begin + 2)
            put_comment_before(&w, d);
        if (d->kind == FUNCTION)
            put_function(&w, d);
        else if (d->kind == STRUCT)
            put_struct(&w, d);
        else if (d->kind == ARRAY)
            put_array(&w, d);
        else
            put_form(&w, t->to->constant, NULL, NULL, d, d->value);
        fputs(t->to->indents && !in_constants ? "\n\n" : "\n", to);
    }
}
