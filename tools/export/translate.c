#include "export/translate.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

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

void put_prefixed(const translation *t, const char *from, size_t length)
{
    for (const char *at = from, *end = from + length; at < end;) {
        int in_word = at > from && (at[-1] == '_' || isalnum((unsigned char)at[-1]));
        int lower = !in_word && strncmp(at, "vndf_", 5) == 0, upper = !in_word && strncmp(at, "VNDF_", 5) == 0;
        if (lower || upper)
            fputs(lower ? t->lower : t->upper, t->file);
        else
            fputc(*at, t->file);
        at += lower || upper ? 5 : 1;
    }
}

/* A variable or a member. */
static void put_name(const translation *t, const word *name)
{
    char spaced[80];
    snprintf(spaced, sizeof spaced, " %.*s ", name->length, name->text);
    put_prefixed(t, name->text, (size_t)name->length);
    fputs(strstr(language_reserved, spaced) ? "_" : "", t->file);
}

/* All declarations begin with the prefix. */
static void put_declared(const translation *t, const declaration *d)
{
    const word *name = &t->word[d->name];
    if (strncmp(name->text, "vndf_", 5) != 0 && strncmp(name->text, "VNDF_", 5) != 0)
        fputs(d->kind == CONSTANT ? t->upper : t->lower, t->file);
    put_prefixed(t, name->text, (size_t)name->length);
}

static declaration *declared(translation *t, int name)
{
    const word *w = &t->word[name];
    for (int i = 0; i < t->count && w->kind == WORD_NAME; i++) {
        const word *own = &t->word[t->at[i].name];
        if (own->length == w->length && memcmp(own->text, w->text, (size_t)w->length) == 0)
            return &t->at[i];
    }
    return NULL;
}

static int is_struct(translation *t, int type)
{
    const declaration *d = declared(t, type);
    return d && d->kind == STRUCT;
}

static void put_words(translation *t, int at, int end);
static void put_parameters(translation *t, const declaration *d);

/* A form of the language: for a type, a variable, a declaration. */
static void put_form(translation *t, const char *form, const declaration *d, int type, int name)
{
    for (size_t plain; *form; form++) {
        const word *w = &t->word[type];
        int length;
        plain = strcspn(form, "$");
        put_prefixed(t, form, plain);
        if (!*(form += plain))
            break;
        switch (*++form) {
        case 'T': {
            const char *own = language_type(t->to, w->text, w->length, &length);
            if (own)
                put_prefixed(t, own, (size_t)length);
            else if (is_struct(t, type))
                put_declared(t, declared(t, type));
            else
                put_name(t, w);
            break;
        }
        case 'V': put_name(t, &t->word[name]); break;
        case 'D': put_declared(t, d); break;
        case 'P': put_parameters(t, d); break;
        case 'N': put_words(t, name + 2, d && d->kind == CONSTANT ? d->end : name + 3); break;
        default: break;
        }
    }
}

/* ---- expressions --------------------------------------------------------------------------------- */

/* All is float: a double of the kernel, which has no f at its end, is printed with 9 digits. */
static void put_number(const translation *t, const word *number)
{
    const size_t length = (size_t)number->length;
    const int is_hex = length > 1 && number->text[1] == 'x', is_float = !is_hex && number->text[length - 1] == 'f';
    char text[40];
    if (is_float || !memchr(number->text, is_hex ? 'p' : '.', length)) {
        fprintf(t->file, "%.*s", number->length - (t->to->indents && is_float), number->text);
        return;
    }
    snprintf(text, sizeof text, "%.9g", strtod(number->text, NULL));
    fprintf(t->file, "%s%s%s", text, strpbrk(text, ".en") ? "" : ".0", t->to->indents ? "" : "f");
}

/* Whether one of the signs stands outside of brackets. */
static int has_sign(const translation *t, int at, int end, const char *signs)
{
    for (; at<end; at = t->word[at].other> at ? t->word[at].other + 1 : at + 1)
        if (t->word[at].kind == WORD_SIGN && strchr(signs, *t->word[at].text))
            return 1;
    return 0;
}

/* A pattern of *length characters for a call, or NULL. */
static const char *pattern_of(const translation *t, int name, int *length)
{
    if (!word_is(&t->word[name], "fetch"))
        return language_call(t->to, t->word[name].text, t->word[name].length, length);
    *length = (int)strlen(t->fetched);
    return t->fetched;
}

