#include "export/export.h"

#include <ctype.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef enum word_kind { WORD_NAME, WORD_NUMBER, WORD_SIGN, WORD_END } word_kind;

typedef struct word {
    word_kind kind;
    const char *text; /* not terminated */
    int length;
    const char *before; /* what stands between the last word and this one: blanks and comments */
    int gap;            /* their number */
    int other;          /* of a bracket: the word that closes or opens it */
    int outdent;        /* blanks that its line begins with for an if that was folded */
    int is_dead;        /* it was folded away */
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
    const export_document *as;
    int apart, indents, by_pointer; /* of the language */
    FILE *file;
    word *word;
    int words, count;
    declaration at[DECLARATIONS_MAX];
} printer;

void put_prefixed(const export_document *as, FILE *to, const char *from, size_t length)
{
    for (const char *at = from, *end = from + length; at < end;) {
        int in_word = at > from && (at[-1] == '_' || isalnum((unsigned char)at[-1]));
        int lower = !in_word && strncmp(at, "vndf_", 5) == 0, upper = !in_word && strncmp(at, "VNDF_", 5) == 0;
        if (lower || upper)
            fputs(lower ? as->lower : as->upper, to);
        else
            fputc(*at, to);
        at += lower || upper ? 5 : 1;
    }
}

/* ---- words and declarations --------------------------------------------------------------------- */

