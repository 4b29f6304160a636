#include "export/translate.h"

#include <stdlib.h>
#include <string.h>

enum { ARGUMENTS_MAX = 16 };

typedef struct writer {
    const translation *t;
    FILE *to;
    part_list *parts;
    const part *in; /* the function */
    const char *at; /* what comes next */
    int depth;      /* of indentation */
} writer;

/* A stretch of the text. */
typedef struct range {
    const char *from, *to;
} range;

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

static int has_prefix(const word *name, const char *prefix)
{
    return name->length >= 5 && memcmp(name->text, prefix, 5) == 0;
}

/* With the prefix for vndf_ or VNDF_, if it has that. */
static void put_prefixed(const translation *t, FILE *to, const word *name)
{
    int lower = has_prefix(name, "vndf_"), upper = has_prefix(name, "VNDF_");
    int skip = lower || upper ? 5 : 0;
    fprintf(to, "%s%.*s", lower ? t->lower : upper ? t->upper : "", (int)name->length - skip, name->text + skip);
}

void translate_pattern(const translation *t, FILE *to, const char *pattern, const char *name, long n)
{
    for (word next = word_at(pattern); next.kind != WORD_END; next = word_at(next.text + next.length)) {
        const word plain = {WORD_NAME, next.text, next.length}, given = {WORD_NAME, name, strlen(name)};
        int marked = next.text > pattern && next.text[-1] == '$';
        if (marked && word_is(&next, "NAME"))
            put_prefixed(t, to, &given);
        else if (marked && word_is(&next, "N"))
            fprintf(to, "%ld", n);
        else if (next.kind == WORD_DIRECTIVE) { /* its words too */
            fputc('#', to);
            next.length = 1;
        } else if (!word_is(&next, "$"))
            put_prefixed(t, to, &plain);
    }
}

/* Whether the name with vndf_ before it is another declaration's. */
static int is_public(const writer *w, const word *name)
{
    for (size_t i = 0; i < w->parts->count; i++) {
        const word *other = &w->parts->at[i].name;
        if (has_prefix(other, "vndf_") && other->length == name->length + 5 &&
            memcmp(other->text + 5, name->text, name->length) == 0)
            return 1;
    }
    return 0;
}

/* The name of a declaration: functions and structs begin with the prefix, constants with it in capitals; those of the
 * kernel that a public one has are told apart. */
static void put_part_name(const writer *w, const part *p)
{
    int has = has_prefix(&p->name, "vndf_") || has_prefix(&p->name, "VNDF_");
    int capital = p->kind == PART_CONSTANT || p->kind == PART_ARRAY;
    if (!has)
        fprintf(w->to, "%s%s", capital ? w->t->upper : w->t->lower, is_public(w, &p->name) ? "kernel_" : "");
    for (size_t i = has ? 5 : 0; i < p->name.length; i++) {
        char c = p->name.text[i];
        if (has && i == 5)
            fputs(capital ? w->t->upper : w->t->lower, w->to);
        fputc(capital && c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c, w->to);
    }
}

/* A variable or a member. */
static void put_name(const writer *w, const word *name)
{
    fprintf(w->to, "%.*s%s", (int)name->length, name->text,
            language_reserves(name->text, name->length) ? "_" : "");
}

static part *part_of(const writer *w, const word *name, part_kind kind)
{
    part *p = part_named(w->parts, name);
    return p && p->kind == kind ? p : NULL;
}

static void put_type(const writer *w, const word *type)
{
    const char *own = language_type(w->t->to, type->text, type->length);
    const part *p = part_of(w, type, PART_STRUCT);
    if (own)
        translate_pattern(w->t, w->to, own, "", 0);
    else if (p)
        put_part_name(w, p);
    else
        fprintf(w->to, "%.*s", (int)type->length, type->text);
}

static int is_type(const writer *w, const word *name)
{
    return word_is(name, "float") || word_is(name, "int") || word_is(name, "vec3") ||
           language_type(w->t->to, name->text, name->length) || part_of(w, name, PART_STRUCT);
}

