#include "export/translate.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef enum word_kind { WORD_NAME, WORD_NUMBER, WORD_SIGN, WORD_END } word_kind;

typedef struct word {
    word_kind kind;
    const char *text; /* not terminated */
    int length;
    int gap;   /* characters between the last word and this one: blanks, comments, directives */
    int other; /* of a bracket: the word that closes or opens it */
} word;

typedef enum declaration_kind { FUNCTION, STRUCT, CONSTANT, ARRAY } declaration_kind;

/* Words from `begin` to before `end`. `inner` is the bracket that opens members, numbers or parameters, or the first
 * word of a constant's value. */
typedef struct declaration {
    declaration_kind kind;
    int name, type, begin, inner, end;
    int wanted;  /* it goes into the file */
    int fetches; /* it reads numbers of tables */
} declaration;

enum { DECLARATIONS_MAX = 1024 };

typedef struct printer {
    const translation *as;
    int apart, indents; /* of the language */
    FILE *file;
    word *word;
    int words, count;
    declaration at[DECLARATIONS_MAX];
} printer;

/* ---- the prefix ---------------------------------------------------------------------------------- */

int translation_prefix(translation *t, const char *name)
{
    const size_t n = strlen(name);
    if (n == 0 || n > PREFIX_MAX || strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_") < n || name[0] == '_' ||
        isdigit((unsigned char)name[0]) || name[n - 1] == '_' || strstr(name, "__") || strcmp(name, "gl") == 0 ||
        strncmp(name, "gl_", 3) == 0)
        return 0;
    snprintf(t->lower, sizeof t->lower, "%s_", name);
    for (size_t i = 0; i <= n + 1; i++)
        t->upper[i] = (char)toupper((unsigned char)t->lower[i]);
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

/* ---- words and declarations --------------------------------------------------------------------- */

static size_t gap_length(const char *from)
{
    const char *at = from;
    for (;;) {
        if (*at == ' ' || *at == '\n')
            at++;
        else if (strncmp(at, "/*", 2) == 0)
            at = strstr(at, "*/") + 2;
        else if (*at == '#')
            do /* with its continuations */
                at += 1 + strcspn(at + 1, "\n");
            while (at[-1] == '\\');
        else
            return (size_t)(at - from);
    }
}

/* What the C compiler took for a number is one: digits, letters, points, signs of exponents. */
static word word_at(const char *from)
{
    static const char pairs[] = "&& || == != <= >= << >> ++";
    const size_t gap = gap_length(from);
    const char *at = from + gap, *exponent = at[0] == '0' && at[1] == 'x' ? "p" : "e";
    int n = *at != '\0';
    word w = {n ? WORD_SIGN : WORD_END, at, 0, (int)gap, 0};
    if (isdigit((unsigned char)*at)) {
        w.kind = WORD_NUMBER;
        while (isalnum((unsigned char)at[n]) || at[n] == '.' ||
               (strchr("+-", at[n]) && strchr(exponent, at[n - 1])))
            n++;
    } else if (isalpha((unsigned char)*at) || *at == '_') {
        w.kind = WORD_NAME;
        while (isalnum((unsigned char)at[n]) || at[n] == '_')
            n++;
    } else {
        for (const char *pair = pairs; n == 1 && pair < pairs + sizeof pairs - 1; pair += 3)
            n += strncmp(at, pair, 2) == 0;
    }
    w.length = n;
    return w;
}

static int word_is(const word *w, const char *name)
{
    return strlen(name) == (size_t)w->length && memcmp(w->text, name, strlen(name)) == 0;
}

static int word_find(const printer *t, int at, int end, const char *sign)
{
    while (at < end && !word_is(&t->word[at], sign))
        at = t->word[at].other > at ? t->word[at].other + 1 : at + 1;
    return at < end ? at : end;
}

/* Adds the declaration that begins there; of an enum each name is one. Returns what follows. */
static int read_declaration(printer *t, int at)
{
    const word *w = &t->word[at];
    const int inner = at + (word_is(w, "enum") ? 1 : word_is(w, "static") ? 8 : 3), close = t->word[inner].other;
    declaration d = {.kind = FUNCTION, .name = at + 2, .type = at + 1, .begin = at, .inner = inner};
    d.end = t->word[close + 1].other + 1;
    for (int name = at + 2; word_is(w, "enum") && name < close; name = d.end + 1) {
        d = (declaration){.kind = CONSTANT, .name = name, .begin = at, .inner = name + 2};
        d.end = word_find(t, name, close, ",");
        t->at[t->count++] = d;
    }
    if (word_is(w, "enum"))
        return close + 2;
    if (word_is(w, "typedef")) {
        d.kind = STRUCT;
        d.end = close + 3;
    } else if (word_is(w, "static")) {
        d.kind = ARRAY;
        d.name = at + 3;
        d.end = close + 2;
    }
    t->at[t->count++] = d;
    return d.end;
}

static int read_text(printer *t, const char *source)
{
    int open[32], depth = 0, room = 0, at = 0;
    do {
        if (t->words == room) {
            word *more = realloc(t->word, (size_t)(room = 2 * room + 4096) * sizeof *more);
            if (!more)
                return 0;
            t->word = more;
        }
        word *w = &t->word[t->words];
        *w = word_at(source);
        source = w->text + w->length;
        if (w->kind == WORD_SIGN && strchr("([{", *w->text)) {
            open[depth++] = t->words;
        } else if (w->kind == WORD_SIGN && strchr(")]}", *w->text)) {
            w->other = open[--depth];
            t->word[w->other].other = t->words;
        }
    } while (t->word[t->words++].kind != WORD_END);
    while (t->word[at].kind != WORD_END && t->count < DECLARATIONS_MAX - 64)
        at = read_declaration(t, at);
    return t->word[at].kind == WORD_END;
}

/* ---- names --------------------------------------------------------------------------------------- */

static int is_same(const printer *t, int a, int b)
{
    const word *v = &t->word[a], *w = &t->word[b];
    return v->length == w->length && memcmp(v->text, w->text, (size_t)v->length) == 0;
}

/* The declaration of that name, if it is of one of these kinds (1 << FUNCTION ...), or NULL. */
static declaration *declared(printer *t, int name, int kinds)
{
    for (declaration *d = t->at; d < t->at + t->count; d++)
        if (is_same(t, d->name, name))
            return kinds >> d->kind & 1 ? d : NULL;
    return NULL;
}

/* Declarations, of these kinds, begin with the prefix; a variable or a member must not be a word of the language. */
static void put_name(printer *t, int name, int kinds)
{
    const word *w = &t->word[name];
    const declaration *d = declared(t, name, kinds);
    char spaced[80];
    snprintf(spaced, sizeof spaced, " %.*s ", w->length, w->text);
    if (d && strncmp(w->text, "vndf_", 5) != 0 && strncmp(w->text, "VNDF_", 5) != 0)
        fputs(d->kind == CONSTANT ? t->as->upper : t->as->lower, t->file);
    put_prefixed(t->as, t->file, w->text, (size_t)w->length);
    fputs(!d && strstr(language_reserved, spaced) ? "_" : "", t->file);
}

/* What the language has for a type, *length characters, or NULL. */
static const char *own_type(const printer *t, int type, int *length)
{
    return language_word(t->as->to, t->word[type].text, t->word[type].length, ": ", length);
}

static int is_struct(printer *t, int type)
{
    int length;
    return declared(t, type, 1 << STRUCT) && !own_type(t, type, &length);
}

static void put_words(printer *t, int at, int end);
static void put_parameters(printer *t, const declaration *d);

/* Argument i of a call, in brackets where it has signs that bind less than those of the pattern. */
static void put_argument(printer *t, int call, int i, const char *signs)
{
    const int close = t->word[call + 1].other;
    int at = call + 2, end, brackets = 0;
    for (; i > 0; i--)
        at = word_find(t, at, close, ",") + 1;
    end = word_find(t, at, close, ",");
    for (int next = at; next < end;) {
        const word *w = &t->word[next];
        brackets |= w->kind == WORD_SIGN && strchr(signs, *w->text);
        next = w->other > next ? w->other + 1 : next + 1;
    }
    fputs(brackets ? "(" : "", t->file);
    put_words(t, at, end);
    fputs(brackets ? ")" : "", t->file);
}

/* What the language has for a form, of a declaration, a type and a name, or for the call of that name. */
static void put_own(printer *t, const char *own, int length, const declaration *d, int type, int name)
{
    int type_length;
    for (const char *at = own, *end = own + length, *plain, *type_is; at < end; at++) {
        for (plain = at; at < end && *at != '$'; at++)
            ;
        put_prefixed(t->as, t->file, plain, (size_t)(at - plain));
        switch (at < end ? *++at : ' ') {
        case ' ': break;
        case 'T':
            if ((type_is = own_type(t, type, &type_length)) != NULL)
                put_prefixed(t->as, t->file, type_is, (size_t)type_length);
            else
                put_name(t, type, 1 << STRUCT);
            break;
        case 'V': put_name(t, name, 0); break;
        case 'D': put_name(t, d->name, 1 << d->kind); break;
        case 'P': put_parameters(t, d); break;
        case 'N': put_words(t, name + 2, d && d->kind == CONSTANT ? d->end : name + 3); break;
        default: put_argument(t, name, *at - '1', length == 2 ? "+-*/&|<>" : "&|<>");
        }
    }
}

/* 0 if the language has no such form. */
static int put_form(printer *t, const char *form, const declaration *d, int type, int name)
{
    int length;
    const char *own = language_word(t->as->to, form, (int)strlen(form), ": ", &length);
    if (own)
        put_own(t, own, length, d, type, name);
    return own != NULL;
}

/* ---- expressions --------------------------------------------------------------------------------- */

/* All is float: a double of the kernel, which has no f at its end, is printed with 9 digits. */
static void put_number(const printer *t, const word *number)
{
    const size_t length = (size_t)number->length;
    const int is_hex = length > 1 && number->text[1] == 'x', is_float = !is_hex && number->text[length - 1] == 'f';
    char digits[40];
    if (is_float || !memchr(number->text, is_hex ? 'p' : '.', length)) {
        fprintf(t->file, "%.*s", number->length - (t->indents && is_float), number->text);
        return;
    }
    snprintf(digits, sizeof digits, "%.9g", strtod(number->text, NULL));
    fprintf(t->file, "%s%s%s", digits, strpbrk(digits, ".en") ? "" : ".0", t->indents ? "" : "f");
}

/* What the language has for a call, *length characters, or NULL. */
static const char *own_call(const printer *t, int name, int *length)
{
    const word *w = &t->word[name];
    const int embedded = t->as->embeds && word_is(w, "fetch");
    *length = 16;
    return embedded ? "VNDF_NUMBERS[$1]" : language_word(t->as->to, w->text, w->length, " = ", length);
}

/* A name before its brackets; returns what follows them. */
static int put_call(printer *t, int name)
{
    const int close = t->word[name + 1].other;
    const declaration *d = declared(t, name, 1 << FUNCTION);
    int length;
    const char *own = own_call(t, name, &length);
    if (own) {
        put_own(t, own, length, NULL, 0, name);
        return close + 1;
    }
    put_name(t, name, 1 << FUNCTION);
    fputs(!d || !d->fetches || !t->as->by_pointer ? "(" : close == name + 2 ? "(numbers" : "(numbers, ", t->file);
    put_words(t, name + 2, close);
    fputs(")", t->file);
    return close + 1;
}

/* Blanks and comments before a word, without directives; Python, where a line ends a statement, has one blank. */
static void put_gap(const printer *t, int at)
{
    const char *end = t->word[at].text, *from = end - t->word[at].gap;
    if (t->indents)
        fputs(from < end ? " " : "", t->file);
    for (const char *next; from < end && !t->indents; from = next) {
        next = *from == '/' ? strstr(from, "*/") + 2 : *from == '#' ? from + strcspn(from, "\n") + 1 : from + 1;
        put_prefixed(t->as, t->file, from, *from == '#' ? 0 : (size_t)(next - from));
    }
}

static void put_words(printer *t, int at, int end)
{
    for (int from = at; at < end; at++) {
        const word *w = &t->word[at];
        const int is_member = word_is(w - 1, "."), is_call = word_is(w + 1, "(") && w->kind == WORD_NAME;
        if (at > from)
            put_gap(t, at);
        if (w->kind == WORD_NUMBER)
            put_number(t, w);
        else if (is_call && !is_member && !word_is(w, "return"))
            at = put_call(t, at) - 1;
        else if (t->indents && word_is(w, "/") && w[1].kind == WORD_NUMBER &&
                 !memchr(w[1].text, '.', (size_t)w[1].length))
            fputs("//", t->file); /* of whole numbers */
        else if (t->indents && word_is(w, "&&"))
            fputs("and", t->file);
        else
            put_name(t, at, is_member ? 0 : 1 << CONSTANT | 1 << ARRAY);
    }
}

/* ---- statements ---------------------------------------------------------------------------------- */

static int put_statement(printer *t, int at);

/* Blanks before the line of a word. */
static int indent_of(const printer *t, int at)
{
    const char *line = t->word[at].text;
    while (line[-1] != '\n')
        line--;
    return (int)strspn(line, " ");
}

/* Whether a function assigns to the name, or to a part of it: what stands before a "=" and is no declaration. */
static int is_assigned(const printer *t, const declaration *d, int name)
{
    for (int at = t->word[d->inner].other + 2, from; at < d->end; at++) {
        if (!word_is(&t->word[at], "="))
            continue;
        for (from = at - 1; word_is(&t->word[from - 1], ".") || word_is(&t->word[from], "]");)
            from = word_is(&t->word[from], "]") ? t->word[from].other - 1 : from - 2;
        if (is_same(t, from, name) && (t->word[from - 1].kind != WORD_NAME || word_is(&t->word[from - 1], "else")))
            return 1;
    }
    return 0;
}

/* Python binds names to one struct where C copies it. */
static void put_value(printer *t, int type, int at, int end)
{
    const int made = word_is(&t->word[at], "{");
    const int copied = t->indents && !made && is_struct(t, type) && word_find(t, at, end, "(") == end;
    if (made)
        put_form(t, "MAKE", NULL, type, 0);
    fputs(copied ? "_copy(" : "", t->file);
    put_words(t, at + made, end - made);
    fputs(copied ? ")" : "", t->file);
    if (made)
        put_form(t, "MADE", NULL, 0, 0);
}

/* type a = x, b, c[N] to before `end`: variables, or members of a struct. */
static void put_variables(printer *t, int type, int end, int members)
{
    int length;
    const int zero = !members && is_struct(t, type) && language_word(t->as->to, "ZERO", 4, ": ", &length);
    for (int name = type + 1, stop; name < end; name = stop + 1) {
        const int first = name == type + 1;
        stop = word_find(t, name, end, ",");
        if (!first && t->apart) {
            fprintf(t->file, "%s\n%*s", members ? "," : t->indents ? "" : ";", indent_of(t, type), "");
        } else if (!first) {
            fputs(",", t->file);
            put_gap(t, name);
        }
        fputs(t->apart && !t->indents && !members ? "var " : "", t->file);
        if (first || t->apart)
            put_form(t, word_is(&t->word[name + 1], "[") ? "SEVERAL" : "TYPED", NULL, type, name);
        else
            put_name(t, name, 0);
        if (word_is(&t->word[name + 1], "=")) {
            fputs(" = ", t->file);
            put_value(t, type, name + 2, stop);
        } else if (zero) {
            fputs(" = ", t->file);
            put_form(t, "ZERO", NULL, type, 0);
        } else if (!members && t->indents) {
            fputs(" = 0", t->file);
        }
    }
}

/* What an if or a for governs, in braces, which close under the line of `head`; returns what follows. */
static int put_governed(printer *t, int head, int at)
{
    const int is_block = word_is(&t->word[at], "{"), close = is_block ? t->word[at].other : 0;
    fputs(t->indents ? ":" : " {", t->file);
    for (at += is_block; is_block && at < close;)
        at = put_statement(t, at);
    if (!is_block)
        at = put_statement(t, at);
    if (!t->indents && is_block)
        put_gap(t, close);
    else if (!t->indents)
        fprintf(t->file, "\n%*s", indent_of(t, head), "");
    fputs(t->indents ? "" : "}", t->file);
    return at + is_block;
}

/* any(less(a, b)) has brackets already. */
static void put_condition(printer *t, int at, int end)
{
    const word *w = &t->word[at];
    int length, whole = word_is(w, "any") && w[1].other == end - 1 && word_is(w + 3, "(") && w[3].other == end - 2;
    const char *own = whole ? own_call(t, at + 2, &length) : NULL;
    const int is_not = word_is(w, "!") && at + 2 == end, is_name = at + 1 == end || is_not;
    if (own && *own == '(' && !t->indents) {
        put_call(t, at + 2);
        return;
    }
    fputs("(", t->file);
    put_words(t, at + is_not, end);
    fputs(!is_name ? ")" : is_not ? " == 0)" : " != 0)", t->file);
}

static int put_if(printer *t, int at)
{
    const int close = t->word[at + 1].other, indents = t->indents;
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
static int put_for(printer *t, int at)
{
    const int close = t->word[at + 1].other, first = word_find(t, at + 2, close, ";"),
              second = word_find(t, first + 1, close, ";");
    if (declared(t, first + 3, 1 << CONSTANT) && put_form(t, "UNROLL", NULL, 0, 0))
        fprintf(t->file, "\n%*s", indent_of(t, at), "");
    if (t->indents) {
        put_own(t, "for $V in range(", 16, NULL, 0, at + 3);
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
static int put_statement(printer *t, int at)
{
    if (t->indents)
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
    fputs(t->indents ? "" : ";", t->file);
    return end + 1;
}

/* ---- declarations -------------------------------------------------------------------------------- */

static void put_parameters(printer *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    if (d->fetches && t->as->by_pointer) {
        put_form(t, "POINTER", NULL, 0, 0);
        fputs(close > d->inner + 2 ? "numbers, " : "numbers", t->file);
    }
    for (int at = d->inner + 1; at + 1 < close; at++) {
        at += word_is(&t->word[at], "const");
        if (!is_assigned(t, d, at + 1) || !put_form(t, "GIVEN", NULL, at, at + 1))
            put_form(t, "TYPED", NULL, at, at + 1);
        at = word_find(t, at, close, ",");
        fputs(at < close ? ", " : "", t->file);
    }
}

static void put_function(printer *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    put_form(t, "FUNCTION", d, d->type, 0);
    for (int at = d->inner + 1, end; at + 1 < close && t->apart; at = end + 1) {
        end = word_find(t, at, close, ",");
        if (is_assigned(t, d, end - 1)) {
            fputs("\n    ", t->file);
            put_form(t, "COPY", NULL, 0, end - 1);
        }
    }
    for (int at = close + 2; at < d->end - 1;)
        at = put_statement(t, at);
    if (t->indents)
        return;
    put_gap(t, d->end - 1);
    fputs("}", t->file);
}

static void put_struct(printer *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    put_form(t, "STRUCT", d, 0, 0);
    for (int at = d->inner + 1, end; at < close; at = end + 1) {
        end = word_find(t, at, close, ";");
        for (int name = at + 1; name < end && t->indents; name = word_find(t, name, end, ",") + 1)
            put_own(t, "\"$V\", ", 6, NULL, 0, name);
        if (t->indents)
            continue;
        put_gap(t, at);
        put_variables(t, at, end, 1);
        fputs(t->apart ? "," : ";", t->file);
    }
    if (!t->indents)
        put_gap(t, close);
    put_form(t, "STRUCT_END", d, 0, 0);
}

/* The comment that ends on the line before. */
static void put_comment_before(const printer *t, const declaration *d)
{
    const word *first = &t->word[d->begin];
    const char *comment = NULL;
    if (first->gap < 5 || strncmp(first->text - 4, " */\n", 4) != 0 || t->indents)
        return;
    for (const char *at = first->text - first->gap; at < first->text; at++)
        comment = strncmp(at, "/*", 2) == 0 ? at : comment;
    put_prefixed(t->as, t->file, comment, (size_t)(first->text - comment));
}

static void want(printer *t, declaration *d)
{
    if (d->wanted)
        return;
    d->wanted = 1;
    for (int i = d->kind == CONSTANT ? d->end : d->begin, length; i < d->end; i++) {
        const int is_call = word_is(&t->word[i + 1], "("), is_member = i > 0 && word_is(&t->word[i - 1], ".");
        declaration *of = is_member ? NULL : declared(t, i, is_call ? -1 : ~(1 << FUNCTION));
        d->fetches |= word_is(&t->word[i], "fetch");
        if (of && of != d && !own_call(t, i, &length) && !own_type(t, i, &length)) {
            want(t, of);
            d->fetches |= of->fetches;
        }
    }
}

static void want_named(printer *t, const char *name, size_t length)
{
    for (int i = 0; i < t->count; i++) {
        const word *own = &t->word[t->at[i].name];
        if (strncmp(own->text, name, length) == 0 && ((size_t)own->length == length || own->text[length] == '_'))
            want(t, &t->at[i]);
    }
}

int translate(const translation *as, const char *source, const char *wanted, FILE *to)
{
    printer whole = {.as = as,
                     .apart = (as->to->is & LANGUAGE_APART) != 0,
                     .indents = (as->to->is & LANGUAGE_INDENTS) != 0,
                     .file = to},
            *t = &whole;
    const int good = read_text(t, source);
    for (; good && *wanted; wanted += strcspn(wanted, " "), wanted += strspn(wanted, " "))
        want_named(t, wanted, strcspn(wanted, " "));
    for (int i = 0, in_constants = 0; i < t->count && good; i++) {
        const declaration *d = &t->at[i];
        if (!d->wanted && !(d->kind == CONSTANT && d->begin == 0)) /* those before the kernel are its host's */
            continue;
        fputs(in_constants && d->kind != CONSTANT ? "\n" : "", to);
        in_constants = d->kind == CONSTANT;
        if (!in_constants || d->name == d->begin + 2)
            put_comment_before(t, d);
        if (d->kind == FUNCTION) {
            put_function(t, d);
        } else if (d->kind == STRUCT) {
            put_struct(t, d);
        } else if (d->kind == ARRAY) {
            put_form(t, "ARRAY", d, 0, d->name);
            put_words(t, d->inner + 1, t->word[d->inner].other);
            put_form(t, "ARRAY_END", d, 0, 0);
        } else {
            put_form(t, "CONSTANT", d, 0, d->name);
        }
        fputs(in_constants ? "\n" : "\n\n", to);
    }
    free(t->word);
    return good;
}