/* What the C compiler took for a number is one: digits, letters, points, signs of exponents. */
static word word_at(const char *from)
{
    static const char pairs[] = "&& || == != <= >= << >> ++";
    const char *at = from;
    while (*at == ' ' || *at == '\n' || strncmp(at, "/*", 2) == 0)
        at = *at == '/' ? strstr(at, "*/") + 2 : at + 1;
    const char *exponent = at[0] == '0' && at[1] == 'x' ? "p" : "e";
    int n = *at != '\0';
    word w = {n ? WORD_SIGN : WORD_END, at, 0, from, (int)(at - from), 0, 0, 0};
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

/* Brackets know each other. */
static void pair_words(printer *t)
{
    int open[32], depth = 0;
    for (word *w = t->word; w < t->word + t->words; w++)
        if (w->kind == WORD_SIGN && strchr("([{", *w->text)) {
            open[depth++] = (int)(w - t->word);
        } else if (w->kind == WORD_SIGN && strchr(")]}", *w->text)) {
            w->other = open[--depth];
            t->word[w->other].other = (int)(w - t->word);
        }
}

/* ---- ifs of constants ----------------------------------------------------------------------------
 *
 * Where a condition, or the first part of one with &&, is made of numbers and constants the if goes before anything is
 * read: what it does not govern then is not there. A constant may have brackets, which are those of a call in C. */

enum { UNKNOWN = -1000 };

static int constant_at(const printer *t, const word *name)
{
    for (const word *w = t->word + 1; w->kind != WORD_END; w++)
        if (w->kind == WORD_NAME && w->length == name->length && !memcmp(w->text, name->text, (size_t)w->length) &&
            word_is(w + 1, "=") && w[2].kind == WORD_NUMBER && strchr("{,", *w[-1].text))
            return atoi(w[2].text);
    return UNKNOWN;
}

/* A number, or a constant with its brackets; *at goes behind. */
static int operand(const printer *t, int *at)
{
    const word *w = &t->word[*at];
    *at = word_is(w + 1, "(") ? w[1].other + 1 : *at + 1;
    return w->kind == WORD_NUMBER ? atoi(w->text) : w->kind == WORD_NAME ? constant_at(t, w) : UNKNOWN;
}

/* Whether a part of a condition, up to && or its end, is true; UNKNOWN if that is not known. */
static int part_value(const printer *t, int at, int *next, int close)
{
    const int is_not = word_is(&t->word[at], "!");
    int part = at + is_not, a = operand(t, &part);
    *next = word_find(t, at, close, "&&");
    if (word_is(&t->word[part], "==")) {
        part++;
        const int b = operand(t, &part);
        a = a == UNKNOWN || b == UNKNOWN ? UNKNOWN : a == b;
    }
    return a == UNKNOWN || part != *next ? UNKNOWN : (a != 0) != is_not;
}

static int statement_end(const printer *t, int at)
{
    if (word_is(&t->word[at], "{"))
        return t->word[at].other + 1;
    if (!word_is(&t->word[at], "if") && !word_is(&t->word[at], "for"))
        return word_find(t, at, t->words, ";") + 1;
    at = statement_end(t, t->word[at + 1].other + 1);
    return word_is(&t->word[at], "else") ? statement_end(t, at + 1) : at;
}

static void kill(printer *t, int at, int end)
{
    for (; at < end; at++)
        t->word[at].is_dead = 1;
}

static int is_else(const word *w)
{
    return word_is(w, "else") && !w->is_dead;
}

/* What stays of an if begins where that did, without braces unless it is what an else governs; after a return nothing
 * follows, up to `block`. */
static void keep(printer *t, int head, int at, int end, int block)
{
    word *first = &t->word[at];
    int last = at;
    if (word_is(first, "{") && !is_else(&t->word[head - 1])) {
        for (int i = at; i < end; i++)
            t->word[i].outdent += 4;
        first->is_dead = t->word[end - 1].is_dead = 1;
        for (int i = ++at; i < end - 1; i = statement_end(t, i))
            last = i;
        first++;
    }
    first->before = t->word[head].before;
    first->gap = t->word[head].gap + first->outdent - t->word[head].outdent;
    if (word_is(&t->word[last], "return"))
        kill(t, end, block);
}

static void fold_if(printer *t, int at, int block)
{
    const int close = t->word[at + 1].other, body = close + 1, end = statement_end(t, body);
    const int other = word_is(&t->word[end], "else") ? end + 1 : end, whole = statement_end(t, at);
    int part = at + 2, next, value = part_value(t, part, &next, close);
    for (; value == 1 && next < close; value = part_value(t, part = next + 1, &next, close))
        kill(t, part, next + 1);
    if (value == 1) {
        kill(t, at, body);
        kill(t, end, whole);
        keep(t, at, body, end, block);
    } else if (value == 0) {
        kill(t, at, other);
        if (other < whole)
            keep(t, at, other, whole, block);
        else if (is_else(&t->word[at - 1]))
            kill(t, at - 1, at);
    }
}

static void fold_all(printer *t)
{
    int kept = 0, block[32], depth = 0;
    for (int i = 0; i < t->words; i++) {
        while (depth > 0 && i >= block[depth - 1])
            depth--;
        if (word_is(&t->word[i], "{"))
            block[depth++] = t->word[i].other;
        if (word_is(&t->word[i], "if") && !t->word[i].is_dead)
            fold_if(t, i, block[depth - 1]);
    }
    for (int i = 0; i < t->words; i++)
        if (!t->word[i].is_dead)
            t->word[kept++] = t->word[i];
    t->words = kept;
    pair_words(t);
}

/* Adds the declaration that begins there; of an enum each name is one. Returns what follows. */
static int read_declaration(printer *t, int at)
{
    static const struct shape {
        const char *begins;
        declaration_kind kind;
        int name, inner, after; /* words from the first one; behind the bracket that closes */
    } shapes[] = {{"KERNEL", FUNCTION, 2, 3, 0},
                  {"CALL", FUNCTION, 2, 3, 0},
                  {"typedef", STRUCT, 2, 3, 3},
                  {"static", ARRAY, 3, 8, 2},
                  {"enum", CONSTANT, 2, 1, 2}};
    const struct shape *is = shapes;
    while (!word_is(&t->word[at], is->begins))
        is++;
    const int close = t->word[at + is->inner].other;
    const int end = is->kind == FUNCTION ? t->word[close + 1].other + 1 : close + is->after;
    for (int name = at + is->name; name < close;
         name = is->kind == CONSTANT ? t->at[t->count - 1].end + 1 : close) {
        declaration d = {is->kind, name, at + 1, at, at + is->inner, end, 0, 0};
        if (is->kind == CONSTANT) {
            d.inner = name + 2;
            d.end = word_find(t, name, close, ",");
        }
        t->at[t->count++] = d;
    }
    return end;
}

static int read_text(printer *t, const char *source)
{
    int room = 0, at = 0;
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
    } while (t->word[t->words++].kind != WORD_END);
    pair_words(t);
    fold_all(t);
    while (t->word[at].kind != WORD_END && t->count < DECLARATIONS_MAX - 64)
        at = read_declaration(t, at);
    return t->word[at].kind == WORD_END;
}