/* `type name` in the language's order. */
static void put_typed(const writer *w, const word *type, const word *name)
{
    if (w->t->to->indents) {
        put_name(w, name);
    } else if (w->t->to->typed_after) {
        put_name(w, name);
        fputs(": ", w->to);
        put_type(w, type);
    } else {
        put_type(w, type);
        fputs(" ", w->to);
        put_name(w, name);
    }
}

static void put_indent(const writer *w)
{
    fprintf(w->to, "%*s", 4 * w->depth, "");
}

static word after(const word *w)
{
    return word_solid(w->text + w->length);
}

/* Text of a comment, in which names have their prefix. */
static void put_text(const writer *w, const char *from, const char *to)
{
    while (from < to) {
        word next = word_at(from);
        if (next.kind != WORD_NAME) /* comments in comments are none */
            next.length = 1;
        put_prefixed(w->t, w->to, &next);
        from += next.length;
    }
}

/* ---- expressions --------------------------------------------------------------------------------- */

static void put_range(writer *w, range r);

/* Between commas; the count. */
static size_t split(range r, range *parts, size_t most)
{
    size_t count = 0;
    while (r.from < r.to && word_solid(r.from).text < r.to) {
        const char *end = words_end(r.from, ",");
        end = end < r.to ? end : r.to;
        words_expect(count < most, r.from, "fewer values");
        parts[count++] = (range){word_solid(r.from).text, end};
        r.from = end + 1;
    }
    return count;
}

/* Whether a sign among these stands outside of brackets. */
static int has_sign(range r, const char *signs)
{
    return words_end(r.from, signs) < r.to;
}

static void put_argument(writer *w, range r, const char *signs)
{
    int closed = has_sign(r, signs);
    fputs(closed ? "(" : "", w->to);
    put_range(w, r);
    fputs(closed ? ")" : "", w->to);
}

/* A call that the language has in a form of its own; `bare`: without the brackets around all. */
static void put_call_of(writer *w, const char *pattern, range arguments, int bare)
{
    range one[ARGUMENTS_MAX];
    size_t count = split(arguments, one, ARGUMENTS_MAX), end = strlen(pattern) - (bare && *pattern == '(');
    const char *signs = strcmp(pattern, "$1") == 0 && !bare ? "+-*/&|<>" : "&|<>";
    for (size_t i = bare && *pattern == '('; i < end; i++) {
        size_t which = pattern[i] == '$' ? (size_t)(pattern[i + 1] - '1') : count;
        word name = word_at(pattern + i);
        if (which < count) {
            put_argument(w, one[which], signs);
            i++;
        } else {
            put_prefixed(w->t, w->to, &name);
            i += name.length - 1;
        }
    }
}

static const char *pattern_of(const writer *w, const word *name)
{
    return word_is(name, "fetch") ? w->t->fetched : language_call(w->t->to, name->text, name->length);
}

/* A name before its brackets; returns what follows them. */
static const char *put_call(writer *w, const word *name)
{
    const char *open = after(name).text, *close = words_end(open + 1, "");
    const char *pattern = pattern_of(w, name);
    const part *p = part_of(w, name, PART_FUNCTION);
    if (pattern) {
        put_call_of(w, pattern, (range){open + 1, close}, 0);
        return close + 1;
    }
    if (p)
        put_part_name(w, p);
    else
        put_name(w, name);
    fputs("(", w->to);
    if (p && p->fetches && w->t->by_pointer)
        fputs(word_solid(open + 1).text == close ? "numbers" : "numbers, ", w->to);
    put_range(w, (range){open + 1, close});
    fputs(")", w->to);
    return close + 1;
}

static void put_number(const writer *w, const word *number)
{
    int hex = number->length > 1 && (number->text[1] == 'x' || number->text[1] == 'X');
    int rounded = !hex && memchr(number->text, '.', number->length) && number->text[number->length - 1] != 'f';
    if (rounded || (hex && (memchr(number->text, 'p', number->length)))) /* of doubles too: all is float */
        fprintf(w->to, w->t->to->indents ? "%.9g" : "%.9gf", strtod(number->text, NULL));
    else
        fprintf(w->to, "%.*s",
                (int)number->length - (w->t->to->indents && !hex && number->text[number->length - 1] == 'f'),
                number->text);
}