/* A name before its brackets; returns what follows them. */
static int put_call(translation *t, int name)
{
    int length, close = t->word[name + 1].other;
    const char *pattern = pattern_of(t, name, &length), *weak = length == 2 ? "+-*/&|<>" : "&|<>";
    const declaration *d = declared(t, name);
    if (!pattern) {
        if (d && d->kind == FUNCTION)
            put_declared(t, d);
        else
            put_name(t, &t->word[name]);
        fputs(!d || !d->fetches || !t->by_pointer ? "(" : close == name + 2 ? "(numbers" : "(numbers, ", t->file);
        put_words(t, name + 2, close);
        fputs(")", t->file);
        return close + 1;
    }
    for (int i = 0; i < length; i++) {
        if (pattern[i] != '$') {
            int n = (int)strcspn(pattern + i, "$");
            n = n < length - i ? n : length - i;
            put_prefixed(t, pattern + i, (size_t)n);
            i += n - 1;
            continue;
        }
        int at = name + 2, end;
        for (int skip = pattern[++i] - '1'; skip > 0; skip--)
            at = word_find(t, at, close, ",") + 1;
        end = word_find(t, at, close, ",");
        int brackets = has_sign(t, at, end, weak);
        fputs(brackets ? "(" : "", t->file);
        put_words(t, at, end);
        fputs(brackets ? ")" : "", t->file);
    }
    return close + 1;
}

/* Blanks and comments before a word, without directives; Python, where a line ends a statement, has one blank. */
static void put_gap(const translation *t, int at)
{
    const char *end = t->word[at].text, *from = end - t->word[at].gap;
    if (t->to->indents)
        fputs(from < end ? " " : "", t->file);
    for (const char *next; from < end && !t->to->indents; from = next) {
        next = *from == '/' ? strstr(from, "*/") + 2 : *from == '#' ? from + strcspn(from, "\n") + 1 : from + 1;
        put_prefixed(t, from, *from == '#' ? 0 : (size_t)(next - from));
    }
}

static int put_word(translation *t, int at)
{
    const word *w = &t->word[at];
    if (w->kind == WORD_NUMBER) {
        put_number(t, w);
    } else if (w->kind == WORD_NAME && !word_is(w - 1, ".")) {
        if (word_is(w + 1, "(") && !word_is(w, "return"))
            return put_call(t, at);
        const declaration *d = declared(t, at);
        if (d && (d->kind == CONSTANT || d->kind == ARRAY))
            put_declared(t, d);
        else
            put_name(t, w);
    } else if (t->to->indents && word_is(w, "/") && w[1].kind == WORD_NUMBER &&
               !memchr(w[1].text, '.', (size_t)w[1].length)) {
        fputs("//", t->file); /* of whole numbers */
    } else if (t->to->indents && word_is(w, "&&")) {
        fputs("and", t->file);
    } else {
        put_name(t, w);
    }
    return at + 1;
}

static void put_words(translation *t, int at, int end)
{
    for (int from = at; at < end;) {
        if (at > from)
            put_gap(t, at);
        at = put_word(t, at);
    }
}

/* ---- statements ---------------------------------------------------------------------------------- */

static int put_statement(translation *t, int at);

/* Blanks before the line of a word. */
static int indent_of(const translation *t, int at)
{
    const char *line = t->word[at].text;
    while (line[-1] != '\n')
        line--;
    return (int)strspn(line, " ");
}

/* Whether the words of a function assign to the name, which begins a statement then, or to a part of it. */
static int is_assigned(const translation *t, const declaration *d, int name)
{
    const word *own = &t->word[name];
    for (int at = t->word[d->inner].other + 2; at < d->end; at++) {
        const word *w = &t->word[at];
        int block = word_is(w - 1, "{") && (word_is(w - 2, ")") || word_is(w - 2, "else"));
        int begins = block || strchr(";})", *w[-1].text) || word_is(w - 1, "else"),
            sets = strchr("=.[", *w[1].text) != NULL;
        if (begins && sets && w[1].length == 1 && w->length == own->length &&
            memcmp(w->text, own->text, (size_t)w->length) == 0)
            return 1;
    }
    return 0;
}

/* Python binds names to one struct where C copies it. */
static void put_value(translation *t, int type, int at, int end)
{
    const int made = word_is(&t->word[at], "{"), call = made && t->to->made_by_call;
    const int copied = t->to->indents && !made && is_struct(t, type) && !has_sign(t, at, end, "(");
    if (call)
        put_form(t, "$T", NULL, type, 0);
    fputs(call ? "(" : made ? "{" : copied ? "_copy(" : "", t->file);
    put_words(t, at + made, end - made);
    fputs(call || copied ? ")" : made ? "}" : "", t->file);
}