/* ---- names --------------------------------------------------------------------------------------- */

/* Without the prefix, if it has one. */
static const char *bare(const char *text)
{
    return text + (strncmp(text, "vndf_", 5) == 0 ? 5 : 0);
}

static int is_same(const printer *t, int a, int b)
{
    const word *v = &t->word[a], *w = &t->word[b];
    const char *one = bare(v->text), *other = bare(w->text);
    const ptrdiff_t length = v->text + v->length - one;
    return length == w->text + w->length - other && memcmp(one, other, (size_t)length) == 0;
}

/* The declaration of that name, if it is of one of these kinds (1 << FUNCTION ...), or NULL. */
static declaration *declared(printer *t, int name, int kinds)
{
    for (declaration *d = t->at; d < t->at + t->count; d++)
        if (is_same(t, d->name, name))
            return kinds >> d->kind & 1 ? d : NULL;
    return NULL;
}

/* What the language has for a type (": ") or a call (" = "), or NULL. */
static const char *own_word(const printer *t, int name, const char *means)
{
    const word *w = &t->word[name];
    if (t->as->embeds && strncmp(w->text, "fetch", 5) == 0)
        return word_is(w, "fetch") ? "VNDF_NUMBERS[$1]; " : NULL;
    return language_word(t->as->to, w->text, w->length, means);
}

static int is_struct(printer *t, int type)
{
    return declared(t, type, 1 << STRUCT) && !own_word(t, type, ": ");
}

/* ---- forms --------------------------------------------------------------------------------------- */

static void put_words(printer *t, int at, int end);
static void put_parameters(printer *t, const declaration *d);
static void put_members(printer *t, const declaration *d);
static void put_statements(printer *t, const declaration *d);

static void put(const printer *t, const char *text)
{
    fputs(text, t->file);
}

/* A new line with the blanks of the one that the word stands in. */
static void put_line(const printer *t, int at)
{
    const char *line = t->word[at].text;
    while (line[-1] != '\n')
        line--;
    fprintf(t->file, "\n%*s", (int)strspn(line, " ") - t->word[at].outdent, "");
}

/* Blanks and comments before a word; in Python, where a line ends a statement, a blank. */
static void put_gap(const printer *t, int at)
{
    const word *w = &t->word[at];
    if (t->indents)
        put(t, w->gap > 0 && *w->text != '}' ? " " : "");
    else
        put_prefixed(t->as, t->file, w->before,
                     (size_t)(w->gap - (memchr(w->before, '\n', (size_t)w->gap) ? w->outdent : 0)));
}

/* Declarations, of these kinds, begin with the prefix; a variable or a member must not be a word of the language. */
static void put_name(printer *t, int name, int kinds)
{
    const word *w = &t->word[name];
    const declaration *d = declared(t, name, kinds);
    char spaced[80];
    snprintf(spaced, sizeof spaced, " %.*s ", w->length, w->text);
    if (d && strncmp(w->text, "vndf_", 5) != 0 && strncmp(w->text, "VNDF_", 5) != 0)
        put(t, d->kind == CONSTANT ? t->as->upper : t->as->lower);
    put_prefixed(t->as, t->file, w->text, (size_t)w->length);
    put(t, !d && strstr(language_reserved, spaced) ? "_" : "");
}

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
    put(t, brackets ? "(" : "");
    put_words(t, at, end);
    put(t, brackets ? ")" : "");
}