static void put_sign(const writer *w, const word *sign, const char *end)
{
    int pair = sign->text + 1 < end && sign->text[1] == *sign->text;
    word next = word_solid(sign->text + 1);
    if (w->t->to->indents && *sign->text == '/' && next.kind == WORD_NUMBER &&
        !memchr(next.text, '.', next.length))
        fputc('/', w->to); /* of whole numbers */
    if (!w->t->to->indents || !strchr("&|!", *sign->text) || (*sign->text == '!' && sign->text[1] == '='))
        fputc(*sign->text, w->to);
    else if (*sign->text == '!')
        fputs("not ", w->to);
    else if (pair || sign->text[-1] == *sign->text)
        fputs(!pair ? "" : *sign->text == '&' ? "and" : "or", w->to);
    else
        fputc(*sign->text, w->to);
}

/* A line break, with the indentation of what continues. */
static void put_break(const writer *w)
{
    if (w->t->to->indents)
        fputs(" ", w->to);
    else
        fprintf(w->to, "\n%*s", 4 * w->depth + 4, "");
}

static void put_range(writer *w, range r)
{
    int member = 0;
    for (const char *at = r.from; at < r.to;) {
        word next = word_at(at);
        at += next.length;
        if (next.kind == WORD_LINE) {
            put_break(w);
            at += strspn(at, " ");
        } else if (next.kind == WORD_SPACE) {
            fputs(*at == '\n' || at >= r.to ? "" : " ", w->to);
        } else if (next.kind == WORD_NUMBER) {
            put_number(w, &next);
        } else if (next.kind == WORD_SIGN) {
            words_expect(*next.text != '?', r.from, "pick or if, not ?:,");
            put_sign(w, &next, r.to);
        } else if (next.kind == WORD_NAME && *after(&next).text == '(' && !member) {
            at = put_call(w, &next);
        } else if (next.kind == WORD_NAME) {
            const part *p = member ? NULL : part_named(w->parts, &next);
            if (p && (p->kind == PART_CONSTANT || p->kind == PART_ARRAY))
                put_part_name(w, p);
            else if (has_prefix(&next, "VNDF_"))
                put_prefixed(w->t, w->to, &next);
            else
                put_name(w, &next);
        }
        member = word_is(&next, ".");
    }
}

/* Whether the function declares a variable of this type. */
static int declares(const writer *w, const char *type, const word *name)
{
    for (word at = word_solid(w->in->inner), next; at.text < w->in->end; at = next) {
        next = after(&at);
        if (word_is(&at, type) && words_equal(&next, name))
            return 1;
    }
    return 0;
}

/* Whether a comparison is the same for all lanes: it names constants, whole numbers of the function (int,
 * where a lane's are of type whole), counts of its table and the kind of its matrix. */
static int is_of_all_lanes(const writer *w, range r)
{
    for (word next = word_solid(r.from); next.text < r.to; next = after(&next)) {
        word dot = after(&next);
        int member = word_is(&dot, ".");
        if (next.kind != WORD_NAME || part_of(w, &next, PART_CONSTANT))
            continue;
        if (!declares(w, member ? "table" : "int", &next) && !(member && declares(w, "affine_map", &next)))
            return 0;
        next = member ? after(&dot) : next;
    }
    return 1;
}

/* The condition of an if, where words stand for truths. Python, whose variables are arrays of lanes, can only
 * ask what is the same for all of them. */