/* type a = x, b, c[N] to before `end`: variables, or members of a struct. */
static void put_variables(translation *t, int type, int end, int members)
{
    const language *to = t->to;
    for (int name = type + 1, stop; name < end; name = stop + 1) {
        const int first = name == type + 1, equals = word_is(&t->word[name + 1], "=");
        stop = word_find(t, name, end, ",");
        if (!first && to->apart) {
            fprintf(t->file, "%s\n%*s", members ? "," : to->indents ? "" : ";", indent_of(t, type), "");
        } else if (!first) {
            fputs(",", t->file);
            put_gap(t, name);
        }
        fputs(to->apart && !to->indents && !members ? "var " : "", t->file);
        put_form(t,
                 word_is(&t->word[name + 1], "[") ? to->several
                 : first || to->apart             ? to->typed
                                                  : "$V",
                 NULL, type, name);
        if (equals) {
            fputs(" = ", t->file);
            put_value(t, type, name + 2, stop);
        } else if (!members && (to->indents || (to->zero && is_struct(t, type)))) {
            fputs(" = ", t->file);
            put_form(t, is_struct(t, type) ? to->zero : "0", NULL, type, 0);
        }
    }
}

/* What an if or a for governs, in braces, which close under the line of `head`; returns what follows. */
static int put_governed(translation *t, int head, int at)
{
    const int is_block = word_is(&t->word[at], "{"), close = is_block ? t->word[at].other : 0;
    fputs(t->to->indents ? ":" : " {", t->file);
    for (at += is_block; is_block && at < close;)
        at = put_statement(t, at);
    if (!is_block)
        at = put_statement(t, at);
    if (!t->to->indents && is_block)
        put_gap(t, close);
    else if (!t->to->indents)
        fprintf(t->file, "\n%*s", indent_of(t, head), "");
    fputs(t->to->indents ? "" : "}", t->file);
    return at + is_block;
}

/* any(less(a, b)) has brackets already. */
static void put_condition(translation *t, int at, int end)
{
    const word *w = &t->word[at];
    int length, whole = word_is(w, "any") && w[1].other == end - 1 && word_is(w + 3, "(") && w[3].other == end - 2;
    const char *pattern = whole ? pattern_of(t, at + 2, &length) : NULL;
    const int is_not = word_is(w, "!") && at + 2 == end, is_name = at + 1 == end || is_not;
    if (pattern && *pattern == '(' && !t->to->indents) {
        put_call(t, at + 2);
        return;
    }
    fputs("(", t->file);
    put_words(t, at + is_not, end);
    fputs(!is_name ? ")" : is_not ? " == 0)" : " != 0)", t->file);
}

static int put_if(translation *t, int at)
{
    const int close = t->word[at + 1].other, indents = t->to->indents;
    fputs("if ", t->file);
    put_condition(t, at + 2, close);
    const int next = put_governed(t, at, close + 1);
    if (!word_is(&t->word[next], "else"))
        return next;
    if (indents)
        fprintf(t->file, "\n%*s", indent_of(t, next), "");
    if (word_is(&t->word[next + 1], "if")) {
        fputs(indents ? "el" : " else ", t->file);
        return put_if(t, next + 1);
    }
    fputs(indents ? "else" : " else", t->file);
    return put_governed(t, next, next + 1);
}

/* for (int i = A; i < B; i++) */
static int put_for(translation *t, int at)
{
    const int close = t->word[at + 1].other, first = word_find(t, at + 2, close, ";"),
              second = word_find(t, first + 1, close, ";");
    const declaration *end = declared(t, first + 3);
    if (end && end->kind == CONSTANT && t->to->unroll)
        fprintf(t->file, "%s\n%*s", t->to->unroll, indent_of(t, at), "");
    if (t->to->indents) {
        put_form(t, "for $V in range(", NULL, 0, at + 3);
        put_words(t, at + 5, first);
        fputs(", ", t->file);
        put_words(t, first + 3, second);
    } else {
        fputs("for (", t->file);
        put_variables(t, at + 2, first, 0);
        fputs("; ", t->file);
        put_words(t, first + 1, second);
        fputs("; ", t->file);
        put_words(t, second + 1, close);
    }
    fputs(")", t->file);
    return put_governed(t, at, close + 1);
}

/* Returns what follows. */
static int put_statement(translation *t, int at)
{
    if (t->to->indents)
        fprintf(t->file, "\n%*s", indent_of(t, at), "");
    else
        put_gap(t, at);
    if (word_is(&t->word[at], "if"))
        return put_if(t, at);
    if (word_is(&t->word[at], "for"))
        return put_for(t, at);
    const int end = word_find(t, at, t->words, ";");
    at += word_is(&t->word[at], "const");
    if (t->word[at + 1].kind == WORD_NAME && !word_is(&t->word[at], "return"))
        put_variables(t, at, end, 0);
    else
        put_words(t, at, end);
    fputs(t->to->indents ? "" : ";", t->file);
    return end + 1;
}