/* What the language has for a form, of a declaration, a type and a name, or for the call of that name. */
static void put_own(printer *t, const char *own, const declaration *d, int type, int name)
{
    const char *end = strstr(own, "; "), *signs = end == own + 2 ? "+-*/&|<>" : "&|<>", *its_type;
    const int first = word_find(t, name, t->words, ";"), items = d ? d->inner : name + 2;
    for (const char *next; own < end; own = next + 2) {
        next = memchr(own, '$', (size_t)(end - own));
        put_prefixed(t->as, t->file, own, (size_t)((next ? next : end) - own));
        switch (next ? next[1] : ' ') {
        case ' ': return;
        case ';': put(t, "; "); break;
        case 'T':
            if ((its_type = own_word(t, type, ": ")) != NULL)
                put_own(t, its_type, NULL, 0, 0);
            else
                put_name(t, type, 1 << STRUCT);
            break;
        case 'V': put_name(t, name, 0); break;
        case 'D': put_name(t, d->name, 1 << d->kind); break;
        case 'P': put_parameters(t, d); break;
        case 'M': put_members(t, d); break;
        case 'S': put_statements(t, d); break;
        case 'I': put_words(t, items + 1, t->word[items].other); break;
        case 'N': put_words(t, name + 2, d && d->kind == CONSTANT ? d->end : name + 3); break;
        case 'A': put_words(t, name + 2, first); break;
        case 'B': put_words(t, first + 3, word_find(t, first + 1, t->words, ";")); break;
        default: put_argument(t, name, next[1] - '1', signs);
        }
    }
}

/* 0 if the language has no such form. */
static int put_form(printer *t, const char *form, const declaration *d, int type, int name)
{
    const char *own = language_word(t->as->to, form, (int)strlen(form), ": ");
    if (own)
        put_own(t, own, d, type, name);
    return own != NULL;
}

/* ---- expressions --------------------------------------------------------------------------------- */

/* All is float: a double of the kernel, which has no f at its end, is printed with 9 digits. */
static void put_number(const printer *t, const word *number)
{
    const size_t length = (size_t)number->length;
    const int is_hex = length > 1 && number->text[1] == 'x', is_float = !is_hex && number->text[length - 1] == 'f';
    const int is_whole = !is_float && !memchr(number->text, is_hex ? 'p' : '.', length);
    char digits[40];
    if (is_float || is_whole)
        snprintf(digits, sizeof digits, "%.*s", number->length - is_float, number->text);
    else
        snprintf(digits, sizeof digits, "%.9g", strtod(number->text, NULL));
    fprintf(t->file, "%s%s%s", digits, is_whole || strpbrk(digits, ".en") ? "" : ".0",
            is_whole || t->indents ? "" : "f");
}

/* A name before its brackets; returns what follows them. */
static int put_call(printer *t, int name)
{
    const int close = t->word[name + 1].other;
    const declaration *d = declared(t, name, 1 << FUNCTION);
    const char *own = own_word(t, name, " = ");
    if (own) {
        put_own(t, own, NULL, 0, name);
        return close + 1;
    }
    put_name(t, name, 1 << FUNCTION);
    put(t, !d || !d->fetches || !t->by_pointer ? "(" : close == name + 2 ? "(numbers" : "(numbers, ");
    put_words(t, name + 2, close);
    put(t, ")");
    return close + 1;
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
            put(t, "//"); /* of whole numbers */
        else if (t->indents && w->kind == WORD_SIGN && (word_is(w, "&&") || word_is(w, "||") || word_is(w, "!")))
            put(t, *w->text == '&' ? "and" : *w->text == '|' ? "or" : "not ");
        else
            put_name(t, at, is_member ? 0 : 1 << CONSTANT | 1 << ARRAY);
    }
}

/* ---- statements ---------------------------------------------------------------------------------- */

static int put_statement(printer *t, int at);