static void put_condition(writer *w, range r, int alone)
{
    r.from = word_solid(r.from).text;
    while (r.to > r.from && (r.to[-1] == ' ' || r.to[-1] == '\n'))
        r.to--;
    for (const char *sign = "|&"; *sign; sign++) {
        const char stops[] = {*sign, '\0'}, *at = words_end(r.from, stops);
        if (at >= r.to)
            continue;
        words_expect(at[1] == *sign, at, "&& or ||");
        put_condition(w, (range){r.from, at}, 0);
        fputs(w->t->to->indents ? (*sign == '|' ? " or " : " and ") : *sign == '|' ? " || " : " && ", w->to);
        put_condition(w, (range){at + 2, r.to}, 0);
        return;
    }
    word first = word_solid(r.from);
    if (word_is(&first, "!")) {
        word inner = after(&first);
        int closed = word_is(&inner, "(");
        fputs(w->t->to->indents ? "not " : "!", w->to);
        fputs(closed ? "" : "(", w->to);
        put_condition(w, (range){inner.text, r.to}, !closed);
        fputs(closed ? "" : ")", w->to);
    } else if (word_is(&first, "(") && words_end(r.from + 1, "") + 1 == r.to) {
        fputs("(", w->to);
        put_condition(w, (range){r.from + 1, r.to - 1}, 0);
        fputs(")", w->to);
    } else if (word_is(&first, "any") && w->t->to->indents) {
        fputs("True", w->to); /* what is done there leaves alone what it does not mean */
    } else if (word_is(&first, "any")) {
        word inner = word_solid(after(&first).text + 1), open = after(&inner);
        const char *pattern = *open.text == '(' ? pattern_of(w, &inner) : NULL;
        if (pattern && alone && *pattern == '(')
            put_call_of(w, pattern, (range){open.text + 1, words_end(open.text + 1, "")}, 1);
        else
            put_range(w, (range){inner.text, r.to - 1});
    } else {
        words_expect(!w->t->to->indents || is_of_all_lanes(w, r), r.from,
                     "pick, or any(mask) for what lanes differ in,");
        put_range(w, r);
        if (!has_sign(r, "<>="))
            fputs(" != 0", w->to);
    }
}

/* ---- structs ------------------------------------------------------------------------------------- */

/* A member; `count` is the number of its elements, or empty. */
typedef struct field {
    word type, name, count;
    int begins; /* a declaration */
} field;

enum { FIELDS_MAX = 40 };

static size_t fields_of(const part *p, field *fields)
{
    size_t count = 0;
    word next = word_solid(p->inner);
    while (!word_is(&next, "}")) {
        word type = next;
        next = after(&next);
        for (int begins = 1;; begins = 0) {
            words_expect(count < FIELDS_MAX, next.text, "fewer members");
            field *f = &fields[count++];
            *f = (field){.type = type, .name = next, .begins = begins};
            next = after(&next);
            if (word_is(&next, "[")) {
                f->count = after(&next);
                next = after(&f->count);
                next = after(&next);
            }
            if (!word_is(&next, ","))
                break;
            next = after(&next);
        }
        next = after(&next);
    }
    return count;
}

static void put_field(writer *w, const field *f, int ends)
{
    if (f->begins || w->t->to->structs == STRUCT_FIELDS)
        put_indent(w);
    if (w->t->to->structs == STRUCT_FIELDS) {
        put_name(w, &f->name);
        fputs(f->count.length ? ": array<" : ": ", w->to);
        put_type(w, &f->type);
        fputs(f->count.length ? ", " : "", w->to);
        if (f->count.length)
            put_range(w, (range){f->count.text, f->count.text + f->count.length});
        fputs(f->count.length ? ">" : "", w->to);
    } else {
        if (f->begins)
            put_type(w, &f->type);
        fputs(f->begins ? " " : "", w->to);
        put_name(w, &f->name);
        if (f->count.length) {
            fputs("[", w->to);
            put_range(w, (range){f->count.text, f->count.text + f->count.length});
            fputs("]", w->to);
        }
    }
    fputs(w->t->to->structs == STRUCT_FIELDS ? ",\n" : ends ? ";\n" : ", ", w->to);
}

/* A class whose members are set by place. */
static void put_class(writer *w, const part *p, const field *fields, size_t count)
{
    fputs("class ", w->to);
    put_part_name(w, p);
    fputs("(_Struct):\n    __slots__ = (", w->to);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? ", \"" : "\"", w->to);
        put_name(w, &fields[i].name);
        fputs("\"", w->to);
    }
    fputs(count == 1 ? ",)\n" : ")\n", w->to);
}