/* ---- declarations -------------------------------------------------------------------------------- */

static void put_parameters(translation *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    if (d->fetches && t->by_pointer)
        fprintf(t->file, "%snumbers%s", t->to->pointer, close > d->inner + 2 ? ", " : "");
    for (int at = d->inner + 1; at + 1 < close; at++) {
        at += word_is(&t->word[at], "const");
        put_form(t, t->to->copied && is_assigned(t, d, at + 1) ? t->to->given : t->to->typed, NULL, at, at + 1);
        at = word_find(t, at, close, ",");
        fputs(at < close ? ", " : "", t->file);
    }
}

static void put_function(translation *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    put_form(t, t->to->function, d, d->type, 0);
    for (int at = d->inner + 1; at + 1 < close && t->to->copied; at = word_find(t, at, close, ",") + 1)
        if (is_assigned(t, d, word_find(t, at, close, ",") - 1)) {
            fputs("\n    ", t->file);
            put_form(t, t->to->copied, NULL, 0, word_find(t, at, close, ",") - 1);
        }
    for (int at = close + 2; at < d->end - 1;)
        at = put_statement(t, at);
    if (t->to->indents)
        return;
    put_gap(t, d->end - 1);
    fputs("}", t->file);
}

static void put_struct(translation *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    put_form(t, t->to->structs, d, 0, 0);
    for (int at = d->inner + 1, end; at < close; at = end + 1) {
        end = word_find(t, at, close, ";");
        for (int name = at + 1; name < end && t->to->indents; name = word_find(t, name, end, ",") + 1)
            put_form(t, "\"$V\", ", NULL, 0, name);
        if (t->to->indents)
            continue;
        put_gap(t, at);
        put_variables(t, at, end, 1);
        fputs(t->to->apart ? "," : ";", t->file);
    }
    if (!t->to->indents)
        put_gap(t, close);
    put_form(t, t->to->structs_close, d, 0, 0);
}

/* The comment that ends on the line before. */
static void put_comment_before(const translation *t, const declaration *d)
{
    const word *first = &t->word[d->begin];
    const char *comment = NULL;
    if (first->gap < 5 || strncmp(first->text - 4, " */\n", 4) != 0 || t->to->indents)
        return;
    for (const char *at = first->text - first->gap; at < first->text; at++)
        comment = strncmp(at, "/*", 2) == 0 ? at : comment;
    put_prefixed(t, comment, (size_t)(first->text - comment));
}

static void want(translation *t, declaration *d)
{
    if (d->wanted)
        return;
    d->wanted = 1;
    for (int i = d->kind == CONSTANT ? d->end : d->begin, length; i < d->end; i++) {
        declaration *of = word_is(&t->word[i - (i > 0)], ".") ? NULL : declared(t, i);
        d->fetches |= word_is(&t->word[i], "fetch");
        if (!of || of == d || (of->kind == FUNCTION && !word_is(&t->word[i + 1], "(")) ||
            pattern_of(t, i, &length))
            continue;
        want(t, of);
        d->fetches |= of->fetches;
    }
}

void translation_want(translation *t, const char *name, size_t length)
{
    for (int i = 0; i < t->count; i++) {
        const word *own = &t->word[t->at[i].name];
        if (strncmp(own->text, name, length) == 0 && ((size_t)own->length == length || own->text[length] == '_'))
            want(t, &t->at[i]);
    }
}

void translate(translation *t, int first)
{
    for (int i = first, in_constants = 0; i < t->count; i++) {
        const declaration *d = &t->at[i];
        if (!d->wanted)
            continue;
        fputs(in_constants && d->kind != CONSTANT ? "\n" : "", t->file);
        in_constants = d->kind == CONSTANT;
        if (!in_constants || d->name == d->begin + 2)
            put_comment_before(t, d);
        if (d->kind == FUNCTION) {
            put_function(t, d);
        } else if (d->kind == STRUCT) {
            put_struct(t, d);
        } else if (d->kind == ARRAY) {
            put_form(t, t->to->array, d, 0, d->name);
            put_words(t, d->inner + 1, t->word[d->inner].other);
            fputs(t->to->array_close, t->file);
        } else {
            put_form(t, t->to->constant, d, 0, d->name);
        }
        fputs(in_constants ? "\n" : "\n\n", t->file);
    }
}