/* Python binds names to one struct where C copies it. */
static void put_value(printer *t, int type, int name, int end)
{
    const int copied = t->indents && is_struct(t, type) && word_find(t, name, end, "(") == end;
    put(t, " = ");
    if (word_is(&t->word[name + 2], "{")) {
        put_form(t, "MAKE", NULL, type, name);
        return;
    }
    put(t, copied ? "_copy(" : "");
    put_words(t, name + 2, end);
    put(t, copied ? ")" : "");
}

/* type a = x, b, c[N] to before `end`: variables, or members of a struct. */
static void put_variables(printer *t, int type, int end, int members)
{
    for (int name = type + 1, stop; name < end; name = stop + 1) {
        const int is_first = name == type + 1, is_set = word_is(&t->word[name + 1], "=");
        stop = word_find(t, name, end, ",");
        if (!is_first && t->apart) {
            put_form(t, members ? "MEMBER_END" : "END", NULL, 0, 0);
            put_line(t, type);
        } else if (!is_first) {
            put(t, ",");
            put_gap(t, name);
        }
        if (is_first || t->apart)
            put_form(t,
                     word_is(&t->word[name + 1], "[") ? "SEVERAL"
                     : members                        ? "MEMBER"
                                                      : "VARIABLE",
                     NULL, type, name);
        else
            put_name(t, name, 0);
        if (is_set)
            put_value(t, type, name, stop);
        else if (!members)
            put_form(t, is_struct(t, type) ? "ZERO" : "UNSET", NULL, type, 0);
    }
}

/* What an if or a for governs, in braces, which close under the line of `head`; returns what follows. */
static int put_governed(printer *t, int head, int at)
{
    const int is_block = word_is(&t->word[at], "{"), close = t->word[at].other;
    put_form(t, "OPEN", NULL, 0, 0);
    at += is_block;
    do
        at = put_statement(t, at);
    while (is_block && at < close);
    if (is_block)
        put_gap(t, close);
    else if (!t->indents)
        put_line(t, head);
    put_form(t, "CLOSE", NULL, 0, 0);
    return at + is_block;
}

/* any(less(a, b)) has brackets already. */
static void put_condition(printer *t, int at, int end)
{
    const word *w = &t->word[at];
    const int whole = word_is(w, "any") && w[1].other == end - 1 && word_is(w + 3, "(") && w[3].other == end - 2;
    const char *own = whole ? own_word(t, at + 2, " = ") : NULL;
    const int is_not = word_is(w, "!") && at + 2 == end, is_name = at + 1 == end || is_not;
    if (own && *own == '(' && !t->indents) {
        put_call(t, at + 2);
        return;
    }
    put(t, "(");
    put_words(t, at + is_not, end);
    put(t, !is_name ? ")" : is_not ? " == 0)" : " != 0)");
}

/* Returns what follows. */
static int put_if(printer *t, int at)
{
    const int close = t->word[at + 1].other;
    put(t, "if ");
    put_condition(t, at + 2, close);
    const int next = put_governed(t, at, close + 1);
    if (!word_is(&t->word[next], "else"))
        return next;
    if (t->indents)
        put_line(t, next);
    const int is_if = word_is(&t->word[next + 1], "if");
    put(t, t->indents ? is_if ? "el" : "else" : is_if ? " else " : " else");
    return is_if ? put_if(t, next + 1) : put_governed(t, next, next + 1);
}

/* for (int i = A; i < B; i++) */
static int put_for(printer *t, int at)
{
    const int bound = word_find(t, at + 2, t->words, ";") + 3;
    if ((declared(t, bound, 1 << CONSTANT) || own_word(t, bound, " = ")) && put_form(t, "UNROLL", NULL, 0, 0))
        put_line(t, at);
    put_form(t, "FOR", NULL, 0, at + 3);
    return put_governed(t, at, t->word[at + 1].other + 1);
}

static int put_statement(printer *t, int at)
{
    if (t->indents)
        put_line(t, at);
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
    put_form(t, "END", NULL, 0, 0);
    return end + 1;
}

/* ---- declarations -------------------------------------------------------------------------------- */