static void put_struct(writer *w, const part *p)
{
    field fields[FIELDS_MAX];
    size_t count = fields_of(p, fields);
    struct_form form = w->t->to->structs;
    if (form == STRUCT_CLASS) {
        put_class(w, p, fields, count);
        return;
    }
    fputs(form == STRUCT_TYPEDEF ? "typedef struct " : "struct ", w->to);
    put_part_name(w, p);
    fputs(" {\n", w->to);
    w->depth = 1;
    for (size_t i = 0; i < count; i++)
        put_field(w, &fields[i], i + 1 == count || fields[i + 1].begins);
    w->depth = 0;
    fputs(form == STRUCT_TYPEDEF ? "} " : "}", w->to);
    if (form == STRUCT_TYPEDEF)
        put_part_name(w, p);
    fputs(form == STRUCT_FIELDS ? "\n" : ";\n", w->to);
}

/* {a, b}, of a struct. */
static void put_made(writer *w, const word *type, range r)
{
    range one[ARGUMENTS_MAX];
    field fields[FIELDS_MAX];
    const part *p = part_of(w, type, PART_STRUCT);
    words_expect(p != NULL, type->text, "a struct");
    size_t count = split(r, one, ARGUMENTS_MAX), members = fields_of(p, fields);
    words_expect(count == members, type->text, "a value for every member");
    if (w->t->to->made_by_call)
        put_type(w, type);
    fputs(w->t->to->made_by_call ? "(" : "{", w->to);
    for (size_t i = 0; i < count && i < members; i++) {
        fputs(i ? "," : "", w->to);
        if (i && memchr(one[i - 1].to, '\n', (size_t)(one[i].from - one[i - 1].to)))
            put_break(w);
        else
            fputs(i ? " " : "", w->to);
        if (*one[i].from == '{')
            put_made(w, &fields[i].type, (range){one[i].from + 1, words_end(one[i].from + 1, "")});
        else
            put_range(w, one[i]);
    }
    fputs(w->t->to->made_by_call ? ")" : "}", w->to);
}

/* ---- statements ---------------------------------------------------------------------------------- */

static void put_statement(writer *w);

/* Whether the function assigns to the name or to a part of it from `at` on. */
static int is_assigned(const writer *w, const char *at, const word *name)
{
    char before = ' ';
    for (word next = word_solid(at); next.text < w->in->end; next = after(&next)) {
        if (words_equal(&next, name) && before != '.') {
            word then = after(&next);
            while (word_is(&then, ".") || word_is(&then, "[")) {
                const char *end = word_is(&then, "[") ? words_end(then.text + 1, "") + 1 : NULL;
                word member = after(&then);
                then = end ? word_solid(end) : after(&member);
            }
            if (then.kind == WORD_SIGN &&
                ((*then.text == '=' && then.text[1] != '=') ||
                 (strchr("+-*/", *then.text) && strchr("=+-", then.text[1]) && then.text[1])))
                return 1;
        }
        before = *next.text;
    }
    return 0;
}

static void end_statement(writer *w)
{
    if (!w->t->to->indents)
        fputs(";", w->to);
    w->at = words_end(w->at, ";") + 1;
}

/* Python binds names to one struct where C copies it. */
static void put_value(writer *w, const word *type, range r)
{
    word first = word_solid(r.from);
    int made = word_is(&first, "{"), copied = w->t->to->indents && !made && !has_sign(r, "+-*/(") &&
                                              first.kind == WORD_NAME && part_of(w, type, PART_STRUCT) &&
                                              *after(&first).text != '(';
    if (made) {
        put_made(w, type, (range){first.text + 1, words_end(first.text + 1, "")});
    } else {
        fputs(copied ? "_copy(" : "", w->to);
        put_range(w, r);
        fputs(copied ? ")" : "", w->to);
    }
}

/* name or name = value. */
static void put_declared(writer *w, const word *type, range r, int is_constant, int first)
{
    const language *to = w->t->to;
    word name = word_solid(r.from), sign = after(&name);
    int has_value = sign.text < r.to && word_is(&sign, "=");
    range value = {has_value ? word_solid(sign.text + 1).text : r.to, r.to};
    if (to->typed_after) {
        int fixed = has_value && (is_constant || !is_assigned(w, r.to, &name)) && !part_of(w, type, PART_STRUCT);
        fputs(fixed ? "let " : "var ",
              w->to); /* structs are variables, since only those have elements at an index */
        put_typed(w, type, &name);
    } else if (to->indents || !first) {
        put_name(w, &name);
    } else {
        fputs(is_constant && to->keeps_const ? "const " : "", w->to);
        put_typed(w, type, &name);
    }
    if (has_value) {
        fputs(" = ", w->to);
        put_value(w, type, value);
    } else if (part_of(w, type, PART_STRUCT) && to->zero) {
        fputs(" = ", w->to);
        for (const char *at = to->zero; *at; at++)
            if (*at == '$')
                put_type(w, type);
            else
                fputc(*at, w->to);
    } else if (to->indents) {
        fputs(" = 0", w->to);
    }
}