static void put_parameters(printer *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    if (d->fetches && t->by_pointer) {
        put_form(t, "POINTER", NULL, 0, 0);
        put(t, close > d->inner + 2 ? "numbers, " : "numbers");
    }
    for (int at = d->inner + 1; at + 1 < close; at++) {
        at += word_is(&t->word[at], "const");
        put_form(t, "MEMBER", NULL, at, at + 1);
        at = word_find(t, at, close, ",");
        put(t, at < close ? ", " : "");
    }
}

static void put_members(printer *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    for (int at = d->inner + 1, end; at < close; at = end + 1) {
        end = word_find(t, at, close, ";");
        put_gap(t, at);
        put_variables(t, at, end, 1);
        put_form(t, "MEMBER_END", NULL, 0, 0);
    }
    put_gap(t, close);
}

/* Folding leaves parameters that nothing reads, of which C warns. */
static void put_unused(printer *t, const declaration *d)
{
    const int close = t->word[d->inner].other;
    for (int name = d->inner + 2, at; name < close; name = word_find(t, name, close, ",") + 2) {
        name += word_is(&t->word[name - 1], "const");
        for (at = close; at < d->end && !(is_same(t, at, name) && !word_is(&t->word[at - 1], ".")); at++)
            ;
        if (at == d->end && language_word(t->as->to, "UNUSED", 6, ": ")) {
            put(t, "\n    ");
            put_form(t, "UNUSED", NULL, 0, name);
        }
    }
}

static void put_statements(printer *t, const declaration *d)
{
    put_unused(t, d);
    for (int at = t->word[d->inner].other + 2; at < d->end - 1;)
        at = put_statement(t, at);
    put_gap(t, d->end - 1);
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
    for (int i = d->begin; i < d->end && d->kind != CONSTANT; i++) {
        const int is_call = word_is(&t->word[i + 1], "("), is_member = i > 0 && word_is(&t->word[i - 1], ".");
        declaration *of = is_member ? NULL : declared(t, i, is_call ? -1 : ~(1 << FUNCTION));
        d->fetches |= word_is(&t->word[i], "fetch") || word_is(&t->word[i], "fetch_4");
        if (of && of != d && !own_word(t, i, " = ") && !own_word(t, i, ": ")) {
            want(t, of);
            d->fetches |= of->fetches;
        }
    }
}

static void want_named(printer *t, const char *name, const char *end)
{
    const size_t length = (size_t)(end - bare(name));
    for (int i = 0; i < t->count; i++) {
        const char *own = bare(t->word[t->at[i].name].text);
        if (strncmp(own, bare(name), length) == 0 && (own[length] == '_' || !isalnum((unsigned char)own[length])))
            want(t, &t->at[i]);
    }
}

int translate(const export_document *as, const char *source, const char *wanted, FILE *to)
{
    static const char *const forms[] = {"FUNCTION", "STRUCT", "CONSTANT", "ARRAY"};
    const int indents = (as->to->is & LANGUAGE_INDENTS) != 0, apart = (as->to->is & LANGUAGE_APART) != 0;
    printer t = {.as = as, .file = to, .indents = indents, .apart = apart};
    const int good = read_text(&t, source);
    t.by_pointer = !as->embeds && language_word(as->to, "POINTER", 7, ": ");
    for (; good && *wanted; wanted += strcspn(wanted, " "), wanted += strspn(wanted, " "))
        want_named(&t, wanted, wanted + strcspn(wanted, " "));
    static const char numbers[] = "VNDF_NUMBERS";
    want_named(&t, numbers, numbers + sizeof numbers - 1);
    for (int i = 0, in_constants = 0; i < t.count && good; i++) {
        const declaration *d = &t.at[i];
        if (!d->wanted && d->begin > 0) /* the first constants are its host's */
            continue;
        put(&t, in_constants && d->kind != CONSTANT ? "\n" : "");
        in_constants = d->kind == CONSTANT;
        if (!in_constants || d->name == d->begin + 2)
            put_comment_before(&t, d);
        put_form(&t, forms[d->kind], d, d->type, d->name);
        put(&t, in_constants ? "\n" : "\n\n");
    }
    free(t.word);
    return good;
}