static void put_declaration(writer *w, int is_constant)
{
    range one[ARGUMENTS_MAX];
    word type = word_solid(w->at);
    if (is_constant)
        type = after(&type);
    size_t count = split((range){type.text + type.length, words_end(type.text, ";")}, one, ARGUMENTS_MAX);
    int apart = w->t->to->typed_after || w->t->to->indents;
    for (size_t i = 0; i < count; i++) {
        if (i && apart) {
            fputs(w->t->to->indents ? "\n" : ";\n", w->to);
            put_indent(w);
        } else if (i) {
            fputs(", ", w->to);
        }
        put_declared(w, &type, one[i], is_constant, i == 0);
    }
    end_statement(w);
}

/* What an if or a for governs, in braces. */
static void put_governed(writer *w)
{
    fputs(w->t->to->indents ? ":\n" : " {\n", w->to);
    w->depth++;
    word next = word_solid(w->at);
    if (word_is(&next, "{")) {
        const char *end = words_end(next.text + 1, "");
        w->at = next.text + 1;
        while (word_solid(w->at).text < end)
            put_statement(w);
        w->at = end + 1;
    } else {
        put_statement(w);
    }
    w->depth--;
    if (!w->t->to->indents) {
        put_indent(w);
        fputs("}", w->to);
    }
}

static void put_if(writer *w)
{
    word open = word_solid(word_solid(w->at).text + 2);
    const char *close = words_end(open.text + 1, "");
    fputs(w->t->to->indents ? "if " : "if (", w->to);
    put_condition(w, (range){open.text + 1, close}, 1);
    fputs(w->t->to->indents ? "" : ")", w->to);
    w->at = close + 1;
    put_governed(w);
    word next = word_solid(w->at), then = after(&next);
    if (!word_is(&next, "else"))
        return;
    w->at = then.text;
    if (w->t->to->indents)
        put_indent(w);
    fputs(w->t->to->indents ? (word_is(&then, "if") ? "el" : "else") : " else", w->to);
    if (word_is(&then, "if")) {
        fputs(w->t->to->indents ? "" : " ", w->to);
        put_if(w);
    } else {
        put_governed(w);
    }
}

/* for (int i = A; condition; step) */
static void put_for(writer *w)
{
    word open = word_solid(word_solid(w->at).text + 3), type = word_solid(open.text + 1), name = after(&type);
    word sign = after(&name);
    const char *first = words_end(open.text + 1, ";"), *second = words_end(first + 1, ";");
    const char *close = words_end(second + 1, "");
    range begin = {word_solid(sign.text + 1).text, first}, goes_on = {word_solid(first + 1).text, second};
    if (w->t->to->indents) {
        fputs("for ", w->to);
        put_name(w, &name);
        fputs(" in range(", w->to);
        put_range(w, begin);
        fputs(", ", w->to);
        put_range(w, (range){word_solid(words_end(goes_on.from, "<") + 1).text, second});
        fputs(")", w->to);
    } else {
        fputs(w->t->to->typed_after ? "for (var " : "for (", w->to);
        put_typed(w, &type, &name);
        fputs(" = ", w->to);
        put_range(w, begin);
        fputs("; ", w->to);
        put_range(w, goes_on);
        fputs("; ", w->to);
        put_range(w, (range){word_solid(second + 1).text, close});
        fputs(")", w->to);
    }
    w->at = close + 1;
    put_governed(w);
}

/* An assignment or a call. */
static void put_assignment(writer *w)
{
    const char *end = words_end(w->at, ";");
    put_range(w, (range){word_solid(w->at).text, end});
    end_statement(w);
}

/* Comments in the language's form, and blank lines. */
static void put_between(writer *w)
{
    for (int lines = 0;;) {
        word next = word_at(w->at);
        if (next.kind == WORD_COMMENT) {
            put_indent(w);
            fputs(w->t->to->indents ? "#" : "/*", w->to);
            put_text(w, next.text + 2, next.text + next.length - 2);
            fputs(w->t->to->indents ? "\n" : "*/\n", w->to);
            lines = -1;
        } else if (next.kind == WORD_LINE && ++lines == 2) {
            fputs("\n", w->to);
        } else if (next.kind != WORD_SPACE && next.kind != WORD_LINE) {
            return;
        }
        w->at += next.length;
    }
}

/* A comment that ends the line of a statement. */
static void put_line_end(writer *w)
{
    word next = word_at(w->at);
    if (next.kind == WORD_SPACE)
        next = word_at(next.text + next.length);
    if (next.kind == WORD_COMMENT) {
        fputs(w->t->to->indents ? "  #" : " /*", w->to);
        put_text(w, next.text + 2, next.text + next.length - 2);
        fputs(w->t->to->indents ? "" : "*/", w->to);
        next = word_at(next.text + next.length);
    }
    fputs("\n", w->to);
    w->at = next.kind == WORD_LINE ? next.text + 1 : next.text;
}

/* Whether a loop, from its bracket on, ends at one of VNDF_. */
static int ends_constant(const char *open)
{
    const char *from = words_end(words_end(open + 1, ";") + 1, "<") + 1;
    word end = word_solid(from);
    return end.kind == WORD_NAME && has_prefix(&end, "VNDF_");
}

static void put_statement(writer *w)
{
    put_between(w);
    word first = word_solid(w->at), second = after(&first);
    put_indent(w);
    if (word_is(&first, "for") && w->t->to->unroll && ends_constant(after(&first).text)) {
        fprintf(w->to, "%s\n", w->t->to->unroll);
        put_indent(w);
    }
    if (word_is(&first, "if")) {
        put_if(w);
        if (w->t->to->indents)
            return;
    } else if (word_is(&first, "for")) {
        put_for(w);
        if (w->t->to->indents)
            return;
    } else if (word_is(&first, "const")) {
        put_declaration(w, 1);
    } else if (second.kind == WORD_NAME && is_type(w, &first)) {
        put_declaration(w, 0);
    } else {
        put_assignment(w);
    }
    put_line_end(w);
}

/* ---- declarations -------------------------------------------------------------------------------- */

/* Parameters that the function changes are copied where the language forbids that; Python would change the caller's. */
static void put_parameters(writer *w, const part *p)
{
    range one[ARGUMENTS_MAX];
    size_t count = split((range){p->inner, words_end(p->inner, "")}, one, ARGUMENTS_MAX);
    fputs("(", w->to);
    if (p->fetches && w->t->by_pointer)
        fprintf(w->to, "%snumbers%s", w->t->to->pointer, count ? ", " : "");
    for (size_t i = 0; i < count; i++) {
        word type = word_solid(one[i].from);
        int constant = word_is(&type, "const");
        type = constant ? after(&type) : type;
        word name = after(&type);
        if (name.text >= one[i].to) /* (void) */
            break;
        fputs(i ? ", " : "", w->to);
        fputs(constant && w->t->to->keeps_const ? "const " : "", w->to);
        if (w->t->to->typed_after && is_assigned(w, p->body, &name)) {
            put_name(w, &name);
            fputs("_in: ", w->to);
            put_type(w, &type);
        } else {
            put_typed(w, &type, &name);
        }
    }
    fputs(")", w->to);
}

static void put_copies(writer *w, const part *p)
{
    range one[ARGUMENTS_MAX];
    size_t count = split((range){p->inner, words_end(p->inner, "")}, one, ARGUMENTS_MAX);
    for (size_t i = 0; i < count; i++) {
        word type = word_solid(one[i].from), name = after(&type);
        if (name.text >= one[i].to || !is_assigned(w, p->body, &name))
            continue;
        if (w->t->to->typed_after) {
            fputs("    var ", w->to);
            put_name(w, &name);
            fputs(" = ", w->to);
            put_name(w, &name);
            fputs("_in;\n", w->to);
        } else if (w->t->to->indents && part_of(w, &type, PART_STRUCT)) {
            fputs("    ", w->to);
            put_name(w, &name);
            fputs(" = _copy(", w->to);
            put_name(w, &name);
            fputs(")\n", w->to);
        }
    }
}

static void put_function(writer *w, const part *p)
{
    const language *to = w->t->to;
    w->in = p;
    fputs(to->indents ? "def " : to->function, w->to);
    if (!to->typed_after && !to->indents) {
        put_type(w, &p->type);
        fputs(" ", w->to);
    }
    put_part_name(w, p);
    put_parameters(w, p);
    if (to->typed_after) {
        fputs(" -> ", w->to);
        put_type(w, &p->type);
    }
    fputs(to->indents ? ":\n" : " {\n", w->to);
    put_copies(w, p);
    w->at = p->body;
    w->depth = 1;
    while (word_solid(w->at).text + 1 < p->end)
        put_statement(w);
    w->depth = 0;
    fputs(to->indents ? "" : "}\n", w->to);
}

static void put_array(writer *w, const part *p)
{
    range one[256];
    char name[64];
    const char *close = words_end(p->inner, "");
    size_t count = split((range){p->inner, close}, one, 256), n = 0;
    for (n = 0; n < p->name.length && n + 6 < sizeof name; n++)
        name[5 + n] =
            p->name.text[n] >= 'a' && p->name.text[n] <= 'z' ? (char)(p->name.text[n] - 32) : p->name.text[n];
    memcpy(name, "VNDF_", 5);
    name[5 + n] = '\0';
    translate_pattern(w->t, w->to, w->t->to->array, name, (long)count);
    w->depth = 0;
    for (size_t i = 0; i < count; i++) {
        fputs(i == 0 ? "" : i % 4 ? ", " : ",\n    ", w->to);
        put_range(w, (range){one[i].from, one[i].from + strcspn(one[i].from, ", \n}")});
    }
    fprintf(w->to, "%s\n", w->t->to->array_close);
}

static void put_comment(writer *w, const part *p)
{
    word comment = word_at(p->comment);
    if (!w->t->to->indents) {
        put_text(w, comment.text, comment.text + comment.length);
        fputs("\n", w->to);
        return;
    }
    for (const char *at = comment.text + 2, *end = comment.text + comment.length - 2; at < end;) {
        size_t n = strcspn(at, "\n");
        at += strspn(at, " *");
        n = strcspn(at, "\n");
        n = at + n < end ? n : (size_t)(end - at);
        fprintf(w->to, "# %.*s\n", (int)n, at);
        at += n + 1;
    }
}

static void put_constant(writer *w, const part *p)
{
    char name[64];
    snprintf(name, sizeof name, "%s%.*s", has_prefix(&p->name, "VNDF_") ? "" : "VNDF_", (int)p->name.length,
             p->name.text);
    translate_pattern(w->t, w->to, w->t->to->constant, name, p->value);
}

static int is_known(const void *in, const word *name)
{
    return language_call(in, name->text, name->length) != NULL;
}

int translation_want(const translation *t, part_list *parts, const char *name)
{
    const word wanted = {WORD_NAME, name, strlen(name)};
    part *p = part_named(parts, &wanted);
    if (p)
        part_want(parts, p, is_known, t->to);
    return p != NULL;
}

void translate(const translation *t, FILE *to, part_list *parts)
{
    writer w = {.t = t, .to = to, .parts = parts};
    for (size_t i = 0; i < parts->count; i++) {
        const part *p = &parts->at[i];
        if (!p->wanted)
            continue;
        if (p->comment)
            put_comment(&w, p);
        if (p->kind == PART_FUNCTION)
            put_function(&w, p);
        else if (p->kind == PART_STRUCT)
            put_struct(&w, p);
        else if (p->kind == PART_ARRAY)
            put_array(&w, p);
        else
            put_constant(&w, p);
        if (p->kind != PART_CONSTANT || i + 1 >= parts->count || parts->at[i + 1].kind != PART_CONSTANT)
            fputs(t->to->indents ? "\n\n" : "\n", to);
    }
}
